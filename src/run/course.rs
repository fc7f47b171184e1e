//! A run from its start to the last tick reached: its present, its observations, its snapshots and its events.

use super::observations::ObservationsMark;
use super::race::{Done, Journal, Observer, Race};
use super::{Event, EventKind, Observations, Session};
use crate::scene::{Action, LaneId};

/// A run from its start to the last tick reached, wherever it is now. A restart replaces it, and an undo of the restart brings
/// it back.
pub(super) struct Course {
    pub(super) session: Session,
    pub(super) seen: Observations,
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

impl Course {
    pub(super) fn new(session: Session) -> Self {
        let seen = Observations::new(session.race(), session.scene().seconds);
        let mut course = Self { session, seen, noted: Noted::default() };
        course.noted.snapshots.push(course.snapshot());
        course
    }

    pub(super) fn race(&self) -> &Race {
        &self.session.race
    }

    /// Performs a person's action at the present tick.
    pub(super) fn act(&mut self, action: Action, observer: &mut dyn Observer) -> Option<Done> {
        self.session.race.act(action, &mut (&mut self.seen, observer))
    }

    /// Performs the journal's pending actions at the present tick.
    pub(super) fn catch_up(&mut self, observer: &mut dyn Observer) {
        self.session.race.catch_up(&mut (&mut self.seen, observer));
    }

    /// Makes a tick. The first time that it is made, its halts and hashes are noted.
    pub(super) fn tick(&mut self, observer: &mut dyn Observer) {
        self.session.tick(&mut (&mut self.seen, observer));
        let (race, noted) = (&self.session.race, &mut self.noted);
        if race.tick() > noted.end {
            noted.end = race.tick();
            noted.halts.extend(halts(race));
            note_hashes(&mut noted.hashes, race);
        }
    }

    /// Goes back to before the first tick, and begins other observations there, of these coordinates.
    pub(super) fn begin(&mut self, coordinates: Vec<usize>) {
        self.session.race = self.noted.snapshots[0].race.clone();
        let (race, span_s) = (&self.session.race, self.session.scene().seconds);
        self.seen = Observations::of_coordinates(race, span_s, coordinates.into_iter());
    }

    pub(super) fn snapshot(&self) -> Snapshot {
        let mut race = self.session.race.clone();
        race.set_journal(Journal::default());
        let mark = self.seen.mark();
        let bytes = race.bytes() + mark.heap_bytes() + size_of::<ObservationsMark>();
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

/// The halts in the last tick of a race that nobody has foreseen.
fn halts(race: &Race) -> impl Iterator<Item = Event> {
    let halts = race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
    halts.map(|(entrant, halt)| {
        let lane = entrant.map(|entrant| entrant.id);
        let is_blow_up = halt.is_blow_up();
        Event { tick: halt.tick, kind: EventKind::Halted { lane, body: halt.body, is_blow_up } }
    })
}

/// A session at a tick.
pub(super) struct Snapshot {
    /// Without a journal, which the run has.
    pub(super) race: Race,
    pub(super) mark: ObservationsMark,
    pub(super) bytes: usize,
}

/// The most hashes that are noted: more than a recording keeps as checks.
const MAX_NOTED: usize = 32_000;

/// The tolerance in seconds for the end of a second: times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// The hash of each lane of a run at a tick.
#[derive(Clone)]
pub(super) struct Hashes {
    pub(super) tick: u64,
    /// The second that has begun last.
    second: f64,
    pub(super) of_lanes: Vec<(LaneId, u64)>,
}

impl Hashes {
    pub(super) fn of(race: &Race) -> Self {
        let ids = race.entrants().iter().map(|entrant| entrant.id);
        let second = libm::floor(race.t() + ON_TIME_S);
        Self { tick: race.tick(), second, of_lanes: ids.zip(race.lane_hashes()).collect() }
    }
}

/// Notes the hashes of a race at a tick that it has just made first, once a second; of a long run, at fewer.
pub(super) fn note_hashes(hashes: &mut Vec<Hashes>, race: &Race) {
    let last = hashes.last().map_or(0.0, |last| last.second);
    if race.t() + ON_TIME_S < last + 1.0 {
        return;
    }
    hashes.push(Hashes::of(race));
    if hashes.len() * race.entrants().len() > MAX_NOTED {
        let mut is_odd = false;
        hashes.retain(|_| {
            is_odd = !is_odd;
            !is_odd
        });
    }
}
