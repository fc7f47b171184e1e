//! The reach of the true motion, which gives the amplitudes of its components, and the scale for the growth of a swing.

use super::TruthNode;
use crate::scene::SceneBody;
use crate::sim::bodies::Coordinates;
use crate::survey::Ranges;

/// A force points to the centre if its transverse part is below this fraction of the whole force.
const CENTRAL: f64 = 1e-9;

/// A motion turns about the centre if the transverse part of its velocity exceeds this fraction of the whole velocity.
const TURNS: f64 = 1e-6;

/// The reach of the true motion in the long run.
pub(crate) enum Reach {
    /// Middle and half the range of each component, with the coordinates first.
    Each(Vec<(f64, f64)>),
    /// Largest distance from the centre at the origin, and largest speed, for a motion that turns about the centre. The
    /// motion's ellipse may rotate as well, which is not growth.
    Centre { distance: f64, speed: f64 },
}

impl Reach {
    /// Returns the reach of these coordinates, relative to the reach of the true motion's coordinates.
    pub(crate) fn of_coordinates(&self, q: &[f64]) -> f64 {
        match self {
            Reach::Each(parts) => farthest(q, &parts[..q.len()]),
            Reach::Centre { distance, .. } => length(q) / distance,
        }
    }

    /// Returns the reach of these velocities, relative to the reach of the true motion's velocities.
    pub(crate) fn of_velocities(&self, v: &[f64]) -> f64 {
        match self {
            Reach::Each(parts) => farthest(v, &parts[v.len()..]),
            Reach::Centre { speed, .. } => length(v) / speed,
        }
    }
}

fn farthest(values: &[f64], parts: &[(f64, f64)]) -> f64 {
    let parts = values.iter().zip(parts).map(|(x, (middle, half))| (x - middle).abs() / half);
    parts.fold(0.0, f64::max)
}

fn length(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Returns the length of the part of `a` perpendicular to `along`, relative to the length of `a`.
fn perpendicular_share(a: &[f64], along: &[f64]) -> f64 {
    let (dot, square) = a
        .iter()
        .zip(along)
        .fold((0.0, 0.0), |(dot, square), (a, along)| (dot + a * along, square + along * along));
    let rest = a.iter().zip(along).map(|(a, along)| a - dot / square * along);
    rest.map(|x| x * x).sum::<f64>().sqrt() / length(a)
}

/// Collects the reach of the true motion.
#[derive(Clone)]
pub(super) struct ReachSoFar {
    pub(super) ranges: Ranges,
    /// Whether all forces up to now point to or from the origin, in a space of coordinates with the same unit.
    is_central: bool,
    turns: bool,
    distance: f64,
    speed: f64,
}

impl ReachSoFar {
    pub(super) fn new(ranges: Ranges, body: &SceneBody) -> Self {
        let coordinates = body.kind.coordinates(&body.values);
        let is_central =
            coordinates.len() > 1 && coordinates.units().all(|unit| unit == coordinates.at(0).unit);
        Self { ranges, is_central, turns: false, distance: 0.0, speed: 0.0 }
    }

    pub(super) fn add(&mut self, from: &TruthNode, to: &TruthNode) {
        self.ranges.extend(from, to);
        if !self.is_central {
            return;
        }
        for moment in [from, to] {
            let n = moment.x.len() / 2;
            let (q, v) = moment.x.split_at(n);
            let a = &moment.slope[n..];
            self.is_central &= length(q) > 0.0 && perpendicular_share(a, q) <= CENTRAL;
            self.turns |= perpendicular_share(v, q) > TURNS;
            self.distance = self.distance.max(length(q));
            self.speed = self.speed.max(length(v));
        }
    }

    /// Returns the reach about `centres`, one per coordinate, with at least these amplitudes.
    pub(super) fn reach(&self, body: &SceneBody, centres: &[f64], amplitudes: &[f64]) -> Reach {
        if self.is_central && self.turns {
            return Reach::Centre { distance: self.distance, speed: self.speed };
        }
        let coordinates = body.kind.coordinates(&body.values);
        let about = |(i, (low, high)): (usize, &(f64, f64))| {
            let centre = centres.get(i).copied().unwrap_or(low + (high - low) / 2.0);
            (centre, (high - centre).max(centre - low).max(amplitudes[i]))
        };
        let each: Vec<(f64, f64)> = self.ranges.0.iter().enumerate().map(about).collect();
        let halves: Vec<f64> = each.iter().map(|(_, half)| *half).collect();
        let largest = largest_alike(&coordinates, &halves);
        Reach::Each(each.iter().map(|(centre, _)| *centre).zip(largest).collect())
    }
}

/// A component is constant up to rounding if half its range is below this fraction of its largest value.
const KEEPS_STILL: f64 = 1e-9;

/// Returns for each component the largest value among components of the same unit. Coordinates and velocities are
/// separate.
fn largest_alike(coordinates: &Coordinates, values: &[f64]) -> Vec<f64> {
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

/// Returns the amplitude of each component, from the true ranges.
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
    fn components_of_one_unit_share_the_largest_amplitude_apart_from_velocities() {
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
