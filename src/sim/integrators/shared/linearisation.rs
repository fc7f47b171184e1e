//! Linearises the forces of a step at its stages, and solves the linear equations `X - ∂a/∂A X = b` for the
//! accelerations at the stages.
//!
//! The matrix is factored, as a band if each coordinate depends only on its neighbours. If each coordinate depends on
//! [few](Coupling::Few) others at any index, the matrix is never formed, and iteration solves the equations. A method
//! learns the derivatives of a force only as [slopes](Slopes) along directions.

use super::krylov::{Krylov, add};
use super::lu::StageLu;
use super::slopes::{Forward, Slopes, comb};
use super::stages::Stages;
use crate::integrators::failure::{StepFailure, Stepped};
use crate::state::{State, Vector, largest};
use crate::system::{Coupling, System};

/// The residual at which an iteration has solved the equations of a step, relative to the right-hand side.
const TOLERANCE: f64 = 1e-10;

/// The states at the stages of a step, and the slopes of the forces there.
#[derive(Clone)]
pub(in crate::integrators) struct Linearisation<V, const S: usize> {
    /// The states at which the forces are linearised.
    pub(in crate::integrators) at: [State<V>; S],
    pub(in crate::integrators) slopes: Slopes<V>,
    along: State<V>,
    slope: V,
    /// The matrix of a single equation.
    alone: f64,
    /// The factored matrix; `None` if the matrix is not formed, or is a single number.
    matrix: Option<StageLu>,
    /// The solver without a matrix.
    krylov: Option<Box<Krylov>>,
}

impl<V: Vector, const S: usize> Linearisation<V, S> {
    pub(in crate::integrators) fn new(like: &V, coupling: Coupling) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        let n = like.components().len();
        let reach = coupling.reach(n);
        Self {
            at: std::array::from_fn(|_| state.clone()),
            slopes: Slopes::new(like),
            along: state,
            slope: like.clone(),
            alone: 1.0,
            matrix: reach.filter(|_| S * n > 1).map(|reach| StageLu::new(S, n, reach)),
            krylov: reach.is_none().then(|| Box::new(Krylov::new(S * n))),
        }
    }

    /// Whether equations are solved without a matrix.
    pub(super) fn is_matrix_free(&self) -> bool {
        self.krylov.is_some()
    }

    /// Forms and factors the matrix. If `forward` gives the forces evaluated at the stages and a displacement in units
    /// of `A`, the slopes are [forward](Forward) differences from these forces. Calls `see` with the row and value of
    /// each entry of `∂a/∂A` that may be nonzero.
    #[inline(always)]
    pub(super) fn factor(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        stages: &Stages<S>,
        forward: Option<(&[V; S], f64)>,
        mut see: impl FnMut(usize, f64),
    ) {
        let Self { at, slopes, along, slope, alone, matrix, .. } = self;
        let mut take = |s: usize, i: usize, first: usize, apart: usize, slope: &mut V| {
            comb(&mut along.q, first, apart, stages.alpha[i][s]);
            comb(&mut along.v, first, apart, stages.beta[i][s]);
            let forward = forward.map(|(from, part)| Forward { from: &from[i], part });
            slopes.differentiate(system, stages.t[i], &at[i], along, forward, slope);
        };
        let Some(matrix) = matrix else {
            take(0, 0, 0, 1, slope);
            let slope = slope.components()[0];
            see(0, slope);
            *alone = 1.0 - slope;
            return;
        };
        // Coordinates that act on different coordinates are displaced together.
        let apart = matrix.independent_stride();
        matrix.clear_matrix();
        for s in 0..S {
            for first in 0..apart {
                for i in 0..S {
                    take(s, i, first, apart, slope);
                    matrix.add_slopes([s, first], i, slope.components(), &mut see);
                }
            }
        }
        matrix.lu.factor();
    }

    /// Overwrites the right-hand side `x` with the solution by the last factored matrix. A singular matrix gives
    /// values that are not finite.
    #[inline]
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        match &mut self.matrix {
            Some(matrix) => matrix.solve(x),
            None => x[0] /= self.alone,
        }
    }

    /// Resets the iterations' budget of products for a new step.
    pub(super) fn begin_step(&mut self) {
        if let Some(krylov) = &mut self.krylov {
            krylov.begin_step();
        }
    }

    /// Whether the iterations of the step have no products left.
    pub(super) fn is_spent(&self) -> bool {
        self.krylov.as_ref().is_some_and(|krylov| krylov.is_spent())
    }

    /// Overwrites the right-hand side `b` with the solution by iteration, as [`Krylov::solve`] does.
    pub(super) fn iterate(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
        tolerance: f64,
        b: &mut [f64],
    ) {
        self.with_products(system, stages, |krylov, matrix| krylov.solve(matrix, tolerance, b));
    }

    /// Overwrites the residual `b` with a descent direction of the energy, as [`Krylov::descend`] does.
    pub(super) fn descend(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
        b: &mut [f64],
    ) -> bool {
        self.with_products(system, stages, |krylov, matrix| krylov.descend(matrix, b))
    }

    fn with_products<T>(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<S>,
        work: impl FnOnce(&mut Krylov, &mut dyn FnMut(&[f64], &mut [f64])) -> T,
    ) -> T {
        let Self { at, slopes, along, slope, krylov, .. } = self;
        let krylov = krylov.as_mut().expect("only what forms no matrix iterates");
        let n = slope.components().len();
        work(krylov, &mut |x, y| {
            for (i, y) in y.chunks_exact_mut(n).enumerate() {
                along.q.components_mut().fill(0.0);
                along.v.components_mut().fill(0.0);
                let weights = stages.alpha[i].iter().zip(&stages.beta[i]);
                for ((alpha, beta), x) in weights.zip(x.chunks_exact(n)) {
                    add(along.q.components_mut(), *alpha, x);
                    add(along.v.components_mut(), *beta, x);
                }
                slopes.differentiate(system, stages.t[i], &at[i], along, None, slope);
                let x = &x[i * n..];
                for ((y, x), slope) in y.iter_mut().zip(x).zip(slope.components()) {
                    *y = x - slope;
                }
            }
        })
    }

    /// Returns the largest change of an acceleration at the first stage when neighbours are displaced by ±`distance`.
    /// This estimates the stiffness of the stiffest mode.
    pub(super) fn largest_change(
        &mut self,
        system: &dyn System<Vector = V>,
        t: f64,
        distance: f64,
    ) -> f64 {
        let Self { at, slopes, along, slope, .. } = self;
        alternate(&mut along.q, distance);
        along.v.components_mut().fill(0.0);
        slopes.differentiate(system, t, &at[0], along, None, slope);
        largest(slope.components())
    }
}

impl<V: Vector> Linearisation<V, 1> {
    /// Adds `times` the derivative of the acceleration at `y` in the direction `(along, 0)` to `x`.
    #[inline]
    pub(in crate::integrators) fn add_slope(
        &mut self,
        system: &impl System<Vector = V>,
        t: f64,
        y: &State<V>,
        times: f64,
        along: &V,
        x: &mut V,
    ) {
        self.along.q.assign(along);
        self.along.v.components_mut().fill(0.0);
        self.slopes.differentiate(system, t, y, &self.along, None, &mut self.slope);
        x.add_scaled(times, &self.slope);
    }

    /// Overwrites the right-hand side `x` with the solution of `(I - α ∂a/∂q - β ∂a/∂v) x' = x`, with the derivatives
    /// at `t` and `y`. A singular matrix gives values that are not finite.
    ///
    /// # Errors
    /// [`StepFailure::LinearSolveFailed`] if an iteration does not converge.
    #[inline]
    pub(in crate::integrators) fn solve_at(
        &mut self,
        system: &impl System<Vector = V>,
        t: f64,
        y: &State<V>,
        [alpha, beta]: [f64; 2],
        x: &mut V,
    ) -> Stepped {
        self.at[0].assign(y);
        let stages = Stages { t: [t], alpha: [[alpha]], beta: [[beta]] };
        if x.components().len() == 1 {
            self.factor(system, &stages, None, |_, _| ());
            self.solve(x.components_mut());
            return Ok(());
        }
        self.solve_together(system, &stages, x)
    }

    /// Solves as [`Self::solve_at`] does, for several coordinates. It is compiled once for all systems.
    fn solve_together(
        &mut self,
        system: &dyn System<Vector = V>,
        stages: &Stages<1>,
        x: &mut V,
    ) -> Stepped {
        if self.is_matrix_free() {
            self.begin_step();
            self.iterate(system, stages, TOLERANCE, x.components_mut());
            return if self.is_spent() { Err(StepFailure::LinearSolveFailed) } else { Ok(()) };
        }
        self.factor(system, stages, None, |_, _| ());
        self.solve(x.components_mut());
        Ok(())
    }
}

/// Overwrites the coordinates of points in a plane with ±`distance`, so that neighbours move apart.
pub(super) fn alternate<V: Vector>(x: &mut V, distance: f64) {
    for (i, x) in x.components_mut().iter_mut().enumerate() {
        *x = if i / 2 % 2 == 0 { distance } else { -distance };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyClass;
    use crate::integrators::{AnySystem, Family, METHODS, any_integrator};

    /// Separate springs, which are all equal, or each stiffer than the one before.
    struct Apart {
        stiffness: f64,
        stiffer: f64,
        damping: f64,
    }

    impl System for Apart {
        type Vector = Vec<f64>;
        fn coupling(&self) -> Coupling {
            Coupling::Few
        }
        fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
            for (i, a) in a.iter_mut().enumerate() {
                *a = -(self.stiffness + self.stiffer * i as f64) * q[i] - self.damping * v[i];
            }
        }
    }

    #[test]
    fn a_sparse_system_is_solved_even_if_all_products_are_parallel() {
        let start: Vec<f64> = (0..8).map(|i| 1.0 - 0.3 * f64::from(i)).collect();
        let y = State { q: start.clone(), v: start.clone() };
        let [alpha, beta] = [0.01, 0.1];
        for stiffer in [0.0, 2.0] {
            let mut equations = Linearisation::<_, 1>::new(&y.q, Coupling::Few);
            let mut x = start.clone();
            equations.slopes.reach_for(0.1, &y, &y.q);
            let apart = Apart { stiffness: 9.0, stiffer, damping: 0.4 };
            equations.solve_at(&apart, 0.0, &y, [alpha, beta], &mut x).unwrap();
            for (i, (x, b)) in x.iter().zip(&start).enumerate() {
                let wanted = b / (1.0 + alpha * (9.0 + stiffer * i as f64) + beta * 0.4);
                assert!((x - wanted).abs() < 1e-7, "{i}: {x}, not {wanted}");
            }
        }
    }

    #[test]
    fn a_sparse_system_decays_until_nothing_is_left_of_it() {
        let start: Vec<f64> = (0..8).map(|i| 1e-60 * (1.0 - 0.3 * f64::from(i))).collect();
        for stiffer in [0.0, 2.0] {
            let apart = Apart { stiffness: 100.0, stiffer, damping: 20.0 };
            for method in METHODS {
                if !matches!(method.family, Family::Implicit | Family::Linearised) {
                    continue;
                }
                let mut y = State { q: start.clone(), v: start.clone() };
                // Behind a pointer: a type of its own would have every method compiled for it.
                let (system, class): (AnySystem<'_>, _) = (&apart, BodyClass::Forced);
                let mut integrator = any_integrator(method, class, Coupling::All, &y.q);
                for step in 0..1200 {
                    let stepped = integrator.step(&system, 0.1 * f64::from(step), 0.1, &mut y);
                    assert_eq!(stepped, Ok(()), "{} at {y:?}", method.id);
                }
                let left = largest(y.q.iter().chain(&y.v));
                assert!(left < 1e-300, "{} with {stiffer}: {left}", method.id);
            }
        }
    }
}
