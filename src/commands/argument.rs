//! Parsers for numeric arguments, and the form that arguments have in messages. Long arguments, such as links to a run,
//! are shortened.

use std::path::Path;

use clap::error::{ContextKind, ContextValue};

use crate::regular_file::is_link;
use crate::scene::{clip, truncate};

/// Maximum number of characters of an argument in a message. It is more than a person types, yet only a few lines.
const MAX_SHOWN_CHARS: usize = 300;

/// Returns a path in the form that it has in a message. A link is unreadable, so only its first characters appear.
pub(super) fn brief(path: &Path) -> String {
    let written = path.display().to_string();
    if is_link(path) { clip(&written) } else { truncate(MAX_SHOWN_CHARS, &written) }
}

/// Shortens the long arguments in an error about the command line.
pub(super) fn with_brief_arguments(mut error: clap::Error) -> clap::Error {
    let shorter = |(kind, value): (ContextKind, &ContextValue)| match value {
        ContextValue::String(text) => {
            let shown = truncate(MAX_SHOWN_CHARS, text);
            (shown != *text).then_some((kind, ContextValue::String(shown)))
        }
        _ => None,
    };
    let long: Vec<(ContextKind, ContextValue)> = error.context().filter_map(shorter).collect();
    if !long.is_empty() {
        // A suggestion would repeat the long argument, so it is removed.
        error.remove(ContextKind::Suggested);
    }
    for (kind, shown) in long {
        error.insert(kind, shown);
    }
    error
}

/// Parses a finite number for which `fits` returns true. The error names the `wanted` numbers.
pub(super) fn number_that(
    written: &str,
    fits: fn(f64) -> bool,
    wanted: &str,
) -> Result<f64, String> {
    let number = written.parse::<f64>().ok().filter(|number| number.is_finite() && fits(*number));
    number.ok_or_else(|| format!("give {wanted}"))
}

/// Parses a number of at least 0.
pub(super) fn number(written: &str) -> Result<f64, String> {
    number_that(written, |x| x >= 0.0, "a number from 0 up")
}

/// Parses a frequency in Hz, with or without its unit.
pub(super) fn frequency(written: &str) -> Result<f64, String> {
    let number = written.strip_suffix("Hz").unwrap_or(written).trim_end();
    number_that(number, |hz| hz > 0.0, "a frequency above 0 in Hz, such as 2.5Hz")
}

/// Parses a number above 0.
pub(super) fn positive(written: &str) -> Result<f64, String> {
    number_that(written, |x| x > 0.0, "a number above 0")
}
