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

/// Start of a run from which a motion is read, in metres and in metres per second.
pub(crate) const SLOW: f64 = 1e-6;
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
    let mut now = 0;
    let at_start = [state.q, state.v];
    let states = states_at(ticks, u64::from(parts), at_start, |_| {
        let t = now as f64 * step_s;
        now += 1;
        stepper.steps(&known, t, step_s, substeps, &mut state).ok()?;
        Some([state.q, state.v])
    })?;
    Some(states.into_iter().map(|[x, v]| [x + rest, v]).collect())
}

/// Returns the states at these rising ticks, of which each takes this many calls of `step`; `None` if the motion
/// diverges.
fn states_at(
    ticks: impl Iterator<Item = u64>,
    parts: u64,
    start: [f64; 2],
    mut step: impl FnMut([f64; 2]) -> Option<[f64; 2]>,
) -> Option<Vec<[f64; 2]>> {
    let (mut state, mut now, mut first) = (start, 0, None);
    let mut states = Vec::with_capacity(ticks.size_hint().0);
    for tick in ticks {
        let end = (tick - *first.get_or_insert(tick)) * parts;
        while now < end {
            state = step(state).filter(|state| state.iter().all(|part| part.abs() < LOST))?;
            now += 1;
        }
        states.push(state);
    }
    Some(states)
}

/// Returns the states of a linear motion at these rising ticks, from the map of its first tick; `None` if the candidate
/// cannot run on the body, or if the run diverges. A candidate with a memory or a limit moves differently.
pub(super) fn run_by_map(
    candidate: Candidate,
    body: &LoggedBody,
    start: [f64; 2],
    tick_s: f64,
    ticks: impl Iterator<Item = u64>,
) -> Option<Vec<[f64; 2]>> {
    let rest = body.rest.unwrap_or(0.0);
    let pushed = LoggedBody { rest: None, ..body.clone() };
    let still = *run(candidate, &pushed, [0.0; 2], tick_s, 0..2)?.last()?;
    let map = map_of_tick(candidate, body, tick_s)?;
    let at_start = [start[0] - rest, start[1]];
    let states = states_at(ticks, 1, at_start, |[x, v]| {
        Some([0, 1].map(|i| still[i] + map[i][0] * x + map[i][1] * v))
    })?;
    Some(states.into_iter().map(|[x, v]| [x + rest, v]).collect())
}

/// Returns the map of the first tick of a motion about its rest, without a push: the rows are of x and v. `None` if the
/// candidate cannot run on the body.
pub(super) fn map_of_tick(
    candidate: Candidate,
    body: &LoggedBody,
    tick_s: f64,
) -> Option<[[f64; 2]; 2]> {
    let free = LoggedBody { push: 0.0, rest: None, ..body.clone() };
    let after = |start| Some(*run(candidate, &free, start, tick_s, 0..2)?.last()?);
    let [x, v] = [after([SLOW, 0.0])?, after([0.0, SLOW])?];
    Some([0, 1].map(|i| [x[i] / SLOW, v[i] / SLOW]))
}

#[cfg(test)]
mod tests {
    use super::super::candidates::candidates;
    use super::*;

    #[test]
    fn the_map_of_a_tick_stands_for_the_steps_of_nearly_all_candidates() {
        let body = LoggedBody {
            spring: Some([40.0, 0.5]),
            push: -9.81,
            rest: Some(3.0),
            ..LoggedBody::default()
        };
        let all = candidates(&body);
        let is_mapped = |candidate: &&Candidate| {
            let go = |run: fn(_, &_, _, _, std::ops::Range<u64>) -> _| {
                run(**candidate, &body, [4.0, 0.1], 1.0 / 60.0, 0..300)
            };
            let apart =
                |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            let [Some(steps), Some(mapped)] = [go(run), go(run_by_map)] else { return false };
            let farthest = steps.iter().zip(&mapped).map(apart).fold(0.0, f64::max);
            farthest.is_finite() && farthest < 1e-9
        };
        let mapped = all.iter().filter(is_mapped).count();
        // The others have a memory.
        assert!(mapped * 10 > all.len() * 8 && mapped < all.len(), "{mapped} of {}", all.len());
    }
}
