//! A run as far as it was reached: its present, its drawn past, its snapshots and what happened in it.

use super::hashes::Hashes;
use super::{Event, Session};
use crate::run::past::{Past, PastMark};
use crate::run::race::{Journal, Race};

/// A run as far as it was reached, wherever it is now.
pub(super) struct RunWithPast {
    pub(super) session: Session,
    pub(super) past: Past,
    pub(super) noted: Noted,
}

/// How far a run has come, and what was noted on its way, which can be made again.
#[derive(Default)]
pub(super) struct Noted {
    /// The last tick reached.
    pub(super) end: u64,
    /// By tick; of a whole run the first is the start.
    pub(super) snapshots: Vec<Snapshot>,
    pub(super) halts: Vec<Event>,
    /// By tick, as ticks were first made.
    pub(super) hashes: Vec<Hashes>,
}

impl RunWithPast {
    pub(super) fn new(session: Session) -> Self {
        let past = Past::new(session.race(), session.scene().seconds);
        let mut run = Self { session, past, noted: Noted::default() };
        run.noted.snapshots.push(run.snapshot());
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

impl Noted {
    /// Splits off what the actions at `tick` decide.
    pub(super) fn split_off(&mut self, tick: u64) -> Self {
        let Self { end, snapshots, halts, hashes } = self;
        // A snapshot holds the session as it reached a tick, before the actions there, and so do hashes.
        let later = snapshots.partition_point(|snapshot| snapshot.race.tick() <= tick);
        let snapshots = snapshots.split_off(later);
        let later = halts.partition_point(|event| event.tick < tick);
        let halts = halts.split_off(later);
        let later = hashes.partition_point(|it| it.tick <= tick);
        let hashes = hashes.split_off(later);
        Self { end: std::mem::replace(end, tick), snapshots, halts, hashes }
    }

    /// Adds what was split off.
    pub(super) fn extend(&mut self, other: Self) {
        let Self { end, snapshots, halts, hashes } = other;
        self.end = end;
        self.snapshots.extend(snapshots);
        self.halts.extend(halts);
        self.hashes.extend(hashes);
    }
}

/// A session at a tick.
pub(super) struct Snapshot {
    /// Without a journal, which the timeline has.
    pub(super) race: Race,
    pub(super) mark: PastMark,
    pub(super) bytes: usize,
}
