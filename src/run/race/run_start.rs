//! Checkpoints from which verdicts and clouds restart. A verdict starts at the tick at which a person last placed or
//! kicked a body. A cloud starts at the tick at which any action last changed a body.

use std::sync::Arc;

use super::journal::{Author, JournalRow};
use super::observer::{Observer, PerformedAction};
use super::{Mode, Race};
use crate::scene::Action;
use crate::sim::TickRate;

/// The true state of a race right after an action on its bodies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RunStart {
    pub(super) tick: u64,
    /// Time (s) of the tick.
    pub(super) t: f64,
    pub(super) tick_hz: TickRate,
    pub(super) throttle: f64,
    pub(super) rudder: f64,
    /// The bodies, in scene order.
    pub(super) bodies: Vec<BodyStart>,
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
        size_of::<Self>() + self.bodies.iter().map(body).sum::<usize>()
    }
}

/// The checkpoints of a run up to its present tick.
#[derive(Clone, Debug, Default)]
pub(crate) struct Checkpoints {
    /// The state right after a person last placed or kicked a body.
    pub(super) of_verdicts: Option<Arc<RunStart>>,
    /// The state right after a person or the script last changed a body.
    pub(super) of_clouds: Option<Arc<RunStart>>,
}

impl Checkpoints {
    /// Returns the heap memory of the checkpoints in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        [&self.of_verdicts, &self.of_clouds].into_iter().flatten().map(|start| start.bytes()).sum()
    }

    /// Whether verdicts describe another run than this one, because a person has edited this one later, or because the
    /// script has changed a method, a parameter or the tick rate. Script actions on the bodies are part of the judged
    /// run.
    pub(crate) fn was_changed_since_judged(&self, race: &Race) -> bool {
        let from = self.of_verdicts.as_ref().map_or(0, |start| start.tick);
        let is_setting = |action: &Action| match action {
            Action::Method(_) => race.mode() == Mode::Solo,
            Action::Lane { .. } | Action::Substeps { .. } | Action::Tolerance { .. } => true,
            Action::TickHz(_) | Action::Set { .. } => true,
            Action::Throttle(_) | Action::Rudder(_) | Action::Kick(_) => false,
            Action::Place { .. } | Action::Push { .. } | Action::Solo { .. } => false,
        };
        let differs = |row: &JournalRow| row.author == Author::Person || is_setting(&row.action);
        race.journal().rows()[..race.done()].iter().any(|row| row.tick > from && differs(row))
    }
}

impl Observer for Checkpoints {
    fn after(&mut self, race: &Race, PerformedAction { action, author, .. }: &PerformedAction) {
        if !(0..race.values.len()).any(|body| action.acts_on(body)) {
            return;
        }
        let bodies = race.truth.bodies().iter().zip(&race.values);
        let bodies = bodies.map(|(body, values)| BodyStart {
            values: values.clone(),
            q: body.stepper.q().into(),
            v: body.stepper.v().into(),
        });
        let start = Arc::new(RunStart {
            tick: race.tick,
            t: race.t(),
            tick_hz: race.tick_hz(),
            throttle: race.throttle,
            rudder: race.rudder,
            bodies: bodies.collect(),
        });
        let is_placed =
            matches!(action, Action::Place { .. } | Action::Push { .. } | Action::Kick(_));
        if is_placed && *author == Author::Person {
            self.of_verdicts = Some(Arc::clone(&start));
        }
        self.of_clouds = Some(start);
    }
}
