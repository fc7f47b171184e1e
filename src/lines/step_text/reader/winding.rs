//! Reads the loops of a rule that turn an angle back into its range.

use std::ops::Range;

use super::{Reader, X};
use crate::expression::parse;
use crate::fault::Parsed;
use crate::step_text::statements::Statement;

/// For the sign of a condition and that of its only line: the way beyond the bound, of the name and the bound.
const WAYS: [(char, &str, [&str; 2]); 2] = [('>', "-", ["", "-"]), ('<', "+", ["-", "+"])];

impl Reader<'_> {
    /// Reads `while a > 180 { a -= 360 }`, if the statements begin with such a loop. It is one expression, as the
    /// number of turns follows from the numbers.
    pub(super) fn read_winding(&mut self, all: &[Statement]) -> Parsed<bool> {
        let [Statement::While(word, condition), line, Statement::End(_), ..] = all else {
            return Ok(false);
        };
        let Statement::Assign { name, joins, value, .. } = line else { return Ok(false) };
        let (written, mut turn) = (&self.text[name.clone()], self.text[value.clone()].trim());
        let mut joins = *joins;
        // Lua has no `-=`.
        let long = turn.strip_prefix(written).map(str::trim_start).filter(|_| joins.is_empty());
        if let Some((sign, rest)) = long.and_then(|long| Some((long.get(..1)?, long.get(1..)?))) {
            (joins, turn) = (if sign == "-" { "-" } else { "+" }, rest);
            if !["-", "+"].contains(&sign) {
                return Ok(false);
            }
        }
        let text = self.text[condition.clone()].trim();
        let inner = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let text = inner.unwrap_or(text);
        let way = WAYS.iter().find(|(sign, line, _)| *line == joins && text.contains(*sign));
        let Some((sign, _, [of_name, of_bound])) = way.filter(|_| !self.is_method()) else {
            return Ok(false);
        };
        let (left, bound) = text.split_once(*sign).unwrap_or_default();
        let (bound, turns) = match bound.strip_prefix('=') {
            Some(bound) => (bound, "max(floor("),
            None => (bound, "max(ceil("),
        };
        let end = if turns.contains("floor") { " + 1" } else { "" };
        let whole = format!(
            "{written} {joins} ({turn}) * {turns}({of_name}{written} {of_bound} ({bound})) / ({turn})){end}, 0)"
        );
        let (Ok(mut read), Ok(turn)) = (parse(&whole, self), parse(turn, self)) else {
            return Ok(false);
        };
        let is_turn = self.constant_value(&turn, value.clone()).is_ok_and(|turn| turn > 0.0);
        if left.trim() != written || !is_turn {
            return Ok(false);
        }
        let place: Range<usize> = word.start..value.end;
        read.spans.fill(place.clone());
        let index = self.index(written).unwrap_or(X);
        self.assign(index, name.clone(), ("", None), read, place)?;
        Ok(true)
    }
}
