//! The truth of a body with a closed form.

use super::body::Body;
use super::integrators::Stepped;
use super::propagator::Propagator;
use super::state::{State, Vector, largest, nan_is_infinite};
use super::stepper::Change;
use super::system::{Counted, StateOf};

/// The exact flow. Each state is computed in one stride from the anchor, so that no error accumulates.
#[derive(Clone)]
pub(super) struct ExactFlow<V> {
    anchor: Anchor<V>,
    /// The time of the current state, in seconds.
    t: f64,
    scratch: State<V>,
}

/// The initial condition of the flow.
#[derive(Clone)]
struct Anchor<V> {
    state: State<V>,
    t: f64,
    /// The state displaced by its error. The same flow carries the displaced state, which shows how the error grows.
    displaced: State<V>,
    /// The displacement, in coordinates and in velocities.
    error: [f64; 2],
}

impl<V: Vector> ExactFlow<V> {
    /// Returns the flow from `state` at time `t` (s).
    pub(super) fn new(state: &State<V>, t: f64) -> Self {
        let [displaced, scratch] = [state.clone(), state.clone()];
        let anchor = Anchor { state: state.clone(), t, displaced, error: [0.0; 2] };
        Self { anchor, t, scratch }
    }
}

impl<V: Vector> Anchor<V> {
    /// Moves the anchor to `state` at time `t` (s), known to within `error`.
    fn place(&mut self, state: &State<V>, t: f64, error: [f64; 2]) {
        self.state.assign(state);
        self.displaced.assign(state);
        self.displaced.q.components_mut().iter_mut().for_each(|x| *x += error[0]);
        self.displaced.v.components_mut().iter_mut().for_each(|x| *x += error[1]);
        (self.t, self.error) = (t, error);
    }

    /// Returns a bound on the error of `state` at time `t`. It sums the rounding errors of the closed form and of the
    /// time, and the error of the anchor after the flow has carried it to `t`.
    fn error<B: Body<Vector = V>>(
        &self,
        body: &B,
        t: f64,
        state: &State<V>,
        scratch: &mut State<V>,
    ) -> [f64; 2] {
        let mut error = [0.0; 2];
        if t != self.t {
            error = body.exact_error(self.t, t - self.t, &self.state, state);
            let late = f64::EPSILON * (t.abs() + self.t.abs());
            body.acceleration(t, &state.q, &state.v, &mut scratch.v);
            let by_time = late_error(late, &state.v, &scratch.v);
            error = [0, 1].map(|i| error[i] + by_time[i]);
        }
        if self.error != [0.0; 2] {
            body.exact_into(self.t, t - self.t, &self.displaced, scratch);
            scratch.add_scaled(-1.0, state);
            error[0] += largest(scratch.q.components());
            error[1] += largest(scratch.v.components());
        }
        error.map(nan_is_infinite)
    }
}

/// Returns the errors of the coordinates and of the velocities that a time error of `late` (s) causes, at velocity `v`
/// and acceleration `a`.
pub(super) fn late_error<V: Vector>(late: f64, v: &V, a: &V) -> [f64; 2] {
    [v, a].map(|rate| late * largest(rate.components()))
}

impl<B: Body> Propagator<B> for ExactFlow<B::Vector> {
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, _n: u32, y: &mut StateOf<B>) -> Stepped {
        self.t = t + h;
        let Anchor { state: from, t: begin, .. } = &self.anchor;
        body.system.exact_into(*begin, self.t - begin, from, y);
        Ok(())
    }

    fn jump(&mut self, t: f64, change: Change<'_>, body: &mut B, state: &mut StateOf<B>) -> bool {
        let Self { anchor, t: now, scratch } = self;
        let error =
            if change.is_placing() { [0.0; 2] } else { anchor.error(body, *now, state, scratch) };
        let is_changed = change.apply(body, state);
        if is_changed {
            anchor.place(state, t, error);
            *now = t;
        }
        is_changed
    }

    fn true_bounce(&self, body: &B, impact: u64) -> Option<[f64; 2]> {
        let [after_s, apex] = body.bounce(&self.anchor.state, impact)?;
        Some([self.anchor.t + after_s, apex])
    }

    fn is_closed_form(&self) -> bool {
        true
    }

    fn truth_error(&self, body: &Counted<B>, state: &StateOf<B>) -> Option<[f64; 2]> {
        let mut scratch = state.clone();
        Some(self.anchor.error(&body.system, self.t, state, &mut scratch))
    }
}
