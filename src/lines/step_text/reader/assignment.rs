//! Reads assignments.

use std::ops::Range;

use super::{DAMPED_PLACE, Reader};
use crate::expression::{Expression, Node, Scope};
use crate::fault::{Parsed, fault, quoted};
use crate::op::Op;
use crate::step_text::{Declares, Line, X};

impl Reader<'_> {
    /// Assigns the place that `SmoothDamp` leaves, and its velocity.
    pub(super) fn assign_damped(
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
        self.assign(damped, name.clone(), ("", None), place, value.clone())?;
        self.assign(v, velocity, ("", None), speed?, value.clone())?;
        let mut read = Expression::default();
        read.nodes.push(Node::input(damped));
        read.spans.push(0..0);
        self.assign(x, name, (joins, None), read, value)
    }

    pub(super) fn assign(
        &mut self,
        index: usize,
        name: Range<usize>,
        (joins, declares): (&'static str, Option<Declares>),
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
        if self.inputs.iter().any(|taken| taken.name == Some(index) && !self.is_function) {
            return fault(name, "a step cannot change its setting", "give it another name");
        }
        let found = match self.is_method() {
            true => {
                self.note_reads(&expression);
                0
            }
            false => self.splice(&expression),
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
                    self.lines.push(Line::Assign {
                        name: index,
                        joins,
                        value: expression,
                        declares,
                    });
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
        self.lines.push(Line::Assign { name: index, joins, value: expression, declares });
        self.check_length(name)
    }
}
