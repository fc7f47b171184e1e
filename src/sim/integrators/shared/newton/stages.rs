//! The stages of an implicit method, whose accelerations are the unknowns.

use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// The times of the stages, and the weights α and β of the accelerations in their coordinates and
/// velocities.
#[derive(Clone, Copy)]
pub(in crate::sim::integrators) struct Stages<const S: usize> {
    pub(in crate::sim::integrators) t: [f64; S],
    pub(in crate::sim::integrators) alpha: [[f64; S]; S],
    pub(in crate::sim::integrators) beta: [[f64; S]; S],
}

impl<const S: usize> Stages<S> {
    /// The stages with all weights multiplied by `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |weights: [[f64; S]; S]| weights.map(|row| row.map(|weight| factor * weight));
        Self { t: self.t, alpha: scaled(self.alpha), beta: scaled(self.beta) }
    }

    /// Overwrites `stage` with the state at stage `i`.
    #[inline]
    pub(super) fn place<V: Vector>(
        &self,
        i: usize,
        known: &[State<V>; S],
        a: &[V; S],
        stage: &mut State<V>,
    ) {
        stage.assign(&known[i]);
        for ((alpha, beta), a) in self.alpha[i].iter().zip(&self.beta[i]).zip(a) {
            stage.q.add_scaled(*alpha, a);
            stage.v.add_scaled(*beta, a);
        }
    }

    #[inline]
    pub(super) fn evaluate<V: Vector>(
        &self,
        system: &(impl System<Vector = V> + ?Sized),
        known: &[State<V>; S],
        a: &[V; S],
        stage: &mut State<V>,
        evaluated: &mut [V; S],
    ) {
        for (i, evaluated) in evaluated.iter_mut().enumerate() {
            self.place(i, known, a, stage);
            system.acceleration(self.t[i], &stage.q, &stage.v, evaluated);
        }
    }
}

#[inline]
pub(super) fn components<V: Vector, const S: usize>(
    vectors: &[V; S],
) -> impl Iterator<Item = &f64> {
    vectors.iter().flat_map(V::components)
}

/// The largest magnitude; NaN if a component is NaN.
#[inline]
pub(in crate::sim::integrators) fn largest<'a>(components: impl Iterator<Item = &'a f64>) -> f64 {
    components.fold(0.0, |largest: f64, component| {
        let size = component.abs();
        if size > largest || size.is_nan() { size } else { largest }
    })
}
