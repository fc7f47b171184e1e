//! The long-term motion of a linear body under a method of equal steps, from its normal modes.

use super::amplitude::Trend;
use super::change::MotionChange;
use super::limits::VISIBLE;
use super::run::MAX_WORK;
use super::truth::{BodyTruth, work_of};
use super::verdict::LongTerm;
use crate::lab::bisection::bisect;
use crate::lab::lane_spec::LaneSpec;
use crate::sim::integrators::Family;
use crate::sim::stability::{FOREVER_S, NormalMode, Stability, Tick, unforced};

/// Finding the modes would take more work than a run may.
pub(super) struct TooMuch;

/// The moments at which the amplitude is compared with the true one.
const ENVELOPE_MOMENTS: u32 = 256;

/// The steps from which a mode's map is computed: three from each of two states.
pub(super) const STEPS_PER_MODE: u64 = 6;

/// The normal modes of a linear body, and their stability under a method of equal steps.
pub(super) struct Modes<'a> {
    /// Each with its share of the motion's energy.
    modes: Vec<(&'a NormalMode, f64, Stability)>,
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
        let work_of_mode = work_of(STEPS_PER_MODE * evaluations, n, spec.solver());
        if work_of_mode.saturating_mul(n) > MAX_WORK {
            return Err(TooMuch);
        }
        let free = unforced(&*truth.with_last_parameters());
        let tick = Tick { t: 0.0, h: 1.0 / f64::from(tick_hz), substeps: spec.substeps };
        let mut found = Vec::with_capacity(modes.len());
        for (mode, share) in modes {
            let Ok(stability) = mode.stability(&*free, spec.solver(), tick) else {
                return Ok(None);
            };
            found.push((mode, *share, stability));
            truth.meter.pass(work_of_mode).await;
        }
        Ok(Some(Self { modes: found }))
    }

    pub(super) fn are_bounded(&self) -> bool {
        self.modes.iter().all(|(.., stability)| stability.is_bounded())
    }

    /// The frequency error of the swinging mode with the most energy.
    pub(super) fn frequency_error(&self) -> Option<f64> {
        let swinging = self.modes.iter().filter(|(mode, ..)| mode.swing().is_some());
        swinging.max_by(|a, b| a.1.total_cmp(&b.1))?.2.frequency_error
    }

    /// Whether the amplitude stays within [`VISIBLE`] of the true one for `seconds`, as the root of the energies of all modes
    /// tells, each with its own rate of growth or decay. `None` if no mode moves.
    pub(super) fn are_as_wide(&self, seconds: f64) -> Option<bool> {
        let moving = || self.modes.iter().filter(|(_, share, _)| *share > 0.0);
        moving().next()?;
        let wide = |t: f64, rate: fn(&NormalMode, &Stability) -> f64| {
            let energy = |(mode, share, stability): &(&NormalMode, f64, Stability)| {
                share * libm::exp(2.0 * rate(mode, stability) * t)
            };
            moving().map(energy).sum::<f64>().sqrt()
        };
        let moments =
            (1..=ENVELOPE_MOMENTS).map(|i| seconds * f64::from(i) / f64::from(ENVELOPE_MOMENTS));
        let off = |t: f64| {
            (wide(t, |_, found| found.growth_per_s) - wide(t, |mode, _| -mode.decay_per_s())).abs()
        };
        Some(moments.map(off).all(|off| off <= VISIBLE))
    }

    fn are_conserved(&self) -> bool {
        self.modes.iter().all(|(mode, ..)| mode.is_conserved() && mode.omega_squared > 0.0)
    }

    /// The amplitude after `t` seconds, in units of the initial one. Modes that decay in truth contribute their growth only.
    fn amplitude(&self, t: f64) -> f64 {
        let conserved = self.are_conserved();
        let energy = self.modes.iter().map(|(_, share, stability)| {
            let growth = if stability.is_bounded() { 0.0 } else { stability.growth_per_s };
            let rate = if conserved && growth <= 0.0 { -stability.loss_per_s } else { growth };
            if *share > 0.0 {
                share * libm::exp(2.0 * rate.max(0.0) * t + 2.0 * rate.min(0.0) * t)
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
    pub(super) fn change(&self, swings: bool, horizon_s: f64) -> MotionChange {
        let moves = self.modes.iter().any(|(_, share, _)| *share > 0.0);
        let is_conserved = moves && self.are_conserved();
        let reaches = |is_wanted: bool, is_past: fn(f64) -> bool| {
            if is_wanted { self.reaches(is_past) } else { None }
        };
        let doubles_in_s = reaches(moves, |amplitude| amplitude >= 2.0);
        let worst = self.modes.iter().filter_map(|(.., stability)| stability.doubling_s());
        let worst = worst.min_by(f64::total_cmp);
        let amplitude = if moves { self.amplitude(horizon_s) } else { 1.0 };
        MotionChange {
            long_term: LongTerm {
                swings,
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
        }
    }
}

/// The first time at which the amplitude is evaluated, in seconds, and the ratio of each later time to the one before.
const FIRST_LOOK_S: f64 = 1e-9;
const LOOKS_APART: f64 = 1.05;
