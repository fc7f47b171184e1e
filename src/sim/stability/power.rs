//! The spectral radius of the one-tick map of a body of many coordinates, by power iteration. The map is never formed;
//! the iteration uses differences between steps of the stepper itself.

use super::{Tick, deviation};
use crate::integrators::{Method, StepFailure};
use crate::numerics::XorShift;
use crate::state::largest;
use crate::state::quotient;
use crate::{Solver, Stepper};

/// The maximum number of iterations, enough for a radius accurate to a thousandth.
const MAX_ITERATIONS: usize = 2048;
/// The minimum number of iterations for a usable result.
const MIN_ITERATIONS: usize = 64;
/// The largest relative difference between the radius after three quarters of the iterations and the radius after all
/// of them, if the iteration has settled.
const SETTLED: f64 = 5e-3;
/// The displacement of the state, relative to its size. It is large compared with rounding, and small compared with the
/// curvature of the forces.
const DISPLACEMENT: f64 = 1e-7;
/// The initial size of a deviation in a continued run. From this size the deviation may grow by 450 decades and shrink
/// by 150.
const START: f64 = 1e-150;

/// The power iteration for the spectral radius of a tick, one tick at a time.
pub struct PowerIteration {
    /// Runs the next tick, and returns the logarithm of the length of the deviation after it.
    tick: Box<TickOfDeviation>,
    logs: Vec<f64>,
}

type TickOfDeviation = dyn FnMut() -> Result<Option<f64>, StepFailure> + Send;

impl PowerIteration {
    /// Returns the iteration with ticks of `solver` on `body`, linearised about the body's current state. If the method
    /// has memory, the iterated map is that of state and memory. Returns `None` if `max_evaluations` is too small, if
    /// the method chooses its substeps, or if it is implicit and has memory.
    ///
    /// # Errors
    /// The failure of the method.
    pub fn new(
        body: &dyn Stepper,
        solver: Solver,
        tick: Tick,
        max_evaluations: u64,
    ) -> Result<Option<Self>, StepFailure> {
        let Some(method) = solver.method().filter(|it| it.keeps_time && it.tolerance.is_none())
        else {
            return Ok(None);
        };
        let evaluations = method.evaluations_per_tick(tick.substeps);
        // With fewer ticks there is no result, and one of them may take an implicit method seconds on a large body.
        if max_evaluations / u64::from(evaluations.unwrap_or(1)) < MIN_ITERATIONS as u64 {
            return Ok(None);
        }
        let tick: Box<TickOfDeviation> = match (method.restart, evaluations) {
            (None, _) => Box::new(displaced_ticks(body, solver, tick, max_evaluations)?),
            (Some(_), Some(evaluations)) => {
                let max_ticks = max_evaluations / u64::from(evaluations);
                Box::new(continued_run(body, method, tick, max_ticks))
            }
            (Some(_), None) => return Ok(None),
        };
        Ok(Some(Self { tick, logs: Vec::with_capacity(MAX_ITERATIONS) }))
    }

    /// Runs a tick. Returns whether the iteration continues, which it does while the deviation is finite and ticks are
    /// left.
    ///
    /// # Errors
    /// The failure of the method.
    pub fn advance(&mut self) -> Result<bool, StepFailure> {
        if self.logs.len() == MAX_ITERATIONS {
            return Ok(false);
        }
        let log = (self.tick)()?.filter(|log| log.is_finite());
        self.logs.extend(log);
        Ok(log.is_some())
    }

    /// Returns the spectral radius; `None` if the iteration has not settled.
    ///
    /// Up to rounding, the length after n iterations grows like ρⁿ nᵖ, with p > 0 for a drifting body. A second
    /// difference of the logarithm of the length removes the part with p.
    pub fn radius(&self) -> Option<f64> {
        settled_radius(&self.logs)
    }
}

/// Returns the ticks of the iteration for a method without memory. Each tick starts from the state of `body` plus the
/// deviation, and the iteration ends if the deviation vanishes or overflows.
fn displaced_ticks(
    body: &dyn Stepper,
    solver: Solver,
    tick: Tick,
    max_evaluations: u64,
) -> Result<impl FnMut() -> Result<Option<f64>, StepFailure> + use<>, StepFailure> {
    let Tick { t, h, substeps } = tick;
    let mut stepper = body.with_solver(solver, t);
    let [q, v] = [body.q().to_vec(), body.v().to_vec()];
    let n = q.len();
    let before = stepper.evaluations();
    stepper.set(t, &q, &v);
    stepper.advance(t, h, substeps)?;
    let image = [stepper.q(), stepper.v()].map(<[f64]>::to_vec);
    let size = largest(q.iter().chain(&image[0]));
    let distance = DISPLACEMENT * if size > 0.0 { size } else { 1.0 };

    // The direction has the coordinates, then the velocities times the length of the tick, so that all have one unit.
    let mut direction = start_vector(2 * n);
    let mut log = 0.0;
    Ok(move || -> Result<Option<f64>, StepFailure> {
        let is_affordable = stepper.evaluations() - before <= max_evaluations;
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        // The largest component is displaced by `distance`.
        let longest = largest(&direction);
        if longest == 0.0 || !length.is_finite() || !is_affordable {
            return Ok(None);
        }
        let part = distance / longest;
        let moved = |x: &[f64], along: &[f64], unit: f64| -> Vec<f64> {
            x.iter().zip(along).map(|(x, along)| x + part * along / unit).collect()
        };
        stepper.set(t, &moved(&q, &direction[..n], 1.0), &moved(&v, &direction[n..], h));
        stepper.advance(t, h, substeps)?;
        let (along_q, along_v) = direction.split_at_mut(n);
        along_q.copy_from_slice(stepper.q());
        along_v.copy_from_slice(stepper.v());
        quotient(along_q, &image[0], part);
        quotient(along_v, &image[1], part / h);
        let pushed = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        log += libm::log(pushed / length);
        // The direction is scaled, because a long product would overflow.
        direction.iter_mut().for_each(|x| *x /= pushed);
        Ok(Some(log))
    })
}

/// Returns at most `max_ticks` ticks of one run, in which the method keeps its memory. The run steps the deviation
/// under the linearised forces, and ends if the method fails.
fn continued_run(
    body: &dyn Stepper,
    method: &'static Method,
    tick: Tick,
    max_ticks: u64,
) -> impl FnMut() -> Result<Option<f64>, StepFailure> + use<> {
    let Tick { t, h, substeps } = tick;
    let n = body.q().len();
    let mut deviation = deviation::deviation_along_forces(body, t, h, DISPLACEMENT, method);
    let mut start = start_vector(2 * n);
    start.iter_mut().for_each(|x| *x *= START);
    start[n..].iter_mut().for_each(|v| *v /= h);
    deviation.set(t, &start[..n], &start[n..]);
    let mut ticks = 0..max_ticks;
    move || {
        if ticks.next().is_none() || deviation.advance(t, h, substeps).is_err() {
            return Ok(None);
        }
        let mut state = [deviation.q(), deviation.v()].concat();
        state[n..].iter_mut().for_each(|v| *v *= h);
        let longest = largest(&state);
        // The sum is relative to the largest component, whose square may overflow.
        let square: f64 = state.iter().map(|x| (x / longest) * (x / longest)).sum();
        Ok(Some(libm::log(longest) + libm::log(square) / 2.0))
    }
}

/// Returns the spectral radius; `None` if the radius still changes with more iterations.
fn settled_radius(logs: &[f64]) -> Option<f64> {
    let [earlier, all] = [logs.len() * 3 / 4, logs.len()].map(|count| radius(&logs[..count]));
    let (earlier, all) = (earlier?, all?);
    ((earlier / all - 1.0).abs() <= SETTLED).then_some(all)
}

/// Returns the spectral radius, from the logarithms of the deviation's length after each iteration.
fn radius(logs: &[f64]) -> Option<f64> {
    let count = logs.len() / 8 * 8;
    if count < MIN_ITERATIONS || !logs[count - 1].is_finite() {
        return None;
    }
    let peak = |window: std::ops::Range<usize>| {
        logs[window].iter().fold(f64::NEG_INFINITY, |most, log| most.max(*log))
    };
    // The windows have equal length, so that a trend moves their peaks equally.
    let [first, middle, last] = [count / 4, count / 2, count].map(|end| peak(end - count / 8..end));
    // If the length is ρⁿ nᵖ, both differences have the same part from nᵖ.
    let rate = ((last - middle) - (middle - first)) / (count / 4) as f64;
    Some(libm::exp(rate))
}

/// Returns a vector with a component in every mode, the same on every run.
fn start_vector(components: usize) -> Vec<f64> {
    let mut random = XorShift::new(0x9E37_79B9_7F4A_7C15);
    (0..components).map(|_| random.next()).collect()
}
