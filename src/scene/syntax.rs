//! Translates the TOML parser's errors into messages with a remedy.

use std::ops::Range;

use toml::de::Error;

use super::clip::clip;
use super::errors::SceneError;
use super::fault::{FaultKind, SceneFault};

const MISSING_COMMA: &str = "missing comma between array elements";

/// Returns the errors in the order of the text, without those that merely follow from an earlier one.
pub(super) fn errors(text: &str, found: Vec<Error>) -> Vec<SceneError> {
    let place = |error: Error| {
        let span = error.span().unwrap_or(text.len()..text.len());
        (span.start.min(text.len())..span.end.min(text.len()), error)
    };
    let mut found: Vec<_> = found.into_iter().map(place).collect();
    found.sort_by_key(|(span, _)| span.start);
    let mut next_line = 0;
    let mut is_table_twice = false;
    let mut errors = Vec::new();
    for (span, error) in found {
        if span.start < next_line {
            continue;
        }
        let fault = fault(text, span.clone(), error.message());
        // If a table occurs twice, the parser merges the keys of both tables.
        if is_table_twice && matches!(fault.kind, FaultKind::Duplicate { .. }) {
            continue;
        }
        is_table_twice |= fault.kind == FaultKind::Duplicate { is_table: true };
        let newline = text.as_bytes()[span.start..].iter().position(|byte| *byte == b'\n');
        next_line = newline.map_or(usize::MAX, |n| span.start + n + 1);
        errors.push(SceneError { span, fault });
        // If a list is not closed, the parser reads all the following lines as part of it.
        if error.message().starts_with(MISSING_COMMA) {
            break;
        }
    }
    errors
}

fn fault(text: &str, span: Range<usize>, message: &str) -> SceneFault {
    let written = text.get(span.clone()).unwrap_or_default();
    let rest_of_line =
        text.get(span.start..).and_then(|rest| rest.lines().next()).unwrap_or_default();
    let before = text.get(..span.start).unwrap_or_default();
    let (what, expected) = match message.split_once(", expected ") {
        Some((what, expected)) => (what, Some(expected)),
        None => (message, None),
    };
    let syntax = |what: &str, remedy: &str| SceneFault::new(what, remedy);
    match (what, expected) {
        ("duplicate key", _) => {
            let is_table = before.trim_end().ends_with('[');
            let key = clip(written);
            let remedy = match is_table {
                true => format!("write `[[{key}]]` each time"),
                false => "keep one of them".into(),
            };
            SceneFault::new(format!("`{key}` is given twice"), remedy)
                .of(FaultKind::Duplicate { is_table })
        }
        ("string values must be quoted", _) if written.trim().is_empty() => {
            syntax("a key has no value", "write one after the `=`")
        }
        ("string values must be quoted", _) => syntax(
            &format!("`{}` is no value", clip(written)),
            "write a number, or text in double quotes",
        ),
        ("key with no value", _) => syntax("a line has no `=`", "write `key = value`"),
        ("invalid unquoted key", _) => {
            syntax(&format!("`{}` cannot be in a key", clip(written)), "write `key = value`")
        }
        ("invalid key-value pair", _) => syntax("a line has no key", "write `key = value`"),
        ("unexpected key or value", _) => syntax(
            &format!("`{}` follows the value", clip(rest_of_line.trim_end())),
            "write one value on a line, with a point for the decimal sign",
        ),
        (MISSING_COMMA, _) => syntax("a list lacks a `,` or a `]`", "write it before this"),
        ("invalid basic string" | "invalid literal string", Some(quote @ ("`\"`" | "'`'`"))) => {
            syntax("a string is not closed", &format!("end it with {quote} on its own line"))
        }
        ("missing escaped value", _) => syntax(
            "a string has a `\\` with no meaning",
            "write `\\\\`, or the text in single quotes",
        ),
        ("recursion limit" | "cannot recurse further; max recursion depth met", _) => {
            syntax("nested too deeply", "a scene needs no list within a list")
        }
        (what, None) => syntax(what, "its form is at https://toml.io"),
        (what, Some("nothing")) => syntax(what, "remove it"),
        (what, Some(expected)) => {
            let expected = match expected.rsplit_once(", ") {
                Some((all, last)) => format!("{all} or {last}"),
                None => expected.into(),
            };
            syntax(what, &format!("write {expected} here"))
        }
    }
}
