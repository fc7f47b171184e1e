//! What is measured of a body in a lane, against the same body in truth.

use std::fmt;

use super::lane::LaneBody;
use crate::sim::Stepper;
use crate::sim::bodies::Coordinate;

/// How a metric is plotted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// As its decimal logarithm.
    Log,
    /// As it is.
    Linear,
}

/// What a metric is counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// The same on every body; empty for a pure number.
    Of(&'static str),
    /// The unit of the body's first coordinate. Those in another unit are left out.
    Coordinate,
    /// That unit per second.
    Velocity,
}

impl Unit {
    /// The unit on a body with this coordinate.
    pub fn on(self, coordinate: &Coordinate) -> String {
        match self {
            Unit::Of(unit) => unit.into(),
            Unit::Coordinate => coordinate.unit.into(),
            Unit::Velocity => format!("{}/s", coordinate.unit),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unit::Of(unit) => unit,
            Unit::Coordinate => "m or rad",
            Unit::Velocity => "m/s or rad/s",
        })
    }
}

/// One thing measured.
#[derive(Debug)]
pub struct Metric {
    /// Name in output, `snake_case`.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// What to say where no lane has a value.
    pub absent: &'static str,
    /// What it is counted in.
    pub unit: Unit,
    /// How it is plotted.
    pub scale: Scale,
    /// The value for a body in a lane and the same body in truth, or `None` where it has no meaning.
    pub measure: fn(lane: &LaneBody, truth: &LaneBody) -> Option<f64>,
}

/// Every metric, the one that lanes are ranked by first.
pub const METRICS: &[Metric] = &[
    Metric {
        id: "position_error",
        name: "position error",
        absent: "Nothing to compare yet: no tick was made.",
        unit: Unit::Coordinate,
        scale: Scale::Log,
        measure: |lane, truth| {
            Some(largest_difference(
                like_first(lane, lane.stepper.q()),
                like_first(truth, truth.stepper.q()),
            ))
        },
    },
    Metric {
        id: "velocity_error",
        name: "velocity error",
        absent: "Nothing to compare yet: no tick was made.",
        unit: Unit::Velocity,
        scale: Scale::Log,
        measure: |lane, truth| {
            Some(largest_difference(
                like_first(lane, lane.stepper.v()),
                like_first(truth, truth.stepper.v()),
            ))
        },
    },
    Metric {
        id: "relative_speed_error",
        name: "speed error",
        absent: "No speed to compare: the exact motion stands still.",
        unit: Unit::Of("%"),
        scale: Scale::Linear,
        measure: |lane, truth| {
            let [speed, exact] =
                [lane, truth].map(|body| length(like_first(body, body.stepper.v())));
            (exact > 0.0).then(|| 100.0 * (speed - exact) / exact)
        },
    },
    Metric {
        id: "energy_drift",
        name: "energy drift",
        absent: "No drift to show: this body does not conserve its energy.",
        unit: Unit::Of("%"),
        scale: Scale::Linear,
        measure: |lane, truth| energy_drift(&*lane.stepper, &*truth.stepper),
    },
    Metric {
        id: "evaluations",
        name: "evaluations",
        absent: "No evaluations yet: no tick was made.",
        unit: Unit::Of(""),
        scale: Scale::Linear,
        measure: |lane, _| Some(lane.stepper.evaluations() as f64),
    },
    Metric {
        id: "lost_time",
        name: "lost time",
        absent: "No time lost: every method shown keeps time.",
        unit: Unit::Of("s"),
        scale: Scale::Linear,
        measure: |lane, _| Some(lane.stepper.lost_time()).filter(|&lost| lost > 0.0),
    },
];

/// The energy that a lane has gained, in percent of the true one.
pub(super) fn energy_drift(lane: &dyn Stepper, truth: &dyn Stepper) -> Option<f64> {
    let (energy, exact) = (lane.energy()?, truth.energy()?);
    (exact != 0.0).then(|| 100.0 * (energy - exact) / exact.abs())
}

/// Of one value for each of the body's coordinates, those of the coordinates in the first one's unit.
fn like_first(body: &LaneBody, values: &[f64]) -> impl Iterator<Item = f64> {
    let unit = body.coordinates[0].unit;
    let pairs = body.coordinates.iter().zip(values);
    pairs.filter(move |(coordinate, _)| coordinate.unit == unit).map(|(_, &value)| value)
}

fn largest_difference(a: impl Iterator<Item = f64>, b: impl Iterator<Item = f64>) -> f64 {
    a.zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn length(v: impl Iterator<Item = f64>) -> f64 {
    v.fold(0.0, libm::hypot)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Scene;
    use crate::sim::Solver;
    use crate::sim::bodies::{Input, kind};
    use crate::sim::integrators::method;

    fn metric(id: &str) -> &'static Metric {
        METRICS.iter().find(|metric| metric.id == id).unwrap()
    }

    #[test]
    fn metrics_compare_a_lane_with_the_truth() {
        let spring = kind("spring").unwrap();
        let values = [2.0, 8.0, 0.0, 1.0, 0.0, 4.0];
        let truth = LaneBody::new(spring, &values, Solver::Truth);
        let mut lane = LaneBody::new(spring, &values, Solver::Truth);
        let of = |id: &str, lane: &LaneBody| (metric(id).measure)(lane, &truth);
        assert_eq!(of("position_error", &lane), Some(0.0));
        assert_eq!(of("energy_drift", &lane), Some(0.0));
        assert_eq!(of("relative_speed_error", &lane), None);
        assert!(lane.stepper.input(0.0, Input::Kick(1.0)));
        assert_eq!(of("velocity_error", &lane), Some(2.0));
        assert_eq!(of("energy_drift", &lane), Some(100.0));
        assert_eq!(of("evaluations", &lane), Some(0.0));
        assert_eq!(of("lost_time", &lane), None);
    }

    #[test]
    fn a_heading_is_no_distance() {
        let helm = kind("helm").unwrap();
        let scene = Scene::built_in("helm").unwrap();
        let [truth, mut lane] =
            [(); 2].map(|()| LaneBody::new(helm, &scene.bodies[0].values, Solver::Truth));
        let moved = |by: &[f64], values: &[f64]| -> Vec<f64> {
            values.iter().zip(by).map(|(value, by)| value + by).collect()
        };
        let q = moved(&[0.0, -0.25, 3.0], truth.stepper.q());
        let v = moved(&[0.5, 0.0, 7.0], truth.stepper.v());
        lane.stepper.set(0.0, &q, &v);
        let of = |id: &str| (metric(id).measure)(&lane, &truth).unwrap();
        assert!((of("position_error") - 0.25).abs() < 1e-12);
        assert!((of("velocity_error") - 0.5).abs() < 1e-12);
    }

    #[test]
    fn time_lost_as_printed_stays_lost_through_resets_and_switches() {
        let ship = kind("ship").unwrap();
        let under = |id| Solver::Method(method(id).unwrap());
        let values = [2e4, 1e3, 1e4, 0.0, 0.0, 2e4];
        let truth = LaneBody::new(ship, &values, Solver::Truth);
        let mut lane = LaneBody::new(ship, &values, under("adaptive-euler-as-printed"));
        let lost = |lane: &LaneBody| (metric("lost_time").measure)(lane, &truth).unwrap();
        lane.stepper.advance(0.0, 0.5, 1).unwrap();
        let once = lost(&lane);
        assert!(once > 0.1 && once < 0.5, "{once} s");
        lane.stepper.reset();
        assert_eq!(lost(&lane), once);
        for solver in [under("rk4"), Solver::Truth, under("adaptive-euler-as-printed")] {
            lane.stepper = lane.stepper.with_solver(solver, 0.5);
            assert_eq!(lost(&lane), once);
        }
        lane.stepper.advance(0.5, 0.5, 1).unwrap();
        assert!(lost(&lane) > once + 0.1);
    }
}
