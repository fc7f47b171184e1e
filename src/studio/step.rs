//! A step to the next or the previous of a list, or of a ladder of numbers.

/// A step along a list, or along a ladder of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The next, or the next higher.
    Next,
    /// The one before, or the next lower.
    Previous,
}

impl Step {
    /// 1 to the next, -1 to the previous.
    pub(super) fn sign(self) -> i64 {
        match self {
            Self::Next => 1,
            Self::Previous => -1,
        }
    }

    /// The index that it leads to on a list that goes round.
    pub(super) fn around(self, index: usize, count: usize) -> usize {
        match self {
            Self::Next => (index + 1) % count,
            Self::Previous => (index + count - 1) % count,
        }
    }

    /// The step the other way.
    pub(super) fn other(self) -> Self {
        match self {
            Self::Next => Self::Previous,
            Self::Previous => Self::Next,
        }
    }

    /// The rung that it leads to; `None` at the end of the ladder.
    pub(super) fn along(self, ladder: &[u32], rung: u32) -> Option<u32> {
        match self {
            Self::Next => ladder.iter().copied().find(|&other| other > rung),
            Self::Previous => ladder.iter().copied().rfind(|&other| other < rung),
        }
    }
}
