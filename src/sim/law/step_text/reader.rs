//! Translates the statements of a step to operations, and finds the current value of each name that is read.

use std::ops::Range;

use super::method::{Function as OwnFunction, General, Input, Machine, Taken};
use super::paths::{SMOOTH_DAMP, damped_velocity};
use super::statements::{Statement, statements};
use super::{BUILT_IN, Carried, H, Line, OTHER_NAMES, STEP_NAMES, StepText, TARGET, V, X};
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

/// The maximum number of functions of a text.
const MAX_FUNCTIONS: usize = 16;

/// The functions that a text may `use`.
const SHARED: [(&str, &str); 4] = [
    ("slope", include_str!("../../../../assets/methods/shared/slope.step")),
    ("solve", include_str!("../../../../assets/methods/shared/solve.step")),
    ("steady", include_str!("../../../../assets/methods/shared/steady.step")),
    ("step-size", include_str!("../../../../assets/methods/shared/step-size.step")),
];

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
    reads_velocity: bool,
    /// Whether the value of `SmoothDamp` is the velocity that it leaves.
    damps_velocity: bool,
}

/// Returns the index of the statement that closes the block which the statement at `at` opens.
fn end_of(all: &[Statement], at: usize) -> usize {
    let mut depth = 0;
    let is_end = |statement: &Statement| {
        depth += statement.depth();
        depth == 0
    };
    all[at..].iter().position(is_end).map_or(all.len(), |length| at + length)
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
        let index = self.index(name).filter(|index| self.may_read(*index))?;
        (self.is_carried[index] || self.values[index].is_some()).then_some(index)
    }

    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn why_not(&self, name: &str) -> Option<String> {
        let is_target = self.index(name).is_some_and(|index| !self.may_read(index));
        is_target.then(|| "a method moves by `a(x, v)`, and has no target".to_owned())
    }

    fn constant(&self, name: &str) -> Option<f64> {
        match name {
            "pi" => Some(std::f64::consts::PI),
            "nan" => Some(f64::NAN),
            _ => None,
        }
    }

    fn own_function(&self, name: &str) -> Option<(usize, Vec<bool>)> {
        let index = self.functions.iter().rposition(|function| function.name == name)?;
        Some((index, self.functions[index].inputs.clone()))
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
    /// Reads a text.
    pub(super) fn read(text: &'t str, all: &[Statement]) -> Parsed<StepText> {
        let mut reader = Self::new(text, first_call(text), Vec::new());
        reader.names = BUILT_IN.map(String::from).to_vec();
        reader.is_carried = vec![true; BUILT_IN.len()];
        reader.starts = vec![0.0; BUILT_IN.len()];
        reader.values = vec![None; BUILT_IN.len()];
        reader.carried = vec![X, V];
        for statement in all {
            if let Statement::Takes(input) = statement {
                reader.take(input.clone())?;
            }
        }
        reader.read_all(all)?;
        reader.finish()
    }

    fn new(text: &'t str, method_at: Option<Range<usize>>, functions: Vec<OwnFunction>) -> Self {
        Reader {
            text,
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
            reads_velocity: false,
            damps_velocity: false,
        }
    }

    /// Reads statements in order, after declaring all names that they assign.
    fn read_all(&mut self, all: &[Statement]) -> Parsed<()> {
        let mut at = 0;
        while let Some(statement) = all.get(at) {
            match statement {
                Statement::Assign { name, is_declared, value, .. } => {
                    let is_carried = !is_declared && !self.is_function;
                    self.declare(name.clone(), is_carried, false)?;
                    if let Some(velocity) = damped_velocity(self.text, value) {
                        self.declare(velocity, is_carried, false)?;
                        if self.index(DAMPED_PLACE).is_none() {
                            self.add_name(DAMPED_PLACE, false);
                        }
                    }
                }
                Statement::Memory { name, .. } => self.declare(name.clone(), true, true)?,
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
            } else {
                self.read_statement(statement.clone())?;
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
        self.is_function || index != TARGET || !self.is_method() || self.takes_target
    }

    /// Reads an input of the lines, such as `whole substeps`.
    fn take(&mut self, span: Range<usize>) -> Parsed<()> {
        let text = self.text[span.clone()].trim();
        let name = text.strip_prefix("whole ").unwrap_or(text).trim();
        let name = name.split('(').next().unwrap_or_default().trim_end();
        let start = span.start + self.text[span.clone()].find(name).unwrap_or(0);
        let span = start..start + name.len();
        if name == "target" {
            self.takes_target = true;
        } else if let Some((_, input)) = Input::ALL.iter().find(|(known, _)| *known == name) {
            self.method_at.get_or_insert(span.clone());
            self.declare(span.clone(), false, false)?;
            let index = self.index(name).unwrap_or(X);
            self.values[index] = Some(0);
            self.inputs.push(Taken { input: *input, name: index, span });
        } else if !ACCELERATION.contains(&name) {
            let known: Vec<&str> = Input::ALL.iter().map(|(name, _)| *name).collect();
            let what = format!("no body gives a step `{}`", quoted(name));
            let remedy = format!("take `a(x, v)`, `target`, {}", known.join(", "));
            return fault(span, what, remedy);
        }
        Ok(())
    }

    /// Reads a function, whose lines are the statements in this range.
    fn read_function(
        &mut self,
        name: Range<usize>,
        inputs: Range<usize>,
        all: &[Statement],
        lines: Range<usize>,
    ) -> Parsed<()> {
        let word = &self.text[name.clone()];
        self.expect_method(&name, "write its lines in the place of the call")?;
        if !self.blocks.is_empty() || self.is_function || lines.end == all.len() {
            let remedy = "end the blocks before it, and close it with `}`";
            return fault(name, "the function stands in a block, or is not closed", remedy);
        }
        if self.functions.len() == MAX_FUNCTIONS {
            let what = format!("the lines have more than {MAX_FUNCTIONS} functions");
            return fault(name, what, "use fewer");
        }
        let mut reader = Self::new(self.text, self.method_at.clone(), Vec::new());
        reader.is_function = true;
        let (mut takes, mut at) = (Vec::new(), inputs.start);
        while at < inputs.end {
            let rest = &self.text[at..inputs.end];
            let length = rest.find([',', '(']).unwrap_or(rest.len());
            let input = rest[..length].trim_start();
            let input = at + length - input.len()..at + length;
            let input = input.start..input.start + self.text[input.clone()].trim_end().len();
            let is_acceleration = rest[length..].starts_with('(');
            let is_name = self.text[input.clone()].bytes().all(is_name_part);
            if input.is_empty() || !is_name || takes.len() == MAX_STEP_NAMES {
                return fault(
                    inputs,
                    "an input of the function is no name",
                    "write `fn f(x, v) {`",
                );
            }
            if !is_acceleration {
                reader.declare(input, false, false)?;
                reader.values.fill(Some(0));
            }
            takes.push(is_acceleration);
            let closed = if is_acceleration {
                rest.find(')').map_or(rest.len(), |at| at + 1)
            } else {
                length
            };
            let next = rest[closed..].find(|c: char| c != ',' && !c.is_ascii_whitespace());
            at += next.map_or(rest.len(), |next| closed + next);
        }
        reader.functions = std::mem::take(&mut self.functions);
        reader.read_all(&all[lines])?;
        let Reader { names, lines, functions, .. } = reader;
        if !matches!(lines.last(), Some(Line::Return(_))) {
            return fault(name, "the function can end without a value", "end it with `return x`");
        }
        self.functions = functions;
        self.functions.push(OwnFunction {
            name: word.to_owned(),
            inputs: takes,
            names,
            lines,
            general: None,
        });
        Ok(())
    }

    /// Adds the functions of a shared source.
    fn use_shared(&mut self, span: Range<usize>) -> Parsed<()> {
        let name = self.text[span.clone()].trim();
        let start = span.start + self.text[span].find(name).unwrap_or(0);
        let span = start..start + name.len();
        let Some((_, source)) = SHARED.iter().find(|(known, _)| *known == name) else {
            let known: Vec<&str> = SHARED.iter().map(|(known, _)| *known).collect();
            let what = format!("nothing shared is called `{}`", quoted(name));
            return fault(span, what, format!("write one of {}", known.join(", ")));
        };
        self.expect_method(&span, "write its lines in the place of the call")?;
        let (text, _) = super::plain(source);
        let before = self.functions.len();
        let mut reader = Reader::new(&text, Some(0..0), std::mem::take(&mut self.functions));
        reader.read_all(&statements(&text)?)?;
        self.functions = reader.functions;
        for function in &mut self.functions[before..] {
            function.general = General::of(&function.name);
        }
        Ok(())
    }

    /// Refuses a rule.
    fn expect_method(&self, at: &Range<usize>, remedy: &str) -> Parsed<()> {
        if self.is_method() {
            return Ok(());
        }
        let what = format!("`{}` cannot stand in a rule", quoted(self.text[at.clone()].trim()));
        fault(at.clone(), what, remedy)
    }

    fn index(&self, name: &str) -> Option<usize> {
        if self.is_function {
            return self.names.iter().position(|known| known == name);
        }
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
            Some(TARGET) if !self.is_function => {
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
                let index = self.index(&self.text[name.clone()]);
                let index = index.filter(|index| *index <= V && !self.is_function);
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
            Statement::While(word, condition) => {
                self.expect_method(&word, "write the lines of one step, which has no loops")?;
                self.open_loop(condition)
            }
            Statement::Return { word, value } => {
                if !self.is_function {
                    let what = "`return` cannot stand in a step";
                    return fault(word, what, "assign `x` and `v` in its place, or write `stay`");
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

    /// Reads an expression or a condition.
    fn expression(&self, span: Range<usize>, is_condition: bool) -> Parsed<Expression> {
        let text = &self.text[span.clone()];
        let read = if is_condition { parse_condition(text, self) } else { parse(text, self) };
        let in_text = |found: ExpressionFault| {
            let at = found.span.start + span.start..found.span.end + span.start;
            let is_call = self.text[at.end..].trim_start().starts_with('(');
            let known = if self.is_method() { "x, v or h" } else { "x, v, h or target" };
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
        let reads = |node: &Node| matches!(node.op, Op::Input | Op::Call | Op::Apply);
        let reads = expression.nodes.iter().any(reads);
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
        if self.inputs.iter().any(|taken| taken.name == index && !self.is_function) {
            return fault(name, "a step cannot change its setting", "give it another name");
        }
        let found = match self.is_method() {
            true => {
                self.note_reads(&expression);
                0
            }
            false => self.splice(&expression, value.start),
        };
        let found = match joins {
            "" => found,
            joins => {
                if self.input(&self.names[index]).is_none() {
                    let written = quoted(&self.names[index]);
                    let what = format!("`{written}` has no value yet");
                    return fault(name, what, format!("write `let {written} = 0` before"));
                }
                if self.is_method() {
                    self.note_read(index);
                    self.values[index] = Some(0);
                    self.lines.push(Line::Assign { name: index, joins, value: expression });
                    return Ok(());
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
        let node = match self.is_method() {
            true => {
                self.note_reads(&expression);
                0
            }
            false => self.splice(&expression, condition.start),
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

    /// Notes that a method reads these names, of which those without a value are carried.
    fn note_reads(&mut self, expression: &Expression) {
        let inputs = expression.nodes.iter().filter(|node| node.op == Op::Input);
        inputs.for_each(|node| self.note_read(node.index));
    }

    fn note_read(&mut self, index: usize) {
        if self.values[index].is_none() && !self.is_function {
            self.reads_velocity |= index == V;
            if index >= BUILT_IN.len() && !self.carried.contains(&index) {
                self.carried.push(index);
            }
        }
    }

    /// Closes a block. The values after the block are those of the branch taken.
    fn close(&mut self, block: Block, brace: &Range<usize>) {
        let Block { condition, before, first, .. } = block;
        let second = match first.is_some() {
            true => std::mem::take(&mut self.values),
            false => before.clone(),
        };
        let first = first.unwrap_or_else(|| std::mem::take(&mut self.values));
        self.values = before;
        for index in 0..self.names.len() {
            let branches = [first[index], second[index]];
            if self.is_method() {
                self.values[index] = branches[0].and(branches[1]);
                continue;
            }
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
            self.nodes.nodes[node] = self.nodes.nodes[node].reading(number_of);
        }
        number_of(self.nodes.nodes.len() - 1)
    }

    fn check_length(&self, at: Range<usize>) -> Parsed<()> {
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
        let is_rule = !self.is_method();
        let ends = carried.iter().filter(|_| is_rule);
        let outputs: Vec<usize> = ends.map(|index| self.value(*index, &last)).collect();
        let whole = |node: usize| Expression {
            nodes: self.nodes.nodes[..=node].to_vec(),
            spans: self.nodes.spans[..=node].to_vec(),
            tables: self.nodes.tables.clone(),
        };
        let expressions: Vec<Expression> = outputs.into_iter().map(whole).collect();
        let parts: Vec<_> = expressions.iter().map(|of| (Part::Energy, of)).collect();
        let tape = Tape::new(self.names.len(), |input| input == H, &parts).or_else(|long| {
            match long.are_switches {
                true => too_long(last.clone(), "corners and jumps", MAX_SWITCHES),
                false => too_long(last.clone(), "operations", MAX_OPERATIONS),
            }
        })?;
        let machine = match is_rule {
            true => Some(Machine::default()),
            false => Machine::new(self.names.len(), &self.lines, &self.functions),
        };
        let machine = machine.map_or_else(|| too_long(last, "operations", MAX_OPERATIONS), Ok)?;
        let named = |input: usize| Carried {
            name: self.names[input].clone(),
            start: self.starts[input],
            input,
        };
        let carried = carried.into_iter().map(named).collect();
        let Reader { names, lines, method_at, inputs, functions, reads_velocity, .. } = self;
        Ok(StepText {
            source: String::new(),
            names,
            lines,
            carried,
            tape,
            method_at,
            inputs,
            functions,
            reads_velocity,
            machine,
            left_out: None,
        })
    }
}

fn too_long<T>(at: Range<usize>, noun: &str, most: usize) -> Parsed<T> {
    fault(at, format!("the lines have more than {most} {noun}"), "write fewer")
}
