//! Methods made of a person's own lines, with measured cards.

use std::sync::{Mutex, PoisonError};

use super::conformance;
use super::integrators::{Family, METHODS, Method};
use super::law::{ExpressionFault, Remedy, StepText};

/// The most characters of the id of an own method.
pub(crate) const MAX_OWN_ID_CHARS: usize = 64;

/// Every method made so far, so that equal lines under one id are one method.
static KNOWN: Mutex<Vec<&'static Method>> = Mutex::new(Vec::new());

/// The method of these lines under this id. [`conformance`] measures its card once per process, in a fraction of a
/// second. Equal lines share one card, which lives as long as the process.
///
/// # Errors
/// The first fault of the lines, or that they do not call the acceleration.
///
/// ```
/// use regatta::sim::own_method;
///
/// let euler = own_method("mine", "v += a(x, v) * h; x += v * h").unwrap();
/// assert_eq!((euler.order, euler.evaluations, euler.symplectic), (1, Some(1), true));
/// assert!(own_method("mine", "x += v * h").is_err());
/// ```
pub fn own_method(id: &str, text: &str) -> Result<&'static Method, ExpressionFault> {
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let is_it = |method: &&&Method| method.id == id && method.own_text() == Some(text);
    if let Some(method) = known().iter().find(is_it) {
        return Ok(method);
    }
    let read = StepText::read(text)?;
    if read.acceleration_at().is_none() {
        return Err(ExpressionFault {
            span: 0..text.len(),
            what: "no line calls `a(x, v)`, so that the lines are a rule".into(),
            remedy: Remedy::Words(
                "ask `regatta rule`, or call the acceleration: `v += h * a(x, v)`".into(),
            ),
        });
    }
    let code = read.code().map(|code| code.method()).unwrap_or_default();
    let formula =
        text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let formula: Vec<&'static str> = formula.map(|line| &*line.to_owned().leak()).collect();
    let name: &'static str = id.to_owned().leak();
    let lines = Box::leak(Box::new(read));
    let card = Box::leak(Box::new(Method {
        id: name,
        name,
        about: "a method by lines of one's own",
        formula: formula.leak(),
        code: code.leak(),
        source: "lines of one's own; this card is measured",
        own: Some(lines),
        ..Family::Explicit.card()
    }));
    let method = conformance::measured(card);
    let mut known = known();
    // Another thread may have been faster.
    if let Some(method) = known.iter().find(is_it) {
        return Ok(method);
    }
    known.push(Box::leak(Box::new(method)));
    Ok(known[known.len() - 1])
}

/// The method id for a file with this name without its extension: letters and digits in lower case, and hyphens for
/// all other characters.
pub fn own_method_id(stem: &str) -> String {
    let mut id = String::new();
    for letter in stem.chars() {
        match letter {
            letter if letter.is_ascii_alphanumeric() => id.push(letter.to_ascii_lowercase()),
            _ if !id.is_empty() && !id.ends_with('-') => id.push('-'),
            _ => {}
        }
    }
    id.trim_end_matches('-').to_owned()
}

/// Checks the id of an own method. The error is a message and a remedy.
///
/// # Errors
/// If it is no valid id, or if one of [`METHODS`] has it.
pub fn check_own_id(id: &str) -> Result<(), [String; 2]> {
    if id.is_empty() || own_method_id(id) != id || id.len() > MAX_OWN_ID_CHARS {
        let remedy = format!(
            "write up to {MAX_OWN_ID_CHARS} lower-case letters and digits with hyphens between, such as `my-rk4`"
        );
        return Err([format!("{id:?} is no id of a method"), remedy]);
    }
    let mut taken = METHODS.iter().flat_map(Method::spellings);
    match taken.find(|(spelling, _)| *spelling == id) {
        Some((_, of)) => Err([
            format!("{id:?} is a name of the built-in method {of}"),
            format!("give it another name, such as `my-{id}`"),
        ]),
        None => Ok(()),
    }
}
