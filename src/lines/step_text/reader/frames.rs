//! Reads the ticks, the picture and the arrays of a game loop.

use std::ops::Range;

use super::Reader;
use crate::expression::{Expression, Node, Scope as _};
use crate::fault::{Parsed, fault, quoted};
use crate::op::Op;
use crate::step_text::method::{Array, Taken};
use crate::step_text::statements::Statement;
use crate::step_text::{H, Line, StepText, TARGET, V, X};

/// The names of every loop. The first four have the slots of a step: the ticks of the frame so far, their time, the
/// duration of the frame, and the length of a tick. Those with a space are for `tick` and `show`.
pub(in super::super) const FRAME_NAMES: [&str; 12] = [
    "ticks made",
    "time made",
    "dt",
    "H",
    "refresh",
    "cost",
    "now",
    "first",
    "second",
    "ticks added",
    "tick length",
    "part shown",
];
pub(in super::super) const REFRESH: usize = 4;
pub(in super::super) const COST: usize = 5;
pub(in super::super) const NOW: usize = 6;
pub(in super::super) const FIRST: usize = 7;
pub(in super::super) const SECOND: usize = 8;
pub(in super::super) const COUNT: usize = 9;
pub(in super::super) const LENGTH: usize = 10;
pub(in super::super) const SHOWN: usize = 11;

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

impl<'t> Reader<'t> {
    /// Reads the lines of a game loop.
    pub(in super::super) fn read_loop(text: &'t str, all: &[Statement]) -> Parsed<StepText> {
        let mut reader = Self::new(text, Some(0..0), Vec::new());
        reader.is_loop = true;
        reader.read_named(&FRAME_NAMES, all)
    }

    /// Reads lines that are given numbers with these names.
    pub(super) fn read_named(mut self, names: &[&str], all: &[Statement]) -> Parsed<StepText> {
        for name in names {
            self.add_name(name, true);
        }
        self.values.fill(Some(0));
        self.carried = vec![X, V];
        self.read_inputs(all)?;
        self.read_all(all)?;
        self.finish()
    }
}

impl Reader<'_> {
    fn expect_loop(&self, word: &Range<usize>) -> Parsed<()> {
        if self.is_loop {
            return Ok(());
        }
        let what = format!("`{}` is for the lines of a game loop", &self.text[word.clone()]);
        fault(word.clone(), what, "name the file .loop, or assign `x` and `v`")
    }

    /// Reads the statement by which the times of a loop are whole numbers.
    pub(super) fn take_whole(&mut self, span: Range<usize>) -> Parsed<()> {
        let word = self.text[span.clone()].trim();
        if word != "whole dt" {
            let what = format!("a loop takes no `{}`", quoted(word));
            return fault(span, what, "write `takes whole dt`, or remove it");
        }
        self.inputs.push(Taken { input: None, name: Some(H), is_whole: true, default: 1, span });
        Ok(())
    }

    /// Reads a statement that only a loop has.
    pub(super) fn read_frame_statement(&mut self, statement: Statement) -> Parsed<()> {
        match statement {
            Statement::Store { name, index, value } => {
                let word = &self.text[name.clone()];
                let Some(array) = self.array(word) else {
                    let what = format!("`{}` is no array", quoted(word));
                    return fault(name, what, "a loop declares one: `memory past[10] = 0`");
                };
                let index = self.expression(index, false)?;
                let value = self.expression(value, false)?;
                self.note_reads(&index);
                self.note_reads(&value);
                self.lines.push(Line::Store { array, index, value });
            }
            Statement::Tick { word, count, length } => {
                self.expect_loop(&word)?;
                let count = self.expression(count, false)?;
                let length = length.map(|length| self.expression(length, false)).transpose()?;
                self.tick(count, length);
            }
            Statement::Show { word, value } => {
                self.expect_loop(&word)?;
                let value = self.expression(value, false)?;
                self.note_reads(&value);
                self.lines.push(Line::Assign { name: SHOWN, joins: "", value, declares: None });
            }
            _ => {}
        }
        Ok(())
    }

    /// Adds ticks of a length, or of `H`.
    fn tick(&mut self, count: Expression, length: Option<Expression>) {
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
