//! The blocks of several languages, and assignments that share a line.

use std::ops::Range;

use super::{Declares, Reader, Statement, begins_word};
use crate::fault::{Parsed, fault};
use crate::token::is_name_start;

/// The end of an open block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// `}`.
    Brace,
    /// `end`, or a word that begins the other case.
    Word,
    /// The first line that is indented no more than the one with this byte.
    Line(usize),
    /// The end of its only statement, and whether that is read.
    Statement(bool),
}

impl Reader<'_> {
    /// Returns the byte of the line's beginning, and its indentation.
    fn line_at(&self, at: usize) -> [usize; 2] {
        let start = self.source[..at].rfind('\n').map_or(0, |end| end + 1);
        let line = &self.source[start..];
        [start, line.len() - line.trim_start_matches([' ', '\t']).len()]
    }

    /// Returns the end of the innermost block, or its other case, if no sign ends it and it ends here.
    pub(super) fn end_without_sign(&mut self) -> Parsed<Option<Statement>> {
        let word = self.name();
        let mut is_other_case = ["else", "elif"].contains(&&self.text[word.clone()]);
        let ends = match self.blocks.last() {
            Some(Ends::Line(head)) => {
                let ([first, outer], [line, inner]) = (self.line_at(*head), self.line_at(self.at));
                is_other_case &= inner >= outer;
                line > first && (inner <= outer || is_other_case)
                    || self.rest().starts_with('}')
                    || self.rest().is_empty()
            }
            Some(Ends::Statement(is_read)) => *is_read,
            _ => false,
        };
        if !ends {
            return Ok(None);
        }
        let block = self.blocks.pop();
        match block.filter(|_| is_other_case) {
            Some(block) => self.other_case(word, block).map(Some),
            None => Ok(Some(Statement::End(self.at..self.at))),
        }
    }

    /// Notes that a block of one statement has it.
    pub(super) fn note_statement(&mut self, statement: Option<&Statement>) {
        let is_whole =
            statement.is_some_and(|it| it.depth() <= 0 && !matches!(it, Statement::Else(..)));
        if let Some(Ends::Statement(is_read)) = self.blocks.last_mut() {
            *is_read |= is_whole;
        }
    }

    /// Reads the beginning of the other case of a block, from its word. `sign` ends the block before it.
    pub(super) fn other_case(&mut self, sign: Range<usize>, before: Ends) -> Parsed<Statement> {
        let word = self.name();
        let is_else = &self.text[word.clone()] == "else";
        self.at = word.end;
        if is_else && before == Ends::Word {
            self.blocks.push(Ends::Word);
            return Ok(Statement::Else(None, sign));
        }
        self.skip(|c| c.is_ascii_whitespace());
        let condition = match &self.text[self.name()] {
            "if" if is_else => Some(self.condition(self.name())?),
            _ if is_else => {
                self.open(word)?;
                None
            }
            _ => Some(self.condition(word)?),
        };
        Ok(Statement::Else(condition, sign))
    }

    /// Returns the condition after this `if` or `while`, up to the sign, the word or the statement that begins its
    /// block.
    pub(super) fn condition(&mut self, word: Range<usize>) -> Parsed<Range<usize>> {
        self.at = word.end;
        let (rest, mut depth, mut is_one_line) = (self.rest(), 0, true);
        let is_bracketed = rest.trim_start().starts_with('(');
        for (at, sign) in rest.char_indices() {
            let after = &rest[at + sign.len_utf8()..];
            depth += i32::from(sign == '(') - i32::from(sign == ')');
            is_one_line &= sign != '\n' || depth > 0;
            let begins = match sign {
                '{' | ';' | '}' => true,
                't' | 'b' | 'd' => begins_word(rest, at, &BEGINNINGS),
                ':' if depth == 0 && is_one_line => {
                    let is_path = rest[..at].ends_with(':') || after.starts_with([':', '=']);
                    !is_path && !rest[..at].contains('?')
                }
                ')' if depth == 0 && is_bracketed => {
                    let first = after.trim_start();
                    first.starts_with(is_name_start) && !begins_word(first, 0, &JOINS)
                }
                _ => false,
            };
            if begins {
                let condition = self.at..self.at + at + usize::from(sign == ')');
                self.at = condition.end;
                self.open(word)?;
                return Ok(condition);
            }
        }
        fault(word, NO_BLOCK, "write `if condition { … }`")
    }

    /// Consumes the sign or the word that begins a block.
    pub(super) fn open(&mut self, word: Range<usize>) -> Parsed<()> {
        let (ends, length) = match self.rest().chars().next() {
            Some('{') => (Ends::Brace, 1),
            Some(':') => (Ends::Line(word.start), 1),
            Some('t' | 'b' | 'd') if begins_word(self.rest(), 0, &BEGINNINGS) => {
                (Ends::Word, self.name().len())
            }
            Some(c) if c.is_ascii_whitespace() || is_name_start(c) => (Ends::Statement(false), 0),
            _ => return fault(word, NO_BLOCK, "write `if condition { … }`"),
        };
        self.at += length;
        self.blocks.push(ends);
        Ok(())
    }

    /// Reads the assignments of a line: `a = 1, b = 2`.
    pub(super) fn assignments(&mut self) -> Parsed<Statement> {
        let first = self.assignment(None)?;
        while self.rest().starts_with(',') {
            self.at += 1;
            self.skip(|c| c.is_ascii_whitespace());
            let declares = match &first {
                Statement::Assign { declares, .. } => *declares,
                _ => None,
            };
            let next = self.assignment(declares)?;
            self.read.push_back(next);
        }
        Ok(first)
    }

    /// Reads `a, b = 1, 2` after its first name.
    pub(super) fn several(
        &mut self,
        first: Range<usize>,
        declares: Option<Declares>,
    ) -> Parsed<Statement> {
        let mut names = vec![first];
        let blank = |c: char| c == ' ' || c == '\t';
        while self.rest().starts_with(',') {
            self.at += 1;
            self.skip(blank);
            names.push(self.name());
            self.at = self.name().end;
            self.skip(blank);
        }
        if declares.is_some() && self.is_line_end() {
            return Ok(Statement::Blank);
        }
        let whole = names[0].start..self.at;
        let mut values = Vec::new();
        let mut sign = if self.rest().starts_with("==") { "" } else { "=" };
        while !sign.is_empty() && self.rest().starts_with(sign) && values.len() < names.len() {
            self.at += 1;
            values.push(self.at..self.end());
            (self.at, sign) = (self.end(), ",");
        }
        if values.len() < names.len() || self.rest().starts_with(',') {
            let what = "the names are not as many as their values";
            return fault(whole, what, "write one assignment in a line");
        }
        for (index, value) in values.iter().enumerate().skip(1) {
            let text = &self.text[value.clone()];
            let is_read = |name: &&Range<usize>| {
                let name = &self.text[(*name).clone()];
                (0..text.len()).any(|at| begins_word(text, at, &[name]))
            };
            if let Some(name) = names[..index].iter().find(is_read) {
                let name = &self.text[name.clone()];
                let what = format!("the line assigns `{name}`, and reads it from before");
                let remedy = format!("write one assignment in a line, after `let old = {name}`");
                return fault(value.clone(), what, remedy);
            }
        }
        let all = names.into_iter().zip(values);
        let mut all =
            all.map(|(name, value)| Statement::Assign { name, joins: "", value, declares });
        let first = all.next();
        self.read.extend(all);
        first.map_or_else(|| fault(whole, "nothing is assigned", "write `a = 1`"), Ok)
    }
}

/// Whether a statement up to a brace chooses its value: `let k = if c { a } else { b }`.
pub(super) fn is_choice(before: &str) -> bool {
    let value = before.split_once('=').map(|(_, value)| value.trim_start());
    value.is_some_and(|value| begins_word(value, 0, &["if"]))
}

/// Words that begin a block, which `end` ends.
const BEGINNINGS: [&str; 3] = ["then", "begin", "do"];
/// Words that may follow a part of a condition in brackets.
const JOINS: [&str; 6] = ["and", "or", "then", "begin", "do", "mod"];
const NO_BLOCK: &str = "no `{` opens the block";
