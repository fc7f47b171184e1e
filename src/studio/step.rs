//! A step to the next or the previous item of a list, or rung of a ladder.

/// A step along a list, or along a ladder of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The next, or the next higher.
    Next,
    /// The previous, or the next lower.
    Previous,
}

impl Step {
    /// 1 for the next, -1 for the previous.
    pub(super) fn sign(self) -> i64 {
        match self {
            Self::Next => 1,
            Self::Previous => -1,
        }
    }

    /// The next or previous index of a cyclic list.
    pub(super) fn cyclic_index(self, index: usize, count: usize) -> usize {
        match self {
            Self::Next => (index + 1) % count,
            Self::Previous => (index + count - 1) % count,
        }
    }

    /// The opposite step.
    pub(super) fn opposite(self) -> Self {
        match self {
            Self::Next => Self::Previous,
            Self::Previous => Self::Next,
        }
    }

    /// The next or previous rung; `None` at the end of the ladder.
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
