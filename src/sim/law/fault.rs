//! Faults of a law's text.

use std::ops::Range;

use super::Remedy;

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

impl LawFault {
    /// Returns a fault with a remedy in words.
    pub(crate) fn new(
        part: Part,
        span: Range<usize>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { part, span, what: what.into(), remedy: Remedy::Words(remedy.into()) }
    }
}
