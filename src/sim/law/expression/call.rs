//! Calls of functions, and the points of tables.

use std::ops::Range;

use super::{Node, Parser};
use crate::sim::law::op::{Body, Function, Op};
use crate::sim::law::refusal::Fault;
use crate::sim::law::table::{MOST_POINTS, Table};
use crate::sim::law::token::Token;

impl Parser<'_> {
    /// The call of a function whose name has been taken.
    pub(super) fn call(&mut self, function: &Function, name: Range<usize>) -> Result<usize, Fault> {
        self.next += 1;
        let mut arguments = Vec::new();
        let mut table = None;
        loop {
            if matches!(function.body, Body::Table) && arguments.len() == 1 {
                table = Some(self.table()?);
                break;
            }
            arguments.push(self.nested(Self::any)?);
            if arguments.len() > function.arguments || !self.takes(",") {
                break;
            }
        }
        let is_complete = matches!(function.body, Body::Table) == table.is_some();
        if arguments.len() != function.arguments || !is_complete {
            let end = self.here().end.max(name.end);
            let what = format!("`{}` does not take these arguments", function.name);
            let remedy = format!("write `{}`", function.usage);
            return Err(Fault::new(name.start..end, what, remedy));
        }
        self.expect(")", "the arguments")?;
        let span = name.start..self.tokens[self.next - 1].1.end;
        let condition = matches!(function.body, Body::If);
        for (place, &argument) in arguments.iter().enumerate() {
            if condition && place == 0 {
                self.want_truth(argument)?;
            } else {
                self.want_number(argument)?;
            }
        }
        Ok(match function.body {
            Body::Op(op) => self.push(op, &arguments, span),
            Body::If => self.push(Op::If, &arguments, span),
            Body::Clamp => {
                let raised = self.push(Op::Max, &arguments[..2], span.clone());
                self.push(Op::Min, &[raised, arguments[2]], span)
            }
            Body::Table => {
                let index = self.expression.tables.len();
                self.expression.tables.extend(table);
                let arguments = [arguments[0], 0, 0];
                self.node(Node { op: Op::Table, arguments, number: 0.0, index }, span)
            }
        })
    }

    /// The points of a table.
    fn table(&mut self) -> Result<Table, Fault> {
        let start = self.span().start;
        self.expect("[", "the comma, before the points `[[x0, y0], [x1, y1]]`")?;
        let mut points: Vec<[f64; 2]> = Vec::new();
        loop {
            let from = self.span().start;
            self.expect("[", "the bracket or comma before a point `[x, y]`")?;
            let x = self.literal()?;
            self.expect(",", "the x of a point")?;
            let y = self.literal()?;
            self.expect("]", "the y of a point")?;
            let span = from..self.tokens[self.next - 1].1.end;
            if let Some([before, _]) = points.last().filter(|last| last[0] >= x) {
                let what = format!("the points go from x = {before} to {x}");
                return Err(Fault::new(span, what, "order them by rising x"));
            }
            if points.len() == MOST_POINTS {
                let what = format!("the table has more than {MOST_POINTS} points");
                return Err(Fault::new(span, what, format!("keep at most {MOST_POINTS}")));
            }
            points.push([x, y]);
            if !self.takes(",") {
                break;
            }
        }
        self.expect("]", "the last point")?;
        if points.len() < 2 {
            let span = start..self.tokens[self.next - 1].1.end;
            return Err(Fault::new(span, "the table has one point", "write two or more"));
        }
        Ok(Table::new(points))
    }

    /// A number with or without a sign.
    fn literal(&mut self) -> Result<f64, Fault> {
        let sign = if self.takes("-") { -1.0 } else { 1.0 };
        let Token::Number(number) = self.peek() else {
            let what = "a point of a table is made of plain numbers";
            return Err(Fault::new(self.here(), what, "write one, such as `0.5`"));
        };
        self.next += 1;
        Ok(sign * number)
    }
}
