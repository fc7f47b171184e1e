//! The functions and classes around the lines, the attributes before a declaration, and Python's `//`.

use std::borrow::Cow;
use std::ops::Range;

use super::blocks::Ends;
use super::{Reader, Statement, begins_word};
use crate::fault::{Parsed, fault, quoted};
use crate::step_text::names::{after_each, assigns, is_name_of};
use crate::step_text::{BUILT_IN, V, X};
use crate::token::{FLOOR_DIVISION, FLOOR_REMAINDER, is_name_part};

/// Words before brackets and a block, which are no function.
const CONTROLS: [&str; 15] = [
    "if", "while", "else", "elseif", "elif", "return", "for", "foreach", "switch", "repeat",
    "match", "until", "takes", "use", "memory",
];

/// Words of the head of a class.
const CLASSES: [&str; 3] = ["class", "struct", "impl"];

/// Beginnings of lines that change no number, before a name.
const IDLE: [&str; 6] = ["extends", "class_name", "using", "import", "from", "global"];

/// Attributes that have no sign before their brackets.
const ATTRIBUTES: [&str; 3] = ["UPROPERTY", "UFUNCTION", "export"];

/// Names of the function that a function replaces.
const BASES: [&str; 2] = ["super", "base"];

/// Methods of three.js that change their vector.
const CHANGES: [&str; 6] =
    ["lerp", "add", "sub", "addScaledVector", "multiplyScalar", "divideScalar"];

/// Parts of a text that Python and Lua do not have, and parts that only they have.
const C_PARTS: [&str; 10] = [";", "{", "}", "/*", "let ", "const ", "Math", "&&", "||", "this."];
const PYTHON_PARTS: [&str; 7] = ["self.", "def ", "elif", "local ", " then", "#", ":\n"];

/// Words of the languages in which a remainder has the sign of its second number.
const FLOORED: [&str; 2] = ["local ", "def "];

/// Words between two operands.
const BETWEEN: [&str; 7] = ["and", "or", "not", "if", "else", "then", "mod"];

/// Returns the length of the text up to the bracket that closes the one at its byte `open`.
fn closed(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0_i32;
    let is_last = |sign: char| {
        depth += i32::from("([".contains(sign)) - i32::from(")]".contains(sign));
        depth == 0
    };
    text[open..].find(is_last).map(|at| open + at + 1)
}

/// A head, with its length up to its block.
struct Head {
    length: usize,
    ends: Ends,
    is_function: bool,
}

impl Reader<'_> {
    /// Reads the words around the lines that change no number, or the head of a function.
    pub(super) fn attribute_or_head(&mut self) -> Parsed<Option<Statement>> {
        while let Some(length) = self.attribute() {
            self.at += length;
            self.skip(|c| c.is_ascii_whitespace());
        }
        let word = &self.text[self.name()];
        if word == "pass" || IDLE.contains(&word) && self.is_followed_by_name() {
            self.at += self.rest().find(['\n', ';']).unwrap_or(self.rest().len());
            return Ok(Some(Statement::Blank));
        }
        let Some(Head { length, ends, is_function }) = self.head() else { return Ok(None) };
        let start = self.at;
        self.at += length;
        self.heads.push(self.blocks.len());
        self.blocks.push(ends);
        Ok(Some(Statement::Head { at: start..self.at, is_function }))
    }

    /// Returns the length of the attribute that stands here, such as `@export` or `[SerializeField]`.
    fn attribute(&self) -> Option<usize> {
        let (rest, name) = (self.rest(), self.name().len());
        let bracketed = |open: usize| match rest[open..].starts_with('(') {
            true => closed(rest, open),
            false => Some(open),
        };
        if rest.starts_with('[') {
            let length = closed(rest, 0)?;
            let after = rest[length..].trim_start().bytes().next();
            return after.is_some_and(|it| is_name_part(it) || it == b'[').then_some(length);
        }
        let named = rest[usize::from(rest.starts_with('@'))..].bytes();
        let named = named.take_while(|byte| is_name_part(*byte)).count();
        match rest.starts_with('@') && named > 0 {
            true => bracketed(named + 1),
            false if ATTRIBUTES.contains(&&rest[..name]) => {
                bracketed(name).filter(|length| *length > name)
            }
            false => None,
        }
    }

    /// Returns the head of a function or a class that stands here.
    fn head(&self) -> Option<Head> {
        let (rest, word) = (self.rest(), &self.text[self.name()]);
        let line = rest.split(['\n', ';']).next().unwrap_or_default();
        let brace = |from: usize| rest[from..].find('{').map(|at| from + at);
        let head = |length, ends| Some(Head { length, ends, is_function: true });
        let is_query = word == "for" && line.contains("query") && line.contains('{');
        let is_class = line.split_whitespace().take(3).any(|it| CLASSES.contains(&it));
        if is_query || is_class && !line.contains('=') {
            let end = line.trim_end().len();
            let of_line =
                || Some(Head { length: end, ends: Ends::Line(self.at), is_function: false });
            let at = brace(0).filter(|at| !rest[..*at].contains([';', '=']));
            let of_brace = |at| Head { length: at + 1, ends: Ends::Brace, is_function: false };
            return if line[..end].ends_with(':') { of_line() } else { at.map(of_brace) };
        }
        if word.is_empty() || CONTROLS.contains(&word) {
            return None;
        }
        if let Some(arrow) = line.find("=>")
            && line[arrow + 2..].trim_start().starts_with('{')
        {
            return head(brace(arrow)? + 1, Ends::Brace);
        }
        let function = (0..line.len()).find(|at| begins_word(line, *at, &["function"]));
        let from = function.unwrap_or(0);
        let open = from + line.get(from..)?.find('(')?;
        let close = closed(rest, open)?;
        let (before, after) = (&rest[..open], &rest[close..]);
        let is_path = |c: char| c.is_ascii_alphanumeric() || "_ .:<>&*~\t".contains(c);
        let is_own = word == "fn" && !rest[open..close].contains(':');
        if is_own || function.is_none() && !before.chars().all(is_path) {
            return None;
        }
        if before.split_whitespace().any(|it| ["def", "func"].contains(&it)) {
            let colon = after.split('\n').next()?.find(':')?;
            return head(close + colon + 1, Ends::Line(self.at));
        }
        let is_type = |c: char| is_path(c) || "-,?|[]".contains(c);
        let brace = after.find('{').filter(|at| match after[..*at].contains('\n') {
            true => after[..*at].trim().is_empty(),
            false => after[..*at].chars().all(is_type),
        });
        match (brace, function) {
            (Some(at), _) => head(close + at + 1, Ends::Brace),
            (None, Some(_)) => head(close, Ends::Word),
            (None, None) => None,
        }
    }

    /// Forgets the heads whose blocks have ended, with the brackets of a call that had the function.
    pub(super) fn end_head(&mut self) {
        while self.heads.pop_if(|around| self.blocks.len() <= *around).is_some() {
            let after = self.rest().trim_start_matches([' ', '\t']);
            if after.starts_with([')', ',']) {
                self.skip(|c| " \t),".contains(c));
            }
        }
    }

    /// Whether the line ends here, or the statement.
    pub(super) fn is_line_end(&self) -> bool {
        let rest = self.rest();
        rest.is_empty() || rest.starts_with(['\n', ';', ',', '}'])
    }

    /// Whether a call of a method after this name changes it, as three.js' `position.lerp(target, part)` does.
    pub(super) fn is_change(&self, name: &Range<usize>) -> bool {
        let is_number = [X, V].iter().any(|index| is_name_of(*index, &self.text[name.clone()]));
        let called = self.rest()[1..].split_once('(').map(|(method, _)| method.trim());
        is_number && called.is_some_and(|method| CHANGES.contains(&method))
    }

    /// Whether this name begins a call of the function that the lines replace.
    pub(super) fn is_call_of_base(&self, name: &Range<usize>) -> bool {
        let is_base = BASES.contains(&&self.text[name.clone()]);
        is_base || self.source[..name.start].ends_with("Super::")
    }
}

/// Returns the statements without the heads around them, which become blank in the text. A number that is declared
/// outside the function and assigned inside starts with its value.
pub(in super::super) fn without_heads(
    text: &mut String,
    statements: Vec<Statement>,
) -> Parsed<Vec<Statement>> {
    let (mut open, mut kept, mut is_done) = (Vec::new(), Vec::new(), false);
    let (mut inside, mut heads) = (Vec::new(), Vec::new());
    for statement in statements {
        match &statement {
            Statement::Head { at, is_function } => {
                if *is_function && is_done {
                    let what =
                        format!("`{}` is a second function", quoted(text[at.clone()].trim()));
                    return fault(at.clone(), what, "leave the lines of one, that of each frame");
                }
                open.push(Some(*is_function));
                heads.push(at.clone());
                continue;
            }
            Statement::End(_) => {
                if let Some(Some(is_function)) = open.pop() {
                    is_done |= is_function;
                    continue;
                }
            }
            Statement::Assign { name, declares: None, .. } if open.contains(&Some(true)) => {
                inside.push(text[name.clone()].to_owned());
            }
            statement if statement.depth() > 0 => open.push(None),
            _ => {}
        }
        kept.push((statement, open.is_empty() || open == [Some(false)]));
    }
    for head in heads {
        text.replace_range(head.clone(), &" ".repeat(head.len()));
    }
    let with_start = |(statement, is_outside)| match statement {
        Statement::Assign { name, joins: "", value, declares: Some(_) }
            if is_outside && inside.iter().any(|it| *it == text[name.clone()]) =>
        {
            Statement::Memory { name, value }
        }
        statement => statement,
    };
    Ok(kept.into_iter().map(with_start).collect())
}

/// Writes Python's `//`, unless it may begin a remark, and the `%` of Python and Lua as the signs of their own in these
/// lines.
pub(in super::super) fn with_floor_signs(text: &str) -> Cow<'_, str> {
    if C_PARTS.iter().any(|part| text.contains(part)) {
        return text.into();
    }
    let is_floored = text.contains('%') && FLOORED.iter().any(|word| text.contains(word));
    let text: Cow<'_, str> =
        if is_floored { text.replace('%', FLOOR_REMAINDER).into() } else { text.into() };
    if !text.contains("//") {
        return text;
    }
    let text = &*text;
    let is_python = PYTHON_PARTS.iter().any(|part| text.contains(part));
    let mut divided = text.to_owned();
    for (at, sign) in text.match_indices("//") {
        let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
        let (before, after) = (text[start..at].trim_end(), &text[at + sign.len()..]);
        let after = after.split(['\n', '#']).next().unwrap_or_default().trim();
        if before.contains('#')
            || !before.ends_with(|c: char| c.is_ascii_alphanumeric() || "_)]".contains(c))
        {
            continue;
        }
        let length = after.bytes().take_while(|byte| is_name_part(*byte)).count();
        let (word, next) = (&after[..length], after[length..].trim_start());
        let is_number = word.starts_with(|c: char| c.is_ascii_digit());
        let is_known = || !BUILT_IN.contains(&word) && after_each(text, word).any(assigns);
        let is_sure = is_python || is_number || length > 0 && is_known();
        let is_operand = length > 0 || after.starts_with(['(', '-']);
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let words: Vec<&str> = after.split_whitespace().collect();
        let is_prose = |two: &[&str]| {
            let is_joined = two.iter().any(|word| BETWEEN.contains(word));
            !is_joined && two[0].ends_with(is_part) && two[1].starts_with(is_part)
        };
        let ends = next.is_empty() || next.starts_with(|c| "+-*/%).,:[(<>=".contains(c));
        let is_joined = BETWEEN.iter().any(|word| begins_word(next, 0, &[word]));
        if is_sure && is_operand && (ends || is_joined) && !words.windows(2).any(is_prose) {
            divided.replace_range(at..at + sign.len(), FLOOR_DIVISION);
        }
    }
    divided.into()
}

#[cfg(test)]
mod tests {
    use super::with_floor_signs;

    #[test]
    fn two_slashes_divide_between_operands_and_begin_a_remark_elsewhere() {
        for (written, read) in [
            ("local d = v % 4\nx += d", "local d = v \u{7f} 4\nx += d"),
            ("x += v % 4", "x += v % 4"),
            ("x += v // 4", "x += v /\\ 4"),
            ("k = 4\nx += (v - x) // k * 2", "k = 4\nx += (v - x) /\\ k * 2"),
            ("self.x += self.v // drag", "self.x += self.v /\\ drag"),
            ("self.x += v//(2) # a // 2", "self.x += v/\\(2) # a // 2"),
            ("self.x += v // 60 fps", "self.x += v // 60 fps"),
            ("self.x += v // ease out", "self.x += v // ease out"),
            ("// 4\nx += v", "// 4\nx += v"),
            ("x += v // drag", "x += v // drag"),
            ("x += v // x", "x += v // x"),
            ("x += v; // 4", "x += v; // 4"),
            ("let k = 4\nx += k // 4", "let k = 4\nx += k // 4"),
        ] {
            assert_eq!(with_floor_signs(written), read, "{written}");
        }
    }
}
