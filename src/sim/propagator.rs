//! The propagator of a body, which is a method or a truth, and how it reacts when the body jumps.
//!
//! # When something jumps
//!
//! Memory carried from step to step is valid only while the motion is smooth. One place detects each kind of jump:
//!
//! - The *state or the forces* jump when the body is placed, given an input or edited. A stepper owns its body and
//!   state, and makes every such change within [`Propagator::jump`]. A method is [reset](Integrator::reset) there. The
//!   exact flow restarts from the new state, and keeps the error of the old state, which is computed with the body
//!   before the change.
//! - The *length of the step* is an argument of every step. A method with memory compares it with the length of its
//!   last step, so nobody has to announce a change.
//! - Any caller can change a state *outside a stepper*. The method that [`integrator`](super::integrators::integrator)
//!   returns therefore compares the state with the one it returned last, and resets itself if they differ. A stepper
//!   skips this comparison, which would cost time at every tick.

use super::body::Body;
use super::impact::Bounces;
use super::integrators::{AnyIntegrator, AnySystem, Integrator, Problem, Stepped};
use super::state::{State, Vector};
use super::stepper::Change;
use super::system::{Counted, StateOf};

/// A method or a truth that advances bodies of type `B`.
pub(super) trait Propagator<B: Body>: Send + 'static {
    /// Advances the state `y` from `t` to `t + h` (s). A method takes `n` equal steps; a truth ignores `n`.
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, n: u32, y: &mut StateOf<B>) -> Stepped;

    /// Applies `change` to the body and its state at time `t` (s), and restarts from the result. If nothing changed,
    /// the propagator keeps its memory. Returns whether anything changed.
    fn jump(&mut self, t: f64, change: Change<'_>, body: &mut B, state: &mut StateOf<B>) -> bool {
        let is_changed = change.apply(body, state);
        if is_changed {
            self.restart(t, change.is_placing(), body, state);
        }
        is_changed
    }

    /// Restarts after a change by [`Propagator::jump`]; `is_placing` is [`Change::is_placing`] of that change.
    fn restart(&mut self, _t: f64, _is_placing: bool, _body: &B, _state: &StateOf<B>) {}

    /// Steps a problem from the state `y`, with a copy of the method that steps the body; `None` for a truth.
    fn try_step(
        &self,
        _of: &Problem<B::Vector>,
        _from_t_by_h: [f64; 2],
        _n: u32,
        _y: &mut StateOf<B>,
    ) -> Option<Stepped> {
        None
    }

    /// Whether the state comes from a closed form.
    fn is_closed_form(&self) -> bool {
        false
    }

    /// Returns the errors of a coordinate and of a velocity at the current `state` of a truth; `None` for a method.
    fn truth_error(&self, _body: &Counted<B>, _state: &StateOf<B>) -> Option<[f64; 2]> {
        None
    }

    /// Returns the time in seconds that a method has left out of its steps.
    fn lost_time(&self) -> f64 {
        0.0
    }

    /// Returns the record of a body that meets walls; `None` for the truth, and for other bodies.
    fn bounces(&self) -> Option<&Bounces> {
        None
    }

    /// Returns the time (s) of the true impact of this number since the last change, and the height of the flight after
    /// it; `None` for a method.
    fn true_bounce(&self, _body: &B, _impact: u64) -> Option<[f64; 2]> {
        None
    }

    /// Returns the memory on the heap in bytes, without coordinate vectors.
    fn heap_bytes(&self) -> usize {
        0
    }
}

/// A method, compiled once for each vector type.
#[derive(Clone)]
pub(super) struct AnyMethod<V>(pub(super) Box<dyn AnyIntegrator<V>>);

impl<V: Vector, B: Body<Vector = V>> Propagator<B> for AnyMethod<V> {
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, n: u32, y: &mut State<V>) -> Stepped {
        let system: AnySystem<'_, V> = body;
        self.0.steps(&system, t, h, n, y)
    }

    fn restart(&mut self, _t: f64, _is_placing: bool, _body: &B, _state: &State<V>) {
        self.0.reset();
    }

    fn try_step(
        &self,
        of: &Problem<V>,
        [t, h]: [f64; 2],
        n: u32,
        y: &mut State<V>,
    ) -> Option<Stepped> {
        let system: AnySystem<'_, V> = of;
        Some(self.0.boxed_clone().steps(&system, t, h, n, y))
    }

    fn lost_time(&self) -> f64 {
        self.0.lost_time()
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(&*self.0)
    }
}

/// A method from the table, compiled for the body.
pub(super) struct MethodPropagator<I>(pub(super) I);

impl<I: Clone> Clone for MethodPropagator<I> {
    /// Not inlined, because each body would otherwise contain a copy of this function.
    #[inline(never)]
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<B: Body, I> Propagator<B> for MethodPropagator<I>
where
    I: Integrator<Counted<B>> + Integrator<Problem<B::Vector>> + Clone + 'static,
{
    #[inline]
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, n: u32, y: &mut StateOf<B>) -> Stepped {
        self.0.steps(body, t, h, n, y)
    }

    #[inline]
    fn restart(&mut self, _t: f64, _is_placing: bool, _body: &B, _state: &StateOf<B>) {
        Integrator::<Counted<B>>::reset(&mut self.0);
    }

    fn try_step(
        &self,
        of: &Problem<B::Vector>,
        [t, h]: [f64; 2],
        n: u32,
        y: &mut StateOf<B>,
    ) -> Option<Stepped> {
        Some(self.clone().0.steps(of, t, h, n, y))
    }

    #[inline]
    fn lost_time(&self) -> f64 {
        Integrator::<Counted<B>>::lost_time(&self.0)
    }
}
