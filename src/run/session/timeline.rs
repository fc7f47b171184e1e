//! A session with its past and its future: it can go to any tick that it has reached, with identical bits, and takes back
//! what a person did.

use std::mem::{replace, swap};

use super::hashes::{Hashes, note_hashes};
use super::run_with_past::{Noted, RunWithPast, Snapshot};
use super::start::StartSettings;
use super::undo::{Change, Future, Other, UndoStack};
use super::{Event, EventKind, Session};
use crate::run::past::Past;
use crate::run::race::{ActionResult, Mode, Observer, Race, TimeScale};
use crate::scene::Action;

/// The memory that snapshots and the drawn pasts of kept runs may take unless it is set, in bytes.
pub const SNAPSHOT_BYTES: usize = 64 << 20;

/// The initial spacing of snapshots in ticks, which are repeated in less than a frame.
const SPACING: u64 = 32;

/// The most work of a run that is repeated to record another coordinate: evaluations of accelerations, times the
/// coordinates of a body and [`WORK_OF_AN_EVALUATION`]. It takes about a second.
const MAX_REPEATED_WORK: u64 = 10_000_000;

/// What an evaluation costs beside its coordinates, in the cost of one.
const WORK_OF_AN_EVALUATION: u64 = 4;

/// A session that can go back and forth in time.
///
/// It keeps snapshots of the session at regular ticks, and reaches any tick from the nearest snapshot before it by
/// repeating the journal's actions. When the snapshots reach their memory limit, their spacing doubles. What a person does
/// can be undone, and done again.
pub struct Timeline {
    run: RunWithPast,
    /// With what the next run starts.
    next: StartSettings,
    spacing: u64,
    limit: usize,
    changes: UndoStack,
}

impl Timeline {
    /// The timeline of a session at its start.
    pub fn new(session: Session) -> Self {
        Self::with_limit(session, SNAPSHOT_BYTES)
    }

    /// Like [`Timeline::new`], with at most `limit` bytes for snapshots and kept runs.
    pub fn with_limit(session: Session, limit: usize) -> Self {
        Self { limit, ..Self::of(StartSettings::of_session(&session), session) }
    }

    /// The timeline of a run that starts with these settings.
    pub(crate) fn starting_with(next: StartSettings) -> Self {
        let session = next.session();
        Self::of(next, session)
    }

    fn of(next: StartSettings, session: Session) -> Self {
        let (run, changes) = (RunWithPast::new(session), UndoStack::default());
        Self { run, next, spacing: SPACING, limit: SNAPSHOT_BYTES, changes }
    }

    /// The session at the present tick.
    pub fn session(&self) -> &Session {
        &self.run.session
    }
    /// With what the next run starts: how this one did, and what a person has set since.
    pub(crate) fn next(&self) -> &StartSettings {
        &self.next
    }
    /// The settings of the next start, to be set in a way that is not undone.
    pub(crate) fn next_mut(&mut self) -> &mut StartSettings {
        &mut self.next
    }
    /// The race at tick 0, before any action; without its journal.
    pub fn start(&self) -> &Race {
        self.run.session.start()
    }
    /// The time of every tick, by the performed and the pending changes of the tick rate.
    pub fn times(&self) -> TimeScale {
        let rows = self.run.session.journal().rows().iter();
        let changes = rows.filter_map(|row| Some((row.tick, row.action.tick_hz()?)));
        TimeScale::new((0, 0.0), self.start().tick_hz(), changes)
    }
    /// The recorded past that is drawn.
    pub fn past(&self) -> &Past {
        &self.run.past
    }
    /// The last tick reached.
    pub fn end(&self) -> u64 {
        self.run.noted.end
    }
    /// Whether the present tick is before the last tick reached.
    pub fn is_in_past(&self) -> bool {
        self.run.session.race.tick() < self.run.noted.end
    }
    /// The memory that snapshots take, and the drawn pasts of the runs before a restart, in bytes.
    pub fn bytes(&self) -> usize {
        let all = self.run.noted.snapshots.iter().chain(self.changes.snapshots());
        all.map(|snapshot| snapshot.bytes).sum::<usize>() + self.changes.past_bytes()
    }
    /// The memory that [`Timeline::bytes`] may be.
    pub fn limit(&self) -> usize {
        self.limit
    }
    /// Sets the memory that [`Timeline::bytes`] may be; it holds from the next snapshot on.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }
    /// What [`Timeline::undo`] would take back, for people; `None` if there is nothing.
    pub fn undoes(&self) -> Option<&str> {
        self.changes.done.last().map(|change| &change.what[..])
    }
    /// What [`Timeline::redo`] would do again, for people; `None` if there is nothing.
    pub fn redoes(&self) -> Option<&str> {
        self.changes.undone.last().map(|change| &change.what[..])
    }

    /// The events up to the last tick reached, by tick.
    pub fn events(&self) -> Vec<Event> {
        let rows = self.run.session.journal().rows().iter();
        let is_solo = self.start().mode() == Mode::Solo;
        let mut solo = is_solo.then(|| self.start().entrants()[0].id);
        let done = rows.take_while(|row| row.tick <= self.run.noted.end).map(|row| {
            if let Action::Solo { lane } = row.action {
                solo = Some(lane);
            }
            let (action, author) = (row.action.clone(), row.author);
            Event { tick: row.tick, kind: EventKind::Done { action, author, solo } }
        });
        let mut events: Vec<Event> = done.chain(self.run.noted.halts.iter().cloned()).collect();
        events.sort_by_key(|event| event.tick);
        events
    }

    /// Adds the present to what is drawn, even if no sample is due.
    pub fn show_present(&mut self) {
        self.run.past.show_present(self.run.session.race());
    }

    /// Performs the journal's pending actions at the present tick.
    pub(crate) fn catch_up<O: Observer>(&mut self, observer: &mut O) {
        self.run.session.race.catch_up(&mut (&mut self.run.past, observer));
    }

    /// Makes a tick; in the past it repeats the tick that was made.
    pub fn tick(&mut self) {
        self.tick_seen(&mut ());
    }

    /// Like [`Timeline::tick`], with an observer.
    pub fn tick_seen<O: Observer>(&mut self, observer: &mut O) {
        self.run.session.tick_seen(&mut (&mut self.run.past, observer));
        let tick = self.run.session.race.tick();
        if tick > self.run.noted.end {
            self.run.noted.end = tick;
            self.note_halts();
            note_hashes(&mut self.run.noted.hashes, self.run.session.race());
        }
        if tick.is_multiple_of(self.spacing) {
            self.take_snapshot();
        }
    }

    fn note_halts(&mut self) {
        let race = self.run.session.race();
        let halts = race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
        self.run.noted.halts.extend(halts.map(|(entrant, halt)| {
            let lane = entrant.map(|entrant| entrant.id);
            let is_blow_up = halt.is_blow_up();
            Event { tick: halt.tick, kind: EventKind::Halted { lane, body: halt.body, is_blow_up } }
        }));
    }

    /// Performs an action at the present tick, like [`Session::act`], as a change that [`Timeline::undo`] takes back. In the
    /// past, another future begins with it.
    pub fn act(&mut self, action: Action) -> bool {
        self.close_change();
        self.act_seen(action, &mut ()) != ActionResult::Nothing
    }

    /// Performs an action, as a part of the present change unless that is closed. A choice of a person is kept for the next
    /// start.
    pub(crate) fn act_seen(
        &mut self,
        action: Action,
        observer: &mut impl Observer,
    ) -> ActionResult {
        let was_past = self.is_in_past();
        let journal = self.run.session.journal().clone();
        let tick = self.run.session.race.tick();
        let acted = self.run.session.act_seen(action.clone(), &mut (&mut self.run.past, observer));
        if acted == ActionResult::Nothing {
            return acted;
        }
        self.run.past.forget_future();
        let added = self.run.session.race.done() - 1;
        let rows = journal.tail_beside(self.run.session.journal(), added);
        let noted = self.run.noted.split_off(tick);
        // A change that was made in the past has a future of its own to bring back.
        if was_past || !self.changes.has_future() {
            let what = format!("{} at tick {tick}", action.noun());
            let other = Other::Future(Future { tick, rows, noted });
            self.changes.push(Change { what, next: self.next.clone(), other });
        }
        self.next.keep(&action, &self.run.session.race, self.run.past.menu());
        acted
    }

    /// Changes a setting of the next start, as a part of the present change unless that is closed. `set` returns whether it
    /// changed anything, as this does.
    pub(crate) fn set_next(
        &mut self,
        what: &str,
        set: impl FnOnce(&mut StartSettings) -> bool,
    ) -> bool {
        let before = self.next.clone();
        let is_changed = set(&mut self.next);
        if is_changed && !self.changes.is_open() {
            let change = Change { what: what.to_owned(), next: before, other: Other::Nothing };
            self.changes.push(change);
        }
        is_changed
    }

    /// Begins a run with the settings of the next start, after `set` has set them. The present run is kept for
    /// [`Timeline::undo`] of the change `kept`, and lost if there is none.
    pub(crate) fn restart(&mut self, kept: Option<&str>, set: impl FnOnce(&mut StartSettings)) {
        let before = self.next.clone();
        set(&mut self.next);
        let run = replace(&mut self.run, RunWithPast::new(self.next.session()));
        self.changes.undone.clear();
        if let Some(what) = kept {
            let other = Other::Run(Box::new(run));
            self.changes.push(Change { what: what.to_owned(), next: before, other });
            self.fit();
        }
        self.spacing = SPACING;
    }

    /// Ends the present change: what a person does next is undone by itself.
    pub(crate) fn close_change(&mut self) {
        self.changes.close();
    }

    /// Makes all that was done part of the start: nothing of it can be undone.
    pub(crate) fn forget_changes(&mut self) {
        self.changes = UndoStack::default();
    }

    /// Takes back the newest change, and goes to the tick at which it was made; the run before a restart comes back where
    /// it was. Returns whether there was a change.
    pub fn undo(&mut self) -> bool {
        let Some(mut change) = self.changes.done.pop() else { return false };
        self.exchange(&mut change);
        self.changes.undone.push(change);
        true
    }

    /// Makes the change again that was undone last, and goes to its tick. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        let Some(mut change) = self.changes.undone.pop() else { return false };
        self.exchange(&mut change);
        self.changes.done.push(change);
        true
    }

    /// Goes to the other side of a change, which becomes the way back.
    fn exchange(&mut self, change: &mut Change) {
        self.changes.close();
        swap(&mut self.next, &mut change.next);
        match &mut change.other {
            Other::Nothing => {}
            Other::Run(run) => swap(&mut self.run, run),
            Other::Future(Future { tick, rows, noted }) => {
                let left = self.run.noted.split_off(*tick);
                self.run.noted.extend(replace(noted, left));
                let mut journal = self.run.session.journal().clone();
                journal.swap_tail(rows);
                self.run.session.race.set_journal(journal);
                self.restore(*tick);
                // The recorded future is the one that has just been left.
                self.run.past.forget_future();
                self.catch_up(&mut ());
            }
        }
    }

    /// Goes to a tick, at most the last reached, in the state before the actions at that tick.
    pub fn seek(&mut self, tick: u64) {
        let tick = tick.min(self.run.noted.end);
        if tick != self.run.session.race.tick() {
            self.restore(tick);
        }
    }

    /// Records of each body the coordinate with this index from now on, and from the start of the run by running it
    /// again to the present tick. Returns whether it does: a run that takes more than a second or so keeps its record.
    pub fn record_coordinates(&mut self, coordinates: &[usize]) -> bool {
        if self.run.past.coordinates().eq(coordinates.iter().copied()) {
            return true;
        }
        let bodies =
            self.run.session.race.entrants().iter().flat_map(|entrant| entrant.lane.bodies());
        let work = bodies.map(|body| {
            body.stepper.evaluations() * (body.coordinates().len() as u64 + WORK_OF_AN_EVALUATION)
        });
        if work.sum::<u64>() > MAX_REPEATED_WORK {
            return false;
        }
        let (tick, journal) = (self.run.session.race.tick(), self.run.session.journal().clone());
        let done = self.run.session.race.done();
        // The other snapshots are marks of a past that was recorded otherwise.
        self.run.noted.snapshots.truncate(1);
        self.changes.clear_futures();
        self.run.session.race = self.run.noted.snapshots[0].race.clone();
        self.begin_past(coordinates.to_vec());
        self.run.noted.snapshots[0].mark = self.run.past.mark();
        self.run.session.race.set_journal(journal);
        self.repeat_to(tick);
        if self.run.session.race.done() < done {
            self.run.session.race.catch_up(&mut self.run.past);
        }
        true
    }

    /// Forgets the recorded past, and begins another at the present.
    fn begin_past(&mut self, coordinates: Vec<usize>) {
        let (race, span_s) = (&self.run.session.race, self.run.session.scene().seconds);
        self.run.past = Past::of_coordinates(race, span_s, coordinates.into_iter());
    }

    /// The hashes that were noted as ticks were first made, by tick.
    pub(super) fn hashes(&self) -> &[Hashes] {
        &self.run.noted.hashes
    }

    /// The race at the last tick reached, before the actions at it.
    pub(super) fn race_at_end(&self) -> Race {
        let RunWithPast { session, noted: Noted { snapshots, end, .. }, .. } = &self.run;
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

    /// Goes to `tick` from a snapshot.
    fn restore(&mut self, tick: u64) {
        let nearest = self.run.noted.snapshots.partition_point(|s| s.race.tick() <= tick) - 1;
        let present = self.run.session.race.tick();
        let is_ahead = (self.run.noted.snapshots[nearest].race.tick()..tick).contains(&present);
        if !is_ahead {
            // Starts so far back that the drawn past is complete again.
            let wanted = &self.run.noted.snapshots[nearest].mark;
            let fills = |snapshot: &Snapshot| self.run.past.fills(&snapshot.mark, wanted);
            let from =
                self.run.noted.snapshots[..=nearest].iter().rfind(|snapshot| fills(snapshot));
            let journal = self.run.session.journal().clone();
            match from {
                Some(Snapshot { race, mark, .. }) => {
                    self.run.session.race = race.clone();
                    self.run.past.rewind(mark, &self.run.session.race);
                }
                None => {
                    self.run.session.race = self.run.noted.snapshots[0].race.clone();
                    self.begin_past(self.run.past.coordinates().collect());
                }
            }
            self.run.session.race.set_journal(journal);
        }
        self.repeat_to(tick);
    }

    /// Makes the ticks up to `tick` again.
    fn repeat_to(&mut self, tick: u64) {
        while self.run.session.race.tick() < tick {
            self.run.session.tick_seen(&mut self.run.past);
            if self.run.session.race.tick().is_multiple_of(self.spacing) {
                self.take_snapshot();
            }
        }
    }

    /// Adds a snapshot of the present if there is none, and thins the snapshots to their memory limit.
    fn take_snapshot(&mut self) {
        let tick = self.run.session.race.tick();
        let index =
            self.run.noted.snapshots.partition_point(|snapshot| snapshot.race.tick() < tick);
        if self.run.noted.snapshots.get(index).is_some_and(|snapshot| snapshot.race.tick() == tick)
        {
            return;
        }
        self.run.noted.snapshots.insert(index, self.run.snapshot());
        self.fit();
    }

    /// Thins the snapshots to the memory limit, of which drawn pasts have at most half, and then forgets changes.
    fn fit(&mut self) {
        while self.bytes() > self.limit {
            if self.changes.past_bytes() <= self.limit / 2
                && self.spacing <= self.run.noted.end.max(self.changes.end())
            {
                self.spacing *= 2;
                let stays = |snapshot: &Snapshot| snapshot.race.tick().is_multiple_of(self.spacing);
                self.run.noted.snapshots.retain(stays);
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
    fn a_change_holds_what_it_has_changed_and_not_the_whole_journal() {
        let scene = Scene::built_in("helm").unwrap();
        let to_come = scene.script.len();
        let mut timeline = Timeline::new(Session::racing(scene.into()));
        for _ in 0..300 {
            timeline.act(Action::Kick(0.01));
        }
        let whole = timeline.session().journal().clone();
        assert_eq!(whole.rows().len(), to_come + 300);
        for _ in 0..150 {
            timeline.undo();
        }
        timeline.redo();
        let changes = timeline.changes.done.iter().chain(&timeline.changes.undone);
        let held = changes.map(|change| match &change.other {
            Other::Future(future) => future.rows.rows.len(),
            _ => panic!("a kick changes the future"),
        });
        let held: Vec<usize> = held.collect();
        assert_eq!(held.len(), 200);
        assert!(held.iter().all(|rows| *rows <= to_come + 1), "{held:?}");
        while timeline.redo() {}
        assert!(*timeline.session().journal() == whole);
    }
}
