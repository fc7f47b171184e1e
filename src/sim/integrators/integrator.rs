//! The trait that every method implements, and the overrides of a method's settings.

use std::fmt;

use super::failure::Stepped;
use crate::state::{State, Vector};
use crate::system::{Coupling, StateOf, System};

/// A method that advances a system by steps.
///
/// The system is a parameter of the trait, so that the force law is inlined into the method, while a `Box<dyn
/// Integrator<Ship>>` can still be swapped at run time. A [clone](CloneIntegrator) has the same memory. A game that
/// goes back to an earlier tick keeps a clone beside the state:
///
/// ```
/// # use regatta_sim::{State, bodies::Spring, integrators::{integrator, method}};
/// # let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 };
/// let mut state = State { q: 1.0, v: 0.0 };
/// let mut bdf2 = integrator(method("bdf2").unwrap(), &state.q);
/// bdf2.step(&spring, 0.0, 0.01, &mut state).unwrap();
/// let mut saved = (state, bdf2.clone());
/// bdf2.step(&spring, 0.01, 0.01, &mut state).unwrap();
/// saved.1.step(&spring, 0.01, 0.01, &mut saved.0).unwrap();
/// assert_eq!(saved.0, state);
/// ```
pub trait Integrator<S: System>: CloneIntegrator<S> + Send + Sync {
    /// Returns a method without memory, with scratch space for coordinate vectors shaped `like` this one.
    fn new(like: &S::Vector) -> Self
    where
        Self: Sized;

    /// Returns a method as [`Integrator::new`] does, for systems with this coupling. A method that solves equations
    /// chooses its linear algebra by the coupling.
    fn coupled(like: &S::Vector, _coupling: Coupling) -> Self
    where
        Self: Sized,
    {
        Self::new(like)
    }

    /// Advances `state` from `t` to exactly `t + h` (s), unless the card says that the method does not [keep
    /// time](super::Method::keeps_time). Never allocates.
    ///
    /// Does not report overflow, so that the caller must check the values. `t` and `h` must be finite. An integrator
    /// built by [`integrator`](super::integrator) checks that they are, but a bare method does not.
    ///
    /// # Errors
    /// If the method gives up or does not step this system; `state` is then undefined.
    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped;

    /// Advances from `t` to `t + h` in `n` equal steps, by one dynamic call for a whole tick.
    ///
    /// # Errors
    /// The same as for [`Integrator::step`].
    fn steps(&mut self, system: &S, t: f64, h: f64, n: u32, state: &mut StateOf<S>) -> Stepped {
        let part = h / f64::from(n);
        for i in 0..n {
            self.step(system, t + part * f64::from(i), part, state)?;
        }
        Ok(())
    }

    /// Clears the memory of the method. Must be called if the state or the forces jump. A method detects by itself that
    /// the length of the step changed.
    fn reset(&mut self) {}

    /// Overrides a setting of the card or the body. A method without this setting ignores the override.
    fn set(&mut self, _override: Override) {}

    /// Returns the time in seconds that the method has left out of its steps since it was built; 0 if it [keeps
    /// time](super::Method::keeps_time).
    fn lost_time(&self) -> f64 {
        0.0
    }
}

/// Clones an [`Integrator`] behind a pointer. Implemented for every integrator that is `Clone`.
pub trait CloneIntegrator<S: System> {
    /// Returns a copy with the same memory. From equal states, the original and the copy make steps of equal bits.
    fn clone_boxed(&self) -> Box<dyn Integrator<S>>;
}

impl<S: System, I: Integrator<S> + Clone + 'static> CloneIntegrator<S> for I {
    fn clone_boxed(&self) -> Box<dyn Integrator<S>> {
        Box::new(self.clone())
    }
}

impl<S: System> Clone for Box<dyn Integrator<S>> {
    fn clone(&self) -> Self {
        (**self).clone_boxed()
    }
}

impl<S: System> fmt::Debug for dyn Integrator<S> {
    /// Writes only a name, because neither the type of the method nor its memory is known here.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Integrator").finish_non_exhaustive()
    }
}

/// An override of a setting of the card or the body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Override {
    /// The tolerance of an adaptive method.
    Tolerance(Tolerance),
    /// The stiffness in 1/s² and the damping in 1/s, each per unit of mass, of a joint in an engine.
    Joint([f64; 2]),
    /// An engine refuses a system that answers no [engine query](crate::Query::Engine), whose joint it would not see.
    EngineQuery,
}

impl Override {
    /// Returns a tolerance with one number for all its parts.
    pub const fn tolerance(bound: f64) -> Self {
        Self::Tolerance(Tolerance::uniform(bound))
    }
}

/// The allowed error of a substep, which is `absolute + relative |y|` in every component.
///
/// An absolute part of `f64::INFINITY` excludes that half of the state from the control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Absolute part for coordinates, in metres or radians.
    pub absolute_q: f64,
    /// Absolute part for velocities, per second.
    pub absolute_v: f64,
    /// Part relative to the component's magnitude.
    pub relative: f64,
}

impl Tolerance {
    /// Returns a tolerance with one number for all three parts.
    pub const fn uniform(tolerance: f64) -> Self {
        Self { absolute_q: tolerance, absolute_v: tolerance, relative: tolerance }
    }

    /// Returns the largest component of `h error`, relative to the tolerance at `y`.
    #[inline]
    pub(in crate::integrators) fn relative_error<V: Vector>(
        &self,
        h: f64,
        error: &State<V>,
        y: &State<V>,
    ) -> f64 {
        let worst = |absolute: f64, error: &V, y: &V| {
            let rows = error.components().iter().zip(y.components());
            rows.fold(0.0, |worst: f64, (error, y)| {
                let error = (h * error).abs() / (absolute + self.relative * y.abs());
                larger(worst, error)
            })
        };
        larger(worst(self.absolute_q, &error.q, &y.q), worst(self.absolute_v, &error.v, &y.v))
    }
}

/// Returns the larger number. Unlike `f64::max`, it returns NaN if a number is NaN, so that a worthless step is
/// rejected.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
