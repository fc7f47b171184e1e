//! Whether a lane meets a criterion, from a run that ends as soon as the answer is known.
//!
//! Unknown is neither met nor missed. One body that fails decides for the lane; a body that is unknown does not,
//! because a later one may still fail. Modes decide without a run where they can, since they are cheap and hold for all
//! times.

use super::{Judge, without_truth};
use crate::bounce_finding::BounceFinding;
use crate::by_bounces::follow_bounces;
use crate::by_energy::follow_energy;
use crate::by_spin::{follow_long_spin, follow_spin};
use crate::change::bounded;
use crate::criterion::{Criterion, FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
use crate::judged_run::{JudgedRun, Until, follow};
use crate::modes::{Modes, TooMuch};
use crate::pace::Pace;
use crate::spin_finding::SpinFinding;
use crate::truth::BodyTruth;

/// Whether a lane meets a [`Criterion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CriterionFinding {
    /// The lane meets the criterion, at this cost.
    Holds { evaluations_per_s: f64 },
    /// The body with this index in the scene fails.
    Fails { body: usize },
    /// The result is unknown, because it would take too much work, or because there is no truth or no tick.
    Unknown,
}

impl CriterionFinding {
    pub(crate) fn holds(self) -> bool {
        matches!(self, CriterionFinding::Holds { .. })
    }
}

/// The reason why a body is not known to meet a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CriterionMiss {
    /// The body fails.
    Fails,
    /// The result is unknown, because it would take too much work, or because there is no truth.
    Unknown,
}

impl From<TooMuch> for CriterionMiss {
    fn from(_: TooMuch) -> Self {
        CriterionMiss::Unknown
    }
}

impl Judge {
    pub(crate) async fn meets(&self, criterion: Criterion, pace: Pace) -> CriterionFinding {
        if !self.has_ticks(pace.tick_hz) {
            return CriterionFinding::Unknown;
        }
        let mut evaluations_per_s = 0.0;
        let mut is_unknown = false;
        for (body, truth) in self.truths.iter().enumerate() {
            let met = match criterion {
                _ if truth.bounces() => {
                    let most = criterion.outcome();
                    self.bounces_within(truth, pace, |found| found.outcome() <= most).await
                }
                Criterion::Bounded if truth.spins() => {
                    let run = follow_long_spin(truth, pace, self.max_work).await;
                    match run.is_bounded {
                        _ if run.is_too_much => Err(CriterionMiss::Unknown),
                        true => Ok(run.evaluations as f64 / run.seconds),
                        false => Err(CriterionMiss::Fails),
                    }
                }
                _ if truth.spins() => {
                    let most = criterion.outcome();
                    self.spins_within(truth, pace, |found| found.outcome() <= most).await
                }
                Criterion::Bounded => self.is_bounded(truth, pace).await,
                Criterion::LooksRight => self.looks_right(body, pace, None).await,
                Criterion::Accurate => self.is_accurate(truth, pace).await,
            };
            match met {
                Ok(evaluations) => evaluations_per_s += evaluations,
                Err(CriterionMiss::Fails) => return CriterionFinding::Fails { body },
                Err(CriterionMiss::Unknown) => is_unknown = true,
            }
        }
        if is_unknown {
            return CriterionFinding::Unknown;
        }
        // A method with memory starts with a few extra evaluations, which are not part of its long-run cost.
        let Pace { spec, tick_hz } = pace;
        let steady = spec.method.evaluations_per_tick(spec.substeps).map(|evaluations| {
            f64::from(evaluations) * f64::from(tick_hz) * self.truths.len() as f64
        });
        CriterionFinding::Holds { evaluations_per_s: steady.unwrap_or(evaluations_per_s) }
    }

    /// Returns how a lane misses a criterion; `None` if the lane meets it. If the modes prove this, nothing runs.
    pub(crate) async fn misses(
        &self,
        criterion: Criterion,
        pace: Pace,
    ) -> Option<CriterionFinding> {
        if self.is_met_by_modes(criterion, pace).await {
            return None;
        }
        let finding = self.meets(criterion, pace).await;
        Some(finding).filter(|finding| !finding.holds())
    }

    /// Whether the modes of every body prove that the body meets a criterion.
    async fn is_met_by_modes(&self, criterion: Criterion, pace: Pace) -> bool {
        if criterion == Criterion::Accurate || !self.has_ticks(pace.tick_hz) {
            return false;
        }
        for truth in &self.truths {
            let Ok(Some(modes)) = Modes::of(truth, pace).await else { return false };
            let is_met = match criterion {
                Criterion::Bounded => modes.are_bounded(),
                Criterion::Accurate => false,
                Criterion::LooksRight => {
                    let error = modes.frequency_error();
                    let is_told = truth.swing.is_some() && truth.first_swings_s.is_none();
                    is_told
                        && Modes::tell_the_width(truth, pace.spec)
                        && error.is_some_and(|error| error.abs() <= FREQUENCY_TOLERANCE)
                        && modes.are_as_wide(truth.horizon_s) == Some(true)
                }
            };
            if truth.failure.is_some() || !is_met {
                return false;
            }
        }
        true
    }

    /// Whether the bounces of a body are as `is_met` demands.
    async fn bounces_within(
        &self,
        truth: &BodyTruth,
        pace: Pace,
        is_met: impl Fn(&BounceFinding) -> bool,
    ) -> Result<f64, CriterionMiss> {
        let run = follow_bounces(truth, pace, self.max_work).await;
        match run.failure {
            _ if run.is_too_much => Err(CriterionMiss::Unknown),
            None if !run.finding.is_empty() && is_met(&run.finding) => {
                Ok(run.evaluations as f64 / run.seconds)
            }
            _ => Err(CriterionMiss::Fails),
        }
    }

    /// Whether the rotation of a body is as `is_met` demands.
    async fn spins_within(
        &self,
        truth: &BodyTruth,
        pace: Pace,
        is_met: impl Fn(&SpinFinding) -> bool,
    ) -> Result<f64, CriterionMiss> {
        let run = follow_spin(truth, pace, self.max_work).await;
        match run.failure {
            _ if run.is_too_much => Err(CriterionMiss::Unknown),
            None if is_met(&run.finding) => Ok(run.evaluations as f64 / run.finding.seconds),
            _ => Err(CriterionMiss::Fails),
        }
    }

    /// Whether nothing grows that does not grow in truth, over the horizon and in the long run.
    async fn is_bounded(&self, truth: &BodyTruth, pace: Pace) -> Result<f64, CriterionMiss> {
        if truth.is_too_dear() {
            let run = follow_energy(truth, pace, self.max_work).await;
            return match run.is_bounded() {
                _ if run.is_too_much => Err(CriterionMiss::Unknown),
                true => Ok(run.evaluations as f64 / run.seconds),
                false => Err(CriterionMiss::Fails),
            };
        }
        if let Some(modes) = Modes::of(truth, pace).await? {
            if !modes.are_bounded() {
                return Err(CriterionMiss::Fails);
            }
            let run = follow(truth, pace, Until::Horizon, self.max_work).await;
            return cost_if(run.failure.is_none(), &run);
        }
        let run = follow(truth, pace, Until::Grown, self.max_work).await;
        match bounded(truth, &run) {
            Some(is_bounded) => cost_if(is_bounded, &run),
            None => Err(CriterionMiss::Unknown),
        }
    }

    /// Runs a lane beside its truth. The result is unknown if the truth cannot be used.
    async fn beside_truth(
        &self,
        truth: &BodyTruth,
        pace: Pace,
        until: Until,
    ) -> Result<JudgedRun, CriterionMiss> {
        if truth.is_too_dear() {
            return Err(CriterionMiss::Unknown);
        }
        let run = follow(truth, pace, until, self.max_work).await;
        let gap = truth.gap(run.seconds, pace.tick_hz).await;
        without_truth(truth, &run, gap).map_or(Ok(run), |_| Err(CriterionMiss::Unknown))
    }

    /// Whether a body stays within [`TOLERANCE`] of its truth.
    async fn is_accurate(&self, truth: &BodyTruth, pace: Pace) -> Result<f64, CriterionMiss> {
        let run = self.beside_truth(truth, pace, Until::Error(TOLERANCE)).await?;
        cost_if(run.error <= TOLERANCE, &run)
    }

    /// Whether a lane is accurate with the fraction `spare` of [`TOLERANCE`] left on every body with bumps. The errors
    /// of linear bodies have no bumps, because they change steadily with a parameter.
    pub(crate) async fn is_accurate_sparing(&self, spare: f64, pace: Pace) -> bool {
        for truth in &self.truths {
            let spare = if truth.modes.is_none() { spare } else { 0.0 };
            let most = (1.0 - spare) * TOLERANCE;
            if truth.bounces() {
                let within = |found: &BounceFinding| found.error() <= most;
                if self.bounces_within(truth, pace, within).await.is_err() {
                    return false;
                }
                continue;
            }
            if truth.spins() {
                let within = |found: &SpinFinding| found.error() <= most;
                if self.spins_within(truth, pace, within).await.is_err() {
                    return false;
                }
                continue;
            }
            let run = self.beside_truth(truth, pace, Until::Error(most)).await;
            if !run.is_ok_and(|run| run.error <= most && !run.is_too_much) {
                return false;
            }
        }
        true
    }

    /// Whether a body has the true amplitude within [`VISIBLE`] and the true frequency within
    /// [`FREQUENCY_TOLERANCE`]. An accurate motion also looks right.
    ///
    /// A body with too few swings is followed over its first swings instead. A body that does not swing has to stay
    /// within [`VISIBLE`] of its range. `known` is the run over the horizon beside a usable truth, if there is such a
    /// run already.
    pub(super) async fn looks_right(
        &self,
        body: usize,
        pace: Pace,
        known: Option<&JudgedRun>,
    ) -> Result<f64, CriterionMiss> {
        let truth = &self.truths[body];
        let own;
        let run = match known {
            Some(run) => run,
            None => {
                own = self.swinging(truth, pace).await?;
                &own
            }
        };
        if run.failure.is_some() || run.error <= TOLERANCE {
            return cost_if(run.failure.is_none(), run);
        }
        let Some(first_swings_s) = truth.first_swings_s else {
            return cost_if(self.swings_alike(truth, run, pace).await?, run);
        };
        let inputs = truth.inputs_at_start();
        let find = BodyTruth::find(
            &truth.body,
            &inputs,
            self.throttle,
            first_swings_s,
            self.meter.clone(),
        );
        let longer = self.of_swings[body].get(find).await;
        let longer_run = self.swinging(longer, pace).await?;
        let is_alike =
            longer_run.failure.is_none() && self.swings_alike(longer, &longer_run, pace).await?;
        if longer_run.is_too_much { Err(CriterionMiss::Unknown) } else { cost_if(is_alike, run) }
    }

    /// Runs over the horizon of `truth`, measuring the swings if the modes do not determine them.
    async fn swinging(&self, truth: &BodyTruth, pace: Pace) -> Result<JudgedRun, CriterionMiss> {
        let until = match Modes::tell_the_width(truth, pace.spec) {
            true => Until::Horizon,
            false => Until::Swings,
        };
        self.beside_truth(truth, pace, until).await
    }

    /// Whether a run over the horizon of `truth` has the same swings as the truth. If the truth does not swing, whether
    /// the run is similarly close.
    async fn swings_alike(
        &self,
        truth: &BodyTruth,
        run: &JudgedRun,
        pace: Pace,
    ) -> Result<bool, CriterionMiss> {
        // The range is twice the amplitude.
        let is_near = run.error <= 2.0 * VISIBLE;
        let Some(swing) = &truth.swing else { return Ok(is_near) };
        let modes = Modes::of(truth, pace).await?;
        let crossings = run.swings.as_ref().map(|swings| &swings.crossings);
        let error = match &modes {
            Some(modes) => modes.frequency_error(),
            None => crossings.and_then(|crossings| swing.frequency_error(crossings)),
        };
        let Some(error) = error else { return Ok(is_near) };
        let is_as_wide = match (&modes, &run.swings) {
            // If energy is conserved, all half turns are equally wide, and the first one is incomplete.
            (_, Some(swings)) => {
                let first = usize::from(truth.energy_scale.is_some());
                swing.is_as_wide(&swings.half_turns, first)
            }
            (Some(modes), None) => modes.are_as_wide(truth.horizon_s).unwrap_or(is_near),
            (None, None) => is_near,
        };
        // An error that no shift in time explains is one of the shape, or of a chaotic motion that conserves energy.
        let crossings = crossings.filter(|_| truth.energy_scale.is_none());
        let is_of_shape = crossings.is_some_and(|crossings| {
            let shift = swing.lead_s(crossings, run.error_at_s);
            run.error > 2.0 * (swing.error_when(shift) + VISIBLE)
        });
        Ok(is_as_wide && error.abs() <= FREQUENCY_TOLERANCE && !is_of_shape)
    }
}

/// Returns the evaluations per simulated second of a run that meets a criterion.
fn cost_if(holds: bool, run: &JudgedRun) -> Result<f64, CriterionMiss> {
    match holds {
        _ if run.is_too_much => Err(CriterionMiss::Unknown),
        true => Ok(run.evaluations as f64 / run.seconds),
        false => Err(CriterionMiss::Fails),
    }
}
