//! The course of a run from its start to the last tick reached, with its session, observations, snapshots and events.
//!
//! A tick is recorded when the run first reaches it, because its repetition gives the same halts and hashes. Moving
//! back therefore loses nothing; only an action splits off the record of all later ticks. Checks count until a person
//! acts, since the recording that they are from knows no such action.

use super::observations::ObservationsMark;
use super::race::{Author, Journal, Observer, PerformedAction, Race};
use super::{Event, EventKind, Observations, Session};
use crate::scene::{Action, Check, LaneId};

/// A run from its start to the last tick reached, whichever tick is the present. A restart replaces the course, and
/// undoing the restart brings it back.
pub(super) struct Course {
    pub(super) session: Session,
    pub(super) seen: Observations,
    pub(super) record: RunRecord,
    /// Checks of the scene by tick. There are none if the run does not start as the scene does.
    checks: Vec<Check>,
}

/// A check of the scene that the run has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checked {
    /// Tick of the check.
    pub tick: u64,
    /// The checked lane.
    pub lane: LaneId,
    /// Whether the lane had the recorded state.
    pub is_same: bool,
}

impl Checked {
    /// Returns words for a run that fails this check first.
    pub fn fault(self) -> String {
        format!("not the same run: tick {}, lane {}", self.tick, self.lane)
    }
}

/// The record of a run's progress, which can be rebuilt by replaying the run.
#[derive(Default)]
pub(super) struct RunRecord {
    /// Last tick reached.
    pub(super) end: u64,
    /// Snapshots in order of ticks. In a whole run, the first one is the start.
    pub(super) snapshots: Vec<Snapshot>,
    pub(super) halts: Vec<Event>,
    /// Hashes in the order in which the run first reached their ticks.
    pub(super) hashes: Vec<Hashes>,
    /// Checks in the order in which the run first reached their ticks, while no person had acted on it.
    pub(super) checked: Vec<Checked>,
}

impl Course {
    /// Creates a course at its start. `has_checks` states that the session starts as its scene does.
    pub(super) fn new(session: Session, has_checks: bool) -> Self {
        let seen = Observations::new(session.race(), session.scene().seconds);
        let (scene, race) = (session.scene(), session.race());
        let starts_alike = |check: &&Check| {
            let spec = scene.lanes.get(check.lane.index());
            has_checks && race.entrant(check.lane).is_some_and(|it| Some(&it.spec) == spec)
        };
        let mut checks: Vec<Check> = scene.checks.iter().filter(starts_alike).copied().collect();
        checks.sort_by_key(|check| check.tick);
        let mut course = Self { session, seen, record: RunRecord::default(), checks };
        course.record.snapshots.push(course.snapshot());
        course
    }

    pub(super) fn race(&self) -> &Race {
        &self.session.race
    }

    /// Performs a person's action at the present tick.
    pub(super) fn act(
        &mut self,
        action: Action,
        observer: &mut dyn Observer,
    ) -> Option<PerformedAction> {
        self.session.race.act(action, &mut (&mut self.seen, observer))
    }

    /// Performs the journal's pending actions at the present tick.
    pub(super) fn catch_up(&mut self, observer: &mut dyn Observer) {
        self.session.race.catch_up(&mut (&mut self.seen, observer));
    }

    /// Makes a tick. When the run reaches that tick for the first time, its halts and hashes are recorded.
    pub(super) fn tick(&mut self, observer: &mut dyn Observer) {
        self.session.tick(&mut (&mut self.seen, observer));
        let (race, record) = (&self.session.race, &mut self.record);
        if race.tick() > record.end {
            record.end = race.tick();
            record.halts.extend(halts(race));
            note_hashes(&mut record.hashes, race);
            note_checks(&self.checks, &mut record.checked, race);
        }
    }

    /// Returns to the start, and begins new observations there, of these coordinates.
    pub(super) fn begin(&mut self, coordinates: Vec<usize>) {
        self.session.race = self.record.snapshots[0].race.clone();
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

impl RunRecord {
    /// Splits off every record that depends on the actions at `tick`.
    pub(super) fn split_off(&mut self, tick: u64) -> Self {
        let Self { end, snapshots, halts, hashes, checked } = self;
        // Snapshots and hashes show a tick as the session reached it, before the actions at that tick; so those at
        // `tick` stay.
        let later = snapshots.partition_point(|snapshot| snapshot.race.tick() <= tick);
        let snapshots = snapshots.split_off(later);
        let later = halts.partition_point(|event| event.tick < tick);
        let halts = halts.split_off(later);
        let later = hashes.partition_point(|it| it.tick <= tick);
        let hashes = hashes.split_off(later);
        let later = checked.partition_point(|check| check.tick <= tick);
        let checked = checked.split_off(later);
        Self { end: std::mem::replace(end, tick), snapshots, halts, hashes, checked }
    }

    /// Appends a record that [`Self::split_off`] returned.
    pub(super) fn extend(&mut self, other: Self) {
        let Self { end, snapshots, halts, hashes, checked } = other;
        self.end = end;
        self.snapshots.extend(snapshots);
        self.halts.extend(halts);
        self.hashes.extend(hashes);
        self.checked.extend(checked);
    }
}

/// Returns the halts in the last tick, except those of a reference that was declined beforehand.
fn halts(race: &Race) -> impl Iterator<Item = Event> {
    let halts = race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
    halts.map(|(entrant, halt)| {
        let lane = entrant.map(|entrant| entrant.id);
        let is_blow_up = halt.is_blow_up();
        Event { tick: halt.tick, kind: EventKind::Halted { lane, body: halt.body, is_blow_up } }
    })
}

/// A session at one tick.
pub(super) struct Snapshot {
    /// The race without a journal, which the run holds.
    pub(super) race: Race,
    pub(super) mark: ObservationsMark,
    pub(super) bytes: usize,
}

/// Maximum number of hashes, which is more than a recording needs as checks.
const MAX_NOTED: usize = 32_000;

/// Tolerance for the end of a second, in seconds, because times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// The hash of each lane at a tick.
#[derive(Clone)]
pub(super) struct Hashes {
    pub(super) tick: u64,
    /// Number of full seconds up to this tick.
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

/// Records the hashes of a tick just reached, once per second. In a long run, every other one is dropped.
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

/// Compares a tick just reached with its checks, unless a person has acted on the run. `checks` are sorted by tick.
fn note_checks(checks: &[Check], checked: &mut Vec<Checked>, race: &Race) {
    let from = checks.partition_point(|check| check.tick < race.tick());
    let due = checks[from..].iter().take_while(|check| check.tick == race.tick());
    let mut rows = race.journal().rows()[..race.done()].iter();
    if due.clone().next().is_none() || rows.any(|row| row.author == Author::Person) {
        return;
    }
    checked.extend(due.filter_map(|&Check { tick, lane, hash }| {
        Some(Checked { tick, lane, is_same: race.lane_hash(lane)? == hash })
    }));
}
