//! Reads calls of functions, and the points of tables.

use std::ops::Range;

use super::{Node, Parser, Scope, parse};
use crate::curve::Curve;
use crate::fault::{Parsed, fault};
use crate::function::{Function, Meaning};
use crate::op::Op;
use crate::switch::{ModeRule, Switch, SwitchValue};
use crate::token::Token;

/// The maximum number of points of a table.
pub const MAX_POINTS: usize = 64;

/// The names of a written function, which are its arguments and the length of the step.
struct Arguments(&'static [&'static str]);

impl Scope for Arguments {
    fn input(&self, name: &str) -> Option<usize> {
        let mut names = self.0.iter().chain(&["dt"]);
        names.position(|known| *known == name)
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    fn why_not(&self, _: &str) -> Option<String> {
        None
    }

    fn function(&self, name: &str) -> Option<&'static Function> {
        Function::named_in_functions(name)
    }

    fn overload(&self, name: &str, count: usize) -> Option<&'static Function> {
        Function::with_arguments(name, count)
    }
}

impl Parser<'_> {
    /// Reads the call of a function after its name. A method has its first argument before its name.
    pub(super) fn call(
        &mut self,
        mut function: &'static Function,
        name: Range<usize>,
        receiver: Option<usize>,
    ) -> Parsed<usize> {
        self.next += 1;
        let mut arguments: Vec<usize> = receiver.into_iter().collect();
        let mut table = None;
        let wanted = function.arguments.len();
        let overload =
            |parser: &Self, count: usize| parser.scope.overload(&parser.text[name.clone()], count);
        while receiver.is_none() || self.peek() != Token::Symbol(")") {
            if matches!(function.meaning, Meaning::Table) && arguments.len() == 1 {
                table = Some(self.table()?);
                break;
            }
            arguments.push(self.nested(Self::any)?);
            let is_full = arguments.len() > wanted && overload(self, arguments.len()).is_none();
            if is_full || !self.consume_if(",") {
                break;
            }
        }
        if arguments.len() != wanted
            && let Some(other) = overload(self, arguments.len())
        {
            function = other;
        }
        let wanted = function.arguments.len();
        if arguments.len() + usize::from(table.is_some()) != wanted {
            let end = self.here().end.max(name.end);
            let what = format!("`{}` does not take these arguments", function.name);
            let remedy = format!("write `{}`", function.usage());
            return fault(name.start..end, what, remedy);
        }
        self.expect(")", "the arguments")?;
        let start = receiver.map_or(name.start, |receiver| self.span_of(receiver).start);
        let span = start..self.tokens[self.next - 1].1.end;
        let condition = matches!(function.meaning, Meaning::If);
        for (index, &argument) in arguments.iter().enumerate() {
            if condition && index == 0 {
                self.want_truth(argument)?;
            } else {
                self.want_number(argument)?;
            }
        }
        Ok(match &function.meaning {
            Meaning::Smooth(smooth) => self.push(Op::Smooth(smooth), &arguments, span),
            Meaning::Switch(switch) => self.limit(Node::new(Op::Switch(*switch), &arguments), span),
            Meaning::If => self.push(Op::If, &arguments, span),
            Meaning::Written(_) => self.written(function, &arguments, &span),
            Meaning::Power => self.push(Op::Power, &arguments, span),
            Meaning::IsNan => {
                let differs = Switch { pieces: ModeRule::Order, value: SwitchValue::NotEqual };
                self.push(Op::Switch(differs), &[arguments[0], arguments[0]], span)
            }
            Meaning::Table => {
                let node = self.push(Op::Switch(Switch::TABLE), &arguments, span);
                self.expression.nodes[node].index = self.expression.tables.len();
                self.expression.tables.extend(table);
                node
            }
        })
    }

    /// Adds the operations of a function that is written as an expression.
    pub(super) fn written(
        &mut self,
        function: &'static Function,
        arguments: &[usize],
        span: &Range<usize>,
    ) -> usize {
        let Meaning::Written(text) = function.meaning else { unreachable!("a written function") };
        let inner = parse(text, &Arguments(function.arguments)).expect("a row of the table");
        let mut nodes: Vec<usize> = Vec::new();
        for node in &inner.nodes {
            let new = match node.op {
                Op::Input if node.index < arguments.len() => arguments[node.index],
                Op::Input => {
                    let step = self.scope.input("dt").unwrap_or_default();
                    self.node(Node::input(step), span.clone())
                }
                _ => self.limit(node.reading(|operand| nodes[operand]), span.clone()),
            };
            nodes.push(new);
        }
        nodes[nodes.len() - 1]
    }

    /// Reads a call of the acceleration after its name. Its arguments are a position, a velocity and a time.
    pub(super) fn acceleration(&mut self, name: Range<usize>) -> Parsed<usize> {
        self.next += 1;
        let mut arguments = vec![self.nested(Self::any)?];
        while self.consume_if(",") {
            arguments.push(self.nested(Self::any)?);
        }
        self.expect(")", "the arguments")?;
        let span = name.start..self.tokens[self.next - 1].1.end;
        if arguments.len() > 3 {
            let what = "an acceleration is one of a place, a velocity and a time";
            return fault(span, what, "write `a(x, v)`, or `a(x, v, h / 2)`");
        }
        arguments.iter().try_for_each(|argument| self.want_number(*argument).map(|_| ()))?;
        if arguments.len() == 1 {
            let v = self.scope.input("v").unwrap_or_default();
            arguments.push(self.node(Node::input(v), span.clone()));
        }
        Ok(self.push(Op::Call, &arguments, span))
    }

    /// Reads a call of a function of the lines after its name.
    pub(super) fn apply(
        &mut self,
        name: Range<usize>,
        index: usize,
        inputs: &[bool],
    ) -> Parsed<usize> {
        self.next += 1;
        let (mut last, mut count) = (None, 0);
        loop {
            let takes_acceleration = inputs.get(count) == Some(&true);
            if takes_acceleration {
                if self.peek() != Token::Name || !self.scope.is_acceleration(self.token_text()) {
                    let what = "the function takes the acceleration here";
                    return fault(self.here(), what, "write `a`");
                }
                self.next += 1;
            } else {
                let argument = self.nested(Self::any)?;
                let argument = self.want_number(argument)?;
                let operands: Vec<usize> = last.into_iter().chain([argument]).collect();
                let span = self.span_of(argument);
                last = Some(self.push(Op::Argument, &operands, span));
            }
            count += 1;
            if !self.consume_if(",") {
                break;
            }
        }
        self.expect(")", "the arguments")?;
        let span = name.start..self.tokens[self.next - 1].1.end;
        if count != inputs.len() {
            let what = format!("the function takes {} arguments, not {count}", inputs.len());
            return fault(span, what, "write as many as its first line names");
        }
        let node = self.push(Op::Apply, &last.into_iter().collect::<Vec<_>>(), span);
        self.expression.nodes[node].index = index;
        Ok(node)
    }

    /// Reads the points of a table.
    fn table(&mut self) -> Parsed<Curve> {
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
                return fault(span, what, "order them by rising x");
            }
            if points.len() == MAX_POINTS {
                let what = format!("the table has more than {MAX_POINTS} points");
                return fault(span, what, format!("keep at most {MAX_POINTS}"));
            }
            points.push([x, y]);
            if !self.consume_if(",") {
                break;
            }
        }
        self.expect("]", "the last point")?;
        if points.len() < 2 {
            let span = start..self.tokens[self.next - 1].1.end;
            return fault(span, "the table has one point", "write two or more");
        }
        Ok(Curve::new(points))
    }

    /// Reads a number with or without a sign.
    fn literal(&mut self) -> Parsed<f64> {
        let sign = if self.consume_if("-") { -1.0 } else { 1.0 };
        let Token::Number(number) = self.peek() else {
            let what = "a point of a table is made of plain numbers";
            return fault(self.here(), what, "write one, such as `0.5`");
        };
        self.next += 1;
        Ok(sign * number)
    }
}
