//! Prints methods and game loops as source code for a game, in each of six languages. For a method, it is one function
//! of `x`, `v` and the step `h`, or of an angular velocity, an attitude and `h`. For a loop, it is a type that makes
//! the ticks of a frame.
//!
//! A method is written once, in `assets/methods`, in the language in which a person writes a step of their own; see
//! [`StepText`]. The printer translates its lines one by one with the table of dialects, and makes the header from the
//! method's card. `tests/tools/source_code` runs the printed functions and compares their steps with the method's.
//!
//! Beside those of a step, a source has these lines, which only its header uses:
//!
//! | line | meaning |
//! |---|---|
//! | `takes a(x, v): about` | an input, with a description; the remarks above it belong to the header |
//! | `stability: when`, and `order`, `symplectic` | replaces the card's sentence |
//! | `several: how`, `held: where` | the words on several coordinates, and on forces that depend on time |
//! | `refused c: why`, `refused: why` | excludes the function from this language, or from all |

use std::fmt;

use crate::sim::Impact;
use crate::sim::integrators::Method;
pub use crate::sim::law::MethodInput;
use crate::sim::law::{LoopText, StepText};

pub use dialect::{CodeForm, Language, Precision};
pub(super) use printer::{RULE_STEP, rule_lines, rule_names};

mod declarations;
mod dialect;
mod expression;
mod header;
mod printer;

/// The source of a method, for other games.
pub struct MethodSource(StepText);

impl MethodSource {
    /// Reads the lines of a method, which are on its [card](Method::code) or a person's own; `None` if it has none.
    pub fn of(method: &Method) -> Option<Self> {
        let text = method.own_text().unwrap_or(method.code);
        if text.is_empty() {
            return None;
        }
        let read = if method.is_for_spin() { StepText::read_spin } else { StepText::read };
        read(text).ok().map(Self)
    }

    /// Returns the function's inputs besides `x`, `v` and `h`.
    pub fn inputs(&self) -> Vec<MethodInput<'_>> {
        self.0.method_inputs()
    }

    /// Returns the source's own words for a claim of the card: `order`, `stability` or `symplectic`.
    pub fn claim(&self, claim: &str) -> Option<&str> {
        self.0.claim(claim)
    }

    /// Whether the function keeps a memory between steps.
    pub fn has_memory(&self) -> bool {
        self.0.carried().len() > 2
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
    pub reason: String,
}

impl std::error::Error for NoSourceCode {}

impl fmt::Display for NoSourceCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has no function in {}: {}", self.method, self.language.name(), self.reason)
    }
}

/// Returns a method's function in a language and a precision, below a comment made from its card; or its
/// [lines](step_lines), which have no precision of their own.
///
/// # Errors
/// If the method is [custom](Method::custom), or cannot be written as such a function, or the language has no such
/// precision.
pub fn source_code(
    method: &Method,
    form: impl Into<CodeForm>,
    precision: Precision,
) -> Result<String, NoSourceCode> {
    let CodeForm::Function(language) = form.into() else { return step_lines(method) };
    let text = printable(method, language, precision)?;
    let header = header::lines(method, &text, language);
    Ok(printer::print(method.id, &text, language, precision, &header))
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
    let text = printable(method, language, precision)?;
    Ok(printer::print(method.id, &text, language, precision, &[]))
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
    let text = printable(method, language, Precision::Double)?;
    let header = header::lines(method, &text, language).into_iter();
    Ok(remarks(header) + "\n" + method.code)
}

/// Returns lines as remarks in the language of steps.
fn remarks(lines: impl Iterator<Item = String>) -> String {
    lines.map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect()
}

/// Returns the statements of a method without remarks, blank lines and `let`, for a card beside its motion. Where the
/// acceleration is taken once, at the start of the step, it is called `a`.
pub fn bare_lines(method: &Method) -> Vec<String> {
    let text = method.own_text().unwrap_or(method.code);
    let is_said = |line: &&str| {
        let first = line.split_whitespace().next().unwrap_or("#");
        !first.starts_with('#') && !["takes", "several:", "held:"].contains(&first)
    };
    let bare = |line: &str| {
        let indent = line.len() - line.trim_start().len();
        let statement = line.trim();
        let statement = statement.strip_prefix("let ").unwrap_or(statement);
        format!("{}{statement}", " ".repeat(indent))
    };
    let mut lines: Vec<String> = text.lines().filter(is_said).map(bare).collect();
    const AT_START: &str = "a(x, v)";
    if lines.iter().map(|line| line.matches("a(").count()).sum::<usize>() == 1 {
        match lines[0].strip_suffix(AT_START) {
            Some(named) if named.ends_with(" = ") => {
                let name = named.trim_end_matches(" = ").to_owned();
                lines.remove(0);
                lines.iter_mut().for_each(|line| *line = line.replace(&name, "a"));
            }
            Some(rest) => lines[0] = format!("{rest}a"),
            None => {}
        }
    }
    lines
}

/// Returns generated lines as the function `rule` or as they are, below a comment of these paragraphs.
///
/// # Errors
/// The reason why the lines cannot be printed, as a clause.
pub(super) fn rule_code(lines: &str, about: &[String], form: CodeForm) -> Result<String, String> {
    let CodeForm::Function(language) = form else {
        let about = about.iter().flat_map(|paragraph| header::wrapped(paragraph));
        return Ok(remarks(about) + "\n" + lines.trim_start());
    };
    let text = StepText::read_generated(lines).map_err(|fault| fault.what)?;
    let header = header::of_rule(about, &text, language);
    Ok(printer::print("rule", &text, language, Precision::Double, &header))
}

/// Returns a rule for impacts, for e = 0.8 and a floor at 0.
///
/// # Errors
/// The reason why the language cannot express the rule, as a clause.
pub fn impact_code(impact: &Impact, form: impl Into<CodeForm>) -> Result<String, String> {
    impact_code_for(impact, form, [0.8, 9.81])
}

/// Returns a rule as [`impact_code`] does, for this restitution and gravity (m/s²).
pub fn impact_code_for(
    impact: &Impact,
    form: impl Into<CodeForm>,
    [e, g]: [f64; 2],
) -> Result<String, String> {
    let effect = impact.kappa.map(|kappa| {
        format!(
            "Under gravity g an impact adds (s + {kappa}) g h to the speed, s = -1 with semi-implicit Euler, 0 with \
             Verlet and RK4, 1 with explicit Euler."
        )
    });
    let about = std::iter::once(format!("{}: {}.", impact.id, impact.about)).chain(effect);
    let code = impact.code.replace("let e = 0.8", &format!("let e = {e:?}"));
    let code = code.replace("let g = 9.81", &format!("let g = {g:?}"));
    rule_code(&code, &about.collect::<Vec<_>>(), form.into())
}

/// Returns a game loop in a language, below a comment from the claims of its lines. It is the type `GameLoop`, whose
/// function of a frame calls a step for each tick and returns the moment to draw, if the loop shows one.
///
/// # Errors
/// The reason why the lines cannot be printed, as a clause.
///
/// ```
/// use regatta_tools::source_code::{Language, loop_code};
///
/// let code = loop_code("mine", "tick 1 of dt", Language::Rust).unwrap();
/// assert!(code.contains("step(duration_ms / self.second);"));
/// ```
pub fn loop_code(id: &str, lines: &str, language: Language) -> Result<String, String> {
    let text = LoopText::read(lines).map_err(|fault| fault.what)?;
    if let Some(reason) = text.text().unwritable() {
        return Err(reason.to_owned());
    }
    let header = header::of_loop(id, &text, language);
    Ok(printer::print_loop(text.text(), language, &header))
}

/// Returns the lines of a method, unless the language or the precision rules them out.
fn printable(
    method: &Method,
    language: Language,
    precision: Precision,
) -> Result<StepText, NoSourceCode> {
    let refused =
        |reason: &str| NoSourceCode { method: method.id, language, reason: reason.to_owned() };
    let no_lines = "it is a custom method, whose code is where it was made";
    let MethodSource(text) = MethodSource::of(method).ok_or_else(|| refused(no_lines))?;
    let of_language = format!("refused {}", language.id());
    let claims = [&*of_language, "refused"].into_iter().find_map(|claim| text.claim(claim));
    let reason = claims.or_else(|| language.refusal(precision)).or_else(|| text.unwritable());
    match reason.map(refused) {
        Some(refused) => Err(refused),
        None => Ok(text),
    }
}
