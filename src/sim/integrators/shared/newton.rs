//! Newton's iteration for the accelerations at the stages of an implicit method.
//!
//! Coordinates and velocities of a stage are sums of known terms and of the accelerations, which are
//! therefore the only unknowns. The Jacobian is taken by finite differences once per step, and again if
//! convergence is slow. The iteration continues to round-off, because a method conserves a quantity
//! only as well as its equations are solved. If it does not converge, the solution is continued from a
//! shorter step.
//!
//! A body of many coordinates that feel few others each has a [sparse vector](Vector::IS_SPARSE), and no
//! matrix: its linear equations are solved by an iteration of their own.

use crate::sim::integrators::failure::StepFailure;
use crate::sim::state::{State, Vector};
use crate::sim::system::System;
use iteration::MAX_ITERATIONS;
pub(in crate::sim::integrators) use iteration::Newton;
pub(in crate::sim::integrators) use krylov::Krylov;
pub(in crate::sim::integrators) use stages::{Stages, largest};

mod continuation;
mod curve;
mod iteration;
mod krylov;
mod sparse;
mod stages;

impl<V: Vector> Newton<V, 1> {
    /// Replaces `y` by the solution of `Y = y + c f(t, Y)`.
    pub(in crate::sim::integrators) fn backward_euler(
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
    /// Solves for the accelerations at the stages.
    pub(in crate::sim::integrators) fn solve(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
    ) -> Result<(), StepFailure> {
        for a in &mut self.a {
            a.components_mut().fill(0.0);
        }
        self.krylov.iter_mut().for_each(|krylov| krylov.begin_step());
        let is_solved = if const { V::IS_SPARSE } {
            self.iterate_sparsely(system, stages)
        } else {
            self.iterate(system, stages) || self.solve_by_continuation(system, stages)
        };
        if is_solved {
            return Ok(());
        }
        Err(StepFailure::NewtonFailed { limit: MAX_ITERATIONS })
    }
}
