//! The long-term motion of a linear body under a method of equal steps, from its normal modes.

use super::amplitude::{Measure, Trend};
use super::change::MotionChange;
use super::criterion::VISIBLE;
use super::judged_run::MAX_WORK;
use super::pace::Pace;
use super::swing_curve::SwingCurve;
use super::truth::{BodyTruth, MovedMode, work_of};
use super::verdict::LongTerm;
use crate::scene::LaneSpec;
use crate::sim::Stepper;
use crate::sim::integrators::{Family, StepFailure};
use crate::sim::numerics::bisect;
use crate::sim::stability::{FOREVER_S, NormalMode, Stability, Tick, unforced};

/// The error if finding the modes would exceed the work limit of a run.
pub(super) struct TooMuch;

/// Number of moments at which the amplitude is compared with the true one.
const ENVELOPE_MOMENTS: u32 = 256;

/// Number of steps to compute a mode's map, which is three from each of two states.
pub(super) const STEPS_PER_MODE: u64 = 6;

/// Number of steps to compute a mode's curve.
const STEPS_PER_CURVE: u64 = 1;

/// The normal modes of a linear body, and their stability under a method of equal steps.
pub(super) struct Modes<'a> {
    modes: Vec<SteppedMode<'a>>,
    /// Step length of the method, in seconds.
    step_s: f64,
}

/// A normal mode under a method.
struct SteppedMode<'a> {
    moved: &'a MovedMode,
    stability: Stability,
    /// The true curve, and the curve through the method's states, in units of the true initial amplitude. `None` if the
    /// mode does not swing in truth or under the method.
    curves: Option<[SwingCurve; 2]>,
}

impl SteppedMode<'_> {
    fn mode(&self) -> &NormalMode {
        &self.moved.mode
    }

    /// Returns the energy after `t` seconds, relative to that of the true motion at the start.
    fn energy(&self, t: f64) -> f64 {
        let width = self.curves.map_or(1.0, |[_, own]| own.width());
        width * width * self.moved.energy(self.stability.growth_per_s, t)
    }
}

impl MovedMode {
    /// Returns the mode's share of the energy after `t` seconds of growth at this rate.
    fn energy(&self, growth_per_s: f64, t: f64) -> f64 {
        self.share * libm::exp(2.0 * growth_per_s * t)
    }

    /// Returns the mode's true curve, and its curve under the method of `stepper` from one `step`. Both begin in the
    /// same state. The curve through the method's first two states contains all later ones. `None` if the mode does not
    /// swing in truth or under the method.
    ///
    /// # Errors
    /// If the method fails in the step.
    fn curves(
        &self,
        stepper: &mut dyn Stepper,
        step: Tick,
        stability: &Stability,
    ) -> Result<Option<[SwingCurve; 2]>, StepFailure> {
        let (Some(swing), Some(error)) = (self.mode.swing(), stability.frequency_error) else {
            return Ok(None);
        };
        let Self { q, v, .. } = *self;
        let decay_per_s = self.mode.decay_per_s();
        let amplitude = libm::hypot(q, (v + decay_per_s * q) / swing);
        let sides = [q / amplitude, v / amplitude];
        if sides.iter().any(|side| !side.is_finite()) {
            return Ok(None);
        }
        let [q, v] = sides;
        let b = (v + decay_per_s * q) / swing;
        let truth = SwingCurve { q, b, growth_per_s: -decay_per_s, frequency: swing };
        let along = |part: f64| self.mode.shape.iter().map(|x| part * x).collect::<Vec<_>>();
        stepper.set(step.t, &along(q), &along(v));
        stepper.advance(step.t, step.h, step.substeps)?;
        let (growth_per_s, frequency) = (stability.growth_per_s, (1.0 + error) * swing);
        let next = self.mode.part(stepper.q()) * libm::exp(-growth_per_s * step.h);
        let angle = frequency * step.h;
        let b = (next - q * libm::cos(angle)) / libm::sin(angle);
        Ok(Some([truth, SwingCurve { q, b, growth_per_s, frequency }]))
    }
}

impl<'a> Modes<'a> {
    /// Returns the true modes, if the method acts on each of them separately.
    fn modes_of(truth: &BodyTruth, spec: LaneSpec) -> Option<&Vec<MovedMode>> {
        let chooses = spec.method.tolerance.is_some() || !spec.method.keeps_time;
        let is_follower = spec.method.family == Family::Follower;
        truth.modes.as_ref().filter(|_| !chooses && !is_follower)
    }

    /// Whether the modes determine the width of the swing, which requires that there is no input.
    pub(super) fn tell_the_width(truth: &BodyTruth, spec: LaneSpec) -> bool {
        Self::modes_of(truth, spec).is_some() && truth.inputs.is_empty()
    }

    /// Finds the modes; `None` if the body is not linear, or if the method chooses its own steps, follows a target or
    /// fails.
    ///
    /// # Errors
    /// Fails if this takes too much work.
    pub(super) async fn of(
        truth: &'a BodyTruth,
        Pace { spec, tick_hz }: Pace,
    ) -> Result<Option<Self>, TooMuch> {
        let Some(modes) = Self::modes_of(truth, spec) else { return Ok(None) };
        let n = modes.len() as u64;
        // An implicit step computes differences of the force along every coordinate.
        let evaluations = u64::from(spec.method.evaluations.unwrap_or(modes.len() as u32));
        let steps = STEPS_PER_MODE + STEPS_PER_CURVE;
        let work_of_mode = work_of(steps * evaluations, n, spec.solver());
        if work_of_mode.saturating_mul(n) > MAX_WORK {
            return Err(TooMuch);
        }
        let free = unforced(&*truth.with_last_parameters());
        let tick = Tick { t: 0.0, h: tick_hz.step_s(), substeps: spec.substeps };
        let mut found = Vec::with_capacity(modes.len());
        let (step, _) = tick.repeated(Some(spec.method));
        for moved in modes {
            let mut stepper = free.with_solver(spec.solver(), tick.t);
            let Ok(stability) = moved.mode.stability(&*free, spec.solver(), tick) else {
                return Ok(None);
            };
            let Ok(curves) = moved.curves(&mut *stepper, step, &stability) else {
                return Ok(None);
            };
            found.push(SteppedMode { moved, stability, curves });
            truth.meter.yield_after(work_of_mode).await;
        }
        Ok(Some(Self { modes: found, step_s: step.h }))
    }

    pub(super) fn are_bounded(&self) -> bool {
        self.modes.iter().all(|mode| mode.stability.is_bounded())
    }

    /// Returns the swinging mode with the most energy.
    fn main(&self) -> Option<&SteppedMode<'a>> {
        let swinging = self.modes.iter().filter(|mode| mode.mode().swing().is_some());
        swinging.max_by(|a, b| a.moved.share.total_cmp(&b.moved.share))
    }

    /// Returns the frequency error of the main mode.
    pub(super) fn frequency_error(&self) -> Option<f64> {
        self.main()?.stability.frequency_error
    }

    /// Returns the true curve of the main mode, and its curve under the method.
    fn main_curves(&self) -> Option<&[SwingCurve; 2]> {
        self.main()?.curves.as_ref()
    }

    /// Whether the amplitude stays within [`VISIBLE`] of the true one for `seconds`. `None` if no mode moves.
    ///
    /// With one mode, half turns are compared. With several modes, the amplitude is the root of their total energy,
    /// where each mode has its own initial width and rate of growth or decay.
    pub(super) fn are_as_wide(&self, seconds: f64) -> Option<bool> {
        let moving = || self.modes.iter().filter(|mode| mode.moved.share > 0.0);
        moving().next()?;
        if let [SteppedMode { curves: Some([truth, own]), .. }] = &self.modes[..] {
            return Some(truth.misfit(own, self.step_s, seconds) <= VISIBLE);
        }
        let off = |t: f64| {
            let own: f64 = moving().map(|mode| mode.energy(t)).sum();
            let decay = |mode: &SteppedMode| mode.moved.energy(-mode.mode().decay_per_s(), t);
            let exact: f64 = moving().map(decay).sum();
            (own.sqrt() - exact.sqrt()).abs()
        };
        let mut moments =
            (0..=ENVELOPE_MOMENTS).map(|i| seconds * f64::from(i) / f64::from(ENVELOPE_MOMENTS));
        Some(moments.all(|t| off(t) <= VISIBLE))
    }

    fn are_conserved(&self) -> bool {
        let is_conserved = |mode: &NormalMode| mode.is_conserved() && mode.omega_squared > 0.0;
        self.modes.iter().all(|mode| is_conserved(mode.mode()))
    }

    /// Returns the amplitude after `t` seconds, relative to the initial amplitude. Modes that decay in truth contribute
    /// only their growth.
    fn amplitude(&self, t: f64) -> f64 {
        let conserved = self.are_conserved();
        let energy = self.modes.iter().map(|SteppedMode { moved, stability, .. }| {
            let growth = if stability.is_bounded() { 0.0 } else { stability.growth_per_s };
            let rate = if conserved && growth <= 0.0 { -stability.loss_per_s } else { growth };
            if moved.share > 0.0 {
                moved.share * libm::exp(2.0 * rate.max(0.0) * t + 2.0 * rate.min(0.0) * t)
            } else {
                0.0
            }
        });
        energy.sum::<f64>().sqrt()
    }

    /// Returns the first time, up to [`FOREVER_S`], at which the amplitude satisfies `is_past`.
    fn reaches(&self, is_past: impl Fn(f64) -> bool) -> Option<f64> {
        let (mut low, mut high) = (0.0, FIRST_LOOK_S);
        while !is_past(self.amplitude(high)) {
            (low, high) = (high, high * LOOKS_APART);
            if low > FOREVER_S {
                return None;
            }
        }
        let [_, past] = bisect([low, high], 60, |t| !is_past(self.amplitude(t)));
        Some(past)
    }

    /// Returns the change of the motion within the horizon and later.
    pub(super) fn change(&self, measure: Measure, horizon_s: f64) -> MotionChange {
        let moves = self.modes.iter().any(|mode| mode.moved.share > 0.0);
        let is_conserved = moves && self.are_conserved();
        let reaches = |is_wanted: bool, is_past: fn(f64) -> bool| {
            if is_wanted { self.reaches(is_past) } else { None }
        };
        let doubles_in_s = reaches(moves, |amplitude| amplitude >= 2.0);
        let worst = self.modes.iter().filter_map(|mode| mode.stability.doubling_s());
        let worst = worst.min_by(f64::total_cmp);
        let amplitude = if moves { self.amplitude(horizon_s) } else { 1.0 };
        let curves = self.main_curves().filter(|_| measure == Measure::Swing);
        MotionChange {
            long_term: LongTerm {
                measure,
                doubles_in_s,
                halves_in_s: reaches(is_conserved, |amplitude| amplitude <= 0.5),
                // A mode without initial energy grows out of rounding.
                parasite_doubles_in_s: worst
                    .filter(|&worst| doubles_in_s.is_none_or(|all| worst < all / 2.0)),
                is_bounded: Some(self.are_bounded()),
            },
            within: Trend::of(amplitude),
            energy_change: is_conserved.then_some(amplitude * amplitude - 1.0),
            frequency_error: self.frequency_error(),
            early_s: curves
                .filter(|_| is_conserved)
                .map(|[truth, own]| own.lead_s(truth, horizon_s)),
            width: curves.map(|[truth, own]| own.widest() / truth.widest()),
        }
    }
}

/// First time at which the amplitude is evaluated, in seconds, and ratio of successive times.
const FIRST_LOOK_S: f64 = 1e-9;
const LOOKS_APART: f64 = 1.05;
