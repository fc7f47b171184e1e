//! What is known of the true motion of one body before any method is held against it.

use super::survey::{Moment, Ranges, TimedInput, walk};
use crate::lab::extent::Extent;
use crate::lab::scene::SceneBody;
use crate::sim::bodies::{Coordinate, Input, Truth};
use crate::sim::integrators::StepFailure;
use crate::sim::stability::{NormalMode, normal_modes};
use crate::sim::{Solver, Stepper};

use course::Courses;

mod course;

pub(super) use course::{Course, ticks};

/// A nonlinear body is followed for this many times the horizon, to see what becomes of it in the long run.
pub const LONG_RUN: f64 = 20.0;

/// A half range this small against the largest value is rounding: the body keeps that value.
const KEEPS_STILL: f64 = 1e-9;

/// Moments of a walk, and products that its exact flow takes, at most: for a chain the square of its masses at each
/// moment.
const MOST_MOMENTS: usize = 100_000;
const MOST_REFERENCE_MOMENTS: usize = 20_000;
const FEWEST_MOMENTS: usize = 512;
const MOST_PRODUCTS: usize = 40_000_000;

/// A crossing at less than this part of the largest speed is no swing any more.
const FAINT: f64 = 1e-3;

/// The windows in which the swing is compared, at most.
const MOST_WINDOWS: usize = 64;

/// The true motion of one body under one throttle.
pub(super) struct BodyTruth {
    pub(super) body: SceneBody,
    pub(super) throttle: f64,
    /// What the scene's script does to it within the horizon, in order.
    pub(super) inputs: Vec<TimedInput>,
    pub(super) horizon_s: f64,
    /// The amplitude of each component of the state, coordinates first.
    pub(super) amplitudes: Vec<f64>,
    /// What each coordinate swings about: the middle of its range or, where its energy goes, where it comes to rest.
    pub(super) centres: Vec<f64>,
    /// The middle and half the range of each component over the long run, or as far as the truth goes.
    pub(super) reach: Vec<(f64, f64)>,
    /// The normal modes of a linear body, each with its share of the energy of the motion.
    pub(super) modes: Option<Vec<(NormalMode, f64)>>,
    /// The energy in motion in joules: the largest kinetic energy, which is all of an oscillator's. `None` where none is
    /// conserved, or nothing moves.
    pub(super) energy_scale: Option<f64>,
    /// The energy that the motion exchanges, in joules, as the metric of energy drift has it.
    pub(super) exchanged_j: Option<f64>,
    pub(super) swing: Option<Swing>,
    /// Why the truth is not known over the whole horizon, if it is not.
    pub(super) failure: Option<StepFailure>,
    courses: Courses,
}

/// How a body swings in truth.
pub(super) struct Swing {
    /// The coordinate that is watched.
    pub(super) coordinate: usize,
    /// When it passes its middle upwards, in seconds.
    pub(super) crossings: Vec<f64>,
    /// The largest swing from the middle of any coordinate, in amplitudes, in each of equal windows of the horizon.
    pub(super) windows: Vec<f64>,
}

impl BodyTruth {
    /// The amplitude of a component is half the range that the truth covers in it, or in another component of the
    /// same body and unit that covers more; of what keeps its value, that value.
    pub(super) fn new(
        body: &SceneBody,
        inputs: &[TimedInput],
        throttle: f64,
        horizon_s: f64,
    ) -> Self {
        let mut truth = Self {
            body: body.clone(),
            throttle,
            inputs: inputs.iter().filter(|input| input.t < horizon_s).cloned().collect(),
            horizon_s,
            amplitudes: Vec::new(),
            centres: Vec::new(),
            reach: Vec::new(),
            modes: None,
            energy_scale: None,
            exchanged_j: None,
            swing: None,
            failure: None,
            courses: Courses::default(),
        };
        truth.survey();
        truth
    }

    /// The body at its start under `solver`.
    pub(super) fn start(&self, solver: Solver) -> Box<dyn Stepper> {
        let mut stepper = (self.body.kind.build)(&self.body.values, solver);
        stepper.input(0.0, Input::Throttle(self.throttle));
        stepper
    }

    /// When the last input comes, in seconds; 0 without one.
    pub(super) fn last_input_s(&self) -> f64 {
        self.inputs.last().map_or(0.0, |input| input.t)
    }

    /// The truth once all inputs are given, or as near to that as it comes.
    fn after_inputs(&self) -> Box<dyn Stepper> {
        let mut body = self.start(Solver::Truth);
        let mut t = 0.0;
        for input in &self.inputs {
            if body.advance(t, input.t - t, 1).is_err() {
                break;
            }
            t = input.t;
            input.given.to(&mut *body, t);
        }
        body
    }

    pub(super) fn coordinates(&self) -> &'static [Coordinate] {
        (self.body.kind.coordinates)(&self.body.values)
    }

    fn survey(&mut self) {
        let mut body = self.start(Solver::Truth);
        let n = body.q().len();
        let most_moments = match self.body.kind.truth {
            Truth::Exact => MOST_MOMENTS,
            Truth::Reference => MOST_REFERENCE_MOMENTS,
        };
        let most = (MOST_PRODUCTS / (n * n)).clamp(FEWEST_MOMENTS, most_moments);
        self.modes = normal_modes(&*body).map(|modes| shares(&*self.after_inputs(), modes));
        let mut there = self.start(Solver::Truth);
        let mut ranges = Ranges::at(&*body);
        let mut kinetic: f64 = body.kinetic_energy().unwrap_or(0.0);
        let mut extent = Extent::default();
        extent.cover(0.0, body.kinetic_energy());
        let conserves = body.energy().is_some() && self.inputs.is_empty();
        let walked = walk(&mut *body, &self.inputs, self.horizon_s, most, |from, to| {
            ranges.take_in(from, to);
            for moment in fastest(from, to).into_iter().filter(|_| conserves) {
                there.set(0.0, &moment.x[..n], &moment.x[n..]);
                let now = there.kinetic_energy();
                kinetic = kinetic.max(now.unwrap_or(0.0));
                extent.cover(0.0, now);
            }
        });
        self.exchanged_j = extent.exchanged_j(&*self.start(Solver::Truth));
        self.failure = walked.err();
        self.amplitudes = amplitudes(&ranges.0, self.coordinates());
        self.energy_scale =
            Some(kinetic).filter(|&scale| conserves && scale > 0.0 && scale.is_finite());
        let middle = |range: &(f64, f64)| range.0 + (range.1 - range.0) / 2.0;
        self.centres = ranges.0[..n].iter().map(middle).collect();
        if self.failure.is_none() && self.energy_scale.is_some() {
            self.swing = self.watch(&self.centres, most);
        }
        let returns = self.swing.as_ref().is_some_and(|swing| swing.crossings.len() > 2);
        if !self.is_oscillator() && !returns {
            // What becomes of other motions beyond the horizon is followed as far as it can be.
            let mut body = self.start(Solver::Truth);
            ranges = Ranges::at(&*body);
            let mut sums = vec![0.0; n];
            let mut seconds = 0.0;
            let _ = walk(&mut *body, &self.inputs, LONG_RUN * self.horizon_s, most, |from, to| {
                ranges.take_in(from, to);
                seconds += to.t - from.t;
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum += (to.t - from.t) * (from.x[i] + to.x[i]) / 2.0;
                }
            });
            if self.energy_scale.is_none() && seconds > 0.0 {
                // What comes to rest swings about the place where it does.
                self.centres = sums.iter().map(|sum| sum / seconds).collect();
            }
        }
        if self.failure.is_none() && self.energy_scale.is_none() {
            self.swing = self.watch(&self.centres, most);
        }
        let reach = |i: usize| {
            let (low, high) = ranges.0[i];
            let centre = self.centres.get(i).copied().unwrap_or_else(|| middle(&ranges.0[i]));
            (centre, (high - centre).max(centre - low).max(self.amplitudes[i]))
        };
        self.reach = (0..2 * n).map(reach).collect();
        let halves: Vec<f64> = self.reach.iter().map(|(_, half)| *half).collect();
        for (i, reach) in self.reach.iter_mut().enumerate() {
            reach.1 = largest_alike((self.body.kind.coordinates)(&self.body.values), &halves, i);
        }
    }

    /// Whether all that it does is to swing for ever, linearly.
    pub(super) fn is_oscillator(&self) -> bool {
        self.modes.as_ref().is_some_and(|modes| {
            modes.iter().all(|(mode, _)| mode.is_conserved() && mode.omega_squared > 0.0)
        })
    }

    /// Follows the swing about the middles of the coordinates.
    fn watch(&self, middles: &[f64], most: usize) -> Option<Swing> {
        let n = middles.len();
        let mut crossings = vec![Vec::new(); n];
        let fast: Vec<f64> = self.amplitudes[n..].iter().map(|v| FAINT * v).collect();
        let mut peaks: Vec<(f64, f64)> = Vec::new();
        let mut body = self.start(Solver::Truth);
        walk(&mut *body, &self.inputs, self.horizon_s, most, |from, to| {
            let mut peak: f64 = 0.0;
            for i in 0..n {
                let (a, b) = (from.x[i] - middles[i], to.x[i] - middles[i]);
                peak = peak.max(a.abs().max(b.abs()) / self.amplitudes[i]);
                if a < 0.0 && b >= 0.0 && to.t > from.t && to.x[n + i] > fast[i] {
                    crossings[i].push(crossing(from, to, i, middles[i]));
                }
                if from.slope[i] * to.slope[i] < 0.0 {
                    let within = (1..8).map(|s| from.between(to, i, f64::from(s) / 8.0));
                    let most = within.map(|x| (x - middles[i]).abs()).fold(0.0, f64::max);
                    peak = peak.max(most / self.amplitudes[i]);
                }
            }
            peaks.push((to.t, peak));
        })
        .ok()?;
        let coordinate = (0..n).find(|&i| crossings[i].len() >= 2)?;
        let crossings = std::mem::take(&mut crossings[coordinate]);
        let mut swing = Swing { coordinate, crossings, windows: Vec::new() };
        let count = ((self.horizon_s / swing.period()) as usize).clamp(1, MOST_WINDOWS);
        swing.windows = vec![0.0; count];
        for (t, peak) in peaks {
            let window = &mut swing.windows[window(t / self.horizon_s, count)];
            *window = window.max(peak);
        }
        Some(swing)
    }
}

/// The window, of `count`, that this part of the horizon falls into.
pub(super) fn window(part: f64, count: usize) -> usize {
    ((part * count as f64) as usize).min(count - 1)
}

/// When coordinate `i` passes `level` between two moments, in seconds.
fn crossing(from: &Moment, to: &Moment, i: usize, level: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if from.between(to, i, middle) < level { low = middle } else { high = middle }
    }
    from.t + low * (to.t - from.t)
}

/// The end of a piece of the way, and where a velocity is largest within it, some moments about there.
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

/// The share of each mode in the energy of the motion of `body` about its rest.
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

/// The largest of the values that are of the same half of the state as component `i` and in its unit.
fn largest_alike(coordinates: &[Coordinate], values: &[f64], i: usize) -> f64 {
    let n = coordinates.len();
    let is_alike = |j: &usize| i / n == j / n && coordinates[i % n].unit == coordinates[j % n].unit;
    (0..2 * n).filter(is_alike).map(|j| values[j]).fold(0.0, f64::max)
}

/// The amplitude of each component, from what the truth covers.
fn amplitudes(ranges: &[(f64, f64)], coordinates: &[Coordinate]) -> Vec<f64> {
    let halves: Vec<f64> = ranges.iter().map(|(low, high)| (high - low) / 2.0).collect();
    let sizes: Vec<f64> = ranges.iter().map(|(low, high)| low.abs().max(high.abs())).collect();
    let amplitude = |i: usize| {
        let half = largest_alike(coordinates, &halves, i);
        let largest = largest_alike(coordinates, &sizes, i);
        match (half > KEEPS_STILL * largest, largest > 0.0) {
            (true, _) => half,
            (false, true) => largest,
            (false, false) => 1.0,
        }
    };
    (0..ranges.len()).map(amplitude).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Scene;
    use crate::sim::bodies::kind;

    #[test]
    fn the_amplitude_is_half_the_range_or_what_is_kept() {
        let ship = kind("ship").unwrap().plain_coordinates();
        assert_eq!(amplitudes(&[(-1.0, 3.0), (20.0, 20.0)], ship), [2.0, 20.0]);
        assert_eq!(amplitudes(&[(0.0, 0.0), (5.0, 5.0 + 1e-12)], ship), [1.0, 5.0 + 1e-12]);
    }

    fn truth(text: &str, seconds: f64) -> BodyTruth {
        let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{text}");
        let scene = Scene::parse("t", &text).unwrap();
        BodyTruth::new(&scene.bodies[0], &[], 1.0, seconds)
    }

    #[test]
    fn amplitudes_are_those_of_the_motion_whatever_its_period_is_to_the_stretch() {
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
        assert!(swing.windows.iter().all(|peak| (peak - 1.0).abs() < 1e-3));
    }
}
