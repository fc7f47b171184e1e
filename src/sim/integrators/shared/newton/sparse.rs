//! Newton's iteration for a sparse vector: its linear equations are solved roughly, and a correction that
//! makes the residual larger is taken in part.
//!
//! Where a step turns and compresses springs a lot, that comes to a halt between solutions. The equations of
//! implicit Euler on springs are those of a minimum of an energy (Martin, Thomaszewski, Grinspun & Gross,
//! *Example-based elastic materials*, 2011), and so nearly are those of the others: a descent comes
//! near a solution, from which Newton's iteration goes on.

use super::iteration::{MAX_ITERATIONS, Newton};
use super::stages::{Stages, components, largest};
use crate::sim::state::Vector;
use crate::sim::system::System;

/// The relative residual to which the linear equations of an iteration are solved. The next iteration
/// solves what is left.
const LINEAR_TOLERANCE: f64 = 1e-4;
/// An iteration that reduces the correction by less than this factor is at the end of what rounding allows.
const SLOW_CONVERGENCE: f64 = 0.1;
/// The residual at rounding level, relative to the forces and to the change of the forces by the rounding of
/// the coordinates.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// The least part of a correction that is tried.
const LEAST_PART: f64 = 1.0 / 64.0;
/// The most steps down the energy.
const MOST_DESCENTS: u32 = 200;
/// The least part of such a step.
const LEAST_DESCENT: f64 = 1e-9;
/// How steeply a step of a descent may end uphill, in units of how steeply it begins.
const UPHILL: f64 = 0.5;
/// The part of the residual that a whole correction must remove.
const LEAST_PROGRESS: f64 = 1e-4;

/// What became of a step down the energy.
enum Descent {
    /// There is no way down, or no work left.
    Stuck,
    /// The energy curves downwards, or is not nearly a parabola.
    Curved,
    /// A whole step was taken: Newton's iteration may converge from here.
    Near,
}

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Iterates from the current `A`. Returns whether it converged.
    pub(super) fn iterate_sparsely(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
    ) -> bool {
        if self.correct_sparsely(system, stages) {
            return true;
        }
        self.a.iter_mut().for_each(|a| a.components_mut().fill(0.0));
        for _ in 0..MOST_DESCENTS {
            match self.descend(system, stages) {
                Descent::Stuck => return false,
                Descent::Curved => continue,
                Descent::Near => {}
            }
            for (kept, a) in self.curve.start.iter_mut().zip(components(&self.a)) {
                *kept = *a;
            }
            if self.correct_sparsely(system, stages) {
                return true;
            }
            let rows = self.a.iter_mut().flat_map(V::components_mut);
            rows.zip(&self.curve.start).for_each(|(a, kept)| *a = *kept);
        }
        false
    }

    /// A step down the energy whose gradient is the residual.
    fn descend(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) -> Descent {
        let Self { known, a, evaluated, stage, residual, krylov, .. } = self;
        let krylov = krylov.as_mut().expect("a sparse vector has it");
        stages.evaluate(system, known, a, stage, evaluated);
        let rows = components(evaluated).zip(components(a));
        residual.iter_mut().zip(rows).for_each(|(off, (evaluated, a))| *off = evaluated - a);
        krylov.linearise(stages, known, a);
        let curves_upwards = krylov.descend(system, residual);
        let downhill = |evaluated: &[V; S], a: &[V; S], direction: &[f64]| {
            let rows = components(evaluated).zip(components(a)).zip(direction);
            rows.map(|((evaluated, a), direction)| (evaluated - a) * direction).sum::<f64>()
        };
        let steep = downhill(evaluated, a, residual);
        if krylov.is_spent() || !(steep > 0.0 && steep.is_finite()) {
            return Descent::Stuck;
        }
        let (mut part, mut moved) = (1.0, 0.0);
        while part >= LEAST_DESCENT {
            let rows = a.iter_mut().flat_map(V::components_mut).zip(residual.iter());
            rows.for_each(|(a, direction)| *a += (part - moved) * direction);
            moved = part;
            stages.evaluate(system, known, a, stage, evaluated);
            // Not far beyond the lowest point of this direction.
            if downhill(evaluated, a, residual) >= -UPHILL * steep {
                let is_near = curves_upwards && part == 1.0;
                return if is_near { Descent::Near } else { Descent::Curved };
            }
            part /= 2.0;
        }
        Descent::Stuck
    }

    /// Newton's iteration from the current `A`. Returns whether it converged.
    fn correct_sparsely(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) -> bool {
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
                if part < LEAST_PART {
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
