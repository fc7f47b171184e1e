//! A step to the next or the previous item of a list, or to the next or the previous rung of a ladder.

/// A step along a list, or along a ladder of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The next item, or the next higher rung.
    Next,
    /// The previous item, or the next lower rung.
    Previous,
}

impl Step {
    /// Returns 1 for the next item, or -1 for the previous one.
    pub(super) fn sign(self) -> i64 {
        match self {
            Self::Next => 1,
            Self::Previous => -1,
        }
    }

    /// Returns the index of the next or previous item of a cyclic list.
    pub(super) fn cyclic_index(self, index: usize, count: usize) -> usize {
        match self {
            Self::Next => (index + 1) % count,
            Self::Previous => (index + count - 1) % count,
        }
    }

    /// Returns the opposite step.
    pub(super) fn opposite(self) -> Self {
        match self {
            Self::Next => Self::Previous,
            Self::Previous => Self::Next,
        }
    }

    /// Returns the next or previous rung of the ladder, or `None` at its end.
    pub(super) fn next_rung(self, ladder: &[u32], rung: impl PartialOrd<u32>) -> Option<u32> {
        match self {
            Self::Next => ladder.iter().copied().find(|other| rung < *other),
            Self::Previous => ladder.iter().copied().rfind(|other| rung > *other),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::TickRate;

    #[test]
    fn a_rate_between_two_rungs_steps_to_the_next_on_either_side() {
        let ladder = [2, 60, 100];
        let from = |step: Step, hz: &str| step.next_rung(&ladder, hz.parse::<TickRate>().unwrap());
        assert_eq!(
            ["66.667", "59.94", "60"].map(|hz| from(Step::Next, hz)),
            [100, 60, 100].map(Some)
        );
        assert_eq!(
            ["66.667", "59.94", "60"].map(|hz| from(Step::Previous, hz)),
            [60, 2, 2].map(Some)
        );
        assert_eq!((from(Step::Next, "100.5"), from(Step::Previous, "0.5")), (None, None));
    }
}
