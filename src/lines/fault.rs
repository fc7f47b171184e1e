//! Faults of expressions and lines.

use std::ops::Range;

/// How to fix a fault.
#[derive(Clone, Debug, PartialEq)]
pub enum Remedy {
    /// An instruction in these words.
    Words(String),
    /// A known name to write instead of an unknown one.
    Name {
        /// The unknown name.
        written: String,
        /// The names known at its position.
        known: Vec<String>,
    },
}

/// A fault of one expression, or of the lines of a step. Messages are in lower case.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionFault {
    /// The byte range at fault.
    pub span: Range<usize>,
    /// The error message.
    pub what: String,
    /// How to fix the fault.
    pub remedy: Remedy,
}

impl ExpressionFault {
    /// Returns a fault with a remedy in words.
    pub fn new(span: Range<usize>, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { span, what: what.into(), remedy: Remedy::Words(remedy.into()) }
    }
}

/// The result of reading text.
pub type Parsed<T> = Result<T, ExpressionFault>;

/// Returns an `Err` with a [fault](ExpressionFault::new).
pub(super) fn fault<T>(
    span: Range<usize>,
    what: impl Into<String>,
    remedy: impl Into<String>,
) -> Parsed<T> {
    Err(ExpressionFault::new(span, what, remedy))
}

/// The maximum number of characters of an expression that a message quotes.
const MAX_QUOTED_CHARS: usize = 40;

/// Shortens the text of an expression for a message.
pub fn quoted(text: &str) -> String {
    let mut quoted: String = text.chars().take(MAX_QUOTED_CHARS).collect();
    if text.chars().nth(MAX_QUOTED_CHARS).is_some() {
        quoted.push('…');
    }
    quoted
}
