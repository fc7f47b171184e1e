//! The amplitudes of a body's components, from their true ranges.

use crate::sim::bodies::Coordinate;

/// A component whose half range is smaller than this part of its largest value is constant but for rounding.
const KEEPS_STILL: f64 = 1e-9;

/// The largest value among the components that have the unit of component `i` and are, like it, coordinates or
/// velocities.
pub(super) fn largest_alike(coordinates: &[Coordinate], values: &[f64], i: usize) -> f64 {
    let n = coordinates.len();
    let is_alike = |j: &usize| i / n == j / n && coordinates[i % n].unit == coordinates[j % n].unit;
    (0..2 * n).filter(is_alike).map(|j| values[j]).fold(0.0, f64::max)
}

/// The amplitude of each component, from the true ranges.
pub(super) fn amplitudes(ranges: &[(f64, f64)], coordinates: &[Coordinate]) -> Vec<f64> {
    let halves: Vec<f64> = ranges.iter().map(|(low, high)| (high - low) / 2.0).collect();
    let sizes: Vec<f64> = ranges.iter().map(|(low, high)| low.abs().max(high.abs())).collect();
    let amplitude = |i: usize| {
        let half = largest_alike(coordinates, &halves, i);
        let largest = largest_alike(coordinates, &sizes, i);
        match (half > KEEPS_STILL * largest, largest > 0.0) {
            (true, _) => half,
            (false, true) => largest,
            (false, false) => 1.0,
        }
    };
    (0..ranges.len()).map(amplitude).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;

    #[test]
    fn the_amplitude_is_half_the_range_or_the_constant_value() {
        let ship = kind("ship").unwrap().plain_coordinates();
        assert_eq!(amplitudes(&[(-1.0, 3.0), (20.0, 20.0)], ship), [2.0, 20.0]);
        assert_eq!(amplitudes(&[(0.0, 0.0), (5.0, 5.0 + 1e-12)], ship), [1.0, 5.0 + 1e-12]);
    }
}
