//! The derivatives of the acceleration with respect to coordinates and velocities, and their products with vectors.
//!
//! The derivatives are stored as matrices. For [`Coupling::Few`], directional derivatives are computed on demand
//! instead.

use super::linearisation::alternate;
use super::slopes::{Slopes, comb};
use crate::state::{State, Vector, largest};
use crate::system::{Coupling, System};

/// The safety factor that turns max|J·(±1, …)| into a bound on ‖J‖∞.
const SPARSE_NORM: f64 = 2.0;

/// `∂a/∂q` and `∂a/∂v` at a state.
#[derive(Clone)]
pub(in crate::integrators) struct Jacobian<V> {
    slopes: Slopes<V>,
    t: f64,
    at: State<V>,
    along: State<V>,
    slope: V,
    /// The largest distance of an entry from the diagonal; `None` if no matrix is kept.
    reach: Option<usize>,
    /// The [rows](rows()) kept of each column, column by column. `da_dq` is empty for a Jacobian by velocity alone.
    da_dq: Vec<f64>,
    da_dv: Vec<f64>,
}

/// Returns the first row and the number of rows kept in column `j` of `n`.
#[inline]
fn rows(j: usize, reach: usize, n: usize) -> (usize, usize) {
    let height = n.min(2 * reach + 1);
    (j.saturating_sub(reach).min(n - height), height)
}

impl<V: Vector> Jacobian<V> {
    /// Returns a Jacobian with both derivatives.
    pub(in crate::integrators) fn new(like: &V, coupling: Coupling) -> Self {
        let by_v = Self::by_velocity(like, coupling);
        Self { da_dq: by_v.da_dv.clone(), ..by_v }
    }

    /// Returns a Jacobian with `∂a/∂v` alone.
    pub(in crate::integrators) fn by_velocity(like: &V, coupling: Coupling) -> Self {
        let n = like.components().len();
        let reach = coupling.reach(n);
        let entries = reach.map_or(0, |reach| n * rows(0, reach, n).1);
        let state = State { q: like.clone(), v: like.clone() };
        Self {
            slopes: Slopes::new(like),
            t: 0.0,
            at: state.clone(),
            along: state,
            slope: like.clone(),
            reach,
            da_dq: Vec::new(),
            da_dv: vec![0.0; entries],
        }
    }

    /// Computes the derivatives at `t` and `y`, where the acceleration is `a`, for a step of `h`.
    #[inline]
    pub(in crate::integrators) fn compute(
        &mut self,
        system: &impl System<Vector = V>,
        t: f64,
        h: f64,
        y: &State<V>,
        a: &V,
    ) {
        let Self { slopes, at, along, slope, da_dq, da_dv, .. } = self;
        self.t = t;
        at.assign(y);
        slopes.reach_for(h, y, a);
        let Some(reach) = self.reach else { return };
        let n = a.components().len();
        let apart = n.min(2 * reach + 1);
        for (is_by_v, matrix) in
            [da_dq, da_dv].into_iter().enumerate().filter(|(_, m)| !m.is_empty())
        {
            for begin in 0..apart {
                let by_v = is_by_v as u32;
                comb(&mut along.q, begin, apart, f64::from(1 - by_v));
                comb(&mut along.v, begin, apart, f64::from(by_v));
                slopes.differentiate(system, t, at, along, None, slope);
                for j in (begin..n).step_by(apart) {
                    let (first, height) = rows(j, reach, n);
                    let column = &mut matrix[j * height..][..height];
                    for (row, entry) in (first..).zip(column) {
                        let is_reached = row.abs_diff(j) <= reach;
                        *entry = if is_reached { slope.components()[row] } else { 0.0 };
                    }
                }
            }
        }
    }

    /// Returns `∂a/∂q` and `∂a/∂v` of a system of one coordinate.
    #[inline]
    pub(in crate::integrators) fn of_one(&self) -> [f64; 2] {
        [self.da_dq.first().copied().unwrap_or(0.0), self.da_dv[0]]
    }

    /// Returns `∂a/∂q q + ∂a/∂v v`. An empty `q` counts as 0.
    #[inline]
    pub(in crate::integrators) fn times(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        q: &[f64],
        v: &[f64],
    ) -> &V {
        let Self { slopes, t, at, along, slope, reach, da_dq, da_dv } = self;
        let Some(reach) = *reach else {
            let there = along.q.components_mut();
            if q.is_empty() {
                there.fill(0.0)
            } else {
                there.copy_from_slice(q)
            }
            along.v.components_mut().copy_from_slice(v);
            slopes.differentiate(system, *t, at, along, None, slope);
            return slope;
        };
        let sums = slope.components_mut();
        sums.fill(0.0);
        let n = sums.len();
        for (matrix, x) in [(da_dq, q), (da_dv, v)] {
            for (j, x) in x.iter().enumerate() {
                let (first, height) = rows(j, reach, n);
                let column = &matrix[j * height..][..height];
                sums[first..].iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * x);
            }
        }
        slope
    }

    /// Returns bounds on the largest row sums of `∂a/∂q` and of `∂a/∂v`.
    pub(in crate::integrators) fn norms(&mut self, system: &dyn System<Vector = V>) -> [f64; 2] {
        let Self { slopes, t, at, along, slope, reach, da_dq, da_dv } = self;
        let Some(reach) = *reach else {
            return [true, false].map(|is_by_q| {
                along.q.components_mut().fill(0.0);
                along.v.components_mut().fill(0.0);
                let part = if is_by_q { &mut along.q } else { &mut along.v };
                alternate(part, 1.0);
                slopes.differentiate(system, *t, at, along, None, slope);
                SPARSE_NORM * largest(slope.components())
            });
        };
        [da_dq, da_dv].map(|matrix| {
            let sums = slope.components_mut();
            sums.fill(0.0);
            let (_, height) = rows(0, reach, sums.len());
            for (j, column) in matrix.chunks_exact(height).enumerate() {
                let (first, _) = rows(j, reach, sums.len());
                let sums = sums[first..].iter_mut().zip(column);
                sums.for_each(|(sum, entry)| *sum += entry.abs());
            }
            largest(slope.components())
        })
    }
}
