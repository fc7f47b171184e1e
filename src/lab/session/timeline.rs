//! A session with its past and its future: any tick that it reached can be gone to, and is to the bit what it was.

use super::{Session, TimeScale};
use crate::lab::action::Action;
use crate::lab::journal::{Journal, Source};
use crate::lab::past::{Past, PastMark};
use crate::lab::race::{Acted, Observer, Race};

/// The memory that snapshots may take, in bytes.
pub const SNAPSHOT_BYTES: usize = 64 << 20;

/// Ticks between snapshots at first: gone over in less than a frame.
const SPACING: u64 = 32;

/// A session that can be gone back and forth in.
///
/// It keeps a snapshot of the session every so many ticks, and comes to any tick from the nearest by doing again what
/// the journal has. Snapshots grow sparser as there are more, so that they never take more than a stated number of
/// bytes.
pub struct Timeline {
    session: Session,
    past: Past,
    /// By tick; the first is the start.
    snapshots: Vec<Snapshot>,
    spacing: u64,
    limit: usize,
    /// The last tick that was reached.
    end: u64,
    halts: Vec<Event>,
    undone: Option<Undone>,
}

/// A session at a tick.
struct Snapshot {
    /// Without its journal, which is the timeline's.
    race: Race,
    mark: PastMark,
    bytes: usize,
}

/// A future that was discarded.
struct Undone {
    /// The tick at which another one began.
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
    /// Something was done.
    Done(Action, Source),
    /// A body of this lane halted; 0 is the truth.
    Halted {
        /// The lane's number, from 1; 0 is the truth.
        lane: usize,
        /// The body's place in the scene.
        body: usize,
        /// Whether a value grew past all bounds, and no solver gave up.
        is_blow_up: bool,
    },
}

impl Timeline {
    /// The timeline of a session that stands at its start.
    pub fn new(session: Session) -> Self {
        Self::with_limit(session, SNAPSHOT_BYTES)
    }

    /// As [`Timeline::new`], with so many bytes for snapshots.
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
    /// The race as it stood at tick 0, before anything was done; without its journal.
    pub fn start(&self) -> &Race {
        &self.snapshots[0].race
    }
    /// The time of every tick, by what was done and what the script has to come.
    pub fn times(&self) -> TimeScale {
        TimeScale::new(self.start().tick_hz(), self.session.journal().rows())
    }
    /// What is remembered of it.
    pub fn past(&self) -> &Past {
        &self.past
    }
    /// The last tick that was reached: beyond it nothing is known.
    pub fn end(&self) -> u64 {
        self.end
    }
    /// Whether the present tick is one of the run's past.
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
    /// Whether there is a discarded future to bring back.
    pub fn can_undo(&self) -> bool {
        self.undone.is_some()
    }

    /// What happened up to the last tick that was reached, by tick.
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

    /// Shows the present, also where no sample of the past is due.
    pub fn show_present(&mut self) {
        self.past.show_present(self.session.race());
    }

    /// Does what the journal has for the present tick and was not done yet.
    pub(in crate::lab) fn catch_up<O: Observer>(&mut self, observer: &mut O) {
        self.session.race.catch_up(&mut (&mut self.past, observer));
    }

    /// Makes a tick: again, in the past.
    pub fn tick(&mut self) {
        self.tick_seen(&mut ());
    }

    /// As [`Timeline::tick`], before the eyes of an observer.
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
        let lanes = race.entrants().iter().map(|entrant| (entrant.lane_number, &entrant.lane));
        for (number, lane) in std::iter::once((0, race.truth())).chain(lanes) {
            for halt in lane.halts().filter(|halt| halt.tick + 1 == race.tick()) {
                let is_blow_up = halt.is_blow_up();
                let kind = EventKind::Halted { lane: number, body: halt.body, is_blow_up };
                self.halts.push(Event { tick: halt.tick, kind });
            }
        }
    }

    /// Does something at the present tick, as [`Session::act`] does. In the past, another future begins with it, and
    /// the one that was is kept for [`Timeline::undo`].
    pub fn act(&mut self, action: Action) -> bool {
        self.act_seen(action, &mut ()) != Acted::Nothing
    }

    pub(in crate::lab) fn act_seen(
        &mut self,
        action: Action,
        observer: &mut impl Observer,
    ) -> Acted {
        let before = self.session.journal().clone();
        let acted = self.session.act_seen(action, &mut (&mut self.past, observer));
        if acted == Acted::Nothing {
            return acted;
        }
        let tick = self.session.race.tick();
        self.past.forget_future();
        // A snapshot shows the session as it came to a tick, before anything is done there.
        let later = self.snapshots.partition_point(|snapshot| snapshot.race.tick() <= tick);
        let snapshots = self.snapshots.split_off(later);
        let later = self.halts.partition_point(|event| event.tick < tick);
        let halts = self.halts.split_off(later);
        if tick < self.end {
            self.undone = Some(Undone { tick, journal: before, end: self.end, snapshots, halts });
            self.end = tick;
        }
        acted
    }

    /// Brings the future back that was discarded last, and goes to where that was. Returns whether there was one.
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
        // It is that of the future that was begun instead.
        self.past.forget_future();
        true
    }

    /// Goes to a tick, at most the last that was reached: to the state in which the session came to it, before
    /// anything is done there.
    pub fn seek(&mut self, tick: u64) {
        let tick = tick.min(self.end);
        if tick != self.session.race.tick() {
            self.restore(tick);
        }
    }

    /// Goes to `tick` from a snapshot.
    fn restore(&mut self, tick: u64) {
        let nearest = self.snapshots.partition_point(|s| s.race.tick() <= tick) - 1;
        let present = self.session.race.tick();
        let is_ahead = (self.snapshots[nearest].race.tick()..tick).contains(&present);
        if !is_ahead {
            // From so far back that what is shown of the past is whole again.
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
                    self.past = Past::new(&self.session.race, self.session.scene().seconds);
                }
            }
            self.session.race.set_journal(journal);
        }
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

    /// Keeps the present, if it is not kept yet, and no more than may be.
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
