//! What is known of the true motion of one body before any method is compared with it.

use std::sync::atomic::{AtomicU64, Ordering};

use super::survey::{BodyInput, Moment, Ranges, TimedInput, follow_truth};
use crate::lab::extent::Extent;
use crate::lab::scene::SceneBody;
use crate::sim::bodies::{Coordinate, Input, Truth};
use crate::sim::integrators::StepFailure;
use crate::sim::stability::{NormalMode, normal_modes};
use crate::sim::{Solver, Stepper};

mod amplitudes;
mod reach;
mod series;
mod swing;

use amplitudes::{amplitudes, largest_alike};
pub(super) use reach::Reach;
use reach::ReachSoFar;
use series::TruthSeriesByRate;
pub(super) use series::{TruthSeries, ticks};
pub(super) use swing::Swing;

/// The long run of a nonlinear body in horizons.
pub const LONG_RUN: f64 = 20.0;

/// Limits of [`follow_truth`], in moments and in products of the exact flow, n² for a chain of n masses.
const MOST_MOMENTS: usize = 100_000;
const MOST_REFERENCE_MOMENTS: usize = 20_000;
const FEWEST_MOMENTS: usize = 512;
const MOST_PRODUCTS: usize = 40_000_000;

/// The work of one moment of an exact flow and of a reference solution, in evaluations of one coordinate, and the products
/// of a flow's matrix that take as much as one.
const WORK_OF_MOMENT: u64 = 64;
const WORK_OF_REFERENCE_MOMENT: u64 = 256;
const PRODUCTS_PER_EVALUATION: u64 = 4;

/// The true motion of one body under one throttle.
pub(super) struct BodyTruth {
    pub(super) body: SceneBody,
    pub(super) throttle: f64,
    /// The script's actions on the body at tick 0, in order. The motion begins after them.
    at_start: Vec<BodyInput>,
    /// The script's later actions on the body within the horizon, in order.
    pub(super) inputs: Vec<TimedInput>,
    pub(super) horizon_s: f64,
    /// The amplitude of each component of the state, coordinates first.
    pub(super) amplitudes: Vec<f64>,
    /// The centre of each coordinate's swing: the middle of its range, or the place of rest if it loses energy.
    pub(super) centres: Vec<f64>,
    /// How far it reaches over the long run, or until the truth fails.
    pub(super) reach: Reach,
    /// The normal modes of a linear body with its last parameters, each with its share of the energy of the motion after
    /// the last input.
    pub(super) modes: Option<Vec<(NormalMode, f64)>>,
    /// The largest kinetic energy in joules, which is all the energy of an oscillator. `None` if energy is not conserved
    /// or nothing moves.
    pub(super) energy_scale: Option<f64>,
    /// The energy that the motion exchanges, in joules, as the metric `energy_drift` defines it.
    pub(super) exchanged_j: Option<f64>,
    pub(super) swing: Option<Swing>,
    /// Why the truth is not known over the whole horizon; `None` if it is known.
    pub(super) failure: Option<StepFailure>,
    /// Whether it fails before anything has moved: no other walk gets further, and each would pay for it again.
    fails_at_start: bool,
    series_by_rate: TruthSeriesByRate,
    work_done: AtomicU64,
}

impl BodyTruth {
    /// The amplitude of a component is half its true range, or that of the component of the same unit with the largest
    /// range. The amplitude of a constant component is its value.
    pub(super) fn new(
        body: &SceneBody,
        inputs: &[TimedInput],
        throttle: f64,
        horizon_s: f64,
    ) -> Self {
        let (at_start, later) = inputs.iter().partition::<Vec<_>, _>(|input| input.t <= 0.0);
        let later = later.into_iter().filter(|input| input.t < horizon_s);
        let mut truth = Self {
            body: body.clone(),
            throttle,
            at_start: at_start.into_iter().map(|input| input.input.clone()).collect(),
            inputs: later.cloned().collect(),
            horizon_s,
            amplitudes: Vec::new(),
            centres: Vec::new(),
            reach: Reach::Each(Vec::new()),
            modes: None,
            energy_scale: None,
            exchanged_j: None,
            swing: None,
            failure: None,
            fails_at_start: false,
            series_by_rate: TruthSeriesByRate::default(),
            work_done: AtomicU64::new(0),
        };
        truth.survey();
        truth
    }

    /// The body under `solver` at its start, after the script's actions at tick 0.
    pub(super) fn start(&self, solver: Solver) -> Box<dyn Stepper> {
        let mut stepper = (self.body.kind.build)(&self.body.values, solver);
        stepper.input(0.0, Input::Throttle(self.throttle));
        self.at_start.iter().for_each(|input| input.apply_to(&mut *stepper, 0.0));
        stepper
    }

    /// When the last input comes, in seconds; 0 without one.
    pub(super) fn last_input_s(&self) -> f64 {
        self.inputs.last().map_or(0.0, |input| input.t)
    }

    /// The true state after the last input, or after the last that could be reached.
    fn after_inputs(&self) -> Box<dyn Stepper> {
        let mut body = self.start(Solver::Truth);
        let mut t = 0.0;
        for input in &self.inputs {
            if body.advance(t, input.t - t, 1).is_err() {
                break;
            }
            t = input.t;
            input.input.apply_to(&mut *body, t);
        }
        body
    }

    /// The body in its initial state, with the parameters that are in force after the last input.
    pub(super) fn with_last_parameters(&self) -> Box<dyn Stepper> {
        let mut body = self.start(Solver::Truth);
        let is_parameter = |input: &&TimedInput| matches!(input.input, BodyInput::Parameter { .. });
        self.inputs.iter().filter(is_parameter).for_each(|it| it.input.apply_to(&mut *body, it.t));
        body
    }

    pub(super) fn coordinates(&self) -> &'static [Coordinate] {
        (self.body.kind.coordinates)(&self.body.values)
    }

    /// The work done so far on this body, its truth included, in evaluations of one coordinate.
    pub(super) fn work_done(&self) -> u64 {
        self.work_done.load(Ordering::Relaxed)
    }

    /// Counts work that was done on it.
    pub(super) fn count_work(&self, work: u64) {
        self.work_done.fetch_add(work, Ordering::Relaxed);
    }

    /// Counts the work of this many moments of the true motion of `body`, which was followed through them.
    fn count_moments(&self, moments: u64, body: &dyn Stepper) {
        let n = body.q().len() as u64;
        let each = match self.body.kind.truth {
            Truth::Exact => WORK_OF_MOMENT + n * n / PRODUCTS_PER_EVALUATION,
            Truth::Reference => WORK_OF_REFERENCE_MOMENT * n,
        };
        self.count_work(moments * each);
    }

    fn survey(&mut self) {
        let mut body = self.start(Solver::Truth);
        let n = body.q().len();
        let most_moments = match self.body.kind.truth {
            Truth::Exact => MOST_MOMENTS,
            Truth::Reference => MOST_REFERENCE_MOMENTS,
        };
        let most = (MOST_PRODUCTS / (n * n)).clamp(FEWEST_MOMENTS, most_moments);
        let after_inputs = self.after_inputs();
        self.modes = normal_modes(&*after_inputs).map(|modes| shares(&*after_inputs, modes));
        let mut there = self.start(Solver::Truth);
        let mut reach = ReachSoFar::new(Ranges::at(&*body), &self.body);
        let mut kinetic: f64 = body.kinetic_energy().unwrap_or(0.0);
        let mut extent = Extent::default();
        extent.cover(0.0, body.kinetic_energy());
        let conserves = body.energy().is_some() && self.inputs.is_empty();
        let mut moments: u64 = 0;
        let walked = follow_truth(&mut *body, &self.inputs, self.horizon_s, most, |from, to| {
            moments += 1;
            reach.take_in(from, to);
            for moment in fastest(from, to).into_iter().filter(|_| conserves) {
                there.set(0.0, &moment.x[..n], &moment.x[n..]);
                let now = there.kinetic_energy();
                kinetic = kinetic.max(now.unwrap_or(0.0));
                extent.cover(0.0, now);
            }
        });
        self.count_moments(moments, &*body);
        self.exchanged_j = extent.exchanged_j(&*self.start(Solver::Truth));
        self.failure = walked.err();
        self.fails_at_start = self.failure.is_some() && moments == 0;
        self.amplitudes = amplitudes(&reach.ranges.0, self.coordinates());
        self.energy_scale =
            Some(kinetic).filter(|&scale| conserves && scale > 0.0 && scale.is_finite());
        let middle = |range: &(f64, f64)| range.0 + (range.1 - range.0) / 2.0;
        self.centres = reach.ranges.0[..n].iter().map(middle).collect();
        if self.failure.is_none() && self.energy_scale.is_some() {
            self.swing = self.watch(&self.centres, most);
        }
        let returns = self.swing.as_ref().is_some_and(|swing| swing.crossings.len() > 2);
        if !self.is_oscillator() && !returns && !self.fails_at_start {
            // Other motions are followed beyond the horizon, as far as the truth goes.
            let mut body = self.start(Solver::Truth);
            reach = ReachSoFar::new(Ranges::at(&*body), &self.body);
            let mut sums = vec![0.0; n];
            let mut seconds = 0.0;
            let long_run_s = LONG_RUN * self.horizon_s;
            let mut moments = 0;
            let _ = follow_truth(&mut *body, &self.inputs, long_run_s, most, |from, to| {
                moments += 1;
                reach.take_in(from, to);
                seconds += to.t - from.t;
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum += (to.t - from.t) * (from.x[i] + to.x[i]) / 2.0;
                }
            });
            self.count_moments(moments, &*body);
            if self.energy_scale.is_none() && seconds > 0.0 {
                // A motion that comes to rest swings about its place of rest.
                self.centres = sums.iter().map(|sum| sum / seconds).collect();
            }
        }
        // What is knocked away from a target that stays does not swing about it.
        let is_chase = body.pursuit(0.0).is_some_and(|pursuit| pursuit.is_still);
        if self.failure.is_none() && self.energy_scale.is_none() && !is_chase {
            self.swing = self.watch(&self.centres, most);
        }
        self.reach = reach.reach(&self.body, &self.centres, &self.amplitudes);
    }

    /// Whether a reference solution would take too much work, so that there is none.
    pub(super) fn is_too_dear(&self) -> bool {
        matches!(self.failure, Some(StepFailure::ReferenceTooDear { .. }))
    }

    /// Whether the body is linear and all its modes are undamped oscillations.
    pub(super) fn is_oscillator(&self) -> bool {
        self.modes.as_ref().is_some_and(|modes| {
            modes.iter().all(|(mode, _)| mode.is_conserved() && mode.omega_squared > 0.0)
        })
    }
}

/// The second of two moments, and 15 between them if a velocity has an extreme there.
fn fastest(from: &Moment, to: &Moment) -> Vec<Moment> {
    let n = to.x.len() / 2;
    let turns = (n..2 * n).any(|i| from.slope[i] * to.slope[i] < 0.0);
    let steps = if turns { 1..=16 } else { 16..=16 };
    let at = |step: i32| {
        let part = f64::from(step) / 16.0;
        let x = (0..2 * n).map(|i| from.between(to, i, part)).collect();
        Moment { t: from.t + part * (to.t - from.t), x, slope: to.slope.clone() }
    };
    steps.map(at).collect()
}

/// Each mode's share of the energy of `body` about its equilibrium.
fn shares(body: &dyn Stepper, modes: Vec<NormalMode>) -> Vec<(NormalMode, f64)> {
    let n = body.q().len();
    let mut push = vec![0.0; n];
    body.acceleration(0.0, &vec![0.0; n], &vec![0.0; n], &mut push);
    let energy = |mode: &NormalMode| {
        let (push, omega2) = (mode.part(&push), mode.omega_squared);
        let (mut q, mut v) = (mode.part(body.q()), mode.part(body.v()));
        if omega2 > 0.0 {
            q -= push / omega2;
        } else if mode.damping_per_s > 0.0 {
            v -= push / mode.damping_per_s;
        }
        v * v + omega2 * q * q
    };
    let energies: Vec<f64> = modes.iter().map(energy).collect();
    let all: f64 = energies.iter().sum();
    let share = |energy: f64| if all > 0.0 && all.is_finite() { energy / all } else { 0.0 };
    modes.into_iter().zip(energies).map(|(mode, energy)| (mode, share(energy))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Scene;

    fn truth(text: &str, seconds: f64) -> BodyTruth {
        let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{text}");
        let scene = Scene::parse("t", &text).unwrap();
        BodyTruth::new(&scene.bodies[0], &[], 1.0, seconds)
    }

    #[test]
    fn amplitudes_do_not_depend_on_the_ratio_of_period_and_horizon() {
        let omega = std::f64::consts::TAU;
        for seconds in [1.0, 20.0, 511.0, 512.0, 1024.0] {
            let spring =
                format!("[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {}\n", omega * omega);
            let [q, v] = truth(&spring, seconds).amplitudes[..] else { panic!("one coordinate") };
            assert!(
                (q - 1.0).abs() < 1e-4 && (v / omega - 1.0).abs() < 1e-4,
                "{seconds} s: {q}, {v}"
            );
        }
        // 512 periods and a half in 20 s.
        let fast = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 25872.6957612\nx0_m = 0\nv0_m_per_s = 10\n";
        let [q, v] = truth(fast, 20.0).amplitudes[..] else { panic!("one coordinate") };
        let omega = 25_872.695_761_2_f64.sqrt();
        assert!((q * omega / 10.0 - 1.0).abs() < 1e-4 && (v / 10.0 - 1.0).abs() < 1e-4, "{q}, {v}");
        // Gone within a hundredth of the stretch: the velocity's range is that of its first swing.
        let damped =
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 10000\ndamping_n_s_per_m = 100\n";
        let [q, v] = truth(damped, 60.0).amplitudes[..] else { panic!("one coordinate") };
        let dense = (0..200_000).map(|i| f64::from(i) * 5e-7).map(|t| {
            let w = 7500.0_f64.sqrt();
            let decay = libm::exp(-50.0 * t);
            let x = decay * (libm::cos(w * t) + 50.0 / w * libm::sin(w * t));
            (x, -decay * 10_000.0 / w * libm::sin(w * t))
        });
        let (mut x, mut y) = ((1.0_f64, 1.0_f64), (0.0_f64, 0.0_f64));
        for (q, v) in dense {
            x = (x.0.min(q), x.1.max(q));
            y = (y.0.min(v), y.1.max(v));
        }
        let (expected_q, expected_v) = ((x.1 - x.0) / 2.0, (y.1 - y.0) / 2.0);
        assert!((q / expected_q - 1.0).abs() < 1e-3, "{q}, not {expected_q}");
        assert!((v / expected_v - 1.0).abs() < 1e-3, "{v}, not {expected_v}");
    }

    #[test]
    fn an_eccentric_orbit_keeps_the_peak_of_its_speed() {
        // Of eccentricity 0.998: 2000 times as fast near the centre as far from it.
        let orbit =
            "[[orbit]]\nmu_m3_per_s2 = 1000\nx0_m = 100\nvy0_m_per_s = 0.1414213562373095\n";
        let truth = truth(orbit, 200.0);
        let fastest = truth.amplitudes[3];
        assert!((fastest / 70.78 - 1.0).abs() < 0.01, "{fastest}");
    }

    #[test]
    fn a_pendulum_swings_at_the_period_of_its_amplitude() {
        let truth = truth("[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 0.7\n", 20.0);
        let swing = truth.swing.unwrap();
        let n = swing.crossings.len() - 1;
        let period = (swing.crossings[n] - swing.crossings[0]) / n as f64;
        // 2π √(l/g) (1 + θ²/16 + 11 θ⁴/3072 + 173 θ⁶/737280)
        let series = 1.0
            + 0.49 / 16.0
            + 11.0 * 0.49_f64.powi(2) / 3072.0
            + 173.0 * 0.49_f64.powi(3) / 737_280.0;
        let expected = std::f64::consts::TAU * (0.4_f64 / 9.81).sqrt() * series;
        assert!((period / expected - 1.0).abs() < 1e-5, "{period}, not {expected}");
        let whole = &swing.half_turns[..swing.half_turns.len() - 1];
        assert_eq!(whole.len(), 2 * swing.crossings.len() + 1, "from rest at the right: {whole:?}");
        assert!(whole.iter().all(|peak| (peak - 1.0).abs() < 1e-3), "{whole:?}");
    }
}
