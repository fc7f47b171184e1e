//! The iteration itself, and the equations that it solves.

use super::curve::Curve;
use crate::sim::integrators::shared::lu::Lu;
use crate::sim::system::{State, System, Vector};

/// Iterations in one step. Usual are 2 to 5; without a limit a force that jumps would hang.
pub(super) const MAX_ITERATIONS: u32 = 30;
/// An iteration that leaves more than this part of the error has a matrix that is too old.
const SLOW: f64 = 0.1;
/// How much a unit of round-off may have grown on its way through the force law.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Parts of an acceleration or velocity, and of a coordinate, by which the matrix's differences are taken.
/// The one is the cube root of round-off, where curvature and rounding weigh alike. The other is so much
/// less because a coordinate may be far from where its force is centred; in a force that is small beside
/// it, five digits are left.
const NUDGES: (f64, f64) = (6e-6, 1e-11);
/// What is small enough to be nothing, and large enough to be too much.
const EXTREMES: (f64, f64) = (1e-150, 1e150);

/// Solves `A_i = a(t_i, Q_i, V_i)` for all `S` stages at once, where `Q_i = q_i + Σ α_ij A_j` and
/// `V_i = v_i + Σ β_ij A_j`.
#[derive(Clone)]
pub(in crate::sim::integrators) struct Newton<V, const S: usize> {
    /// `q_i` and `v_i`, to be written before solving.
    pub(in crate::sim::integrators) known: [State<V>; S],
    /// `A_i`, after solving.
    pub(in crate::sim::integrators) a: [V; S],
    /// What the force law makes of `A`.
    pub(super) found: [V; S],
    /// What it makes of `A` with one component nudged.
    pub(super) nudged: [V; S],
    /// The state at which a stage is evaluated.
    pub(super) stage: State<V>,
    /// The derivatives of `A - found`.
    pub(super) matrix: Lu,
    /// `found - A`, and then the correction of `A`.
    pub(super) missing: Vec<f64>,
    /// The most by which `found` may be off for the rounding of its coordinates, in units of round-off.
    blur: Vec<f64>,
    /// For steps at which the iteration alone does not converge.
    pub(super) curve: Curve,
}

/// What is given: when the stages are, and the weights α and β of the accelerations in their coordinates
/// and velocities.
pub(in crate::sim::integrators) struct Stages<const S: usize> {
    pub(in crate::sim::integrators) t: [f64; S],
    pub(in crate::sim::integrators) alpha: [[f64; S]; S],
    pub(in crate::sim::integrators) beta: [[f64; S]; S],
}

impl<V: Vector, const S: usize> Newton<V, S> {
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        let vectors = || std::array::from_fn(|_| like.clone());
        let size = S * like.components().len();
        Self {
            known: std::array::from_fn(|_| state.clone()),
            a: vectors(),
            found: vectors(),
            nudged: vectors(),
            stage: state,
            matrix: Lu::new(size),
            missing: vec![0.0; size],
            blur: vec![0.0; size],
            curve: Curve::new(size),
        }
    }

    /// The memory that it takes beyond its own size and that of its coordinate vectors, in bytes.
    pub(in crate::sim::integrators) fn heap_bytes(&self) -> usize {
        let vectors = size_of_val(&self.missing[..]) + size_of_val(&self.blur[..]);
        self.matrix.heap_bytes() + self.curve.heap_bytes() + vectors
    }

    /// Iterates from the present `A`, and returns whether it converged.
    #[inline(always)]
    pub(super) fn iterate(&mut self, system: &impl System<Vector = V>, stages: &Stages<S>) -> bool {
        let mut is_coarse = true;
        // There is no rate before the second correction.
        let mut last = f64::NAN;
        for _ in 0..MAX_ITERATIONS {
            let Self { known, a, found, stage, .. } = self;
            stages.evaluate(system, known, a, stage, found);
            if is_coarse {
                self.linearise(system, stages, stages);
            }
            let is_rounded = self.subtract();
            self.matrix.solve(&mut self.missing);
            let (correction, size) = self.correct();

            let rate = correction / last;
            // What is left is at most a geometric series of corrections at this rate.
            let left = rate / (1.0 - rate) * correction;
            let is_solved = rate < 1.0 && left <= f64::EPSILON * size;
            let is_quick = rate <= SLOW;
            if size.is_finite() && (is_solved || is_rounded && !is_quick) {
                return true;
            }
            is_coarse = rate > SLOW;
            last = correction;
        }
        false
    }

    /// Writes and factors the matrix at the present `A`, by differences fit for the weights of `whole`.
    // Called from two places, it would be no part of the loop any more, which costs a fourteenth of a step.
    #[inline(always)]
    pub(super) fn linearise(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
        whole: &Stages<S>,
    ) {
        let Self { known, a, found, nudged, stage, matrix, blur, .. } = self;
        let v = largest(known.iter().flat_map(|known| known.v.components()));
        let q = largest(known.iter().flat_map(|known| known.q.components()));
        let (v, q) = (v / whole.beta[0][0].abs(), q / whole.alpha[0][0]);
        let near = v.max(largest(components(found))).max(largest(components(a)));
        let nudge = (NUDGES.0 * near).max(NUDGES.1 * q).clamp(EXTREMES.0, EXTREMES.1);
        let reach = v.max(q).min(EXTREMES.1);

        for (blur, found) in blur.iter_mut().zip(components(found)) {
            *blur = found.abs();
        }
        let n = blur.len() / S;
        for j in 0..blur.len() {
            let before = a[j / n].components()[j % n];
            let after = before + nudge;
            a[j / n].components_mut()[j % n] = after;
            stages.evaluate(system, known, a, stage, nudged);
            a[j / n].components_mut()[j % n] = before;

            let column = matrix.column_mut(j);
            let rows = components(nudged).zip(components(found)).zip(blur.iter_mut());
            for (entry, ((nudged, found), blur)) in column.iter_mut().zip(rows) {
                let slope = (nudged - found) / (after - before);
                *entry = -slope;
                *blur += slope.abs() * reach;
            }
            column[j] += 1.0;
        }
        matrix.factor();
    }

    /// Writes what is missing, and returns whether it is no more than rounding may make of nothing.
    #[inline]
    pub(super) fn subtract(&mut self) -> bool {
        let Self { a, found, missing, blur, .. } = self;
        let mut is_rounded = true;
        let rows = components(found).zip(components(a)).zip(blur.iter());
        for (missing, ((found, a), blur)) in missing.iter_mut().zip(rows) {
            *missing = found - a;
            is_rounded &= missing.abs() <= ROUND_OFF * blur + EXTREMES.0;
        }
        is_rounded
    }

    /// Adds the correction to `A`; returns the largest components of both.
    #[inline]
    fn correct(&mut self) -> (f64, f64) {
        let Self { a, missing, .. } = self;
        let rows = a.iter_mut().flat_map(V::components_mut);
        for (a, correction) in rows.zip(missing.iter()) {
            *a += correction;
        }
        (largest(missing.iter()), largest(components(a)))
    }
}

impl<const S: usize> Stages<S> {
    /// The same with all weights multiplied.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |weights: [[f64; S]; S]| weights.map(|row| row.map(|weight| factor * weight));
        Self { t: self.t, alpha: scaled(self.alpha), beta: scaled(self.beta) }
    }

    #[inline]
    pub(super) fn evaluate<V: Vector>(
        &self,
        system: &impl System<Vector = V>,
        known: &[State<V>; S],
        a: &[V; S],
        stage: &mut State<V>,
        found: &mut [V; S],
    ) {
        for i in 0..S {
            stage.assign(&known[i]);
            for ((alpha, beta), a) in self.alpha[i].iter().zip(&self.beta[i]).zip(a) {
                stage.q.add_scaled(*alpha, a);
                stage.v.add_scaled(*beta, a);
            }
            system.acceleration(self.t[i], &stage.q, &stage.v, &mut found[i]);
        }
    }
}

#[inline]
pub(super) fn components<V: Vector, const S: usize>(
    vectors: &[V; S],
) -> impl Iterator<Item = &f64> {
    vectors.iter().flat_map(V::components)
}

/// The largest magnitude; not a number where one of them is not.
#[inline]
pub(super) fn largest<'a>(components: impl Iterator<Item = &'a f64>) -> f64 {
    components.fold(0.0, |largest: f64, component| {
        let size = component.abs();
        if size > largest || size.is_nan() { size } else { largest }
    })
}
