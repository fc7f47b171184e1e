//! Values as other languages write them: numbers of another type, a choice in braces, and a whole part by `| 0`.

use std::ops::Range;

use super::Parser;
use crate::fault::{Parsed, fault, quoted};
use crate::function::Function;
use crate::op::{Level, OPERATOR_WORDS};
use crate::token::{INPUT, Token};

/// The remedy for a turn by an angle at most.
const ROTATE: &str =
    "write the angle as a number: `rotation = rotate_toward(rotation, target, by)`, in radians";

/// Functions of more than one number, each with the lines that do the same to one.
const REMEDIES: [(&str, &str); 4] = [
    ("slerp", "write the angle as a number: `rotation = lerp_angle(rotation, target, part)`"),
    ("rotatetowards", ROTATE),
    ("movetowardsangle", ROTATE),
    ("smoothdampangle", "write the angle as a number that does not wrap: `SmoothDamp`"),
];

/// Words in the names of functions that read keys or a stick, and that make a vector.
const INPUTS: [&str; 6] = ["key", "press", "axis", "held", "button", "isdown"];
const VECTORS: [&str; 3] = ["vector", "vec2", "vec3"];
const ONE_COMPONENT: &str = "a step moves one number: write one component of the vector";

/// Returns the remedy for this function: how lines of one number do the same.
pub(super) fn remedy(function: &str) -> Option<&'static str> {
    let found = REMEDIES.iter().find(|(name, _)| name.eq_ignore_ascii_case(function));
    let name = function.to_ascii_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    let other = [(has(&VECTORS), ONE_COMPONENT), (has(&INPUTS), INPUT)];
    let other = other.iter().find(|(is_it, _)| *is_it);
    found.map(|(_, remedy)| *remedy).or(other.map(|(_, remedy)| *remedy))
}

/// Returns the function that makes a number of this type.
fn conversion(kind: &str) -> Option<&'static Function> {
    let kind = if ["Vector2", "Vector3"].contains(&kind) { "float" } else { kind };
    Function::named_in_steps(kind).filter(|function| ["float", "trunc"].contains(&function.name))
}

impl Parser<'_> {
    /// Reads `(float)x`, `static_cast<float>(x)` or Rust's `if c { a } else { b }`, if one stands here.
    pub(super) fn foreign_value(&mut self) -> Parsed<Option<usize>> {
        if !self.scope.is_step() {
            return Ok(None);
        }
        let span = self.span();
        let mut signs = [""; 5];
        for (sign, (token, span)) in signs.iter_mut().zip(&self.tokens[self.next..]) {
            *sign = if *token == Token::End { "" } else { &self.text[span.clone()] };
        }
        let is_name = |name: &str| self.scope.input(name).is_some();
        let length = match signs {
            ["if", after, ..] if after != "(" => return self.choice_in_braces().map(Some),
            ["static_cast", "<", _, ">", "("] => 4,
            ["(", kind, ")", next, _] if !is_name(kind) && conversion(kind).is_some() => {
                let is_operand = |c: char| c.is_ascii_alphanumeric() || "_(-.".contains(c);
                if !next.starts_with(is_operand) || OPERATOR_WORDS.contains(&next) {
                    return Ok(None);
                }
                3
            }
            _ => return Ok(None),
        };
        let kind = self.tokens[self.next + length - 2].1.clone();
        self.next += length;
        let operand = self.nested(|parser| parser.operand(Some(Level::Product)))?;
        self.as_kind(operand, kind, span.start).map(Some)
    }

    fn choice_in_braces(&mut self) -> Parsed<usize> {
        self.next += 1;
        let condition = self.nested(|parser| parser.operation(None))?;
        let first = self.in_braces("the condition")?;
        if self.sign() != "else" {
            return fault(self.here(), "`else` is missing", "write `if c { a } else { b }`");
        }
        self.next += 1;
        let second = match self.sign() {
            "if" => self.nested(Self::choice_in_braces)?,
            _ => self.in_braces("`else`")?,
        };
        self.choice(condition, first, second)
    }

    fn in_braces(&mut self, after: &str) -> Parsed<usize> {
        self.expect("{", after)?;
        let value = self.nested(Self::any)?;
        self.expect("}", "the value")?;
        Ok(value)
    }

    /// Reads Rust's `as f32` after a value.
    pub(super) fn converted(&mut self, mut value: usize) -> Parsed<usize> {
        while self.scope.is_step() && self.sign() == "as" {
            self.next += 1;
            let kind = self.span();
            self.next += usize::from(self.peek() != Token::End);
            let start = self.span_of(value).start;
            value = self.as_kind(value, kind, start)?;
        }
        Ok(value)
    }

    /// Returns a number as one of another type.
    fn as_kind(&mut self, value: usize, kind: Range<usize>, start: usize) -> Parsed<usize> {
        let value = self.want_number(value)?;
        let Some(function) = conversion(&self.text[kind.clone()]) else {
            let what = format!("`{}` is no type of a number", quoted(&self.text[kind.clone()]));
            return fault(kind, what, "remove it, or write `trunc(x)` for an integer");
        };
        let end = self.tokens[self.next - 1].1.end;
        Ok(self.written(function, &[value], &(start..end)))
    }

    /// Reads JavaScript's `| 0` after a value.
    pub(super) fn truncated(&mut self, value: usize) -> Parsed<usize> {
        let sign = self.span();
        if !self.consume_if("|") {
            return Ok(value);
        }
        if self.peek() != Token::Number(0.0) {
            return fault(sign, "`|` has no meaning here", "write `or`");
        }
        self.next += 1;
        let value = self.want_number(value)?;
        let trunc = Function::named_in_steps("trunc").expect("a row of the table");
        let span = self.span_of(value).start..self.tokens[self.next - 1].1.end;
        Ok(self.written(trunc, &[value], &span))
    }
}
