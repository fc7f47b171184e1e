//! The lines of a method, which call the acceleration or take the settings of a body.
//!
//! A step advances all coordinates of a body together. Each coordinate runs only the blocks whose condition holds for
//! it, and a call of the acceleration is made if at least one coordinate makes it. Functions are compiled at each call.

use std::ops::Range;

use super::{H, Line, StepRegisters, StepText, TARGET, V, X};
use crate::curve::Curve;
use crate::op::Op;

mod compile;

/// The maximum number of turns of all loops in a step, which ends any loop in a fraction of a second.
const MAX_TURNS: u32 = 1 << 16;

/// A setting that a method takes from its body, or from its caller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The rate of the law by which the body follows its target, per second.
    Rate,
    /// The stiffness of a joint, per unit of mass.
    Stiffness,
    /// The damping of a joint, per unit of mass.
    Damping,
    /// The drag of the body, per unit of mass.
    Drag,
    /// The remaining force per unit of mass.
    Force,
    /// The number of substeps.
    Substeps,
}

impl Input {
    /// Every setting, with its name in the lines.
    pub(super) const ALL: [(&str, Self); 6] = [
        ("rate", Self::Rate),
        ("stiffness", Self::Stiffness),
        ("damping", Self::Damping),
        ("drag", Self::Drag),
        ("force", Self::Force),
        ("substeps", Self::Substeps),
    ];
}

/// An input that the lines take.
#[derive(Clone, Debug)]
pub(super) struct Taken {
    /// The setting; `None` for the acceleration and the target.
    pub(super) input: Option<Input>,
    /// The index of its name; `None` for the acceleration.
    pub(super) name: Option<usize>,
    pub(super) is_whole: bool,
    /// Its number where a lane gives none.
    pub(super) default: u32,
    /// The byte range of its name, which its description may follow.
    pub(super) span: Range<usize>,
}

/// A request of a step to its body.
#[derive(Clone, Copy, Debug)]
pub enum Request<'r> {
    /// The acceleration.
    Acceleration,
    /// The accelerations `a` of the state moved by `alpha a` and `beta a`, for all coordinates together.
    Solution {
        /// The weight of the accelerations in the positions, in s².
        alpha: f64,
        /// The weight of the accelerations in the velocities, in seconds.
        beta: f64,
    },
    /// The derivative of the acceleration along a direction.
    Slope {
        /// The changes of the positions and of the velocities.
        along: [&'r [f64]; 2],
        /// The length in seconds of the step whose motion a difference suits.
        h: f64,
        /// The acceleration here.
        found: &'r [f64],
    },
}

/// A function for which the built-in methods have a general form, which steps use in place of its lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum General {
    /// The solver of implicit methods.
    Solve,
    /// The derivative of the acceleration along a direction.
    Slope,
}

impl General {
    /// Returns the general form of a function of the shared sources.
    pub(super) fn of(name: &str) -> Option<Self> {
        match name {
            "solve" => Some(Self::Solve),
            "slope" => Some(Self::Slope),
            _ => None,
        }
    }
}

/// A function of the lines. Its first names are its inputs.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: String,
    /// Whether each input is the acceleration.
    pub(super) inputs: Vec<bool>,
    pub(super) names: Vec<String>,
    pub(super) lines: Vec<Line>,
    /// The remarks above the function.
    pub(super) remarks: Vec<String>,
    /// The shared source of the function, if it is not the text of the step.
    pub(super) shared: Option<&'static str>,
    pub(super) general: Option<General>,
}

/// An array of numbers that the lines carry from one frame to the next.
#[derive(Debug)]
pub(super) struct Array {
    pub(super) name: String,
    pub(super) size: usize,
    pub(super) start: f64,
}

/// A call of the acceleration.
#[derive(Clone, Copy, Debug)]
pub struct StepCall {
    /// The time of the call, as a fraction of the step.
    pub part: f64,
    /// Whether the call is in a loop or in a function, where its time differs from turn to turn.
    is_repeated: bool,
}

/// One action of a step, on the slots of all coordinates.
#[derive(Debug)]
enum Act {
    Compute {
        op: Op,
        to: usize,
        from: [usize; 3],
        table: usize,
    },
    /// A request, at a position and with a velocity that are its first arguments.
    Call {
        general: Option<General>,
        from: Vec<usize>,
        time: usize,
        to: usize,
        index: usize,
    },
    /// Copies the number of an array at an index, or NaN if it has none there.
    Load {
        to: usize,
        array: usize,
        index: usize,
    },
    /// Copies a slot to the number of an array at an index, if it has one there.
    Store {
        array: usize,
        index: usize,
        from: usize,
    },
    /// Copies a slot, for the coordinates that run the block.
    Set {
        to: usize,
        from: usize,
    },
    If {
        condition: usize,
        yes: Vec<Act>,
        no: Vec<Act>,
    },
    While {
        test: Vec<Act>,
        condition: usize,
        body: Vec<Act>,
    },
    /// The lines of a function, which [`Act::Leave`] ends.
    Function(Vec<Act>),
    /// Ends the function or the step, for the coordinates that run the block.
    Leave,
}

/// The actions of a step. The first slots are those of the names.
#[derive(Debug, Default)]
pub(super) struct Machine {
    acts: Vec<Act>,
    numbers: Vec<(usize, f64)>,
    tables: Vec<Curve>,
    slots: usize,
    /// The number of levels of blocks and functions.
    levels: usize,
    calls: Vec<StepCall>,
    generals: Vec<General>,
    /// The first slot and the number of slots of each array.
    arrays: Vec<[usize; 2]>,
}

/// A step in progress.
struct Run<'r, F> {
    machine: &'r Machine,
    slots: &'r mut [f64],
    masks: &'r mut [bool],
    answer: &'r mut [f64],
    /// The number of coordinates.
    size: usize,
    h: f64,
    turns: u32,
    acceleration: F,
    /// The times of the calls, if they are sought. Then both blocks of an `if` are run.
    times: Option<&'r mut [f64]>,
}

impl<F: FnMut(f64, Request<'_>, [&[f64]; 2], &mut [f64])> Run<'_, F> {
    fn mask(&mut self, level: usize) -> &mut [bool] {
        &mut self.masks[level * self.size..][..self.size]
    }

    /// Opens a block at the level below `level` for the coordinates whose truth in a slot is `wanted`. Returns whether
    /// there are any.
    fn open(&mut self, level: usize, condition: Option<(usize, bool)>) -> bool {
        let (size, mut any) = (self.size, false);
        for i in 0..size {
            let holds =
                |(slot, wanted): (usize, bool)| (self.slots[slot * size + i] == 1.0) == wanted;
            let runs = self.masks[level * size + i] && condition.is_none_or(holds);
            self.masks[(level + 1) * size + i] = runs;
            any |= runs;
        }
        any
    }

    /// Runs actions at this level of blocks, in a function whose lines are at the level `function`.
    fn run(&mut self, acts: &[Act], level: usize, function: usize) {
        let size = self.size;
        for act in acts {
            match act {
                Act::Compute { op, to, from, table } => {
                    let table = self.machine.tables.get(*table);
                    for i in 0..size {
                        let operands = from.map(|slot| self.slots[slot * size + i]);
                        self.slots[to * size + i] = op.value(operands, table);
                    }
                }
                Act::Load { to, array, index } => {
                    for i in 0..size {
                        let found = self.element(*array, *index, i);
                        self.slots[to * size + i] = found.map_or(f64::NAN, |at| self.slots[at]);
                    }
                }
                Act::Store { array, index, from } => {
                    for i in 0..size {
                        let found = self.element(*array, *index, i);
                        if let Some(at) = found.filter(|_| self.masks[level * size + i]) {
                            self.slots[at] = self.slots[from * size + i];
                        }
                    }
                }
                Act::Set { to, from } => {
                    for i in 0..size {
                        if self.masks[level * size + i] {
                            self.slots[to * size + i] = self.slots[from * size + i];
                        }
                    }
                }
                Act::Call { general, from, time, to, index } => {
                    self.call(*general, from, [*time, *to, *index], level);
                }
                Act::If { condition, yes, no } => {
                    for (acts, wanted) in [(yes, true), (no, false)] {
                        if self.open(level, Some((*condition, wanted))) {
                            self.run(acts, level + 1, function);
                        } else if self.times.is_some() {
                            let (slots, masks) = (self.slots.to_vec(), self.masks.to_vec());
                            self.mask(level + 1).fill(true);
                            self.run(acts, level + 1, function);
                            self.slots.copy_from_slice(&slots);
                            self.masks.copy_from_slice(&masks);
                        }
                    }
                }
                Act::While { test, condition, body } => {
                    self.open(level, None);
                    loop {
                        self.run(test, level + 1, function);
                        for i in 0..size {
                            let holds = self.slots[condition * size + i] == 1.0;
                            self.masks[(level + 1) * size + i] &= holds;
                        }
                        if self.turns == MAX_TURNS || !self.mask(level + 1).contains(&true) {
                            break;
                        }
                        self.turns += 1;
                        self.run(body, level + 1, function);
                    }
                }
                Act::Function(body) => {
                    if self.open(level, None) {
                        self.run(body, level + 1, level + 1);
                    }
                }
                Act::Leave => {
                    for i in 0..size {
                        if self.masks[level * size + i] {
                            (function..=level)
                                .for_each(|level| self.masks[level * size + i] = false);
                        }
                    }
                }
            }
        }
    }

    /// Returns the place of a coordinate's number of an array, at the index in a slot.
    fn element(&self, array: usize, index: usize, i: usize) -> Option<usize> {
        let [start, size] = self.machine.arrays[array];
        let index = self.slots[index * self.size + i].floor();
        let is_there = (0.0..size as f64).contains(&index);
        is_there.then(|| (start + index as usize) * self.size + i)
    }

    fn call(
        &mut self,
        general: Option<General>,
        from: &[usize],
        [time, to, index]: [usize; 3],
        level: usize,
    ) {
        let size = self.size;
        let Some(first) = self.mask(level).iter().position(|runs| *runs) else { return };
        if let Some(times) = &mut self.times
            && times[index].is_nan()
        {
            times[index] = self.slots[time * size];
        }
        let argument = |n: usize| &self.slots[from[n] * size..][..size];
        let request = match general {
            None => Request::Acceleration,
            Some(General::Solve) => {
                let [alpha, beta] = [2, 3].map(|n| argument(n)[first]);
                Request::Solution { alpha, beta }
            }
            Some(General::Slope) => {
                let along = [argument(2), argument(3)];
                Request::Slope { along, h: argument(4)[first], found: argument(5) }
            }
        };
        let since = self.machine.calls[index].part * self.h;
        (self.acceleration)(since, request, [argument(0), argument(1)], self.answer);
        self.slots[to * size..][..size].copy_from_slice(self.answer);
    }
}

impl StepText {
    /// Returns the byte range that makes the lines those of a method; `None` for a rule. It is the first call of the
    /// acceleration or the first setting of a body.
    pub fn acceleration_at(&self) -> Option<Range<usize>> {
        self.method_at.clone()
    }

    /// Returns the calls of the acceleration, in order. Those of a function are listed for each of its calls.
    pub fn calls(&self) -> &[StepCall] {
        &self.machine.calls
    }

    /// Whether the lines call the acceleration in a loop or in a function, so that a step decides by a single
    /// coordinate.
    #[inline]
    pub fn is_for_one_coordinate(&self) -> bool {
        self.machine.calls.iter().any(|call| call.is_repeated)
    }

    /// Whether a step uses this general form.
    pub fn uses(&self, general: General) -> bool {
        self.machine.generals.contains(&general)
    }

    /// Returns the number of substeps of a lane that gives none.
    pub fn default_substeps(&self) -> u32 {
        let taken = self.inputs.iter().find(|taken| taken.input == Some(Input::Substeps));
        taken.map_or(1, |taken| taken.default)
    }

    /// Whether the method takes this setting.
    #[inline]
    pub fn takes(&self, input: Input) -> bool {
        self.inputs.iter().any(|taken| taken.input == Some(input))
    }

    /// Returns the order of the law by which the method follows a target; `None` if it follows none.
    #[inline]
    pub fn law_order(&self) -> Option<u32> {
        self.takes(Input::Rate).then_some(if self.reads_velocity { 2 } else { 1 })
    }

    /// Returns how many numbers a step needs per coordinate.
    pub fn slots(&self) -> usize {
        self.tape.slots.max(self.machine.slots)
    }

    /// Returns the text with the times of its calls. The time of a call is its place in a step of 1 s from 0, with a
    /// velocity of 1 and without a force. In a loop or a function it is the middle of the step, unless a line
    /// `held: at its start`, or `end`, tells otherwise.
    pub(super) fn timed(mut self) -> Self {
        let held = self.claim("held").and_then(|held| held.strip_prefix("at its "));
        let held = held.map_or(0.5, |held| if held.starts_with("start") { 0.0 } else { 1.0 });
        let mut times = vec![f64::NAN; self.machine.calls.len()];
        if self.machine.calls.iter().any(|call| !call.is_repeated) {
            let mut registers = self.method_registers(1);
            let (mut q, mut v) = ([0.0], [1.0]);
            self.set_input(&mut registers, Input::Substeps, 0, 1.0);
            let still = |_: f64, _: Request<'_>, _: [&[f64]; 2], found: &mut [f64]| found.fill(0.0);
            self.advance(&mut registers, 1.0, [&mut q, &mut v], still, Some(&mut times));
        }
        for (call, time) in self.machine.calls.iter_mut().zip(times) {
            let is_known = time.is_finite() && !call.is_repeated;
            call.part = if is_known { time } else { held };
        }
        self
    }

    /// Returns the registers of a body with this many coordinates, before its first step by a method.
    pub fn method_registers(&self, coordinates: usize) -> StepRegisters {
        let mut registers = StepRegisters {
            slots: vec![0.0; self.slots() * coordinates],
            next: Vec::new(),
            answer: vec![0.0; coordinates],
            masks: vec![false; self.machine.levels.max(1) * coordinates],
        };
        for (slot, number) in &self.machine.numbers {
            registers.slots[slot * coordinates..][..coordinates].fill(*number);
        }
        for ([first, size], array) in self.machine.arrays.iter().zip(&self.arrays) {
            registers.slots[first * coordinates..][..size * coordinates].fill(array.start);
        }
        self.forget(&mut registers);
        registers
    }

    /// Resets all carried numbers but `x` and `v` to their values before the first step.
    pub fn forget(&self, registers: &mut StepRegisters) {
        let size = registers.answer.len();
        for carried in self.carried.iter().filter(|carried| carried.input > V) {
            registers.slots[carried.input * size..][..size].fill(carried.start);
        }
    }

    /// Sets a setting of a coordinate, if the method takes it.
    #[inline]
    pub fn set_input(
        &self,
        registers: &mut StepRegisters,
        input: Input,
        coordinate: usize,
        value: f64,
    ) {
        let size = registers.answer.len();
        let taken = self.inputs.iter().find(|taken| taken.input == Some(input));
        if let Some(name) = taken.and_then(|taken| taken.name) {
            registers.slots[name * size + coordinate] = value;
        }
    }

    /// Sets the constant of this name in the registers of one coordinate, if its value is a number.
    pub(super) fn set_number(&self, registers: &mut StepRegisters, name: &str, value: f64) {
        let slot = self.names.iter().position(|known| known == name);
        let assigned = self.machine.acts.iter().find_map(|act| match act {
            Act::Set { to, from } if Some(*to) == slot => Some(*from),
            _ => None,
        });
        let number = self.machine.numbers.iter().find(|(number, _)| Some(*number) == assigned);
        if let Some((number, _)) = number {
            registers.slots[*number] = value;
        }
    }

    /// Sets the target of a coordinate.
    #[inline]
    pub fn set_target(&self, registers: &mut StepRegisters, coordinate: usize, value: f64) {
        let size = registers.answer.len();
        registers.slots[TARGET * size + coordinate] = value;
    }

    /// Steps all coordinates by `h` seconds, and replaces positions and velocities. Returns whether the loops of the
    /// lines ended by themselves. Never allocates.
    ///
    /// The arguments of `acceleration` are the time since the start of the step in seconds, the request, positions with
    /// velocities, and the output.
    pub fn step_method(
        &self,
        registers: &mut StepRegisters,
        h: f64,
        moved: [&mut [f64]; 2],
        acceleration: impl FnMut(f64, Request<'_>, [&[f64]; 2], &mut [f64]),
    ) -> bool {
        self.advance(registers, h, moved, acceleration, None)
    }

    fn advance(
        &self,
        registers: &mut StepRegisters,
        h: f64,
        [q, v]: [&mut [f64]; 2],
        acceleration: impl FnMut(f64, Request<'_>, [&[f64]; 2], &mut [f64]),
        times: Option<&mut [f64]>,
    ) -> bool {
        let StepRegisters { slots, answer, masks, .. } = registers;
        let size = q.len();
        slots[X * size..][..size].copy_from_slice(q);
        slots[V * size..][..size].copy_from_slice(v);
        slots[H * size..][..size].fill(h);
        masks[..size].fill(true);
        let machine = &self.machine;
        let mut run = Run { machine, slots, masks, answer, size, h, turns: 0, acceleration, times };
        run.run(&machine.acts, 0, 0);
        let has_ended = run.turns < MAX_TURNS;
        q.copy_from_slice(&slots[X * size..][..size]);
        v.copy_from_slice(&slots[V * size..][..size]);
        has_ended
    }
}
