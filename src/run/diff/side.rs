//! The rows of a side that wait for those of the other.

use std::collections::{HashMap, VecDeque};

use csv::ByteRecord;

use super::{MAX_WAITING, MAX_WAITING_BYTES};

/// A row, where it belongs.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Place {
    /// The tick or the time, as bits that are in order.
    pub(super) order: u64,
    pub(super) stream: usize,
}

/// A row that waits for the other side's.
pub(super) struct Waiting {
    pub(super) row: ByteRecord,
    /// How many rows its side had before it.
    pub(super) number: u64,
}

/// A side of the comparison.
#[derive(Default)]
pub(super) struct Side {
    /// The stream that the next row is of, if streams come in turn.
    pub(super) next: usize,
    pub(super) number: u64,
    /// The order of the last row.
    pub(super) order: u64,
    pub(super) waiting: HashMap<Place, Waiting>,
    /// The bytes of the rows that wait.
    waiting_bytes: usize,
    /// The rows that wait, and some that did, as they came.
    queue: VecDeque<(Place, u64)>,
}

impl Side {
    /// Lets a row wait. Returns the one of the same name that it replaces.
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

    /// Takes out the row of this name.
    pub(super) fn remove(&mut self, place: &Place) -> Option<Waiting> {
        let row = self.waiting.remove(place)?;
        self.waiting_bytes -= row.row.as_slice().len();
        Some(row)
    }

    pub(super) fn is_full(&self) -> bool {
        self.waiting.len() > MAX_WAITING || self.waiting_bytes > MAX_WAITING_BYTES
    }

    /// Takes out the row that has waited longest.
    pub(super) fn oldest(&mut self) -> Option<(Place, Waiting)> {
        while let Some((place, number)) = self.queue.pop_front() {
            if self.waiting.get(&place).is_some_and(|row| row.number == number) {
                return Some((place, self.remove(&place)?));
            }
        }
        None
    }
}
