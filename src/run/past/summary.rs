//! The samples of a history, several to a record: for a plot that has fewer columns than there are samples.

use std::collections::vec_deque;
use std::{iter, option};

use super::sample::Sample;
use super::swept_range::SweptRange;
use super::windowed_log::WindowedLog;

/// The most samples that a summary stands for, one for each log, the fewest summaries first.
pub(super) const MAX_SUMMED: [usize; 2] = [4, 2];

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

/// Compares bits.
impl PartialEq for Summary {
    fn eq(&self, other: &Self) -> bool {
        let bits = |s: &Self| [s.t, s.q].map(f64::to_bits);
        bits(self) == bits(other)
            && (self.entry, self.jumped, self.swept) == (other.entry, other.jumped, other.swept)
    }
}

impl Summary {
    /// A sample alone.
    pub fn of(sample: &Sample) -> Self {
        let &Sample { t, q, swept, entry, jumped, .. } = sample;
        Self { t, q, swept, entry, jumped }
    }

    /// Both, if they are of one motion under one method.
    fn and(self, next: Self) -> Option<Self> {
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

/// The summary that is still being made, and how many samples it stands for so far.
type Unfinished = Option<(Summary, usize)>;

/// The summaries of a history.
#[derive(Debug)]
pub(super) struct SummaryLog {
    max_summed: usize,
    whole: WindowedLog<Summary>,
    last: Unfinished,
}

/// The end of a [`SummaryLog`] at some tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct SummaryMark {
    whole: u64,
    last: Unfinished,
}

/// Summaries, oldest first.
pub(super) type Summaries<'l> =
    iter::Chain<iter::Copied<vec_deque::Iter<'l, Summary>>, option::IntoIter<Summary>>;

impl SummaryLog {
    /// A log of summaries, each of this number of samples at most, with room for `samples` of them and `spare` more.
    pub(super) fn new(max_summed: usize, samples: usize, spare: usize) -> Self {
        let whole = WindowedLog::new(samples / max_summed + 1, spare / max_summed);
        Self { max_summed, whole, last: None }
    }

    pub(super) fn shown(&self) -> Summaries<'_> {
        self.whole.shown().copied().chain(self.last.map(|(summary, _)| summary))
    }

    /// Adds a sample. Never allocates.
    pub(super) fn push(&mut self, sample: &Sample) {
        let next = Summary::of(sample);
        let together = self.last.filter(|(_, count)| *count < self.max_summed);
        let together = together.and_then(|(last, count)| Some((last.and(next)?, count + 1)));
        if together.is_none()
            && let Some((last, _)) = self.last
        {
            self.whole.push(last);
        }
        self.last = together.or(Some((next, 1)));
    }

    /// Removes the newest sample, which stands alone.
    pub(super) fn pop(&mut self) {
        self.last = None;
    }

    pub(super) fn mark(&self) -> SummaryMark {
        SummaryMark { whole: self.whole.mark(), last: self.last }
    }

    pub(super) fn rewind(&mut self, mark: SummaryMark) {
        self.whole.rewind(mark.whole);
        self.last = mark.last;
    }

    pub(super) fn forget_future(&mut self) {
        self.whole.forget_future();
    }
}
