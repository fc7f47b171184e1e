//! A step to what is beside on a list or a ladder.

/// Which of the two beside on a list, or on a ladder of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The next, or the next higher.
    Next,
    /// The one before, or the next lower.
    Previous,
}

impl Step {
    /// 1, or -1 for the one before.
    pub(super) fn sign(self) -> i64 {
        match self {
            Self::Next => 1,
            Self::Previous => -1,
        }
    }

    /// The index beside on a list that goes round.
    pub(super) fn around(self, index: usize, count: usize) -> usize {
        match self {
            Self::Next => (index + 1) % count,
            Self::Previous => (index + count - 1) % count,
        }
    }

    /// The other way.
    pub(super) fn other(self) -> Self {
        match self {
            Self::Next => Self::Previous,
            Self::Previous => Self::Next,
        }
    }

    /// The rung beside on a ladder; `None` at its end.
    pub(super) fn along(self, ladder: &[u32], rung: u32) -> Option<u32> {
        match self {
            Self::Next => ladder.iter().copied().find(|&other| other > rung),
            Self::Previous => ladder.iter().copied().rfind(|&other| other < rung),
        }
    }
}
