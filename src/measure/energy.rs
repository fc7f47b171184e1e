//! The energy of a body during a run, with its drift, and its mean over quarters of the run.

use super::truth::BodyTruth;
use crate::sim::Stepper;

/// Relative loss of amplitude over the second half of the long run from which on a swing counts as losing.
const LOSING: f64 = 0.01;

/// Change of a body's energy since the start, in units of the largest true kinetic energy.
pub(super) struct Energy {
    start: f64,
    scale: Option<f64>,
    /// The unit in percent of the energy that the true motion exchanges.
    pub(super) percent: Option<f64>,
    /// Means over the quarters of the horizon.
    pub(super) horizon: Means,
    /// Means over the quarters of the long run.
    pub(super) long: Means,
}

impl Energy {
    /// Creates a record that starts with the initial energy of `stepper`, for a horizon and a long run that end at the
    /// ticks `horizon` and `end`.
    pub(super) fn of(stepper: &dyn Stepper, truth: &BodyTruth, horizon: u64, end: u64) -> Self {
        let start = stepper.energy().unwrap_or(0.0);
        Self {
            start,
            scale: truth.energy_scale,
            percent: truth.energy_scale.zip(truth.exchanged_j).map(|(a, b)| 100.0 * a / b),
            horizon: Means::over(horizon),
            long: Means::over(end),
        }
    }

    /// Whether the amplitude decreases in the long run.
    pub(super) fn is_losing(&self) -> bool {
        let [_, early, _, late] = self.long.means().map(|drift| (1.0 + drift).max(0.0).sqrt());
        self.scale.is_some() && late < (1.0 - LOSING) * early
    }

    /// Adds the state after `tick` ticks and returns the drift of its energy.
    pub(super) fn add(&mut self, stepper: &dyn Stepper, tick: u64) -> Option<f64> {
        let drift = (stepper.energy()? - self.start) / self.scale?;
        if !drift.is_finite() {
            return None;
        }
        self.horizon.add(tick, drift);
        self.long.add(tick, drift);
        Some(drift)
    }
}

/// Means over the quarters of a run, weighted so that oscillations within a quarter average out.
pub(super) struct Means {
    end: u64,
    sums: [(f64, f64); 4],
}

impl Means {
    pub(super) fn over(end: u64) -> Self {
        Self { end, sums: [(0.0, 0.0); 4] }
    }

    pub(super) fn add(&mut self, tick: u64, value: f64) {
        if tick > self.end {
            return;
        }
        let place = 4.0 * (tick as f64 - 0.5) / self.end as f64;
        let quarter = (place as usize).min(3);
        let part = place - quarter as f64;
        let weight = part * (1.0 - part);
        let weight = weight * weight;
        let (sum, weights) = &mut self.sums[quarter];
        *sum += weight * value;
        *weights += weight;
    }

    pub(super) fn means(&self) -> [f64; 4] {
        self.sums.map(|(sum, weights)| if weights > 0.0 { sum / weights } else { f64::NAN })
    }
}
