//! Checkpoints from which verdicts, advice and clouds restart. A verdict starts at the tick at which the run was last
//! changed, so that it is of what follows. Advice starts at the tick at which a person last placed or kicked a body. A
//! cloud starts at the tick at which any action last changed a body.

use std::sync::Arc;

use super::journal::Author;
use super::observer::{Observer, PerformedAction};
use super::{Entrant, Race};
use crate::scene::{Action, LaneId};
use crate::sim::TickRate;

/// The true state of a race right after an action, and the states of its lanes.
#[derive(Clone, Debug)]
pub(super) struct RunStart {
    pub(super) tick: u64,
    /// Time (s) of the tick.
    pub(super) t: f64,
    pub(super) tick_hz: TickRate,
    pub(super) throttle: f64,
    pub(super) rudder: f64,
    /// The bodies, in scene order.
    pub(super) bodies: Vec<BodyStart>,
    /// The lanes that are not in the true state.
    pub(super) lanes: Vec<LaneStart>,
}

/// A drag of the tick rate changes nothing else, so that starts at other rates are equal.
impl PartialEq for RunStart {
    fn eq(&self, other: &Self) -> bool {
        let inputs = |start: &Self| (start.tick, start.t, start.throttle, start.rudder);
        inputs(self) == inputs(other) && self.bodies == other.bodies && self.lanes == other.lanes
    }
}

/// The state of a lane beside the truth.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LaneStart {
    pub(super) id: LaneId,
    /// Coordinates and velocities of each body; `None` for a body that has halted or is in its true state.
    pub(super) bodies: Vec<Option<[Box<[f64]>; 2]>>,
}

impl LaneStart {
    /// Returns the state of a lane; `None` if it is that of the truth.
    fn of(entrant: &Entrant, truth: &[BodyStart]) -> Option<Self> {
        let bodies = entrant.lane.bodies().iter().zip(truth).map(|(body, truth)| {
            let (q, v) = (body.stepper.q(), body.stepper.v());
            let differs = q != &truth.q[..] || v != &truth.v[..];
            (differs && body.halted().is_none()).then(|| [q.into(), v.into()])
        });
        let bodies: Vec<_> = bodies.collect();
        bodies.iter().any(Option::is_some).then_some(Self { id: entrant.id, bodies })
    }
}

/// The true state of one body.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BodyStart {
    /// Parameters, in the order that the body's kind [expects](crate::sim::bodies::Kind::build).
    pub(super) values: Vec<f64>,
    pub(super) q: Box<[f64]>,
    pub(super) v: Box<[f64]>,
}

impl RunStart {
    /// Returns the memory of this state in bytes.
    pub(super) fn bytes(&self) -> usize {
        let body = |body: &BodyStart| {
            size_of_val(body)
                + size_of_val(&body.values[..])
                + size_of_val(&body.q[..])
                + size_of_val(&body.v[..])
        };
        let lane = |lane: &LaneStart| {
            let states =
                lane.bodies.iter().flatten().flatten().map(|values| size_of_val(&values[..]));
            size_of_val(lane) + size_of_val(&lane.bodies[..]) + states.sum::<usize>()
        };
        size_of::<Self>()
            + self.bodies.iter().map(body).sum::<usize>()
            + self.lanes.iter().map(lane).sum::<usize>()
    }
}

/// The checkpoints of a run up to its present tick.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    /// The state right after a person last changed the run, or the script a method, a parameter, the tick rate or the
    /// state of a body. The script's throttle and rudder are part of the judged run.
    pub(super) of_verdicts: Option<Arc<RunStart>>,
    /// The state right after a person last placed or kicked a body.
    pub(super) of_advice: Option<Arc<RunStart>>,
    /// The state right after a person or the script last changed a body.
    pub(super) of_clouds: Option<Arc<RunStart>>,
}

impl Checkpoints {
    /// Returns the heap memory of the checkpoints in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let starts = [&self.of_verdicts, &self.of_advice, &self.of_clouds];
        starts.into_iter().flatten().map(|start| start.bytes()).sum()
    }

    /// Returns the time (s) of the run at which verdicts start.
    pub fn verdicts_start_at_s(&self) -> f64 {
        self.of_verdicts.as_ref().map_or(0.0, |start| start.t)
    }
}

impl Observer for Checkpoints {
    fn after(&mut self, race: &Race, done: &PerformedAction) {
        let PerformedAction { action, author, switch, .. } = done;
        let is_of_person = *author == Author::Person;
        let acts_on_bodies = (0..race.values.len()).any(|body| action.acts_on(body));
        let is_moved =
            matches!(action, Action::Place { .. } | Action::Push { .. } | Action::Kick(_));
        let is_set = matches!(action, Action::TickHz(_) | Action::Set { .. });
        // A setting before the first tick is one of the whole run.
        let is_changed = race.tick > 0
            && (switch.is_some() || is_set || acts_on_bodies && (is_of_person || is_moved));
        let is_moved = is_moved && is_of_person;
        if !(acts_on_bodies || is_changed) {
            return;
        }
        let bodies = race.truth.bodies().iter().zip(&race.values);
        let bodies = bodies.map(|(body, values)| BodyStart {
            values: values.clone(),
            q: body.stepper.q().into(),
            v: body.stepper.v().into(),
        });
        let bodies: Vec<_> = bodies.collect();
        let lanes = race.entrants.iter().filter_map(|entrant| LaneStart::of(entrant, &bodies));
        let start = Arc::new(RunStart {
            tick: race.tick,
            t: race.t(),
            tick_hz: race.tick_hz(),
            throttle: race.throttle,
            rudder: race.rudder,
            lanes: lanes.collect(),
            bodies,
        });
        if is_changed || is_moved {
            self.of_verdicts = Some(Arc::clone(&start));
        }
        if is_moved {
            self.of_advice = Some(Arc::clone(&start));
        }
        if acts_on_bodies {
            self.of_clouds = Some(start);
        }
    }
}
