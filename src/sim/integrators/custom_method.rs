//! Methods behind a pointer, compiled once for each vector type. Custom methods are in no table, so that their cards
//! build them.

use std::fmt;
use std::panic::RefUnwindSafe;

use super::failure::{StepFailure, Stepped};
use super::integrator::{Integrator, Override};
use crate::TickRate;
use crate::state::{State, Vector};
use crate::system::{Coupling, StateOf, System};
use crate::vec_system::{Scratch, VecSystem};

/// A system of any type. A custom method steps systems with their coordinates in a `Vec`.
pub type AnySystem<'a, V = Vec<f64>> = &'a (dyn System<Vector = V> + 'a);

/// A method behind a pointer, which steps systems behind a pointer. Every `Clone` [`Integrator`] is such a method.
pub trait AnyIntegrator<V = Vec<f64>>: for<'a> Integrator<AnySystem<'a, V>> {
    /// Returns a copy with the same memory.
    fn boxed_clone(&self) -> Box<dyn AnyIntegrator<V>>;
}

impl<V, I: for<'a> Integrator<AnySystem<'a, V>> + Clone + 'static> AnyIntegrator<V> for I {
    fn boxed_clone(&self) -> Box<dyn AnyIntegrator<V>> {
        Box::new(self.clone())
    }
}

/// Builds the integrators of a custom method. [`custom_integrator`] does, and so do the lines of a person.
pub trait BuildIntegrator: Send + Sync + RefUnwindSafe {
    /// Returns an integrator for this number of coordinates of systems with this coupling.
    fn build(&self, coordinates: usize, coupling: Coupling) -> Box<dyn AnyIntegrator>;
    /// Returns a person's own lines, if the method is made of lines.
    fn text(&self) -> Option<&str> {
        None
    }
    /// Returns the frame rate for which the lines were written, if they are a rule.
    fn fps(&self) -> Option<TickRate> {
        None
    }
    /// Returns an upper bound on how many numbers the method keeps on the heap besides its own vectors, for `n`
    /// coordinates. By default the method counts as one with sixteen vectors.
    fn numbers_kept(&self, n: usize) -> usize {
        16 * (n + 3)
    }
}

impl<F: Fn(usize) -> Box<dyn AnyIntegrator> + Send + Sync + RefUnwindSafe> BuildIntegrator for F {
    fn build(&self, coordinates: usize, _coupling: Coupling) -> Box<dyn AnyIntegrator> {
        self(coordinates)
    }
}

impl fmt::Debug for dyn BuildIntegrator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text().unwrap_or("a custom method"))
    }
}

/// Builds the integrator `I` for this number of coordinates. A reference to this function is the value of
/// [`Method::custom`](super::Method::custom) on a custom method's card:
///
/// ```
/// use regatta_sim::prelude::*;
///
/// /// Explicit Euler's step.
/// #[derive(Clone)]
/// struct Plain<V>(State<V>);
///
/// impl<S: System> Integrator<S> for Plain<S::Vector> {
///     fn new(like: &S::Vector) -> Self {
///         Self(State { q: like.clone(), v: like.clone() })
///     }
///     fn step(
///         &mut self,
///         system: &S,
///         t: f64,
///         h: f64,
///         state: &mut State<S::Vector>,
///     ) -> Result<(), StepFailure> {
///         system.derivative(t, state, &mut self.0);
///         state.add_scaled(h, &self.0);
///         Ok(())
///     }
/// }
///
/// static PLAIN: Method = Method {
///     id: "plain",
///     name: "Plain",
///     order: 1,
///     order_with_drag: 1,
///     evaluations: Some(1),
///     custom: Some(&custom_integrator::<Plain<Vec<f64>>>),
///     ..Family::Explicit.card()
/// };
/// assert_eq!(PLAIN.stability_limit, Some(0.0));
/// ```
pub fn custom_integrator<I: AnyIntegrator + 'static>(coordinates: usize) -> Box<dyn AnyIntegrator> {
    Box::new(I::new(&vec![0.0; coordinates]))
}

impl<V> Clone for Box<dyn AnyIntegrator<V>> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}

/// A custom method on systems with coordinates in a `V`.
#[derive(Clone)]
pub(super) struct CustomMethod<V> {
    integrator: Box<dyn AnyIntegrator>,
    state: State<Vec<f64>>,
    scratch: Scratch<V>,
}

impl<V: Vector> CustomMethod<V> {
    /// Returns the method that `custom` builds, for coordinates shaped `like` these, with this coupling.
    pub(super) fn new(custom: &dyn BuildIntegrator, like: &V, coupling: Coupling) -> Self {
        let zero = vec![0.0; like.components().len()];
        Self {
            integrator: custom.build(zero.len(), coupling),
            state: State { q: zero.clone(), v: zero },
            scratch: Scratch::new(like),
        }
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for CustomMethod<S::Vector> {
    /// Refuses every step, because only the card knows which method to build.
    fn new(like: &S::Vector) -> Self {
        Self::new(&custom_integrator::<Unfit>, like, Coupling::All)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        self.steps(system, t, h, 1, state)
    }

    fn steps(&mut self, system: &S, t: f64, h: f64, n: u32, state: &mut StateOf<S>) -> Stepped {
        let Self { integrator, state: many, scratch } = self;
        many.q.copy_from_slice(state.q.components());
        many.v.copy_from_slice(state.v.components());
        let system: AnySystem<'_> = &VecSystem::new(system, scratch);
        let stepped = integrator.steps(&system, t, h, n, many);
        state.q.components_mut().copy_from_slice(&many.q);
        state.v.components_mut().copy_from_slice(&many.v);
        stepped
    }

    fn reset(&mut self) {
        self.integrator.reset();
    }

    fn set(&mut self, with: Override) {
        self.integrator.set(with);
    }

    fn lost_time(&self) -> f64 {
        self.integrator.lost_time()
    }
}

/// Replaces a method on a system that the method cannot step. It refuses every step.
#[derive(Clone)]
pub(super) struct Unfit {
    pub(super) reason: &'static str,
}

impl<S: System> Integrator<S> for Unfit {
    fn new(_like: &S::Vector) -> Self {
        Self { reason: "it was built without its card" }
    }

    fn step(&mut self, _system: &S, _t: f64, _h: f64, _state: &mut StateOf<S>) -> Stepped {
        Err(StepFailure::Refused { reason: self.reason })
    }
}
