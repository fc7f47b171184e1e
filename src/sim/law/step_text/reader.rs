//! Translates the statements of a step to operations, and finds the current value of each name that is read.

use std::ops::Range;

use super::paths::{SMOOTH_DAMP, damped_velocity};
use super::statements::Statement;
use super::{
    BUILT_IN, Carried, H, Line, OTHER_NAMES, STEP_NAMES, StepCall, StepText, TARGET, V, X,
};
use crate::sim::law::expression::{Expression, Node, Scope, parse, parse_condition};
use crate::sim::law::fault::{ExpressionFault, Parsed, Part, Remedy, fault, quoted};
use crate::sim::law::function::Function;
use crate::sim::law::op::{OPERATOR_WORDS, Op};
use crate::sim::law::tape::{MAX_OPERATIONS, MAX_SWITCHES, Tape};
use crate::sim::law::token::is_name_part;

/// The maximum number of names of a text. It is so small that the bits of one word can represent a set of names.
const MAX_STEP_NAMES: usize = 64;

/// The deepest nesting of blocks.
const MAX_BLOCKS: usize = 32;

/// The maximum number of calls of the acceleration in a step.
const MAX_CALLS: usize = 64;

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
    /// The guard of the lines around the block.
    outside: Option<usize>,
    /// Whether the block ends with the block around it, as an `else if` does.
    is_chained: bool,
}

/// Consumes the statements of a text, one by one.
pub(super) struct Reader<'t> {
    text: &'t str,
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
    /// The first call of the acceleration, which makes the lines a method.
    call: Option<Range<usize>>,
    /// The nodes of the calls, and of their times.
    calls: Vec<[usize; 2]>,
    /// In a method, the node that tells whether the current lines run.
    guard: Option<usize>,
    /// Whether the value of `SmoothDamp` is the velocity that it leaves.
    damps_velocity: bool,
}

/// The place that `SmoothDamp` leaves, until the velocity is assigned.
const DAMPED_PLACE: &str = "damped_place";

/// Whether a text has this word.
fn has_word(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|found| found == word)
}

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
        let index = self.index(name).filter(|index| *index != TARGET || self.call.is_none())?;
        (self.is_carried[index] || self.values[index].is_some()).then_some(index)
    }

    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn why_not(&self, name: &str) -> Option<String> {
        let is_target = self.call.is_some() && self.index(name) == Some(TARGET);
        is_target.then(|| "a method moves by `a(x, v)`, and has no target".to_owned())
    }

    fn is_acceleration(&self, name: &str) -> bool {
        ACCELERATION.contains(&name)
    }

    fn function(&self, name: &str) -> Option<&'static Function> {
        let found = Function::named_in_steps(name)?;
        let velocity = self.damps_velocity && found.name == SMOOTH_DAMP;
        if velocity { Function::named_in_steps("smoothDampVelocity") } else { Some(found) }
    }

    fn overload(&self, name: &str, count: usize) -> Option<&'static Function> {
        Function::with_arguments(self.function(name)?.name, count)
    }

    fn is_step(&self) -> bool {
        true
    }
}

impl<'t> Reader<'t> {
    /// Returns a reader that already knows the names that the text assigns.
    pub(super) fn new(text: &'t str, statements: &[Statement]) -> Parsed<Self> {
        let mut reader = Reader {
            text,
            names: BUILT_IN.map(String::from).to_vec(),
            is_carried: vec![true; BUILT_IN.len()],
            starts: vec![0.0; BUILT_IN.len()],
            lines: Vec::new(),
            nodes: Expression::default(),
            values: vec![None; BUILT_IN.len()],
            carried: vec![X, V],
            blocks: Vec::new(),
            call: first_call(text),
            calls: Vec::new(),
            guard: None,
            damps_velocity: false,
        };
        for statement in statements.iter().cloned() {
            match statement {
                Statement::Assign { name, is_declared, value, .. } => {
                    reader.declare(name, !is_declared, false)?;
                    if let Some(velocity) = damped_velocity(text, &value) {
                        reader.declare(velocity, true, false)?;
                        if reader.index(DAMPED_PLACE).is_none() {
                            reader.add_name(DAMPED_PLACE, false);
                        }
                    }
                }
                Statement::Memory { name, .. } => reader.declare(name, true, true)?,
                _ => {}
            }
        }
        Ok(reader)
    }

    fn index(&self, name: &str) -> Option<usize> {
        if STEP_NAMES.contains(&name) {
            return Some(H);
        }
        let other = OTHER_NAMES
            .iter()
            .find(|(index, names)| names.contains(&name) && !has_word(self.text, BUILT_IN[*index]));
        let known = || self.names.iter().position(|known| known == name);
        other.map(|(index, _)| *index).or_else(known)
    }

    /// Returns the name that a statement declares. If the lines read a memory as `memory.name`, the name includes that
    /// prefix.
    fn declared(&self, span: Range<usize>, is_memory: bool) -> String {
        let name = &self.text[span];
        let field = format!("{FIELD}{name}");
        if is_memory && self.text.contains(&field) { field } else { name.to_owned() }
    }

    fn declare(&mut self, span: Range<usize>, is_carried: bool, is_memory: bool) -> Parsed<()> {
        let name = &*self.declared(span.clone(), is_memory);
        let is_word = OPERATOR_WORDS.contains(&name) || name == "pi";
        if is_word || Function::is_reserved(name) {
            let what = format!("`{}` has a meaning of its own in expressions", quoted(name));
            return fault(span, what, "give it another name");
        }
        match self.index(name) {
            Some(TARGET) => {
                let remedy = "give the number another name, such as `goal`";
                return fault(
                    span,
                    "`target` is the goal of `x`, and no line may change it",
                    remedy,
                );
            }
            Some(index) => self.is_carried[index] |= is_carried,
            None if self.names.len() == MAX_STEP_NAMES => {
                let what = format!("the lines have more than {} names", MAX_STEP_NAMES - 4);
                return fault(span, what, "use fewer");
            }
            None => self.add_name(name, is_carried),
        }
        Ok(())
    }

    fn add_name(&mut self, name: &str, is_carried: bool) {
        self.names.push(name.to_owned());
        self.is_carried.push(is_carried);
        self.starts.push(0.0);
        self.values.push(None);
    }

    /// Consumes the next statement.
    pub(super) fn read_statement(&mut self, statement: Statement) -> Parsed<()> {
        match statement {
            Statement::Assign { name, joins, value, is_declared } => {
                // A game declares the initial value of `x` or `v` above the lines of its frames.
                let index = self.index(&self.text[name.clone()]).filter(|index| *index <= V);
                let is_first = index.is_some_and(|index| self.values[index].is_none());
                let start = match is_declared && is_first && self.blocks.is_empty() {
                    true => self
                        .constant_value(&self.expression(value.clone(), false)?, value.clone())
                        .ok(),
                    false => None,
                };
                match (index.zip(start), damped_velocity(self.text, &value)) {
                    (Some((index, start)), _) => self.starts[index] = start,
                    (None, Some(velocity)) => self.assign_damped(name, joins, value, velocity)?,
                    (None, None) => {
                        let expression = self.expression(value.clone(), false)?;
                        let index = self.index(&self.text[name.clone()]).unwrap_or(X);
                        self.assign(index, name, joins, expression, value)?;
                    }
                }
                Ok(())
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
                Ok(())
            }
            Statement::If(condition) => self.open(condition, false),
            Statement::Else(condition, brace) => {
                let Some(block) = self.blocks.last_mut().filter(|block| block.first.is_none())
                else {
                    return fault(brace, "`else` follows no block of an `if`", "remove it");
                };
                block.first = Some(std::mem::replace(&mut self.values, block.before.clone()));
                let (taken, outside) = (block.condition, block.outside);
                let not = self.push(Node::new(Op::Not, &[taken]), &brace);
                self.guard = Some(self.nested_guard(outside, not, &brace));
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

    /// Reads an expression or a condition.
    fn expression(&self, span: Range<usize>, is_condition: bool) -> Parsed<Expression> {
        let text = &self.text[span.clone()];
        let read = if is_condition { parse_condition(text, self) } else { parse(text, self) };
        let in_text = |found: ExpressionFault| {
            let at = found.span.start + span.start..found.span.end + span.start;
            let is_call = self.text[at.end..].trim_start().starts_with('(');
            let known = if self.call.is_some() { "x, v or h" } else { "x, v, h or target" };
            let remedy = match found.remedy {
                Remedy::Name { written, .. } if !is_call => Remedy::Words(format!(
                    "write {known}, or give it a value before: `let {} = 1`",
                    quoted(&written)
                )),
                remedy => remedy,
            };
            ExpressionFault { span: at, remedy, ..found }
        };
        read.map_err(in_text)
    }

    /// Returns the value of an expression made only of numbers.
    fn constant_value(&self, expression: &Expression, span: Range<usize>) -> Parsed<f64> {
        let reads = expression.nodes.iter().any(|node| matches!(node.op, Op::Input | Op::Call));
        let tape = || Tape::new(0, |_| false, &[(Part::Energy, expression)]).ok();
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

    /// Assigns the place that `SmoothDamp` leaves, and its velocity.
    fn assign_damped(
        &mut self,
        name: Range<usize>,
        joins: &'static str,
        value: Range<usize>,
        velocity: Range<usize>,
    ) -> Parsed<()> {
        let index = |text: &str| self.index(text).unwrap_or(X);
        let [x, v] = [&name, &velocity].map(|span| index(&self.text[span.clone()]));
        let damped = index(DAMPED_PLACE);
        let place = self.expression(value.clone(), false)?;
        self.damps_velocity = true;
        let speed = self.expression(value.clone(), false);
        self.damps_velocity = false;
        self.assign(damped, name.clone(), "", place, value.clone())?;
        self.assign(v, velocity, "", speed?, value.clone())?;
        let mut read = Expression::default();
        read.nodes.push(Node::input(damped));
        read.spans.push(0..0);
        self.assign(x, name, joins, read, value)
    }

    fn assign(
        &mut self,
        index: usize,
        name: Range<usize>,
        joins: &'static str,
        expression: Expression,
        value: Range<usize>,
    ) -> Parsed<()> {
        let is_0 = |node: usize| {
            let node = expression.nodes[node];
            matches!(node.op, Op::Number) && node.number == 0.0
        };
        let mut nodes = expression.nodes.iter();
        if nodes.any(|node| matches!(node.op, Op::Divide) && is_0(node.arguments()[1])) {
            return fault(value, "it divides by 0", "divide by another number");
        }
        let found = self.splice(&expression, value.start);
        let found = match joins {
            "" => found,
            joins => {
                if self.input(&self.names[index]).is_none() {
                    let written = quoted(&self.names[index]);
                    let what = format!("`{written}` has no value yet");
                    return fault(name, what, format!("write `let {written} = 0` before"));
                }
                let op = match joins {
                    "+" => Op::Add,
                    "-" => Op::Subtract,
                    "*" => Op::Multiply,
                    _ => Op::Divide,
                };
                let before = self.value(index, &name);
                self.push(Node::new(op, &[before, found]), &name)
            }
        };
        self.values[index] = Some(found);
        self.lines.push(Line::Assign { name: index, joins, value: expression });
        self.check_length(name)
    }

    fn open(&mut self, condition: Range<usize>, is_chained: bool) -> Parsed<()> {
        if self.blocks.len() == MAX_BLOCKS {
            let what = format!("the blocks are nested more than {MAX_BLOCKS} deep");
            return fault(condition, what, "use fewer");
        }
        let expression = self.expression(condition.clone(), true)?;
        let node = self.splice(&expression, condition.start);
        let (before, outside) = (self.values.clone(), self.guard);
        self.guard = Some(self.nested_guard(outside, node, &condition));
        self.blocks.push(Block { condition: node, before, first: None, outside, is_chained });
        self.lines.push(Line::If(expression));
        Ok(())
    }

    /// Returns the node whose value is whether the lines within a block of this condition run.
    fn nested_guard(
        &mut self,
        outside: Option<usize>,
        condition: usize,
        at: &Range<usize>,
    ) -> usize {
        match outside {
            Some(outside) => self.push(Node::new(Op::And, &[outside, condition]), at),
            None => condition,
        }
    }

    /// Closes a block. The values after the block are those of the branch taken.
    fn close(&mut self, block: Block, brace: &Range<usize>) {
        let Block { condition, before, first, outside, is_chained: _ } = block;
        self.guard = outside;
        let second = match first.is_some() {
            true => std::mem::take(&mut self.values),
            false => before.clone(),
        };
        let first = first.unwrap_or_else(|| std::mem::take(&mut self.values));
        self.values = before;
        for index in 0..self.names.len() {
            let branches = [first[index], second[index]];
            if branches[0] == branches[1] {
                self.values[index] = branches[0];
                continue;
            }
            // A number that only one branch declares does not exist after that branch.
            if branches.contains(&None) && !self.is_carried[index] {
                continue;
            }
            let [a, b] =
                branches.map(|branch| branch.unwrap_or_else(|| self.before_step(index, brace)));
            self.values[index] = Some(self.push(Node::new(Op::If, &[condition, a, b]), brace));
        }
    }

    /// Returns the node of a name's current number.
    fn value(&mut self, index: usize, at: &Range<usize>) -> usize {
        self.values[index].unwrap_or_else(|| self.before_step(index, at))
    }

    /// Returns the node of a name's number before the step.
    fn before_step(&mut self, index: usize, at: &Range<usize>) -> usize {
        if index >= BUILT_IN.len() && !self.carried.contains(&index) {
            self.carried.push(index);
        }
        self.push(Node::input(index), at)
    }

    fn push(&mut self, node: Node, at: &Range<usize>) -> usize {
        self.nodes.nodes.push(node);
        self.nodes.spans.push(at.clone());
        self.nodes.nodes.len() - 1
    }

    /// Adds the operations of an expression, which read the current numbers of the names. Returns the node of its
    /// value.
    fn splice(&mut self, expression: &Expression, at: usize) -> usize {
        let at = at..at;
        let mut read: Vec<(usize, usize)> = Vec::new();
        for node in expression.nodes.iter().filter(|node| node.op == Op::Input) {
            if !read.iter().any(|(name, _)| *name == node.index) {
                read.push((node.index, self.value(node.index, &at)));
            }
        }
        let (before, tables) = (self.nodes.nodes.len(), self.nodes.tables.len());
        let zero = Node::new(Op::Number, &[]);
        for (node, span) in expression.nodes.iter().zip(&expression.spans) {
            let span = at.start + span.start..at.start + span.end;
            let mut node = node.after(before);
            if node.op.is_table() {
                node.index += tables;
            }
            // A zero is a placeholder for an input, because operations read the name's current number instead.
            self.push(if node.op == Op::Input { zero } else { node }, &span);
        }
        self.nodes.tables.extend(expression.tables.iter().cloned());
        let number_of = |node: usize| {
            let inner = &expression.nodes[node - before];
            let found = read.iter().find(|(name, _)| inner.op == Op::Input && inner.index == *name);
            found.map_or(node, |(_, number)| *number)
        };
        for node in before..self.nodes.nodes.len() {
            let new = self.nodes.nodes[node].reading(number_of);
            self.nodes.nodes[node] =
                if new.op == Op::Call { self.guarded_call(&new, node) } else { new };
        }
        number_of(self.nodes.nodes.len() - 1)
    }

    /// Returns the node of a call of the acceleration. The call is guarded if the current lines are in a block.
    fn guarded_call(&mut self, call: &Node, node: usize) -> Node {
        let &[x, v, ref time @ ..] = call.arguments() else { return *call };
        let index = self.calls.len();
        self.calls.push([node, time.first().copied().unwrap_or(x)]);
        let operands = [Some(x), Some(v), self.guard].into_iter().flatten().collect::<Vec<_>>();
        let mut made = Node::new(Op::Call, &operands);
        made.index = index;
        made
    }

    fn check_length(&self, at: Range<usize>) -> Parsed<()> {
        if self.calls.len() > MAX_CALLS {
            let what = format!("the lines call the acceleration more than {MAX_CALLS} times");
            return fault(at, what, "write fewer");
        }
        if self.nodes.nodes.len() <= 2 * MAX_OPERATIONS {
            return Ok(());
        }
        let what = format!("the lines have more than {MAX_OPERATIONS} operations");
        fault(at, what, "write fewer")
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
            let remedy = "write `x` for the position and `v` for its velocity: `x += v * dt`";
            return fault(last, "no line assigns `x` or `v`", remedy);
        }
        let mut carried = self.carried.clone();
        carried.sort_unstable();
        let ends: Vec<usize> = carried.iter().map(|index| self.value(*index, &last)).collect();
        // The calls come first, in the order written, including calls without effect.
        let asked = [0, 1].map(|of| self.calls.iter().map(move |call| call[of]));
        let outputs: Vec<usize> = asked.into_iter().flatten().chain(ends).collect();
        let whole = |node: usize| Expression {
            nodes: self.nodes.nodes[..=node].to_vec(),
            spans: self.nodes.spans[..=node].to_vec(),
            tables: self.nodes.tables.clone(),
        };
        let expressions: Vec<Expression> = outputs.into_iter().map(whole).collect();
        let parts: Vec<_> = expressions.iter().map(|of| (Part::Energy, of)).collect();
        let mut tape = Tape::new(self.names.len(), |input| input == H, &parts).or_else(|long| {
            let (noun, most) = match long.are_switches {
                true => ("corners and jumps", MAX_SWITCHES),
                false => ("operations", MAX_OPERATIONS),
            };
            fault(last, format!("the lines have more than {most} {noun}"), "write fewer")
        })?;
        let named = |input: usize| Carried {
            name: self.names[input].clone(),
            start: self.starts[input],
            input,
        };
        let carried = carried.into_iter().map(named).collect();
        let times = tape.outputs.drain(..2 * self.calls.len()).skip(self.calls.len()).collect();
        let Reader { names, lines, call, .. } = self;
        let (source, calls) = (String::new(), Vec::new());
        let left_out = None;
        let mut text = StepText { source, names, lines, carried, tape, call, calls, left_out };
        text.calls = StepCall::all(&text, times);
        Ok(text)
    }
}
