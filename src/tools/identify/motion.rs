//! Runs a log's body under a candidate.

use super::candidates::{Candidate, SpringForm};
use super::logged::LoggedBody;
use crate::sim::integrators::{fresh, problem};
use crate::sim::{Query, State, System};

/// A body with known numbers, as a system.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub(super) spring: [f64; 2],
    pub(super) drag: f64,
    pub(super) push: f64,
    pub(super) is_held: bool,
}

impl System for Known {
    type Vector = f64;

    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        let [stiffness, damping] = self.spring;
        *a = self.push - (stiffness * x + damping * v) - self.drag * v;
    }

    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { state: State { q: x, v }, settings, force } = query else {
            return false;
        };
        let [stiffness, damping] = self.spring;
        settings.drag = self.drag;
        if self.is_held {
            *force = self.push - (stiffness * x + damping * v);
        } else {
            *force = self.push;
            (settings.stiffness, settings.damping) = (stiffness, damping);
        }
        true
    }
}

/// A run fails once the magnitude of a value exceeds this.
const LOST: f64 = 1e150;

/// Returns the states of a run at these rising ticks; `None` if the candidate cannot run on the body, or if the run
/// diverges.
pub(crate) fn run(
    candidate: Candidate,
    body: &LoggedBody,
    start: [f64; 2],
    tick_s: f64,
    ticks: impl Iterator<Item = u64>,
) -> Option<Vec<[f64; 2]>> {
    // An explicit joint reads its force again in each substep, as if each substep were a tick.
    let (is_held, parts) = match candidate.spring {
        SpringForm::Joint(mode) if mode.is_explicit => (true, candidate.substeps),
        spring => (spring == SpringForm::HeldForce, 1),
    };
    let (step_s, substeps) = (tick_s / f64::from(parts), candidate.substeps / parts);
    let known = problem(Known { spring: body.spring?, drag: body.drag, push: body.push, is_held });
    let rest = body.rest.unwrap_or(0.0);
    let mut state = State { q: start[0] - rest, v: start[1] };
    let mut stepper = fresh(candidate.method);
    let (mut now, mut states, mut first) = (0, Vec::new(), None);
    for tick in ticks {
        let steps = (tick - *first.get_or_insert(tick)) * u64::from(parts);
        while now < steps {
            let t = now as f64 * step_s;
            stepper.steps(&known, t, step_s, substeps, &mut state).ok()?;
            now += 1;
            let is_there = state.q.abs() < LOST && state.v.abs() < LOST;
            is_there.then_some(())?;
        }
        states.push([state.q + rest, state.v]);
    }
    Some(states)
}
