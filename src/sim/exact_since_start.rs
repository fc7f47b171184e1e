//! The exact motion of a body that knows this motion only from its start. After an input, an edit or a placement
//! elsewhere, the truth of the body is a reference solution.

use std::cell::RefCell;

use super::body::Body;
use super::exact_flow::late_error;
use super::state::{State, Vector, largest, nan_is_infinite};

/// The rounding error of a closed form whose operations are unknown, relative to the value of the form.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The exact motion since the start.
#[derive(Clone, Debug)]
pub(super) struct ExactSinceStart<V> {
    /// Whether the body is untouched since the start.
    pub(super) is_untouched: bool,
    /// The time of the current state, in seconds.
    t: f64,
    /// The start of the exact motion, kept because a change must not allocate.
    pub(super) start: State<V>,
    /// Scratch for computing the error, which is read at every tick.
    a: RefCell<V>,
}

impl<V: Vector> ExactSinceStart<V> {
    /// Returns the motion of `body` in `state` at time `t` (s); `None` if `state` is not the start of `body`, or if the
    /// body has no exact motion.
    pub(super) fn new<B: Body<Vector = V>>(
        body: &B,
        t: f64,
        state: &State<V>,
    ) -> Option<Box<Self>> {
        let start = body.start();
        let is_known = is_start(&start, t, state) && body.exact_since_start(t, &mut state.clone());
        is_known.then(|| {
            let a = RefCell::new(start.v.clone());
            Box::new(Self { is_untouched: true, t, start, a })
        })
    }

    /// Overwrites `y` with the state at time `t` (s), if the body is untouched. Returns whether `y` was overwritten.
    pub(super) fn step<B: Body<Vector = V>>(&mut self, body: &B, t: f64, y: &mut State<V>) -> bool {
        self.t = t;
        self.is_untouched && body.exact_since_start(t, y)
    }

    /// Records that an input, an edit or a placement put the body into `state` at time `t` (s).
    pub(super) fn jump(&mut self, t: f64, is_placing: bool, state: &State<V>) {
        self.is_untouched = is_placing && is_start(&self.start, t, state);
        self.t = t;
    }

    /// Returns a bound on the error of the current `state`, in a coordinate and in a velocity.
    pub(super) fn error<B: Body<Vector = V>>(&self, body: &B, state: &State<V>) -> [f64; 2] {
        let a = &mut *self.a.borrow_mut();
        body.acceleration(self.t, &state.q, &state.v, a);
        let [q, v] = late_error(f64::EPSILON * self.t, &state.v, a);
        let of = |size: &V, by_time: f64| ROUNDING * largest(size.components()) + by_time;
        [of(&state.q, q), of(&state.v, v)].map(nan_is_infinite)
    }
}

/// Whether `state` at time `t` (s) is `start`.
fn is_start<V: Vector>(start: &State<V>, t: f64, state: &State<V>) -> bool {
    let are_equal = |a: &V, b: &V| a.components() == b.components();
    t == 0.0 && are_equal(&start.q, &state.q) && are_equal(&start.v, &state.v)
}
