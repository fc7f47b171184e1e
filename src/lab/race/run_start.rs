//! States from which a run can be told anew: verdicts are of the run from where a person last placed or kicked a body, and
//! clouds start where anything last changed one.

use std::sync::Arc;

use super::Race;
use super::journal::Author;
use crate::lab::action::Action;

/// The true state of a race right after an action on its bodies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RunStart {
    pub(super) tick: u64,
    /// The time of the tick in seconds.
    pub(super) t: f64,
    pub(super) tick_hz: u32,
    pub(super) throttle: f64,
    pub(super) rudder: f64,
    /// In scene order.
    pub(super) bodies: Vec<BodyStart>,
}

/// The true state of one body.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BodyStart {
    /// Its parameters, as its kind [takes](crate::sim::bodies::Kind::build) them.
    pub(super) values: Vec<f64>,
    pub(super) q: Box<[f64]>,
    pub(super) v: Box<[f64]>,
}

impl RunStart {
    /// Its memory in bytes.
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

impl Race {
    /// The state right after a person last placed or kicked a body; `None` if nobody has.
    pub(super) fn judged_start(&self) -> Option<&Arc<RunStart>> {
        self.judged_start.as_ref()
    }

    /// Whether a person has changed the run since it is judged, so that verdicts are of another run.
    pub(in crate::lab) fn was_changed_since_judged(&self) -> bool {
        let from = self.judged_start.as_ref().map_or(0, |start| start.tick);
        let rows = &self.journal().rows()[..self.done()];
        rows.iter().any(|row| row.tick > from && row.author == Author::Person)
    }

    /// The state right after a person or the script last acted on a body; `None` if neither has.
    pub(super) fn cloud_start(&self) -> Option<&Arc<RunStart>> {
        self.cloud_start.as_ref()
    }

    /// Keeps the present state if `action` acted on a body: clouds start from it, and verdicts too if a person placed or
    /// kicked a body.
    pub(super) fn note_start(&mut self, action: &Action, author: Author) {
        if !(0..self.values.len()).any(|body| action.acts_on(body)) {
            return;
        }
        let is_placed = matches!(action, Action::Place { .. } | Action::Kick(_));
        let bodies = self.truth.bodies().iter().zip(&self.values);
        let bodies = bodies.map(|(body, values)| BodyStart {
            values: values.clone(),
            q: body.stepper.q().into(),
            v: body.stepper.v().into(),
        });
        let start = Arc::new(RunStart {
            tick: self.tick,
            t: self.t(),
            tick_hz: self.tick_hz(),
            throttle: self.throttle,
            rudder: self.rudder,
            bodies: bodies.collect(),
        });
        if is_placed && author == Author::Person {
            self.judged_start = Some(Arc::clone(&start));
        }
        self.cloud_start = Some(start);
    }
}
