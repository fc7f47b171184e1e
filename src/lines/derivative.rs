//! The derivative of an expression as text, by the chain rule.

use super::expression::Expression;
use super::op::Op;
use super::step_text::bracketed;

/// The maximum number of operations of an expression whose derivative is written. Nested powers have many in a short
/// text.
const MAX_OPERATIONS_DERIVED: f64 = 200.0;

/// An expression as text; `None` for zero.
pub type Term = Option<String>;

/// Returns the derivative of the expression with this text. `of_input` returns that of each input. Returns `None` if
/// the expression is too long, or if a part of it has no derivative here.
pub fn derivative(
    text: &str,
    of: &Expression,
    of_input: &dyn Fn(usize) -> Option<Term>,
) -> Option<Term> {
    let is_short = operations(of) <= MAX_OPERATIONS_DERIVED;
    let derivative = Derivative { text, of, of_input };
    is_short.then(|| derivative.slope(of.nodes.len() - 1)).flatten()
}

/// Returns the number of operations of an expression in which no part is shared.
fn operations(expression: &Expression) -> f64 {
    let mut sizes: Vec<f64> = Vec::new();
    for node in &expression.nodes {
        sizes.push(1.0 + node.arguments().iter().map(|operand| sizes[*operand]).sum::<f64>());
    }
    sizes.last().copied().unwrap_or_default()
}

/// The derivative in the making.
struct Derivative<'a> {
    text: &'a str,
    of: &'a Expression,
    of_input: &'a dyn Fn(usize) -> Option<Term>,
}

impl Derivative<'_> {
    /// Returns the derivative of a node; `None` if it has none here.
    fn slope(&self, node: usize) -> Option<Term> {
        let operand = |n: usize| self.of.nodes[node].arguments()[n];
        let value = |n: usize| Some(self.written(operand(n)));
        let slope = |n: usize| self.slope(operand(n));
        Some(match self.of.nodes[node].op {
            Op::Number => None,
            Op::Input => (self.of_input)(self.of.nodes[node].index)?,
            Op::Negate => joined(None, "-", slope(0)?),
            Op::Add => joined(slope(0)?, "+", slope(1)?),
            Op::Subtract => joined(slope(0)?, "-", slope(1)?),
            Op::Multiply => {
                let first = joined(slope(0)?, "*", value(1));
                joined(first, "+", joined(value(0), "*", slope(1)?))
            }
            Op::Divide => {
                let ratio = joined(joined(value(0), "*", slope(1)?), "/", value(1));
                joined(joined(slope(0)?, "-", ratio), "/", value(1))
            }
            Op::Smooth(_) => {
                let call = |name| Some(format!("{name}({})", self.written(operand(0))));
                let slope = slope(0)?;
                match self.function(node) {
                    "sin" => joined(call("cos"), "*", slope),
                    "cos" => joined(None, "-", joined(call("sin"), "*", slope)),
                    "exp" => joined(call("exp"), "*", slope),
                    "ln" => joined(slope, "/", value(0)),
                    "sqrt" => joined(slope, "/", Some(format!("2*{}", call("sqrt")?))),
                    _ => return None,
                }
            }
            _ => return None,
        })
    }

    /// Returns the name of the function of a node.
    fn function(&self, node: usize) -> &str {
        let text = &self.text[self.of.spans[node].clone()];
        text.trim_start_matches(['(', ' ']).split(['(', ' ']).next().unwrap_or_default()
    }

    /// Returns the text of a node. A whole power is a product of nodes that share one text.
    fn written(&self, node: usize) -> String {
        let of = self.of.nodes[node];
        let value = |n: usize| self.written(of.arguments()[n]);
        let infix = |sign: &str| joined(Some(value(0)), sign, Some(value(1))).unwrap_or_default();
        match of.op {
            Op::Multiply => infix("*"),
            Op::Divide => infix("/"),
            Op::Number => of.number.to_string(),
            _ => self.text[self.of.spans[node].clone()].to_owned(),
        }
    }
}

/// Joins two terms by an operator, in brackets where they need them.
fn joined(left: Term, sign: &str, right: Term) -> Term {
    let is_sum = sign == "+" || sign == "-";
    match (left, right) {
        (Some(left), None) if is_sum => Some(left),
        (None, Some(right)) if sign == "+" => Some(right),
        (None, Some(right)) if sign == "-" => Some(format!("-{}", closed(&right))),
        (Some(left), Some(right)) if is_sum => {
            let right = if sign == "+" { right } else { closed(&right) };
            Some(format!("{left} {sign} {right}"))
        }
        (Some(one), Some(other)) if sign == "*" && one == "1" => Some(other),
        (Some(other), Some(one)) if one == "1" => Some(other),
        (Some(left), Some(right)) => Some(format!("{}{sign}{}", closed(&left), closed(&right))),
        _ => None,
    }
}

/// Returns an expression that any operator may follow.
fn closed(text: &str) -> String {
    let name = text.find('(').unwrap_or(text.len());
    let is_name =
        text[..name].chars().all(|letter| letter.is_alphanumeric() || "_.".contains(letter));
    let is_closed = is_name && (name == text.len() || bracketed(&text[name..]).is_some());
    if is_closed { text.to_owned() } else { format!("({text})") }
}
