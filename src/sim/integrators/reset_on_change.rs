//! A wrapper that detects when the caller changes the state of a method, or the forces.
//!
//! A memory is of a motion without a jump, and is wrong after one. The wrapper finds a jump of the state by itself, so
//! that a game may set a body without a word to its method. A jump of the forces it cannot see in their values, which
//! change in any case; so a system counts its jumps.

use super::failure::{StepFailure, Stepped};
use super::integrator::{Integrator, Override};
use crate::state::{State, Vector};
use crate::system::{Coupling, StateOf, System};

/// A method that [resets](Integrator::reset) if its state is not the one that it returned, or if the forces have
/// jumped.
#[derive(Clone)]
pub(super) struct ResetOnChange<I, V> {
    method: I,
    returned: State<V>,
    /// The [generation](System::generation) of the forces of the last step.
    generation: u64,
}

impl<I, V: Vector> ResetOnChange<I, V> {
    /// Wraps this method, for coordinates shaped `like` these.
    pub(super) fn around(method: I, like: &V) -> Self {
        Self { method, returned: State { q: like.clone(), v: like.clone() }, generation: 0 }
    }

    #[inline]
    fn advance<S: System<Vector = V>>(
        &mut self,
        system: &S,
        state: &mut State<V>,
        advance: impl FnOnce(&mut I, &mut State<V>) -> Stepped,
    ) -> Stepped
    where
        I: Integrator<S>,
    {
        let same = |a: &V, b: &V| a.components() == b.components();
        let is_own = same(&state.q, &self.returned.q) && same(&state.v, &self.returned.v);
        let generation = system.generation();
        if !is_own || generation != self.generation {
            self.method.reset();
        }
        self.generation = generation;
        let done = advance(&mut self.method, state);
        self.returned.assign(state);
        done
    }
}

impl<S, I> Integrator<S> for ResetOnChange<I, S::Vector>
where
    S: System<Vector: Vector>,
    I: Integrator<S> + Clone + 'static,
{
    fn new(like: &S::Vector) -> Self {
        Self::around(I::new(like), like)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self::around(I::coupled(like, coupling), like)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        StepFailure::check_step(t, h, 1)?;
        self.advance(system, state, |method, state| method.step(system, t, h, state))
    }

    fn steps(&mut self, system: &S, t: f64, h: f64, n: u32, state: &mut StateOf<S>) -> Stepped {
        StepFailure::check_step(t, h, n)?;
        self.advance(system, state, |method, state| method.steps(system, t, h, n, state))
    }

    fn reset(&mut self) {
        self.method.reset();
    }

    fn set(&mut self, with: Override) {
        self.method.set(with);
    }

    fn lost_time(&self) -> f64 {
        self.method.lost_time()
    }
}
