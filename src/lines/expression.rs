//! An expression, read from text in one pass. The parser looks up names and checks types as it goes.

use std::collections::HashSet;
use std::f64::consts::PI;
use std::ops::Range;

use super::fault::{ExpressionFault, Parsed, Remedy, fault, quoted};
use super::function::{FUNCTIONS, Function, STEP_FUNCTIONS};
use super::op::{INFIXES, Infix, Level, OPERATOR_WORDS, Op, WRITTEN, is_word};
use super::switch::{ModeRule, Switch};
use super::token::{Token, tokens};
use crate::curve::Curve;

mod call;
mod foreign;

pub use call::MAX_POINTS;

/// The maximum number of bytes of an expression, which is several lines of a file.
pub const MAX_BYTES: usize = 4096;

/// The deepest nesting of brackets, signs and functions. The parser calls itself for each level, about ten calls deep.
pub const MAX_DEPTH: usize = 64;

/// The largest whole exponent that becomes a product. A power with a larger exponent is computed by `libm::pow`.
const MAX_PRODUCT: u32 = 16;

/// One operation of an expression. The nodes of its arguments precede it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) op: Op,
    operands: [usize; 3],
    count: usize,
    /// The value of the node, if it is a number.
    pub(super) number: f64,
    /// The index of an input among the inputs, or of a table among the tables.
    pub(super) index: usize,
}

impl Node {
    /// Returns an operation on the nodes `arguments`.
    pub(super) fn new(op: Op, arguments: &[usize]) -> Self {
        let mut operands = [0; 3];
        operands[..arguments.len()].copy_from_slice(arguments);
        Self { op, operands, count: arguments.len(), number: 0.0, index: 0 }
    }

    fn leaf(op: Op) -> Self {
        Self::new(op, &[])
    }

    /// Returns the node for the value of the input with this index.
    pub(super) fn input(index: usize) -> Self {
        Self { index, ..Self::leaf(Op::Input) }
    }

    /// Returns the same operation, for nodes appended after `before` others.
    pub(super) fn after(self, before: usize) -> Self {
        self.reading(|operand| operand + before)
    }

    /// Returns the same operation, with other nodes as arguments.
    pub(super) fn reading(self, other: impl Fn(usize) -> usize) -> Self {
        let mut operands = self.operands;
        operands[..self.count].iter_mut().for_each(|operand| *operand = other(*operand));
        Self { operands, ..self }
    }

    /// Returns the indices of the nodes that are its arguments.
    pub(super) fn arguments(&self) -> &[usize] {
        &self.operands[..self.count]
    }
}

/// An expression whose value is a number.
#[derive(Clone, Debug, Default)]
pub struct Expression {
    pub(super) nodes: Vec<Node>,
    /// The byte range of each node in the text.
    pub(super) spans: Vec<Range<usize>>,
    pub(super) tables: Vec<Curve>,
}

/// The names that an expression may use.
pub trait Scope {
    /// Returns the index of a name among the inputs.
    fn input(&self, name: &str) -> Option<usize>;
    /// Returns all names that the expression may use.
    fn names(&self) -> Vec<String>;
    /// Returns the reason why this name, which other expressions may use, is not allowed here.
    fn why_not(&self, name: &str) -> Option<String>;
    /// Returns the value of a constant that every expression knows.
    fn constant(&self, name: &str) -> Option<f64> {
        (name == "pi").then_some(PI)
    }
    /// Returns the index of a function of the text, and whether each of its inputs is the acceleration.
    fn own_function(&self, _name: &str) -> Option<(usize, Vec<bool>)> {
        None
    }
    /// Returns the index of an array of the text.
    fn array(&self, _name: &str) -> Option<usize> {
        None
    }
    /// Whether a call of this name is a call of the acceleration.
    fn is_acceleration(&self, _name: &str) -> bool {
        false
    }
    /// Returns the function with this name.
    fn function(&self, name: &str) -> Option<&'static Function> {
        Function::named(name)
    }
    /// Returns the function with this name that takes this number of arguments.
    fn overload(&self, _name: &str, _count: usize) -> Option<&'static Function> {
        None
    }
    /// Whether the expression may have the signs and the methods of other languages, such as `&&` and `x.abs()`.
    fn is_step(&self) -> bool {
        false
    }
}

/// Reads an expression. Its last node is the value.
///
/// # Errors
/// The first fault of the text.
pub fn parse(text: &str, scope: &dyn Scope) -> Parsed<Expression> {
    parse_as(text, scope, |parser, value| parser.want_number(value))
}

/// Reads a condition. Its last node is the value.
pub(super) fn parse_condition(text: &str, scope: &dyn Scope) -> Parsed<Expression> {
    parse_as(text, scope, |parser, value| parser.want_truth(value))
}

fn parse_as(
    text: &str,
    scope: &dyn Scope,
    want: fn(&Parser<'_>, usize) -> Parsed<usize>,
) -> Parsed<Expression> {
    if text.len() > MAX_BYTES {
        let what = format!("the expression has {} bytes", text.len());
        let end = text.floor_char_boundary(MAX_BYTES);
        return fault(end..text.len(), what, format!("keep at most {MAX_BYTES}"));
    }
    let tokens = tokens(text, scope.is_step())?;
    let expression = Expression::default();
    let mut parser = Parser { text, tokens, next: 0, depth: 0, scope, expression };
    if parser.peek() == Token::End {
        return fault(0..text.len(), "the expression is empty", "write one");
    }
    let value = parser.any()?;
    match parser.peek() {
        Token::End => {}
        Token::Symbol(")" | "]") => {
            let what = format!("`{}` closes nothing", parser.token_text());
            return fault(parser.span(), what, "remove it, or open it before");
        }
        _ => return Err(parser.juxtaposed()),
    }
    want(&parser, value)?;
    parser.want_finite(value)?;
    let mut expression = parser.expression;
    // If the value is a single name or a repeated part, it need not be the last node.
    if value + 1 != expression.nodes.len() {
        let (node, span) = (expression.nodes[value], expression.spans[value].clone());
        expression.nodes.push(node);
        expression.spans.push(span);
    }
    Ok(expression)
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<(Token, Range<usize>)>,
    next: usize,
    depth: usize,
    scope: &'a dyn Scope,
    expression: Expression,
}

impl Parser<'_> {
    fn peek(&self) -> Token {
        self.tokens[self.next].0
    }

    /// Returns the byte range of the next token.
    fn span(&self) -> Range<usize> {
        self.tokens[self.next].1.clone()
    }

    fn token_text(&self) -> &str {
        &self.text[self.span()]
    }

    /// Returns the next token if it is a symbol or a word; empty otherwise.
    fn sign(&self) -> &str {
        match self.peek() {
            Token::Symbol(symbol) => symbol,
            Token::Name => self.token_text(),
            Token::Number(_) | Token::End => "",
        }
    }

    /// Consumes the next token if it is this symbol.
    fn consume_if(&mut self, symbol: &str) -> bool {
        let is_it = matches!(self.peek(), Token::Symbol(found) if found == symbol);
        self.next += usize::from(is_it);
        is_it
    }

    fn expect(&mut self, symbol: &'static str, after: &str) -> Parsed<()> {
        if self.consume_if(symbol) {
            return Ok(());
        }
        if let Token::Name | Token::Number(_) | Token::Symbol("(") = self.peek()
            && symbol == ")"
        {
            return Err(self.juxtaposed());
        }
        let what = match self.peek() {
            Token::End => format!("the text ends where `{symbol}` is missing"),
            _ => format!("`{}` stands where `{symbol}` is missing", self.token_text()),
        };
        fault(self.here(), what, format!("write `{symbol}` after {after}"))
    }

    /// Returns the fault of a token that follows a value without an operator.
    fn juxtaposed(&self) -> ExpressionFault {
        let what = format!("`{}` follows a complete expression", quoted(self.token_text()));
        ExpressionFault::new(self.span(), what, "write an operator before it, such as `*`")
    }

    /// Returns the byte range of the next token, or that of the last character at the end of the text.
    fn here(&self) -> Range<usize> {
        match self.peek() {
            Token::End => {
                let last = self.text.trim_end().char_indices().next_back();
                last.map_or(0..0, |(at, c)| at..at + c.len_utf8())
            }
            _ => self.span(),
        }
    }

    /// Reads one level deeper into brackets, signs or functions.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth == MAX_DEPTH {
            let what = format!("the expression is nested more than {MAX_DEPTH} deep");
            return fault(self.here(), what, "use fewer brackets");
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    /// Reads an expression, which in a step may choose: `c ? a : b`, or `a if c else b`.
    fn any(&mut self) -> Parsed<usize> {
        let value = self.operation(None)?;
        let value = self.truncated(value)?;
        if self.consume_if("?") {
            let first = self.nested(Self::any)?;
            self.expect(":", "the first of two values")?;
            let second = self.nested(Self::any)?;
            return self.choice(value, first, second);
        }
        if !self.scope.is_step() || self.sign() != "if" {
            return Ok(value);
        }
        self.next += 1;
        let condition = self.nested(|parser| parser.operation(None))?;
        if self.sign() != "else" {
            return fault(self.here(), "`else` is missing", "write `a if c else b`");
        }
        self.next += 1;
        let second = self.nested(Self::any)?;
        self.choice(condition, value, second)
    }

    fn choice(&mut self, condition: usize, first: usize, second: usize) -> Parsed<usize> {
        let all =
            [self.want_truth(condition)?, self.want_number(first)?, self.want_number(second)?];
        let starts = all.map(|node| self.span_of(node).start);
        let start = starts.into_iter().fold(usize::MAX, usize::min);
        Ok(self.push(Op::If, &all, start..self.span_of(second).end))
    }

    /// Reads operands joined by operators that bind more tightly than the level `outside`.
    fn operation(&mut self, outside: Option<Level>) -> Parsed<usize> {
        let mut left = self.operand(outside)?;
        while let Some(infix) = self.infix().filter(|infix| Some(infix.level) > outside) {
            if infix.op == Op::Power {
                left = self.raised(left)?;
                continue;
            }
            let is_word = self.peek() == Token::Name && self.scope.is_step();
            self.next += 1;
            let right = self.operation(Some(infix.level))?;
            // Lua's choice: `c and a or b`.
            if is_word && infix.op == Op::And && !self.is_truth(right) && self.sign() == "or" {
                self.next += 1;
                let other = self.operation(Some(Level::Or))?;
                left = self.choice(left, right, other)?;
                continue;
            }
            if let Some((_, function)) = WRITTEN.iter().find(|(it, _)| it.sign == infix.sign) {
                let operands = [self.want_number(left)?, self.want_number(right)?];
                let span = self.span_of(left).start..self.span_of(right).end;
                let function = Function::named_in_steps(function).expect("a row of the table");
                left = self.written(function, &operands, &span);
                continue;
            }
            for operand in [left, right] {
                match infix.op {
                    Op::And | Op::Or => self.want_truth(operand)?,
                    _ => self.want_number(operand)?,
                };
            }
            if infix.level == Level::Comparison
                && let Some(second) = self.infix().filter(|second| second.level == infix.level)
            {
                let what = format!("`{}` follows another comparison", second.sign);
                return fault(self.span(), what, "write `a < b and b < c`");
            }
            let span = self.span_of(left).start..self.span_of(right).end;
            let operands = if infix.is_swapped { [right, left] } else { [left, right] };
            left = self.push(infix.op, &operands, span);
        }
        Ok(left)
    }

    /// Returns the next token as an operator, if it is one.
    fn infix(&self) -> Option<&'static Infix> {
        let sign = self.sign();
        let mut written = WRITTEN.iter().map(|(infix, _)| infix).filter(|_| self.scope.is_step());
        let found = INFIXES.iter().find(|infix| infix.sign == sign);
        found.or_else(|| written.find(|infix| infix.sign == sign))
    }

    /// Reads the first operand of operators that bind more tightly than the level `outside`.
    fn operand(&mut self, outside: Option<Level>) -> Parsed<usize> {
        let start = self.span().start;
        if outside <= Some(Level::And) && self.sign() == "not" {
            self.next += 1;
            let operand = self.nested(|parser| parser.operation(Some(Level::And)))?;
            let operand = self.want_truth(operand)?;
            return Ok(self.push(Op::Not, &[operand], start..self.span_of(operand).end));
        }
        let is_negated = self.consume_if("-");
        if !is_negated && !self.consume_if("+") {
            return self.methods();
        }
        let operand = self.nested(|parser| parser.operation(Some(Level::Product)))?;
        let operand = self.want_number(operand)?;
        if !is_negated {
            return Ok(operand);
        }
        Ok(self.push(Op::Negate, &[operand], start..self.span_of(operand).end))
    }

    /// Reads the power of `base`, starting at the sign `^`. Powers group to the right.
    fn raised(&mut self, base: usize) -> Parsed<usize> {
        self.next += 1;
        let base = self.want_number(base)?;
        let exponent = self.nested(|parser| parser.operation(Some(Level::Product)))?;
        let exponent = self.want_number(exponent)?;
        let span = self.span_of(base).start..self.span_of(exponent).end;
        let Some((times, is_inverse)) = self.whole(exponent) else {
            return Ok(self.push(Op::Power, &[base, exponent], span));
        };
        let mut product = base;
        for _ in 1..times {
            product = self.push(Op::Multiply, &[product, base], span.clone());
        }
        if times == 0 {
            product = self.number(1.0, span.clone());
        }
        if is_inverse {
            let one = self.number(1.0, span.clone());
            product = self.push(Op::Divide, &[one, product], span);
        }
        Ok(product)
    }

    /// Returns the magnitude of a small whole number, and whether it is negative; `None` if the node is no such number.
    fn whole(&self, node: usize) -> Option<(u32, bool)> {
        let nodes = &self.expression.nodes;
        let (node, is_negative) = match nodes[node].op {
            Op::Negate => (nodes[nodes[node].operands[0]], true),
            _ => (nodes[node], false),
        };
        let is_small = node.number.fract() == 0.0 && node.number <= f64::from(MAX_PRODUCT);
        (node.op == Op::Number && is_small).then_some((node.number as u32, is_negative))
    }

    /// Reads a value and the methods that are called on it, such as `(v * dt).abs()`.
    fn methods(&mut self) -> Parsed<usize> {
        let foreign = self.foreign_value()?;
        let mut value = foreign.map_or_else(|| self.primary(), Ok)?;
        while self.consume_if(".") {
            let (span, name) = (self.span(), self.token_text().to_owned());
            self.next += 1;
            if self.peek() != Token::Symbol("(") {
                let what = format!("`{}` is one part of a value", quoted(&name));
                let remedy =
                    "a step moves one number: write `x` for its position and `v` for its velocity";
                return fault(span, what, remedy);
            }
            let Some(function) = self.scope.function(&name) else {
                return Err(self.unknown(span, name, "function"));
            };
            let receiver = self.want_number(value)?;
            value = self.call(function, span, Some(receiver))?;
        }
        self.converted(value)
    }

    fn primary(&mut self) -> Parsed<usize> {
        let span = self.span();
        match self.peek() {
            Token::Number(number) => {
                self.next += 1;
                Ok(self.number(number, span))
            }
            Token::Symbol("(") => {
                self.next += 1;
                let inner = self.nested(Self::any)?;
                self.expect(")", "the part in brackets")?;
                self.expression.spans[inner] = span.start..self.tokens[self.next - 1].1.end;
                Ok(inner)
            }
            Token::Name => self.named(),
            Token::End => {
                let remedy = "write a number, a name or a bracket at the end";
                fault(self.here(), "the expression ends in its middle", remedy)
            }
            Token::Symbol(symbol) => {
                let what = format!("`{symbol}` stands where a number or a name is missing");
                fault(span, what, "write one before it")
            }
        }
    }

    /// Reads a name, a function or a word.
    fn named(&mut self) -> Parsed<usize> {
        let (span, name) = (self.span(), self.token_text().to_owned());
        self.next += 1;
        let is_call = self.peek() == Token::Symbol("(");
        if is_call && self.scope.is_acceleration(&name) {
            return self.acceleration(span);
        }
        if is_call && let Some((index, inputs)) = self.scope.own_function(&name) {
            return self.apply(span, index, &inputs);
        }
        if let Some(array) = self.scope.array(&name) {
            self.expect("[", "the name of an array")?;
            let index = self.nested(Self::any)?;
            let index = self.want_number(index)?;
            self.expect("]", "the index")?;
            let node = self.push(Op::Element, &[index], span);
            self.expression.nodes[node].index = array;
            return Ok(node);
        }
        let function = self.scope.function(&name);
        if let Some(function) = function.filter(|_| is_call || self.scope.input(&name).is_none()) {
            if !is_call {
                let what = format!("`{name}` is a function");
                return fault(span, what, format!("write `{}`", function.usage()));
            }
            return self.call(function, span, None);
        }
        if let Some(input) = self.scope.input(&name) {
            if self.peek() == Token::Symbol("(") {
                let what = format!("`{name}` is no function");
                return fault(span, what, format!("write `{name}*(…)` for a product"));
            }
            return Ok(self.node(Node::input(input), span));
        }
        if let Some(value) = self.scope.constant(&name) {
            return Ok(self.number(value, span));
        }
        if let Some(why) = self.scope.why_not(&name) {
            return fault(span, why, "remove it");
        }
        let is_step = self.scope.is_step();
        if is_word(&name) && (!is_step || OPERATOR_WORDS.contains(&&*name)) {
            let what = format!("`{name}` stands where a number or a name is missing");
            return fault(span, what, "write one before it");
        }
        Err(self.unknown(span, name, if is_call { "function" } else { "name" }))
    }

    /// Returns the fault of an unknown function or name.
    fn unknown(&self, span: Range<usize>, name: String, noun: &str) -> ExpressionFault {
        let functions = FUNCTIONS.iter().chain(&STEP_FUNCTIONS).map(|function| function.name);
        let functions = functions.filter(|name| self.scope.function(name).is_some());
        if let Some(remedy) = foreign::remedy(&name).filter(|_| self.scope.is_step()) {
            let what = format!("unknown {noun} `{}`", quoted(&name));
            return ExpressionFault::new(span, what, remedy);
        }
        let mut known: Vec<String> = if noun == "function" {
            functions.map(str::to_owned).collect()
        } else {
            self.scope.names().into_iter().chain(["pi".to_owned()]).collect()
        };
        // A function has a row for each number of its arguments.
        let mut all = HashSet::new();
        known.retain(|name| all.insert(name.clone()));
        let what = format!("unknown {noun} `{}`", quoted(&name));
        ExpressionFault { span, what, remedy: Remedy::Name { written: name, known } }
    }
}

impl Parser<'_> {
    fn push(&mut self, op: Op, arguments: &[usize], span: Range<usize>) -> usize {
        self.node(Node::new(op, arguments), span)
    }

    fn node(&mut self, node: Node, span: Range<usize>) -> usize {
        self.expression.nodes.push(node);
        self.expression.spans.push(span);
        self.expression.nodes.len() - 1
    }

    /// Adds an operation, unless it is a limit at infinity. Such a limit leaves its operand unchanged.
    fn limit(&mut self, node: Node, span: Range<usize>) -> usize {
        let nodes = &self.expression.nodes;
        let number = |index: usize| match (nodes[index].op, nodes[index].arguments()) {
            (Op::Number, _) => nodes[index].number,
            (Op::Negate, [inner]) if nodes[*inner].op == Op::Number => -nodes[*inner].number,
            _ => 0.0,
        };
        let far = match node.op {
            Op::Switch(Switch { pieces: ModeRule::Less, .. }) => f64::INFINITY,
            Op::Switch(Switch { pieces: ModeRule::Greater, .. }) => f64::NEG_INFINITY,
            _ => return self.node(node, span),
        };
        match *node.arguments() {
            [a, b] if number(b) == far => a,
            [a, b] if number(a) == far => b,
            _ => self.node(node, span),
        }
    }

    /// Refuses a value that depends on an infinite number.
    fn want_finite(&self, value: usize) -> Parsed<()> {
        let nodes = &self.expression.nodes;
        let mut is_read = vec![false; value + 1];
        is_read[value] = true;
        for index in (0..=value).rev() {
            if is_read[index] && nodes[index].number.is_infinite() {
                let span = self.span_of(index);
                let what = format!("`{}` is no limit here", quoted(&self.text[span.clone()]));
                return fault(span, what, "leave it out, or write a large number: `1e9`");
            }
            if is_read[index] {
                for operand in nodes[index].arguments() {
                    is_read[*operand] = true;
                }
            }
        }
        Ok(())
    }

    fn number(&mut self, number: f64, span: Range<usize>) -> usize {
        self.node(Node { number, ..Node::leaf(Op::Number) }, span)
    }

    fn span_of(&self, node: usize) -> Range<usize> {
        self.expression.spans[node].clone()
    }

    fn is_truth(&self, node: usize) -> bool {
        self.expression.nodes[node].op.is_truth()
    }

    fn want_number(&self, node: usize) -> Parsed<usize> {
        if !self.is_truth(node) {
            return Ok(node);
        }
        let span = self.span_of(node);
        let what = format!("`{}` is true or false, not a number", quoted(&self.text[span.clone()]));
        fault(span, what, "write `if(condition, 1, 0)` for a number")
    }

    fn want_truth(&self, node: usize) -> Parsed<usize> {
        if self.is_truth(node) {
            return Ok(node);
        }
        let span = self.span_of(node);
        let what = format!("`{}` is a number, not a condition", quoted(&self.text[span.clone()]));
        fault(span, what, "compare it, such as `x > 0`")
    }
}
