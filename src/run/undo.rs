//! One stack of all edits that can be undone or redone.
//!
//! One change is whatever happens between pointer down and pointer up, or by one key: an edit joins the newest change
//! until that is closed. So undo takes back a whole drag. Within a run a change holds the other side as journal rows,
//! which repeat it exactly: its snapshots only save time, and memory may run out of room for them.

use super::course::{Course, RunRecord, Snapshot};
use super::race::JournalTail;
use super::start::StartSettings;

/// Maximum number of changes that can be undone.
const MAX_CHANGES: usize = 200;

/// Maximum number of runs that are kept from before a restart.
const MAX_RUNS: usize = 4;

/// An edit by a person, with the state on its other side.
pub(super) struct Change {
    /// Description for people.
    pub(super) what: String,
    /// Settings of the next start on the other side.
    pub(super) next: StartSettings,
    pub(super) replaced: Replaced,
}

/// The state on the other side of a change.
pub(super) enum Replaced {
    /// The run did not change, but only the next start.
    Nothing,
    Future(ReplacedFuture),
    Course(Box<Course>),
}

/// The future of a run from a tick on.
pub(super) struct ReplacedFuture {
    /// Tick of the change. Until this tick, before its actions, both futures are the same.
    pub(super) tick: u64,
    /// Rows of the journal that only this future has. The whole journal grows for as long as a person steers the run.
    pub(super) rows: JournalTail,
    pub(super) record: RunRecord,
}

impl Replaced {
    fn record(&self) -> Option<&RunRecord> {
        match self {
            Replaced::Nothing => None,
            Replaced::Future(future) => Some(&future.record),
            Replaced::Course(course) => Some(&course.record),
        }
    }
}

/// Edits by a person, with the newest last.
#[derive(Default)]
pub(super) struct UndoStack {
    pub(super) done: Vec<Change>,
    pub(super) undone: Vec<Change>,
    /// Whether the next edit joins the newest change.
    is_open: bool,
}

impl UndoStack {
    /// Adds a change, and drops all undone ones.
    pub(super) fn push(&mut self, change: Change) {
        self.undone.clear();
        self.done.push(change);
        self.is_open = true;
        let is_run = |change: &Change| matches!(change.replaced, Replaced::Course(_));
        while self.done.len() > MAX_CHANGES
            || self.done.iter().filter(|change| is_run(change)).count() > MAX_RUNS
        {
            self.done.remove(0);
        }
    }

    /// Renames the newest change after the change's latest edit.
    pub(super) fn rename_newest(&mut self, what: String) {
        self.done.last_mut().expect("a change is open").what = what;
    }

    /// Whether an action would join the newest change, and that change already holds its future.
    pub(super) fn has_future(&self) -> bool {
        self.open().is_some_and(|change| matches!(change.replaced, Replaced::Future(_)))
    }

    /// Returns the newest change, if the next edit joins it.
    pub(super) fn open(&self) -> Option<&Change> {
        self.done.last().filter(|_| self.is_open)
    }

    /// Whether an edit of the next start would join the newest change.
    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    /// Closes the newest change, so that the next edit starts another one.
    pub(super) fn close(&mut self) {
        self.is_open = false;
    }

    fn changes(&self) -> impl Iterator<Item = &Change> {
        self.done.iter().chain(&self.undone)
    }

    /// Returns the records of all replaced futures and runs.
    fn records(&self) -> impl Iterator<Item = &RunRecord> {
        self.changes().filter_map(|change| change.replaced.record())
    }

    /// Returns the snapshots of all replaced futures and runs.
    pub(super) fn snapshots(&self) -> impl Iterator<Item = &Snapshot> {
        self.records().flat_map(|record| &record.snapshots)
    }

    /// Returns the memory (bytes) of the drawn pasts of the kept runs.
    pub(super) fn past_bytes(&self) -> usize {
        let pasts = self.changes().filter_map(|change| match &change.replaced {
            Replaced::Course(course) => Some(course.seen.past().heap_bytes()),
            Replaced::Nothing | Replaced::Future(_) => None,
        });
        pasts.sum()
    }

    /// Returns the last tick of all replaced futures and runs.
    pub(super) fn end(&self) -> u64 {
        self.records().map(|record| record.end).max().unwrap_or(0)
    }

    /// Drops the snapshots for which `stays` is false.
    pub(super) fn retain(&mut self, stays: impl Fn(&Snapshot) -> bool) {
        for change in self.done.iter_mut().chain(&mut self.undone) {
            match &mut change.replaced {
                Replaced::Nothing => {}
                Replaced::Future(future) => future.record.snapshots.retain(&stays),
                Replaced::Course(course) => course.record.snapshots.retain(&stays),
            }
        }
    }

    /// Drops the snapshots of all replaced futures, because their past has other coordinates.
    pub(super) fn clear_futures(&mut self) {
        for change in self.done.iter_mut().chain(&mut self.undone) {
            if let Replaced::Future(future) = &mut change.replaced {
                future.record.snapshots.clear();
            }
        }
    }

    /// Drops the change that undo would reach last or, if there is none, the one that redo would reach last. Returns
    /// whether there was a change to drop.
    pub(super) fn drop_last(&mut self) -> bool {
        let from = if self.done.is_empty() { &mut self.undone } else { &mut self.done };
        let is_there = !from.is_empty();
        from.drain(..usize::from(is_there));
        is_there
    }
}
