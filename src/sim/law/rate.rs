//! The second-order form of equations of first order, by the chain rule.

use super::compile::PartScope;
use super::expression::{Expression, MAX_BYTES, parse};
use super::fault::Part;
use super::op::Op;
use super::step_text::bracketed;
use super::{At, Equations, FIRST_COORDINATE, LawText, Registers, T};

/// The maximum number of operations of a rate whose derivative is written. Nested powers have many in a short text.
const MAX_OPERATIONS_DERIVED: f64 = 200.0;

/// The second-order form of a coordinate of first order.
pub struct SecondOrder {
    /// The acceleration; `None` if a part of the rate has no derivative here.
    pub acceleration: Option<String>,
    /// The velocity at the start.
    pub start_velocity: f64,
}

/// Returns the second-order form of each coordinate of `law`, in which each acceleration is in truth a rate. `values`
/// are those of the law. In its own acceleration a coordinate's rate is its velocity, so that a lag becomes a drag.
///
/// Returns `None` if the rates have a fault.
pub fn second_order(law: &LawText, values: &[f64]) -> Option<Vec<SecondOrder>> {
    let equations = Equations::new(law.clone()).ok()?;
    let n = law.coordinates.len();
    let mut rates = vec![0.0; n];
    let (q, v) = (&values[law.constants.len()..][..n], &vec![0.0; n]);
    let at = At { t: 0.0, steering: [0.0; 2], q, v };
    equations.accelerate(&mut Registers::new(&equations, values), at, &mut rates);
    let form = |(of, start_velocity): (usize, f64)| {
        let text = &law.coordinates[of].acceleration;
        let rate = parse(text, &PartScope { text: law, part: Part::Acceleration(of) }).ok()?;
        let is_short = operations(&rate) <= MAX_OPERATIONS_DERIVED;
        let slope = Rate { law, text, rate: &rate, of };
        let slope = is_short.then(|| slope.slope(rate.nodes.len() - 1)).flatten();
        let acceleration = slope.map(|slope| slope.unwrap_or_else(|| "0".into()));
        let acceleration = acceleration.filter(|text| text.len() <= MAX_BYTES);
        Some(SecondOrder { acceleration, start_velocity })
    };
    rates.into_iter().enumerate().map(form).collect()
}

/// Returns the number of operations of an expression in which no part is shared.
fn operations(expression: &Expression) -> f64 {
    let mut sizes: Vec<f64> = Vec::new();
    for node in &expression.nodes {
        sizes.push(1.0 + node.arguments().iter().map(|operand| sizes[*operand]).sum::<f64>());
    }
    sizes.last().copied().unwrap_or_default()
}

/// An expression; `None` for zero.
type Term = Option<String>;

/// The rate of the coordinate with index `of`.
struct Rate<'a> {
    law: &'a LawText,
    text: &'a str,
    rate: &'a Expression,
    of: usize,
}

impl Rate<'_> {
    /// Returns the derivative of a node by time; `None` if it has none here.
    fn slope(&self, node: usize) -> Option<Term> {
        let operand = |n: usize| self.rate.nodes[node].arguments()[n];
        let value = |n: usize| Some(self.written(operand(n)));
        let slope = |n: usize| self.slope(operand(n));
        Some(match self.rate.nodes[node].op {
            Op::Number => None,
            Op::Input => self.slope_of_input(self.rate.nodes[node].index)?,
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

    fn slope_of_input(&self, slot: usize) -> Option<Term> {
        let coordinates = &self.law.coordinates;
        match slot.checked_sub(FIRST_COORDINATE).filter(|index| *index < coordinates.len()) {
            Some(index) if index == self.of => Some(Some(format!("v{}", coordinates[index].name))),
            Some(index) => Some(Some(coordinates[index].acceleration.clone())),
            None if slot == T => Some(Some("1".into())),
            None => self.law.slots_of_constants().contains(&slot).then_some(None),
        }
    }

    /// Returns the name of the function of a node.
    fn function(&self, node: usize) -> &str {
        let text = &self.text[self.rate.spans[node].clone()];
        text.trim_start_matches(['(', ' ']).split(['(', ' ']).next().unwrap_or_default()
    }

    /// Returns the text of a node. A whole power is a product of nodes that share one text.
    fn written(&self, node: usize) -> String {
        let of = self.rate.nodes[node];
        let value = |n: usize| self.written(of.arguments()[n]);
        let infix = |sign: &str| joined(Some(value(0)), sign, Some(value(1))).unwrap_or_default();
        match of.op {
            Op::Multiply => infix("*"),
            Op::Divide => infix("/"),
            Op::Number => of.number.to_string(),
            _ => self.text[self.rate.spans[node].clone()].to_owned(),
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
