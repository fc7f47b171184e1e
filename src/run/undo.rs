//! The changes of a person that can be undone, and those that can be done again: one stack for all of them.

use super::course::{Course, Noted, Snapshot};
use super::race::JournalTail;
use super::start::StartSettings;

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
    pub(super) replaced: Replaced,
}

/// The state on the other side of a change.
pub(super) enum Replaced {
    /// Nothing of the run: the change was one of the next start.
    Nothing,
    Future(Future),
    Course(Box<Course>),
}

/// The future of a run from a tick on.
pub(super) struct Future {
    /// The tick of the change. Up to it, before its actions, both futures are the same.
    pub(super) tick: u64,
    /// Its rows of the journal: not the whole, which grows for as long as a run is steered.
    pub(super) rows: JournalTail,
    pub(super) noted: Noted,
}

impl Replaced {
    fn noted(&self) -> Option<&Noted> {
        match self {
            Replaced::Nothing => None,
            Replaced::Future(future) => Some(&future.noted),
            Replaced::Course(course) => Some(&course.noted),
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
        let is_run = |change: &Change| matches!(change.replaced, Replaced::Course(_));
        while self.done.len() > MAX_CHANGES
            || self.done.iter().filter(|change| is_run(change)).count() > MAX_RUNS
        {
            self.done.remove(0);
        }
    }

    /// Names the newest change by what it has come to.
    pub(super) fn rename_newest(&mut self, what: String) {
        self.done.last_mut().expect("a change is open").what = what;
    }

    /// Whether an action now belongs to the newest change, which already has the future before it.
    pub(super) fn has_future(&self) -> bool {
        let newest = self.done.last().filter(|_| self.is_open);
        newest.is_some_and(|change| matches!(change.replaced, Replaced::Future(_)))
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
        self.changes().filter_map(|change| change.replaced.noted())
    }

    /// The snapshots of all that was replaced.
    pub(super) fn snapshots(&self) -> impl Iterator<Item = &Snapshot> {
        self.noted().flat_map(|noted| &noted.snapshots)
    }

    /// The memory of the drawn pasts of the runs that are kept, in bytes.
    pub(super) fn past_bytes(&self) -> usize {
        let pasts = self.changes().filter_map(|change| match &change.replaced {
            Replaced::Course(course) => Some(course.seen.past().heap_bytes()),
            Replaced::Nothing | Replaced::Future(_) => None,
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
            match &mut change.replaced {
                Replaced::Nothing => {}
                Replaced::Future(future) => future.noted.snapshots.retain(&stays),
                Replaced::Course(course) => course.noted.snapshots.retain(&stays),
            }
        }
    }

    /// Drops the snapshots of all replaced futures, whose past was recorded otherwise than it now is.
    pub(super) fn clear_futures(&mut self) {
        for change in self.done.iter_mut().chain(&mut self.undone) {
            if let Replaced::Future(future) = &mut change.replaced {
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
