//! The long-term motion of a linear body under a method of equal steps, from its normal modes.

use super::amplitude::{Measure, Trend};
use super::change::MotionChange;
use super::limits::VISIBLE;
use super::run::MAX_WORK;
use super::truth::{BodyTruth, MovedMode, work_of};
use super::verdict::LongTerm;
use crate::lab::bisection::bisect;
use crate::lab::lane_spec::LaneSpec;
use crate::sim::Stepper;
use crate::sim::integrators::{Family, StepFailure};
use crate::sim::stability::{FOREVER_S, NormalMode, Stability, Tick, unforced};

/// Finding the modes would take more work than a run may.
pub(super) struct TooMuch;

/// The moments at which the amplitude is compared with the true one.
const ENVELOPE_MOMENTS: u32 = 256;

/// The steps from which a mode's map is computed: three from each of two states.
pub(super) const STEPS_PER_MODE: u64 = 6;

/// The step from which its curve is.
const STEPS_PER_CURVE: u64 = 1;

/// The normal modes of a linear body, and their stability under a method of equal steps.
pub(super) struct Modes<'a> {
    modes: Vec<SteppedMode<'a>>,
}

/// A normal mode under a method.
struct SteppedMode<'a> {
    moved: &'a MovedMode,
    stability: Stability,
    curve: Curve,
}

/// The curve on which the steps of a mode lie, beside the true one: both begin in the same state.
struct Curve {
    /// Its amplitude at the start, in units of the true one.
    width: f64,
    /// By how many seconds it is early at the start.
    early_s: f64,
}

impl Curve {
    /// That of a mode that does not swing under both.
    const TRUE: Self = Self { width: 1.0, early_s: 0.0 };
}

impl SteppedMode<'_> {
    fn mode(&self) -> &NormalMode {
        &self.moved.mode
    }

    /// Its energy after `t` seconds, in units of that of the true motion at the start.
    fn energy(&self, t: f64) -> f64 {
        self.curve.width * self.curve.width * self.moved.energy(self.stability.growth_per_s, t)
    }
}

impl MovedMode {
    /// Its share of the energy after it has grown at this rate for `t` seconds.
    fn energy(&self, growth_per_s: f64, t: f64) -> f64 {
        self.share * libm::exp(2.0 * growth_per_s * t)
    }

    /// Its curve under the method of `stepper`, from one `step`: a curve rⁿ (q cos nθ + b sin nθ) through the first two states
    /// of the method is that of all its states.
    ///
    /// # Errors
    /// The failure of the method in the step.
    fn curve(
        &self,
        stepper: &mut dyn Stepper,
        step: Tick,
        stability: &Stability,
    ) -> Result<Curve, StepFailure> {
        let (Some(swing), Some(error)) = (self.mode.swing(), stability.frequency_error) else {
            return Ok(Curve::TRUE);
        };
        let Self { q, v, .. } = *self;
        let side = (v + self.mode.damping_per_s / 2.0 * q) / swing;
        let truth = libm::hypot(q, side);
        let sides = [q / truth, v / truth];
        if sides.iter().any(|side| !side.is_finite()) {
            return Ok(Curve::TRUE);
        }
        let [q, v] = sides;
        let true_phase = libm::atan2(side / truth, q);
        let along = |part: f64| self.mode.shape.iter().map(|x| part * x).collect::<Vec<_>>();
        stepper.set(step.t, &along(q), &along(v));
        stepper.advance(step.t, step.h, step.substeps)?;
        let next = self.mode.part(stepper.q()) * libm::exp(-stability.growth_per_s * step.h);
        let angle = (1.0 + error) * swing * step.h;
        let side = (next - q * libm::cos(angle)) / libm::sin(angle);
        let ahead = libm::remainder(true_phase - libm::atan2(side, q), std::f64::consts::TAU);
        Ok(Curve { width: libm::hypot(q, side), early_s: ahead / swing })
    }
}

impl<'a> Modes<'a> {
    /// `None` if the body is not linear, or if the method chooses its own steps, follows a target or fails.
    ///
    /// # Errors
    /// If that takes too much work.
    pub(super) async fn of(
        truth: &'a BodyTruth,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> Result<Option<Self>, TooMuch> {
        let chooses = spec.method.tolerance.is_some() || !spec.method.keeps_time;
        let is_follower = spec.method.family == Family::Follower;
        let Some(modes) = truth.modes.as_ref().filter(|_| !chooses && !is_follower) else {
            return Ok(None);
        };
        let n = modes.len() as u64;
        // An implicit step takes differences of the force along every coordinate.
        let evaluations = u64::from(spec.method.evaluations.unwrap_or(modes.len() as u32));
        let steps = STEPS_PER_MODE + STEPS_PER_CURVE;
        let work_of_mode = work_of(steps * evaluations, n, spec.solver());
        if work_of_mode.saturating_mul(n) > MAX_WORK {
            return Err(TooMuch);
        }
        let free = unforced(&*truth.with_last_parameters());
        let tick = Tick { t: 0.0, h: 1.0 / f64::from(tick_hz), substeps: spec.substeps };
        let mut found = Vec::with_capacity(modes.len());
        let (step, _) = tick.repeated(Some(spec.method));
        for moved in modes {
            let mut stepper = free.with_solver(spec.solver(), tick.t);
            let Ok(stability) = moved.mode.stability(&*free, spec.solver(), tick) else {
                return Ok(None);
            };
            let Ok(curve) = moved.curve(&mut *stepper, step, &stability) else {
                return Ok(None);
            };
            found.push(SteppedMode { moved, stability, curve });
            truth.meter.pass(work_of_mode).await;
        }
        Ok(Some(Self { modes: found }))
    }

    pub(super) fn are_bounded(&self) -> bool {
        self.modes.iter().all(|mode| mode.stability.is_bounded())
    }

    /// The swinging mode with the most energy.
    fn main(&self) -> Option<&SteppedMode<'a>> {
        let swinging = self.modes.iter().filter(|mode| mode.mode().swing().is_some());
        swinging.max_by(|a, b| a.moved.share.total_cmp(&b.moved.share))
    }

    /// The frequency error of the main mode.
    pub(super) fn frequency_error(&self) -> Option<f64> {
        self.main()?.stability.frequency_error
    }

    /// By how many seconds the main mode is early after `seconds`.
    fn early_s(&self, seconds: f64) -> Option<f64> {
        let main = self.main()?;
        Some(main.curve.early_s + main.stability.frequency_error? * seconds)
    }

    /// Whether the amplitude stays within [`VISIBLE`] of the true one for `seconds`, as the root of the energies of all modes
    /// tells, each with its own width at the start and its own rate of growth or decay. `None` if no mode moves.
    pub(super) fn are_as_wide(&self, seconds: f64) -> Option<bool> {
        let moving = || self.modes.iter().filter(|mode| mode.moved.share > 0.0);
        moving().next()?;
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

    /// The amplitude after `t` seconds, in units of the initial one. Modes that decay in truth contribute their growth only.
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

    /// The first time, up to [`FOREVER_S`], at which `is_past` is true of the amplitude.
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

    /// The change of the motion within the horizon and later.
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
        MotionChange {
            long_term: LongTerm {
                measure,
                doubles_in_s,
                halves_in_s: reaches(is_conserved, |amplitude| amplitude <= 0.5),
                // A mode that has no energy at the start grows out of rounding.
                parasite_doubles_in_s: worst
                    .filter(|&worst| doubles_in_s.is_none_or(|all| worst < all / 2.0)),
                is_bounded: Some(self.are_bounded()),
            },
            within: Trend::of(amplitude),
            energy_change: is_conserved.then_some(amplitude * amplitude - 1.0),
            frequency_error: self.frequency_error(),
            early_s: self.early_s(horizon_s).filter(|_| is_conserved && measure == Measure::Swing),
        }
    }
}

/// The first time at which the amplitude is evaluated, in seconds, and the ratio of each later time to the one before.
const FIRST_LOOK_S: f64 = 1e-9;
const LOOKS_APART: f64 = 1.05;
