//! Faults of a law's text.

use std::ops::Range;

/// A part of a law's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The name of the constant with this index.
    Constant(usize),
    /// The name of the coordinate with this index.
    Coordinate(usize),
    /// The acceleration of the coordinate with this index.
    Acceleration(usize),
    /// The exact solution of the coordinate with this index.
    Exact(usize),
    /// The x (0) or y (1) of the drawing position of the coordinate with this index.
    Place(usize, usize),
    /// The energy.
    Energy,
    /// The event with this index.
    Event(usize),
    /// Where the event with this index fires.
    When(usize),
    /// A new velocity of the event with the first index.
    Then(usize, usize),
}

/// A fault of a law's text. Messages are in lower case.
#[derive(Clone, Debug, PartialEq)]
pub struct LawFault {
    /// The part at fault.
    pub part: Part,
    /// The byte range at fault, within the text of the part.
    pub span: Range<usize>,
    /// The error message.
    pub what: String,
    /// How to fix the fault.
    pub remedy: Remedy,
}

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
    pub(super) fn new(
        span: Range<usize>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { span, what: what.into(), remedy: Remedy::Words(remedy.into()) }
    }

    /// Returns the same fault, located in this part of a law.
    pub(super) fn of(self, part: Part) -> LawFault {
        let Self { span, what, remedy } = self;
        LawFault { part, span, what, remedy }
    }
}

/// The result of reading text.
pub(super) type Parsed<T> = Result<T, ExpressionFault>;

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
pub(super) fn quoted(text: &str) -> String {
    let mut quoted: String = text.chars().take(MAX_QUOTED_CHARS).collect();
    if text.chars().nth(MAX_QUOTED_CHARS).is_some() {
        quoted.push('…');
    }
    quoted
}
