//! An expression, read from text in one pass: the names are looked up and the types are checked while
//! it is parsed.

use std::f64::consts::PI;
use std::ops::Range;

use super::op::{FUNCTIONS, Op, is_word};
use super::refusal::{Fault, Remedy, quoted};
use super::table::Table;
use super::token::{Token, tokens};

mod call;
mod nodes;

/// The most bytes of an expression: several lines of a file.
pub const MOST_BYTES: usize = 4096;

/// The most brackets, signs and functions within each other. The parser calls itself for each, about
/// ten calls deep.
pub const MOST_DEPTH: usize = 64;

/// The largest whole exponent that is written out as a product; a larger one is `libm::pow`'s.
const LARGEST_PRODUCT: u32 = 16;

/// One operation of an expression. Its arguments come before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) op: Op,
    pub(super) arguments: [usize; 3],
    /// The value of a number.
    pub(super) number: f64,
    /// The place of an input among the inputs, or of a table among the tables.
    pub(super) index: usize,
}

/// An expression whose value is a number.
#[derive(Clone, Debug, Default)]
pub(super) struct Expression {
    pub(super) nodes: Vec<Node>,
    /// The bytes of each node.
    pub(super) spans: Vec<Range<usize>>,
    pub(super) tables: Vec<Table>,
}

/// The names that an expression may use.
pub(super) trait Scope {
    /// The place of a name among the inputs.
    fn input(&self, name: &str) -> Option<usize>;
    /// All names.
    fn names(&self) -> Vec<String>;
    /// Why a name that other expressions may use cannot be used here.
    fn why_not(&self, name: &str) -> Option<String>;
}

/// Reads an expression. Its last node is its value.
pub(super) fn parse(text: &str, scope: &dyn Scope) -> Result<Expression, Fault> {
    if text.len() > MOST_BYTES {
        let what = format!("the expression has {} bytes", text.len());
        let end = text.floor_char_boundary(MOST_BYTES);
        return Err(Fault::new(end..text.len(), what, format!("keep at most {MOST_BYTES}")));
    }
    let tokens = tokens(text)?;
    let expression = Expression::default();
    let mut parser = Parser { text, tokens, next: 0, depth: 0, scope, expression };
    if parser.peek() == Token::End {
        return Err(Fault::new(0..text.len(), "the expression is empty", "write one"));
    }
    let value = parser.any()?;
    match parser.peek() {
        Token::End => {}
        Token::Symbol(")" | "]") => {
            let what = format!("`{}` closes nothing", parser.written());
            return Err(Fault::new(parser.span(), what, "remove it, or open it before"));
        }
        _ => return Err(parser.juxtaposed()),
    }
    parser.want_number(value)?;
    let mut expression = parser.expression;
    // The value of a name alone, or of a repeated part, need not be the last node.
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

    /// The bytes of the next token.
    fn span(&self) -> Range<usize> {
        self.tokens[self.next].1.clone()
    }

    fn written(&self) -> &str {
        &self.text[self.span()]
    }

    fn is_word(&self, word: &str) -> bool {
        self.peek() == Token::Name && self.written() == word
    }

    /// Takes the next token if it is this symbol.
    fn takes(&mut self, symbol: &str) -> bool {
        let is_it = matches!(self.peek(), Token::Symbol(found) if found == symbol);
        self.next += usize::from(is_it);
        is_it
    }

    fn expect(&mut self, symbol: &'static str, after: &str) -> Result<(), Fault> {
        if self.takes(symbol) {
            return Ok(());
        }
        if let Token::Name | Token::Number(_) | Token::Symbol("(") = self.peek()
            && symbol == ")"
        {
            return Err(self.juxtaposed());
        }
        let what = match self.peek() {
            Token::End => format!("the text ends where `{symbol}` is missing"),
            _ => format!("`{}` stands where `{symbol}` is missing", self.written()),
        };
        Err(Fault::new(self.here(), what, format!("write `{symbol}` after {after}")))
    }

    /// The next token follows a value without an operator.
    fn juxtaposed(&self) -> Fault {
        let what = format!("`{}` follows a complete expression", quoted(self.written()));
        Fault::new(self.span(), what, "write an operator before it, such as `*`")
    }

    /// The bytes of the next token; at the end of the text, the last character.
    fn here(&self) -> Range<usize> {
        match self.peek() {
            Token::End => {
                let last = self.text.trim_end().char_indices().next_back();
                last.map_or(0..0, |(at, c)| at..at + c.len_utf8())
            }
            _ => self.span(),
        }
    }

    /// One level deeper into brackets, signs or functions.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Fault>) -> Result<T, Fault> {
        if self.depth == MOST_DEPTH {
            let what = format!("the expression is nested more than {MOST_DEPTH} deep");
            return Err(Fault::new(self.here(), what, "use fewer brackets"));
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    fn any(&mut self) -> Result<usize, Fault> {
        let mut left = self.conjunction()?;
        while self.is_word("or") {
            self.next += 1;
            let right = self.conjunction()?;
            left = self.logical(Op::Or, left, right)?;
        }
        Ok(left)
    }

    fn conjunction(&mut self) -> Result<usize, Fault> {
        let mut left = self.negation()?;
        while self.is_word("and") {
            self.next += 1;
            let right = self.negation()?;
            left = self.logical(Op::And, left, right)?;
        }
        Ok(left)
    }

    fn logical(&mut self, op: Op, left: usize, right: usize) -> Result<usize, Fault> {
        let (left, right) = (self.want_truth(left)?, self.want_truth(right)?);
        Ok(self.push(op, &[left, right], self.span_of(left).start..self.span_of(right).end))
    }

    fn negation(&mut self) -> Result<usize, Fault> {
        if !self.is_word("not") {
            return self.comparison();
        }
        let start = self.span().start;
        self.next += 1;
        let operand = self.nested(Self::negation)?;
        let operand = self.want_truth(operand)?;
        Ok(self.push(Op::Not, &[operand], start..self.span_of(operand).end))
    }

    fn comparison(&mut self) -> Result<usize, Fault> {
        let left = self.sum()?;
        let Token::Symbol(symbol) = self.peek() else { return Ok(left) };
        let Some((op, is_swapped)) = comparison(symbol) else { return Ok(left) };
        self.next += 1;
        let right = self.sum()?;
        let (left, right) = (self.want_number(left)?, self.want_number(right)?);
        if let Token::Symbol(second) = self.peek()
            && comparison(second).is_some()
        {
            let what = format!("`{second}` follows another comparison");
            return Err(Fault::new(self.span(), what, "write `a < b and b < c`"));
        }
        let span = self.span_of(left).start..self.span_of(right).end;
        let operands = if is_swapped { [right, left] } else { [left, right] };
        Ok(self.push(op, &operands, span))
    }

    fn sum(&mut self) -> Result<usize, Fault> {
        self.binary(Self::product, |symbol| match symbol {
            "+" => Some(Op::Add),
            "-" => Some(Op::Subtract),
            _ => None,
        })
    }

    fn product(&mut self) -> Result<usize, Fault> {
        self.binary(Self::signed, |symbol| match symbol {
            "*" => Some(Op::Multiply),
            "/" => Some(Op::Divide),
            _ => None,
        })
    }

    /// Operands joined by operators of one precedence, from left to right.
    fn binary(
        &mut self,
        operand: impl Fn(&mut Self) -> Result<usize, Fault>,
        operator: impl Fn(&str) -> Option<Op>,
    ) -> Result<usize, Fault> {
        let mut left = operand(self)?;
        while let Token::Symbol(symbol) = self.peek()
            && let Some(op) = operator(symbol)
        {
            self.next += 1;
            let right = operand(self)?;
            let (a, b) = (self.want_number(left)?, self.want_number(right)?);
            left = self.push(op, &[a, b], self.span_of(a).start..self.span_of(b).end);
        }
        Ok(left)
    }

    fn signed(&mut self) -> Result<usize, Fault> {
        let start = self.span().start;
        if self.takes("-") {
            let operand = self.nested(Self::signed)?;
            let operand = self.want_number(operand)?;
            return Ok(self.push(Op::Negate, &[operand], start..self.span_of(operand).end));
        }
        if self.takes("+") {
            let operand = self.nested(Self::signed)?;
            return self.want_number(operand);
        }
        self.power()
    }

    fn power(&mut self) -> Result<usize, Fault> {
        let base = self.primary()?;
        if !self.takes("^") {
            return Ok(base);
        }
        let base = self.want_number(base)?;
        let exponent = self.nested(Self::signed)?;
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

    /// The magnitude of a whole number with or without a sign, and whether it is negative.
    fn whole(&self, node: usize) -> Option<(u32, bool)> {
        let nodes = &self.expression.nodes;
        let (node, is_negative) = match nodes[node].op {
            Op::Negate => (nodes[nodes[node].arguments[0]], true),
            _ => (nodes[node], false),
        };
        let is_small = node.number.fract() == 0.0 && node.number <= f64::from(LARGEST_PRODUCT);
        (node.op == Op::Number && is_small).then_some((node.number as u32, is_negative))
    }

    fn primary(&mut self) -> Result<usize, Fault> {
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
                Err(Fault::new(self.here(), "the expression ends in its middle", remedy))
            }
            Token::Symbol(symbol) => {
                let what = format!("`{symbol}` stands where a number or a name is missing");
                Err(Fault::new(span, what, "write one before it"))
            }
        }
    }

    /// A name, a function or a word.
    fn named(&mut self) -> Result<usize, Fault> {
        let (span, name) = (self.span(), self.written().to_owned());
        self.next += 1;
        if let Some(function) = FUNCTIONS.iter().find(|function| function.name == name) {
            if self.peek() != Token::Symbol("(") {
                let what = format!("`{name}` is a function");
                return Err(Fault::new(span, what, format!("write `{}`", function.usage)));
            }
            return self.call(function, span);
        }
        if let Some(input) = self.scope.input(&name) {
            if self.peek() == Token::Symbol("(") {
                let what = format!("`{name}` is no function");
                return Err(Fault::new(span, what, format!("write `{name}*(…)` for a product")));
            }
            let node = Node { op: Op::Input, arguments: [0; 3], number: 0.0, index: input };
            return Ok(self.node(node, span));
        }
        if name == "pi" {
            return Ok(self.number(PI, span));
        }
        if let Some(why) = self.scope.why_not(&name) {
            return Err(Fault::new(span, why, "remove it"));
        }
        if is_word(&name) {
            let what = format!("`{name}` stands where a number or a name is missing");
            return Err(Fault::new(span, what, "write one before it"));
        }
        let is_call = self.peek() == Token::Symbol("(");
        let functions = FUNCTIONS.iter().map(|function| function.name.to_owned());
        let known: Vec<String> = if is_call {
            functions.collect()
        } else {
            self.scope.names().into_iter().chain(["pi".to_owned()]).collect()
        };
        let noun = if is_call { "function" } else { "name" };
        let what = format!("unknown {noun} `{}`", quoted(&name));
        Err(Fault { span, what, remedy: Remedy::Name { written: name, known } })
    }
}

/// The operation of a comparison, and whether its operands change places.
fn comparison(symbol: &str) -> Option<(Op, bool)> {
    Some(match symbol {
        "<" => (Op::Less, false),
        "<=" => (Op::LessEqual, false),
        ">" => (Op::Less, true),
        ">=" => (Op::LessEqual, true),
        "==" => (Op::Equal, false),
        "!=" => (Op::NotEqual, false),
        _ => return None,
    })
}
