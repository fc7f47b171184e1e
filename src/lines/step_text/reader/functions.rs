//! Reads the settings and the functions of a method.

use std::ops::Range;

use super::{ACCELERATION, MAX_STEP_NAMES, Reader};
use crate::fault::{Parsed, fault, quoted};
use crate::step_text::method::{Function, General, Input, Taken};
use crate::step_text::plain::plain;
use crate::step_text::statements::{Statement, statements};
use crate::step_text::{Line, MAX_SUBSTEPS, TARGET, X};
use crate::token::is_name_part;

/// The maximum number of functions of a text.
const MAX_FUNCTIONS: usize = 16;

/// The functions that a text may `use`.
const SHARED_STEPS: [(&str, &str); 11] = [
    ("half-sine", include_str!("../../../../assets/methods/shared/half-sine.step")),
    ("on-group", include_str!("../../../../assets/methods/shared/on-group.step")),
    ("rate-of-spin", include_str!("../../../../assets/methods/shared/rate-of-spin.step")),
    ("remainder", include_str!("../../../../assets/engine-loops/shared/remainder.loop")),
    ("single", include_str!("../../../../assets/engine-loops/shared/single.loop")),
    ("seen", include_str!("../../../../assets/methods/shared/seen.step")),
    ("slope", include_str!("../../../../assets/methods/shared/slope.step")),
    ("solve", include_str!("../../../../assets/methods/shared/solve.step")),
    ("steady", include_str!("../../../../assets/methods/shared/steady.step")),
    ("step-size", include_str!("../../../../assets/methods/shared/step-size.step")),
    ("unit", include_str!("../../../../assets/methods/shared/unit.step")),
];

/// Returns the index of the statement that closes the block which the statement at `at` opens.
pub(super) fn end_of(all: &[Statement], at: usize) -> usize {
    let mut depth = 0;
    let is_end = |statement: &Statement| {
        depth += statement.depth();
        depth == 0
    };
    all[at..].iter().position(is_end).map_or(all.len(), |length| at + length)
}

impl Reader<'_> {
    /// Reads an input of the lines, such as `whole substeps`.
    pub(super) fn take(&mut self, span: Range<usize>) -> Parsed<()> {
        let text = self.text[span.clone()].trim();
        let end = span.start + self.text[span.clone()].trim_end().len();
        let (text, number) = match text.split_once('=') {
            Some((text, number)) => (text.trim_end(), Some(number.trim())),
            None => (text, None),
        };
        let is_whole = text.starts_with("whole ");
        let name = text.strip_prefix("whole ").unwrap_or(text).trim();
        let name = name.split('(').next().unwrap_or_default().trim_end();
        let start = span.start + self.text[span.clone()].find(name).unwrap_or(0);
        let span = start..start + name.len();
        let setting = Input::ALL.iter().find(|(known, _)| *known == name).map(|(_, input)| *input);
        let is_default =
            |n: &u32| setting == Some(Input::Substeps) && (1..=MAX_SUBSTEPS).contains(n);
        let default = number.map_or(Some(1), |number| number.parse().ok().filter(is_default));
        let Some(default) = default else {
            let what = format!("`{}` is no number of substeps", quoted(number.unwrap_or("")));
            let remedy = "write 1 to 1000 in `takes whole substeps = 4`, or leave it out";
            return fault(span.start..end, what, remedy);
        };
        let index = match name {
            "target" => {
                self.takes_target = true;
                Some(TARGET)
            }
            _ if setting.is_some() => {
                self.method_at.get_or_insert(span.clone());
                self.declare(span.clone(), false, false)?;
                let index = self.index(name).unwrap_or(X);
                self.values[index] = Some(0);
                Some(index)
            }
            _ if ACCELERATION.contains(&name) => None,
            _ => {
                let known: Vec<&str> = Input::ALL.iter().map(|(name, _)| *name).collect();
                let what = format!("no body gives a step `{}`", quoted(name));
                let remedy = format!("take `a(x, v)`, `target`, {}", known.join(", "));
                return fault(span, what, remedy);
            }
        };
        self.inputs.push(Taken { input: setting, name: index, is_whole, default, span });
        Ok(())
    }

    /// Reads a function, whose lines are the statements in this range.
    pub(super) fn read_function(
        &mut self,
        name: Range<usize>,
        inputs: Range<usize>,
        all: &[Statement],
        lines: Range<usize>,
    ) -> Parsed<()> {
        let word = &self.text[name.clone()];
        self.expect_method(&name, "write its lines in the place of the call")?;
        if !self.blocks.is_empty() || self.is_function || lines.end == all.len() {
            let remedy = "end the blocks before it, and close it with `}`";
            return fault(name, "the function stands in a block, or is not closed", remedy);
        }
        if self.functions.len() == MAX_FUNCTIONS {
            let what = format!("the lines have more than {MAX_FUNCTIONS} functions");
            return fault(name, what, "use fewer");
        }
        let mut reader = Reader::new(self.text, self.method_at.clone(), Vec::new());
        (reader.is_function, reader.has_begun) = (true, true);
        let (mut takes, mut at) = (Vec::new(), inputs.start);
        while at < inputs.end {
            let rest = &self.text[at..inputs.end];
            let length = rest.find([',', '(']).unwrap_or(rest.len());
            let input = rest[..length].trim_start();
            let input = at + length - input.len()..at + length;
            let input = input.start..input.start + self.text[input.clone()].trim_end().len();
            let is_acceleration = rest[length..].starts_with('(');
            let is_name = self.text[input.clone()].bytes().all(is_name_part);
            if input.is_empty() || !is_name || takes.len() == MAX_STEP_NAMES {
                return fault(
                    inputs,
                    "an input of the function is no name",
                    "write `fn f(x, v) {`",
                );
            }
            if !is_acceleration {
                reader.declare(input, false, false)?;
                reader.values.fill(Some(0));
            }
            takes.push(is_acceleration);
            let closed = if is_acceleration {
                rest.find(')').map_or(rest.len(), |at| at + 1)
            } else {
                length
            };
            let next = rest[closed..].find(|c: char| c != ',' && !c.is_ascii_whitespace());
            at += next.map_or(rest.len(), |next| closed + next);
        }
        reader.functions = std::mem::take(&mut self.functions);
        reader.read_all(&all[lines])?;
        let Reader { names, lines, functions, .. } = reader;
        let is_line = |line: &&Line| !matches!(line, Line::Remark(_) | Line::Blank);
        if !matches!(lines.iter().rfind(is_line), Some(Line::Return(_))) {
            return fault(name, "the function can end without a value", "end it with `return x`");
        }
        self.functions = functions;
        self.functions.push(Function {
            name: word.to_owned(),
            inputs: takes,
            names,
            lines,
            remarks: std::mem::take(&mut self.remarks),
            shared: None,
            general: None,
        });
        Ok(())
    }

    /// Adds the functions of a shared source.
    pub(super) fn use_shared(&mut self, span: Range<usize>) -> Parsed<()> {
        let name = self.text[span.clone()].trim();
        let start = span.start + self.text[span].find(name).unwrap_or(0);
        let span = start..start + name.len();
        let Some((_, source)) = SHARED_STEPS.iter().find(|(known, _)| *known == name) else {
            let known: Vec<&str> = SHARED_STEPS.iter().map(|(known, _)| *known).collect();
            let what = format!("nothing shared is called `{}`", quoted(name));
            return fault(span, what, format!("write one of {}", known.join(", ")));
        };
        self.expect_method(&span, "write its lines in the place of the call")?;
        let (text, _) = plain(source);
        let before = self.functions.len();
        let mut reader = Reader::new(&text, Some(0..0), std::mem::take(&mut self.functions));
        reader.read_all(&statements(&text, source)?)?;
        self.functions = reader.functions;
        for function in &mut self.functions[before..] {
            function.general = General::of(&function.name);
            function.shared = Some(source);
        }
        Ok(())
    }

    /// Refuses a rule.
    pub(super) fn expect_method(&self, at: &Range<usize>, remedy: &str) -> Parsed<()> {
        if self.is_method() {
            return Ok(());
        }
        let what = format!("`{}` cannot stand in a rule", quoted(self.text[at.clone()].trim()));
        fault(at.clone(), what, remedy)
    }
}
