//! The true motion of one body, determined before any method is compared with it.
//!
//! Amplitudes, centres and ranges come from the truth alone, so that all methods are measured by the same scale. A
//! method's own motion must not set the scale of its error. The truth itself may fail or be imprecise; then no lane is
//! compared with it.

use std::sync::{Arc, Mutex, OnceLock};

use super::slices::Meter;
use super::survey::{Ranges, TruthNode};
use crate::run::race::Extent;
use crate::scene::{Action, SceneBody, Scripted};
use crate::sim::bodies::{Coordinates, Input, Origin, Truth};
use crate::sim::integrators::{GENERAL_METHODS, Override, StepFailure};
use crate::sim::stability::{NormalMode, normal_modes};
use crate::sim::{BodyClass, Solver, Stepper};

mod followed_body;
mod reach;
mod series;
mod swing;
mod walk;

pub(super) use followed_body::{FollowedBody, FollowedRun, ticks, work_of};
pub(super) use reach::Reach;
use reach::{ReachSoFar, amplitudes};
pub(super) use series::TruthSeries;
use series::TruthSeriesByRate;
pub(super) use swing::Swing;

/// Length of a nonlinear body's long run, in horizons.
pub const LONG_RUN: f64 = 20.0;

/// Number of swings over which a body is followed if it makes too few swings for a frequency within the horizon.
const FOLLOWED_SWINGS: u32 = 4;

/// Limits of [`BodyTruth::walk`], in moments and in products of the exact flow, which are n² for a chain of n masses.
const MAX_MOMENTS: usize = 100_000;
const MAX_REFERENCE_MOMENTS: usize = 20_000;
const MIN_MOMENTS: usize = 512;
const MAX_PRODUCTS: usize = 40_000_000;

/// Absolute and relative tolerance over the long run, for a body without a closed form.
const LONG_RUN_TOLERANCE: f64 = 1e-9;

/// Work of a moment of an exact flow and of a reference solution, in evaluations of one coordinate. The last number is
/// the matrix products of a flow that count as one evaluation.
const WORK_OF_MOMENT: u64 = 64;
const WORK_OF_REFERENCE_MOMENT: u64 = 256;
const PRODUCTS_PER_EVALUATION: u64 = 4;

/// The true motion of one body under one throttle.
pub(super) struct BodyTruth {
    pub(super) body: SceneBody,
    pub(super) throttle: f64,
    /// The script's actions on the body at the start, in order. The motion begins after them.
    at_start: Vec<Action>,
    /// The script's later actions on the body within the horizon, in order.
    pub(super) inputs: Vec<Scripted>,
    pub(super) horizon_s: f64,
    truth: Truth,
    /// Amplitude of each component of the state, with the coordinates first.
    pub(super) amplitudes: Vec<f64>,
    /// Centre of each coordinate's swing, which is the middle of its range, or the place of rest if the body loses
    /// energy.
    pub(super) centres: Vec<f64>,
    /// Reach of the motion over the long run, or until the truth fails.
    pub(super) reach: Reach,
    /// The normal modes of a linear body with its last parameters, each with the part of the motion after the last
    /// input that is in the mode.
    pub(super) modes: Option<Vec<MovedMode>>,
    /// Largest kinetic energy in joules, which is the total energy of an oscillator. `None` if energy is not
    /// conserved or nothing moves.
    pub(super) energy_scale: Option<f64>,
    /// The energy that the motion exchanges, in joules, as the metric `energy_drift` defines it.
    pub(super) exchanged_j: Option<f64>,
    pub(super) swing: Option<Swing>,
    /// Duration of the first swings in seconds. It is set if the body makes too few swings for a frequency within the
    /// horizon, and nothing disturbs these swings.
    pub(super) first_swings_s: Option<f64>,
    /// The reason why the truth is unknown over the whole horizon; `None` if the truth is known.
    pub(super) failure: Option<StepFailure>,
    /// Whether the truth fails before anything has moved. Another walk would cost the same again and get no further.
    fails_at_start: bool,
    series_by_rate: TruthSeriesByRate,
    /// The exact motion of a body with walls, whose impacts every verdict reads, and whether it rests at the end.
    pub(super) impacts: Mutex<Option<Box<dyn Stepper>>>,
    pub(super) rests: OnceLock<bool>,
    /// The meter that counts the truth's work.
    pub(super) meter: Arc<Meter>,
}

impl BodyTruth {
    /// Computes the truth. The amplitude of a component is half the largest true range among components of the same
    /// unit. For constant components, it is the largest value.
    pub(super) async fn find(
        body: &SceneBody,
        inputs: &[Scripted],
        throttle: f64,
        horizon_s: f64,
        meter: Arc<Meter>,
    ) -> Self {
        let (at_start, later) = inputs.iter().partition::<Vec<_>, _>(|input| input.at_s <= 0.0);
        let later = later.into_iter().filter(|input| input.at_s < horizon_s);
        let mut truth = Self {
            body: body.clone(),
            throttle,
            at_start: at_start.into_iter().map(|input| input.action.clone()).collect(),
            inputs: later.cloned().collect(),
            horizon_s,
            truth: body.kind.truth_of(&body.values),
            amplitudes: Vec::new(),
            centres: Vec::new(),
            reach: Reach::Each(Vec::new()),
            modes: None,
            energy_scale: None,
            exchanged_j: None,
            swing: None,
            first_swings_s: None,
            failure: None,
            fails_at_start: false,
            series_by_rate: TruthSeriesByRate::default(),
            impacts: Mutex::default(),
            rests: OnceLock::new(),
            meter,
        };
        truth.survey().await;
        truth
    }

    /// Returns the body under `solver` at its start, after the script's actions at the start.
    pub(super) fn start(&self, solver: Solver) -> Box<dyn Stepper> {
        let mut stepper = (self.body.kind.build)(&self.body.values, solver);
        stepper.input(0.0, Input::Throttle(self.throttle));
        self.at_start.iter().for_each(|input| input.apply_to(&mut *stepper, 0.0));
        stepper
    }

    pub(super) fn inputs_at_start(&self) -> Vec<Scripted> {
        let input = |action: &Action| Scripted { at_s: 0.0, action: action.clone() };
        self.at_start.iter().map(input).collect()
    }

    /// Returns the time of the last input in seconds; 0 if there is no input.
    pub(super) fn last_input_s(&self) -> f64 {
        self.inputs.last().map_or(0.0, |input| input.at_s)
    }

    /// Returns the true state after the last input that can be reached.
    async fn after_inputs(&self) -> Box<dyn Stepper> {
        let mut body = self.start(Solver::Truth);
        let mut t = 0.0;
        for input in &self.inputs {
            if body.advance(t, input.at_s - t, 1).is_err() {
                break;
            }
            t = input.at_s;
            input.action.apply_to(&mut *body, t);
            self.meter.yield_after(self.work_of_moment()).await;
        }
        body
    }

    /// Returns the body in its initial state, with the parameters in force after the last input.
    pub(super) fn with_last_parameters(&self) -> Box<dyn Stepper> {
        let mut body = self.start(Solver::Truth);
        let is_parameter = |input: &&Scripted| matches!(input.action, Action::Set { .. });
        self.inputs
            .iter()
            .filter(is_parameter)
            .for_each(|it| it.action.apply_to(&mut *body, it.at_s));
        body
    }

    /// Whether the motion depends on the time of the run: under a law that reads it, or after a target that moves.
    pub(super) fn is_driven(&self) -> bool {
        let reads_time =
            matches!(&self.body.kind.origin, Origin::Law(equations) if equations.reads_time());
        let pursuit = self.start(Solver::Truth).pursuit(0.0);
        // Of a ball whose floor moves.
        let has_lost_form = self.body.kind.truth != self.truth;
        reads_time || has_lost_form || pursuit.is_some_and(|pursuit| !pursuit.is_still)
    }

    /// Whether the body is judged by its bounces, up to a first input.
    pub(super) fn bounces(&self) -> bool {
        self.body.kind.has_walls && self.failure.is_none()
    }

    /// Whether the body is judged by its rotation in space.
    pub(super) fn spins(&self) -> bool {
        self.body.kind.class == BodyClass::Spin && self.failure.is_none()
    }

    pub(super) fn coordinates(&self) -> Coordinates {
        self.body.kind.coordinates(&self.body.values)
    }

    /// Returns the work of one moment of the true motion, in evaluations of one coordinate.
    pub(super) fn work_of_moment(&self) -> u64 {
        let n = self.coordinates().len() as u64;
        match self.truth {
            Truth::Exact => WORK_OF_MOMENT + n * n / PRODUCTS_PER_EVALUATION,
            Truth::Reference => WORK_OF_REFERENCE_MOMENT * n,
        }
    }

    async fn survey(&mut self) {
        let mut body = self.start(Solver::Truth);
        let n = body.q().len();
        let max_moments = match self.truth {
            Truth::Exact => MAX_MOMENTS,
            Truth::Reference => MAX_REFERENCE_MOMENTS,
        };
        let most = (MAX_PRODUCTS / (n * n)).clamp(MIN_MOMENTS, max_moments);
        let after_inputs = self.after_inputs().await;
        self.modes = normal_modes(&*after_inputs).map(|modes| moved(&*after_inputs, modes));
        let mut there = self.start(Solver::Truth);
        let mut reach = ReachSoFar::new(Ranges::at(&*body), &self.body);
        let mut kinetic: f64 = body.kinetic_energy().unwrap_or(0.0);
        let mut extent = Extent::default();
        extent.add_moment(0.0, body.kinetic_energy());
        let conserves = body.energy().is_some() && self.inputs.is_empty();
        let mut has_moved = false;
        // A reference is expensive, so its moments are kept.
        let mut seen = (self.truth == Truth::Reference).then(Vec::new);
        let see = |from: &TruthNode, to: &TruthNode| {
            has_moved = true;
            if let Some(seen) = &mut seen {
                seen.push((from.clone(), to.clone()));
            }
            reach.add(from, to);
            for moment in fastest(from, to).into_iter().filter(|_| conserves) {
                there.set(0.0, &moment.x[..n], &moment.x[n..]);
                let now = there.kinetic_energy();
                kinetic = kinetic.max(now.unwrap_or(0.0));
                extent.add_moment(0.0, now);
            }
        };
        let walked = self.walk(&mut *body, Solver::Truth, self.horizon_s, most, see).await;
        self.exchanged_j = extent.exchanged_j(&*self.start(Solver::Truth));
        self.failure = walked.err();
        self.fails_at_start = self.failure.is_some() && !has_moved;
        self.amplitudes = amplitudes(&reach.ranges.0, &self.coordinates());
        self.energy_scale =
            Some(kinetic).filter(|&scale| conserves && scale > 0.0 && scale.is_finite());
        let middle = |range: &(f64, f64)| range.0 + (range.1 - range.0) / 2.0;
        self.centres = reach.ranges.0[..n].iter().map(middle).collect();
        if self.failure.is_none() && self.energy_scale.is_some() {
            self.swing = self.measure_swing(&self.centres, seen.as_deref(), most).await;
        }
        let returns = self.swing.as_ref().is_some_and(|swing| swing.crossings.len() > 2);
        let mut first_swings_s = self.first_swings_of_modes_s();
        if !returns && !self.fails_at_start {
            // A motion that does not return is followed beyond the horizon, as far as the truth reaches.
            let is_close = self.truth == Truth::Reference && self.failure.is_none();
            let close = match is_close {
                true => self.long_run(close_solver(), most).await.ok(),
                false => None,
            };
            let long = match close {
                Some(long) => long,
                None => self.long_run(Solver::Truth, most).await.unwrap_or_else(|long| long),
            };
            reach = long.reach;
            first_swings_s = first_swings_s.or(long.first_swings_s);
            if self.energy_scale.is_none() && !long.means.is_empty() {
                // A motion that comes to rest swings about its place of rest.
                self.centres = long.means;
            }
        }
        // A body that is knocked away from a fixed target does not swing about that target.
        let is_chase = body.pursuit(0.0).is_some_and(|pursuit| pursuit.is_still);
        if self.failure.is_none() && self.energy_scale.is_none() && !is_chase {
            self.swing = self.measure_swing(&self.centres, seen.as_deref(), most).await;
        }
        self.reach = reach.reach(&self.body, &self.centres, &self.amplitudes);
        let is_short = !self.swing.as_ref().is_some_and(Swing::has_a_frequency);
        let is_left_alone = self.inputs.is_empty() && !is_chase && self.failure.is_none();
        self.first_swings_s =
            first_swings_s.filter(|&s| is_short && is_left_alone && s > self.horizon_s);
    }

    /// Returns the duration in seconds of the first swings of the slowest moving mode of an undamped linear body.
    fn first_swings_of_modes_s(&self) -> Option<f64> {
        let modes = self.modes.iter().flatten().filter(|moved| moved.share > 0.0);
        let slowest = modes.filter_map(|moved| moved.mode.swing()).min_by(f64::total_cmp)?;
        let period_s = std::f64::consts::TAU / slowest;
        self.is_oscillator().then_some(f64::from(FOLLOWED_SWINGS) * period_s)
    }

    /// Returns the motion over the long run under this solver.
    ///
    /// # Errors
    /// If the solver fails, the motion up to the failure is returned as the error.
    async fn long_run(&self, solver: Solver, most: usize) -> Result<LongRun, LongRun> {
        let mut body = self.start(solver);
        let mut reach = ReachSoFar::new(Ranges::at(&*body), &self.body);
        let mut sums = vec![0.0; body.q().len()];
        let mut seconds = 0.0;
        let n = sums.len();
        let mut turns = vec![0; n];
        let mut first_swings_s = None;
        let see = |from: &TruthNode, to: &TruthNode| {
            reach.add(from, to);
            for (i, turns) in turns.iter_mut().enumerate() {
                *turns += u32::from((from.x[n + i] < 0.0) != (to.x[n + i] < 0.0));
                if *turns >= 2 * FOLLOWED_SWINGS {
                    first_swings_s = first_swings_s.or(Some(to.t));
                }
            }
            seconds += to.t - from.t;
            for (i, sum) in sums.iter_mut().enumerate() {
                *sum += (to.t - from.t) * (from.x[i] + to.x[i]) / 2.0;
            }
        };
        let walked = self.walk(&mut *body, solver, LONG_RUN * self.horizon_s, most, see).await;
        let means =
            if seconds > 0.0 { sums.iter().map(|sum| sum / seconds).collect() } else { Vec::new() };
        let long = LongRun { reach, means, first_swings_s };
        if walked.is_ok() { Ok(long) } else { Err(long) }
    }

    /// Whether there is no reference solution because it would take too much work.
    pub(super) fn is_too_dear(&self) -> bool {
        matches!(self.failure, Some(StepFailure::ReferenceTooExpensive { .. }))
    }

    /// Whether the body is linear and all its modes are undamped oscillations.
    pub(super) fn is_oscillator(&self) -> bool {
        self.modes.as_ref().is_some_and(|modes| {
            modes.iter().all(|moved| moved.mode.is_conserved() && moved.mode.omega_squared > 0.0)
        })
    }
}

struct LongRun {
    reach: ReachSoFar,
    /// Mean of each coordinate; empty if the motion was not followed.
    means: Vec<f64>,
    /// Time in seconds at which a coordinate has turned back twice for each of the first swings.
    first_swings_s: Option<f64>,
}

/// Returns the adaptive solver of highest order, at [`LONG_RUN_TOLERANCE`]. It suffices for the reach of a motion and
/// its place of rest in the long run, at a tenth of the work of a reference.
fn close_solver() -> Solver {
    let adaptive = GENERAL_METHODS.iter().filter(|method| method.tolerance.is_some());
    let method = adaptive.max_by_key(|method| method.order).expect("a method is adaptive");
    Solver::With(method, Override::tolerance(LONG_RUN_TOLERANCE))
}

/// Returns the second of two moments and, if a velocity has an extreme between both, 15 moments between them.
fn fastest(from: &TruthNode, to: &TruthNode) -> Vec<TruthNode> {
    let n = to.x.len() / 2;
    let turns = (n..2 * n).any(|i| from.slope[i] * to.slope[i] < 0.0);
    let steps = if turns { 1..=16 } else { 16..=16 };
    let at = |step: i32| {
        let part = f64::from(step) / 16.0;
        let x = (0..2 * n).map(|i| from.between(to, i, part)).collect();
        TruthNode { t: from.t + part * (to.t - from.t), x, slope: to.slope.clone() }
    };
    steps.map(at).collect()
}

/// A normal mode and the part of a motion in it.
pub(super) struct MovedMode {
    pub(super) mode: NormalMode,
    /// Initial distance from the mode's equilibrium, and initial velocity.
    pub(super) q: f64,
    pub(super) v: f64,
    /// The mode's share of the energy of the motion.
    pub(super) share: f64,
}

/// Splits the motion of `body` from its current state into the parts in its `modes`.
fn moved(body: &dyn Stepper, modes: Vec<NormalMode>) -> Vec<MovedMode> {
    let n = body.q().len();
    let mut push = vec![0.0; n];
    body.acceleration(0.0, &vec![0.0; n], &vec![0.0; n], &mut push);
    let moved = |mode: NormalMode| {
        let (push, omega2) = (mode.part(&push), mode.omega_squared);
        let (mut q, mut v) = (mode.part(body.q()), mode.part(body.v()));
        if omega2 > 0.0 {
            q -= push / omega2;
        } else if mode.damping_per_s > 0.0 {
            v -= push / mode.damping_per_s;
        }
        MovedMode { mode, q, v, share: v * v + omega2 * q * q }
    };
    let mut modes: Vec<MovedMode> = modes.into_iter().map(moved).collect();
    let all: f64 = modes.iter().map(|moved| moved.share).sum();
    let is_known = all > 0.0 && all.is_finite();
    modes.iter_mut().for_each(|moved| moved.share = if is_known { moved.share / all } else { 0.0 });
    modes
}

#[cfg(test)]
mod tests;
