//! Several samples of a history as one: for a plot that has fewer columns than there are samples.

use super::sample::Sample;
use super::swept_range::SweptRange;

/// Consecutive samples of one motion under one method.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// The time of the last of them, in seconds.
    pub t: f64,
    /// The recorded coordinate there.
    pub q: f64,
    /// The range of that coordinate since the summary before.
    pub swept: SweptRange,
    /// The index of the lane's method on the [menu](super::Menu).
    pub entry: usize,
    /// Whether the body was put where they begin, so that no path leads from the summary before.
    pub jumped: bool,
}

impl Summary {
    /// A sample alone.
    pub fn of(sample: &Sample) -> Self {
        let &Sample { t, q, swept, entry, jumped, .. } = sample;
        Self { t, q, swept, entry, jumped }
    }

    /// Both, if they are of one motion under one method.
    pub(super) fn and(self, next: Self) -> Option<Self> {
        let is_one = self.entry == next.entry && !next.jumped;
        let ends = next.swept.ends();
        let swept = self.swept.and(ends[0]).and(ends[1]);
        (is_one && self.q.is_finite() && next.q.is_finite()).then_some(Self {
            swept,
            jumped: self.jumped,
            ..next
        })
    }
}
