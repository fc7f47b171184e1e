//! The truth of a body that knows its exact motion from the start, but not from any state: after an
//! input, an edit or a placing it is a reference solution.

use std::cell::RefCell;

use super::body::Body;
use super::integrators::Stepped;
use super::propagator::Propagator;
use super::reference::Reference;
use super::state::{State, Vector, largest};
use super::stepper::Change;
use super::system::{Counted, StateOf};

/// The rounding of a closed form whose operations are not known, relative to its value.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The exact motion since the start, or the reference solution since somebody intervened.
#[derive(Clone, Debug)]
pub(super) struct ExactSinceStart<V> {
    is_untouched: bool,
    /// The time of the current state, in seconds.
    t: f64,
    /// Where the exact motion starts. Kept, for a change must not allocate.
    start: State<V>,
    reference: Reference<V>,
    /// Scratch of the error, which is asked for at every tick.
    a: RefCell<V>,
}

impl<V: Vector> ExactSinceStart<V> {
    /// The motion of `body`, which stands at its start at time 0.
    pub(super) fn new<B: Body<Vector = V>>(body: &B, start: &State<V>) -> Self {
        let a = RefCell::new(start.v.clone());
        let (start, reference) = (start.clone(), Reference::new(body, start));
        Self { is_untouched: true, t: 0.0, start, reference, a }
    }
}

/// Whether `state` at time `t` (s) is the start of `body`.
pub(super) fn is_start<B: Body>(body: &B, t: f64, state: &StateOf<B>) -> bool {
    t == 0.0 && are_equal(&body.start(), state)
}

fn are_equal<V: Vector>(a: &State<V>, b: &State<V>) -> bool {
    a.q.components() == b.q.components() && a.v.components() == b.v.components()
}

impl<B: Body> Propagator<B> for ExactSinceStart<B::Vector> {
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, n: u32, y: &mut StateOf<B>) -> Stepped {
        self.t = t + h;
        if self.is_untouched && body.system.exact_since_start(self.t, y) {
            return Ok(());
        }
        self.reference.step(body, t, h, n, y)
    }

    fn jump(&mut self, t: f64, change: Change<'_>, body: &mut B, state: &mut StateOf<B>) -> bool {
        let is_changed = self.reference.jump(t, change, body, state);
        if is_changed {
            self.is_untouched = change.is_placing() && t == 0.0 && are_equal(&self.start, state);
            self.t = t;
        }
        is_changed
    }

    fn is_closed_form(&self) -> bool {
        self.is_untouched
    }

    fn truth_error(&self, body: &Counted<B>, state: &StateOf<B>) -> Option<[f64; 2]> {
        if !self.is_untouched {
            return self.reference.truth_error(body, state);
        }
        let a = &mut *self.a.borrow_mut();
        body.system.acceleration(self.t, &state.q, &state.v, a);
        let late = f64::EPSILON * self.t;
        let of = |size: &B::Vector, rate: &B::Vector| {
            ROUNDING * largest(size.components()) + late * largest(rate.components())
        };
        let error = [of(&state.q, &state.v), of(&state.v, a)];
        Some(error.map(|error| if error.is_nan() { f64::INFINITY } else { error }))
    }

    fn heap_bytes(&self) -> usize {
        Propagator::<B>::heap_bytes(&self.reference)
    }
}
