//! An ensemble: copies of one body stepped as one system, so that a method that chooses its substeps
//! chooses the same for all. The forces can be replaced by their linearisation.

use nalgebra::DMatrix;

use crate::sim::integrators::{Integrator, Method, Stepped, Tolerance, integrator};
use crate::sim::{Solver, State, Stepper, System};

/// An acceleration function on slices: time, coordinates, velocities, output.
type Acceleration = Box<dyn Fn(f64, &[f64], &[f64], &mut [f64])>;

/// The equation of motion of several copies that do not interact.
struct EnsembleSystem {
    acceleration: Acceleration,
    coordinates: usize,
}

impl System for EnsembleSystem {
    type Vector = Vec<f64>;

    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let n = self.coordinates;
        for ((q, v), a) in q.chunks(n).zip(v.chunks(n)).zip(a.chunks_mut(n)) {
            (self.acceleration)(t, q, v, a);
        }
    }
}

/// Copies of one body under one method.
pub(super) struct Ensemble {
    copies: EnsembleSystem,
    integrator: Box<dyn Integrator<EnsembleSystem>>,
    state: State<Vec<f64>>,
}

impl Ensemble {
    /// An ensemble of `count` copies of `body`.
    pub(super) fn new(body: Box<dyn Stepper>, method: &Method, count: usize) -> Self {
        let coordinates = body.q().len();
        let acceleration: Acceleration = Box::new(move |t, q, v, a| body.acceleration(t, q, v, a));
        Self::of(acceleration, coordinates, method, count)
    }

    /// An ensemble of `count` copies of `body` with its forces linearised about its state at time `t`.
    /// `derivative` is the Jacobian of the acceleration with respect to coordinates and velocities, one
    /// row per coordinate.
    pub(super) fn linearised(
        body: &dyn Stepper,
        derivative: DMatrix<f64>,
        t: f64,
        method: &Method,
        count: usize,
    ) -> Self {
        let (q0, v0) = (body.q().to_vec(), body.v().to_vec());
        let n = q0.len();
        let mut a0 = vec![0.0; n];
        body.acceleration(t, &q0, &v0, &mut a0);
        let acceleration: Acceleration = Box::new(move |_, q, v, a| {
            a.copy_from_slice(&a0);
            for (i, a) in a.iter_mut().enumerate() {
                for j in 0..n {
                    let (by_q, by_v) = (derivative[(i, j)], derivative[(i, n + j)]);
                    *a += by_q * (q[j] - q0[j]) + by_v * (v[j] - v0[j]);
                }
            }
        });
        Self::of(acceleration, n, method, count)
    }

    /// One body whose acceleration is `jacobian` times its coordinates and velocities, one row per coordinate.
    pub(super) fn linear(jacobian: DMatrix<f64>, method: &Method) -> Self {
        let n = jacobian.nrows();
        let acceleration: Acceleration = Box::new(move |_, q, v, a| {
            for (i, a) in a.iter_mut().enumerate() {
                let row = |j: usize| jacobian[(i, j)] * q[j] + jacobian[(i, n + j)] * v[j];
                *a = (0..n).map(row).sum();
            }
        });
        Self::of(acceleration, n, method, 1)
    }

    /// A deviation from the state of `body` at time `t`, under the forces linearised there by differences along the
    /// deviation: of `displacement` times the size of the state, whatever the deviation's own size. Velocities count
    /// times `h`.
    pub(super) fn of_deviation(
        body: &dyn Stepper,
        t: f64,
        h: f64,
        displacement: f64,
        method: &Method,
    ) -> Self {
        let body = body.with_solver(Solver::Truth, t);
        let (q0, v0) = (body.q().to_vec(), body.v().to_vec());
        let n = q0.len();
        let largest =
            |x: &[f64], unit: f64| x.iter().fold(0.0, |most: f64, x| most.max((x * unit).abs()));
        let size = largest(&q0, 1.0).max(largest(&v0, h));
        let distance = displacement * if size > 0.0 { size } else { 1.0 };
        let mut a0 = vec![0.0; n];
        body.acceleration(t, &q0, &v0, &mut a0);
        let moved = |x0: &[f64], part: f64, x: &[f64]| {
            x0.iter().zip(x).map(|(x0, x)| x0 + part * x).collect()
        };
        let acceleration: Acceleration = Box::new(move |_, q, v, a| {
            let part = distance / largest(q, 1.0).max(largest(v, h));
            let (q, v): (Vec<f64>, Vec<f64>) = (moved(&q0, part, q), moved(&v0, part, v));
            body.acceleration(t, &q, &v, a);
            a.iter_mut().zip(&a0).for_each(|(a, a0)| *a = (*a - a0) / part);
        });
        Self::of(acceleration, n, method, 1)
    }

    fn of(acceleration: Acceleration, n: usize, method: &Method, count: usize) -> Self {
        let state = State { q: vec![0.0; n * count], v: vec![0.0; n * count] };
        let integrator = integrator(method, &state.q);
        Self { copies: EnsembleSystem { acceleration, coordinates: n }, integrator, state }
    }

    /// Overrides the method's own tolerance.
    pub(super) fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.integrator.set_tolerance(tolerance);
        self
    }

    /// Puts each copy into a state, coordinates first, and resets the method.
    pub(super) fn set(&mut self, states: &[Vec<f64>]) {
        let n = self.copies.coordinates;
        for (i, state) in states.iter().enumerate() {
            self.state.q[i * n..(i + 1) * n].copy_from_slice(&state[..n]);
            self.state.v[i * n..(i + 1) * n].copy_from_slice(&state[n..]);
        }
        self.integrator.reset();
    }

    /// Advances all copies from `t` to `t + h` (s).
    pub(super) fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Stepped {
        self.integrator.steps(&self.copies, t, h, substeps, &mut self.state)
    }

    /// The state of copy number `copy`, coordinates first.
    pub(super) fn state(&self, copy: usize) -> Vec<f64> {
        let n = self.copies.coordinates;
        let here = copy * n..(copy + 1) * n;
        [&self.state.q[here.clone()], &self.state.v[here]].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::{GENERAL_METHODS, method};

    #[test]
    fn each_copy_moves_as_a_stepper_does() {
        let spring = kind("spring").unwrap();
        let values = [2.0, 180.0, 3.0, 1.0, 0.0, 1.0];
        let states = [vec![1.0, 0.0], vec![-0.3, 4.0]];
        for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
            let mut stepper = (spring.build)(&values, Solver::Method(method));
            let mut ensemble = Ensemble::new((spring.build)(&values, Solver::Truth), method, 2);
            ensemble.set(&states);
            ensemble.advance(0.0, 0.05, 3).unwrap();
            for (copy, from) in states.iter().enumerate() {
                stepper.set(0.0, &from[..1], &from[1..]);
                stepper.advance(0.0, 0.05, 3).unwrap();
                let alone = [stepper.q(), stepper.v()].concat();
                let apart =
                    ensemble.state(copy).into_iter().zip(&alone).map(|(a, b)| (a - b).abs());
                // An implicit method iterates until all copies have converged.
                let allowed = if method.evaluations.is_some() { 0.0 } else { 1e-12 };
                assert!(apart.fold(0.0, f64::max) <= allowed, "{}", method.id);
            }
        }
    }

    /// Whether both states agree to rounding.
    fn near(found: &[f64], wanted: &[f64]) -> bool {
        found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= 1e-12 * (1.0 + b.abs()))
    }

    #[test]
    fn copies_of_several_coordinates_do_not_interact() {
        let values = [3.0, 0.5, 200.0, 0.2, 2.0, 0.7, 2.0];
        let chain = |solver| (kind("chain").unwrap().build)(&values, solver);
        let rk4 = method("rk4").unwrap();
        let states: Vec<Vec<f64>> = (0..4)
            .map(|copy| (0..6).map(|i| 0.1 * f64::from(copy * 7 + i) - 0.9).collect())
            .collect();
        let mut ensemble = Ensemble::new(chain(Solver::Truth), rk4, 4);
        ensemble.set(&states);
        ensemble.advance(0.0, 0.05, 2).unwrap();
        let mut stepper = chain(Solver::Method(rk4));
        for (copy, from) in states.iter().enumerate() {
            stepper.set(0.0, &from[..3], &from[3..]);
            stepper.advance(0.0, 0.05, 2).unwrap();
            let alone = [stepper.q(), stepper.v()].concat();
            assert!(near(&ensemble.state(copy), &alone), "{copy}: {:?}", ensemble.state(copy));
        }
    }

    #[test]
    fn linearising_linear_forces_changes_nothing() {
        let spring = kind("spring").unwrap();
        let rk4 = method("rk4").unwrap();
        // From a state in which coordinate, velocity and force are all nonzero.
        let body = (spring.build)(&[2.0, 180.0, 3.0, 0.7, 1.5, 1.0], Solver::Truth);
        let derivative = DMatrix::from_row_slice(1, 2, &[-90.0, -1.5]);
        let mut ensemble = Ensemble::linearised(&*body, derivative, 0.0, rk4, 2);
        let states = [vec![0.2, -4.0], vec![-1.0, 0.3]];
        ensemble.set(&states);
        ensemble.advance(0.0, 0.05, 3).unwrap();
        let mut stepper = body.with_solver(Solver::Method(rk4), 0.0);
        for (copy, from) in states.iter().enumerate() {
            stepper.set(0.0, &from[..1], &from[1..]);
            stepper.advance(0.0, 0.05, 3).unwrap();
            let alone = [stepper.q(), stepper.v()].concat();
            assert!(near(&ensemble.state(copy), &alone), "{copy}: {:?}", ensemble.state(copy));
        }
    }
}
