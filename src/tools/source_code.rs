//! Prints the methods as source code for a game. For each method, it is one function of `x`, `v` and the step `h`, in
//! each of four languages.
//!
//! A method is written once, in `assets/methods`, in a small language of its own with one statement per line, in which
//! all values are numbers. The printer translates it line by line with the table of dialects, and makes the header from
//! the method's card. `tests/library/source_code` compiles the printed functions and compares their steps with the
//! method's.
//!
//! | statement | meaning |
//! |---|---|
//! | `takes a(x, v): about` | an input: a function of these or, without parentheses, a number; with a description |
//! | `memory last_h = nan` | a number carried from step to step, with its value before the first |
//! | `use solve` | the functions of `assets/methods/shared/solve.step` |
//! | `fn solve(a(x, v), x) {` | a function that returns a number |
//! | `const`, `let`, `var` | a constant, a number, a number that changes; `+=` and the like change it |
//! | `count`, and `takes whole n` | a whole number that changes, and one that is an input |
//! | `4e-15\|2e-6` | a number in double and in single precision |
//! | `if … {`, `} else {`, `while … {`, `}` | with `and` and `or` |
//! | `fail`, `stay` | ends the step with `x` and `v` not a number, or with their present values |
//! | `stability: when`, and `order`, `symplectic` | replaces the card's sentence in the header |
//! | `several: how`, `held: where` | the header's words on several coordinates, and on forces that depend on time |
//! | `refused c: why`, `refused: why` | excludes the function from this language, or from all |
//!
//! A comment begins with `#`. Comments before the first statement belong to the header. A line that begins with an
//! operator continues the line before.

use std::fmt;

use crate::sim::integrators::Method;

pub use dialect::{Language, Precision};
pub use program::MethodInput;
use program::Program;

mod dialect;
mod header;
mod names;
mod printer;
mod program;

/// The source of a method, for other games.
pub struct MethodSource(Program<'static>);

impl MethodSource {
    /// Reads the source on a method's [card](Method::code); `None` if the card has no source.
    pub fn of(method: &Method) -> Option<Self> {
        (!method.code.is_empty()).then(|| Self(Program::read(method.code)))
    }

    /// Returns the function's inputs besides `x`, `v` and `h`.
    pub fn inputs(&self) -> &[MethodInput<'static>] {
        &self.0.inputs
    }

    /// Returns the source's own words for a claim of the card: `order`, `stability` or `symplectic`.
    pub fn claim(&self, claim: &str) -> Option<&'static str> {
        self.0.claim(claim)
    }

    /// Whether the function keeps a memory between steps.
    pub fn has_memory(&self) -> bool {
        !self.0.memory.is_empty()
    }
}

/// The reason why a method has no source code in a language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSourceCode {
    /// Id of the method.
    pub method: &'static str,
    /// The language.
    pub language: Language,
    /// The reason, as a clause in lower case.
    pub reason: &'static str,
}

impl std::error::Error for NoSourceCode {}

impl fmt::Display for NoSourceCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has no function in {}: {}", self.method, self.language.name(), self.reason)
    }
}

/// Returns a method's function in a language and a precision, below a comment made from its card.
///
/// # Errors
/// If the method is [custom](Method::custom), or cannot be written as such a function, or the language has no such
/// precision.
pub fn source_code(
    method: &Method,
    language: Language,
    precision: Precision,
) -> Result<String, NoSourceCode> {
    let program = program(method, language, precision)?;
    let header = header::lines(method, &program, language);
    Ok(printer::print(method.id, &program, language, precision, &header))
}

/// Returns the same function without the comment above it.
///
/// # Errors
/// Fails as [`source_code`] does.
pub fn function_code(
    method: &Method,
    language: Language,
    precision: Precision,
) -> Result<String, NoSourceCode> {
    let program = program(method, language, precision)?;
    Ok(printer::print(method.id, &program, language, precision, &[]))
}

/// Returns the lines of a method's step, which can be changed and read again as a method. The lines of a method from
/// the table stand below a comment made from its card.
///
/// # Errors
/// If the method is [custom](Method::custom).
pub fn step_lines(method: &Method) -> Result<String, NoSourceCode> {
    if let Some(own) = method.own_text() {
        return Ok(own.to_owned());
    }
    let language = Language::Rust;
    let program = program(method, language, Precision::Double)?;
    let header = header::lines(method, &program, language);
    let header = header.iter().map(|line| format!("# {line}").trim_end().to_owned() + "\n");
    Ok(header.collect::<String>() + "\n" + method.code)
}

/// Returns the function `rule` of a source, below a comment of these paragraphs.
///
/// # Panics
/// If the source is malformed.
pub(super) fn rule_code(text: &str, about: &[String], language: Language) -> String {
    let program = Program::read(text);
    let header = header::of_rule(about, &program, language);
    printer::print("rule", &program, language, Precision::Double, &header)
}

/// Returns the method's program, unless the language or the precision rules it out.
fn program(
    method: &Method,
    language: Language,
    precision: Precision,
) -> Result<Program<'static>, NoSourceCode> {
    let refused = |reason| NoSourceCode { method: method.id, language, reason };
    let source = MethodSource::of(method);
    let source = source.ok_or(refused(match method.own_text() {
        Some(_) => "a function that its lines call has no word there",
        None => "it is a custom method, whose code is where it was made",
    }))?;
    match source.0.refusal(language).or(language.refusal(precision)) {
        Some(reason) => Err(refused(reason)),
        None => Ok(source.0),
    }
}
