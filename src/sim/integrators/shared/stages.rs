//! The stages of an implicit method, whose accelerations are the unknowns.

use crate::state::{State, Vector, largest};
use crate::system::System;

/// The times of the stages, and the weights α and β of the accelerations in the coordinates and velocities of the
/// stages.
#[derive(Clone, Copy)]
pub(in crate::integrators) struct Stages<const S: usize> {
    pub(in crate::integrators) t: [f64; S],
    pub(in crate::integrators) alpha: [[f64; S]; S],
    pub(in crate::integrators) beta: [[f64; S]; S],
}

impl<const S: usize> Stages<S> {
    /// Returns the stages with all weights multiplied by `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |weights: [[f64; S]; S]| weights.map(|row| row.map(|weight| factor * weight));
        Self { t: self.t, alpha: scaled(self.alpha), beta: scaled(self.beta) }
    }

    /// Overwrites `at` with the states at the stages, and `evaluated` with the forces at these states.
    #[inline]
    pub(super) fn evaluate<V: Vector>(
        &self,
        system: &(impl System<Vector = V> + ?Sized),
        base: &[State<V>; S],
        a: &[V; S],
        at: &mut [State<V>; S],
        evaluated: &mut [V; S],
    ) {
        for (i, evaluated) in evaluated.iter_mut().enumerate() {
            let at = &mut at[i];
            at.assign(&base[i]);
            for ((alpha, beta), a) in self.alpha[i].iter().zip(&self.beta[i]).zip(a) {
                at.q.add_scaled(*alpha, a);
                at.v.add_scaled(*beta, a);
            }
            system.acceleration(self.t[i], &at.q, &at.v, evaluated);
        }
    }
}

/// Returns the largest magnitude over all stages; NaN if a component is NaN.
#[inline]
pub(super) fn largest_of<V: Vector, const S: usize>(vectors: &[V; S]) -> f64 {
    let bits = vectors.iter().map(|vector| largest(vector.components()).to_bits());
    f64::from_bits(bits.fold(0, u64::max))
}
