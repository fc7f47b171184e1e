//! A flat tape of operations, evaluated from the first to the last.
//!
//! Operations that depend only on constants form a prelude, which runs only when a constant changes. Equal operations
//! on equal operands are evaluated once. Neither the prelude nor this sharing changes a bit of the result.

use std::array::from_fn;
use std::collections::HashMap;
use std::ops::Range;

use super::expression::{Expression, Node};
use super::jet::{self, Jet};
use super::op::Op;
use super::switch::{ModeRule, Switch};
use crate::curve::Curve;

/// The maximum number of operations of a tape, with which a step takes ten microseconds.
pub const MAX_OPERATIONS: usize = 4096;

/// The maximum number of switches of a tape. It is small, so that the list of their modes is small.
pub const MAX_SWITCHES: usize = 32;

/// One operation, which reads up to three slots and writes one.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    op: Op,
    to: u16,
    operands: [u16; 3],
    /// Number of operands.
    count: u8,
    /// The index of the operation's table.
    table: u16,
}

/// The kind of a switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SwitchKind {
    /// A comparison, whose mode 1 is true.
    Condition,
    /// The choice of one of two numbers.
    Limit,
    /// A function of a number's sign.
    Sign,
    /// A function with many pieces.
    Many,
}

/// The position of an operation in the text.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The index of the expression.
    pub expression: usize,
    /// The byte range in the text of the expression.
    pub span: Range<usize>,
}

/// The operations of one or more expressions over the same inputs. The first slots hold the inputs.
#[derive(Clone, Debug)]
pub struct Tape {
    numbers: Vec<(u16, f64)>,
    prelude: Vec<Instruction>,
    main: Vec<Instruction>,
    /// The slots of the expressions' values, in the order of the expressions.
    pub outputs: Vec<u16>,
    /// The number of slots of an evaluation.
    pub slots: usize,
    /// The switches of the main part.
    switches: Vec<(Switch, Instruction)>,
    tables: Vec<Curve>,
    /// The origin of each operation, by the slot that it writes.
    origins: HashMap<u16, Origin>,
}

/// The fault of a tape that is too long or has too many switches. It begins at the expression with this index.
pub struct TooLong {
    /// The index of the expression.
    pub expression: usize,
    /// Whether there are too many switches, rather than operations.
    pub are_switches: bool,
}

/// The key of common subexpressions, which is an operation and its arguments.
type Key = (Op, [u16; 3], u64, Vec<[u64; 2]>);

impl Tape {
    /// Returns the tape of these expressions over `inputs` inputs. Inputs that are `fixed` change only when a parameter
    /// changes.
    ///
    /// # Errors
    /// If there are more than [`MAX_OPERATIONS`] or [`MAX_SWITCHES`].
    pub fn new(
        inputs: usize,
        fixed: impl Fn(usize) -> bool,
        expressions: &[Expression],
    ) -> Result<Self, TooLong> {
        let mut tape = Self {
            numbers: Vec::new(),
            prelude: Vec::new(),
            main: Vec::new(),
            outputs: Vec::new(),
            slots: inputs,
            switches: Vec::new(),
            tables: Vec::new(),
            origins: HashMap::new(),
        };
        let mut is_fixed: Vec<bool> = (0..inputs).map(&fixed).collect();
        let mut known: HashMap<Key, u16> = HashMap::new();
        for (index, expression) in expressions.iter().enumerate() {
            let used = used(expression);
            let mut slots = vec![0; expression.nodes.len()];
            let rows = expression.nodes.iter().zip(&expression.spans).zip(used).enumerate();
            for (n, ((node, span), _)) in rows.filter(|(_, (_, is_used))| *is_used) {
                let mut operands = [0; 3];
                for (operand, &argument) in operands.iter_mut().zip(node.arguments()) {
                    *operand = slots[argument];
                }
                let origin = Origin { expression: index, span: span.clone() };
                slots[n] = match node.op {
                    Op::Input => node.index as u16,
                    _ => tape.place(node, operands, expression, &mut is_fixed, &mut known, origin),
                };
                let are_switches = tape.switches.len() > MAX_SWITCHES;
                if are_switches || tape.slots > MAX_OPERATIONS {
                    return Err(TooLong { expression: index, are_switches });
                }
            }
            tape.outputs.extend(slots.last());
        }
        Ok(tape)
    }

    /// Returns the slot of an operation, which is the slot of an equal earlier operation, or a new slot.
    fn place(
        &mut self,
        node: &Node,
        operands: [u16; 3],
        expression: &Expression,
        is_fixed: &mut Vec<bool>,
        known: &mut HashMap<Key, u16>,
        origin: Origin,
    ) -> u16 {
        let table = node.op.is_table().then(|| &expression.tables[node.index]);
        let points = table.map_or(&[][..], Curve::points);
        let bits = points.iter().map(|point| point.map(f64::to_bits)).collect();
        let key = (node.op, operands, node.number.to_bits(), bits);
        if let Some(&slot) = known.get(&key) {
            return slot;
        }
        let to = self.slots as u16;
        self.slots += 1;
        known.insert(key, to);
        self.origins.insert(to, origin);
        let count = node.arguments().len();
        let is_constant = operands[..count].iter().all(|&slot| is_fixed[slot as usize]);
        is_fixed.push(is_constant);
        let index = self.tables.len() as u16;
        self.tables.extend(table.cloned());
        let count = count as u8;
        let instruction = Instruction { op: node.op, to, operands, count, table: index };
        match node.op {
            Op::Number => self.numbers.push((to, node.number)),
            _ if is_constant => self.prelude.push(instruction),
            op => {
                self.main.push(instruction);
                if let Op::Switch(switch) = op {
                    self.switches.push((switch, instruction));
                }
            }
        }
        to
    }

    /// Writes the numbers and runs the prelude. The slots of the constants must be set.
    #[inline]
    pub fn prepare<const W: usize>(&self, slots: &mut [[f64; W]]) {
        self.numbers.iter().for_each(|&(slot, number)| slots[slot as usize] = [number; W]);
        self.run_lanes(&self.prelude, slots, &[], Switch::value);
    }

    /// Evaluates the tape.
    #[inline]
    pub fn evaluate(&self, slots: &mut [f64]) {
        self.run(slots, Switch::value);
    }

    /// Evaluates the tape on several motions at once. `alike` is the result of [`Tape::alike`].
    #[inline(always)]
    pub fn evaluate_lanes<const W: usize>(&self, slots: &mut [[f64; W]], alike: &[bool]) {
        self.run_lanes(&self.main, slots, alike, Switch::value);
    }

    /// Returns, for each slot, whether it has the same value in all motions, if only inputs that satisfy `differs`
    /// differ.
    pub fn alike(&self, differs: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut alike: Vec<bool> = (0..self.slots).map(|slot| !differs(slot)).collect();
        for (_, operands, to, _) in self.operations() {
            alike[to as usize] = operands.iter().all(|&slot| alike[slot as usize]);
        }
        alike
    }

    /// Evaluates the tape with each switch in its mode of `modes`.
    #[inline]
    pub fn evaluate_on(&self, modes: &[i64], slots: &mut [f64]) {
        let mut modes = modes.iter();
        self.run(slots, |switch, a, b, table| {
            switch.value_on(modes.next().copied().unwrap_or(0), a, b, table)
        });
    }

    /// Writes the modes of the switches at the values of the last evaluation.
    #[inline]
    pub fn write_modes(&self, slots: &[f64], modes: &mut [i64]) {
        for ((switch, instruction), to) in self.switches.iter().zip(modes) {
            let [a, b, _] = instruction.operands.map(|slot| slots[slot as usize]);
            *to = switch.mode(a, b, self.table(instruction));
        }
    }

    /// Writes the distances of the switches to the boundaries of these modes, at the values of the last evaluation.
    #[inline]
    pub fn write_distances(&self, slots: &[f64], modes: &[i64], to: &mut [[f64; 2]]) {
        for (((switch, instruction), &mode), to) in self.switches.iter().zip(modes).zip(to) {
            let [a, b, _] = instruction.operands.map(|slot| slots[slot as usize]);
            *to = switch.distances(mode, a, b, self.table(instruction));
        }
    }

    /// Evaluates the tape with derivatives. The slots of the inputs must be set.
    pub fn evaluate_jets(&self, slots: &mut [Jet]) {
        self.evaluate_jets_on(&[], slots);
    }

    /// Evaluates the tape with derivatives, with each switch in its mode of `modes`. Switches without one are in the
    /// mode of their operands.
    pub(super) fn evaluate_jets_on(&self, modes: &[i64], slots: &mut [Jet]) {
        for &(slot, number) in &self.numbers {
            slots[slot as usize] = jet::constant(number);
        }
        let mut modes = modes.iter();
        for (n, (op, operands, to, table)) in self.operations().enumerate() {
            let operand = |n: usize| operands.get(n).map_or([0.0; 3], |&slot| slots[slot as usize]);
            let operands = [operand(0), operand(1), operand(2)];
            let mode = match op {
                Op::Switch(switch) if n >= self.prelude.len() => {
                    modes.next().map(|it| (switch, *it))
                }
                _ => None,
            };
            slots[to as usize] = match mode {
                Some((switch, mode)) => switch.jet_on(mode, [operands[0], operands[1]], table),
                None => jet(op, operands, table),
            };
        }
    }

    /// Returns the kind and the byte range of each switch.
    pub(super) fn switch_origins(&self) -> impl Iterator<Item = (SwitchKind, &Range<usize>)> {
        self.switches.iter().map(|(switch, instruction)| {
            let kind = match switch.pieces {
                _ if switch.is_truth() => SwitchKind::Condition,
                ModeRule::Floor | ModeRule::Table => SwitchKind::Many,
                ModeRule::NotNegative | ModeRule::Sign => SwitchKind::Sign,
                _ => SwitchKind::Limit,
            };
            (kind, &self.origins[&instruction.to].span)
        })
    }

    /// Returns the slot of each switch.
    pub(super) fn switch_slots(&self) -> impl Iterator<Item = u16> {
        self.switches.iter().map(|(_, instruction)| instruction.to)
    }

    /// Returns the slots of the first two operands of each switch.
    pub(super) fn switch_operands(&self) -> impl Iterator<Item = [u16; 2]> {
        self.switches.iter().map(|(_, Instruction { operands: [a, b, _], .. })| [*a, *b])
    }

    /// Returns the operand, the slot and the byte range of each operation that rounds.
    pub(super) fn roundings(&self) -> impl Iterator<Item = ([u16; 2], &Range<usize>)> {
        let all = self.operations().filter(|(op, ..)| op.rounds());
        all.map(|(_, operands, to, _)| ([operands[0], to], &self.origins[&to].span))
    }

    /// Returns whether a comparison is true in a mode; `None` for another switch.
    pub(super) fn truth(&self, index: usize, mode: i64) -> Option<bool> {
        let (switch, _) = self.switches[index];
        switch.is_truth().then(|| switch.value_on(mode, 0.0, 0.0, None) == 1.0)
    }

    /// Returns the slot and the byte range of each condition that joins others by `and`, `or` or `not`, and chooses a
    /// number.
    pub(super) fn joined(&self) -> impl Iterator<Item = (u16, &Range<usize>)> {
        let slots: Vec<u16> =
            self.operations().filter(|it| it.0 == Op::If).map(|it| it.1[0]).collect();
        let joins = |op: Op| matches!(op, Op::And | Op::Or | Op::Not);
        let all = self.operations().filter(move |(op, _, to, _)| joins(*op) && slots.contains(to));
        all.map(|(_, _, to, _)| (to, &self.origins[&to].span))
    }

    /// Returns the number of switches.
    pub fn switches(&self) -> usize {
        self.switches.len()
    }

    /// Returns the mode of the switch with this index beyond a boundary of its mode.
    #[inline]
    pub fn neighbour(&self, index: usize, mode: i64, side: usize) -> i64 {
        self.switches[index].0.neighbour(mode, side)
    }

    /// Returns the operations of the prelude and of the main part, with their operands, output slot and table.
    pub(super) fn operations(&self) -> impl Iterator<Item = (Op, &[u16], u16, Option<&Curve>)> {
        self.prelude.iter().chain(&self.main).map(|instruction| {
            let operands = &instruction.operands[..usize::from(instruction.count)];
            (instruction.op, operands, instruction.to, self.table(instruction))
        })
    }

    /// Whether an operation reads this slot, or the slot is an output.
    pub fn reads(&self, slot: usize) -> bool {
        let is_it = |read: &u16| usize::from(*read) == slot;
        self.operations().any(|(_, operands, ..)| operands.iter().any(is_it))
            || self.outputs.iter().any(is_it)
    }

    /// Returns the origin of the first operation that makes an output infinite or undefined in the last evaluation, and
    /// whether it divides by 0; `None` if all outputs are finite.
    pub fn not_finite(&self, slots: &[f64]) -> Option<(&Origin, bool)> {
        let value = |slot: u16| slots[slot as usize];
        let mut slot = *self.outputs.iter().find(|&&slot| !value(slot).is_finite())?;
        loop {
            let (op, operands, ..) = self.operations().find(|(_, _, to, _)| *to == slot)?;
            // The untaken branch of a choice does not matter.
            let taken =
                |n: &usize| op != Op::If || *n == if value(operands[0]) == 1.0 { 1 } else { 2 };
            let mut rows = (0..operands.len()).filter(taken).map(|n| operands[n]);
            let operand = rows.find(|operand| !value(*operand).is_finite());
            if let Some(operand) = operand.filter(|operand| self.origins.contains_key(operand)) {
                slot = operand;
                continue;
            }
            return Some((self.origins.get(&slot)?, op == Op::Divide && value(operands[1]) == 0.0));
        }
    }

    fn table(&self, instruction: &Instruction) -> Option<&Curve> {
        instruction.op.is_table().then(|| &self.tables[instruction.table as usize])
    }

    #[inline]
    fn run(
        &self,
        slots: &mut [f64],
        switched: impl FnMut(Switch, f64, f64, Option<&Curve>) -> f64,
    ) {
        self.run_lanes::<1>(&self.main, slots.as_chunks_mut().0, &[], switched);
    }

    /// Evaluates instructions on `W` motions at once. Each motion has the same bits as alone. If `alike` is set for a
    /// slot, all motions have the same value there, so that a function is called only once.
    #[inline(always)]
    fn run_lanes<const W: usize>(
        &self,
        instructions: &[Instruction],
        slots: &mut [[f64; W]],
        alike: &[bool],
        mut switched: impl FnMut(Switch, f64, f64, Option<&Curve>) -> f64,
    ) {
        for instruction in instructions {
            let [a, b, c] = from_fn(|n| &slots[instruction.operands[n] as usize]);
            let to = instruction.to as usize;
            let is_alike = alike.get(to).copied().unwrap_or(false);
            let called = |value: fn(f64, f64) -> f64| {
                if is_alike { [value(a[0], b[0]); W] } else { from_fn(|i| value(a[i], b[i])) }
            };
            let value = match instruction.op {
                Op::Negate => from_fn(|i| -a[i]),
                Op::Add => from_fn(|i| a[i] + b[i]),
                Op::Subtract => from_fn(|i| a[i] - b[i]),
                Op::Multiply | Op::And => from_fn(|i| a[i] * b[i]),
                Op::Divide => from_fn(|i| a[i] / b[i]),
                Op::Power => called(libm::pow),
                Op::Or => from_fn(|i| f64::from(u8::from(a[i] + b[i] > 0.0))),
                Op::Not => from_fn(|i| 1.0 - a[i]),
                Op::If => from_fn(|i| if a[i] == 1.0 { b[i] } else { c[i] }),
                Op::Smooth(smooth) => called(smooth.value),
                Op::Switch(switch) => {
                    let table = self.table(instruction);
                    from_fn(|i| switched(switch, a[i], b[i], table))
                }
                // A tape has no calls, and its caller writes these slots.
                Op::Number | Op::Input | Op::Call | Op::Apply | Op::Argument | Op::Element => {
                    slots[to]
                }
            };
            slots[to] = value;
        }
    }
}

fn jet(op: Op, [a, b, c]: [Jet; 3], table: Option<&Curve>) -> Jet {
    match op {
        // These values are in their slots already, and a tape has no calls.
        Op::Number | Op::Input | Op::Call | Op::Apply | Op::Argument | Op::Element => a,
        Op::Negate => a.map(|x| -x),
        Op::Add => jet::sum(a, b),
        Op::Subtract => jet::difference(a, b),
        Op::Multiply => jet::product(a, b),
        Op::Divide => jet::quotient(a, b),
        Op::Power => jet::pow(a, b),
        Op::And => jet::constant(a[0] * b[0]),
        Op::Or => jet::constant(f64::from(u8::from(a[0] + b[0] > 0.0))),
        Op::Not => jet::constant(1.0 - a[0]),
        Op::If if a[0] == 1.0 => b,
        Op::If => c,
        Op::Smooth(smooth) => (smooth.jet)(a, b),
        Op::Switch(switch) => switch.jet([a, b], table),
    }
}

/// Returns, for each node, whether the value of the expression depends on it.
fn used(expression: &Expression) -> Vec<bool> {
    let mut used = vec![false; expression.nodes.len()];
    if let Some(last) = used.last_mut() {
        *last = true;
    }
    for (n, node) in expression.nodes.iter().enumerate().rev() {
        if used[n] {
            node.arguments().iter().for_each(|&argument| used[argument] = true);
        }
    }
    used
}
