//! The derivatives of the acceleration by coordinates and by velocities, and their products with vectors.
//!
//! They are kept as matrices, or for a [sparse vector](Vector::IS_SPARSE) taken along each vector.

use super::newton::largest;
use super::slopes::Slopes;
use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// Safety factor that turns max|J·(±1, …)| into a bound on ‖J‖∞.
const SPARSE_NORM: f64 = 2.0;

/// `∂a/∂q` and `∂a/∂v` at a state.
#[derive(Clone)]
pub(in crate::sim::integrators) struct Jacobian<V> {
    slopes: Slopes<V>,
    t: f64,
    at: State<V>,
    along: State<V>,
    slope: V,
    /// Column by column; empty if it is not asked for, or of a sparse vector.
    by_q: Vec<f64>,
    by_v: Vec<f64>,
}

impl<V: Vector> Jacobian<V> {
    /// For both derivatives.
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        let by_v = Self::by_velocity(like);
        Self { by_q: by_v.by_v.clone(), ..by_v }
    }

    /// For `∂a/∂v` alone.
    pub(in crate::sim::integrators) fn by_velocity(like: &V) -> Self {
        let n = if V::IS_SPARSE { 0 } else { like.components().len() };
        let state = State { q: like.clone(), v: like.clone() };
        Self {
            slopes: Slopes::new(like),
            t: 0.0,
            at: state.clone(),
            along: state,
            slope: like.clone(),
            by_q: Vec::new(),
            by_v: vec![0.0; n * n],
        }
    }

    /// Memory in bytes, without its own size and that of its coordinate vectors.
    pub(in crate::sim::integrators) fn heap_bytes(&self) -> usize {
        size_of_val(&self.by_q[..]) + size_of_val(&self.by_v[..])
    }

    /// Takes the derivatives at `t` and `y`, where the acceleration is `a`, for a step of `h`.
    pub(in crate::sim::integrators) fn take(
        &mut self,
        system: &dyn System<Vector = V>,
        t: f64,
        h: f64,
        y: &State<V>,
        a: &V,
    ) {
        let Self { slopes, at, along, slope, by_q, by_v, .. } = self;
        self.t = t;
        at.assign(y);
        slopes.reach_for(h, y, a);
        let n = slope.components().len();
        along.q.components_mut().fill(0.0);
        along.v.components_mut().fill(0.0);
        for (j, column) in by_q.chunks_exact_mut(n).enumerate() {
            along.q.components_mut()[j] = 1.0;
            slopes.take(system, t, at, along, slope);
            along.q.components_mut()[j] = 0.0;
            column.copy_from_slice(slope.components());
        }
        for (j, column) in by_v.chunks_exact_mut(n).enumerate() {
            along.v.components_mut()[j] = 1.0;
            slopes.take(system, t, at, along, slope);
            along.v.components_mut()[j] = 0.0;
            column.copy_from_slice(slope.components());
        }
    }

    /// `∂a/∂q q + ∂a/∂v v`. An empty `q` stands for 0.
    pub(in crate::sim::integrators) fn times(
        &mut self,
        system: &dyn System<Vector = V>,
        q: &[f64],
        v: &[f64],
    ) -> &V {
        let Self { slopes, t, at, along, slope, by_q, by_v } = self;
        if V::IS_SPARSE {
            let there = along.q.components_mut();
            if q.is_empty() {
                there.fill(0.0)
            } else {
                there.copy_from_slice(q)
            }
            along.v.components_mut().copy_from_slice(v);
            slopes.take(system, *t, at, along, slope);
            return slope;
        }
        let sums = slope.components_mut();
        sums.fill(0.0);
        let n = sums.len();
        let columns = by_q.chunks_exact(n).zip(q).chain(by_v.chunks_exact(n).zip(v));
        for (column, x) in columns {
            sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * x);
        }
        slope
    }

    /// Bounds of the largest row sums of `∂a/∂q` and of `∂a/∂v`.
    pub(in crate::sim::integrators) fn norms(
        &mut self,
        system: &dyn System<Vector = V>,
    ) -> [f64; 2] {
        let Self { slopes, t, at, along, slope, by_q, by_v } = self;
        if V::IS_SPARSE {
            return [true, false].map(|is_by_q| {
                along.q.components_mut().fill(0.0);
                along.v.components_mut().fill(0.0);
                let part = if is_by_q { &mut along.q } else { &mut along.v };
                for (i, x) in part.components_mut().iter_mut().enumerate() {
                    *x = if i / 2 % 2 == 0 { 1.0 } else { -1.0 };
                }
                slopes.take(system, *t, at, along, slope);
                SPARSE_NORM * largest(slope.components().iter())
            });
        }
        [by_q, by_v].map(|matrix| {
            let sums = slope.components_mut();
            sums.fill(0.0);
            for column in matrix.chunks_exact(sums.len()) {
                sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry.abs());
            }
            largest(slope.components().iter())
        })
    }
}
