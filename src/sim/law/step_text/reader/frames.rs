//! Reads the ticks, the picture and the arrays of a game loop.

use std::ops::Range;

use super::Reader;
use crate::sim::law::expression::{Expression, Node, Scope as _};
use crate::sim::law::fault::{Parsed, fault, quoted};
use crate::sim::law::op::Op;
use crate::sim::law::step_text::frames::{COUNT, LENGTH, SHOWN};
use crate::sim::law::step_text::method::Array;
use crate::sim::law::step_text::{Line, TARGET, V, X};

/// The most numbers of an array.
const MAX_ARRAY: f64 = 1024.0;

/// Returns the expression of a name, or of the product of two.
fn product(names: &[usize]) -> Expression {
    let mut nodes: Vec<Node> = names.iter().map(|name| Node::input(*name)).collect();
    if nodes.len() > 1 {
        nodes.push(Node::new(Op::Multiply, &[0, 1]));
    }
    Expression { spans: vec![0..0; nodes.len()], nodes, tables: Vec::new() }
}

impl Reader<'_> {
    pub(super) fn expect_loop(&self, word: &Range<usize>) -> Parsed<()> {
        if self.is_loop {
            return Ok(());
        }
        let what = format!("`{}` is for the lines of a game loop", &self.text[word.clone()]);
        fault(word.clone(), what, "name the file .loop, or assign `x` and `v`")
    }

    /// Adds ticks of a length, or of `H`.
    pub(super) fn tick(&mut self, count: Expression, length: Option<Expression>) {
        self.note_reads(&count);
        length.iter().for_each(|length| self.note_reads(length));
        let length = length.unwrap_or_else(|| product(&[TARGET]));
        for (name, joins, value) in [
            (COUNT, "", count),
            (LENGTH, "", length),
            (X, "+", product(&[COUNT])),
            (V, "+", product(&[COUNT, LENGTH])),
        ] {
            self.lines.push(Line::Assign { name, joins, value, declares: None });
        }
    }

    pub(super) fn show(&mut self, value: Expression) {
        self.note_reads(&value);
        self.lines.push(Line::Assign { name: SHOWN, joins: "", value, declares: None });
    }

    /// Declares an array.
    pub(super) fn add_array(
        &mut self,
        name: Range<usize>,
        size: Range<usize>,
        value: Range<usize>,
    ) -> Parsed<()> {
        self.expect_loop(&name)?;
        let constant =
            |span: Range<usize>| self.constant_value(&self.expression(span.clone(), false)?, span);
        let (numbers, start) = (constant(size.clone())?, constant(value)?);
        if numbers.fract() != 0.0 || !(1.0..=MAX_ARRAY).contains(&numbers) {
            let what = format!("an array has 1 to {MAX_ARRAY} numbers");
            return fault(size, what, "write a whole number");
        }
        let word = self.text[name.clone()].to_owned();
        if self.array(&word).is_some() || self.index(&word).is_some() {
            return fault(name, format!("`{}` is declared twice", quoted(&word)), "rename one");
        }
        self.arrays.push(Array { name: word, size: numbers as usize, start });
        Ok(())
    }
}
