//! What was recorded, in order, and the part of it that is shown: the newest of a run, or of a moment in its past.

use std::collections::{VecDeque, vec_deque};

/// A bounded row of records, of which a window is shown. Allocated once.
///
/// Records are numbered from the run's start. The window ends at the present; while the run's past is the present,
/// records of its future stay behind the window, and what is [pushed](Log::push) again is not stored again.
#[derive(Debug)]
pub(super) struct Log<T> {
    kept: VecDeque<T>,
    /// The most that is shown.
    window: usize,
    /// The most that is kept.
    capacity: usize,
    /// The number of the oldest that is kept.
    first: u64,
    /// The number after the newest that is shown.
    end: u64,
}

impl<T: PartialEq> Log<T> {
    /// An empty log that shows the newest `window` records and keeps `spare` more.
    pub(super) fn new(window: usize, spare: usize) -> Self {
        let capacity = window + spare;
        Self { kept: VecDeque::with_capacity(capacity), window, capacity, first: 0, end: 0 }
    }

    /// How many are shown.
    pub(super) fn len(&self) -> usize {
        self.window.min((self.end - self.first) as usize)
    }

    /// The records shown, oldest first.
    pub(super) fn shown(&self) -> vec_deque::Iter<'_, T> {
        self.range(0)
    }

    /// The records shown, but for the `skipped` oldest.
    pub(super) fn range(&self, skipped: usize) -> vec_deque::Iter<'_, T> {
        let end = (self.end - self.first) as usize;
        self.kept.range(end - self.len() + skipped..end)
    }

    /// The newest that is shown.
    pub(super) fn newest(&self) -> Option<&T> {
        self.shown().next_back()
    }

    /// Adds the next record. Never allocates.
    pub(super) fn push(&mut self, record: T) {
        let next = (self.end - self.first) as usize;
        if self.kept.get(next) == Some(&record) {
            self.end += 1;
            return;
        }
        self.forget_future();
        if self.kept.len() == self.capacity {
            self.kept.pop_front();
            self.first += 1;
        }
        self.kept.push_back(record);
        self.end += 1;
    }

    /// Takes the newest that is shown from the window: the next record takes its place.
    pub(super) fn pop(&mut self) {
        self.end = self.first.max(self.end.saturating_sub(1));
    }

    /// The number after the newest that is shown: where the window ends.
    pub(super) fn mark(&self) -> u64 {
        self.end
    }

    /// Whether the window that ends at `mark` is as it was then.
    pub(super) fn keeps(&self, mark: u64) -> bool {
        let oldest = mark.saturating_sub(self.window as u64);
        self.first <= oldest && mark <= self.first + self.kept.len() as u64
    }

    /// Whether the run, begun again at `from`, will have filled the window that ends at `mark`.
    pub(super) fn fills(&self, from: u64, mark: u64) -> bool {
        from + self.window as u64 <= mark || self.keeps(mark) && self.first <= from
    }

    /// Ends the window at `mark`. Where what was there is not kept, it begins anew.
    pub(super) fn rewind(&mut self, mark: u64) {
        if !(self.first..=self.first + self.kept.len() as u64).contains(&mark) {
            self.kept.clear();
            self.first = mark;
        }
        self.end = mark;
    }

    /// Forgets what lies behind the window.
    pub(super) fn forget_future(&mut self) {
        self.kept.truncate((self.end - self.first) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(log: &Log<u32>) -> Vec<u32> {
        log.shown().copied().collect()
    }

    fn filled(to: u32) -> Log<u32> {
        let mut log = Log::new(3, 2);
        (0..to).for_each(|n| log.push(n));
        log
    }

    #[test]
    fn the_newest_are_shown_and_some_more_are_kept_to_go_back_to() {
        let mut log = filled(9);
        assert_eq!((shown(&log), log.mark(), log.newest()), (vec![6, 7, 8], 9, Some(&8)));
        assert!(log.keeps(9) && log.keeps(7) && !log.keeps(6) && !log.keeps(10));
        log.rewind(7);
        assert_eq!(shown(&log), [4, 5, 6]);
        log.push(7);
        log.push(8);
        assert_eq!(shown(&log), [6, 7, 8]);
        assert_eq!(log.range(1).copied().collect::<Vec<_>>(), [7, 8]);
    }

    #[test]
    fn another_record_than_the_one_that_was_makes_another_future() {
        let mut log = filled(9);
        log.rewind(7);
        log.push(70);
        assert_eq!((shown(&log), log.keeps(9)), (vec![5, 6, 70], false));
        log.push(8);
        assert_eq!(shown(&log), [6, 70, 8]);
        log.rewind(8);
        log.forget_future();
        assert!(!log.keeps(9) && log.keeps(8));
    }

    #[test]
    fn a_window_that_is_not_kept_is_filled_again_from_far_enough_back() {
        let mut log = filled(100);
        assert!(!log.keeps(50) && log.fills(47, 50) && !log.fills(48, 50) && !log.fills(0, 2));
        log.rewind(47);
        assert_eq!((shown(&log), log.mark()), (vec![], 47));
        (47..50).for_each(|n| log.push(n));
        assert_eq!((shown(&log), log.mark()), (vec![47, 48, 49], 50));
        // What is kept lies before where the run begins again.
        assert!(log.fills(49, 50) && !log.fills(50, 51));
    }

    #[test]
    fn what_is_popped_is_replaced() {
        let mut log = filled(2);
        log.pop();
        log.push(10);
        assert_eq!(shown(&log), [0, 10]);
        let mut empty: Log<u32> = Log::new(3, 0);
        empty.pop();
        assert_eq!((empty.len(), empty.mark(), empty.newest()), (0, 0, None));
    }
}
