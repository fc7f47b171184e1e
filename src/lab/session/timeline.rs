//! A session with its past and its future: it can go to any tick that it has reached, with identical bits.

use super::{Session, TimeScale};
use crate::lab::action::Action;
use crate::lab::journal::{Journal, Source};
use crate::lab::past::{Past, PastMark};
use crate::lab::race::{ActionResult, Observer, Race};

/// The memory that snapshots may take, in bytes.
pub const SNAPSHOT_BYTES: usize = 64 << 20;

/// The initial spacing of snapshots in ticks, which are repeated in less than a frame.
const SPACING: u64 = 32;

/// The most work of a run that is repeated to record another coordinate: evaluations of accelerations, times the
/// coordinates of a body and [`WORK_OF_AN_EVALUATION`]. It takes about a second.
const MOST_REPEATED_WORK: u64 = 10_000_000;

/// What an evaluation costs beside its coordinates, in the cost of one.
const WORK_OF_AN_EVALUATION: u64 = 4;

/// A session that can go back and forth in time.
///
/// It keeps snapshots of the session at regular ticks, and reaches any tick from the nearest snapshot before it by
/// repeating the journal's actions. When the snapshots reach their memory limit, their spacing doubles.
pub struct Timeline {
    session: Session,
    past: Past,
    /// By tick; the first is the start.
    snapshots: Vec<Snapshot>,
    spacing: u64,
    limit: usize,
    /// The last tick reached.
    end: u64,
    halts: Vec<Event>,
    undone: Option<Undone>,
}

/// A session at a tick.
struct Snapshot {
    /// Without a journal, which the timeline has.
    race: Race,
    mark: PastMark,
    bytes: usize,
}

/// A future that was discarded.
struct Undone {
    /// The tick at which another future began.
    tick: u64,
    journal: Journal,
    end: u64,
    snapshots: Vec<Snapshot>,
    halts: Vec<Event>,
}

/// Something that happened in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When.
    pub tick: u64,
    /// What.
    pub kind: EventKind,
}

/// What happened in a run.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// An action was performed.
    Done(Action, Source),
    /// A body of this lane halted; 0 is the truth.
    Halted {
        /// The lane's number, from 1; 0 is the truth.
        lane: usize,
        /// The body's place in the scene.
        body: usize,
        /// Whether a value left its range, rather than the solver failing.
        is_blow_up: bool,
    },
}

impl Timeline {
    /// The timeline of a session at its start.
    pub fn new(session: Session) -> Self {
        Self::with_limit(session, SNAPSHOT_BYTES)
    }

    /// Like [`Timeline::new`], with at most `limit` bytes for snapshots.
    pub fn with_limit(session: Session, limit: usize) -> Self {
        let past = Past::new(session.race(), session.scene().seconds);
        let mut timeline = Self {
            session,
            past,
            snapshots: Vec::new(),
            spacing: SPACING,
            limit,
            end: 0,
            halts: Vec::new(),
            undone: None,
        };
        timeline.snapshots.push(timeline.snapshot());
        timeline
    }

    /// The session at the present tick.
    pub fn session(&self) -> &Session {
        &self.session
    }
    /// The race at tick 0, before any action; without its journal.
    pub fn start(&self) -> &Race {
        self.session.start()
    }
    /// The time of every tick, by the performed and the pending changes of the tick rate.
    pub fn times(&self) -> TimeScale {
        TimeScale::new(self.start().tick_hz(), self.session.journal().rows())
    }
    /// The recorded past that is drawn.
    pub fn past(&self) -> &Past {
        &self.past
    }
    /// The last tick reached.
    pub fn end(&self) -> u64 {
        self.end
    }
    /// Whether the present tick is before the last tick reached.
    pub fn is_in_past(&self) -> bool {
        self.session.race.tick() < self.end
    }
    /// The memory that snapshots take, in bytes.
    pub fn bytes(&self) -> usize {
        let undone = self.undone.iter().flat_map(|undone| &undone.snapshots);
        self.snapshots.iter().chain(undone).map(|snapshot| snapshot.bytes).sum()
    }
    /// The memory that snapshots may take, in bytes.
    pub fn limit(&self) -> usize {
        self.limit
    }
    /// Sets the memory that snapshots may take, in bytes; it holds from the next snapshot on.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }
    /// Whether there is a discarded future to bring back.
    pub fn can_undo(&self) -> bool {
        self.undone.is_some()
    }

    /// The events up to the last tick reached, by tick.
    pub fn events(&self) -> Vec<Event> {
        let rows = self.session.journal().rows().iter();
        let done = rows.take_while(|row| row.tick <= self.end).map(|row| Event {
            tick: row.tick,
            kind: EventKind::Done(row.action.clone(), row.source),
        });
        let mut events: Vec<Event> = done.chain(self.halts.iter().cloned()).collect();
        events.sort_by_key(|event| event.tick);
        events
    }

    /// Adds the present to what is drawn, even if no sample is due.
    pub fn show_present(&mut self) {
        self.past.show_present(self.session.race());
    }

    /// Performs the journal's pending actions at the present tick.
    pub(in crate::lab) fn catch_up<O: Observer>(&mut self, observer: &mut O) {
        self.session.race.catch_up(&mut (&mut self.past, observer));
    }

    /// Makes a tick; in the past it repeats the tick that was made.
    pub fn tick(&mut self) {
        self.tick_seen(&mut ());
    }

    /// Like [`Timeline::tick`], with an observer.
    pub fn tick_seen<O: Observer>(&mut self, observer: &mut O) {
        self.session.tick_seen(&mut (&mut self.past, observer));
        let tick = self.session.race.tick();
        if tick > self.end {
            self.end = tick;
            self.note_halts();
        }
        if tick.is_multiple_of(self.spacing) {
            self.take_snapshot();
        }
    }

    fn note_halts(&mut self) {
        let race = self.session.race();
        let halts = race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
        self.halts.extend(halts.map(|(place, halt)| {
            let lane = place.map_or(0, |place| race.entrants()[place].lane_number);
            let is_blow_up = halt.is_blow_up();
            Event { tick: halt.tick, kind: EventKind::Halted { lane, body: halt.body, is_blow_up } }
        }));
    }

    /// Performs an action at the present tick, like [`Session::act`]. In the past, another future begins with it, and the
    /// old future is kept for [`Timeline::undo`].
    pub fn act(&mut self, action: Action) -> bool {
        self.act_seen(action, &mut ()) != ActionResult::Nothing
    }

    pub(in crate::lab) fn act_seen(
        &mut self,
        action: Action,
        observer: &mut impl Observer,
    ) -> ActionResult {
        let before = self.is_in_past().then(|| self.session.journal().clone());
        let acted = self.session.act_seen(action, &mut (&mut self.past, observer));
        if acted == ActionResult::Nothing {
            return acted;
        }
        let tick = self.session.race.tick();
        self.past.forget_future();
        // A snapshot holds the session as it reached a tick, before the actions there.
        let later = self.snapshots.partition_point(|snapshot| snapshot.race.tick() <= tick);
        let snapshots = self.snapshots.split_off(later);
        let later = self.halts.partition_point(|event| event.tick < tick);
        let halts = self.halts.split_off(later);
        if let Some(journal) = before {
            self.undone = Some(Undone { tick, journal, end: self.end, snapshots, halts });
            self.end = tick;
        }
        acted
    }

    /// Restores the future that was discarded last, and goes to the tick at which that happened. Returns whether there was
    /// one.
    pub fn undo(&mut self) -> bool {
        let Some(undone) = self.undone.take() else { return false };
        let Undone { tick, journal, end, snapshots, halts } = undone;
        self.snapshots.truncate(self.snapshots.partition_point(|s| s.race.tick() <= tick));
        self.snapshots.extend(snapshots);
        self.halts.truncate(self.halts.partition_point(|event| event.tick < tick));
        self.halts.extend(halts);
        self.session.race.set_journal(journal);
        self.end = end;
        self.restore(tick);
        // The recorded future is the one that has just been undone.
        self.past.forget_future();
        true
    }

    /// Goes to a tick, at most the last reached, in the state before the actions at that tick.
    pub fn seek(&mut self, tick: u64) {
        let tick = tick.min(self.end);
        if tick != self.session.race.tick() {
            self.restore(tick);
        }
    }

    /// Records of each body the coordinate with this index from now on, and from the start of the run by running it
    /// again to the present tick. Returns whether it does: a run that takes more than a second or so keeps its record.
    pub fn record_coordinates(&mut self, coordinates: &[usize]) -> bool {
        if self.past.coordinates().eq(coordinates.iter().copied()) {
            return true;
        }
        let bodies = self.session.race.entrants().iter().flat_map(|entrant| entrant.lane.bodies());
        let work = bodies.map(|body| {
            body.stepper.evaluations() * (body.coordinates.len() as u64 + WORK_OF_AN_EVALUATION)
        });
        if work.sum::<u64>() > MOST_REPEATED_WORK {
            return false;
        }
        let (tick, journal) = (self.session.race.tick(), self.session.journal().clone());
        let done = self.session.race.done();
        // The other snapshots are marks of a past that was recorded otherwise.
        self.snapshots.truncate(1);
        self.undone.iter_mut().for_each(|undone| undone.snapshots.clear());
        self.session.race = self.snapshots[0].race.clone();
        self.begin_past(coordinates.to_vec());
        self.snapshots[0].mark = self.past.mark();
        self.session.race.set_journal(journal);
        self.repeat_to(tick);
        if self.session.race.done() < done {
            self.session.race.catch_up(&mut self.past);
        }
        true
    }

    /// Forgets the recorded past, and begins another at the present.
    fn begin_past(&mut self, coordinates: Vec<usize>) {
        let (race, span_s) = (&self.session.race, self.session.scene().seconds);
        self.past = Past::of_coordinates(race, span_s, coordinates.into_iter());
    }

    /// Goes to `tick` from a snapshot.
    fn restore(&mut self, tick: u64) {
        let nearest = self.snapshots.partition_point(|s| s.race.tick() <= tick) - 1;
        let present = self.session.race.tick();
        let is_ahead = (self.snapshots[nearest].race.tick()..tick).contains(&present);
        if !is_ahead {
            // Starts so far back that the drawn past is complete again.
            let wanted = &self.snapshots[nearest].mark;
            let fills = |snapshot: &Snapshot| self.past.fills(&snapshot.mark, wanted);
            let from = self.snapshots[..=nearest].iter().rfind(|snapshot| fills(snapshot));
            let journal = self.session.journal().clone();
            match from {
                Some(Snapshot { race, mark, .. }) => {
                    self.session.race = race.clone();
                    self.past.rewind(mark, &self.session.race);
                }
                None => {
                    self.session.race = self.snapshots[0].race.clone();
                    self.begin_past(self.past.coordinates().collect());
                }
            }
            self.session.race.set_journal(journal);
        }
        self.repeat_to(tick);
    }

    /// Makes the ticks up to `tick` again.
    fn repeat_to(&mut self, tick: u64) {
        while self.session.race.tick() < tick {
            self.session.tick_seen(&mut self.past);
            if self.session.race.tick().is_multiple_of(self.spacing) {
                self.take_snapshot();
            }
        }
    }

    fn snapshot(&self) -> Snapshot {
        let mut race = self.session.race.clone();
        race.set_journal(Journal::default());
        let mark = self.past.mark();
        let bytes = race.bytes() + mark.heap_bytes() + size_of::<PastMark>();
        Snapshot { race, mark, bytes }
    }

    /// Adds a snapshot of the present if there is none, and thins the snapshots to their memory limit.
    fn take_snapshot(&mut self) {
        let tick = self.session.race.tick();
        let place = self.snapshots.partition_point(|snapshot| snapshot.race.tick() < tick);
        if self.snapshots.get(place).is_some_and(|snapshot| snapshot.race.tick() == tick) {
            return;
        }
        self.snapshots.insert(place, self.snapshot());
        while self.bytes() > self.limit && self.spacing <= self.end {
            self.spacing *= 2;
            let stays = |snapshot: &Snapshot| snapshot.race.tick().is_multiple_of(self.spacing);
            self.snapshots.retain(stays);
            if let Some(undone) = &mut self.undone {
                undone.snapshots.retain(stays);
            }
        }
    }
}
