//! The state carried from places near its own: what derivatives are made of.

use nalgebra::{DMatrix, DVector};

use super::flock::Flock;
use super::tick::Tick;
use crate::sim::integrators::{StepFailure, Tolerance};
use crate::sim::{Solver, Stepper};

/// How far the state is differenced in units of its scale: far, which loses nothing to rounding where
/// the map is linear, and nearer until the map is straight over the distance.
const DISTANCES: [f64; 5] = [1.0 / 16.0, 9.8e-4, 1.5e-5, 2.4e-7, 3.7e-9];
/// A map is straight where differences over once and twice the distance agree to this: their
/// extrapolation is then right to its square.
const STRAIGHT: f64 = 1e-7;
/// Where each copy stands, in distances.
pub(super) const COPIES: [f64; 4] = [1.0, -1.0, 2.0, -2.0];

pub(super) fn state_of(stepper: &dyn Stepper) -> Vec<f64> {
    [stepper.q(), stepper.v()].concat()
}

/// The size of each component: that of the largest of its half of the state, now or a tick on.
pub(super) fn scale(here: &[f64], there: &[f64], h: f64) -> Vec<f64> {
    let n = here.len() / 2;
    let largest = |half: std::ops::Range<usize>| {
        let both = here[half.clone()].iter().chain(&there[half]);
        let largest = both.filter(|x| x.is_finite()).fold(0.0, |most: f64, x| most.max(x.abs()));
        // Below, a distance would have no digits left.
        if largest > 1e-290 { Some(largest) } else { None }
    };
    let v = largest(n..2 * n);
    let q = largest(0..n).or(v.map(|v| v * h)).unwrap_or(1.0);
    [vec![q; n], vec![v.unwrap_or(1.0); n]].concat()
}

/// Carries the body through ticks from states near its own.
pub(super) struct Probe {
    pub(super) carrier: Carrier,
    pub(super) tick: Tick,
}

pub(super) enum Carrier {
    /// The lane's own stepper, once for each copy.
    Alone(Box<dyn Stepper>),
    /// All copies under one choice of substeps.
    Together(Flock),
}

impl Probe {
    pub(super) fn new(body: &dyn Stepper, solver: Solver, tick: Tick) -> Self {
        let own = body.with_solver(solver, tick.t);
        let carrier = match solver {
            Solver::Method(method) if method.tolerance.is_some() => {
                Carrier::Together(Flock::new(own, method, COPIES.len()))
            }
            Solver::Within(method, tolerance) => {
                let flock = Flock::new(own, method, COPIES.len());
                Carrier::Together(flock.within(Tolerance::uniform(tolerance)))
            }
            _ => Carrier::Alone(own),
        };
        Self { carrier, tick }
    }

    /// The states of all copies after each of `ticks` ticks.
    fn run(&mut self, from: &[Vec<f64>], ticks: usize) -> Result<Vec<Vec<Vec<f64>>>, StepFailure> {
        let Tick { t, h, substeps } = self.tick;
        let begins = |tick: usize| t + h * tick as f64;
        match &mut self.carrier {
            Carrier::Together(flock) => {
                flock.set(from);
                let tick = |k| {
                    flock.advance(begins(k), h, substeps)?;
                    Ok((0..from.len()).map(|copy| flock.state(copy)).collect())
                };
                (0..ticks).map(tick).collect()
            }
            Carrier::Alone(stepper) => {
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

    /// The derivatives of the state after 1, 2 … `TICKS` ticks with respect to the state before them,
    /// in units of `scale`.
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

    /// The derivatives with respect to component `j`, after each of `ticks` ticks: at the first distance
    /// over which the map is straight, or else at the one where it is straightest.
    fn column(
        &mut self,
        at: &[f64],
        scale: &[f64],
        j: usize,
        ticks: usize,
    ) -> Result<Vec<Vec<f64>>, StepFailure> {
        straightest(DISTANCES.iter().map(|distance| {
            let moved: Vec<Vec<f64>> = COPIES
                .iter()
                .map(|copies| {
                    let mut moved = at.to_vec();
                    moved[j] += copies * distance * scale[j];
                    moved
                })
                .collect();
            let states = self.run(&moved, ticks)?;
            let (near, far) = (moved[0][j] - moved[1][j], moved[2][j] - moved[3][j]);
            let mut bend: f64 = 0.0;
            let columns = states.iter().map(|after| {
                let row = |i: usize| {
                    let unit = scale[j] / scale[i];
                    let once = (after[0][i] - after[1][i]) / near * unit;
                    let twice = (after[2][i] - after[3][i]) / far * unit;
                    bend = bend.max((once - twice).abs());
                    once + (once - twice) / 3.0
                };
                (0..at.len()).map(row).collect()
            });
            let columns: Vec<Vec<f64>> = columns.collect();
            let size = columns.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
            Ok((bend / size.max(1.0), columns))
        }))
    }
}

/// The first of the tries, each with its bend, that is [straight](STRAIGHT), or else the one that is straightest. A try
/// that fails is passed over: its copies, as in the middle of an orbit, were put too far out.
///
/// # Errors
/// The last failure, where all tries fail.
fn straightest<T>(
    tries: impl IntoIterator<Item = Result<(f64, T), StepFailure>>,
) -> Result<T, StepFailure> {
    let mut best: Option<(f64, T)> = None;
    let mut failed = None;
    for tried in tries {
        match tried {
            Ok((bend, found)) if bend <= STRAIGHT => return Ok(found),
            Ok((bend, found)) => {
                if best.as_ref().is_none_or(|(least, _)| bend < *least) {
                    best = Some((bend, found));
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

/// The derivative of a body's acceleration with respect to its coordinates and velocities.
pub(super) fn rates(body: &dyn Stepper, here: &[f64], scale: &[f64], t: f64) -> DMatrix<f64> {
    let n = here.len() / 2;
    let at = |j: usize, copies: f64| {
        let mut moved = here.to_vec();
        moved[j] += copies * NEAR * scale[j];
        let mut a = vec![0.0; n];
        body.acceleration(t, &moved[..n], &moved[n..], &mut a);
        (moved[j], a)
    };
    let mut rates = DMatrix::zeros(n, 2 * n);
    for j in 0..2 * n {
        let ((ahead, a), (behind, b)) = (at(j, 1.0), at(j, -1.0));
        for i in 0..n {
            rates[(i, j)] = (a[i] - b[i]) / (ahead - behind);
        }
    }
    rates
}

/// How far forces are differenced, in units of the state's scale: where the bend of the force and the
/// rounding of the difference are alike small.
const NEAR: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    fn failure(value: f64) -> StepFailure {
        StepFailure::NotFinite { coordinate: "x", value }
    }

    #[test]
    fn the_first_straight_try_is_taken_and_of_bent_ones_the_straightest() {
        let of = |bends: &[f64]| {
            let mut tried = 0;
            let tries = bends.iter().enumerate().map(|(place, &bend)| {
                tried += 1;
                if bend < 0.0 { Err(failure(bend)) } else { Ok((bend, place)) }
            });
            (straightest(tries), tried)
        };
        assert_eq!(of(&[0.1, 1e-8, 0.0]), (Ok(1), 2));
        assert_eq!(of(&[0.1, 2e-7, 1e-3]), (Ok(1), 3));
        assert_eq!(of(&[0.1, 0.2, 0.3]), (Ok(0), 3));
        assert_eq!(of(&[0.3, 0.2, 0.1]), (Ok(2), 3));
        assert_eq!(of(&[-1.0, 0.2, -2.0]), (Ok(1), 3));
        assert_eq!(of(&[-1.0, -2.0]), (Err(failure(-2.0)), 2));
    }

    #[test]
    fn a_bent_map_is_differenced_as_near_as_it_takes() {
        // Semi-implicit Euler: ω' = ω - h g/l sin θ, θ' = θ + h ω'.
        let values = [1.0, 2.0, 9.81, 0.0, 1.2, 0.5, 1.0];
        let pendulum = (kind("pendulum").unwrap().build)(&values, Solver::Truth);
        let here = state_of(&*pendulum);
        let rate = 9.81 * libm::cos(here[0]);
        for h in [0.01, 0.2, 3.0] {
            let solver = Solver::Method(method("semi-implicit-euler").unwrap());
            let mut probe = Probe::new(&*pendulum, solver, Tick { t: 0.0, h, substeps: 1 });
            let [found] = probe.derivatives(&here, &[1.0; 2]).unwrap();
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
    fn a_scale_is_the_largest_of_its_half_and_of_nothing_what_a_tick_makes_of_the_other() {
        assert_eq!(scale(&[1.0, -3.0, 0.5, 0.0], &[2.0, 0.0, 7.0, 0.0], 0.1), [3.0, 3.0, 7.0, 7.0]);
        assert_eq!(scale(&[0.0, 4.0], &[1e-300, 5.0], 0.1), [0.5, 5.0]);
        assert_eq!(scale(&[2.0, 0.0], &[2.0, 0.0], 0.1), [2.0, 1.0]);
        assert_eq!(scale(&[0.0, 0.0], &[0.0, f64::NAN], 0.1), [1.0, 1.0]);
    }
}
