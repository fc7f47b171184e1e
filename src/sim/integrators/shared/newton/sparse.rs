//! Newton's iteration without a matrix. It solves its linear equations roughly, and shortens a correction that
//! increases the residual.
//!
//! If a step strongly turns and compresses springs, the iteration can stall between solutions. The equations of
//! implicit Euler on springs are those of a minimum of an energy (Martin, Thomaszewski, Grinspun & Gross,
//! *Example-based elastic materials*, 2011). The equations of the other methods nearly are. A descent then comes near a
//! solution, from which Newton's iteration continues.

use super::{Convergence, MAX_ITERATIONS, Newton, Progress, ROUND_OFF};
use crate::integrators::shared::krylov::length;
use crate::integrators::shared::stages::{Stages, largest_of};
use crate::state::{Vector, largest};
use crate::system::System;

/// The relative residual of the linear equations of an iteration. The next iteration reduces the residual further.
const LINEAR_TOLERANCE: f64 = 1e-4;
/// The smallest fraction of a correction that is tried.
const MIN_PART: f64 = 1.0 / 64.0;
/// The maximum number of descent steps.
const MAX_DESCENTS: u32 = 200;
/// The smallest fraction of a descent step that is tried.
const MIN_DESCENT: f64 = 1e-9;
/// The steepest uphill slope at the end of a descent step, relative to the slope at its start.
const UPHILL: f64 = 0.5;
/// The fraction of the residual that a full correction must remove.
const MIN_PROGRESS: f64 = 1e-4;

/// Residuals below this number are rounding, because forces near this number lose digits to underflow.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// The outcome of a descent step.
enum Descent {
    /// No direction leads downhill, or the budget is spent.
    Stuck,
    /// The energy curves downwards, or is not close to a parabola.
    Curved,
    /// A full step succeeded, so that Newton's iteration may converge from here.
    Near,
}

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Iterates from the current `A`. Returns whether the iteration converged.
    pub(super) fn iterate_sparsely(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
    ) -> bool {
        self.linearisation.begin_step();
        if self.correct_sparsely(system, stages) {
            return true;
        }
        self.a.iter_mut().for_each(|a| a.components_mut().fill(0.0));
        for _ in 0..MAX_DESCENTS {
            match self.descend(system, stages) {
                Descent::Stuck => return false,
                Descent::Curved => continue,
                Descent::Near => {}
            }
            self.save_unknowns();
            if self.correct_sparsely(system, stages) {
                return true;
            }
            self.restore_unknowns();
        }
        false
    }

    /// Evaluates the forces, the residual and the reach of slopes at the current `A`.
    fn evaluate_residual(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) {
        self.evaluate(system, stages);
        let Self { evaluated, linearisation, .. } = &mut *self;
        linearisation.slopes.reach_for(stages.beta[0][0], &linearisation.at[0], &evaluated[0]);
        self.compute_residual();
    }

    /// Makes a step down the energy, whose negative gradient is the residual.
    fn descend(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) -> Descent {
        self.evaluate_residual(system, stages);
        self.correction.copy_from_slice(&self.residual);
        let curves_upwards = self.linearisation.descend(system, stages, &mut self.correction);
        let downhill = |newton: &Self| {
            newton.residual.iter().zip(&newton.correction).map(|(r, d)| r * d).sum::<f64>()
        };
        let steep = downhill(self);
        if self.linearisation.is_spent() || !(steep > 0.0 && steep.is_finite()) {
            return Descent::Stuck;
        }
        let (mut part, mut moved) = (1.0, 0.0);
        while part >= MIN_DESCENT {
            self.add_correction(part - moved);
            moved = part;
            self.evaluate_residual(system, stages);
            // The step ends not far beyond the lowest point in this direction.
            if downhill(self) >= -UPHILL * steep {
                let is_near = curves_upwards && part == 1.0;
                return if is_near { Descent::Near } else { Descent::Curved };
            }
            part /= 2.0;
        }
        Descent::Stuck
    }

    /// Runs Newton's iteration from the current `A`. Returns whether the iteration converged.
    fn correct_sparsely(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) -> bool {
        let mut rounding = 0.0;
        let (mut norm, mut part) = (f64::INFINITY, 1.0);
        let mut convergence = Convergence::BEGUN;
        for iteration in 0..MAX_ITERATIONS {
            let is_at_rounding = loop {
                self.evaluate_residual(system, stages);
                if iteration == 0 {
                    rounding = ROUND_OFF * self.rounding_of_forces(system, stages) + UNDERFLOW;
                }
                let now = length(&self.residual);
                let is_at_rounding = largest(&self.residual) <= rounding;
                if now <= (1.0 - MIN_PROGRESS * part) * norm || is_at_rounding {
                    norm = now;
                    break is_at_rounding;
                }
                part /= 2.0;
                if part < MIN_PART {
                    return false;
                }
                self.add_correction(-part);
            };
            self.correction.copy_from_slice(&self.residual);
            self.linearisation.iterate(system, stages, LINEAR_TOLERANCE, &mut self.correction);
            part = 1.0;
            let (correction, size) = self.correct();
            match convergence.judge(correction, size, is_at_rounding) {
                Progress::Solved => return true,
                Progress::Lost => return false,
                Progress::Fast | Progress::Slow if self.linearisation.is_spent() => return false,
                Progress::Fast | Progress::Slow => {}
            }
        }
        false
    }

    /// Returns the scale of the rounding error of the forces, in units of round-off. It is the size of the forces at
    /// the stages, plus their change if coordinates change by as much as the largest of them.
    fn rounding_of_forces(&mut self, system: &dyn System<Vector = V>, stages: &Stages<S>) -> f64 {
        let distances = self.base.iter().map(|base| largest(base.q.components()));
        let distance = distances.fold(0.0, f64::max);
        let change = self.linearisation.largest_change(system, stages.t[0], distance);
        largest_of(&self.evaluated) + change
    }
}
