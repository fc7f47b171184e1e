//! The values of names while the lines of a step are read, and the operations of a rule.

use std::f64::consts::PI;
use std::ops::Range;

use super::{Block, Reader};
use crate::expression::{Expression, Node};
use crate::fault::{Parsed, fault};
use crate::op::Op;
use crate::step_text::{BUILT_IN, V};
use crate::tape::MAX_OPERATIONS;

/// Names of constants in games. A limit may be infinite, and a component of a zero vector is 0.
pub(super) const CONSTANTS: [(&[&str], f64); 4] = [
    (&["pi", "PI"], PI),
    (&["nan"], f64::NAN),
    (
        &[
            "infinity",
            "Infinity",
            "INFINITY",
            "inf",
            "INF",
            "huge",
            "positiveInfinity",
            "PositiveInfinity",
            "positive_infinity",
        ],
        f64::INFINITY,
    ),
    (&["zero", "zeroVector"], 0.0),
];

impl Reader<'_> {
    /// Notes that a method reads these names, of which those without a value are carried.
    pub(super) fn note_reads(&mut self, expression: &Expression) {
        let inputs = expression.nodes.iter().filter(|node| node.op == Op::Input);
        inputs.for_each(|node| self.note_read(node.index));
    }

    pub(super) fn note_read(&mut self, index: usize) {
        if self.values[index].is_none() && !self.is_function {
            self.reads_velocity |= index == V;
            if index >= BUILT_IN.len() && !self.carried.contains(&index) {
                self.carried.push(index);
            }
        }
    }

    /// Closes a block. The values after the block are those of the branch taken.
    pub(super) fn close(&mut self, block: Block, brace: &Range<usize>) {
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
    pub(super) fn value(&mut self, index: usize, at: &Range<usize>) -> usize {
        self.values[index].unwrap_or_else(|| self.before_step(index, at))
    }

    /// Returns the node of a name's number before the step.
    pub(super) fn before_step(&mut self, index: usize, at: &Range<usize>) -> usize {
        if index >= BUILT_IN.len() && !self.carried.contains(&index) {
            self.carried.push(index);
        }
        self.push(Node::input(index), at)
    }

    pub(super) fn push(&mut self, node: Node, at: &Range<usize>) -> usize {
        self.nodes.nodes.push(node);
        self.nodes.spans.push(at.clone());
        self.nodes.nodes.len() - 1
    }

    /// Adds the operations of an expression, which read the current numbers of the names. Returns the node of its
    /// value.
    pub(super) fn splice(&mut self, expression: &Expression) -> usize {
        let at = expression.spans.last().map_or(0..0, |span| span.start..span.start);
        let mut read: Vec<(usize, usize)> = Vec::new();
        for node in expression.nodes.iter().filter(|node| node.op == Op::Input) {
            if !read.iter().any(|(name, _)| *name == node.index) {
                read.push((node.index, self.value(node.index, &at)));
            }
        }
        let (before, tables) = (self.nodes.nodes.len(), self.nodes.tables.len());
        let zero = Node::new(Op::Number, &[]);
        for (node, span) in expression.nodes.iter().zip(&expression.spans) {
            let mut node = node.after(before);
            if node.op.is_table() {
                node.index += tables;
            }
            // A zero is a placeholder for an input, because operations read the name's current number instead.
            self.push(if node.op == Op::Input { zero } else { node }, span);
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

    pub(super) fn check_length(&self, at: Range<usize>) -> Parsed<()> {
        if self.nodes.nodes.len() <= 2 * MAX_OPERATIONS {
            return Ok(());
        }
        let what = format!("the lines have more than {MAX_OPERATIONS} operations");
        fault(at, what, "write fewer")
    }
}
