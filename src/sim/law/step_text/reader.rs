//! From the statements of a step to its operations: which number a name has where it is read.

use std::ops::Range;

use super::statements::{Statement, statements};
use super::{BUILT_IN, Carried, H, Line, StepText, TARGET, V, X};
use crate::sim::law::expression::{Expression, Node, Scope, parse, parse_condition};
use crate::sim::law::fault::{ExpressionFault, Parsed, Part, Remedy, fault, quoted};
use crate::sim::law::function::Function;
use crate::sim::law::op::{OPERATOR_WORDS, Op};
use crate::sim::law::tape::{MAX_OPERATIONS, MAX_SWITCHES, Tape};

/// The most names of a text, so that one word holds a set of them.
const MAX_STEP_NAMES: usize = 64;

/// The most blocks within each other.
const MAX_BLOCKS: usize = 32;

/// Other names of the length of a step.
const STEP_NAMES: [&str; 5] = ["dt", "delta", "deltaTime", "delta_time", "delta_seconds"];

/// The values of the names where the reader stands.
type Values = Vec<Option<usize>>;

/// An open block.
struct Block {
    condition: usize,
    before: Values,
    /// The values at the end of the first branch, once the second is open.
    first: Option<Values>,
    /// Whether it ends with the block around it, as that of `else if` does.
    is_chained: bool,
}

/// Takes the statements of a text, one by one.
pub(super) struct Reader<'t> {
    text: &'t str,
    names: Vec<String>,
    /// Of each name whether it may be read before a line assigns it.
    is_carried: Vec<bool>,
    starts: Vec<f64>,
    lines: Vec<Line>,
    /// The operations of all lines. The node of an input is that of the number before the step.
    nodes: Expression,
    values: Values,
    carried: Vec<usize>,
    blocks: Vec<Block>,
}

impl Scope for Reader<'_> {
    fn input(&self, name: &str) -> Option<usize> {
        let index = self.index(name)?;
        (self.is_carried[index] || self.values[index].is_some()).then_some(index)
    }

    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn why_not(&self, _: &str) -> Option<String> {
        None
    }

    fn function(&self, name: &str) -> Option<&'static Function> {
        Function::named_in_steps(name)
    }
}

impl<'t> Reader<'t> {
    /// A reader that knows which names the text assigns.
    pub(super) fn new(text: &'t str) -> Parsed<Self> {
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
        };
        for statement in statements(text)? {
            let (name, is_carried) = match statement {
                Statement::Assign { name, is_declared, .. } => (name, !is_declared),
                Statement::Memory { name, .. } => (name, true),
                _ => continue,
            };
            reader.declare(name, is_carried)?;
        }
        Ok(reader)
    }

    fn index(&self, name: &str) -> Option<usize> {
        if STEP_NAMES.contains(&name) {
            return Some(H);
        }
        self.names.iter().position(|known| known == name)
    }

    fn declare(&mut self, span: Range<usize>, is_carried: bool) -> Parsed<()> {
        let name = &self.text[span.clone()];
        let is_word = OPERATOR_WORDS.contains(&name) || name == "pi";
        if is_word || Function::named_in_steps(name).is_some() {
            let what = format!("`{}` has a meaning of its own in expressions", quoted(name));
            return fault(span, what, "give it another name");
        }
        match self.index(name) {
            Some(TARGET) => {
                let remedy = "give the number another name, such as `goal`";
                return fault(span, "`target` is where `x` goes, which no line changes", remedy);
            }
            Some(index) => self.is_carried[index] |= is_carried,
            None if self.names.len() == MAX_STEP_NAMES => {
                let what = format!("the lines have more than {} names", MAX_STEP_NAMES - 4);
                return fault(span, what, "use fewer");
            }
            None => {
                self.names.push(name.to_owned());
                self.is_carried.push(is_carried);
                self.starts.push(0.0);
                self.values.push(None);
            }
        }
        Ok(())
    }

    /// Takes the next statement.
    pub(super) fn take(&mut self, statement: Statement) -> Parsed<()> {
        match statement {
            Statement::Assign { name, joins, value, is_declared: _ } => {
                self.assign(name, joins, value)
            }
            Statement::Memory { name, value } => {
                let expression = self.expression(value.clone(), false)?;
                let map = self.alone(&expression, value)?;
                let index = self.index(&self.text[name]).unwrap_or(X);
                self.starts[index] = map;
                Ok(())
            }
            Statement::If(condition) => self.open(condition, false),
            Statement::Else(condition, brace) => {
                let Some(block) = self.blocks.last_mut().filter(|block| block.first.is_none())
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

    /// Reads an expression, or a condition.
    fn expression(&self, span: Range<usize>, is_condition: bool) -> Parsed<Expression> {
        let text = &self.text[span.clone()];
        let read = if is_condition { parse_condition(text, self) } else { parse(text, self) };
        let in_text = |found: ExpressionFault| {
            let at = found.span.start + span.start..found.span.end + span.start;
            let is_call = self.text[at.end..].trim_start().starts_with('(');
            let remedy = match found.remedy {
                Remedy::Name { written, .. } if !is_call => Remedy::Words(format!(
                    "write x, v, h or target, or give it a value before: `let {} = 1`",
                    quoted(&written)
                )),
                remedy => remedy,
            };
            ExpressionFault { span: at, remedy, ..found }
        };
        read.map_err(in_text)
    }

    /// The value of an expression of numbers alone.
    fn alone(&self, expression: &Expression, span: Range<usize>) -> Parsed<f64> {
        let reads = expression.nodes.iter().any(|node| node.op == Op::Input);
        let tape = Tape::new(0, |_| false, &[(Part::Energy, expression)]).ok().filter(|_| !reads);
        let value = tape.map(|tape| {
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

    fn assign(
        &mut self,
        name: Range<usize>,
        joins: &'static str,
        value: Range<usize>,
    ) -> Parsed<()> {
        let expression = self.expression(value, false)?;
        let index = self.index(&self.text[name.clone()]).unwrap_or(X);
        let found = self.splice(&expression, name.start);
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
        let before = self.values.clone();
        self.blocks.push(Block { condition: node, before, first: None, is_chained });
        self.lines.push(Line::If(expression));
        Ok(())
    }

    /// Chooses the values of the branch that is taken.
    fn close(&mut self, Block { condition, before, first, .. }: Block, brace: &Range<usize>) {
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
            // A number that only one branch declares ends with it.
            if branches.contains(&None) && !self.is_carried[index] {
                continue;
            }
            let [a, b] =
                branches.map(|branch| branch.unwrap_or_else(|| self.before_step(index, brace)));
            self.values[index] = Some(self.push(Node::new(Op::If, &[condition, a, b]), brace));
        }
    }

    /// The node of a name's number where the reader stands.
    fn value(&mut self, index: usize, at: &Range<usize>) -> usize {
        self.values[index].unwrap_or_else(|| self.before_step(index, at))
    }

    /// The node of a name's number before the step.
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

    /// Adds the operations of an expression, with the numbers that its names have here.
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
        for node in &expression.nodes {
            let mut node = node.after(before);
            if node.op.is_table() {
                node.index += tables;
            }
            // Stands for its number, which an operation reads in its place.
            self.push(if node.op == Op::Input { zero } else { node }, &at);
        }
        self.nodes.tables.extend(expression.tables.iter().cloned());
        let number_of = |node: usize| {
            let inner = &expression.nodes[node - before];
            let found = read.iter().find(|(name, _)| inner.op == Op::Input && inner.index == *name);
            found.map_or(node, |(_, number)| *number)
        };
        for node in &mut self.nodes.nodes[before..] {
            *node = node.reading(number_of);
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

    /// The lines, once all statements are taken.
    pub(super) fn finish(mut self) -> Parsed<StepText> {
        if !self.blocks.is_empty() {
            let end = self.text.trim_end().len();
            let last = self.text.floor_char_boundary(end.saturating_sub(1));
            return fault(last..end, "a block is not closed", "write `}` at its end");
        }
        let last = 0..self.text.len();
        let assigns = |line: &Line| matches!(line, Line::Assign { name: X | V, .. });
        if !self.lines.iter().any(assigns) {
            let remedy = "write `x` for what moves and `v` for its velocity: `x += v * dt`";
            return fault(last, "no line assigns `x` or `v`", remedy);
        }
        let mut carried = self.carried.clone();
        carried.sort_unstable();
        let outputs: Vec<usize> = carried.iter().map(|index| self.value(*index, &last)).collect();
        let whole = |node: usize| Expression {
            nodes: self.nodes.nodes[..=node].to_vec(),
            spans: self.nodes.spans[..=node].to_vec(),
            tables: self.nodes.tables.clone(),
        };
        let expressions: Vec<Expression> = outputs.into_iter().map(whole).collect();
        let parts: Vec<_> = expressions.iter().map(|of| (Part::Energy, of)).collect();
        let tape = Tape::new(self.names.len(), |input| input == H, &parts).or_else(|long| {
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
        Ok(StepText { carried, names: self.names, lines: self.lines, tape })
    }
}
