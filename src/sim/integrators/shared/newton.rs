//! Newton's iteration for the accelerations at the stages of an implicit method.
//!
//! The coordinates and velocities of a stage are sums of known terms and of accelerations, so that the accelerations
//! are the only unknowns. The Jacobian is computed once per step, and again if convergence is slow. The iteration
//! continues to round-off, because a method conserves a quantity only as well as its equations are solved. If the
//! iteration does not converge, continuation from a shorter step replaces it.
//!
//! For a body of many coordinates that depend on [few](crate::Coupling::Few) others each, no matrix is formed. The
//! linear equations are then solved roughly, and a correction that increases the residual is shortened.

use super::linearisation::Linearisation;
use super::stages::{Stages, largest_of};
use crate::integrators::failure::{StepFailure, Stepped};
use crate::state::{State, Vector, assert_length, largest};
use crate::system::{Coupling, System};
use continuation::SolutionCurve;

mod continuation;
mod sparse;

/// The maximum number of iterations in one step. 2 to 5 are usual. Without a limit, the iteration on a discontinuous
/// force would never end.
const MAX_ITERATIONS: u32 = 30;
/// An iteration that reduces the error by less than this factor needs a new Jacobian, or has reached the limit of
/// rounding.
const SLOW_CONVERGENCE: f64 = 0.1;
/// The residual at rounding level, relative to the rounding scale. It is the growth of a unit of round-off in the force
/// law.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// The relative differences for the Jacobian, first of accelerations and velocities, then of coordinates. The first is
/// the cube root of round-off, which balances truncation and rounding. The second is much smaller because a coordinate
/// may be far from the centre of its force.
const RELATIVE_DIFFERENCES: (f64, f64) = (6e-6, 1e-11);
/// The bounds on a difference. Below the first bound the difference underflows, and above the second it overflows.
const EXTREMES: (f64, f64) = (1e-150, 1e150);

/// Solves `A_i = a(t_i, Q_i, V_i)` for all `S` stages at once, where `Q_i = q_i + Σ α_ij A_j` and
/// `V_i = v_i + Σ β_ij A_j`.
#[derive(Clone)]
pub(in crate::integrators) struct Newton<V, const S: usize> {
    /// `q_i` and `v_i`, which the caller sets before solving.
    pub(in crate::integrators) base: [State<V>; S],
    /// `A_i`, the solution of the equations.
    pub(in crate::integrators) a: [V; S],
    /// The force law evaluated at `A`.
    evaluated: [V; S],
    linearisation: Linearisation<V, S>,
    /// The difference `evaluated - A`.
    residual: Vec<f64>,
    /// The last correction of `A`.
    correction: Vec<f64>,
    /// The `A` at the start of an attempt that may fail.
    kept: Vec<f64>,
    /// The scale of the rounding error of `evaluated`, in units of round-off; empty if no matrix is formed.
    rounding_scale: Vec<f64>,
    /// The solution curve for steps at which the iteration alone fails.
    curve: SolutionCurve<V, S>,
}

/// The convergence of an iteration.
struct Convergence {
    /// The size of the last correction. It is NaN before the first correction, when no rate is known.
    last: f64,
}

/// The verdict on a correction.
enum Progress {
    /// The remaining error is rounding.
    Solved,
    /// The Jacobian serves for another iteration.
    Fast,
    /// A new Jacobian is needed.
    Slow,
    /// The unknowns are no longer finite.
    Lost,
}

impl Convergence {
    const BEGUN: Self = Self { last: f64::NAN };

    /// Judges a correction after which the largest unknown is `size`. `is_at_rounding` is whether the residual of the
    /// correction was at rounding level.
    #[inline]
    fn judge(&mut self, correction: f64, size: f64, is_at_rounding: bool) -> Progress {
        let rate = correction / self.last;
        self.last = correction;
        // The remaining error is at most a geometric series of corrections at this rate.
        let left = rate / (1.0 - rate) * correction;
        let is_solved = rate < 1.0 && left <= f64::EPSILON * size;
        let is_fast = rate <= SLOW_CONVERGENCE;
        if !size.is_finite() {
            Progress::Lost
        } else if is_solved || is_at_rounding && !is_fast {
            Progress::Solved
        } else if rate > SLOW_CONVERGENCE {
            Progress::Slow
        } else {
            Progress::Fast
        }
    }
}

impl<V: Vector> Newton<V, 1> {
    /// Replaces `y` by the solution of `Y = y + c f(t, Y)`.
    pub(in crate::integrators) fn backward_euler(
        &mut self,
        system: &impl System<Vector = V>,
        t: f64,
        c: f64,
        y: &mut State<V>,
    ) -> Stepped {
        self.base[0].assign(y);
        self.base[0].q.add_scaled(c, &y.v);
        self.solve(system, &Stages { t: [t], alpha: [[c * c]], beta: [[c]] })?;
        y.v.add_scaled(c, &self.a[0]);
        y.q.add_scaled(c, &y.v);
        Ok(())
    }
}

impl<V: Vector, const S: usize> Newton<V, S> {
    pub(in crate::integrators) fn new(like: &V, coupling: Coupling) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        let vectors = || std::array::from_fn(|_| like.clone());
        let linearisation = Linearisation::new(like, coupling);
        let zeros = vec![0.0; S * like.components().len()];
        Self {
            base: std::array::from_fn(|_| state.clone()),
            a: vectors(),
            evaluated: vectors(),
            rounding_scale: if linearisation.is_matrix_free() { Vec::new() } else { zeros.clone() },
            linearisation,
            residual: zeros.clone(),
            correction: zeros.clone(),
            curve: SolutionCurve::new(like, zeros.len()),
            kept: zeros,
        }
    }

    /// Solves for the accelerations at the stages.
    pub(in crate::integrators) fn solve(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
    ) -> Stepped {
        for a in &mut self.a {
            a.components_mut().fill(0.0);
        }
        let is_solved = if self.linearisation.is_matrix_free() {
            self.iterate_sparsely(system, stages)
        } else {
            self.iterate(system, stages) || self.solve_by_continuation(system, stages)
        };
        if is_solved {
            return Ok(());
        }
        Err(StepFailure::NewtonFailed { limit: MAX_ITERATIONS })
    }

    /// Evaluates the forces at the current `A`.
    #[inline]
    fn evaluate(&mut self, system: &(impl System<Vector = V> + ?Sized), stages: &Stages<S>) {
        let Self { base, a, evaluated, linearisation, .. } = self;
        stages.evaluate(system, base, a, &mut linearisation.at, evaluated);
    }

    /// Iterates from the current `A`. Returns whether the iteration converged.
    #[inline(always)]
    fn iterate(&mut self, system: &(impl System<Vector = V> + ?Sized), stages: &Stages<S>) -> bool {
        let mut is_stale = true;
        let mut convergence = Convergence::BEGUN;
        for _ in 0..MAX_ITERATIONS {
            self.evaluate(system, stages);
            if is_stale {
                self.factor(system, stages, stages);
            }
            self.compute_residual();
            let is_at_rounding = self.is_at_rounding();
            self.correction.copy_from_slice(&self.residual);
            self.linearisation.solve(&mut self.correction);
            let (correction, size) = self.correct();
            is_stale = match convergence.judge(correction, size, is_at_rounding) {
                Progress::Solved => return true,
                Progress::Fast => false,
                Progress::Slow | Progress::Lost => true,
            };
        }
        false
    }

    /// Computes and factors the Jacobian at the current `A`, by differences suited to the weights of `whole`.
    // Two places call this function, so that without `inline(always)` it would not be inlined in the loop, which costs
    // a fourteenth of a step.
    #[inline(always)]
    fn factor(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        stages: &Stages<S>,
        whole: &Stages<S>,
    ) {
        let Self { base, a, evaluated, linearisation, rounding_scale, .. } = self;
        let most = |half: fn(&State<V>) -> &V| {
            base.iter().fold(0.0, |most: f64, base| most.max(largest(half(base).components())))
        };
        let v = most(|base| &base.v) / whole.beta[0][0].abs();
        let q = most(|base| &base.q) / whole.alpha[0][0];
        let near = v.max(largest_of(evaluated)).max(largest_of(a));
        let difference = (RELATIVE_DIFFERENCES.0 * near)
            .max(RELATIVE_DIFFERENCES.1 * q)
            .clamp(EXTREMES.0, EXTREMES.1);
        let size = v.max(q).min(EXTREMES.1);
        let n = rounding_scale.len() / S;
        for (scales, forces) in rounding_scale.chunks_exact_mut(n).zip(evaluated.iter()) {
            assert_length(forces.components().len(), n);
            let rows = scales.iter_mut().zip(forces.components());
            rows.for_each(|(scale, force)| *scale = force.abs());
        }
        linearisation.factor(system, stages, Some((evaluated, difference)), |row, slope| {
            rounding_scale[row] += slope.abs() * size;
        });
    }

    /// Overwrites the residual with the residual of the last evaluation.
    #[inline]
    fn compute_residual(&mut self) {
        let Self { a, evaluated, residual, .. } = self;
        let n = residual.len() / S;
        for (residual, (force, a)) in residual.chunks_exact_mut(n).zip(evaluated.iter().zip(a)) {
            let known = force.components().iter().zip(a.components());
            residual.iter_mut().zip(known).for_each(|(residual, (force, a))| *residual = force - a);
        }
    }

    /// Whether the residual is at rounding level.
    #[inline]
    fn is_at_rounding(&self) -> bool {
        let mut rows = self.residual.iter().zip(&self.rounding_scale);
        rows.all(|(residual, scale)| residual.abs() <= ROUND_OFF * scale + EXTREMES.0)
    }

    /// Adds the correction to `A`. Returns the largest component of the correction and that of `A`.
    #[inline]
    fn correct(&mut self) -> (f64, f64) {
        self.add_correction(1.0);
        (largest(&self.correction), largest_of(&self.a))
    }

    /// Adds `part` of the correction to `A`.
    #[inline]
    fn add_correction(&mut self, part: f64) {
        let n = self.correction.len() / S;
        for (a, correction) in self.a.iter_mut().zip(self.correction.chunks_exact(n)) {
            for (a, correction) in a.components_mut().iter_mut().zip(correction) {
                *a += part * correction;
            }
        }
    }

    /// Saves `A`.
    fn save_unknowns(&mut self) {
        let n = self.kept.len() / S;
        for (kept, a) in self.kept.chunks_exact_mut(n).zip(&self.a) {
            kept.copy_from_slice(a.components());
        }
    }

    /// Restores the saved `A`.
    fn restore_unknowns(&mut self) {
        let n = self.kept.len() / S;
        for (kept, a) in self.kept.chunks_exact(n).zip(&mut self.a) {
            a.components_mut().copy_from_slice(kept);
        }
    }
}
