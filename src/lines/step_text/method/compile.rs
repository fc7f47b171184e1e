//! Compiles lines to actions on the slots of numbers.

use std::slice::Iter;

use super::{Act, Array, Function, General, Machine, StepCall};
use crate::expression::Expression;
use crate::op::Op;
use crate::step_text::{Line, V, X};
use crate::tape::MAX_OPERATIONS;

impl Machine {
    /// Compiles lines with this number of names; `None` if they have more than [`MAX_OPERATIONS`] operations.
    pub(in crate::step_text) fn new(
        names: usize,
        lines: &[Line],
        functions: &[Function],
        arrays: &[Array],
    ) -> Option<Self> {
        let machine = Self { slots: names, levels: 1, ..Self::default() };
        let mut compiler = Compiler { machine, functions, level: 0, repeats: 0 };
        let slots: Vec<usize> = (0..names).collect();
        let (acts, _) = compiler.block(&mut lines.iter(), &slots, X)?;
        let mut machine = compiler.machine;
        for array in arrays {
            machine.arrays.push([machine.slots, array.size]);
            machine.slots += array.size;
        }
        Some(Self { acts, ..machine })
    }
}

struct Compiler<'c> {
    machine: Machine,
    functions: &'c [Function],
    level: usize,
    /// The number of loops and functions around the current line.
    repeats: usize,
}

impl Compiler<'_> {
    fn slot(&mut self) -> usize {
        self.machine.slots += 1;
        self.machine.slots - 1
    }

    fn number(&mut self, value: f64) -> usize {
        let slot = self.slot();
        self.machine.numbers.push((slot, value));
        slot
    }

    /// Compiles a part that has a level of its own.
    fn deeper<T>(&mut self, repeats: bool, part: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        self.level += 1;
        self.repeats += usize::from(repeats);
        self.machine.levels = self.machine.levels.max(self.level + 1);
        let compiled = part(self);
        self.level -= 1;
        self.repeats -= usize::from(repeats);
        compiled
    }

    /// Compiles the lines up to the end of their block. Returns the actions, and whether an `else` ended the block. The
    /// slots are those of the names; a function returns its value in the slot `result`.
    fn block(
        &mut self,
        lines: &mut Iter<'_, Line>,
        slots: &[usize],
        result: usize,
    ) -> Option<(Vec<Act>, bool)> {
        let mut acts = Vec::new();
        while let Some(line) = lines.next() {
            match line {
                Line::End => return Some((acts, false)),
                Line::Else => return Some((acts, true)),
                Line::Assign { name, joins, value, .. } => {
                    let mut from = self.expression(value, slots, &mut acts)?;
                    let op = match *joins {
                        "+" => Some(Op::Add),
                        "-" => Some(Op::Subtract),
                        "*" => Some(Op::Multiply),
                        "/" => Some(Op::Divide),
                        _ => None,
                    };
                    if let Some(op) = op {
                        let to = self.slot();
                        let operands = [slots[*name], from, 0];
                        acts.push(Act::Compute { op, to, from: operands, table: 0 });
                        from = to;
                    }
                    acts.push(Act::Set { to: slots[*name], from });
                }
                Line::If(condition) => {
                    let condition = self.expression(condition, slots, &mut acts)?;
                    let [yes, no] = self.deeper(false, |inner| {
                        let (yes, has_else) = inner.block(lines, slots, result)?;
                        let no = match has_else {
                            true => inner.block(lines, slots, result)?.0,
                            false => Vec::new(),
                        };
                        Some([yes, no])
                    })?;
                    acts.push(Act::If { condition, yes, no });
                }
                Line::While(condition) => {
                    let mut test = Vec::new();
                    let (condition, body) = self.deeper(true, |inner| {
                        let condition = inner.expression(condition, slots, &mut test)?;
                        Some((condition, inner.block(lines, slots, result)?.0))
                    })?;
                    acts.push(Act::While { test, condition, body });
                }
                Line::Remark(_) | Line::Blank => {}
                Line::Store { array, index, value } => {
                    let index = self.expression(index, slots, &mut acts)?;
                    let from = self.expression(value, slots, &mut acts)?;
                    acts.push(Act::Store { array: *array, index, from });
                }
                Line::Return(value) => {
                    let from = self.expression(value, slots, &mut acts)?;
                    acts.extend([Act::Set { to: result, from }, Act::Leave]);
                }
                Line::Stop { fails } => {
                    if *fails {
                        let from = self.number(f64::NAN);
                        acts.extend([X, V].map(|to| Act::Set { to, from }));
                    }
                    acts.push(Act::Leave);
                }
            }
        }
        Some((acts, false))
    }

    /// Compiles an expression, and returns the slot of its value.
    fn expression(
        &mut self,
        expression: &Expression,
        slots: &[usize],
        acts: &mut Vec<Act>,
    ) -> Option<usize> {
        let tables = self.machine.tables.len();
        self.machine.tables.extend(expression.tables.iter().cloned());
        let mut found: Vec<usize> = Vec::with_capacity(expression.nodes.len());
        for node in &expression.nodes {
            let operand = |n: usize| node.arguments().get(n).map_or(0, |at| found[*at]);
            let from = [operand(0), operand(1), operand(2)];
            found.push(match node.op {
                Op::Number => self.number(node.number),
                Op::Input => slots[node.index],
                // The value of an argument, which is its last operand.
                Op::Argument => from[node.arguments().len() - 1],
                Op::Call => {
                    let time = if node.arguments().len() > 2 { from[2] } else { from[0] };
                    self.call(None, from[..2].to_vec(), time, acts)
                }
                Op::Element => {
                    let to = self.slot();
                    acts.push(Act::Load { to, array: node.index, index: from[0] });
                    to
                }
                Op::Apply => {
                    let mut arguments = Vec::new();
                    let mut next = node.arguments().first().copied();
                    while let Some(at) = next {
                        arguments.push(found[at]);
                        let before = expression.nodes[at].arguments();
                        next = (before.len() > 1).then(|| before[0]);
                    }
                    arguments.reverse();
                    self.function(node.index, arguments, acts)?
                }
                op => {
                    let to = self.slot();
                    acts.push(Act::Compute { op, to, from, table: tables + node.index });
                    to
                }
            });
            if self.machine.slots > MAX_OPERATIONS {
                return None;
            }
        }
        found.last().copied()
    }

    /// Compiles a request, and returns the slot of its value.
    fn call(
        &mut self,
        general: Option<General>,
        from: Vec<usize>,
        time: usize,
        acts: &mut Vec<Act>,
    ) -> usize {
        let (to, index) = (self.slot(), self.machine.calls.len());
        let is_repeated = self.repeats > 0 || general == Some(General::Slope);
        self.machine.calls.push(StepCall { part: f64::NAN, is_repeated });
        self.machine.generals.extend(general);
        acts.push(Act::Call { general, from, time, to, index });
        to
    }

    /// Compiles a call of a function, and returns the slot of its value.
    fn function(
        &mut self,
        index: usize,
        mut slots: Vec<usize>,
        acts: &mut Vec<Act>,
    ) -> Option<usize> {
        let Function { names, lines, general, .. } = &self.functions[index];
        if general.is_some() {
            let time = slots[0];
            return Some(self.call(*general, slots, time, acts));
        }
        while slots.len() < names.len() {
            slots.push(self.slot());
        }
        let result = self.slot();
        let (body, _) =
            self.deeper(true, |inner| inner.block(&mut lines.iter(), &slots, result))?;
        acts.push(Act::Function(body));
        Some(result)
    }
}
