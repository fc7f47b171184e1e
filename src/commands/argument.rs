//! Arguments of the command line: those that are numbers, and how any stands in a message: cut where it is long, as a link
//! to a run is.

use std::path::Path;

use clap::error::{ContextKind, ContextValue};

use crate::regular_file::is_link;
use crate::scene::{clip, cut};

/// The most characters of an argument in a message: more than a person writes, and no more than a few lines.
const MAX_SHOWN_CHARS: usize = 300;

/// A path for a message. Of a link, whose letters say nothing, the first few stand for it.
pub(super) fn brief(path: &Path) -> String {
    let written = path.display().to_string();
    if is_link(path) { clip(&written) } else { cut(MAX_SHOWN_CHARS, &written) }
}

/// An error of the command line, in which long arguments are cut.
pub(super) fn with_brief_arguments(mut error: clap::Error) -> clap::Error {
    let shorter = |(kind, value): (ContextKind, &ContextValue)| match value {
        ContextValue::String(text) => {
            let shown = cut(MAX_SHOWN_CHARS, text);
            (shown != *text).then_some((kind, ContextValue::String(shown)))
        }
        _ => None,
    };
    let long: Vec<(ContextKind, ContextValue)> = error.context().filter_map(shorter).collect();
    if !long.is_empty() {
        // A suggestion would repeat what is too long.
        error.remove(ContextKind::Suggested);
    }
    for (kind, shown) in long {
        error.insert(kind, shown);
    }
    error
}

/// A finite number on the command line that fits, or else what is wanted.
pub(super) fn number_that(
    written: &str,
    fits: fn(f64) -> bool,
    wanted: &str,
) -> Result<f64, String> {
    let number = written.parse::<f64>().ok().filter(|number| number.is_finite() && fits(*number));
    number.ok_or_else(|| format!("give {wanted}"))
}

/// A number of the command line that is not negative.
pub(super) fn number(written: &str) -> Result<f64, String> {
    number_that(written, |x| x >= 0.0, "a number from 0 up")
}

/// A frequency of the command line in Hz, which may have its unit behind it.
pub(super) fn frequency(written: &str) -> Result<f64, String> {
    let number = written.strip_suffix("Hz").unwrap_or(written).trim_end();
    number_that(number, |hz| hz > 0.0, "a frequency above 0 in Hz, such as 2.5Hz")
}

/// A number of the command line above 0.
pub(super) fn positive(written: &str) -> Result<f64, String> {
    number_that(written, |x| x > 0.0, "a number above 0")
}
