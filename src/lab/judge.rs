//! How far a lane strays from the truth over a scene, and whether it holds: what verdicts and advice
//! are made of.
//!
//! A scene is judged from its start, without its script, under one throttle from beginning to end.

use super::lane::Lane;
use super::metrics;
use super::scene::{LaneSpec, Scene};
use super::trend::growth_of_energy;
use super::verdict::{Fate, Verdict};
use crate::sim::bodies::{Coordinate, Input};
use crate::sim::stability::{Stability, Tick};
use crate::sim::{Solver, Stepper};

/// The error that still counts as accurate: a hundredth of the amplitude, about what can be seen.
pub const TOLERANCE: f64 = 0.01;

/// The longest stretch that is judged, in simulated seconds. Shorter scenes are judged whole; longer
/// ones would make a search for a rate take minutes.
pub const LONGEST_HORIZON_S: f64 = 60.0;

/// Moments at which a lane is held against the truth: some twenty a turn of what turns once a second.
const MOMENTS: u64 = 512;

/// An error in amplitudes that no lane makes which only lags or leads: twice the range of the motion.
const ASTRAY: f64 = 4.0;

/// States of the true motion over which the stability is averaged of a nonlinear body that conserves no
/// energy.
const STATES: u32 = 32;

/// The most steps of a stretch over which the energy of a body is followed: about a second's work. The
/// longest horizon at the highest rate takes fewer; only many substeps make the stretch shorter.
const MOST_FOLLOWED: u64 = 1_000_000;

/// A half range this small against the largest value is rounding: the body keeps that value.
const KEEPS_STILL: f64 = 1e-9;

/// The truth over a scene, to hold lanes against.
pub struct Judge {
    scene: Scene,
    throttle: f64,
    horizon_s: f64,
    /// For each body, the amplitude of each component of its state, coordinates first.
    amplitudes: Vec<Vec<f64>>,
    /// For each body that conserves its energy, how much there is of it in joules without what is there at
    /// rest: twice the mean of what is kinetic, which is all of an oscillator's.
    energies: Vec<Option<f64>>,
}

/// How a lane fared.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The largest error of a coordinate or a velocity, as a part of its amplitude; infinite for a lane
    /// that did not get through.
    pub error: f64,
    /// The body that is furthest off, or that failed, by its place in the scene.
    pub body: usize,
    /// The energy drift of largest magnitude, in percent as the metric has it; `None` where no body
    /// conserves energy.
    pub energy_drift: Option<f64>,
    /// What ended the lane, if something did.
    pub fate: Option<Fate>,
    /// Evaluations of all bodies' accelerations.
    pub evaluations: u64,
    /// How far the lane came, in simulated seconds.
    pub seconds: f64,
}

impl Outcome {
    /// Whether the error stayed within [`TOLERANCE`].
    pub fn is_accurate(&self) -> bool {
        self.error <= TOLERANCE
    }
}

impl Judge {
    /// For `scene` under this throttle, -1 to 1.
    ///
    /// The amplitude of a component is half the range that the truth covers in it, or in another
    /// component of the same body and unit that covers more; of what keeps its value, that value.
    pub fn new(scene: &Scene, throttle: f64) -> Self {
        Self::over(scene, throttle, scene.seconds.min(LONGEST_HORIZON_S))
    }

    /// The same over `horizon_s` simulated seconds, more than 0, however long the scene is.
    pub fn over(scene: &Scene, throttle: f64, horizon_s: f64) -> Self {
        let (scene, amplitudes) = (scene.clone(), Vec::new());
        let mut judge = Self { scene, throttle, horizon_s, amplitudes, energies: Vec::new() };
        (judge.amplitudes, judge.energies) = judge.measure();
        judge
    }

    /// The throttle that the scene is judged under.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }

    /// The simulated seconds that lanes are held against the truth.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// What is to be said of a lane at this tick rate.
    pub fn verdict(&self, spec: LaneSpec, tick_hz: u32) -> Verdict {
        self.verdict_within(spec, tick_hz, f64::INFINITY)
    }

    /// The same over no more than `most_s` seconds. Amplitudes stay those of the whole.
    pub fn verdict_within(&self, spec: LaneSpec, tick_hz: u32, most_s: f64) -> Verdict {
        let horizon_s = self.horizon_s.min(most_s);
        let outcome = self.run(spec, tick_hz, horizon_s, f64::INFINITY);
        Verdict::new(self.stability(spec, tick_hz), outcome, horizon_s)
    }

    /// How the method treats deviations, the worst of all bodies in each respect: of a linear body about
    /// the start; of a nonlinear one by the trend of its energy or, where it conserves none, about states
    /// of its true motion in the mean. `None` where the method cannot get through its first ticks.
    pub fn stability(&self, spec: LaneSpec, tick_hz: u32) -> Option<Stability> {
        Some(self.over_the_motion(spec, tick_hz)?.0)
    }

    /// The same, and whether all bodies are linear.
    fn over_the_motion(&self, spec: LaneSpec, tick_hz: u32) -> Option<(Stability, bool)> {
        let bodies = self.truth().into_iter().enumerate();
        let all: Option<Vec<(Stability, bool)>> =
            bodies.map(|(i, body)| self.of_body(i, body, spec, tick_hz)).collect();
        all?.into_iter().reduce(|(a, a_linear), (b, b_linear)| (worse(a, b), a_linear && b_linear))
    }

    /// The same of one body, whose truth stands at the start.
    fn of_body(
        &self,
        place: usize,
        mut body: Box<dyn Stepper>,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> Option<(Stability, bool)> {
        let h = 1.0 / f64::from(tick_hz);
        let tick = |t: f64| Tick { t, h, substeps: spec.substeps };
        let of = |body: &dyn Stepper, t: f64| Stability::of(body, spec.solver(), tick(t)).ok();
        let start = of(&*body, 0.0)?;
        let mut lane = body.with_solver(spec.solver(), 0.0);
        let stretch = self.horizon_s / f64::from(STATES);
        body.advance(0.0, stretch, 1).ok()?;
        let next = of(&*body, stretch)?;
        if alike(&start, &next) {
            return Some((start, true));
        }
        if let Some(scale) = self.energies[place] {
            let ticks = (self.horizon_s / h).round() as u64;
            let ticks = ticks.min(MOST_FOLLOWED / u64::from(spec.substeps)).max(1);
            let growth = growth_of_energy(&mut *lane, tick(0.0), ticks, scale);
            let growth_per_s = growth.unwrap_or(f64::INFINITY);
            let loss_per_s = (-growth_per_s).max(0.0);
            return Some((
                Stability { growth_per_s, loss_per_s, frequency_error: None, ..start },
                false,
            ));
        }
        let mut states = vec![start, next];
        for i in 1..STATES {
            let t = stretch * f64::from(i);
            body.advance(t, stretch, 1).ok()?;
            states.push(of(&*body, t + stretch)?);
        }
        Some((mean(&states), false))
    }

    /// How a lane fares over the horizon at this tick rate, but no further than the error is within [`TOLERANCE`].
    pub fn outcome_while_accurate(&self, spec: LaneSpec, tick_hz: u32) -> Outcome {
        self.run(spec, tick_hz, self.horizon_s, TOLERANCE)
    }

    /// Whether no body's deviations grow and, where one is nonlinear and small deviations do not tell
    /// all, none strays further than twice the range of its motion.
    pub fn is_stable(&self, spec: LaneSpec, tick_hz: u32) -> bool {
        let Some((stability, is_linear)) = self.over_the_motion(spec, tick_hz) else {
            return false;
        };
        stability.is_bounded()
            && (is_linear || self.run(spec, tick_hz, self.horizon_s, ASTRAY).error <= ASTRAY)
    }

    /// Coordinates of all bodies together.
    pub(super) fn coordinates(&self) -> u64 {
        self.amplitudes.iter().map(|body| body.len() as u64 / 2).sum()
    }

    /// Steps a lane to the horizon, or until its error is more than `enough`.
    fn run(&self, spec: LaneSpec, tick_hz: u32, horizon_s: f64, enough: f64) -> Outcome {
        let hz = f64::from(tick_hz);
        let ticks = ((horizon_s * hz).round() as u64).max(1);
        let stride = (ticks / MOMENTS).max(1);
        let mut lane = Lane::new(&self.scene, spec.solver(), spec.substeps);
        lane.input(0, 0.0, Input::Throttle(self.throttle));
        let mut truth = self.truth();
        let (mut error, mut worst, mut tick, mut compared) = (0.0, 0, 0, 0);
        let mut energy_drift: Option<f64> = None;
        while tick < ticks && error <= enough {
            lane.tick(tick, tick as f64 / hz, 1.0 / hz);
            tick += 1;
            if lane.halted().is_some() {
                break;
            }
            if tick.is_multiple_of(stride) || tick == ticks {
                let (from, to) = (compared as f64 / hz, tick as f64 / hz);
                compared = tick;
                for (i, body) in truth.iter_mut().enumerate() {
                    if body.advance(from, to - from, 1).is_err() {
                        continue;
                    }
                    let stepped = &*lane.bodies()[i].stepper;
                    let off = self.error(i, stepped, &**body);
                    if off > error {
                        (error, worst) = (off, i);
                    }
                    if let Some(drift) = metrics::energy_drift(stepped, &**body)
                        && energy_drift.is_none_or(|largest| drift.abs() > largest.abs())
                    {
                        energy_drift = Some(drift);
                    }
                }
            }
        }
        let fate = lane.halted().map(|halt| {
            (error, worst) = (f64::INFINITY, halt.body);
            Fate { t: halt.tick as f64 / hz, failure: halt.failure.clone() }
        });
        let (evaluations, seconds) = (lane.evaluations(), tick as f64 / hz);
        Outcome { error, body: worst, energy_drift, fate, evaluations, seconds }
    }

    /// The largest error of a component of this body, in amplitudes.
    fn error(&self, body: usize, lane: &dyn Stepper, truth: &dyn Stepper) -> f64 {
        let pairs = components(lane).zip(components(truth)).zip(&self.amplitudes[body]);
        pairs.map(|((lane, truth), amplitude)| (lane - truth).abs() / amplitude).fold(0.0, f64::max)
    }

    /// Every body at its start on the exact flow.
    fn truth(&self) -> Vec<Box<dyn Stepper>> {
        let bodies = self.scene.bodies.iter().map(|body| {
            let mut stepper = (body.kind.build)(&body.values, Solver::Truth);
            stepper.input(0.0, Input::Throttle(self.throttle));
            stepper
        });
        bodies.collect()
    }

    /// The amplitudes and the energies.
    fn measure(&self) -> (Vec<Vec<f64>>, Vec<Option<f64>>) {
        let mut truth = self.truth();
        let mut energies = vec![Some(0.0); truth.len()];
        let mut ranges: Vec<Vec<(f64, f64)>> =
            truth.iter().map(|body| components(&**body).map(|x| (x, x)).collect()).collect();
        let at = |moment: u64| self.horizon_s * moment as f64 / MOMENTS as f64;
        for moment in 0..MOMENTS {
            for ((body, ranges), energy) in truth.iter_mut().zip(&mut ranges).zip(&mut energies) {
                if body.advance(at(moment), at(moment + 1) - at(moment), 1).is_ok() {
                    for (range, x) in ranges.iter_mut().zip(components(&**body)) {
                        *range = (range.0.min(x), range.1.max(x));
                    }
                    let part = kinetic_energy(&**body).map(|now| 2.0 * now / MOMENTS as f64);
                    *energy = energy.zip(part).map(|(sum, part)| sum + part);
                }
            }
        }
        let bodies = ranges.iter().zip(&self.scene.bodies);
        let amplitudes =
            bodies.map(|(ranges, body)| amplitudes(ranges, (body.kind.coordinates)(&body.values)));
        (amplitudes.collect(), energies)
    }
}

/// What the body's motion takes of its energy, in joules; `None` where it conserves none.
fn kinetic_energy(body: &dyn Stepper) -> Option<f64> {
    let whole = body.energy()?;
    let mut still = body.with_solver(Solver::Truth, 0.0);
    still.set(0.0, body.q(), &vec![0.0; body.v().len()]);
    Some(whole - still.energy()?)
}

fn components(stepper: &dyn Stepper) -> impl Iterator<Item = f64> {
    stepper.q().iter().chain(stepper.v()).copied()
}

/// The amplitude of each component, from what the truth covers.
fn amplitudes(ranges: &[(f64, f64)], coordinates: &[Coordinate]) -> Vec<f64> {
    let n = ranges.len() / 2;
    let unit = |i: usize| coordinates[i % n].unit;
    let alike = |i: usize| (0..2 * n).filter(move |&j| i / n == j / n && unit(i) == unit(j));
    let most =
        |of: fn(&(f64, f64)) -> f64, i: usize| alike(i).map(|j| of(&ranges[j])).fold(0.0, f64::max);
    let amplitude = |i: usize| {
        let half = most(|(low, high)| (high - low) / 2.0, i);
        let largest = most(|(low, high)| low.abs().max(high.abs()), i);
        match (half > KEEPS_STILL * largest, largest > 0.0) {
            (true, _) => half,
            (false, true) => largest,
            (false, false) => 1.0,
        }
    };
    (0..2 * n).map(amplitude).collect()
}

/// Whether a body is seen to be linear: the same in two states.
fn alike(a: &Stability, b: &Stability) -> bool {
    let near = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-6 * (1e-3 + a.abs());
    near(a.spectral_radius, b.spectral_radius) && near(a.growth_per_s, b.growth_per_s)
}

fn mean(states: &[Stability]) -> Stability {
    let of =
        |value: fn(&Stability) -> f64| states.iter().map(value).sum::<f64>() / states.len() as f64;
    let errors: Vec<f64> = states.iter().filter_map(|s| s.frequency_error).collect();
    let frequency_error = errors.iter().sum::<f64>() / errors.len() as f64;
    Stability {
        spectral_radius: of(|s| s.spectral_radius),
        growth_per_s: of(|s| s.growth_per_s),
        loss_per_s: of(|s| s.loss_per_s),
        frequency_error: (!errors.is_empty()).then_some(frequency_error),
    }
}

fn worse(a: Stability, b: Stability) -> Stability {
    let frequency_error = match (a.frequency_error, b.frequency_error) {
        (Some(a), Some(b)) => Some(if a.abs() > b.abs() { a } else { b }),
        (a, b) => a.or(b),
    };
    Stability {
        spectral_radius: a.spectral_radius.max(b.spectral_radius),
        growth_per_s: a.growth_per_s.max(b.growth_per_s),
        loss_per_s: a.loss_per_s.max(b.loss_per_s),
        frequency_error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    #[test]
    fn the_amplitude_is_half_the_range_or_what_is_kept() {
        let ship = kind("ship").unwrap().plain_coordinates();
        assert_eq!(amplitudes(&[(-1.0, 3.0), (20.0, 20.0)], ship), [2.0, 20.0]);
        assert_eq!(amplitudes(&[(0.0, 0.0), (5.0, 5.0 + 1e-12)], ship), [1.0, 5.0 + 1e-12]);
    }

    #[test]
    fn the_energy_drift_is_the_largest_on_the_way() {
        let outcome = |scene: &str, id: &str, tick_hz| {
            let judge = Judge::new(&Scene::built_in(scene).unwrap(), 1.0);
            judge.verdict(LaneSpec::plain(method(id).unwrap()), tick_hz).outcome
        };
        // The energy swings as h ω / 2 sin 2ωt, and at the end of whole periods it is what it was.
        let swing = 100.0 * std::f64::consts::PI / 60.0;
        let drift = outcome("spring", "semi-implicit-euler", 60).energy_drift.unwrap();
        assert!((0.9..1.1).contains(&(drift.abs() / swing)), "{drift} %");
        // It loses z⁶/72 a step, and ends with the largest loss.
        let lost = -100.0 * 1200.0 * (std::f64::consts::TAU / 60.0).powi(6) / 72.0;
        let drift = outcome("spring", "rk4", 60).energy_drift.unwrap();
        assert!((0.95..1.05).contains(&(drift / lost)), "{drift} %, not {lost}");
        assert_eq!(outcome("ship", "rk4", 2).energy_drift, None);
    }

    #[test]
    fn a_swing_of_one_metre_has_an_amplitude_of_one_metre() {
        let judge = Judge::new(&Scene::built_in("spring").unwrap(), 1.0);
        let [q, v] = judge.amplitudes[0][..] else { panic!("one coordinate") };
        assert!(
            (q - 1.0).abs() < 1e-4 && (v / std::f64::consts::TAU - 1.0).abs() < 1e-3,
            "{q}, {v}"
        );
    }
}
