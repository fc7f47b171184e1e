//! Translates the statements of a step to operations, and finds the current value of each name that is read.

use std::ops::Range;
use std::slice;

pub(super) use frames::{COST, COUNT, FIRST, FRAME_NAMES, LENGTH, NOW, REFRESH, SECOND, SHOWN};
use functions::end_of;
pub(super) use spin::SPIN_NAMES;
use values::CONSTANTS;

use super::method::{Array, Function as OwnFunction, Machine, Taken};
use super::names::{meant, other_lengths};
use super::paths::{SMOOTH_DAMP, damped_velocity};
use super::statements::{Declares, Statement};
use super::{BUILT_IN, Carried, H, Line, StepText, TARGET, V, X};
use crate::expression::{Expression, Node, Scope, parse, parse_condition};
use crate::fault::{ExpressionFault, Parsed, Remedy, fault, quoted};
use crate::function::Function;
use crate::op::Op;
use crate::tape::{MAX_OPERATIONS, MAX_SWITCHES, Tape};
use crate::token::is_name_part;

mod assignment;
mod declared;
mod frames;
mod functions;
mod spin;
mod values;
mod winding;

/// The maximum number of names of a text. It is so small that the bits of one word can represent a set of names.
const MAX_STEP_NAMES: usize = 64;

/// The deepest nesting of blocks.
const MAX_BLOCKS: usize = 32;

/// Names for the call of the acceleration.
const ACCELERATION: [&str; 3] = ["a", "accel", "acceleration"];

/// The prefix of a field of `memory` after both are joined into one name.
pub(super) const FIELD: &str = "memory_";

/// The node of each name's current value.
type Values = Vec<Option<usize>>;

/// An open block.
struct Block {
    condition: usize,
    before: Values,
    /// The values at the end of the first branch, while the second branch is open.
    first: Option<Values>,
    is_loop: bool,
    /// Whether the block ends with the block around it, as an `else if` does.
    is_chained: bool,
}

/// Consumes the statements of a text, one by one.
pub(super) struct Reader<'t> {
    text: &'t str,
    /// The words that mean `x`, `v` and `target`.
    meant: Vec<(usize, String)>,
    /// The names of the length of a step that are those of other numbers here.
    other_lengths: Vec<&'static str>,
    names: Vec<String>,
    /// For each name, whether it may be read before a line assigns it.
    is_carried: Vec<bool>,
    starts: Vec<f64>,
    lines: Vec<Line>,
    /// The operations of all lines. The node of an input is the number before the step.
    nodes: Expression,
    values: Values,
    carried: Vec<usize>,
    blocks: Vec<Block>,
    /// The first call of the acceleration or setting of a body, which makes the lines a method.
    method_at: Option<Range<usize>>,
    inputs: Vec<Taken>,
    takes_target: bool,
    functions: Vec<OwnFunction>,
    /// Whether the lines are those of a function.
    is_function: bool,
    /// Remarks above the inputs, and above what the reader has not reached.
    notes: Vec<String>,
    remarks: Vec<String>,
    /// Whether a line of the step itself was read.
    has_begun: bool,
    reads_velocity: bool,
    /// Whether the lines are those of a game loop, and its arrays.
    is_loop: bool,
    arrays: Vec<Array>,
    /// Whether the value of `SmoothDamp` is the velocity that it leaves.
    damps_velocity: bool,
}

/// The remedy for a loop in a rule.
const NO_LOOPS: &str = "write the lines of one step, which has no loops; an angle is wrapped by \
    `wrap(x, -pi, pi)`, and the way to another is `angle_difference(x, target)`";

/// The place that `SmoothDamp` leaves, until the velocity is assigned.
const DAMPED_PLACE: &str = "damped_place";

/// Returns the byte range of the name in the first call of the acceleration.
fn first_call(text: &str) -> Option<Range<usize>> {
    let name = |at: usize| {
        let is_part = |byte: &u8| is_name_part(*byte);
        let before = at.checked_sub(1).and_then(|before| text.as_bytes().get(before));
        if before.is_some_and(|byte| is_part(byte) || *byte == b'.') {
            return None;
        }
        let length = text.as_bytes()[at..].iter().take_while(|byte| is_part(byte)).count();
        let is_called = text[at + length..].trim_start_matches([' ', '\t']).starts_with('(');
        let span = at..at + length;
        (is_called && ACCELERATION.contains(&&text[span.clone()])).then_some(span)
    };
    text.match_indices('a').find_map(|(at, _)| name(at))
}

impl Scope for Reader<'_> {
    fn input(&self, name: &str) -> Option<usize> {
        let index = self.index(name).filter(|index| self.may_read(*index))?;
        (self.is_carried[index] || self.values[index].is_some()).then_some(index)
    }

    fn names(&self) -> Vec<String> {
        self.names.iter().filter(|name| !name.contains(' ')).cloned().collect()
    }

    fn why_not(&self, name: &str) -> Option<String> {
        let is_target = self.index(name).is_some_and(|index| !self.may_read(index));
        is_target.then(|| "a method moves by `a(x, v)`, and has no target".to_owned())
    }

    fn constant(&self, name: &str) -> Option<f64> {
        CONSTANTS.iter().find(|(names, _)| names.contains(&name)).map(|(_, value)| *value)
    }

    fn own_function(&self, name: &str) -> Option<(usize, Vec<bool>)> {
        let index = self.functions.iter().rposition(|function| function.name == name)?;
        Some((index, self.functions[index].inputs.clone()))
    }

    fn array(&self, name: &str) -> Option<usize> {
        self.arrays.iter().position(|array| array.name == name)
    }

    fn is_acceleration(&self, name: &str) -> bool {
        !self.is_loop && ACCELERATION.contains(&name)
    }

    fn function(&self, name: &str) -> Option<&'static Function> {
        let found = Function::named_in_steps(name)?;
        let velocity = self.damps_velocity && found.name == SMOOTH_DAMP;
        if velocity { Function::named_in_functions("smoothDampVelocity") } else { Some(found) }
    }

    fn overload(&self, name: &str, count: usize) -> Option<&'static Function> {
        Function::with_arguments(self.function(name)?.name, count)
    }

    fn is_step(&self) -> bool {
        true
    }
}

impl<'t> Reader<'t> {
    /// Reads a text, which is a method if `method_at` is given or a line calls the acceleration.
    pub(super) fn read(
        text: &'t str,
        method_at: Option<Range<usize>>,
        all: &[Statement],
    ) -> Parsed<StepText> {
        let mut reader = Self::new(text, method_at.or_else(|| first_call(text)), Vec::new());
        reader.names = BUILT_IN.map(String::from).to_vec();
        let is_rule = !reader.is_method();
        (reader.meant, reader.other_lengths) = (meant(text), other_lengths(text, is_rule));
        reader.is_carried = vec![true; BUILT_IN.len()];
        reader.starts = vec![0.0; BUILT_IN.len()];
        reader.values = vec![None; BUILT_IN.len()];
        reader.carried = vec![X, V];
        reader.read_inputs(all)?;
        reader.read_all(all)?;
        reader.finish()
    }

    fn read_inputs(&mut self, all: &[Statement]) -> Parsed<()> {
        for statement in all {
            match statement {
                Statement::Takes(input) if self.is_loop => self.take_whole(input.clone())?,
                Statement::Takes(input) => self.take(input.clone())?,
                _ => {}
            }
        }
        Ok(())
    }

    fn new(text: &'t str, method_at: Option<Range<usize>>, functions: Vec<OwnFunction>) -> Self {
        Reader {
            text,
            meant: Vec::new(),
            other_lengths: Vec::new(),
            names: Vec::new(),
            is_carried: Vec::new(),
            starts: Vec::new(),
            lines: Vec::new(),
            nodes: Expression::default(),
            values: Vec::new(),
            carried: Vec::new(),
            blocks: Vec::new(),
            method_at,
            inputs: Vec::new(),
            takes_target: false,
            functions,
            is_function: false,
            notes: Vec::new(),
            remarks: Vec::new(),
            has_begun: false,
            reads_velocity: false,
            is_loop: false,
            arrays: Vec::new(),
            damps_velocity: false,
        }
    }

    /// Reads statements in order, after declaring all names that they assign.
    fn read_all(&mut self, all: &[Statement]) -> Parsed<()> {
        let mut at = 0;
        while let Some(statement) = all.get(at) {
            match statement {
                Statement::Assign { name, declares, value, .. } => {
                    let is_carried = declares.is_none() && !self.is_function;
                    self.declare(name.clone(), is_carried, false)?;
                    if let Some(velocity) = damped_velocity(self.text, value) {
                        self.declare(velocity, is_carried, false)?;
                        if self.index(DAMPED_PLACE).is_none() {
                            self.add_name(DAMPED_PLACE, false);
                        }
                    }
                }
                Statement::Memory { name, .. } => self.declare(name.clone(), true, true)?,
                Statement::Array { name, size, value } => {
                    self.add_array(name.clone(), size.clone(), value.clone())?;
                }
                Statement::Function { .. } => at = end_of(all, at),
                _ => {}
            }
            at += 1;
        }
        let mut at = 0;
        while let Some(statement) = all.get(at) {
            if let Statement::Function { name, inputs } = statement {
                let end = end_of(all, at);
                self.read_function(name.clone(), inputs.clone(), all, at + 1..end)?;
                at = end;
            } else if !self.read_winding(&all[at..])? {
                self.read_statement(statement.clone())?;
            } else {
                at += 2;
            }
            at += 1;
        }
        Ok(())
    }

    fn is_method(&self) -> bool {
        self.method_at.is_some()
    }

    /// Whether the lines may read an input that has a value.
    fn may_read(&self, index: usize) -> bool {
        let is_free = self.is_function || self.is_loop || !self.is_method();
        is_free || index != TARGET || self.takes_target
    }

    /// Consumes the next statement.
    pub(super) fn read_statement(&mut self, statement: Statement) -> Parsed<()> {
        if !self.has_begun {
            match statement {
                Statement::Blank => return Ok(()),
                Statement::Remark(text) => {
                    self.remarks.push(text);
                    return Ok(());
                }
                Statement::Takes(_) => self.notes.append(&mut self.remarks),
                Statement::Memory { .. } | Statement::Use(_) => {}
                _ => {
                    self.has_begun = true;
                    self.lines.extend(self.remarks.drain(..).map(Line::Remark));
                }
            }
        }
        match statement {
            Statement::Remark(text) => {
                self.lines.push(Line::Remark(text));
                Ok(())
            }
            Statement::Blank => {
                self.lines.push(Line::Blank);
                Ok(())
            }
            Statement::Assign { name, joins, value, declares } => {
                self.read_assignment(name, (joins, declares), value)
            }
            Statement::Memory { name, value } => {
                // A memory may start as NaN, which equals no step length, so that the lines can recognise the first
                // step.
                let start = match self.text[value.clone()].trim() {
                    "nan" => f64::NAN,
                    _ => self.constant_value(&self.expression(value.clone(), false)?, value)?,
                };
                let index = self.index(&self.declared(name, true)).unwrap_or(X);
                self.starts[index] = start;
                // A game may draw a number that the lines only write.
                if self.is_method() && !self.carried.contains(&index) {
                    self.carried.push(index);
                }
                Ok(())
            }
            Statement::If(condition) => self.open(condition, false),
            Statement::While(word, condition) => {
                self.expect_method(&word, NO_LOOPS)?;
                self.open_loop(condition)
            }
            Statement::Return { word, value } => {
                if !self.is_function {
                    let what = "`return` cannot stand in a step";
                    let remedy = match self.is_method() {
                        true => "assign `x` and `v` in its place, or write `stay`",
                        false => "put the lines after it into the block of the opposite condition",
                    };
                    return fault(word, what, remedy);
                }
                let value = self.expression(value, false)?;
                self.note_reads(&value);
                self.lines.push(Line::Return(value));
                Ok(())
            }
            Statement::Stop(word, fails) => {
                self.expect_method(&word, "write the lines in an `if` of the opposite")?;
                if self.is_function {
                    return fault(word, "a function cannot end the step", "return `nan`");
                }
                self.lines.push(Line::Stop { fails });
                Ok(())
            }
            statement @ (Statement::Store { .. }
            | Statement::Tick { .. }
            | Statement::Show { .. }
            | Statement::Array { .. }) => self.read_frame_statement(statement),
            Statement::Head { at, .. } => {
                fault(at, "a function cannot stand here", "write the lines inside the function")
            }
            Statement::Takes(_) | Statement::Function { .. } => Ok(()),
            Statement::Use(name) => self.use_shared(name),
            Statement::Else(condition, brace) => {
                let open = self.blocks.last_mut();
                let Some(block) = open.filter(|block| block.first.is_none() && !block.is_loop)
                else {
                    return fault(brace, "`else` follows no block of an `if`", "remove it");
                };
                block.first = Some(std::mem::replace(&mut self.values, block.before.clone()));
                self.lines.push(Line::Else);
                match condition {
                    Some(condition) => self.open(condition, true),
                    None => Ok(()),
                }
            }
            Statement::End(brace) => loop {
                let Some(block) = self.blocks.pop() else {
                    return fault(brace, "`}` closes nothing", "remove it, or open it before");
                };
                let is_chained = block.is_chained;
                self.close(block, &brace);
                self.lines.push(Line::End);
                if !is_chained {
                    return self.check_length(brace);
                }
            },
        }
    }

    fn read_assignment(
        &mut self,
        name: Range<usize>,
        joins: (&'static str, Option<Declares>),
        value: Range<usize>,
    ) -> Parsed<()> {
        // A game declares the initial value of `x` or `v` above the lines of its frames.
        let index = self.index(&self.text[name.clone()]);
        let index = index.filter(|index| *index <= V && !self.is_function);
        let is_first = index.is_some_and(|index| self.values[index].is_none());
        let start = match joins.1.is_some() && is_first && self.blocks.is_empty() {
            true => {
                self.constant_value(&self.expression(value.clone(), false)?, value.clone()).ok()
            }
            false => None,
        };
        match (index.zip(start), damped_velocity(self.text, &value)) {
            (Some((index, start)), _) => self.starts[index] = start,
            (None, Some(velocity)) => self.assign_damped(name, joins.0, value, velocity)?,
            (None, None) => {
                let expression = self.expression(value.clone(), false)?;
                let index = self.index(&self.text[name.clone()]).unwrap_or(X);
                self.assign(index, name, joins, expression, value)?;
            }
        }
        Ok(())
    }

    /// Reads an expression or a condition.
    fn expression(&self, span: Range<usize>, is_condition: bool) -> Parsed<Expression> {
        let text = &self.text[span.clone()];
        let read = if is_condition { parse_condition(text, self) } else { parse(text, self) };
        let in_text = |found: ExpressionFault| {
            let at = found.span.start + span.start..found.span.end + span.start;
            let is_call = self.text[at.end..].trim_start().starts_with('(');
            let known = match (self.is_loop, self.is_method()) {
                (true, _) => "dt, H, second, refresh, cost, now or first",
                (false, true) => "x, v or h",
                (false, false) => "x, v, h or target",
            };
            let remedy = match found.remedy {
                Remedy::Name { written, .. } if !is_call => Remedy::Words(format!(
                    "write {known}, or give it a value before: `let {} = 1`",
                    quoted(&written)
                )),
                remedy => remedy,
            };
            ExpressionFault { span: at, remedy, ..found }
        };
        let mut read = read.map_err(in_text)?;
        for place in &mut read.spans {
            *place = place.start + span.start..place.end + span.start;
        }
        Ok(read)
    }

    /// Returns the value of an expression made only of numbers.
    fn constant_value(&self, expression: &Expression, span: Range<usize>) -> Parsed<f64> {
        let reads = |node: &Node| matches!(node.op, Op::Input | Op::Call | Op::Apply);
        let reads = expression.nodes.iter().any(reads);
        let tape = || Tape::new(0, |_| false, slice::from_ref(expression)).ok();
        let value = (!reads).then(tape).flatten().map(|tape| {
            let mut slots = vec![0.0; tape.slots];
            tape.prepare::<1>(slots.as_chunks_mut().0);
            tape.evaluate(&mut slots);
            slots[usize::from(tape.outputs[0])]
        });
        value.filter(|value| value.is_finite()).map_or_else(
            || fault(span, "a memory starts as a finite number", "write one, such as `0`"),
            Ok,
        )
    }

    fn open(&mut self, condition: Range<usize>, is_chained: bool) -> Parsed<()> {
        if self.blocks.len() == MAX_BLOCKS {
            let what = format!("the blocks are nested more than {MAX_BLOCKS} deep");
            return fault(condition, what, "use fewer");
        }
        let expression = self.expression(condition.clone(), true)?;
        let node = match self.is_method() {
            true => {
                self.note_reads(&expression);
                0
            }
            false => self.splice(&expression),
        };
        let before = self.values.clone();
        self.blocks.push(Block {
            condition: node,
            before,
            first: None,
            is_loop: false,
            is_chained,
        });
        self.lines.push(Line::If(expression));
        Ok(())
    }

    fn open_loop(&mut self, condition: Range<usize>) -> Parsed<()> {
        self.open(condition, false)?;
        if let (Some(block), Some(Line::If(condition))) = (self.blocks.last_mut(), self.lines.pop())
        {
            block.is_loop = true;
            self.lines.push(Line::While(condition));
        }
        Ok(())
    }

    /// Returns the parsed lines, after all statements.
    pub(super) fn finish(mut self) -> Parsed<StepText> {
        if !self.blocks.is_empty() {
            let end = self.text.trim_end().len();
            let last = self.text.floor_char_boundary(end.saturating_sub(1));
            return fault(last..end, "a block is not closed", "write `}` at its end");
        }
        let last = 0..self.text.len();
        let assigns = |line: &Line| matches!(line, Line::Assign { name: X | V, .. });
        if !self.lines.iter().any(assigns) {
            if self.is_loop {
                return fault(last, "no line makes a tick", "write `tick 1`, or `tick 1 of dt`");
            }
            let remedy = "write `x` for the position and `v` for its velocity: `x += v * dt`";
            return fault(last, "no line assigns `x` or `v`", remedy);
        }
        let mut carried = self.carried.clone();
        carried.sort_unstable();
        let is_rule = !self.is_method();
        let ends = carried.iter().filter(|_| is_rule);
        let outputs: Vec<usize> = ends.map(|index| self.value(*index, &last)).collect();
        let whole = |node: usize| Expression {
            nodes: self.nodes.nodes[..=node].to_vec(),
            spans: self.nodes.spans[..=node].to_vec(),
            tables: self.nodes.tables.clone(),
        };
        let expressions: Vec<Expression> = outputs.into_iter().map(whole).collect();
        let tape = Tape::new(self.names.len(), |input| input == H, &expressions).or_else(
            |long| match long.are_switches {
                true => too_long(last.clone(), "corners and jumps", MAX_SWITCHES),
                false => too_long(last.clone(), "operations", MAX_OPERATIONS),
            },
        )?;
        let machine = match is_rule {
            true => Some(Machine::default()),
            false => Machine::new(self.names.len(), &self.lines, &self.functions, &self.arrays),
        };
        let machine = machine.map_or_else(|| too_long(last, "operations", MAX_OPERATIONS), Ok)?;
        let named = |input: usize| Carried {
            name: self.names[input].clone(),
            start: self.starts[input],
            input,
        };
        let carried = carried.into_iter().map(named).collect();
        let Reader { names, lines, method_at, inputs, functions, arrays, .. } = self;
        let Reader { notes, reads_velocity, .. } = self;
        Ok(StepText {
            source: String::new(),
            names,
            lines,
            carried,
            tape,
            method_at,
            inputs,
            functions,
            arrays,
            notes,
            reads_velocity,
            machine,
            left_out: None,
        })
    }
}

fn too_long<T>(at: Range<usize>, noun: &str, most: usize) -> Parsed<T> {
    fault(at, format!("the lines have more than {most} {noun}"), "write fewer")
}
