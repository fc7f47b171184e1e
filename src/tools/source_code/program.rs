//! Reads the source of a method.

use std::collections::BTreeSet;

use super::dialect::Language;
use crate::sim::law::SHARED_STEPS;

/// An input of the function besides `x`, `v` and `h`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodInput<'a> {
    /// Name of the input.
    pub name: &'a str,
    /// Arguments of the input if it is a function; empty for a number.
    pub arguments: Vec<&'a str>,
    /// Whether the input is a whole number.
    pub is_whole: bool,
    /// Description of the input, as a phrase in lower case.
    pub about: &'a str,
}

/// A number carried from step to step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StateVariable<'a> {
    pub(super) name: &'a str,
    /// Value before the first step.
    pub(super) start: &'a str,
}

/// A function that returns a number.
#[derive(Clone, Debug)]
pub(super) struct Function<'a> {
    pub(super) name: &'a str,
    pub(super) inputs: Vec<MethodInput<'a>>,
    pub(super) comments: Vec<&'a str>,
    pub(super) body: Vec<Line<'a>>,
}

/// A statement. An expression keeps its line breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Line<'a> {
    Blank,
    Comment(&'a str),
    Constant {
        name: &'a str,
        value: String,
    },
    Let {
        name: &'a str,
        value: String,
    },
    Var {
        name: &'a str,
        value: String,
    },
    /// Declares a whole number that counts.
    Counter {
        name: &'a str,
        value: String,
    },
    /// An assignment with its operator: `x += h * v`.
    Assignment(String),
    If(String),
    Else,
    While(String),
    End,
    Return(String),
    Fail,
    Stay,
}

impl Line<'_> {
    /// Whether the line changes `name`.
    fn assigns(&self, name: &str) -> bool {
        matches!(self, Line::Assignment(text) if text.split(' ').next() == Some(name))
    }
}

/// The parsed source of a method.
#[derive(Clone, Debug, Default)]
pub(super) struct Program<'a> {
    /// Comments at the head of the source.
    pub(super) notes: Vec<&'a str>,
    /// Words of the source that replace the card's sentence on a [claim](CLAIMS) in the header.
    claims: Vec<(&'a str, &'a str)>,
    /// Languages without the function, by their ids, each with the reason. An empty id stands for all languages.
    refusals: Vec<(&'a str, &'a str)>,
    pub(super) inputs: Vec<MethodInput<'a>>,
    pub(super) memory: Vec<StateVariable<'a>>,
    pub(super) functions: Vec<Function<'a>>,
    pub(super) body: Vec<Line<'a>>,
}

/// Parts of the header that a source can word itself. They are claims of the card, use on several coordinates, and the
/// moment at which the method holds a time-dependent force.
const CLAIMS: [&str; 5] = ["order", "stability", "symplectic", "several", "held"];

impl<'a> Program<'a> {
    /// Reads a source.
    ///
    /// # Panics
    /// If the source is malformed. Sources are the package's own, and the tests read all of them.
    pub(super) fn read(text: &'a str) -> Self {
        let mut program = Self::default();
        let mut lines = text.lines().peekable();
        let mut comments = Vec::new();
        while let Some(line) = lines.next() {
            let line = line.trim();
            let (word, rest) = line.split_once([' ', ':']).unwrap_or((line, ""));
            match word {
                "refused" => {
                    let (language, reason) = line.split_once(": ").expect("a refusal says why");
                    let language = language.trim_start_matches("refused").trim();
                    program.refusals.push((language, reason));
                }
                claim if CLAIMS.contains(&claim) && line[claim.len()..].starts_with(": ") => {
                    program.claims.push((claim, rest.trim()));
                }
                "takes" => {
                    let (input, about) = rest.split_once(": ").expect("an input says what it is");
                    program.inputs.extend(inputs(input, about));
                    program.notes.append(&mut comments);
                }
                "memory" => {
                    let (name, start) = rest.split_once(" = ").expect("a field has a start");
                    program.memory.push(StateVariable { name, start });
                }
                "use" => {
                    let shared = SHARED_STEPS.iter().find(|(name, _)| *name == rest);
                    let (_, text) = shared.unwrap_or_else(|| panic!("no shared source {rest}"));
                    program.functions.extend(Program::read(text).functions);
                }
                "fn" => {
                    let head = rest.strip_suffix(") {").expect("a function opens a block");
                    let (name, taken) = head.split_once('(').expect("a function takes something");
                    let inputs = inputs(taken, "");
                    // The function ends at the brace in the first column.
                    let inside = std::iter::from_fn(|| lines.next_if(|line| *line != "}"));
                    let body = statements(inside);
                    lines.next();
                    let comments = std::mem::take(&mut comments);
                    program.functions.push(Function { name, inputs, comments, body });
                }
                "#" => comments.push(rest),
                "" => {}
                _ => {
                    // This is the first statement of the step. Everything from here on is the step, with the comments
                    // above.
                    let above = comments.drain(..).map(Line::Comment);
                    program.body = above.collect();
                    program.body.extend(statements(std::iter::once(line).chain(lines)));
                    break;
                }
            }
        }
        program
    }

    /// Returns the names of numbers and inputs that the program declares, after those of its state.
    pub(super) fn names(&self) -> Vec<&'a str> {
        let mut names = vec!["x", "v", "h", "memory"];
        let inputs = self.functions.iter().flat_map(|function| &function.inputs);
        names.extend(self.inputs.iter().chain(inputs).map(|input| input.name));
        names.extend(self.memory.iter().map(|field| field.name));
        let lines = self.functions.iter().flat_map(|function| &function.body);
        names.extend(self.body.iter().chain(lines).filter_map(|line| match line {
            Line::Constant { name, .. }
            | Line::Let { name, .. }
            | Line::Var { name, .. }
            | Line::Counter { name, .. } => Some(*name),
            _ => None,
        }));
        let mut seen = BTreeSet::new();
        names.retain(|name| seen.insert(*name));
        names
    }

    /// Whether the step uses the value of `name` other than to assign it.
    pub(super) fn reads(&self, name: &str) -> bool {
        self.body.iter().any(|line| {
            let text = match line {
                Line::Constant { value, .. }
                | Line::Let { value, .. }
                | Line::Counter { value, .. }
                | Line::Var { value, .. } => value,
                Line::If(value) | Line::While(value) | Line::Return(value) => value,
                Line::Assignment(text) => match text.split_once(" = ") {
                    Some((_, value)) => value,
                    None => text,
                },
                Line::Blank
                | Line::Comment(_)
                | Line::Else
                | Line::End
                | Line::Fail
                | Line::Stay => "",
            };
            text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == name)
        })
    }

    /// Whether a statement changes `name`.
    pub(super) fn assigns(&self, name: &str) -> bool {
        self.body.iter().any(|line| line.assigns(name))
    }

    /// Whether every step assigns `name`.
    pub(super) fn replaces(&self, name: &str) -> bool {
        let mut depth = 0;
        self.body.iter().any(|line| {
            match line {
                Line::If(_) | Line::While(_) => depth += 1,
                Line::End => depth -= 1,
                _ => {}
            }
            depth == 0 && line.assigns(name)
        })
    }

    /// Returns the source's own words for this claim of the card, if there are any.
    pub(super) fn claim(&self, claim: &str) -> Option<&'a str> {
        self.claims.iter().find(|(known, _)| *known == claim).map(|(_, words)| *words)
    }

    /// Whether the function has an input with this name.
    pub(super) fn takes(&self, name: &str) -> bool {
        self.inputs.iter().any(|input| input.name == name)
    }

    /// Returns the reason why this language has no function, if it has none.
    pub(super) fn refusal(&self, language: Language) -> Option<&'a str> {
        let mut refusals = self.refusals.iter();
        let of_it = refusals.find(|(id, _)| id.is_empty() || *id == language.id());
        of_it.map(|(_, reason)| *reason)
    }
}

/// Returns the names of the whole numbers, which are inputs, and counters declared in `body`.
pub(super) fn whole_numbers<'a>(inputs: &[MethodInput<'a>], body: &[Line<'a>]) -> Vec<&'a str> {
    let of_input = |input: &MethodInput<'a>| input.is_whole.then_some(input.name);
    let of_line = |line: &Line<'a>| match line {
        Line::Counter { name, .. } => Some(*name),
        _ => None,
    };
    inputs.iter().filter_map(of_input).chain(body.iter().filter_map(of_line)).collect()
}

/// Reads inputs separated by commas: `a(x, v), x, whole n`.
fn inputs<'a>(mut text: &'a str, about: &'a str) -> Vec<MethodInput<'a>> {
    let mut inputs = Vec::new();
    while !text.is_empty() {
        let end = text.find([',', '(']).unwrap_or(text.len());
        let (name, mut rest) = text.split_at(end);
        let mut arguments = Vec::new();
        if let Some(inside) = rest.strip_prefix('(') {
            let (inside, after) = inside.split_once(')').expect("a closed parenthesis");
            arguments = inside.split(", ").collect();
            rest = after;
        }
        let (name, is_whole) = match name.trim().strip_prefix("whole ") {
            Some(name) => (name, true),
            None => (name.trim(), false),
        };
        inputs.push(MethodInput { name, arguments, is_whole, about });
        text = rest.trim_start_matches([',', ' ']);
    }
    inputs
}

/// Reads statements. A line that begins with an operator continues the line before.
fn statements<'a>(lines: impl Iterator<Item = &'a str>) -> Vec<Line<'a>> {
    let mut lines = lines.map(str::trim).peekable();
    let mut read = Vec::new();
    while let Some(first) = lines.next() {
        let mut rest = String::new();
        while let Some(more) = lines.next_if(|line| continues(line)) {
            rest.push('\n');
            rest.push_str(more);
        }
        read.push(statement(first, &rest));
    }
    read
}

fn continues(line: &str) -> bool {
    let word = line.split(' ').next().unwrap_or_default();
    ["+", "-", "*", "/", "and", "or"].contains(&word)
}

/// Reads the statement whose first line is `first`; `rest` continues that line.
fn statement<'a>(first: &'a str, rest: &str) -> Line<'a> {
    let (word, after) = first.split_once(' ').unwrap_or((first, ""));
    let named = || {
        let (name, value) = after.split_once(" = ").expect("a declaration has a value");
        (name, format!("{value}{rest}"))
    };
    let condition = || {
        let whole = format!("{after}{rest}");
        whole.strip_suffix(" {").expect("a condition opens a block").to_owned()
    };
    match (word, first) {
        ("", _) => Line::Blank,
        ("#", _) => Line::Comment(after),
        ("const", _) => {
            let (name, value) = named();
            Line::Constant { name, value }
        }
        ("let", _) => {
            let (name, value) = named();
            Line::Let { name, value }
        }
        ("var", _) => {
            let (name, value) = named();
            Line::Var { name, value }
        }
        ("count", _) => {
            let (name, value) = named();
            Line::Counter { name, value }
        }
        ("if", _) => Line::If(condition()),
        ("while", _) => Line::While(condition()),
        (_, "} else {") => Line::Else,
        (_, "}") => Line::End,
        (_, "fail") => Line::Fail,
        (_, "stay") => Line::Stay,
        ("return", _) => Line::Return(format!("{after}{rest}")),
        _ => Line::Assignment(format!("{first}{rest}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_is_read_into_its_parts() {
        let program = Program::read(
            "# Be careful.\nrefused c: it has no such thing\nstability: at small steps\ntakes f(x): the force\ntakes drag: in kg/s\n\
             memory last = nan\n\n# Twice.\nfn twice(f(x), x) {\n    return 2.0\n        * f(x)\n}\n\n\
             # Now.\nlet k = f(x)\nif k < 0.0\n    or h == 0.0 {\n    fail\n} else {\n    v += k\n}\n",
        );
        assert_eq!(program.notes, ["Be careful."]);
        assert_eq!(program.refusal(Language::C), Some("it has no such thing"));
        assert_eq!(program.refusal(Language::Rust), None);
        assert_eq!(program.claim("stability"), Some("at small steps"));
        assert_eq!(program.claim("order"), None);
        assert!(program.takes("drag") && !program.takes("mass"));
        let inputs: Vec<_> = program.inputs.iter().map(|i| (i.name, i.arguments.len())).collect();
        assert_eq!(inputs, [("f", 1), ("drag", 0)]);
        assert_eq!(program.inputs[1].about, "in kg/s");
        assert_eq!((program.memory[0].name, program.memory[0].start), ("last", "nan"));
        let twice = &program.functions[0];
        assert_eq!((twice.name, &twice.comments[..]), ("twice", &["Twice."][..]));
        assert_eq!(twice.body, [Line::Return("2.0\n* f(x)".into())]);
        assert_eq!(
            program.body,
            [
                Line::Comment("Now."),
                Line::Let { name: "k", value: "f(x)".into() },
                Line::If("k < 0.0\nor h == 0.0".into()),
                Line::Fail,
                Line::Else,
                Line::Assignment("v += k".into()),
                Line::End,
            ]
        );
    }

    #[test]
    fn a_source_can_refuse_every_language() {
        let program = Program::read("refused: it steps pairs of bodies\n");
        assert!(Language::ALL.iter().all(|language| program.refusal(*language).is_some()));
    }
}
