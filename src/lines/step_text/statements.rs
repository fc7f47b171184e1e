//! The statements of a step, with their positions in the text.

use std::collections::VecDeque;
use std::ops::Range;

use blocks::{Ends, is_choice};

use crate::fault::{Parsed, fault, quoted};
use crate::token::{is_name_part, is_name_start};

mod blocks;
mod heads;

pub(super) use heads::{with_floor_signs, without_heads};

/// A statement with the byte ranges of its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Statement {
    /// `name = value`. `joins` is the operator that combines the value with the previous number; it is empty for `=`.
    Assign {
        name: Range<usize>,
        joins: &'static str,
        value: Range<usize>,
        declares: Option<Declares>,
    },
    /// `memory name = value`.
    Memory { name: Range<usize>, value: Range<usize> },
    /// `memory name[size] = value`.
    Array { name: Range<usize>, size: Range<usize>, value: Range<usize> },
    /// `name[index] = value`.
    Store { name: Range<usize>, index: Range<usize>, value: Range<usize> },
    /// `tick count` or `tick count of length`.
    Tick { word: Range<usize>, count: Range<usize>, length: Option<Range<usize>> },
    /// `show value`.
    Show { word: Range<usize>, value: Range<usize> },
    /// `if condition {`.
    If(Range<usize>),
    /// `} else {`, and the condition in `} else if condition {`.
    Else(Option<Range<usize>>, Range<usize>),
    /// `while condition {`.
    While(Range<usize>, Range<usize>),
    /// `}`.
    End(Range<usize>),
    /// `takes name`, with the arguments of a function.
    Takes(Range<usize>),
    /// `use name`.
    Use(Range<usize>),
    /// `fn name(inputs) {`.
    Function { name: Range<usize>, inputs: Range<usize> },
    /// The head of a function or a class around the lines.
    Head { at: Range<usize>, is_function: bool },
    /// `return value`.
    Return { word: Range<usize>, value: Range<usize> },
    /// `fail` or `stay`, and whether the step fails.
    Stop(Range<usize>, bool),
    /// A remark on a line of its own, without its sign.
    Remark(String),
    /// An empty line between others.
    Blank,
}

/// The kind of number that a statement declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declares {
    /// A number.
    Number,
    /// A number that no line changes.
    Constant,
    /// A whole number.
    Counter,
}

impl Statement {
    /// The number of blocks that the statement opens, less those that it closes.
    pub(super) fn depth(&self) -> i32 {
        match self {
            Self::If(_) | Self::While(..) | Self::Function { .. } | Self::Head { .. } => 1,
            Self::End(_) => -1,
            _ => 0,
        }
    }
}

/// Words that declare a number in some language.
const DECLARERS: &str = "let var const float double auto local mut final static count val Vector2 Vector3 \
    export onready public private protected readonly internal";

fn is_declarer(word: &str) -> bool {
    DECLARERS.split_whitespace().any(|declarer| declarer == word)
}

/// Words that begin a line which no step can have, each with a remedy.
const REFUSED: [(&str, &str); 5] = [
    ("for", "write a loop as `while n < 4 { n += 1 }`, or the lines of one step"),
    ("func", "write the lines inside the function"),
    ("def", "write the lines inside the function"),
    ("void", "write the lines inside the function"),
    ("function", "write the lines inside the function"),
];

/// The assignment operators, each with the operator that combines the value with the previous number.
const ASSIGNMENTS: [(&str, &str); 6] =
    [("+=", "+"), ("-=", "-"), ("*=", "*"), ("/=", "/"), (":=", ""), ("=", "")];

/// Words that end a block after `then`.
const WORDS: [&str; 4] = ["end", "else", "elseif", "elif"];

/// Whether one of these words is at a byte.
fn begins_word(text: &str, at: usize, words: &[&str]) -> bool {
    let bytes = text.as_bytes();
    let is_part =
        |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(|it| is_name_part(*it));
    !is_part(at.checked_sub(1))
        && words
            .iter()
            .any(|word| bytes[at..].starts_with(word.as_bytes()) && !is_part(Some(at + word.len())))
}

/// Returns the statements of a text whose remarks are blank. `source` is the text with them.
pub(super) fn statements(text: &str, source: &str) -> Parsed<Vec<Statement>> {
    if let Some(at) = text.find("/*") {
        return fault(at..at + 2, "the remark is not closed", "write `*/` at its end");
    }
    let (blocks, heads, read) = (Vec::new(), Vec::new(), VecDeque::new());
    let mut reader = Reader { text, source, at: 0, blocks, heads, read };
    let mut statements = Vec::new();
    loop {
        let before = reader.at;
        reader.skip(|c| c.is_ascii_whitespace() || c == ';');
        add_remarks(&mut statements, source, before..reader.at);
        match reader.next()? {
            Some(statement) => statements.push(statement),
            None => return Ok(statements),
        }
    }
}

/// Adds the remarks and the empty lines between two statements.
fn add_remarks(statements: &mut Vec<Statement>, source: &str, between: Range<usize>) {
    let mut at = between.start;
    for line in source[between.clone()].split_inclusive('\n') {
        let (start, text) = (at, line.trim());
        at += line.len();
        let is_first = start == between.start && start > 0;
        if is_first || !line.ends_with('\n') && at < source.len() {
            continue;
        }
        let signs = text.strip_prefix("//").or(text.strip_prefix('#'));
        if let Some(remark) = signs.map(str::trim_start) {
            statements.push(Statement::Remark(remark.to_owned()));
        } else if text.is_empty()
            && at < source.len()
            && !matches!(statements.last(), None | Some(Statement::Blank))
        {
            statements.push(Statement::Blank);
        }
    }
}

struct Reader<'t> {
    text: &'t str,
    /// The text as it is written, of the same length, whose lines begin where their author has put them.
    source: &'t str,
    at: usize,
    /// The end of each open block.
    blocks: Vec<Ends>,
    /// The number of blocks around each open function.
    heads: Vec<usize>,
    /// Statements of the last line that are still to be returned.
    read: VecDeque<Statement>,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn skip(&mut self, blank: impl Fn(char) -> bool) {
        self.at += self.rest().len() - self.rest().trim_start_matches(blank).len();
    }

    /// Returns the byte range of the next name; the range is empty if the next token is no name.
    fn name(&self) -> Range<usize> {
        let is_name = self.rest().starts_with(is_name_start);
        let length = self.rest().bytes().take_while(|byte| is_name && is_name_part(*byte)).count();
        self.at..self.at + length
    }

    fn next(&mut self) -> Parsed<Option<Statement>> {
        self.skip(|c| c.is_ascii_whitespace() || c == ';');
        let ahead = self.read.pop_front();
        let statement = match ahead {
            None => match self.end_without_sign()? {
                None => self.statement()?,
                end => end,
            },
            ahead => ahead,
        };
        self.note_statement(statement.as_ref());
        self.end_head();
        Ok(statement)
    }

    fn statement(&mut self) -> Parsed<Option<Statement>> {
        if let Some(foreign) = self.attribute_or_head()? {
            return Ok(Some(foreign));
        }
        let start = self.at;
        match (self.rest().chars().next(), &self.text[self.name()]) {
            (None, _) => Ok(None),
            (Some('}'), _) => {
                self.at += 1;
                self.blocks.pop();
                let brace = start..self.at;
                self.skip(|c| c.is_ascii_whitespace());
                if &self.text[self.name()] != "else" {
                    self.at = brace.end;
                    return Ok(Some(Statement::End(brace)));
                }
                self.other_case(brace, Ends::Brace).map(Some)
            }
            (_, "if") => Ok(Some(Statement::If(self.condition(self.name())?))),
            (_, word) if self.is_worded() && WORDS.contains(&word) => {
                let word = self.name();
                self.blocks.pop();
                if &self.text[word.clone()] == "end" {
                    self.at = word.end;
                    return Ok(Some(Statement::End(word)));
                }
                self.other_case(word, Ends::Word).map(Some)
            }
            (_, "while") => {
                let word = self.name();
                Ok(Some(Statement::While(word.clone(), self.condition(word)?)))
            }
            (_, "return") => {
                let word = self.name();
                self.at = word.end;
                let value = self.at..self.end();
                self.at = value.end;
                Ok(Some(Statement::Return { word, value }))
            }
            (_, "fn") => self.function().map(Some),
            (_, word @ ("takes" | "use")) if self.is_followed_by_name() => {
                let is_input = word == "takes";
                self.at = self.name().end;
                let line = self.rest().find(['\n', ';']).unwrap_or(self.rest().len());
                let named = self.at..self.at + line;
                self.at = named.end;
                Ok(Some(if is_input { Statement::Takes(named) } else { Statement::Use(named) }))
            }
            (_, "tick" | "show") if self.is_followed_by_value() => Ok(Some(self.frame_word())),
            (_, "else") => fault(
                self.name(),
                "`else` follows no block",
                "write `if condition { … } else { … }`",
            ),
            _ => self.assignments().map(Some),
        }
    }

    fn is_worded(&self) -> bool {
        self.blocks.last() == Some(&Ends::Word)
    }

    /// Whether a name follows the next name on its line.
    fn is_followed_by_name(&self) -> bool {
        let after = self.text[self.name().end..].trim_start_matches([' ', '\t']);
        after.starts_with(is_name_start)
    }

    /// Whether a value follows the next name on its line, as in `tick 2`.
    fn is_followed_by_value(&self) -> bool {
        let after = &self.text[self.name().end..];
        let value = after.trim_start_matches([' ', '\t']);
        let is_assigned = ASSIGNMENTS.iter().any(|(sign, _)| value.starts_with(sign));
        value.len() < after.len() && !is_assigned && !value.starts_with(['\n', ';', '}'])
    }

    /// Reads `tick count of length`, or `show value`.
    fn frame_word(&mut self) -> Statement {
        let word = self.name();
        self.at = word.end;
        let value = self.at..self.end();
        self.at = value.end;
        if &self.text[word.clone()] == "show" {
            return Statement::Show { word, value };
        }
        let text = &self.text[value.clone()];
        let of = (0..text.len()).find(|at| begins_word(text, *at, &["of"]));
        let length = of.map(|of| value.start + of + "of".len()..value.end);
        let count = value.start..of.map_or(value.end, |of| value.start + of);
        Statement::Tick { word, count, length }
    }

    /// Reads the first line of a function.
    fn function(&mut self) -> Parsed<Statement> {
        let word = self.name();
        self.at = word.end;
        self.skip(|c| c == ' ' || c == '\t');
        let name = self.name();
        self.at = name.end;
        // The inputs end at the parenthesis before the brace.
        let head = self.rest().find(['{', '}', ';']).unwrap_or(self.rest().len());
        let inputs = self.rest()[..head].trim_end();
        let inside = inputs.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let Some(inside) = inside.filter(|_| !name.is_empty()) else {
            return fault(word, "the function has no name or no inputs", "write `fn f(x, v) {`");
        };
        let inputs = self.at + 1..self.at + 1 + inside.len();
        self.at += head;
        self.open(word)?;
        Ok(Statement::Function { name, inputs })
    }

    /// Returns the end of the statement, which is at `;`, at a brace, at a comma outside brackets, or at the end of a
    /// line that does not continue.
    fn end(&self) -> usize {
        let mut depth = 0_i32;
        for (at, sign) in self.rest().char_indices() {
            match sign {
                '(' | '[' => depth += 1,
                ')' | ']' => depth -= 1,
                '{' if is_choice(&self.rest()[..at]) => depth += 1,
                '}' if is_choice(&self.rest()[..at]) && depth > 0 => depth -= 1,
                ';' | '{' | '}' => return self.at + at,
                ',' if depth <= 0 => return self.at + at,
                _ if self.is_worded() && begins_word(self.rest(), at, &WORDS) => {
                    return self.at + at;
                }
                '\n' if depth <= 0
                    && !continues_on_next_line(&self.rest()[..at], &self.rest()[at..]) =>
                {
                    return self.at + at;
                }
                _ => {}
            }
        }
        self.text.len()
    }

    /// Reads an assignment, which `declares` its name as the one before on the same line does.
    fn assignment(&mut self, mut declares: Option<Declares>) -> Parsed<Statement> {
        let (start, end) = (self.at, self.end());
        let whole = |reader: &Self| start..end.max(reader.at).max(start + 1).min(reader.text.len());
        let mut name = self.name();
        if let Some((word, remedy)) =
            REFUSED.iter().find(|(word, _)| *word == &self.text[name.clone()])
        {
            return fault(name, format!("`{word}` cannot stand in a step"), *remedy);
        }
        let is_memory = &self.text[name.clone()] == "memory";
        while is_memory && declares.is_none()
            || is_declarer(&self.text[name.clone()])
            || declares.is_some() && self.is_followed_by_name()
        {
            let declared = match &self.text[name.clone()] {
                "const" => Declares::Constant,
                "count" => Declares::Counter,
                _ => declares.unwrap_or(Declares::Number),
            };
            self.at = name.end;
            self.skip(|c| c == ' ' || c == '\t');
            if self.name().is_empty() {
                break;
            }
            declares = Some(declared);
            name = self.name();
        }
        if name.is_empty() {
            let span = start..self.text.ceil_char_boundary(start + 1);
            let what = format!("`{}` begins no statement", quoted(&self.text[span.clone()]));
            return fault(span, what, "write an assignment, such as `x += v * dt`");
        }
        self.at = name.end;
        self.skip(|c| c == ' ' || c == '\t');
        if declares.is_some() && self.rest().starts_with(':') && !self.rest().starts_with(":=") {
            self.at += 1;
            self.skip(|c| c == ' ' || c == '\t');
            self.at = self.name().end;
            self.skip(|c| c == ' ' || c == '\t');
        }
        if self.rest().starts_with(',') {
            return self.several(name, declares);
        }
        let mut index = None;
        if self.rest().starts_with('[') {
            let length = self.rest().find([']', '\n', ';', '=']).unwrap_or(0);
            if self.rest()[length..].starts_with(']') {
                index = Some(self.at + 1..self.at + length);
                self.at += length + 1;
                self.skip(|c| c == ' ' || c == '\t');
            }
        }
        let written = quoted(&self.text[name.clone()]);
        let one_part = |scan: &Self| {
            format!("`{}` is one part of a value", quoted(scan.text[whole(scan)].trim()))
        };
        let operator = ASSIGNMENTS.iter().find(|(sign, _)| self.rest().starts_with(sign));
        let Some((sign, joins)) = operator.filter(|_| !self.rest().starts_with("==")) else {
            let (what, remedy) = match self.rest().chars().next() {
                _ if declares.is_some() && self.is_line_end() => return Ok(Statement::Blank),
                Some('.') if self.is_change(&name) => {
                    let value = name.start..end;
                    self.at = end;
                    return Ok(Statement::Assign { name, joins: "", value, declares: None });
                }
                Some('(' | '.') if self.is_call_of_base(&name) => {
                    self.at = end;
                    return Ok(Statement::Blank);
                }
                Some('.' | '[') => (one_part(self), ONE_NUMBER),
                Some('(') if written.eq_ignore_ascii_case("move_and_slide") => {
                    (format!("`{written}(…)` is a call"), "write `x += v * dt` in its place")
                }
                Some('(') => (
                    format!("`{written}(…)` is a call"),
                    "remove it if it moves nothing, or write an assignment, such as `x += v * dt`",
                ),
                Some('+' | '-') => (format!("`{written}` is counted"), "write `x += 1`"),
                _ if ["fail", "stay"].contains(&&*written) => {
                    return Ok(Statement::Stop(name, written == "fail"));
                }
                _ => (
                    format!("`{written}` is not assigned"),
                    "write `=`, `+=`, `-=`, `*=` or `/=` after it",
                ),
            };
            return fault(whole(self), what, remedy);
        };
        let value = self.at + sign.len()..end.max(self.at + sign.len());
        self.at = value.end;
        if self.rest().starts_with('{') {
            let brace = self.at..self.at + 1;
            return fault(brace, "`{` opens no block here", "write `if condition {`, or remove it");
        }
        if let Some(index) = index {
            if !joins.is_empty() {
                let remedy = format!("{ONE_NUMBER}; an array of a loop takes `=`");
                return fault(whole(self), one_part(self), remedy);
            }
            return Ok(match is_memory && declares.is_some() {
                true => Statement::Array { name, size: index, value },
                false => Statement::Store { name, index, value },
            });
        }
        Ok(match is_memory && declares.is_some() {
            true if joins.is_empty() => Statement::Memory { name, value },
            _ => Statement::Assign { name, joins, value, declares },
        })
    }
}

/// The remedy for a part of a value, such as `pos.x`.
const ONE_NUMBER: &str =
    "a step moves one number: write `x` for its position and `v` for its velocity";

/// Whether a statement continues after the end of a line.
fn continues_on_next_line(before: &str, after: &str) -> bool {
    let is_operator = |sign: char| "+-*/^=<>?:&|%".contains(sign);
    let (before, after) = (before.trim_end(), after.trim_start());
    let is_word = |word: &str| {
        let rest = after.strip_prefix(word);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_'))
    };
    before.ends_with(|sign| is_operator(sign) || sign == ',')
        || after.starts_with(is_operator)
        || is_word("and")
        || is_word("or")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step_text::plain::plain;

    fn read(text: &str) -> Vec<String> {
        let (plain, _) = plain(text);
        let of = |span: Range<usize>| plain[span].trim().to_owned();
        let shown = |statement| match statement {
            Statement::Assign { name, joins, value, declares } => {
                let declared = declares.map_or(String::new(), |it| format!("{it:?} "));
                format!("{declared}{} {joins}= {}", of(name), of(value))
            }
            Statement::Memory { name, value } => format!("memory {} = {}", of(name), of(value)),
            Statement::Array { name, size, value } => {
                format!("memory {}[{}] = {}", of(name), of(size), of(value))
            }
            Statement::Store { name, index, value } => {
                format!("{}[{}] = {}", of(name), of(index), of(value))
            }
            Statement::Tick { count, length, .. } => {
                format!("tick {} of {}", of(count), length.map_or("H".into(), of))
            }
            Statement::Show { value, .. } => format!("show {}", of(value)),
            Statement::If(condition) => format!("if {}", of(condition)),
            Statement::While(_, condition) => format!("while {}", of(condition)),
            Statement::Takes(input) => format!("takes {}", of(input)),
            Statement::Use(name) => format!("use {}", of(name)),
            Statement::Function { name, inputs } => format!("fn {} {}", of(name), of(inputs)),
            Statement::Head { at, .. } => format!("around {}", of(at)),
            Statement::Return { value, .. } => format!("return {}", of(value)),
            Statement::Stop(word, _) => of(word),
            Statement::Else(condition, _) => format!("else {}", condition.map_or("".into(), of)),
            Statement::End(_) => "end".into(),
            Statement::Remark(text) => format!("# {text}"),
            Statement::Blank => String::new(),
        };
        statements(&plain, text).unwrap().into_iter().map(shown).collect()
    }

    #[test]
    fn statements_end_at_semicolons_braces_and_complete_lines() {
        let text = "let k: f32 = 3; v = (v + (1 - x)\n * 0.2) * k\n  - 1\nx += v;\n";
        assert_eq!(read(text), ["Number k = 3", "v = (v + (1 - x)\n * 0.2) * k\n  - 1", "x += v"]);
        let text = "memory old = 0\nif (x > 1) { x = 1; v = 0 } else if x < 0\n{\nx = 0 } else { old = x }";
        assert_eq!(
            read(text),
            [
                "memory old = 0",
                "if (x > 1)",
                "x = 1",
                "v = 0",
                "else x < 0",
                "x = 0",
                "else ",
                "old = x",
                "end"
            ]
        );
        assert_eq!(
            read("const float a := 1\n\n;;float b = 2"),
            ["Constant a = 1", "", "Number b = 2"]
        );
        let text = "takes whole n\nuse solve\nfn f(a(x, v), x) {\n  while x < 1 {\n stay }\n return a(x,\n 1) }; fail";
        let found = ["takes whole n", "use solve", "fn f a(x, v), x", "while x < 1", "stay", "end"];
        assert_eq!(read(text)[..6], found);
        assert_eq!(read(text)[6..], ["return a(x,\n 1)", "end", "fail"]);
        assert_eq!(read(" \n;"), [""; 0]);
        let text =
            "memory past[4] = 0; past[i + 1] = past[i]; tick floor(n) of dt\ntick 1; show owed / H";
        let found = ["memory past[4] = 0", "past[i + 1] = past[i]", "tick floor(n) of dt"];
        assert_eq!(read(text)[..3], found);
        assert_eq!(read(text)[3..], ["tick 1 of H", "show owed / H"]);
        let text = "if x < 1:\n  x = 1\n\n  if v > 1: v = 0; x = 2\nelif x > 3:\n\tx = 3\nelse:\n  v = 1\nx += v";
        let found =
            ["if x < 1", "x = 1", "", "if v > 1", "v = 0", "x = 2", "end", "else x > 3", "x = 3"];
        assert_eq!(read(text)[..9], found);
        assert_eq!(read(text)[9..], ["else ", "v = 1", "end", "x += v"]);
        let text =
            "if (x < (1)) x = 1, v = 2; else if (v > 1)\n  if (x > 2) v = 1\n  else v = 3;\nx += v";
        let found = [
            "if (x < (1))",
            "x = 1",
            "v = 2",
            "else (v > 1)",
            "if (x > 2)",
            "v = 1",
            "else ",
            "v = 3",
        ];
        assert_eq!(read(text)[..8], found);
        assert_eq!(read(text)[8..], ["end", "end", "x += v"]);
        let found = ["Number a = min(1, 2)", "Number b = 3", "Number c = 4", "Number d = 5"];
        assert_eq!(read("float a = min(1, 2), b = 3;\nlocal c, d = 4, 5"), found);
        let text = "// One.\n\n\nx += v # two\n  #three\nv *= 2 /* four */\n# five\n";
        let found = ["# One.", "", "x += v", "# three", "v *= 2", "# five"];
        assert_eq!(read(text), found);
        assert_eq!(read("count n = 1; const float k = 2"), ["Counter n = 1", "Constant k = 2"]);
    }

    #[test]
    fn a_malformed_statement_is_refused_at_its_place() {
        for (text, at) in [
            ("x", 0..1),
            ("x == 1", 0..6),
            ("x = 1; pos.x += 1", 7..17),
            ("update(x)", 0..9),
            ("for x < 1 { x = 1 }", 0..3),
            ("while x < 1; x = 1", 0..5),
            ("fn f { x = 1 }", 0..2),
            ("if x < 0 x = 1", 0..2),
            ("if x < 0; x = 1", 0..2),
            ("else { x = 1 }", 0..4),
            ("x = 1 { v = 1 }", 6..7),
            ("½ = 1", 0..2),
            ("let", 0..3),
            ("def x", 0..3),
            ("3", 0..1),
            ("x, v = v", 0..5),
            ("x, v = v, x", 9..11),
            ("if x > 1 { x = 1 } else", 19..23),
            ("if (x > 1) 2", 0..2),
            ("if x > 1", 0..2),
        ] {
            assert_eq!(statements(text, text).unwrap_err().span, at, "{text}");
        }
    }
}
