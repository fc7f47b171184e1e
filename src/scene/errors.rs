//! The errors of a scene file, or of the lines of a step, with their places.

use std::fmt;
use std::ops::Range;

use super::MAX_FILE_BYTES;
use super::fault::SceneFault;
use super::nearest::words;
use crate::sim::law::ExpressionFault;

/// Number of errors shown for one file, which is about as many as a person fixes before trying again.
pub const MAX_SHOWN: usize = 10;

/// A remedy longer than this, in bytes, such as the list of all methods, appears only once in the errors of a file.
const MAX_REPEATED_BYTES: usize = 200;

/// All errors of one scene file. Its display has one line for each error.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneErrors {
    /// The file's name, as given.
    pub file: String,
    /// The text to which the errors' spans refer.
    pub text: String,
    /// The first [`MAX_SHOWN`] errors in the order of the text. There is at least one.
    pub errors: Vec<SceneError>,
    /// Number of further errors.
    pub more: usize,
}

/// An error of a file, as shown to people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShownError {
    /// The error message, with its place.
    pub message: String,
    /// The faulty lines of the file, with marks; empty if there are none.
    pub quoted: String,
}

/// Makes a shown error without lines of a file.
impl<T: Into<String>> From<T> for ShownError {
    fn from(message: T) -> Self {
        Self { message: message.into(), quoted: String::new() }
    }
}

impl From<SceneErrors> for Vec<ShownError> {
    fn from(errors: SceneErrors) -> Self {
        errors.messages().map(ShownError::from).collect()
    }
}

/// One error of a scene file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{fault}")]
pub struct SceneError {
    /// Range of the faulty bytes of the text. For a missing key it is the header of the table, or an empty range at the
    /// top of the file.
    pub span: Range<usize>,
    pub(super) fault: SceneFault,
}

impl SceneError {
    /// Returns the fault in lower case, as the title of a longer message.
    pub fn fault(&self) -> &str {
        &self.fault.what
    }

    /// Returns the remedy, as the label of the span in a longer message.
    pub fn remedy(&self) -> &str {
        &self.fault.remedy
    }
}

impl SceneErrors {
    pub(super) fn new(file: &str, text: &str, mut errors: Vec<SceneError>) -> Self {
        errors.sort_by_key(|error| error.span.start);
        let more = errors.len().saturating_sub(MAX_SHOWN);
        errors.truncate(MAX_SHOWN);
        for n in (1..errors.len()).rev() {
            let (before, [error, ..]) = errors.split_at_mut(n) else { break };
            let remedy = &error.fault.remedy;
            if remedy.len() > MAX_REPEATED_BYTES
                && let Some(first) = before.iter().find(|first| first.fault.remedy == *remedy)
            {
                let (line, _) = position(text, first.span.start);
                error.fault.remedy = format!("mend it as on line {line}");
            }
        }
        Self { file: file.into(), text: text.into(), errors, more }
    }

    /// Returns the error for a file with more bytes than a scene file may have.
    pub fn too_large(file: &str) -> Self {
        let what = format!("the file holds more than {MAX_FILE_BYTES} bytes");
        let fault = SceneFault::new(what, "give a scene file, with a shorter script");
        Self::new(file, "", vec![SceneError { span: 0..0, fault }])
    }

    /// Returns the error for a fault in the lines of a step. `file` names the file or the argument with these lines.
    pub fn of_step(file: &str, text: &str, fault: ExpressionFault) -> Self {
        let ExpressionFault { span, what, remedy } = fault;
        let fault = SceneFault::new(what, words(remedy));
        Self::new(file, text, vec![SceneError { span, fault }])
    }

    pub(super) fn not_utf8(file: &str, bytes: &[u8], byte: usize) -> Self {
        let text = String::from_utf8_lossy(bytes);
        let span = byte..byte + char::REPLACEMENT_CHARACTER.len_utf8();
        let what = format!("the file is not text: byte {byte} is not UTF-8");
        let fault = SceneFault::new(what, "give a scene file, saved as UTF-8");
        Self::new(file, &text, vec![SceneError { span, fault }])
    }

    /// Returns a line for each of [`errors`](Self::errors), and one line for the further errors if there are any.
    pub fn messages(&self) -> impl Iterator<Item = String> {
        let Self { file, errors, more, .. } = self;
        let message = move |error: &SceneError| {
            let (line, column) = self.position(error.span.start);
            format!("{file}:{line}:{column}: {error}")
        };
        let rest = (*more > 0).then(|| format!("{file}: and {more} more; mend these first"));
        errors.iter().map(message).chain(rest)
    }

    /// Returns the line and column of a byte of the text, both from 1. The column counts characters.
    pub fn position(&self, byte: usize) -> (usize, usize) {
        position(&self.text, byte)
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.messages().collect::<Vec<_>>().join("\n"))
    }
}

impl std::error::Error for SceneErrors {}

pub(super) fn position(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(byte)];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.bytes().filter(|byte| *byte == b'\n').count();
    (line, 1 + before[line_start..].chars().count())
}
