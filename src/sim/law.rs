//! Equations of motion as text, such as `z = "-k*z/m"`, compiled to a flat tape.
//!
//! The expressions are those of [lines](regatta_lines).

use std::ops::Range;

use regatta_lines::{Jet, Tape, is_angle, is_linear, quoted};

use super::body::{self, Distances};
use compile::{Compiled, Compiler, check_names};

mod compile;
mod event;
mod fault;
mod linear;
mod powers;
mod rate;
mod registers;
mod text;

pub use fault::{LawFault, Part};
pub use linear::{AT_TARGET, Frame, LinearRule, NO_RETURN, RuleBody, remembers_place};
pub use powers::Powers;
pub use rate::{SecondOrder, second_order};
pub use regatta_lines::{
    Carried, Declares, Expression, ExpressionFault, FrameInput, FrameOutput, General, Input, Level,
    Line, LoopName, LoopText, MAX_BYTES, MAX_DEPTH, MAX_OPERATIONS, MAX_STEP_BYTES, MAX_SUBSTEPS,
    MethodInput, Operation, Remedy, Request, StepBody, StepCall, StepMap, StepRegisters, StepText,
    SwitchKind, bracketed, functions, is_function, operators, values,
};
pub(crate) use registers::LawLanes;
pub use registers::Registers;
pub use text::{CoordinateText, EventText, LawText, Layout};

// The same limits hold for any body, and `sim` is also built without lines.
const _: () = assert!(regatta_lines::MAX_SWITCHES == body::MAX_SWITCHES);
const _: () = assert!(regatta_lines::MAX_POINTS == crate::MAX_POINTS);

/// The maximum number of coordinates of a law. More could not be distinguished on a stage.
pub const MAX_COORDINATES: usize = 16;

/// The maximum number of constants of a law.
pub const MAX_CONSTANTS: usize = 64;

/// The maximum number of events of a law.
pub const MAX_EVENTS: usize = 8;

/// The units that a coordinate can have.
pub const UNITS: [&str; 14] =
    ["m", "rad", "km", "cm", "mm", "deg", "kg", "N", "J", "V", "A", "C", "K", "1"];

/// Returns a unit as people read it, which is empty for a pure number.
pub(crate) fn shown_unit(unit: &'static str) -> &'static str {
    if unit == "1" { "" } else { unit }
}

/// A compiled law.
///
/// The slots of the law's inputs are, in order: the time, throttle and rudder, coordinates, velocities, constants, and
/// the coordinates and velocities at the start.
#[derive(Debug)]
pub struct Equations {
    text: LawText,
    pub(crate) motion: Tape,
    energy: Option<Tape>,
    exact: Option<Tape>,
    places: Option<Tape>,
    when: Vec<Tape>,
    then: Option<Tape>,
    /// The coordinate of each event.
    walls: Vec<usize>,
    is_linear: bool,
    angles: Vec<bool>,
    is_steered: [bool; 2],
    reads_time: bool,
}

/// The slots of the first inputs.
const T: usize = 0;
const THROTTLE: usize = 1;
const RUDDER: usize = 2;
const FIRST_COORDINATE: usize = 3;

impl Equations {
    /// Compiles a law.
    ///
    /// # Errors
    /// All faults of the text, each with its position.
    pub fn new(text: LawText) -> Result<Self, Vec<LawFault>> {
        let mut faults = check_names(&text);
        let compiler = Compiler { text: &text };
        let mut tape =
            |compiled: Option<Compiled>| compiled?.map_err(|found| faults.extend(found)).ok();
        let is_solved = text.coordinates.iter().any(|of| of.exact.is_some());
        let is_placed = text.coordinates.iter().any(|of| of.at.is_some());
        let motion = tape(Some(compiler.motion()));
        let energy = tape(text.energy.as_ref().map(|_| compiler.energy()));
        let exact = tape(is_solved.then(|| compiler.exact()));
        let places = tape(is_placed.then(|| compiler.places()));
        let has_events = !text.events.is_empty();
        let when: Vec<Tape> =
            (0..text.events.len()).filter_map(|i| tape(Some(compiler.when(i)))).collect();
        let then = tape(has_events.then(|| compiler.then()));
        let Some(motion) = motion.filter(|_| faults.is_empty()) else { return Err(faults) };
        let walls = event::coordinates_of(&text, &when)?;
        event::check_count(&text, &motion)?;
        let moves = text.slots_of_motion();
        let is_angle = |input: usize| {
            let mut energy = energy.iter().filter(|tape| tape.reads(input));
            is_angle(&motion, input) && energy.all(|tape| is_angle(tape, input))
        };
        Ok(Self {
            is_linear: is_linear(&motion, text.inputs(), T, |input| moves.contains(&input)),
            angles: moves.clone().take(text.coordinates.len()).map(is_angle).collect(),
            is_steered: [motion.reads(THROTTLE), motion.reads(RUDDER)],
            reads_time: motion.reads(T) || when.iter().any(|tape| tape.reads(T)),
            text,
            motion,
            energy,
            exact,
            places,
            when,
            then,
            walls,
        })
    }

    /// Returns the text.
    pub fn text(&self) -> &LawText {
        &self.text
    }

    /// Whether the accelerations or the walls depend on the time.
    pub fn reads_time(&self) -> bool {
        self.reads_time
    }

    /// Whether the motion depends on the throttle and on the rudder.
    pub fn is_steered(&self) -> [bool; 2] {
        self.is_steered
    }

    /// Whether the accelerations are linear in coordinates and velocities, plus a constant.
    pub fn is_linear(&self) -> bool {
        self.is_linear
    }

    /// Whether a full turn of this coordinate changes nothing, because it is used only as the argument of a sine,
    /// cosine or tangent, and no event is about it.
    pub fn is_angle(&self, coordinate: usize) -> bool {
        self.angles[coordinate] && !self.walls.contains(&coordinate)
    }

    /// Returns the text of a part.
    pub fn part(&self, part: Part) -> &str {
        let text = &self.text;
        match part {
            Part::Constant(i) => &text.constants[i],
            Part::Coordinate(i) => &text.coordinates[i].name,
            Part::Acceleration(i) => &text.coordinates[i].acceleration,
            Part::Exact(i) => text.coordinates[i].exact.as_deref().unwrap_or_default(),
            Part::Place(i, axis) => text.coordinates[i].at.as_ref().map_or("", |at| &at[axis]),
            Part::Energy => text.energy.as_deref().unwrap_or_default(),
            Part::Event(i) => &text.events[i].name,
            Part::When(i) => &text.events[i].when,
            Part::Then(i, n) => &text.events[i].then[n].1,
        }
    }

    /// Whether the law declares drawing positions.
    pub fn has_places(&self) -> bool {
        self.places.is_some()
    }

    /// Returns the number of parts of the accelerations with a corner or a jump.
    pub fn switches(&self) -> usize {
        self.motion.switches()
    }
}

/// A moment of a motion, with its time, inputs and state.
#[derive(Clone, Copy, Debug)]
pub struct At<'a> {
    /// The time in seconds.
    pub t: f64,
    /// Throttle and rudder.
    pub steering: [f64; 2],
    /// The coordinates.
    pub q: &'a [f64],
    /// The velocities.
    pub v: &'a [f64],
}

impl Equations {
    #[inline]
    fn write_inputs(&self, registers: &mut Registers, at: At<'_>) {
        let slots = &mut registers.motion;
        slots[T] = at.t;
        [slots[THROTTLE], slots[RUDDER]] = at.steering;
        let (q, v) = slots[FIRST_COORDINATE..].split_at_mut(at.q.len());
        q.copy_from_slice(at.q);
        v[..at.v.len()].copy_from_slice(at.v);
    }

    #[inline]
    fn read(&self, registers: &Registers, a: &mut [f64]) {
        for (a, &slot) in a.iter_mut().zip(&self.motion.outputs) {
            *a = registers.motion[slot as usize];
        }
    }

    /// Overwrites `a` with the accelerations. Never allocates.
    #[inline]
    pub fn accelerate(&self, registers: &mut Registers, at: At<'_>, a: &mut [f64]) {
        self.write_inputs(registers, at);
        self.motion.evaluate(&mut registers.motion);
        self.read(registers, a);
    }

    /// Returns the acceleration of one coordinate. Never allocates.
    pub(crate) fn acceleration_of(
        &self,
        registers: &mut Registers,
        at: At<'_>,
        coordinate: usize,
    ) -> f64 {
        self.write_inputs(registers, at);
        self.motion.evaluate(&mut registers.motion);
        registers.motion[self.motion.outputs[coordinate] as usize]
    }

    /// Overwrites `a` with the accelerations of the piece with these modes, continued beyond the piece's boundaries.
    pub(super) fn accelerate_on(
        &self,
        modes: &[i64],
        registers: &mut Registers,
        at: At<'_>,
        a: &mut [f64],
    ) {
        self.write_inputs(registers, at);
        self.motion.evaluate_on(modes, &mut registers.motion);
        self.read(registers, a);
    }

    /// Overwrites `modes` with the modes of the switches at this moment.
    pub(super) fn write_modes(&self, registers: &mut Registers, at: At<'_>, modes: &mut [i64]) {
        self.write_inputs(registers, at);
        self.motion.evaluate(&mut registers.motion);
        self.motion.write_modes(&registers.motion, modes);
    }

    /// Overwrites `distances` with the distances from this moment to the boundaries of the piece with these modes.
    pub(super) fn write_distances(
        &self,
        modes: &[i64],
        registers: &mut Registers,
        at: At<'_>,
        distances: &mut Distances,
    ) {
        self.write_inputs(registers, at);
        self.motion.evaluate_on(modes, &mut registers.motion);
        self.motion.write_distances(&registers.motion, modes, distances);
    }

    /// Returns the energy in joules; if `v` is `None`, it is the energy at rest. Returns `None` if the law has no
    /// energy. Never allocates.
    pub fn energy(&self, registers: &mut Registers, q: &[f64], v: Option<&[f64]>) -> Option<f64> {
        let tape = self.energy.as_ref()?;
        let slots = &mut registers.energy[FIRST_COORDINATE..];
        slots[..q.len()].copy_from_slice(q);
        match v {
            Some(v) => slots[q.len()..2 * q.len()].copy_from_slice(v),
            None => slots[q.len()..2 * q.len()].fill(0.0),
        }
        tape.evaluate(&mut registers.energy);
        Some(registers.energy[*tape.outputs.first()? as usize])
    }

    /// Calls `to` with the drawing position of each coordinate that has one, in the order of the coordinates. A
    /// position has x to the right and y up, in metres. Never allocates.
    pub(super) fn place(&self, registers: &mut Registers, q: &[f64], mut to: impl FnMut([f64; 2])) {
        let Some(tape) = &self.places else { return };
        let slots = &mut registers.places;
        slots[FIRST_COORDINATE..][..q.len()].copy_from_slice(q);
        tape.evaluate(slots);
        for pair in tape.outputs.chunks_exact(2) {
            to([slots[pair[0] as usize], slots[pair[1] as usize]]);
        }
    }

    /// Calls `to` with the exact solution of each coordinate at time `t` (s). Its arguments are the coordinate's index,
    /// and the coordinate's value, velocity and acceleration. Returns whether the law has an exact solution. Never
    /// allocates.
    pub(super) fn solve(
        &self,
        registers: &mut Registers,
        t: f64,
        mut to: impl FnMut(usize, Jet),
    ) -> bool {
        let Some(tape) = &self.exact else { return false };
        let slots = &mut registers.exact;
        slots[T] = [t, 1.0, 0.0];
        tape.evaluate_jets(slots);
        for (i, &slot) in tape.outputs.iter().enumerate() {
            to(i, slots[slot as usize]);
        }
        true
    }

    /// Returns the two parts ∂E/∂q·v and ∂E/∂v·a of dE/dt, in watts; their sum is 0 if energy is conserved. The third
    /// number is the sum of the magnitudes of their terms, one for each coordinate. Returns `None` if the law has no
    /// energy.
    pub(super) fn power(&self, registers: &Registers, [q, v, a]: [&[f64]; 3]) -> Option<[f64; 3]> {
        let tape = self.energy.as_ref()?;
        let n = q.len();
        let mut slots: Vec<Jet> = registers.energy.iter().map(|&x| [x, 0.0, 0.0]).collect();
        let mut rate = |of: Range<usize>, by_velocity: bool| {
            for i in 0..n {
                let (moves, turns) = match (of.contains(&i), by_velocity) {
                    (false, _) => (0.0, 0.0),
                    (true, true) => (v[i], 0.0),
                    (true, false) => (0.0, a[i]),
                };
                slots[FIRST_COORDINATE + i] = [q[i], moves, 0.0];
                slots[FIRST_COORDINATE + n + i] = [v[i], turns, 0.0];
            }
            tape.evaluate_jets(&mut slots);
            tape.outputs.first().map(|&slot| slots[slot as usize][1])
        };
        let terms = (0..n).flat_map(|i| [(i, true), (i, false)]);
        let size = terms.map(|(i, of)| Some(rate(i..i + 1, of)?.abs())).sum::<Option<f64>>()?;
        Some([rate(0..n, true)?, rate(0..n, false)?, size])
    }
}

impl Equations {
    /// Returns the fault of the first operation that makes an acceleration infinite or undefined in the last
    /// evaluation; `None` if all accelerations are finite.
    pub(crate) fn not_finite(&self, registers: &Registers) -> Option<LawFault> {
        let (origin, divides) = self.motion.not_finite(&registers.motion)?;
        let (part, span) = (Part::Acceleration(origin.expression), origin.span.clone());
        let what = if divides { "divides by zero" } else { "is not finite" };
        let what = format!("`{}` {what} at the start", quoted(&self.part(part)[span.clone()]));
        let remedy = "give another start or other constants, or guard it with `if` or `max`";
        Some(LawFault::new(part, span, what, remedy))
    }
}
