//! A run, which has lanes that race against the truth, a person's actions on these lanes, a drawn past, and a text.
//!
//! A [`race`] ticks its lanes and performs the actions of its journal; a [`Session`] is a scene's race as a plain
//! value. A [`Run`] moves back and forth in time, and undoes edits. [`Observations`] follow the run's race. They are
//! the [`Menu`], the checkpoints from which verdicts restart, and the drawn [`past`].
//!
//! Each tick updates the [`METRICS`]. A [`trace`] tabulates them, and [`diff`] compares two such tables. A [`link`]
//! is a run in an address.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_scene as scene;
use regatta_sim as sim;
use regatta_table as table;

use std::mem::{replace, swap};

use crate::scene::Action;
pub use course::Checked;
use course::{Course, Hashes, RunRecord, Snapshot};
use past::Past;
use race::{Author, Checkpoints, Mode, Observer, PerformedAction, TimeScale};
use undo::{Change, Replaced, ReplacedFuture, UndoStack};

mod course;
mod csv_row;
pub mod diff;
mod event;
pub mod link;
mod menu;
mod metrics;
mod observations;
pub mod past;
pub mod race;
mod recording;
mod session;
mod start;
pub mod trace;
mod undo;

pub use csv_row::csv_row;
pub use event::{Event, EventKind};
pub use menu::{Menu, MenuIndex};
pub use metrics::{METRICS, Metric, Scale, Unit, energy_gained_j, energy_gained_percent, energy_j};
pub use observations::Observations;
pub use race::{Journal, Lane, Race, Ticker};
pub use recording::MAX_CHECKS;
pub use recording::with_menu_lanes as recording_among;
pub use recording::{Reached, RecordingError, Replay, text as recording_text};
pub use session::Session;
pub use start::StartSettings;

/// Default memory limit in bytes for snapshots and the drawn pasts of kept runs.
pub const SNAPSHOT_BYTES: usize = 64 << 20;

/// Initial spacing of snapshots in ticks. These are few enough to repeat in less than a frame.
const SPACING: u64 = 32;

/// Maximum work that recording another coordinate may repeat, which takes about a second. Work is the number of
/// evaluations of accelerations, multiplied by a body's number of coordinates plus [`WORK_OF_AN_EVALUATION`].
const MAX_REPEATED_WORK: u64 = 10_000_000;

/// Fixed cost of an evaluation, in units of the cost per coordinate.
const WORK_OF_AN_EVALUATION: u64 = 4;

/// A session that moves back and forth in time, with its drawn past and the settings of its next restart.
///
/// The run keeps snapshots of the session at regular ticks. To reach a tick, it starts from the nearest earlier
/// snapshot and repeats the journal's actions. When the snapshots reach their memory limit, their spacing doubles. A
/// person's edits can be undone and redone.
pub struct Run {
    course: Course,
    /// Settings of the next restart.
    next: StartSettings,
    spacing: u64,
    limit: usize,
    changes: UndoStack,
}

impl Run {
    /// Creates the run of a session at its start.
    pub fn new(session: Session) -> Self {
        Self::with_limit(session, SNAPSHOT_BYTES)
    }

    /// Like [`Run::new`], with at most `limit` bytes for snapshots and kept runs.
    pub fn with_limit(session: Session, limit: usize) -> Self {
        Self { limit, ..Self::of(StartSettings::of_session(&session), session) }
    }

    /// Creates a run that starts with these settings.
    pub fn starting_with(next: StartSettings) -> Self {
        let session = next.session();
        Self::of(next, session)
    }

    fn of(next: StartSettings, session: Session) -> Self {
        let course = Course::new(session, next.is_as_opened());
        let changes = UndoStack::default();
        Self { course, next, spacing: SPACING, limit: SNAPSHOT_BYTES, changes }
    }

    /// Returns the session at the present tick.
    pub fn session(&self) -> &Session {
        &self.course.session
    }
    /// Returns the settings of the next restart, which are those of this start, plus a person's edits since.
    pub fn next(&self) -> &StartSettings {
        &self.next
    }
    /// Returns the settings of the next restart, for changes that undo skips.
    pub fn next_mut(&mut self) -> &mut StartSettings {
        &mut self.next
    }
    /// Returns the race at tick 0, before any action, without its journal.
    pub fn start(&self) -> &Race {
        self.course.session.start()
    }
    /// Returns the time of every tick, from past and pending changes of the tick rate.
    pub fn times(&self) -> TimeScale {
        let rows = self.course.session.journal().rows().iter();
        let changes = rows.filter_map(|row| Some((row.tick, row.action.tick_hz()?)));
        TimeScale::new((0, 0.0), self.start().tick_hz(), changes)
    }
    /// Returns the lanes and the truth at the present tick.
    pub fn race(&self) -> &Race {
        self.course.race()
    }
    /// Returns the drawn past.
    pub fn past(&self) -> &Past {
        self.course.seen.past()
    }
    /// Returns the methods to which digits and rows refer.
    pub fn menu(&self) -> &Menu {
        self.course.seen.menu()
    }
    /// Returns the checkpoints from which verdicts and clouds restart.
    pub fn checkpoints(&self) -> &Checkpoints {
        self.course.seen.checkpoints()
    }
    /// Returns the last tick reached.
    pub fn end(&self) -> u64 {
        self.course.record.end
    }
    /// Whether the present tick is before the last tick reached.
    pub fn is_in_past(&self) -> bool {
        self.race().tick() < self.course.record.end
    }
    /// Returns the memory in bytes of the snapshots, and of the drawn pasts from before restarts.
    pub fn bytes(&self) -> usize {
        let all = self.course.record.snapshots.iter().chain(self.changes.snapshots());
        all.map(|snapshot| snapshot.bytes).sum::<usize>() + self.changes.past_bytes()
    }
    /// Returns the limit for [`Run::bytes`].
    pub fn limit(&self) -> usize {
        self.limit
    }
    /// Sets the limit for [`Run::bytes`], effective from the next snapshot.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }
    /// Returns the description of the change that [`Run::undo`] would take back; `None` if there is none.
    pub fn undoes(&self) -> Option<&str> {
        self.changes.done.last().map(|change| &change.what[..])
    }
    /// Returns the description of the change that [`Run::redo`] would repeat; `None` if there is none.
    pub fn redoes(&self) -> Option<&str> {
        self.changes.undone.last().map(|change| &change.what[..])
    }

    /// Returns the checks of the scene that the run has reached, by tick. A run that a person has changed has no
    /// further ones.
    pub fn checked(&self) -> &[Checked] {
        &self.course.record.checked
    }

    /// Returns the first failed check up to the present tick.
    pub fn first_failed_check(&self) -> Option<Checked> {
        let reached = self.checked().iter().take_while(|check| check.tick <= self.race().tick());
        reached.copied().find(|check| !check.is_same)
    }

    /// Returns the events up to the last tick reached, in order.
    pub fn events(&self) -> Vec<Event> {
        let rows = self.course.session.journal().rows().iter();
        let is_solo = self.start().mode() == Mode::Solo;
        let mut solo = is_solo.then(|| self.start().entrants()[0].id);
        let done = rows.take_while(|row| row.tick <= self.course.record.end).map(|row| {
            if let Action::Solo { lane } = row.action {
                solo = Some(lane);
            }
            let (action, author) = (row.action.clone(), row.author);
            Event { tick: row.tick, kind: EventKind::Done { action, author, solo } }
        });
        let mut events: Vec<Event> = done.chain(self.course.record.halts.iter().cloned()).collect();
        events.sort_by_key(|event| event.tick);
        events
    }

    /// Extends the drawn past to the present, even if no sample is due.
    pub fn show_present(&mut self) {
        self.course.seen.show_present(self.course.session.race());
    }

    /// Performs the journal's pending actions at the present tick.
    pub fn catch_up(&mut self, observer: &mut dyn Observer) {
        self.course.catch_up(observer);
    }

    /// Makes a tick and notifies the observer. In the past, this repeats the recorded tick.
    pub fn tick(&mut self, observer: &mut dyn Observer) {
        self.course.tick(observer);
        if self.race().tick().is_multiple_of(self.spacing) {
            self.take_snapshot();
        }
    }

    /// Performs an action at the present tick, like [`Session::act`], as a change that [`Run::undo`] takes back. In the
    /// past, the action begins another future. Returns whether the action changed anything.
    pub fn act(&mut self, action: Action) -> bool {
        self.close_change();
        self.act_within(action, &mut ()).is_some()
    }

    /// Whether [`act_within`](Self::act_within) replaces the only action of the open change by this one, because both
    /// set the same quantity at the present tick.
    pub fn replaces_open_action(&self, action: &Action) -> bool {
        let (race, Some(change)) = (self.race(), self.changes.open()) else { return false };
        let Replaced::Future(ReplacedFuture { tick, rows, .. }) = &change.replaced else {
            return false;
        };
        let performed = race.journal().rows()[..race.done()].get(rows.kept..);
        let Some([only]) = performed.filter(|_| *tick == race.tick()) else { return false };
        only.author == Author::Person && only.action.sets_same(action)
    }

    /// Performs an action as part of the open change, or of a new one. In a drag while time waits, the last value
    /// replaces the earlier ones, and a drag that returns to the first value leaves no change. Edits also apply to the
    /// next restart. Returns `None` if the action changes nothing.
    pub fn act_within(
        &mut self,
        action: Action,
        observer: &mut dyn Observer,
    ) -> Option<PerformedAction> {
        if self.replaces_open_action(&action) {
            let mut change = self.changes.done.pop().expect("it is open");
            self.swap_change(&mut change);
        } else if !self.changes.is_open() && action.sets_same(&action) {
            self.take_snapshot_before_actions();
        }
        let was_past = self.is_in_past();
        let journal = self.course.session.journal().clone();
        let tick = self.race().tick();
        let done = self.course.act(action, observer)?;
        self.course.seen.forget_future();
        let added = self.race().done() - 1;
        let rows = journal.tail_beside(self.course.session.journal(), added);
        let record = self.course.record.split_off(tick);
        let what = format!("{} (tick {tick})", done.action.in_words(self.course.session.scene()));
        // A change in the past has its own future to bring back.
        if was_past || !self.changes.has_future() {
            let replaced = Replaced::Future(ReplacedFuture { tick, rows, record });
            self.changes.push(Change { what, next: self.next.clone(), replaced });
        } else {
            self.changes.rename_newest(what);
        }
        self.next.apply_edit(&done, self.course.race(), self.course.seen.menu());
        Some(done)
    }

    /// Changes a setting of the next start, as part of the open change, or of a new one. Both `set` and this function
    /// return whether a setting changed.
    pub fn set_next(&mut self, what: &str, set: impl FnOnce(&mut StartSettings) -> bool) -> bool {
        let before = self.next.clone();
        let is_changed = set(&mut self.next);
        if let Some(Change { next, replaced: Replaced::Nothing, .. }) = self.changes.open()
            && next.has_same_values(&self.next)
        {
            self.changes.done.pop();
            self.changes.close();
        } else if is_changed && !self.changes.is_open() {
            let (what, replaced) = (what.to_owned(), Replaced::Nothing);
            self.changes.push(Change { what, next: before, replaced });
        }
        is_changed
    }

    /// Applies `set` to the next start's settings and begins a run with these. With a description in `kept`,
    /// [`Run::undo`] can bring back the present run; otherwise the present run is lost.
    pub fn restart(&mut self, kept: Option<&str>, set: impl FnOnce(&mut StartSettings)) {
        let before = self.next.clone();
        set(&mut self.next);
        self.next.settle();
        let begun = Course::new(self.next.session(), self.next.is_as_opened());
        let course = replace(&mut self.course, begun);
        self.changes.undone.clear();
        if let Some(what) = kept {
            let (what, replaced) = (what.to_owned(), Replaced::Course(Box::new(course)));
            self.changes.push(Change { what, next: before, replaced });
            self.thin_to_limit();
        }
        self.spacing = SPACING;
    }

    /// Closes the open change, so that undo handles the next edit separately.
    pub fn close_change(&mut self) {
        self.changes.close();
    }

    /// Clears the undo stack, so that all edits up to now become part of the start.
    pub fn forget_changes(&mut self) {
        self.changes = UndoStack::default();
    }

    /// Takes back the newest change, and returns to the tick of that change. Undoing a restart brings back the earlier
    /// run at its former tick. Returns whether there was a change.
    pub fn undo(&mut self) -> bool {
        let Some(mut change) = self.changes.done.pop() else { return false };
        self.swap_change(&mut change);
        self.changes.undone.push(change);
        true
    }

    /// Repeats the change that was undone last, and moves to the tick of that change. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        let Some(mut change) = self.changes.undone.pop() else { return false };
        self.swap_change(&mut change);
        self.changes.done.push(change);
        true
    }

    /// Exchanges the present side of a change for the other side, which the change holds.
    fn swap_change(&mut self, change: &mut Change) {
        self.changes.close();
        swap(&mut self.next, &mut change.next);
        match &mut change.replaced {
            Replaced::Nothing => {}
            Replaced::Course(course) => swap(&mut self.course, course),
            Replaced::Future(ReplacedFuture { tick, rows, record }) => {
                let left = self.course.record.split_off(*tick);
                self.course.record.extend(replace(record, left));
                let mut journal = self.course.session.journal().clone();
                journal.swap_tail(rows);
                self.course.session.follow(journal);
                self.restore(*tick);
                // The recorded future belongs to the side that was just left.
                self.course.seen.forget_future();
                self.catch_up(&mut ());
            }
        }
    }

    /// Moves to a tick, at most the last one reached, in the state before the actions of that tick.
    pub fn seek(&mut self, tick: u64) {
        let tick = tick.min(self.course.record.end);
        if tick != self.race().tick() {
            self.restore(tick);
        }
    }

    /// Records these coordinates, one index per body, from now on, and also from the start by repeating the run. If
    /// that would take more than about a second, it returns `false` and keeps the previous coordinates.
    pub fn record_coordinates(&mut self, coordinates: &[usize]) -> bool {
        if self.past().coordinates().eq(coordinates.iter().copied()) {
            return true;
        }
        let bodies = self.race().entrants().iter().flat_map(|entrant| entrant.lane.bodies());
        let work = bodies.map(|body| {
            body.stepper.evaluations() * (body.coordinates().len() as u64 + WORK_OF_AN_EVALUATION)
        });
        if work.sum::<u64>() > MAX_REPEATED_WORK {
            return false;
        }
        let (tick, journal) = (self.race().tick(), self.course.session.journal().clone());
        let done = self.race().done();
        // The other snapshots mark a past with other coordinates.
        self.course.record.snapshots.truncate(1);
        self.changes.clear_futures();
        self.course.begin(coordinates.to_vec());
        self.course.record.snapshots[0].mark = self.course.seen.mark();
        self.course.session.follow(journal);
        self.repeat_to(tick);
        if self.race().done() < done {
            self.catch_up(&mut ());
        }
        true
    }

    /// Returns the hashes noted so far, in order of ticks.
    fn hashes(&self) -> &[Hashes] {
        &self.course.record.hashes
    }

    /// Returns the race at the last tick reached, before the actions of that tick.
    fn race_at_end(&self) -> Race {
        let Course { session, record: RunRecord { snapshots, end, .. }, .. } = &self.course;
        let before = session.journal().rows().partition_point(|row| row.tick < *end);
        if session.race.tick() == *end && session.race.done() == before {
            return session.race.clone();
        }
        let nearest = snapshots.partition_point(|snapshot| snapshot.race.tick() <= *end) - 1;
        let mut race = snapshots[nearest].race.clone();
        race.set_journal(session.journal().clone());
        race.run(end - race.tick());
        race
    }

    /// Moves to `tick` from a snapshot.
    fn restore(&mut self, tick: u64) {
        let Course { session, seen, record: RunRecord { snapshots, .. }, .. } = &mut self.course;
        let nearest = snapshots.partition_point(|snapshot| snapshot.race.tick() <= tick) - 1;
        let is_ahead = (snapshots[nearest].race.tick()..tick).contains(&session.race.tick());
        if !is_ahead {
            // The repetition starts far enough back to complete the drawn past again.
            let wanted = &snapshots[nearest].mark;
            let fills = |snapshot: &&Snapshot| seen.fills(&snapshot.mark, wanted);
            let from = snapshots[..=nearest].iter().rfind(fills);
            let journal = session.journal().clone();
            if let Some(Snapshot { race, mark, .. }) = from {
                session.race = race.clone();
                seen.rewind(mark, race);
            } else {
                let coordinates = seen.past().coordinates().collect();
                self.course.begin(coordinates);
            }
            self.course.session.follow(journal);
        }
        self.repeat_to(tick);
    }

    /// Repeats the ticks up to `tick`.
    fn repeat_to(&mut self, tick: u64) {
        while self.race().tick() < tick {
            self.tick(&mut ());
        }
    }

    /// Adds a snapshot of the present if no action has been performed at its tick, so that the next action can be taken
    /// back without repeating ticks.
    fn take_snapshot_before_actions(&mut self) {
        let race = self.race();
        let last = race.journal().rows()[..race.done()].last();
        if last.is_none_or(|row| row.tick < race.tick()) {
            self.take_snapshot();
        }
    }

    /// Adds a snapshot of the present unless there is one, and thins the snapshots to their memory limit.
    fn take_snapshot(&mut self) {
        let tick = self.race().tick();
        let index =
            self.course.record.snapshots.partition_point(|snapshot| snapshot.race.tick() < tick);
        if self
            .course
            .record
            .snapshots
            .get(index)
            .is_some_and(|snapshot| snapshot.race.tick() == tick)
        {
            return;
        }
        self.course.record.snapshots.insert(index, self.course.snapshot());
        self.thin_to_limit();
    }

    /// Thins the snapshots to the memory limit, and after that drops changes. Drawn pasts may take up to half of the
    /// limit.
    fn thin_to_limit(&mut self) {
        while self.bytes() > self.limit {
            if self.changes.past_bytes() <= self.limit / 2
                && self.spacing <= self.course.record.end.max(self.changes.end())
            {
                self.spacing *= 2;
                let stays = |snapshot: &Snapshot| snapshot.race.tick().is_multiple_of(self.spacing);
                self.course.record.snapshots.retain(stays);
                self.changes.retain(stays);
            } else if !self.changes.drop_last() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn an_undo_entry_holds_only_the_replaced_rows_of_the_journal() {
        let scene = Scene::built_in("helm").unwrap();
        let to_come = scene.script.len();
        let mut run = Run::new(Session::racing(scene.into()));
        for _ in 0..300 {
            run.act(Action::Kick(0.01));
        }
        let whole = run.session().journal().clone();
        assert_eq!(whole.rows().len(), to_come + 300);
        for _ in 0..150 {
            run.undo();
        }
        run.redo();
        let changes = run.changes.done.iter().chain(&run.changes.undone);
        let held = changes.map(|change| match &change.replaced {
            Replaced::Future(future) => future.rows.rows.len(),
            _ => panic!("a kick changes the future"),
        });
        let held: Vec<usize> = held.collect();
        assert_eq!(held.len(), 200);
        assert!(held.iter().all(|rows| *rows <= to_come + 1), "{held:?}");
        while run.redo() {}
        assert!(*run.session().journal() == whole);
    }
}
