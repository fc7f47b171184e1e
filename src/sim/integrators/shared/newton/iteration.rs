//! Newton's iteration, and the equations that it solves.

use super::curve::Curve;
use super::krylov::Krylov;
use super::stages::{Stages, components, largest};
use crate::sim::integrators::shared::lu::Lu;
use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// The largest number of iterations in one step. Usual are 2 to 5; without a limit a discontinuous
/// force would never end.
pub(super) const MAX_ITERATIONS: u32 = 30;
/// An iteration that reduces the error by less than this factor needs a new Jacobian.
const SLOW_CONVERGENCE: f64 = 0.1;
/// The residual at rounding level, relative to the rounding scale: how much a unit of round-off grows
/// in the force law.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Relative differences for the Jacobian, of accelerations and velocities, and of coordinates. The
/// first is the cube root of round-off, which balances truncation and rounding. The second is much
/// smaller because a coordinate may be far from the centre of its force.
const RELATIVE_DIFFERENCES: (f64, f64) = (6e-6, 1e-11);
/// The bounds of a difference: below underflow, above overflow.
const EXTREMES: (f64, f64) = (1e-150, 1e150);

/// Solves `A_i = a(t_i, Q_i, V_i)` for all `S` stages at once, where `Q_i = q_i + Σ α_ij A_j` and
/// `V_i = v_i + Σ β_ij A_j`.
#[derive(Clone)]
pub(in crate::sim::integrators) struct Newton<V, const S: usize> {
    /// `q_i` and `v_i`, set before solving.
    pub(in crate::sim::integrators) known: [State<V>; S],
    /// `A_i`, after solving.
    pub(in crate::sim::integrators) a: [V; S],
    /// The force law evaluated at `A`.
    pub(super) evaluated: [V; S],
    /// The force law evaluated with one component of `A` perturbed.
    pub(super) perturbed: [V; S],
    /// The state at which a stage is evaluated.
    pub(super) stage: State<V>,
    /// The Jacobian of `A - evaluated`, factored; empty for a sparse vector.
    pub(super) jacobian: Lu,
    /// Solves the linear equations of a sparse vector.
    pub(super) krylov: Option<Box<Krylov<V, S>>>,
    /// The residual `evaluated - A`, and then the correction of `A`.
    pub(super) residual: Vec<f64>,
    /// The scale of the rounding error of `evaluated`, in units of round-off.
    rounding_scale: Vec<f64>,
    /// For steps at which the iteration alone fails.
    pub(super) curve: Curve,
}

impl<V: Vector, const S: usize> Newton<V, S> {
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        let vectors = || std::array::from_fn(|_| like.clone());
        let size = S * like.components().len();
        Self {
            known: std::array::from_fn(|_| state.clone()),
            a: vectors(),
            evaluated: vectors(),
            perturbed: vectors(),
            stage: state,
            jacobian: Lu::new(if V::IS_SPARSE { 0 } else { size }),
            krylov: V::IS_SPARSE.then(|| Box::new(Krylov::new(like))),
            residual: vec![0.0; size],
            rounding_scale: vec![0.0; if V::IS_SPARSE { 0 } else { size }],
            curve: Curve::new(size),
        }
    }

    /// Memory in bytes, without its own size and that of its coordinate vectors.
    pub(in crate::sim::integrators) fn heap_bytes(&self) -> usize {
        let vectors = size_of_val(&self.residual[..]) + size_of_val(&self.rounding_scale[..]);
        let krylov = self.krylov.as_ref().map_or(0, |krylov| krylov.heap_bytes());
        self.jacobian.heap_bytes() + self.curve.heap_bytes() + vectors + krylov
    }

    /// Iterates from the current `A`. Returns whether it converged.
    #[inline(always)]
    pub(super) fn iterate(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        stages: &Stages<S>,
    ) -> bool {
        let mut is_stale = true;
        // No convergence rate is known before the second correction.
        let mut last = f64::NAN;
        for _ in 0..MAX_ITERATIONS {
            let Self { known, a, evaluated, stage, .. } = self;
            stages.evaluate(system, known, a, stage, evaluated);
            if is_stale {
                self.factor_jacobian(system, stages, stages);
            }
            let is_at_rounding = self.compute_residual();
            self.jacobian.solve(&mut self.residual);
            let (correction, size) = self.correct();

            let rate = correction / last;
            // The remaining error is at most a geometric series of corrections at this rate.
            let left = rate / (1.0 - rate) * correction;
            let is_solved = rate < 1.0 && left <= f64::EPSILON * size;
            let is_fast = rate <= SLOW_CONVERGENCE;
            if size.is_finite() && (is_solved || is_at_rounding && !is_fast) {
                return true;
            }
            is_stale = rate > SLOW_CONVERGENCE;
            last = correction;
        }
        false
    }

    /// Computes and factors the Jacobian at the current `A`, by differences suited to the weights of
    /// `whole`.
    // Without inlining it would leave the loop, because it is called from two places; that costs a
    // fourteenth of a step.
    #[inline(always)]
    pub(super) fn factor_jacobian(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        stages: &Stages<S>,
        whole: &Stages<S>,
    ) {
        let Self { known, a, evaluated, perturbed, stage, jacobian, rounding_scale, .. } = self;
        let v = largest(known.iter().flat_map(|known| known.v.components()));
        let q = largest(known.iter().flat_map(|known| known.q.components()));
        let (v, q) = (v / whole.beta[0][0].abs(), q / whole.alpha[0][0]);
        let near = v.max(largest(components(evaluated))).max(largest(components(a)));
        let difference = (RELATIVE_DIFFERENCES.0 * near)
            .max(RELATIVE_DIFFERENCES.1 * q)
            .clamp(EXTREMES.0, EXTREMES.1);
        let size = v.max(q).min(EXTREMES.1);

        for (rounding_scale, evaluated) in rounding_scale.iter_mut().zip(components(evaluated)) {
            *rounding_scale = evaluated.abs();
        }
        let n = rounding_scale.len() / S;
        for j in 0..rounding_scale.len() {
            let before = a[j / n].components()[j % n];
            let after = before + difference;
            a[j / n].components_mut()[j % n] = after;
            stages.evaluate(system, known, a, stage, perturbed);
            a[j / n].components_mut()[j % n] = before;

            let column = jacobian.column_mut(j);
            let rows =
                components(perturbed).zip(components(evaluated)).zip(rounding_scale.iter_mut());
            for (entry, ((perturbed, evaluated), rounding_scale)) in column.iter_mut().zip(rows) {
                let slope = (perturbed - evaluated) / (after - before);
                *entry = -slope;
                *rounding_scale += slope.abs() * size;
            }
            column[j] += 1.0;
        }
        jacobian.factor();
    }

    /// Computes the residual. Returns whether it is at rounding level.
    #[inline]
    pub(super) fn compute_residual(&mut self) -> bool {
        let Self { a, evaluated, residual, rounding_scale, .. } = self;
        let mut is_at_rounding = true;
        let rows = components(evaluated).zip(components(a)).zip(rounding_scale.iter());
        for (residual, ((evaluated, a), rounding_scale)) in residual.iter_mut().zip(rows) {
            *residual = evaluated - a;
            is_at_rounding &= residual.abs() <= ROUND_OFF * rounding_scale + EXTREMES.0;
        }
        is_at_rounding
    }

    /// Adds the correction to `A`. Returns the largest components of both.
    #[inline]
    fn correct(&mut self) -> (f64, f64) {
        let Self { a, residual, .. } = self;
        let rows = a.iter_mut().flat_map(V::components_mut);
        for (a, correction) in rows.zip(residual.iter()) {
            *a += correction;
        }
        (largest(residual.iter()), largest(components(a)))
    }
}
