//! A method that nobody has to tell that its state was changed.

use super::failure::StepFailure;
use super::integrator::Integrator;
use super::tolerance::Tolerance;
use crate::sim::system::{State, System, Vector};

/// A method, [reset](Integrator::reset) whenever it is given a state other than the one it left.
pub(super) struct Watched<I, V> {
    method: I,
    left: State<V>,
}

impl<I, V: Vector> Watched<I, V> {
    #[inline]
    fn watch<S: System<Vector = V>>(
        &mut self,
        state: &mut State<V>,
        advance: impl FnOnce(&mut I, &mut State<V>) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure>
    where
        I: Integrator<S>,
    {
        let same = |a: &V, b: &V| a.components() == b.components();
        if !(same(&state.q, &self.left.q) && same(&state.v, &self.left.v)) {
            self.method.reset();
        }
        let done = advance(&mut self.method, state);
        self.left.assign(state);
        done
    }
}

impl<S: System, I: Integrator<S>> Integrator<S> for Watched<I, S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { method: I::new(like), left: State { q: like.clone(), v: like.clone() } }
    }

    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        self.watch::<S>(state, |method, state| method.step(system, t, h, state))
    }

    fn steps(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        n: u32,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        self.watch::<S>(state, |method, state| method.steps(system, t, h, n, state))
    }

    fn reset(&mut self) {
        self.method.reset();
    }

    fn set_tolerance(&mut self, tolerance: Tolerance) {
        self.method.set_tolerance(tolerance);
    }

    fn heap_bytes(&self) -> usize {
        self.method.heap_bytes()
    }
}
