//! The tree of the lines of a step, as a printer reads it.

use std::ops::Range;

use super::method::{Function, Taken};
use super::plain::number_length;
use super::{Declares, H, Line, StepText, TARGET, V};
use crate::expression::{Expression, Node};
use crate::function::{FUNCTIONS, Meaning, STEP_FUNCTIONS};
use crate::op::{INFIXES, Infix, Level, Op};

/// The maximum number of operations of an expression in print, in which a shared part is written out at each use.
const MAX_PRINTED: usize = 1024;

/// An input of a step or of a function besides `x`, `v` and `h`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodInput<'a> {
    /// Name of the input.
    pub name: &'a str,
    /// Arguments of the input if it is a function; empty for a number.
    pub arguments: Vec<&'a str>,
    /// Whether the input is a whole number.
    pub is_whole: bool,
    /// Description of the input, as a phrase in lower case.
    pub about: &'a str,
}

impl<'a> MethodInput<'a> {
    fn number(name: &'a str, about: &'a str) -> Self {
        Self { name, arguments: Vec::new(), is_whole: false, about }
    }

    fn acceleration(about: &'a str) -> Self {
        Self { arguments: vec!["x", "v"], ..Self::number("a", about) }
    }
}

/// The lines of a step, or of one of its functions.
#[derive(Clone, Copy, Debug)]
pub struct StepBody<'t> {
    pub(super) text: &'t StepText,
    pub(super) function: Option<&'t Function>,
}

/// An operation of an expression. Operands are indices of nodes before it.
pub enum Operation<'t> {
    /// A number, with its texts in double and single precision if it is a literal.
    Number {
        /// The number.
        value: f64,
        /// Its texts.
        written: Option<[&'t str; 2]>,
    },
    /// The value of a name.
    Name(usize),
    /// An operator between two operands.
    Infix {
        /// Sign of the operator.
        sign: &'static str,
        /// How tightly it binds.
        level: Level,
        /// The operands.
        operands: [usize; 2],
        /// Whether a line begins with it.
        breaks: bool,
    },
    /// The opposite number.
    Negate(usize),
    /// The opposite condition.
    Not(usize),
    /// A call of a function of the language.
    Call {
        /// Name of the function.
        function: &'static str,
        /// Its arguments.
        arguments: &'t [usize],
    },
    /// The number of an array at an index.
    Element {
        /// Name of the array.
        array: &'t str,
        /// The place in it.
        index: usize,
    },
    /// A call of the acceleration at a position and a velocity.
    Acceleration([usize; 2]),
    /// A call of a function of the lines. `None` hands the acceleration on.
    Own {
        /// Name of the function.
        function: &'t str,
        /// Its arguments.
        arguments: Vec<Option<usize>>,
    },
}

impl StepText {
    /// Returns the lines of the step.
    pub fn body(&self) -> StepBody<'_> {
        StepBody { text: self, function: None }
    }

    /// Returns the functions of the lines.
    pub fn functions(&self) -> impl Iterator<Item = StepBody<'_>> {
        let body = |function| StepBody { text: self, function: Some(function) };
        self.functions.iter().map(body)
    }

    /// Returns the remarks above the inputs.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Returns the words of the text on a claim of its card, which are a line such as `order: 2 on a spring`.
    pub fn claim<'t>(&'t self, claim: &str) -> Option<&'t str> {
        let mut lines = self.source.lines();
        lines.find_map(|line| Some(line.strip_prefix(claim)?.strip_prefix(": ")?.trim()))
    }

    /// Whether a line has the length of a step.
    pub fn reads_step(&self) -> bool {
        self.lines.iter().any(|line| line.mentions(H))
    }

    /// Returns the inputs of the step besides `x`, `v` and `h`.
    pub fn method_inputs(&self) -> Vec<MethodInput<'_>> {
        let named = |taken: &'_ Taken| -> MethodInput<'_> {
            let line = self.source[taken.span.end..].lines().next().unwrap_or_default();
            let about = line.split_once(": ").map(|(_, about)| about.trim());
            match taken.name {
                None => MethodInput::acceleration(about.unwrap_or(ACCELERATION_AT)),
                Some(TARGET) => MethodInput::number("target", about.unwrap_or(THE_TARGET)),
                Some(_) => MethodInput {
                    is_whole: taken.is_whole,
                    ..MethodInput::number(
                        &self.source[taken.span.clone()],
                        about.unwrap_or("a setting of the body"),
                    )
                },
            }
        };
        let mut inputs: Vec<MethodInput<'_>> = self.inputs.iter().map(named).collect();
        let takes = |name| self.inputs.iter().any(|taken| taken.name == name);
        if !self.calls().is_empty() && !takes(None) {
            inputs.insert(0, MethodInput::acceleration(ACCELERATION_AT));
        }
        if (self.law_order().is_some() || self.takes_target()) && !takes(Some(TARGET)) {
            let at = inputs.iter().filter(|input| !input.arguments.is_empty()).count();
            inputs.insert(at, MethodInput::number("target", THE_TARGET));
        }
        inputs
    }

    /// Returns the reason why no other language can have the lines; `None` if they can.
    pub fn unwritable(&self) -> Option<&'static str> {
        if self.is_loop()
            && self.lines.iter().any(|line| matches!(line, Line::Stop { fails: true }))
        {
            return Some("its `fail` takes back ticks; write `stay`");
        }
        let bodies = self.functions.iter().map(|function| &function.lines).chain([&self.lines]);
        let mut values = bodies.flatten().flat_map(Line::values);
        values.find_map(|expression| {
            let mut sizes: Vec<usize> = Vec::with_capacity(expression.nodes.len());
            for node in &expression.nodes {
                if node.op.is_table() {
                    return Some("`table(…)` has no words there; write blocks of `if`");
                }
                let operands = node.arguments().iter().map(|operand| sizes[*operand]);
                sizes.push(operands.fold(1, usize::saturating_add));
            }
            let is_long = sizes.last().is_some_and(|size| *size > MAX_PRINTED);
            is_long.then_some("an expression is too long once its powers are written out")
        })
    }
}

/// Descriptions of the inputs that a text need not describe.
const ACCELERATION_AT: &str = "the acceleration at position x and velocity v";
const THE_TARGET: &str = "the target of x";

impl Line {
    /// Returns the expression of the line, if it has one.
    pub fn value(&self) -> Option<&Expression> {
        match self {
            Line::Assign { value, .. }
            | Line::If(value)
            | Line::While(value)
            | Line::Store { value, .. }
            | Line::Return(value) => Some(value),
            Line::Else | Line::End | Line::Stop { .. } | Line::Remark(_) | Line::Blank => None,
        }
    }

    /// Returns all expressions of the line, with that of an index.
    pub fn values(&self) -> impl Iterator<Item = &Expression> {
        let index = match self {
            Line::Store { index, .. } => Some(index),
            _ => None,
        };
        index.into_iter().chain(self.value())
    }

    /// The number of blocks that the line opens, less those that it closes.
    pub fn depth(&self) -> i32 {
        match self {
            Line::If(_) | Line::While(_) => 1,
            Line::End => -1,
            _ => 0,
        }
    }

    /// Whether the line assigns or reads a name.
    pub fn mentions(&self, name: usize) -> bool {
        let assigns = matches!(self, Line::Assign { name: assigned, .. } if *assigned == name);
        assigns || self.values().any(|value| value.reads(name))
    }
}

impl Expression {
    /// Whether the expression reads a name.
    pub fn reads(&self, name: usize) -> bool {
        self.nodes.iter().any(|node| node.op == Op::Input && node.index == name)
    }

    /// Whether the expression is made of numbers and names for which `is_constant` holds.
    pub fn is_constant(&self, is_constant: impl Fn(usize) -> bool) -> bool {
        self.nodes.iter().all(|node| match node.op {
            Op::Input => is_constant(node.index),
            Op::Number | Op::Negate | Op::Add | Op::Subtract | Op::Multiply | Op::Divide => true,
            _ => false,
        })
    }

    /// Returns the argument of `ceil`, which the reader writes as `-floor(-x)`, if this node is its `floor`.
    fn ceiling(&self, floor: usize) -> Option<&[usize]> {
        let [inner] = self.nodes[floor].arguments() else { return None };
        let is_floor = name_of(self.nodes[floor].op) == Some("floor");
        (is_floor && self.nodes[*inner].op == Op::Negate).then(|| self.nodes[*inner].arguments())
    }

    /// Returns the number of operations.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }
}

impl<'t> StepBody<'t> {
    /// Returns the name of the function; `None` for the step.
    pub fn function(self) -> Option<&'t str> {
        self.function.map(|function| &*function.name)
    }

    /// Returns the remarks above a function.
    pub fn remarks(self) -> &'t [String] {
        self.function.map_or(&[], |function| &function.remarks)
    }

    /// Returns the inputs besides `x`, `v` and `h`, which for a function are all of its inputs.
    pub fn inputs(self) -> Vec<MethodInput<'t>> {
        let Some(function) = self.function else { return self.text.method_inputs() };
        let mut names = function.names.iter();
        let input = |is_acceleration: &bool| match is_acceleration {
            true => MethodInput::acceleration(""),
            false => MethodInput::number(names.next().map_or("", String::as_str), ""),
        };
        function.inputs.iter().map(input).collect()
    }

    /// Returns the lines.
    pub fn lines(self) -> &'t [Line] {
        self.function.map_or(&self.text.lines, |function| &function.lines)
    }

    /// Returns the names, to which lines and expressions refer by their indices.
    pub fn names(self) -> &'t [String] {
        self.function.map_or(&self.text.names, |function| &function.names)
    }

    /// Whether a name has a value before the first line.
    pub fn is_given(self, name: usize) -> bool {
        match self.function {
            Some(function) => name < function.inputs.iter().filter(|is| !**is).count(),
            None => {
                name <= self.last_told()
                    || self.is_field(name)
                    || self.text.inputs.iter().any(|taken| taken.name == Some(name))
            }
        }
    }

    /// Whether a name is a number that the memory carries.
    pub fn is_field(self, name: usize) -> bool {
        let carried = || self.text.carried.iter().any(|carried| carried.input == name);
        self.function.is_none() && name > V && carried()
    }

    /// Whether a name is a whole number, which lines declared as such count.
    pub fn is_whole(self, name: usize) -> bool {
        // The whole times of a loop are numbers like all others.
        let has_inputs = self.function.is_none() && !self.is_loop();
        let inputs = self.text.inputs.iter().filter(|_| has_inputs);
        let is_taken = inputs.clone().any(|taken| taken.is_whole && taken.name == Some(name));
        let mut assigned = self.lines().iter().filter_map(|line| match line {
            Line::Assign { name: other, joins, value, declares } if *other == name => {
                Some((*declares, *joins, value))
            }
            _ => None,
        });
        is_taken
            || assigned.clone().any(|(declares, ..)| declares == Some(Declares::Counter))
                && assigned.all(|(_, joins, value)| joins != "/" && self.counts(value))
    }

    /// Whether an expression is made of whole literals and counters.
    fn counts(self, value: &Expression) -> bool {
        let is_counter = |name: usize| {
            self.lines().iter().any(|line| match line {
                Line::Assign { name: other, declares: Some(Declares::Counter), .. } => {
                    *other == name
                }
                _ => false,
            })
        };
        value.nodes.iter().all(|node| match node.op {
            Op::Number => is_whole_literal(node.number),
            Op::Input => is_counter(node.index),
            op => WHOLE.contains(&op),
        })
    }

    /// Returns for each operation of an expression whether its value is a whole number. If `is_whole`, the value of
    /// the expression is one.
    pub fn whole(self, expression: &Expression, is_whole: bool) -> Vec<bool> {
        let nodes = &expression.nodes;
        // Whether each node can be whole, and whether it has a counter.
        let mut can: Vec<[bool; 2]> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let operands = node.arguments().iter().map(|operand| can[*operand]);
            can.push(match node.op {
                Op::Number => [is_whole_literal(node.number), false],
                Op::Input => [self.is_whole(node.index); 2],
                op if WHOLE.contains(&op) => {
                    operands.fold([true, false], |all, it| [all[0] && it[0], all[1] || it[1]])
                }
                _ => [false; 2],
            });
        }
        let mut whole = vec![false; nodes.len()];
        if let Some(last) = whole.last_mut() {
            *last = is_whole;
        }
        for (index, node) in nodes.iter().enumerate().rev() {
            let operands = node.arguments();
            let compares = node.op.is_truth() && matches!(node.op, Op::Switch(_));
            let are_whole =
                || operands.iter().all(|it| can[*it][0]) && operands.iter().any(|it| can[*it][1]);
            if WHOLE.contains(&node.op) && whole[index] || compares && are_whole() {
                operands.iter().for_each(|operand| whole[*operand] = true);
            }
        }
        whole
    }

    /// Returns the text to which the byte ranges of expressions refer.
    fn source(self) -> &'t str {
        let shared = self.function.and_then(|function| function.shared);
        shared.unwrap_or(&self.text.source)
    }

    /// Returns one operation of an expression.
    pub fn operation(self, expression: &'t Expression, index: usize) -> Operation<'t> {
        let node = &expression.nodes[index];
        let operands = node.arguments();
        let [a, b] = [0, 1].map(|n| operands.get(n).copied().unwrap_or_default());
        let spans = [a, b].map(|operand| expression.spans[operand].clone());
        match node.op {
            Op::Number => Operation::Number {
                value: node.number,
                written: literal(self.source(), &expression.spans[index], node.number),
            },
            Op::Input => Operation::Name(node.index),
            Op::Element => Operation::Element { array: self.array(node.index), index: a },
            Op::Negate => match expression.ceiling(a) {
                Some(arguments) => Operation::Call { function: "ceil", arguments },
                None => Operation::Negate(a),
            },
            Op::Not => Operation::Not(a),
            Op::Call => Operation::Acceleration([a, b]),
            Op::Apply => self.call(&expression.nodes, node),
            op if operands.len() == 2 && a == b && name_of(op).is_none() && is_unequal(op) => {
                Operation::Call { function: "is_nan", arguments: &operands[..1] }
            }
            Op::Power => Operation::Call { function: "pow", arguments: operands },
            Op::If => Operation::Call { function: "if", arguments: operands },
            op => {
                // The reader turns `a > b` into `b < a`.
                let is_swapped = op.is_truth() && spans[0].start > spans[1].start;
                let infix = |swapped| {
                    let is_it = |infix: &&Infix| infix.op == op && infix.is_swapped == swapped;
                    INFIXES.iter().find(is_it)
                };
                let Some(infix) = infix(is_swapped).or_else(|| infix(false)) else {
                    let function = name_of(op).unwrap_or_default();
                    return Operation::Call { function, arguments: operands };
                };
                let [first, second] = if infix.is_swapped { [1, 0] } else { [0, 1] };
                let between = spans[first].end..spans[second].start;
                let between = self.source().get(between).unwrap_or_default();
                Operation::Infix {
                    sign: infix.sign,
                    level: infix.level,
                    operands: [[a, b][first], [a, b][second]],
                    breaks: between.contains('\n'),
                }
            }
        }
    }

    /// Returns the call of a function of the lines.
    fn call(self, nodes: &[Node], node: &Node) -> Operation<'t> {
        let function = &self.text.functions[node.index];
        let mut values = Vec::new();
        let mut next = node.arguments().first().copied();
        while let Some(at) = next {
            let [before @ .., value] = nodes[at].arguments() else { break };
            values.push(*value);
            next = before.first().copied();
        }
        let argument = |is_acceleration: &bool| if *is_acceleration { None } else { values.pop() };
        let arguments = function.inputs.iter().map(argument).collect();
        Operation::Own { function: &function.name, arguments }
    }

    /// Whether an operation stands in brackets of its own in the lines.
    pub fn is_bracketed(self, expression: &Expression, index: usize) -> bool {
        let text = self.source().get(expression.spans[index].clone()).unwrap_or_default();
        bracketed(text).is_some()
    }
}

/// Returns an expression without the brackets around all of it; `None` if it has none.
pub fn bracketed(text: &str) -> Option<&str> {
    let mut depth = 0;
    let closes = text.bytes().position(|byte| {
        depth += i32::from(byte == b'(') - i32::from(byte == b')');
        depth == 0
    });
    let inside = text.strip_prefix('(')?.strip_suffix(')')?;
    (closes == Some(text.len() - 1)).then_some(inside)
}

/// Operations on whole numbers whose value is whole.
const WHOLE: [Op; 4] = [Op::Add, Op::Subtract, Op::Multiply, Op::Negate];

/// Whether a number can be a whole one of 32 bits.
fn is_whole_literal(number: f64) -> bool {
    number.fract() == 0.0 && number.abs() < 1e9
}

/// Whether an operation is `!=`.
fn is_unequal(op: Op) -> bool {
    INFIXES.iter().any(|infix| infix.sign == "!=" && infix.op == op)
}

/// Returns the texts of a number in double and in single precision, if it is a literal that every language can read.
fn literal<'t>(source: &'t str, span: &Range<usize>, value: f64) -> Option<[&'t str; 2]> {
    let double = source.get(span.clone())?.trim_matches(['(', ')', ' ']);
    let is_plain = |text: &str| {
        let (whole, rest) =
            text.split_at(text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len()));
        !whole.is_empty()
            && rest.starts_with(['.', 'e'])
            && !rest.contains("E")
            && !text.ends_with('.')
    };
    if !is_plain(double) || double.contains(".e") || double.parse() != Ok(value) {
        return None;
    }
    let after = source[span.end..].strip_prefix('|');
    let single = after.map_or(double, |after| &after[..number_length(after.as_bytes()).0]);
    Some([double, single])
}

/// Returns the name of the function that an operation calls.
fn name_of(op: Op) -> Option<&'static str> {
    let is_it = |meaning: &Meaning| match (op, meaning) {
        (Op::Smooth(called), Meaning::Smooth(smooth)) => called == smooth,
        (Op::Switch(called), Meaning::Switch(switch)) => called == *switch,
        _ => false,
    };
    let mut functions = FUNCTIONS.iter().chain(&STEP_FUNCTIONS);
    functions.find(|function| is_it(&function.meaning)).map(|function| function.name)
}
