//! Derivatives of the map over a few ticks, by central differences between displaced copies of a body.

use nalgebra::{DMatrix, DVector};

use super::ensemble::Ensemble;
use super::spectrum::Derivatives;
use super::tick::Tick;
use crate::sim::integrators::{StepFailure, Tolerance};
use crate::sim::state::largest;
use crate::sim::{Solver, Stepper};

/// Distances of the differences in units of the scale. A large one loses nothing to rounding if the map
/// is linear; smaller ones follow until the map is linear over the distance.
const DISTANCES: [f64; 5] = [1.0 / 16.0, 9.8e-4, 1.5e-5, 2.4e-7, 3.7e-9];
/// A map is linear over a distance if differences over once and twice the distance agree to this. The
/// error of their extrapolation is of second order in it.
const LINEAR: f64 = 1e-7;
/// The displacement of each copy, in distances.
pub(super) const OFFSETS: [f64; 4] = [1.0, -1.0, 2.0, -2.0];

pub(super) fn state_of(stepper: &dyn Stepper) -> Vec<f64> {
    [stepper.q(), stepper.v()].concat()
}

/// The scale of each component: the largest magnitude in its half of the state, now or one tick later.
pub(super) fn scale(here: &[f64], there: &[f64], h: f64) -> Vec<f64> {
    let n = here.len() / 2;
    let size = |half: std::ops::Range<usize>| {
        let both = here[half.clone()].iter().chain(&there[half]);
        let size = largest(both.filter(|x| x.is_finite()));
        // Below this, a distance would lose digits to underflow.
        if size > 1e-290 { Some(size) } else { None }
    };
    let v = size(n..2 * n);
    let q = size(0..n).or(v.map(|v| v * h)).unwrap_or(1.0);
    [vec![q; n], vec![v.unwrap_or(1.0); n]].concat()
}

/// Copies of a body that are advanced from displaced states.
pub(super) struct TickMap {
    pub(super) copies: Copies,
    pub(super) tick: Tick,
}

pub(super) enum Copies {
    /// One stepper, which advances the copies one after the other.
    Separate(Box<dyn Stepper>),
    /// All copies in one ensemble, with the same substeps.
    Ensemble(Ensemble),
}

impl TickMap {
    pub(super) fn new(body: &dyn Stepper, solver: Solver, tick: Tick) -> Self {
        let own = body.with_solver(solver, tick.t);
        let copies = match solver {
            Solver::Method(method) if method.tolerance.is_some() => {
                Copies::Ensemble(Ensemble::new(own, method, OFFSETS.len()))
            }
            Solver::WithTolerance(method, tolerance) => {
                let ensemble = Ensemble::new(own, method, OFFSETS.len());
                Copies::Ensemble(ensemble.with_tolerance(Tolerance::uniform(tolerance)))
            }
            _ => Copies::Separate(own),
        };
        Self { copies, tick }
    }

    /// The states of all copies after each of `ticks` ticks.
    fn run(&mut self, from: &[Vec<f64>], ticks: usize) -> Result<Vec<Vec<Vec<f64>>>, StepFailure> {
        let Tick { t, h, substeps } = self.tick;
        let begins = |tick: usize| t + h * tick as f64;
        match &mut self.copies {
            Copies::Ensemble(ensemble) => {
                ensemble.set(from);
                let tick = |k| {
                    ensemble.advance(begins(k), h, substeps)?;
                    Ok((0..from.len()).map(|copy| ensemble.state(copy)).collect())
                };
                (0..ticks).map(tick).collect()
            }
            Copies::Separate(stepper) => {
                let mut states = vec![Vec::with_capacity(from.len()); ticks];
                for state in from {
                    let (q, v) = state.split_at(state.len() / 2);
                    stepper.set(t, q, v);
                    for (k, states) in states.iter_mut().enumerate() {
                        stepper.advance(begins(k), h, substeps)?;
                        states.push(state_of(&**stepper));
                    }
                }
                Ok(states)
            }
        }
    }

    /// The Jacobians of the state after 1, 2 … `TICKS` ticks with respect to the initial state, in
    /// units of `scale`.
    pub(super) fn derivatives<const TICKS: usize>(
        &mut self,
        at: &[f64],
        scale: &[f64],
    ) -> Result<[DMatrix<f64>; TICKS], StepFailure> {
        let n = at.len();
        let mut derivatives = [(); TICKS].map(|()| DMatrix::zeros(n, n));
        for j in 0..n {
            for (derivative, column) in
                derivatives.iter_mut().zip(self.column(at, scale, j, TICKS)?)
            {
                derivative.set_column(j, &DVector::from_vec(column));
            }
        }
        Ok(derivatives)
    }

    /// The derivatives with respect to component `j` after each of `ticks` ticks, at the first distance
    /// over which the map is linear, or else at the most linear one.
    fn column(
        &mut self,
        at: &[f64],
        scale: &[f64],
        j: usize,
        ticks: usize,
    ) -> Result<Vec<Vec<f64>>, StepFailure> {
        most_linear(DISTANCES.iter().map(|distance| {
            let moved: Vec<Vec<f64>> = OFFSETS
                .iter()
                .map(|offset| {
                    let mut moved = at.to_vec();
                    moved[j] += offset * distance * scale[j];
                    moved
                })
                .collect();
            let states = self.run(&moved, ticks)?;
            let (near, far) = (moved[0][j] - moved[1][j], moved[2][j] - moved[3][j]);
            let mut nonlinearity: f64 = 0.0;
            let columns = states.iter().map(|after| {
                let row = |i: usize| {
                    let unit = scale[j] / scale[i];
                    let once = (after[0][i] - after[1][i]) / near * unit;
                    let twice = (after[2][i] - after[3][i]) / far * unit;
                    nonlinearity = nonlinearity.max((once - twice).abs());
                    once + (once - twice) / 3.0
                };
                (0..at.len()).map(row).collect()
            });
            let columns: Vec<Vec<f64>> = columns.collect();
            let size = largest(columns.iter().flatten());
            Ok((nonlinearity / size.max(1.0), columns))
        }))
    }
}

/// Returns the first attempt whose nonlinearity is at most [`LINEAR`], or else the most linear one.
/// Attempts that fail are skipped: their copies were displaced too far, for instance into the centre of
/// an orbit.
///
/// # Errors
/// The last failure, if all attempts fail.
fn most_linear<T>(
    tries: impl IntoIterator<Item = Result<(f64, T), StepFailure>>,
) -> Result<T, StepFailure> {
    let mut best: Option<(f64, T)> = None;
    let mut failed = None;
    for tried in tries {
        match tried {
            Ok((nonlinearity, found)) if nonlinearity <= LINEAR => return Ok(found),
            Ok((nonlinearity, found)) => {
                if best.as_ref().is_none_or(|(least, _)| nonlinearity < *least) {
                    best = Some((nonlinearity, found));
                }
            }
            Err(failure) => failed = Some(failure),
        }
    }
    match best {
        Some((_, found)) => Ok(found),
        None => Err(failed.expect("a try that does not succeed fails")),
    }
}

/// The maps of a linear motion over 1, 2 and 3 ticks. `run` returns the state after tick number `k` of a run that begins
/// in a unit of component `column`, in such units; it begins the run if `k` is 0.
pub(super) fn linear_maps(
    size: usize,
    mut run: impl FnMut(usize, usize) -> Result<Vec<f64>, StepFailure>,
) -> Result<Derivatives, StepFailure> {
    let mut now: [DMatrix<f64>; 3] = std::array::from_fn(|_| DMatrix::zeros(size, size));
    for column in 0..size {
        for (k, map) in now.iter_mut().enumerate() {
            map.set_column(column, &DVector::from_vec(run(column, k)?));
        }
    }
    let later = [now[0].clone(), now[1].clone()];
    Ok(Derivatives { now, later })
}

/// The acceleration of a body in the state `at`, coordinates first, with component `moved.0` displaced by `moved.1`.
fn acceleration_at(
    body: &dyn Stepper,
    at: &[f64],
    moved: Option<(usize, f64)>,
    t: f64,
) -> Vec<f64> {
    let mut state = at.to_vec();
    if let Some((index, by)) = moved {
        state[index] += by;
    }
    let (q, v) = state.split_at(at.len() / 2);
    let mut a = vec![0.0; q.len()];
    body.acceleration(t, q, v, &mut a);
    a
}

/// The Jacobian of the acceleration of a body with respect to coordinates and velocities, by differences over `by` to one
/// side.
pub(super) fn force_slopes(body: &dyn Stepper, at: &[f64], by: f64, t: f64) -> DMatrix<f64> {
    let here = acceleration_at(body, at, None, t);
    let column = |j: usize| {
        let moved = acceleration_at(body, at, Some((j, by)), t).into_iter();
        moved.zip(&here).map(|(moved, here)| (moved - here) / by).collect::<Vec<_>>()
    };
    DMatrix::from_vec(here.len(), at.len(), (0..at.len()).flat_map(column).collect())
}

/// The same by differences to both sides, over distances that fit the scale of each component.
pub(super) fn force_jacobian(
    body: &dyn Stepper,
    here: &[f64],
    scale: &[f64],
    t: f64,
) -> DMatrix<f64> {
    let n = here.len() / 2;
    let at = |j: usize, side: f64| {
        let by = side * FORCE_DISTANCE * scale[j];
        (here[j] + by, acceleration_at(body, here, Some((j, by)), t))
    };
    let mut force_jacobian = DMatrix::zeros(n, 2 * n);
    for j in 0..2 * n {
        let ((ahead, a), (behind, b)) = (at(j, 1.0), at(j, -1.0));
        for i in 0..n {
            force_jacobian[(i, j)] = (a[i] - b[i]) / (ahead - behind);
        }
    }
    force_jacobian
}

/// The distance of the differences of forces, in units of the scale: it balances truncation and
/// rounding.
const FORCE_DISTANCE: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    fn failure(value: f64) -> StepFailure {
        StepFailure::NotFinite { coordinate: "x".into(), value }
    }

    #[test]
    fn the_first_linear_attempt_is_returned_or_else_the_most_linear() {
        let of = |nonlinearities: &[f64]| {
            let mut tried = 0;
            let tries = nonlinearities.iter().enumerate().map(|(place, &nonlinearity)| {
                tried += 1;
                if nonlinearity < 0.0 {
                    Err(failure(nonlinearity))
                } else {
                    Ok((nonlinearity, place))
                }
            });
            (most_linear(tries), tried)
        };
        assert_eq!(of(&[0.1, 1e-8, 0.0]), (Ok(1), 2));
        assert_eq!(of(&[0.1, 2e-7, 1e-3]), (Ok(1), 3));
        assert_eq!(of(&[0.1, 0.2, 0.3]), (Ok(0), 3));
        assert_eq!(of(&[0.3, 0.2, 0.1]), (Ok(2), 3));
        assert_eq!(of(&[-1.0, 0.2, -2.0]), (Ok(1), 3));
        assert_eq!(of(&[-1.0, -2.0]), (Err(failure(-2.0)), 2));
    }

    #[test]
    fn a_nonlinear_map_is_differenced_at_a_small_distance() {
        // Semi-implicit Euler: ω' = ω - h g/l sin θ, θ' = θ + h ω'.
        let values = [1.0, 2.0, 9.81, 0.0, 1.2, 0.5, 1.0];
        let pendulum = (kind("pendulum").unwrap().build)(&values, Solver::Truth);
        let here = state_of(&*pendulum);
        let rate = 9.81 * libm::cos(here[0]);
        for h in [0.01, 0.2, 3.0] {
            let solver = Solver::Method(method("semi-implicit-euler").unwrap());
            let mut tick_map = TickMap::new(&*pendulum, solver, Tick { t: 0.0, h, substeps: 1 });
            let [found] = tick_map.derivatives(&here, &[1.0; 2]).unwrap();
            let wanted = [[1.0 - h * h * rate, h], [-h * rate, 1.0]];
            for (i, row) in wanted.iter().enumerate() {
                for (j, wanted) in row.iter().enumerate() {
                    let off = (found[(i, j)] - wanted).abs();
                    assert!(off < 1e-9 * (1.0 + h * h), "{h} s: ({i}, {j}) is off by {off:e}");
                }
            }
        }
    }

    #[test]
    fn a_scale_is_the_largest_of_its_half_or_else_follows_from_the_other_half() {
        assert_eq!(scale(&[1.0, -3.0, 0.5, 0.0], &[2.0, 0.0, 7.0, 0.0], 0.1), [3.0, 3.0, 7.0, 7.0]);
        assert_eq!(scale(&[0.0, 4.0], &[1e-300, 5.0], 0.1), [0.5, 5.0]);
        assert_eq!(scale(&[2.0, 0.0], &[2.0, 0.0], 0.1), [2.0, 1.0]);
        assert_eq!(scale(&[0.0, 0.0], &[0.0, f64::NAN], 0.1), [1.0, 1.0]);
    }
}
