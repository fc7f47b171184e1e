//! Newton's iteration for the accelerations at the stages of an implicit method.
//!
//! The coordinates and velocities of a stage are sums of what is known before and of the accelerations
//! sought, so that these are all there is to solve for. Their derivatives come by differences, once a
//! step, and again where that turns out too coarse. The iteration goes on to round-off, because a method
//! that keeps a quantity keeps it only as well as its equations are solved. Where it does not converge, the
//! solution is followed from a shorter step.

use crate::sim::integrators::failure::StepFailure;
use crate::sim::system::{State, System, Vector};
use iteration::MAX_ITERATIONS;
pub(in crate::sim::integrators) use iteration::{Newton, Stages};

mod continuation;
mod curve;
mod iteration;

impl<V: Vector> Newton<V, 1> {
    /// Carries `y` to the solution of `Y = y + c f(t, Y)`.
    pub(in crate::sim::integrators) fn backward(
        &mut self,
        system: &impl System<Vector = V>,
        t: f64,
        c: f64,
        y: &mut State<V>,
    ) -> Result<(), StepFailure> {
        self.known[0].assign(y);
        self.known[0].q.add_scaled(c, &y.v);
        self.solve(system, &Stages { t: [t], alpha: [[c * c]], beta: [[c]] })?;
        y.v.add_scaled(c, &self.a[0]);
        y.q.add_scaled(c, &y.v);
        Ok(())
    }
}

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Finds the accelerations.
    pub(in crate::sim::integrators) fn solve(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
    ) -> Result<(), StepFailure> {
        for a in &mut self.a {
            a.components_mut().fill(0.0);
        }
        if self.iterate(system, stages) || self.follow(system, stages) {
            return Ok(());
        }
        Err(StepFailure::NewtonFailed { limit: MAX_ITERATIONS })
    }
}
