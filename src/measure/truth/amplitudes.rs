//! The amplitudes of a body's components, from their true ranges.

use crate::sim::bodies::Coordinates;

/// A component whose half range is smaller than this part of its largest value is constant but for rounding.
const KEEPS_STILL: f64 = 1e-9;

/// For each component, the largest value among those that have its unit and are, like it, coordinates or velocities.
pub(super) fn largest_alike(coordinates: &Coordinates, values: &[f64]) -> Vec<f64> {
    let mut units: Vec<&str> = Vec::new();
    let mut unit_index = |unit: &'static str| {
        units.iter().position(|known| *known == unit).unwrap_or_else(|| {
            units.push(unit);
            units.len() - 1
        })
    };
    let of_coordinate: Vec<usize> = coordinates.units().map(&mut unit_index).collect();
    let groups = || {
        let velocities = of_coordinate.iter().map(|unit| units.len() + unit);
        of_coordinate.iter().copied().chain(velocities)
    };
    let mut largest = vec![0.0_f64; 2 * units.len()];
    for (group, value) in groups().zip(values) {
        largest[group] = largest[group].max(*value);
    }
    groups().map(|group| largest[group]).collect()
}

/// The amplitude of each component, from the true ranges.
pub(super) fn amplitudes(ranges: &[(f64, f64)], coordinates: &Coordinates) -> Vec<f64> {
    let halves: Vec<f64> = ranges.iter().map(|(low, high)| (high - low) / 2.0).collect();
    let sizes: Vec<f64> = ranges.iter().map(|(low, high)| low.abs().max(high.abs())).collect();
    let largest = largest_alike(coordinates, &sizes);
    let amplitude =
        |(half, largest): (f64, f64)| match (half > KEEPS_STILL * largest, largest > 0.0) {
            (true, _) => half,
            (false, true) => largest,
            (false, false) => 1.0,
        };
    largest_alike(coordinates, &halves).into_iter().zip(largest).map(amplitude).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::{Coordinate, kind};

    #[test]
    fn the_amplitude_is_half_the_range_or_the_constant_value() {
        let ship = &kind("ship").unwrap().all_coordinates;
        assert_eq!(amplitudes(&[(-1.0, 3.0), (20.0, 20.0)], ship), [2.0, 20.0]);
        assert_eq!(amplitudes(&[(0.0, 0.0), (5.0, 5.0 + 1e-12)], ship), [1.0, 5.0 + 1e-12]);
    }

    #[test]
    fn components_of_one_unit_share_the_largest_and_velocities_are_apart() {
        let coordinate = |name: &'static str, unit| Coordinate {
            name: name.into(),
            velocity: name.into(),
            unit,
        };
        let coordinates = [coordinate("x", "m"), coordinate("a", "rad"), coordinate("y", "m")];
        let found = largest_alike(&coordinates.to_vec().into(), &[1.0, 7.0, 3.0, 20.0, 5.0, 10.0]);
        assert_eq!(found, [3.0, 7.0, 3.0, 20.0, 5.0, 20.0]);
    }
}
