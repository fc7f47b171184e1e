//! Newton's iteration for a sparse vector: its linear equations are solved roughly, and a correction that
//! makes the residual larger is taken in part.

use super::iteration::{MAX_ITERATIONS, Newton, Stages, components, largest};
use crate::sim::system::{System, Vector};

/// The relative residual to which the linear equations of an iteration are solved. The next iteration
/// solves what is left.
const LINEAR_TOLERANCE: f64 = 1e-4;
/// An iteration that reduces the correction by less than this factor is at the end of what rounding allows.
const SLOW_CONVERGENCE: f64 = 0.1;
/// The residual at rounding level, relative to the forces and to the change of the forces by the rounding of
/// the coordinates.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// The least part of a correction that is tried.
const LEAST_PART: f64 = 1.0 / 1024.0;
/// The part of the residual that a whole correction must remove.
const LEAST_PROGRESS: f64 = 1e-4;

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Iterates from the current `A`. Returns whether it converged.
    pub(super) fn iterate_sparsely(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
    ) -> bool {
        let Self { known, a, evaluated, perturbed, stage, residual, krylov, .. } = self;
        let krylov = krylov.as_mut().expect("a sparse vector has it");
        let distance = largest(known.iter().flat_map(|known| known.q.components()));
        let mut rounding = 0.0;
        let (mut norm, mut last, mut part) = (f64::INFINITY, f64::NAN, 1.0);
        for iteration in 0..MAX_ITERATIONS {
            let mut is_at_rounding;
            loop {
                stages.evaluate(system, known, a, stage, evaluated);
                if iteration == 0 {
                    krylov.linearise(stages, known, a);
                    let change = krylov.largest_change(system, distance);
                    rounding = ROUND_OFF * (largest(components(evaluated)) + change);
                }
                let rows = components(evaluated).zip(components(a));
                let mut squares = 0.0_f64;
                for (off, (evaluated, a)) in
                    perturbed.iter_mut().flat_map(V::components_mut).zip(rows)
                {
                    *off = evaluated - a;
                    squares += *off * *off;
                }
                let now = squares.sqrt();
                is_at_rounding = largest(components(perturbed)) <= rounding;
                if now <= (1.0 - LEAST_PROGRESS * part) * norm || is_at_rounding {
                    norm = now;
                    break;
                }
                part /= 2.0;
                // Written so that a NaN ends it.
                if !(part >= LEAST_PART) {
                    return false;
                }
                let rows = a.iter_mut().flat_map(V::components_mut);
                rows.zip(residual.iter()).for_each(|(a, correction)| *a -= part * correction);
            }
            for (residual, off) in residual.iter_mut().zip(components(perturbed)) {
                *residual = *off;
            }
            krylov.linearise(stages, known, a);
            krylov.solve(system, LINEAR_TOLERANCE, residual);
            let rows = a.iter_mut().flat_map(V::components_mut);
            rows.zip(residual.iter()).for_each(|(a, correction)| *a += correction);
            part = 1.0;

            let (correction, size) = (largest(residual.iter()), largest(components(a)));
            let rate = correction / last;
            // The remaining error is at most a geometric series of corrections at this rate.
            let left = rate / (1.0 - rate) * correction;
            let is_solved = rate < 1.0 && left <= f64::EPSILON * size;
            let is_fast = rate <= SLOW_CONVERGENCE;
            if size.is_finite() && (is_solved || is_at_rounding && !is_fast) {
                return true;
            }
            if krylov.is_spent() || !size.is_finite() {
                return false;
            }
            last = correction;
        }
        false
    }
}
