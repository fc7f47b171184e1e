//! The changes of a person that can be undone, and those that can be done again: one stack for all of them.

use super::run_with_past::{Noted, RunWithPast, Snapshot};
use super::start::StartSettings;
use crate::run::race::JournalTail;

/// The most changes that can be undone.
const MAX_CHANGES: usize = 200;

/// The most runs before a restart that are kept.
const MAX_RUNS: usize = 4;

/// A change of a person, with what is on its other side.
pub(super) struct Change {
    /// Its name for people.
    pub(super) what: String,
    /// The settings of the next start.
    pub(super) next: StartSettings,
    pub(super) other: Other,
}

/// What a change has replaced, or what undoing it has replaced.
pub(super) enum Other {
    /// Nothing of the run: the change was one of the next start.
    Nothing,
    Future(Future),
    Run(Box<RunWithPast>),
}

/// The future of a run from a tick on.
pub(super) struct Future {
    /// The tick of the change. Up to it, before its actions, both futures are the same.
    pub(super) tick: u64,
    /// Its rows of the journal: not the whole, which grows for as long as a run is steered.
    pub(super) rows: JournalTail,
    pub(super) noted: Noted,
}

impl Other {
    fn noted(&self) -> Option<&Noted> {
        match self {
            Other::Nothing => None,
            Other::Future(future) => Some(&future.noted),
            Other::Run(run) => Some(&run.noted),
        }
    }
}

/// The changes of a person, newest last.
#[derive(Default)]
pub(super) struct UndoStack {
    pub(super) done: Vec<Change>,
    pub(super) undone: Vec<Change>,
    /// Whether what a person does next belongs to the newest change.
    is_open: bool,
}

impl UndoStack {
    /// Adds a change. Those that were undone cannot be done again.
    pub(super) fn push(&mut self, change: Change) {
        self.undone.clear();
        self.done.push(change);
        self.is_open = true;
        let is_run = |change: &Change| matches!(change.other, Other::Run(_));
        while self.done.len() > MAX_CHANGES
            || self.done.iter().filter(|change| is_run(change)).count() > MAX_RUNS
        {
            self.done.remove(0);
        }
    }

    /// Whether an action now belongs to the newest change, which already has the future before it.
    pub(super) fn has_future(&self) -> bool {
        let newest = self.done.last().filter(|_| self.is_open);
        newest.is_some_and(|change| matches!(change.other, Other::Future(_)))
    }

    /// Whether a change of the next start now belongs to the newest change.
    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    /// Ends the newest change: what a person does next is another.
    pub(super) fn close(&mut self) {
        self.is_open = false;
    }

    fn changes(&self) -> impl Iterator<Item = &Change> {
        self.done.iter().chain(&self.undone)
    }

    /// What was noted of all that was replaced.
    fn noted(&self) -> impl Iterator<Item = &Noted> {
        self.changes().filter_map(|change| change.other.noted())
    }

    /// The snapshots of all that was replaced.
    pub(super) fn snapshots(&self) -> impl Iterator<Item = &Snapshot> {
        self.noted().flat_map(|noted| &noted.snapshots)
    }

    /// The memory of the drawn pasts of the runs that are kept, in bytes.
    pub(super) fn past_bytes(&self) -> usize {
        let pasts = self.changes().filter_map(|change| match &change.other {
            Other::Run(run) => Some(run.past.heap_bytes()),
            Other::Nothing | Other::Future(_) => None,
        });
        pasts.sum()
    }

    /// The last tick of all that was replaced.
    pub(super) fn end(&self) -> u64 {
        self.noted().map(|noted| noted.end).max().unwrap_or(0)
    }

    /// Drops the snapshots that do not stay.
    pub(super) fn retain(&mut self, stays: impl Fn(&Snapshot) -> bool) {
        for change in self.done.iter_mut().chain(&mut self.undone) {
            match &mut change.other {
                Other::Nothing => {}
                Other::Future(future) => future.noted.snapshots.retain(&stays),
                Other::Run(run) => run.noted.snapshots.retain(&stays),
            }
        }
    }

    /// Drops the snapshots of all replaced futures, whose past was recorded otherwise than it now is.
    pub(super) fn clear_futures(&mut self) {
        for change in self.done.iter_mut().chain(&mut self.undone) {
            if let Other::Future(future) = &mut change.other {
                future.noted.snapshots.clear();
            }
        }
    }

    /// Drops the change that would be undone last, or else the one that would be done again last. Returns whether there was
    /// one.
    pub(super) fn drop_last(&mut self) -> bool {
        let from = if self.done.is_empty() { &mut self.undone } else { &mut self.done };
        let is_there = !from.is_empty();
        from.drain(..usize::from(is_there));
        is_there
    }
}
