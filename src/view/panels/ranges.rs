//! Ranges of the axes of plots, which include the truth and the healthy lanes. A lane far beyond them is cut off and
//! does not change an axis.

use super::tracks::Track;
use crate::chart::AxisScale;

/// Minimum error that plots show, as a power of ten. Smaller errors are only rounding.
const FLOOR: f64 = -17.0;
/// Maximum share (%) that counts as healthy. A larger share extends no axis while another lane is healthy.
const HEALTHY_SHARE: f64 = 25.0;
/// Maximum share (%) before the motion counts as lost.
const LOST_SHARE: f64 = 300.0;
/// Maximum drift (%) before the motion counts as lost, and minimum drift, below which a drift is only rounding.
const LOST_DRIFT: f64 = 1e4;
const MIN_DRIFT: f64 = 1e-9;
/// Minimum half range of an axis, relative to the axis's values. The labels of a body that has not yet moved are then
/// no longer than later labels.
const MIN_HALF_RANGE: f64 = 0.02;

/// Returns the range of the truth along an axis. The range extends to all values of the lanes that are at most
/// `healthy` times as far from its middle.
pub(super) fn around_truth(
    truth: impl Iterator<Item = f64>,
    lanes: &[Track],
    axis: usize,
    healthy: f64,
) -> (f64, f64) {
    let (low, high) = range(truth).unwrap_or((-1.0, 1.0));
    let far = high.abs().max(low.abs());
    let half = if far > 0.0 { ((high - low) / 2.0).max(MIN_HALF_RANGE * far) } else { 1.0 };
    let middle = (low + high) / 2.0;
    let near = |value: &f64| (value - middle).abs() <= healthy * half;
    let all = lanes.iter().flat_map(|lane| lane.along(axis)).filter(near);
    let (low, high) = range(all.chain([low, high])).unwrap_or((low, high));
    let pad = (0.12 * (high - low)).max(half - (high - low) / 2.0);
    (low - pad, high + pad)
}

/// Extends a range to include these points, but to at most `times` its size on each side of its middle.
pub(super) fn with_room<'a>(
    (low, high): (f64, f64),
    points: impl Iterator<Item = &'a [f64; 2]>,
    times: f64,
) -> (f64, f64) {
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let [least, most] = [-1.0, 1.0].map(|sign| middle + sign * times * half);
    let values = points.map(|at| at[1]).filter(|value| value.is_finite());
    values.fold((low, high), |(low, high), value| {
        let value = value.clamp(least, most);
        (low.min(value), high.max(value))
    })
}

/// Returns the range of the truth along an axis, and of the lanes that always stay within `healthy` times that range.
pub(super) fn around_orbit(
    truth: impl Iterator<Item = f64> + Clone,
    lanes: &[Track],
    axis: usize,
    healthy: f64,
) -> (f64, f64) {
    let (low, high) = range(truth).unwrap_or((-1.0, 1.0));
    let (half, middle) = ((high - low) / 2.0, (low + high) / 2.0);
    let near = |lane: &&Track| lane.along(axis).all(|y| (y - middle).abs() <= healthy * half);
    let lanes = lanes.iter().filter(near).flat_map(|lane| lane.along(axis));
    around_truth(lanes.chain([low, high]), &[], axis, healthy)
}

/// Returns the decades of the errors, up to ten times the `size` of the quantity. A lane with a larger error is lost.
pub(super) fn of_decades(lanes: &[Track], size: f64) -> (f64, f64) {
    let lost = libm::log10(size.max(1e-300)).ceil() + 1.0;
    let all = lanes.iter().flat_map(|lane| lane.along(1));
    let (low, high) = range(all.filter(|&y| y > FLOOR && y <= lost)).unwrap_or((-3.0, 0.0));
    (low.floor() - 0.2, high.ceil().max(low.floor() + 2.0) + 0.2)
}

/// Returns the range of shares, in percent of the truth. The range includes zero and the healthy lanes. If no lane is
/// healthy, it includes all values that are not lost.
pub(super) fn of_shares(lanes: &[Track]) -> (f64, f64) {
    let most = |lane: &&Track| lane.along(1).map(f64::abs).fold(0.0, f64::max);
    let healthy = lanes.iter().filter(|lane| !lane.is_empty() && most(lane) <= HEALTHY_SHARE);
    let values = healthy.flat_map(|lane| lane.along(1));
    let all = || lanes.iter().flat_map(|lane| lane.along(1)).filter(|y| y.abs() <= LOST_SHARE);
    padded(range(values).or_else(|| range(all())))
}

/// Returns the drift (%) up to which a symmetric scale is linear. It is just below the drift of the lane that drifts
/// least.
pub(super) fn linear_drift(lanes: &[Track]) -> f64 {
    let most = |lane: &Track| lane.along(1).map(f64::abs).fold(0.0, f64::max);
    let least = lanes.iter().map(most).filter(|&drift| drift > 0.0).fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        libm::pow(10.0, libm::floor(libm::log10(least))).clamp(MIN_DRIFT, 0.1)
    } else {
        0.1
    }
}

/// Returns the range of drifts on a symmetric scale, which includes zero and all values that are not lost.
pub(super) fn of_drift(lanes: &[Track], scale: AxisScale) -> (f64, f64) {
    let lost = scale.place(LOST_DRIFT);
    let all = lanes.iter().flat_map(|lane| lane.along(1)).filter(|y| y.abs() <= lost);
    padded(range(all))
}

/// Returns the range that includes zero and all values of a count or a sum.
pub(super) fn from_zero(lanes: &[Track]) -> (f64, f64) {
    padded(range(lanes.iter().flat_map(|lane| lane.along(1))))
}

/// Extends a range to zero, and adds a little room on both sides.
fn padded(values: Option<(f64, f64)>) -> (f64, f64) {
    let (low, high) = values.map_or((0.0, 1.0), |(low, high)| (low.min(0.0), high.max(0.0)));
    let wide = if high > low { high - low } else { 1.0 };
    (low - 0.08 * wide, high + 0.08 * wide)
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let nothing = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(nothing, |(low, high), y| {
        (if y < low { y } else { low }, if y > high { y } else { high })
    });
    (low <= high).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{METRICS, Metric};
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};

    fn lanes(studio: &Studio, metric: usize) -> Vec<Track> {
        Track::of(studio, 0, |s| [s.t, s.metrics[metric]])
    }

    #[test]
    fn the_energy_axis_fits_healthy_lanes_or_else_those_not_lost() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::ToggleRace);
        (0..600).for_each(|_| studio.tick());
        // Explicit Euler is off by some thousand per cent, semi-implicit Euler swings by five.
        let (low, high) = of_shares(&lanes(&studio, Metric::ENERGY_DRIFT));
        assert!((-8.0..-4.0).contains(&low) && (4.0..8.0).contains(&high), "{low} to {high} %");
        studio.apply(StageCommand::Pick(0));
        studio.apply(StageCommand::ToggleRace);
        let (low, high) = of_shares(&lanes(&studio, Metric::ENERGY_DRIFT));
        assert!(low < 0.0 && (200.0..400.0).contains(&high), "{low} to {high} %");
    }

    #[test]
    fn an_axis_fits_the_truth_and_nearby_lanes_but_no_distant_ones() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::ToggleRace);
        (0..600).for_each(|_| studio.tick());
        let tracks = Track::of(&studio, 0, |s| [s.t, s.q]);
        let truth = || studio.past().truth_curves()[0].samples().map(|s| s.q);
        let (low, high) = around_truth(truth(), &tracks, 1, 1.6);
        assert!((-2.1..-1.1).contains(&low) && (1.1..2.1).contains(&high), "{low} to {high}");
        let (low, high) = around_truth(truth(), &tracks, 1, 4.0);
        assert!(low < -3.0 && high > 3.0, "{low} to {high}");
    }

    #[test]
    fn ranges_of_constant_values_are_wide_enough_for_marks() {
        for value in [0.0, 1e-12, -7.0, 3e15] {
            let (low, high) = around_truth([value; 9].into_iter(), &[], 1, 1.6);
            assert!(low < value && value < high, "{low} to {high}");
            assert!((high - low) > 1e-4 * value.abs() && (high - low).is_finite());
        }
        for (low, high) in [of_shares(&[]), from_zero(&[]), of_decades(&[], 0.0)] {
            assert!(high - low >= 1.0, "{low} to {high}");
        }
        let still = Studio::new(Scene::built_in("spring").unwrap());
        let evaluations = METRICS.iter().position(|metric| metric.id == "evaluations").unwrap();
        let (low, high) = from_zero(&lanes(&still, evaluations));
        assert!(low < 0.0 && high > 0.0, "{low} to {high}");
    }
}
