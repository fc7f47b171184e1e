//! Whether a lane meets a criterion: a run that ends as soon as that is known.

use super::{Judge, without_truth};
use crate::lab::analysis::by_energy::follow_energy;
use crate::lab::analysis::change::bounded;
use crate::lab::analysis::frequency::frequency_error;
use crate::lab::analysis::limits::{FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
use crate::lab::analysis::modes::{Modes, TooMuch};
use crate::lab::analysis::run::{Run, Until, follow};
use crate::lab::analysis::truth::BodyTruth;
use crate::lab::lane_spec::LaneSpec;

/// Whether a lane meets a [`Criterion`](crate::lab::Criterion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::lab::analysis) enum CriterionFinding {
    /// It does, at this cost.
    Holds { evaluations_per_s: f64 },
    /// The body at this index of the scene does not.
    Fails { body: usize },
    /// Not known: it would take too much work, or there is no truth or no tick.
    Unknown,
}

/// Why a body is not known to meet a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum CriterionMiss {
    /// It does not meet it.
    Fails,
    /// Not known: it would take too much work, or there is no truth.
    Unknown,
}

impl From<TooMuch> for CriterionMiss {
    fn from(_: TooMuch) -> Self {
        CriterionMiss::Unknown
    }
}

impl Judge {
    /// Whether nothing grows that does not grow in truth, over the horizon and in the long run.
    pub(in crate::lab::analysis) fn is_bounded(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            if truth.is_too_dear() {
                let run = follow_energy(truth, spec, tick_hz, self.max_work);
                return match run.is_bounded() {
                    _ if run.is_too_much => Err(CriterionMiss::Unknown),
                    true => Ok(run.evaluations as f64 / run.seconds),
                    false => Err(CriterionMiss::Fails),
                };
            }
            if let Some(modes) = Modes::of(truth, spec, tick_hz)? {
                if !modes.are_bounded() {
                    return Err(CriterionMiss::Fails);
                }
                let run = follow(truth, spec, tick_hz, Until::Horizon, self.max_work);
                return cost_if(run.failure.is_none(), &run);
            }
            let run = follow(truth, spec, tick_hz, Until::Grown, self.max_work);
            match bounded(truth, &run) {
                Some(is_bounded) => cost_if(is_bounded, &run),
                None => Err(CriterionMiss::Unknown),
            }
        })
    }

    /// Whether the modes of every body tell that it is bounded.
    pub(in crate::lab::analysis) fn is_bounded_by_modes(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> bool {
        self.by_modes(spec, tick_hz, |_, modes| modes.are_bounded())
    }

    /// Whether the modes of every body tell that it looks right.
    pub(in crate::lab::analysis) fn looks_right_by_modes(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> bool {
        self.by_modes(spec, tick_hz, |truth, modes| {
            truth.swing.is_some()
                && modes.frequency_error().is_some_and(|error| error.abs() <= FREQUENCY_TOLERANCE)
                && self.are_as_wide(truth, modes) == Some(true)
        })
    }

    /// Whether every body is linear and `tells` is true of its modes.
    fn by_modes(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
        tells: impl Fn(&BodyTruth, &Modes) -> bool,
    ) -> bool {
        let told = |truth: &BodyTruth| match Modes::of(truth, spec, tick_hz) {
            Ok(Some(modes)) => truth.failure.is_none() && tells(truth, &modes),
            Ok(None) | Err(TooMuch) => false,
        };
        self.has_ticks(tick_hz) && self.truths.iter().all(told)
    }

    /// Whether the modes keep the true amplitude; `None` if an input changes it, or if nothing moves.
    fn are_as_wide(&self, truth: &BodyTruth, modes: &Modes) -> Option<bool> {
        if truth.inputs.is_empty() { modes.are_as_wide(self.horizon_s) } else { None }
    }

    /// The run of a lane, of which nothing is known if the truth cannot be used for it.
    fn beside_truth(
        &self,
        truth: &BodyTruth,
        spec: LaneSpec,
        tick_hz: u32,
        until: Until,
    ) -> Result<Run, CriterionMiss> {
        if truth.is_too_dear() {
            return Err(CriterionMiss::Unknown);
        }
        let run = follow(truth, spec, tick_hz, until, self.max_work);
        let gap = truth.gap(run.seconds, tick_hz);
        without_truth(truth, &run, gap).map_or(Ok(run), |_| Err(CriterionMiss::Unknown))
    }

    /// Whether every body stays within [`TOLERANCE`] of its truth.
    pub(in crate::lab::analysis) fn is_accurate(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            let run = self.beside_truth(truth, spec, tick_hz, Until::Error(TOLERANCE))?;
            cost_if(run.error <= TOLERANCE, &run)
        })
    }

    /// Whether every body has the true amplitude within [`VISIBLE`] and the true frequency within
    /// [`FREQUENCY_TOLERANCE`]. A body that makes too few turns has to stay within [`VISIBLE`] of its range. What is
    /// accurate looks right.
    pub(in crate::lab::analysis) fn looks_right(
        &self,
        spec: LaneSpec,
        tick_hz: u32,
    ) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            let run = self.beside_truth(truth, spec, tick_hz, Until::Horizon)?;
            if run.failure.is_some() || run.error <= TOLERANCE {
                return cost_if(run.failure.is_none(), &run);
            }
            // The range is twice the amplitude.
            let is_near = run.error <= 2.0 * VISIBLE;
            let Some(swing) = &truth.swing else { return cost_if(is_near, &run) };
            let modes = Modes::of(truth, spec, tick_hz)?;
            let error = match &modes {
                Some(modes) => modes.frequency_error(),
                None => frequency_error(truth, &run).map(|measured| measured.error),
            };
            let Some(error) = error else { return cost_if(is_near, &run) };
            let is_as_wide = modes
                .and_then(|modes| self.are_as_wide(truth, &modes))
                .unwrap_or_else(|| swing.is_as_wide(&run.half_turns, tick_hz));
            cost_if(is_as_wide && error.abs() <= FREQUENCY_TOLERANCE, &run)
        })
    }

    /// Applies `of` to every body, which returns the evaluations per second of a body that meets the criterion.
    fn each(
        &self,
        tick_hz: u32,
        of: impl Fn(&BodyTruth) -> Result<f64, CriterionMiss>,
    ) -> CriterionFinding {
        if !self.has_ticks(tick_hz) {
            return CriterionFinding::Unknown;
        }
        let mut evaluations_per_s = 0.0;
        let mut is_unknown = false;
        for (body, truth) in self.truths.iter().enumerate() {
            match of(truth) {
                Ok(evaluations) => evaluations_per_s += evaluations,
                Err(CriterionMiss::Fails) => return CriterionFinding::Fails { body },
                Err(CriterionMiss::Unknown) => is_unknown = true,
            }
        }
        if is_unknown {
            CriterionFinding::Unknown
        } else {
            CriterionFinding::Holds { evaluations_per_s }
        }
    }
}

/// The evaluations per simulated second of a run, if it meets a criterion.
fn cost_if(holds: bool, run: &Run) -> Result<f64, CriterionMiss> {
    match holds {
        _ if run.is_too_much => Err(CriterionMiss::Unknown),
        true => Ok(run.evaluations as f64 / run.seconds),
        false => Err(CriterionMiss::Fails),
    }
}
