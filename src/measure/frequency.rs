//! The frequency error of a lane, from the times at which the lane crosses its centre.
//!
//! The frequency follows from crossings of the centre, because their times do not depend on the amplitude, which may
//! grow or shrink. An error that differs between both halves of the run is no error of the frequency.

use super::judged_run::JudgedRun;
use super::truth::{BodyTruth, Swing};
use crate::sim::numerics::bisect;

/// Minimum number of crossings for a frequency, which is two whole turns.
const FEWEST_CROSSINGS: usize = 3;

/// Relative frequency error of a lane, over all its turns and over each half of them. The error is positive if the lane
/// is too fast.
pub(super) struct FrequencyError {
    pub(super) error: f64,
    /// Seconds by which the lane is early at the end of the horizon; `None` if this is uncertain by a tenth.
    pub(super) early_s: Option<f64>,
    halves: [f64; 2],
    /// Uncertainty of the error, from interpolation between ticks.
    blur: f64,
}

impl FrequencyError {
    /// Whether the error is constant and its uncertainty small.
    pub(super) fn is_steady(&self) -> bool {
        let least = (0.005 * self.error.abs()).max(2.5e-5);
        let [a, b] = self.halves;
        self.blur <= least && (a - b).abs() <= 2.0 * least
    }
}

/// Returns the frequency error of a run; `None` if the run has too few turns.
pub(super) fn frequency_error(truth: &BodyTruth, run: &JudgedRun) -> Option<FrequencyError> {
    let swing = truth.swing.as_ref()?;
    let h = run.horizon_s / run.series.len().max(1) as f64;
    let level = truth.centres[swing.coordinate];
    let lane = crossings(&run.series, level);
    let count = lane.len().min(swing.crossings.len());
    if count < FEWEST_CROSSINGS {
        return None;
    }
    let error = |from: usize, to: usize| {
        let exact = swing.crossings[to] - swing.crossings[from];
        exact / (h * (lane[to].at - lane[from].at)) - 1.0
    };
    let middle = count / 2;
    let span = lane[count - 1].at - lane[0].at;
    let halves = [error(0, middle), error(middle, count - 1)];
    // Either series may have extra crossings before the first common one.
    let more = (h * lane[0].at - swing.crossings[0]) / swing.period();
    let [skipped, skipped_of_lane] = [more, -more].map(|more| libm::round(more.max(0.0)) as usize);
    let mut pairs = swing.crossings.iter().skip(skipped).zip(lane.iter().skip(skipped_of_lane));
    let (last, of_lane) = pairs.next_back()?;
    let early_s = last - h * of_lane.at + halves[1] * (run.horizon_s - last);
    let blur = lane[0].blur + lane[count - 1].blur;
    Some(FrequencyError {
        error: error(0, count - 1),
        early_s: Some(early_s).filter(|early_s| h * blur <= 0.1 * early_s.abs()),
        halves,
        blur: blur / span,
    })
}

/// The place where a series crosses a level upwards, counted in samples.
struct Crossing {
    at: f64,
    /// Uncertainty of `at`.
    blur: f64,
}

fn crossings(series: &[f64], level: f64) -> Vec<Crossing> {
    let passes = |k: &usize| series[*k] < level && series[k + 1] >= level;
    (1..series.len().saturating_sub(2))
        .filter(passes)
        .map(|k| {
            let y: [f64; 4] = std::array::from_fn(|i| series[k - 1 + i] - level);
            let straight = y[1] / (y[1] - y[2]);
            let [low, _] = bisect([0.0, 1.0], 40, |s| cubic(&y, s) < 0.0);
            Crossing { at: (k + 1) as f64 + low, blur: 0.2 * (low - straight).abs() }
        })
        .collect()
}

/// Evaluates the cubic through values at -1, 0, 1 and 2, at `s`.
fn cubic(y: &[f64; 4], s: f64) -> f64 {
    let [a, b, c, d] = y;
    -s * (s - 1.0) * (s - 2.0) / 6.0 * a + (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0 * b
        - (s + 1.0) * s * (s - 2.0) / 2.0 * c
        + (s + 1.0) * s * (s - 1.0) / 6.0 * d
}

impl Swing {
    /// Returns the relative frequency error, over all turns, of a swing that crosses its centre upwards at these times
    /// (s). It is positive if that swing is too fast, and `None` if one of the two swings makes too few turns.
    pub(super) fn frequency_error(&self, crossings: &[f64]) -> Option<f64> {
        let count = crossings.len().min(self.crossings.len());
        let span = |crossings: &[f64]| crossings[count - 1] - crossings[0];
        (count >= FEWEST_CROSSINGS).then(|| span(&self.crossings) / span(crossings) - 1.0)
    }

    /// Whether the swing has enough crossings for a frequency.
    pub(super) fn has_a_frequency(&self) -> bool {
        self.crossings.len() >= FEWEST_CROSSINGS
    }

    /// Returns the mean time between two crossings, in seconds.
    pub(super) fn period(&self) -> f64 {
        let turns = self.crossings.len() - 1;
        (self.crossings[turns] - self.crossings[0]) / turns as f64
    }
}
