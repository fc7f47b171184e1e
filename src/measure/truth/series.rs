//! The true states of one body at the ticks of one rate, with the inputs at those ticks.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

use super::{BodyTruth, FollowedBody, ticks};
use crate::run::race::StopReason;
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, TickRate};
use crate::slices::Once;

/// Maximum number of products of the exact flow for one series, which is less than a second of work.
const MAX_SERIES_PRODUCTS: u64 = 500_000_000;

/// Maximum number of cached values, which are some thirty megabytes. They suffice for a rope at each rate that a search
/// of margins tries. A full cache is cleared.
const MAX_KEPT: usize = 1 << 22;

/// Cached series by tick rate in Hz. If several threads request the same one, the first thread computes it.
pub(crate) type TruthSeriesByRate = Mutex<HashMap<TickRate, Arc<Once<Arc<TruthSeries>>>>>;

/// The true states at the ticks of one rate.
pub(crate) struct TruthSeries {
    /// The components after each tick, in order.
    values: Vec<f64>,
    components: usize,
    /// Largest error of the truth up to each tick, in amplitudes.
    gaps: Vec<f64>,
    pub(crate) failure: Option<StepFailure>,
    /// Whether the series is missing because it would take too much work.
    pub(crate) is_too_much: bool,
}

impl TruthSeries {
    /// Returns the components after `tick` ticks, where `tick` is at least 1; `None` after the truth has failed.
    pub(crate) fn at(&self, tick: u64) -> Option<&[f64]> {
        let from = (tick as usize - 1) * self.components;
        self.values.get(from..from + self.components)
    }

    /// Returns the largest error of the truth up to `tick` ticks, in amplitudes; infinite after the truth has failed.
    pub(crate) fn gap(&self, tick: u64) -> f64 {
        self.gaps.get(tick as usize - 1).copied().unwrap_or(f64::INFINITY)
    }
}

impl BodyTruth {
    /// Returns the largest error of the truth up to this time, in amplitudes, at the ticks of this rate.
    pub(crate) async fn gap(&self, seconds: f64, tick_hz: TickRate) -> f64 {
        self.series(tick_hz).await.gap(ticks(seconds, tick_hz).max(1))
    }

    /// Returns the true states at the ticks of this rate, up to the horizon.
    pub(crate) async fn series(&self, tick_hz: TickRate) -> Arc<TruthSeries> {
        let once = {
            let mut series_by_rate = self.series_by_rate.lock().expect("no thread panics with it");
            let known = series_by_rate.values().filter_map(|once| once.get_if_known());
            let held: usize = known.map(|series| series.values.len()).sum();
            if held > MAX_KEPT && !series_by_rate.contains_key(&tick_hz) {
                series_by_rate.clear();
            }
            Arc::clone(series_by_rate.entry(tick_hz).or_default())
        };
        Arc::clone(once.get(async { Arc::new(self.compute_series(tick_hz).await) }).await)
    }

    async fn compute_series(&self, tick_hz: TickRate) -> TruthSeries {
        let n = self.coordinates().len();
        let mut series = TruthSeries {
            values: Vec::new(),
            components: 2 * n,
            gaps: Vec::new(),
            failure: None,
            is_too_much: false,
        };
        let mut gap: f64 = 0.0;
        let ticks = ticks(self.horizon_s, tick_hz);
        let is_spent = self.meter.budget_left() == 0;
        if is_spent || ticks.saturating_mul((n * n) as u64) > MAX_SERIES_PRODUCTS {
            series.is_too_much = true;
            return series;
        }
        if self.fails_at_start && ticks > 0 {
            series.failure.clone_from(&self.failure);
            return series;
        }
        let mut run = self.follow(Solver::Truth, 1, tick_hz);
        let see = |body: &FollowedBody, _| {
            let body = &*body.stepper;
            series.values.extend(body.q().iter().chain(body.v()));
            let off = body.truth_error().unwrap_or([0.0; 2]);
            for (i, amplitude) in self.amplitudes.iter().enumerate() {
                let part = off[i / n] / amplitude;
                gap = if part <= gap { gap } else { part };
            }
            series.gaps.push(gap);
            ControlFlow::Continue(())
        };
        if let StopReason::Failed(failure) = self.run_until(&mut run, ticks, see).await {
            series.failure = Some(failure);
        }
        series
    }
}
