//! The state at which a person last placed or kicked a body: verdicts are of the run from there.

use std::sync::Arc;

use super::Race;
use crate::lab::action::Action;

/// The true state of a race right after a person placed or kicked a body.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::lab) struct JudgedStart {
    pub(in crate::lab) tick: u64,
    /// The time of the tick in seconds.
    pub(in crate::lab) t: f64,
    pub(in crate::lab) tick_hz: u32,
    pub(in crate::lab) throttle: f64,
    pub(in crate::lab) rudder: f64,
    /// In scene order.
    pub(in crate::lab) bodies: Vec<JudgedBody>,
}

/// The true state of one body.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::lab) struct JudgedBody {
    /// Its parameters, as its kind [takes](crate::sim::bodies::Kind::build) them.
    pub(in crate::lab) values: Vec<f64>,
    pub(in crate::lab) q: Box<[f64]>,
    pub(in crate::lab) v: Box<[f64]>,
}

impl JudgedStart {
    /// Its memory in bytes.
    pub(super) fn bytes(&self) -> usize {
        let body = |body: &JudgedBody| {
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
    pub(in crate::lab) fn judged_start(&self) -> Option<&Arc<JudgedStart>> {
        self.judged_start.as_ref()
    }

    /// Keeps the present state if `action`, which a person has done, placed or kicked a body.
    pub(super) fn note_judged_start(&mut self, action: &Action) {
        if !matches!(action, Action::Place { .. } | Action::Kick(_)) {
            return;
        }
        let bodies = self.truth.bodies().iter().zip(&self.values);
        let bodies = bodies.map(|(body, values)| JudgedBody {
            values: values.clone(),
            q: body.stepper.q().into(),
            v: body.stepper.v().into(),
        });
        self.judged_start = Some(Arc::new(JudgedStart {
            tick: self.tick,
            t: self.t(),
            tick_hz: self.tick_hz(),
            throttle: self.throttle,
            rudder: self.rudder,
            bodies: bodies.collect(),
        }));
    }
}
