//! Rows of one side that wait for their counterparts.

use std::collections::{HashMap, VecDeque};

use csv::ByteRecord;

use super::{MAX_WAITING, MAX_WAITING_BYTES};

/// Identity of a row, which is its order and its stream.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Place {
    /// Tick or time, as bits that sort alike.
    pub(super) order: u64,
    pub(super) stream: usize,
}

/// A row that waits for its counterpart.
pub(super) struct Waiting {
    pub(super) row: ByteRecord,
    /// Number of rows before this one on its side.
    pub(super) number: u64,
}

/// One side of the comparison.
#[derive(Default)]
pub(super) struct Side {
    /// Expected stream of the next row, if streams take turns.
    pub(super) next: usize,
    pub(super) number: u64,
    /// Order of the last row.
    pub(super) order: u64,
    pub(super) waiting: HashMap<Place, Waiting>,
    /// Bytes of the waiting rows.
    waiting_bytes: usize,
    /// Waiting rows in order of arrival. Some of these may no longer wait.
    queue: VecDeque<(Place, u64)>,
}

impl Side {
    /// Queues a row. Returns the earlier row at the same place, if the new row replaces one.
    pub(super) fn insert(&mut self, place: Place, row: Waiting) -> Option<Waiting> {
        self.waiting_bytes += row.row.as_slice().len();
        self.queue.push_back((place, row.number));
        let twice = self.waiting.insert(place, row);
        self.waiting_bytes -= twice.as_ref().map_or(0, |twice| twice.row.as_slice().len());
        if self.queue.len() > 2 * MAX_WAITING {
            let Side { queue, waiting, .. } = self;
            queue.retain(|(at, n)| waiting.get(at).is_some_and(|row| row.number == *n));
        }
        twice
    }

    /// Removes the row at this place.
    pub(super) fn remove(&mut self, place: &Place) -> Option<Waiting> {
        let row = self.waiting.remove(place)?;
        self.waiting_bytes -= row.row.as_slice().len();
        Some(row)
    }

    pub(super) fn is_full(&self) -> bool {
        self.waiting.len() > MAX_WAITING || self.waiting_bytes > MAX_WAITING_BYTES
    }

    /// Removes the row that has waited longest, and returns it.
    pub(super) fn oldest(&mut self) -> Option<(Place, Waiting)> {
        while let Some((place, number)) = self.queue.pop_front() {
            if self.waiting.get(&place).is_some_and(|row| row.number == number) {
                return Some((place, self.remove(&place)?));
            }
        }
        None
    }
}
