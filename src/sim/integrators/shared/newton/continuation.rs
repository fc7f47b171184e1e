//! Continuation, for steps at which Newton's iteration does not converge. It follows the solution from a step of length
//! zero, where the solution is known.
//!
//! A factor λ multiplies the weights α and β. At λ = 0 the solution is the force at the known terms, and at λ = 1 it is
//! the solution of the step. The solutions in between form a curve, which turns back at folds, where two solutions
//! meet. Parametrised by arc length (Keller, *Numerical solution of bifurcation and nonlinear eigenvalue problems*,
//! 1977), the curve can be followed through such folds. If the force is bounded and smooth, the curve cannot end before
//! λ = 1.
//!
//! No built-in scene needs continuation at its own rate. The scene `pendulum` needs it at 1 to 3 Hz, and `kicked-rotor`
//! at 1 to 8 Hz. Without continuation, an implicit method halts within minutes there.

use super::Newton;
use crate::integrators::shared::krylov::dot;
use crate::integrators::shared::stages::{Stages, largest_of};
use crate::state::Vector;
use crate::state::quotient;
use crate::system::System;

/// The longest arc length of a step, in each of three attempts. Longer steps can jump to a nearby curve that leads
/// nowhere, and shorter steps take more work.
const MAX_STEP_LENGTHS: [f64; 3] = [0.25, 0.05, 0.01];
/// The shortest arc length of a step. The attempt fails if the force is not smooth at this scale.
const MIN_STEP_LENGTH: f64 = 1e-7;
/// The factor by which the step grows if it converged, and the factor by which it shrinks if it failed.
const STEP_FACTORS: (f64, f64) = (1.5, 0.3);
/// The maximum number of steps of an attempt.
const MAX_STEPS: u32 = 1000;
/// The maximum number of corrector iterations of a step.
const MAX_CORRECTIONS: u32 = 6;
/// The largest size of the last correction. This tolerance can be coarse, because the end of the curve is solved to
/// round-off.
const CORRECTOR_TOLERANCE: f64 = 1e-6;
/// The change of λ by which the derivative with respect to λ is computed.
const LAMBDA_DIFFERENCE: f64 = 1e-6;

/// The current point on the curve of solutions, and its tangent.
#[derive(Clone, Debug)]
pub(super) struct SolutionCurve<V, const S: usize> {
    lambda: f64,
    /// The unit of accelerations, which is the largest force found on the curve.
    scale: f64,
    /// The forces at a slightly larger λ.
    further: [V; S],
    /// The derivative of the solution with respect to λ.
    slope_by_lambda: Vec<f64>,
    /// The unit tangent, whose components are accelerations in units of `scale`, and λ.
    tangent: Vec<f64>,
    tangent_lambda: f64,
}

impl<V: Vector, const S: usize> SolutionCurve<V, S> {
    pub(super) fn new(like: &V, size: usize) -> Self {
        Self {
            lambda: 0.0,
            scale: 1.0,
            further: std::array::from_fn(|_| like.clone()),
            slope_by_lambda: vec![0.0; size],
            tangent: vec![0.0; size],
            tangent_lambda: 1.0,
        }
    }
}

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Solves the equations. Returns whether the solution was found.
    #[cold]
    pub(super) fn solve_by_continuation(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
    ) -> bool {
        MAX_STEP_LENGTHS.iter().any(|&longest| self.continue_by(system, stages, longest))
    }

    /// Follows the curve by steps of at most `longest`. Their length is measured in units of λ, and in units of the
    /// force for accelerations. Returns whether the solution was found.
    fn continue_by(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
        longest: f64,
    ) -> bool {
        // At λ = 0 the force does not depend on the accelerations.
        self.a.iter_mut().for_each(|a| a.components_mut().fill(0.0));
        self.evaluate(system, &stages.scaled(0.0));
        let Self { a, evaluated, curve, .. } = self;
        let force = largest_of(evaluated);
        if !force.is_finite() {
            return false;
        }
        for (a, evaluated) in a.iter_mut().zip(evaluated.iter()) {
            a.assign(evaluated);
        }
        curve.scale = force.max(f64::MIN_POSITIVE);
        curve.lambda = 0.0;
        curve.tangent.fill(0.0);
        curve.tangent_lambda = 1.0;

        let mut step = longest;
        for _ in 0..MAX_STEPS {
            self.update_tangent(system, stages);
            self.save_unknowns();
            let begun = self.curve.lambda;
            if self.predict_and_correct(system, stages, step) {
                // Only the start of the curve is at λ = 0, so that a point with λ < 0 is on another curve.
                if self.curve.lambda < 0.0 {
                    return false;
                }
                if self.curve.lambda < 1.0 {
                    step = (STEP_FACTORS.0 * step).min(longest);
                    continue;
                }
                // The chord crosses λ = 1 close to the solution.
                let part = (1.0 - begun) / (self.curve.lambda - begun);
                let rows = self.a.iter_mut().flat_map(V::components_mut);
                for (a, start) in rows.zip(&self.kept) {
                    *a = start + part * (*a - start);
                }
                if self.iterate(system, stages) {
                    return true;
                }
            }
            self.restore_unknowns();
            self.curve.lambda = begun;
            step *= STEP_FACTORS.1;
            if step < MIN_STEP_LENGTH {
                return false;
            }
        }
        false
    }

    /// Computes the tangent at the current point, in the direction of travel.
    fn update_tangent(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) {
        self.linearise_on_curve(system, stages);
        let SolutionCurve { scale, slope_by_lambda, tangent, tangent_lambda, .. } = &mut self.curve;
        let along = dot(slope_by_lambda, tangent) / (*scale * *scale) + *tangent_lambda;
        let length = (dot(slope_by_lambda, slope_by_lambda) / (*scale * *scale) + 1.0)
            .sqrt()
            .copysign(along);
        for (tangent, slope_by_lambda) in tangent.iter_mut().zip(slope_by_lambda) {
            *tangent = *slope_by_lambda / length;
        }
        *tangent_lambda = 1.0 / length;
    }

    /// Makes one step along the curve. It predicts along the tangent by `step`, then corrects perpendicular to the
    /// tangent. Returns whether the corrections converged to the curve.
    fn predict_and_correct(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
        step: f64,
    ) -> bool {
        let Self { a, curve, .. } = self;
        let rows = a.iter_mut().flat_map(V::components_mut);
        for (a, tangent) in rows.zip(&curve.tangent) {
            *a += step * tangent;
        }
        curve.lambda += step * curve.tangent_lambda;
        let mut last = f64::INFINITY;
        for _ in 0..MAX_CORRECTIONS {
            self.linearise_on_curve(system, stages);
            self.compute_residual();
            self.correction.copy_from_slice(&self.residual);
            self.linearisation.solve(&mut self.correction);
            let Self { a, correction: residual, curve, .. } = self;
            let SolutionCurve { lambda, scale, slope_by_lambda, tangent, tangent_lambda, .. } =
                curve;
            let unit = *scale * *scale;
            let across = dot(tangent, slope_by_lambda) / unit + *tangent_lambda;
            let more = -dot(tangent, residual) / unit / across;
            let mut size = more.abs();
            let rows =
                a.iter_mut().flat_map(V::components_mut).zip(residual.iter()).zip(slope_by_lambda);
            for ((a, residual), slope_by_lambda) in rows {
                let correction = residual + more * *slope_by_lambda;
                *a += correction;
                size = size.max(correction.abs() / *scale);
            }
            *lambda += more;
            // The condition is written so that a NaN fails. A correction longer than the step leads to another curve.
            if !(size < last && size <= step) {
                return false;
            }
            if size <= CORRECTOR_TOLERANCE {
                return true;
            }
            last = size;
        }
        false
    }

    /// Evaluates the force, the Jacobian and the derivative of the solution with respect to λ at the current point.
    fn linearise_on_curve(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) {
        let lambda = self.curve.lambda;
        let here = stages.scaled(lambda);
        self.evaluate(system, &here);
        self.factor(system, &here, stages);
        let Self { base, a, evaluated, linearisation, curve, .. } = self;
        let SolutionCurve { scale, further, slope_by_lambda, .. } = curve;
        *scale = scale.max(largest_of(evaluated));
        let there = stages.scaled(lambda + LAMBDA_DIFFERENCE);
        there.evaluate(system, base, a, &mut linearisation.at, further);
        let n = slope_by_lambda.len() / S;
        let stages = further.iter().zip(evaluated.iter());
        for (slope_by_lambda, (further, here)) in slope_by_lambda.chunks_exact_mut(n).zip(stages) {
            slope_by_lambda.copy_from_slice(further.components());
            quotient(slope_by_lambda, here.components(), LAMBDA_DIFFERENCE);
        }
        linearisation.solve(slope_by_lambda);
    }
}
