//! A bounded log whose visible window ends at the present or earlier.

use std::collections::{VecDeque, vec_deque};

/// A bounded sequence of records with a visible window, which is allocated once.
///
/// Numbers count records from the run's start. While a run is in its past, the records of its future stay after the
/// window. If a repetition [pushes](WindowedLog::push) an equal record, the log keeps the stored one.
#[derive(Clone, Debug)]
pub(super) struct WindowedLog<T> {
    kept: VecDeque<T>,
    /// Maximum number of visible records.
    window: usize,
    /// Maximum number of kept records.
    capacity: usize,
    /// Number of the oldest kept record.
    first: u64,
    /// Number after the newest visible record.
    end: u64,
}

impl<T: PartialEq> WindowedLog<T> {
    /// Creates an empty log that shows the newest `window` records and keeps `spare` more.
    pub(super) fn new(window: usize, spare: usize) -> Self {
        let capacity = window + spare;
        Self { kept: VecDeque::with_capacity(capacity), window, capacity, first: 0, end: 0 }
    }

    /// Returns the heap memory of the log in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.capacity * size_of::<T>()
    }

    /// Returns the number of visible records.
    pub(super) fn len(&self) -> usize {
        self.window.min((self.end - self.first) as usize)
    }

    /// Returns the visible records, with the oldest first.
    pub(super) fn shown(&self) -> vec_deque::Iter<'_, T> {
        self.range(0)
    }

    /// Returns the visible records, with the oldest first, each with its number.
    pub(super) fn numbered(&self) -> impl Iterator<Item = (u64, &T)> {
        (self.end - self.len() as u64..self.end).zip(self.shown())
    }

    /// Returns the visible records, without the `skipped` oldest ones.
    pub(super) fn range(&self, skipped: usize) -> vec_deque::Iter<'_, T> {
        let end = (self.end - self.first) as usize;
        self.kept.range(end - self.len() + skipped..end)
    }

    /// Returns the index of the first visible record at or after `t` (s). If the body was placed at `t`, it is the
    /// index of the last placement. `moment` returns a record's time, and whether the record is a placement.
    pub(super) fn count_before(&self, t: f64, moment: impl Fn(&T) -> (f64, bool)) -> usize {
        let end = (self.end - self.first) as usize;
        let oldest = end - self.len();
        let first = self.kept.partition_point(|record| moment(record).0 < t).clamp(oldest, end);
        let at_once = self.kept.range(first..end).map(moment).take_while(|(time, _)| *time == t);
        let put = at_once.enumerate().filter(|(_, (_, is_put))| *is_put).last();
        first - oldest + put.map_or(0, |(place, _)| place)
    }

    /// Returns the newest visible record.
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

    /// Removes the newest visible record from the window; the next record replaces it.
    pub(super) fn pop(&mut self) {
        self.end = self.first.max(self.end.saturating_sub(1));
    }

    /// Returns the end of the window, which is the number after the newest visible record.
    pub(super) fn mark(&self) -> u64 {
        self.end
    }

    /// Whether the log still keeps all records of the window that ends at `mark`.
    pub(super) fn keeps_window(&self, mark: u64) -> bool {
        let oldest = mark.saturating_sub(self.window as u64);
        self.first <= oldest && mark <= self.first + self.kept.len() as u64
    }

    /// Whether a repetition from `from` fills the window that ends at `mark`.
    pub(super) fn fills(&self, from: u64, mark: u64) -> bool {
        from + self.window as u64 <= mark || self.keeps_window(mark) && self.first <= from
    }

    /// Ends the window at `mark`. If the log has no records at that number, it is cleared.
    pub(super) fn rewind(&mut self, mark: u64) {
        if !(self.first..=self.first + self.kept.len() as u64).contains(&mark) {
            self.kept.clear();
            self.first = mark;
        }
        self.end = mark;
    }

    /// Drops the records after the window.
    pub(super) fn forget_future(&mut self) {
        self.kept.truncate((self.end - self.first) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(log: &WindowedLog<u32>) -> Vec<u32> {
        log.shown().copied().collect()
    }

    fn filled(to: u32) -> WindowedLog<u32> {
        let mut log = WindowedLog::new(3, 2);
        (0..to).for_each(|n| log.push(n));
        log
    }

    #[test]
    fn the_newest_records_are_visible_and_older_ones_return_on_rewind() {
        let mut log = filled(9);
        assert_eq!((shown(&log), log.mark(), log.newest()), (vec![6, 7, 8], 9, Some(&8)));
        assert!(
            log.keeps_window(9)
                && log.keeps_window(7)
                && !log.keeps_window(6)
                && !log.keeps_window(10)
        );
        log.rewind(7);
        assert_eq!(shown(&log), [4, 5, 6]);
        log.push(7);
        log.push(8);
        assert_eq!(shown(&log), [6, 7, 8]);
        assert_eq!(log.range(1).copied().collect::<Vec<_>>(), [7, 8]);
    }

    #[test]
    fn a_differing_record_discards_the_recorded_future() {
        let mut log = filled(9);
        log.rewind(7);
        log.push(70);
        assert_eq!((shown(&log), log.keeps_window(9)), (vec![5, 6, 70], false));
        log.push(8);
        assert_eq!(shown(&log), [6, 70, 8]);
        log.rewind(8);
        log.forget_future();
        assert!(!log.keeps_window(9) && log.keeps_window(8));
    }

    #[test]
    fn a_lost_window_is_refilled_from_far_enough_back() {
        let mut log = filled(100);
        assert!(
            !log.keeps_window(50) && log.fills(47, 50) && !log.fills(48, 50) && !log.fills(0, 2)
        );
        log.rewind(47);
        assert_eq!((shown(&log), log.mark()), (vec![], 47));
        (47..50).for_each(|n| log.push(n));
        assert_eq!((shown(&log), log.mark()), (vec![47, 48, 49], 50));
        // The kept records end before the start of the repetition.
        assert!(log.fills(49, 50) && !log.fills(50, 51));
    }

    #[test]
    fn a_popped_record_is_replaced() {
        let mut log = filled(2);
        log.pop();
        log.push(10);
        assert_eq!(shown(&log), [0, 10]);
        let mut empty: WindowedLog<u32> = WindowedLog::new(3, 0);
        empty.pop();
        assert_eq!((empty.len(), empty.mark(), empty.newest()), (0, 0, None));
    }
}
