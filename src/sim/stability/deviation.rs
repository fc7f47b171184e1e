//! A small deviation of a body from a state, under linearised forces. It is presented as a body that any method can
//! step.

use nalgebra::DMatrix;

use crate::bodies::{Custom, Extras};
use crate::integrators::Method;
use crate::state::largest;
use crate::state::quotient;
use crate::{Solver, State, Stepper, System, stepper};

/// Returns the acceleration of a body in a state, coordinates first.
pub(super) fn acceleration_at(body: &dyn Stepper, t: f64, state: &[f64]) -> Vec<f64> {
    let (q, v) = state.split_at(state.len() / 2);
    let mut a = vec![0.0; q.len()];
    body.acceleration(t, q, v, &mut a);
    a
}

/// Returns the derivative of the acceleration of a body in the direction `along`. It is a one-sided difference over
/// `part` of `along`, from the state `at`, in which the acceleration is `here`.
fn slope(
    body: &dyn Stepper,
    t: f64,
    at: &[f64],
    here: &[f64],
    part: f64,
    along: &[f64],
) -> Vec<f64> {
    let moved: Vec<f64> = at.iter().zip(along).map(|(x, along)| x + part * along).collect();
    let mut slope = acceleration_at(body, t, &moved);
    quotient(&mut slope, here, part);
    slope
}

/// Returns the Jacobian of the acceleration of a body with respect to coordinates and velocities, by one-sided
/// differences over the distance `by`.
pub(super) fn force_slopes(body: &dyn Stepper, at: &[f64], by: f64, t: f64) -> DMatrix<f64> {
    let here = acceleration_at(body, t, at);
    let column = |j: usize| {
        let mut along = vec![0.0; at.len()];
        along[j] = 1.0;
        slope(body, t, at, &here, by, &along)
    };
    DMatrix::from_vec(here.len(), at.len(), (0..at.len()).flat_map(column).collect())
}

/// A system given by a function that computes its acceleration. The function takes the coordinates, the velocities and
/// the output as slices.
#[derive(Clone)]
struct SliceSystem<F>(F);

impl<F: Fn(&[f64], &[f64], &mut [f64])> System for SliceSystem<F> {
    type Vector = Vec<f64>;

    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        (self.0)(q, v, a);
    }
}

/// Returns a body with this acceleration, under `method`, with `n` coordinates and velocities of 0.
fn body_with_acceleration(
    acceleration: impl Fn(&[f64], &[f64], &mut [f64]) + Clone + Send + 'static,
    n: usize,
    method: &'static Method,
) -> Box<dyn Stepper> {
    let start = State { q: vec![0.0; n], v: vec![0.0; n] };
    let body = Custom::unnamed(SliceSystem(acceleration), &start, &Extras::default());
    stepper(body, Solver::Method(method))
}

/// Returns a deviation whose acceleration is `jacobian` times its coordinates and velocities. The Jacobian has one row
/// per coordinate.
pub(super) fn linear(jacobian: DMatrix<f64>, method: &'static Method) -> Box<dyn Stepper> {
    let n = jacobian.nrows();
    let acceleration = move |q: &[f64], v: &[f64], a: &mut [f64]| {
        for (i, a) in a.iter_mut().enumerate() {
            let row = |j: usize| jacobian[(i, j)] * q[j] + jacobian[(i, n + j)] * v[j];
            *a = (0..n).map(row).sum();
        }
    };
    body_with_acceleration(acceleration, n, method)
}

/// Returns a deviation from the state of `body` at time `t` (s), under forces linearised there. The slopes of the
/// forces are differences along the deviation, over `displacement` times the size of the state. The size of a state is
/// its largest coordinate, or its largest velocity times `h` if that is larger.
pub(super) fn deviation_along_forces(
    body: &dyn Stepper,
    t: f64,
    h: f64,
    displacement: f64,
    method: &'static Method,
) -> Box<dyn Stepper> {
    let body = body.with_solver(Solver::Truth, t);
    let at = [body.q(), body.v()].concat();
    let size_of = move |q: &[f64], v: &[f64]| largest(q).max(h * largest(v));
    let size = size_of(body.q(), body.v());
    let distance = displacement * if size > 0.0 { size } else { 1.0 };
    let here = acceleration_at(&*body, t, &at);
    let n = here.len();
    let acceleration = move |q: &[f64], v: &[f64], a: &mut [f64]| {
        let part = distance / size_of(q, v);
        a.copy_from_slice(&slope(&*body, t, &at, &here, part, &[q, v].concat()));
    };
    body_with_acceleration(acceleration, n, method)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::Spring;
    use crate::integrators::{GENERAL_METHODS, method};
    use crate::stepper;

    fn spring(x0: f64, v0: f64) -> Spring {
        Spring { mass: 2.0, stiffness: 180.0, damping: 3.0, x0, v0, kick: 1.0 }
    }

    /// Returns the largest difference between two states, relative to 1 and their size.
    fn apart(found: &[f64], wanted: &[f64]) -> f64 {
        let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
        apart.fold(0.0, f64::max)
    }

    /// Returns the state after three steps within 0.05 s.
    fn reached(stepper: &mut dyn Stepper, q: f64, v: f64) -> Vec<f64> {
        stepper.set(0.0, &[q], &[v]);
        stepper.advance(0.0, 0.05, 3).unwrap();
        [stepper.q(), stepper.v()].concat()
    }

    #[test]
    fn a_deviation_from_rest_moves_like_a_linear_body() {
        for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
            let mut stepper = stepper(spring(1.0, 0.0), Solver::Method(method));
            let jacobian = DMatrix::from_row_slice(1, 2, &[-90.0, -1.5]);
            let mut deviation = linear(jacobian, method);
            for [q, v] in [[1.0, 0.0], [-0.3, 4.0]] {
                let [found, wanted] =
                    [&mut deviation, &mut stepper].map(|it| reached(&mut **it, q, v));
                assert!(apart(&found, &wanted) < 1e-12, "{}", method.id);
            }
        }
    }

    #[test]
    fn the_difference_of_two_motions_of_a_linear_body_is_a_deviation() {
        let rk4 = method("rk4").unwrap();
        // Starts in a state in which coordinate, velocity and force are all nonzero.
        let body = stepper(spring(0.7, 1.5), Solver::Truth);
        let found = reached(&mut *deviation_along_forces(&*body, 0.0, 0.05, 1e-3, rk4), 0.2, -4.0);
        let mut stepper = body.with_solver(Solver::Method(rk4), 0.0);
        let [near, far] = [[0.7, 1.5], [0.9, -2.5]].map(|[q, v]| reached(&mut *stepper, q, v));
        let wanted: Vec<f64> = far.iter().zip(&near).map(|(far, near)| far - near).collect();
        assert!(apart(&found, &wanted) < 1e-9, "{found:?}");
    }
}
