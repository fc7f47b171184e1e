//! A run as far as it was reached: its present, its drawn past, its snapshots and what happened in it.

use super::hashes::Hashes;
use super::{Event, Session};
use crate::lab::past::{Past, PastMark};
use crate::lab::race::{Journal, Race};

/// A run as far as it was reached, wherever it is now.
pub(super) struct RunWithPast {
    pub(super) session: Session,
    pub(super) past: Past,
    /// By tick; the first is the start.
    pub(super) snapshots: Vec<Snapshot>,
    /// The last tick reached.
    pub(super) end: u64,
    pub(super) halts: Vec<Event>,
    /// By tick, as ticks were first made.
    pub(super) hashes: Vec<Hashes>,
}

impl RunWithPast {
    pub(super) fn new(session: Session) -> Self {
        let past = Past::new(session.race(), session.scene().seconds);
        let (snapshots, halts, hashes) = Default::default();
        let mut run = Self { session, past, snapshots, end: 0, halts, hashes };
        run.snapshots.push(run.snapshot());
        run
    }

    pub(super) fn snapshot(&self) -> Snapshot {
        let mut race = self.session.race.clone();
        race.set_journal(Journal::default());
        let mark = self.past.mark();
        let bytes = race.bytes() + mark.heap_bytes() + size_of::<PastMark>();
        Snapshot { race, mark, bytes }
    }
}

/// A session at a tick.
pub(super) struct Snapshot {
    /// Without a journal, which the timeline has.
    pub(super) race: Race,
    pub(super) mark: PastMark,
    pub(super) bytes: usize,
}
