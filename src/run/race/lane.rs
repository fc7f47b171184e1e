//! A solver on its own copy of the scene's bodies. The truth is a lane, too.
//!
//! A body that blows up, or whose solver fails, halts alone: the lane's other bodies continue, unchanged to the bit.

use std::sync::Arc;

use super::chase::Chase;
use super::extent::Extent;
use super::ticker::Ticked;
use crate::scene::{Action, Appearance, Drawing, Preview, Scene, SceneBody};
use crate::sim::bodies::{Coordinate, Coordinates, Custom, FalseClaims, Input, Kind, Law, Truth};
use crate::sim::integrators::StepFailure;
use crate::sim::number::{duration, superscript};
use crate::sim::{Solver, Stepper};

/// Largest magnitude of a coordinate or velocity. A larger value would not fit the picture's f32, so the body halts.
pub const ESCAPE: f64 = 1e38;

/// The reason why a body stopped, and the time.
#[derive(Clone, Debug, PartialEq)]
pub struct Halt {
    /// The tick that failed. The body keeps its state from before that tick.
    pub tick: u64,
    /// Time (s) at which the failed tick began.
    pub t: f64,
    /// Index in the scene of the body that failed.
    pub body: usize,
    /// The reason why the body failed.
    pub failure: StepFailure,
}

impl Halt {
    /// Whether a value left the range of [`ESCAPE`] or was not finite; if not, the solver failed.
    pub fn is_blow_up(&self) -> bool {
        matches!(self.failure, StepFailure::Escaped { .. } | StepFailure::NotFinite { .. })
    }

    /// Returns in words how the body ended: `blew up` or `gave up`.
    pub fn ending(&self) -> &'static str {
        if self.is_blow_up() { "blew up" } else { "gave up" }
    }

    /// Returns the body's end and its time in words: `blew up at 8.4 s`.
    pub fn fate(&self) -> String {
        format!("{} at {}", self.ending(), duration(self.t))
    }
}

/// A halted body that resumes because its lane was switched to another method.
#[derive(Clone, Debug, PartialEq)]
pub struct Resumed {
    /// The halt that has ended.
    pub halt: Halt,
    /// The state from which it resumes.
    pub from: ResumedFrom,
}

/// The state from which a halted body resumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResumedFrom {
    /// The present state of the truth.
    Truth,
    /// The body's own last good state, because the truth has failed too.
    LastGood,
}

/// One body of a lane.
#[derive(Clone)]
pub struct LaneBody {
    /// Card of the body's kind.
    pub kind: Arc<Kind>,
    /// The body under the lane's solver.
    pub stepper: Box<dyn Stepper>,
    /// Coordinates one tick ago, for drawing between ticks.
    pub previous_q: Vec<f64>,
    /// Velocities one tick ago.
    pub previous_v: Vec<f64>,
    /// The state before the last input, to restore if the input makes the body fail.
    before_input: [Vec<f64>; 2],
    halted: Option<Halt>,
    /// Number of evaluations before the last tick.
    evaluations_before: u64,
    /// Range of the true motion so far; `None` under a method.
    extent: Option<Extent>,
    chase: Option<Chase>,
    appearance: Arc<Appearance>,
}

impl LaneBody {
    /// Returns the claims of a [`Law`] or a [`Custom`] body that fail with the present parameters; no claims for other
    /// bodies.
    pub fn false_claims(&self) -> FalseClaims {
        let body = self.stepper.body();
        let law = || body.downcast_ref().map(Law::false_claims);
        body.downcast_ref().map(Custom::false_claims).or_else(law).unwrap_or_default()
    }

    /// Creates a body of a scene at its start, under `solver`.
    pub fn new(body: &SceneBody, solver: Solver) -> Self {
        let stepper = (body.kind.build)(&body.values, solver);
        let state = [stepper.q(), stepper.v()].map(<[f64]>::to_vec);
        let [previous_q, previous_v] = state.clone();
        let chase = Chase::new(&*stepper, 0.0);
        let mut body = Self {
            kind: body.kind.clone(),
            stepper,
            previous_q,
            previous_v,
            before_input: state,
            halted: None,
            evaluations_before: 0,
            extent: (solver == Solver::Truth).then(Extent::default),
            chase,
            appearance: body.appearance.clone(),
        };
        body.add_moment();
        body
    }

    /// Returns the coordinates, in state order.
    pub fn coordinates(&self) -> Coordinates {
        self.kind.all_coordinates.first(self.stepper.q().len())
    }

    /// Returns why and when the body stopped, if it did.
    pub fn halted(&self) -> Option<&Halt> {
        self.halted.as_ref()
    }

    /// Returns the body's end in words with its values, if it halted: `blew up at 8.4 s (speed reached 10³⁸ m/s)`.
    pub fn fate(&self) -> Option<String> {
        let halt = self.halted()?;
        let (fate, how) = (halt.fate(), |name| self.quantity(name));
        Some(match &halt.failure {
            StepFailure::Escaped { coordinate, value } => {
                let size = superscript(libm::round(libm::log10(value.abs())) as i32);
                let (quantity, unit) = how(coordinate);
                format!("{fate} ({quantity} reached 10{size}{unit})")
            }
            StepFailure::NotFinite { coordinate, .. } => {
                format!("{fate} ({} overflowed)", how(coordinate).0)
            }
            failure => format!("{fate}: {failure}"),
        })
    }

    /// Returns the quantity with this name in words, and the quantity's unit with a space in front, if it has one.
    pub fn quantity(&self, name: &str) -> (String, String) {
        let coordinates = self.coordinates();
        let several = coordinates.len() > 1;
        let velocity = coordinates.iter().find(|coordinate| *coordinate.velocity == *name);
        let of = velocity.clone().or_else(|| coordinates.iter().find(|it| *it.name == *name));
        let plain = if velocity.is_some() { "speed" } else { "position" };
        let quantity = match self.kind.node(name) {
            Some((_, node)) => format!("node {node}"),
            None if several => name.to_owned(),
            None => plain.to_owned(),
        };
        let unit = match (of.map_or("1", |coordinate| coordinate.unit), velocity.is_some()) {
            ("1", false) => String::new(),
            ("1", true) => " per second".into(),
            (unit, false) => format!(" {unit}"),
            (unit, true) => format!(" {unit}/s"),
        };
        (quantity, unit)
    }

    /// Returns the number of evaluations of the body's acceleration in the last tick.
    pub fn evaluations_of_last_tick(&self) -> u64 {
        self.stepper.evaluations() - self.evaluations_before
    }

    /// Returns the range of the true motion so far; `None` under a method.
    pub(crate) fn extent(&self) -> Option<&Extent> {
        self.extent.as_ref()
    }

    /// Returns the progress towards the body's target since the body's start, or since the last input or placement.
    /// `None` if there is no target, or if the target moves.
    pub fn chase(&self) -> Option<&Chase> {
        self.chase.as_ref()
    }

    /// Returns the drawing by the author of a custom body; `None` for the default drawing.
    pub fn drawing(&self) -> Option<&Drawing> {
        self.appearance.drawing.as_deref()
    }

    /// Returns the motion of a law, a net or a custom body in its first seconds.
    pub fn preview(&self) -> Arc<Preview> {
        self.appearance.preview(&self.kind, self.stepper.body())
    }

    /// Returns the index of the coordinate that a plot shows by default. For a net, this is the one that moves farthest
    /// in the first seconds, such as the height of a bridge's middle; for other bodies it is the first.
    pub fn plotted_coordinate(&self) -> usize {
        self.kind.net().map_or(0, |_| self.preview().farthest)
    }

    /// Returns the values whose coordinate has the unit of the first coordinate. `values` has one value per coordinate.
    pub fn like_first(&self, values: &[f64]) -> impl Iterator<Item = f64> {
        let units = self.kind.all_coordinates.units();
        let first = units.clone().next();
        units.zip(values).filter(move |(unit, _)| Some(*unit) == first).map(|(_, &value)| value)
    }

    /// Returns the speed in the coordinates that have the unit of the first coordinate.
    pub(crate) fn speed(&self) -> f64 {
        self.like_first(self.stepper.v()).fold(0.0, libm::hypot)
    }

    /// Returns the kind of truth for a body under [`Solver::Truth`]. A law that gives its solution is
    /// [exact](Truth::Exact) up to the first input.
    pub fn truth(&self) -> Truth {
        if self.stepper.is_closed_form() { Truth::Exact } else { Truth::Reference }
    }

    /// Describes how well the true motion is known: `exact`, or the present error of the reference in the units of the
    /// coordinates. `no reference` if the reference would take too much work.
    pub fn truth_in_words(&self) -> String {
        let id = self.truth().id();
        if let Some(StepFailure::ReferenceTooExpensive { .. }) =
            self.halted().map(|halt| &halt.failure)
        {
            return self.truth().missing().into();
        }
        match (self.truth(), self.stepper.truth_error()) {
            (Truth::Exact, _) | (_, None) => id.into(),
            // A body that starts at 0 has no rounding error yet.
            (Truth::Reference, Some([0.0, _])) => id.into(),
            (Truth::Reference, Some([error, _])) if error.is_finite() => {
                let exponent = libm::ceil(libm::log10(error)) as i32;
                format!("{id} to 10{}", superscript(exponent))
            }
            (Truth::Reference, Some(_)) => format!("{id} lost"),
        }
    }

    /// Steps from `t` by `h` (s), from tick `tick` to the next, or halts in its present state. `index` is the body's
    /// index in the scene.
    fn tick(&mut self, index: usize, tick: u64, (t, h): (f64, f64), substeps: u32) {
        if self.halted.is_some() {
            return;
        }
        self.store_previous();
        self.evaluations_before = self.stepper.evaluations();
        let coordinates = &self.kind.all_coordinates;
        match advance_checked(&mut *self.stepper, coordinates, (t, h), substeps) {
            Ok(()) => {
                self.add_moment();
                let place = self.stepper.q()[0];
                if let Some(chase) = &mut self.chase {
                    chase.add_place(place, t + h);
                }
            }
            Err(failure) => {
                self.stepper.set(t, &self.previous_q, &self.previous_v);
                self.halted = Some(Halt { tick, t, body: index, failure });
            }
        }
    }

    /// Applies an input at time `t` (s), before tick `tick`. A body that fails under the input halts in the state
    /// before it. A halted body ignores a kick, and keeps the throttle and the rudder for when it resumes.
    fn input(&mut self, index: usize, tick: u64, t: f64, input: Input) {
        if self.halted.is_none() {
            self.change(index, tick, t, |stepper| stepper.input(t, input));
        } else if !matches!(input, Input::Kick(_)) {
            self.stepper.input(t, input);
        }
    }

    /// Pushes the body at time `t` (s), before tick `tick`. A body that fails under the push halts in the state before.
    /// A halted body ignores it.
    fn push(&mut self, index: usize, tick: u64, t: f64, action: &Action) {
        if self.halted.is_none() {
            self.change(index, tick, t, |stepper| {
                action.apply_to(stepper, t);
                true
            });
        }
    }

    /// Changes the state by `change`, which returns whether it did. A body that fails in the new state halts in the
    /// state before.
    fn change(
        &mut self,
        index: usize,
        tick: u64,
        t: f64,
        change: impl FnOnce(&mut dyn Stepper) -> bool,
    ) {
        let [q, v] = &mut self.before_input;
        q.copy_from_slice(self.stepper.q());
        v.copy_from_slice(self.stepper.v());
        let is_taken = change(&mut *self.stepper);
        match check(&*self.stepper, &self.kind.all_coordinates) {
            Ok(()) => {
                self.forget_energy();
                self.add_moment();
                if is_taken {
                    self.chase = Chase::new(&*self.stepper, t);
                }
            }
            Err(failure) => {
                let [q, v] = &self.before_input;
                self.stepper.set(t, q, v);
                self.store_previous();
                self.halted = Some(Halt { tick, t, body: index, failure });
            }
        }
    }

    /// Puts the body under another solver at time `t` (s) with its state unchanged. A halted body takes the present
    /// state of the truth.
    fn switch(&mut self, solver: Solver, t: f64, truth: &LaneBody) -> Option<Resumed> {
        self.stepper = self.stepper.with_solver(solver, t);
        let halt = self.halted.take()?;
        let from = if truth.halted.is_none() { ResumedFrom::Truth } else { ResumedFrom::LastGood };
        if from == ResumedFrom::Truth {
            self.stepper.set(t, truth.stepper.q(), truth.stepper.v());
        }
        self.store_previous();
        Some(Resumed { halt, from })
    }

    /// Puts the body into a state at time `t` (s), before tick `tick`. If the body had halted, it resumes.
    fn place(&mut self, index: usize, tick: u64, t: f64, [q, v]: [&[f64]; 2]) {
        self.halted = None;
        let [q0, v0] = &mut self.before_input;
        q0.copy_from_slice(self.stepper.q());
        v0.copy_from_slice(self.stepper.v());
        self.stepper.set(t, q, v);
        if let Err(failure) = check(&*self.stepper, &self.kind.all_coordinates) {
            let [q, v] = &self.before_input;
            self.stepper.set(t, q, v);
            self.halted = Some(Halt { tick, t, body: index, failure });
        }
        self.store_previous();
        self.forget_energy();
        self.add_moment();
        self.chase = Chase::new(&*self.stepper, t);
    }

    fn store_previous(&mut self) {
        self.previous_q.copy_from_slice(self.stepper.q());
        self.previous_v.copy_from_slice(self.stepper.v());
    }

    fn bytes(&self, solver: Solver) -> usize {
        let [q, v] = &self.before_input;
        let vectors = [&self.previous_q, &self.previous_v, q, v];
        let vectors = vectors.map(|vector| size_of_val(&vector[..])).iter().sum::<usize>();
        size_of::<Self>() + vectors + self.stepper.bytes(solver)
    }

    /// Forgets the energies of the true motion before a change of its state. A linear body tells the new one itself.
    fn forget_energy(&mut self) {
        let [q, v] = &self.before_input;
        let is_moved = q[..] != *self.stepper.q() || v[..] != *self.stepper.v();
        let is_linear = self.stepper.is_linear();
        if let Some(extent) = self.extent.as_mut().filter(|_| is_moved && !is_linear) {
            extent.forget_energy();
        }
    }

    /// Extends the range of the true motion by the present state.
    fn add_moment(&mut self) {
        if let Some(mut extent) = self.extent.take() {
            let kinetic_j = self.stepper.kinetic_energy();
            extent.add_moment(self.speed(), kinetic_j);
            // A body that conserves its energy needs no record of the sum.
            if kinetic_j.is_none() {
                extent.cover_energy(self.stepper.mechanical_energy());
            }
            self.extent = Some(extent);
        }
    }
}

/// Steps a body from `t` by `h` (s).
///
/// # Errors
/// If the body's solver fails, or if a coordinate or a velocity is not finite or is beyond [`ESCAPE`].
pub fn advance_checked(
    body: &mut dyn Stepper,
    coordinates: &Coordinates,
    (t, h): (f64, f64),
    substeps: u32,
) -> Result<(), StepFailure> {
    body.advance(t, h, substeps).and_then(|()| check(body, coordinates))
}

/// Fails if a coordinate or a velocity of a body is not finite or is beyond [`ESCAPE`].
fn check(body: &dyn Stepper, coordinates: &Coordinates) -> Result<(), StepFailure> {
    // This is false for NaN, too.
    let is_fine = |value: &f64| value.abs() <= ESCAPE;
    if [body.q(), body.v()].iter().all(|values| values.iter().all(is_fine)) {
        return Ok(());
    }
    let (q, v) = (body.q().iter().map(|q| (q, false)), body.v().iter().map(|v| (v, true)));
    let mut values = (0..body.q().len()).chain(0..body.v().len()).zip(q.chain(v));
    let (index, (&value, is_velocity)) =
        values.find(|(_, (value, _))| !is_fine(value)).expect("one is not fine");
    let Coordinate { name, velocity, .. } = coordinates.at(index);
    let coordinate = if is_velocity { velocity } else { name };
    Err(match value.is_finite() {
        true => StepFailure::Escaped { coordinate, value },
        false => StepFailure::NotFinite { coordinate, value },
    })
}

/// A solver on its own copy of the scene.
#[derive(Clone)]
pub struct Lane {
    solver: Solver,
    substeps: u32,
    bodies: Vec<LaneBody>,
}

impl Lane {
    /// Creates a lane with the scene's bodies at their start under `solver`, which takes `substeps` steps per tick.
    pub fn new(scene: &Scene, solver: Solver, substeps: u32) -> Self {
        let bodies = scene.bodies.iter().map(|body| LaneBody::new(body, solver)).collect();
        Self { solver, substeps, bodies }
    }

    /// Returns the solver of the bodies.
    pub fn solver(&self) -> Solver {
        self.solver
    }
    /// Returns the number of steps per tick.
    pub fn substeps(&self) -> u32 {
        self.substeps
    }
    /// Returns the bodies, in scene order.
    pub fn bodies(&self) -> &[LaneBody] {
        &self.bodies
    }
    /// Returns why and when bodies halted, in scene order. The other bodies continue.
    pub fn halts(&self) -> impl Iterator<Item = &Halt> {
        self.bodies.iter().filter_map(LaneBody::halted)
    }
    /// Returns the earliest halt of a body, if there is one.
    pub fn halted(&self) -> Option<&Halt> {
        self.halts().min_by_key(|halt| halt.tick)
    }
    /// Returns the number of evaluations of all bodies' accelerations since the start.
    pub fn evaluations(&self) -> u64 {
        self.bodies.iter().map(|body| body.stepper.evaluations()).sum()
    }

    /// Steps every body from `t` by `h` (s), from tick `tick` to the next. A body that fails keeps its state and
    /// halts.
    pub fn tick(&mut self, tick: u64, t: f64, h: f64) {
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.tick(index, tick, (t, h), self.substeps);
        }
    }

    /// Applies an input at time `t` (s), before tick `tick`, to every body that accepts it. A body that fails under the
    /// input keeps its state and halts. A halted body ignores a kick, and keeps the throttle and the rudder.
    pub fn input(&mut self, tick: u64, t: f64, input: Input) {
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.input(index, tick, t, input);
        }
    }

    /// Applies an action to the bodies at time `t` (s), before tick `tick`. A halted body resumes if an action places
    /// it. If a body cannot be in the new state, it keeps its own and halts.
    pub fn act(&mut self, tick: u64, t: f64, action: &Action) {
        match action {
            Action::Place { body, q, v } => self.bodies[*body].place(*body, tick, t, [q, v]),
            Action::Push { body, .. } => self.bodies[*body].push(*body, tick, t, action),
            Action::Set { body, .. } => action.apply_to(&mut *self.bodies[*body].stepper, t),
            other => {
                if let Some(input) = other.input() {
                    self.input(tick, t, input);
                }
            }
        }
    }

    /// Returns an upper limit of the heap memory in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.bodies.iter().map(|body| body.bytes(self.solver)).sum()
    }

    /// Puts the bodies under another solver at time `t` (s), with their states unchanged. Halted bodies resume from the
    /// present state of `truth`; the result lists these bodies. A switch to the present solver and substeps does
    /// nothing.
    pub fn switch(&mut self, solver: Solver, substeps: u32, t: f64, truth: &Lane) -> Vec<Resumed> {
        if (solver, substeps) == (self.solver, self.substeps) {
            return Vec::new();
        }
        (self.solver, self.substeps) = (solver, substeps);
        let bodies = self.bodies.iter_mut().zip(&truth.bodies);
        bodies.filter_map(|(body, truth)| body.switch(solver, t, truth)).collect()
    }
}

impl Ticked for Lane {
    fn act(&mut self, tick: u64, t: f64, action: &Action) {
        self.act(tick, t, action);
    }

    fn tick(&mut self, tick: u64, t: f64, h: f64) -> Result<(), StepFailure> {
        self.tick(tick, t, h);
        Ok(())
    }

    /// Work is counted in evaluations of a body's accelerations.
    fn has_worked_more(&self, than: u64, _: u64) -> bool {
        self.evaluations() > than
    }
}

#[cfg(test)]
mod tests;
