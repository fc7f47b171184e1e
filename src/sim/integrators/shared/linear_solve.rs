//! The linear equations of a method that solves them once per step: `(I - α ∂a/∂q - β ∂a/∂v) x = b`.
//!
//! The matrix is factored, or for a [sparse vector](Vector::IS_SPARSE) never formed: its equations are
//! solved by iteration.

use super::lu::Lu;
use super::newton::{Krylov, Stages};
use super::slopes::Slopes;
use crate::sim::integrators::failure::StepFailure;
use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// The residual to which an iteration solves, relative to the right-hand side.
const TOLERANCE: f64 = 1e-10;

/// The matrix, and scratch to solve by it.
#[derive(Clone)]
pub(in crate::sim::integrators) struct LinearSolve<V> {
    pub(in crate::sim::integrators) slopes: Slopes<V>,
    along: State<V>,
    slope: V,
    matrix: Lu,
    /// Solves without the matrix, for a sparse vector.
    iteration: Option<Box<Iteration<V>>>,
}

/// The iteration, the state that it linearises at, no acceleration there, and the right-hand side.
#[derive(Clone)]
struct Iteration<V> {
    krylov: Krylov<V, 1>,
    at: [State<V>; 1],
    still: [V; 1],
    b: Vec<f64>,
}

impl<V: Vector> Iteration<V> {
    fn new(zero: &State<V>) -> Self {
        Self {
            krylov: Krylov::new(&zero.q),
            at: [zero.clone()],
            still: [zero.q.clone()],
            b: zero.q.components().to_vec(),
        }
    }

    /// Memory in bytes.
    fn bytes(&self) -> usize {
        let vectors = 3 * self.still[0].heap_bytes() + size_of_val(&self.b[..]);
        // Its own size is in the first.
        size_of::<Self>() - size_of::<Krylov<V, 1>>() + self.krylov.heap_bytes() + vectors
    }

    fn solve(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<1>,
        y: &State<V>,
        x: &mut V,
    ) -> Result<(), StepFailure> {
        let Self { krylov, at, still, b } = self;
        at[0].assign(y);
        krylov.begin_step();
        krylov.linearise(stages, at, still);
        b.copy_from_slice(x.components());
        krylov.solve(system, TOLERANCE, b);
        x.components_mut().copy_from_slice(b);
        if krylov.is_spent() { Err(StepFailure::Unsolved) } else { Ok(()) }
    }
}

impl<V: Vector> LinearSolve<V> {
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        let mut zero = State { q: like.clone(), v: like.clone() };
        zero.q.components_mut().fill(0.0);
        zero.v.components_mut().fill(0.0);
        let n = like.components().len();
        Self {
            slopes: Slopes::new(like),
            slope: like.clone(),
            matrix: Lu::new(if V::IS_SPARSE { 0 } else { n }),
            iteration: V::IS_SPARSE.then(|| Box::new(Iteration::new(&zero))),
            along: zero,
        }
    }

    /// Memory in bytes, without its own size and that of its coordinate vectors.
    pub(in crate::sim::integrators) fn heap_bytes(&self) -> usize {
        let iteration = self.iteration.as_ref().map_or(0, |iteration| iteration.bytes());
        self.matrix.heap_bytes() + iteration
    }

    /// Adds `times` the derivative of the acceleration at `y` in the direction `(along, 0)` to `x`.
    pub(in crate::sim::integrators) fn add_slope(
        &mut self,
        system: &dyn System<Vector = V>,
        t: f64,
        y: &State<V>,
        times: f64,
        along: &V,
        x: &mut V,
    ) {
        self.along.q.assign(along);
        self.along.v.components_mut().fill(0.0);
        self.slopes.take(system, t, y, &self.along, &mut self.slope);
        x.add_scaled(times, &self.slope);
    }

    /// Overwrites the right-hand side `x` with the solution of `(I - α ∂a/∂q - β ∂a/∂v) x' = x`, with the
    /// derivatives at `t` and `y`. A singular matrix gives values that are not finite.
    ///
    /// # Errors
    /// [`StepFailure::Unsolved`] if the iteration for a sparse vector comes to no end.
    pub(in crate::sim::integrators) fn solve(
        &mut self,
        system: &dyn System<Vector = V>,
        t: f64,
        y: &State<V>,
        [alpha, beta]: [f64; 2],
        x: &mut V,
    ) -> Result<(), StepFailure> {
        if let Some(iteration) = &mut self.iteration {
            let stages = Stages { t: [t], alpha: [[alpha]], beta: [[beta]] };
            return iteration.solve(system, &stages, y, x);
        }
        let Self { slopes, along, slope, matrix, .. } = self;
        along.q.components_mut().fill(0.0);
        along.v.components_mut().fill(0.0);
        for j in 0..x.components().len() {
            along.q.components_mut()[j] = alpha;
            along.v.components_mut()[j] = beta;
            slopes.take(system, t, y, along, slope);
            along.q.components_mut()[j] = 0.0;
            along.v.components_mut()[j] = 0.0;
            let column = matrix.column_mut(j);
            for (entry, slope) in column.iter_mut().zip(slope.components()) {
                *entry = -slope;
            }
            column[j] += 1.0;
        }
        matrix.factor();
        matrix.solve(x.components_mut());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::points::Points;

    /// Springs apart from each other, all equal or each stiffer than the last.
    struct Apart {
        stiffer: f64,
    }

    impl System for Apart {
        type Vector = Points;
        fn acceleration(&self, _t: f64, q: &Points, v: &Points, a: &mut Points) {
            for (i, a) in a.0.iter_mut().enumerate() {
                *a = -(9.0 + self.stiffer * i as f64) * q.0[i] - 0.4 * v.0[i];
            }
        }
    }

    #[test]
    fn a_sparse_vector_is_solved_even_where_all_products_point_one_way() {
        let start: Vec<f64> = (0..8).map(|i| 1.0 - 0.3 * f64::from(i)).collect();
        let y = State { q: Points(start.clone()), v: Points(start.clone()) };
        let [alpha, beta] = [0.01, 0.1];
        for stiffer in [0.0, 2.0] {
            let mut equations = LinearSolve::new(&y.q);
            let mut x = Points(start.clone());
            equations.slopes.reach_for(0.1, &y, &y.q);
            equations.solve(&Apart { stiffer }, 0.0, &y, [alpha, beta], &mut x).unwrap();
            for (i, (x, b)) in x.0.iter().zip(&start).enumerate() {
                let wanted = b / (1.0 + alpha * (9.0 + stiffer * i as f64) + beta * 0.4);
                assert!((x - wanted).abs() < 1e-7, "{i}: {x}, not {wanted}");
            }
        }
    }
}
