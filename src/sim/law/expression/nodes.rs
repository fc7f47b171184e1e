//! The nodes of an expression that is being read, and the types of their values.

use std::ops::Range;

use super::{Node, Parser};
use crate::sim::law::fault::{Parsed, fault, quoted};
use crate::sim::law::op::Op;

impl Parser<'_> {
    pub(super) fn push(&mut self, op: Op, arguments: &[usize], span: Range<usize>) -> usize {
        let mut operands = [0; 3];
        operands[..arguments.len()].copy_from_slice(arguments);
        self.node(Node { op, operands, count: arguments.len(), number: 0.0, index: 0 }, span)
    }

    pub(super) fn node(&mut self, node: Node, span: Range<usize>) -> usize {
        self.expression.nodes.push(node);
        self.expression.spans.push(span);
        self.expression.nodes.len() - 1
    }

    pub(super) fn number(&mut self, number: f64, span: Range<usize>) -> usize {
        self.node(Node { number, ..Node::leaf(Op::Number) }, span)
    }

    pub(super) fn span_of(&self, node: usize) -> Range<usize> {
        self.expression.spans[node].clone()
    }

    pub(super) fn is_truth(&self, node: usize) -> bool {
        self.expression.nodes[node].op.is_truth()
    }

    pub(super) fn want_number(&self, node: usize) -> Parsed<usize> {
        if !self.is_truth(node) {
            return Ok(node);
        }
        let span = self.span_of(node);
        let what = format!("`{}` is true or false, not a number", quoted(&self.text[span.clone()]));
        fault(span, what, "write `if(condition, 1, 0)` for a number")
    }

    pub(super) fn want_truth(&self, node: usize) -> Parsed<usize> {
        if self.is_truth(node) {
            return Ok(node);
        }
        let span = self.span_of(node);
        let what = format!("`{}` is a number, not a condition", quoted(&self.text[span.clone()]));
        fault(span, what, "compare it, such as `x > 0`")
    }
}
