//! What is measured of a body in a lane, against the same body in truth.

use std::fmt;

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
    /// The unit of the body's coordinates. Where they differ, each counts in its own.
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
    /// What it is counted in.
    pub unit: Unit,
    /// How it is plotted.
    pub scale: Scale,
    /// The value for a body in a lane and the same body in truth, or `None` where it has no meaning.
    pub measure: fn(lane: &dyn Stepper, truth: &dyn Stepper) -> Option<f64>,
}

/// Every metric, the one that lanes are ranked by first.
pub const METRICS: &[Metric] = &[
    Metric {
        id: "position_error",
        name: "position error",
        unit: Unit::Coordinate,
        scale: Scale::Log,
        measure: |lane, truth| Some(largest_difference(lane.q(), truth.q())),
    },
    Metric {
        id: "velocity_error",
        name: "velocity error",
        unit: Unit::Velocity,
        scale: Scale::Log,
        measure: |lane, truth| Some(largest_difference(lane.v(), truth.v())),
    },
    Metric {
        id: "relative_speed_error",
        name: "speed error",
        unit: Unit::Of("%"),
        scale: Scale::Linear,
        measure: |lane, truth| {
            let (speed, exact) = (length(lane.v()), length(truth.v()));
            (exact > 0.0).then(|| 100.0 * (speed - exact) / exact)
        },
    },
    Metric {
        id: "energy_drift",
        name: "energy drift",
        unit: Unit::Of("%"),
        scale: Scale::Linear,
        measure: energy_drift,
    },
    Metric {
        id: "evaluations",
        name: "evaluations",
        unit: Unit::Of(""),
        scale: Scale::Linear,
        measure: |lane, _| Some(lane.evaluations() as f64),
    },
    Metric {
        id: "lost_time",
        name: "lost time",
        unit: Unit::Of("s"),
        scale: Scale::Linear,
        measure: |lane, _| (lane.lost_time() > 0.0).then(|| lane.lost_time()),
    },
];

/// The energy that a lane has gained, in percent of the true one.
pub(super) fn energy_drift(lane: &dyn Stepper, truth: &dyn Stepper) -> Option<f64> {
    let (energy, exact) = (lane.energy()?, truth.energy()?);
    (exact != 0.0).then(|| 100.0 * (energy - exact) / exact.abs())
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn length(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |length, &v| libm::hypot(length, v))
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let truth = (spring.build)(&values, Solver::Truth);
        let mut lane = (spring.build)(&values, Solver::Truth);
        let of = |id: &str, lane: &dyn Stepper| (metric(id).measure)(lane, &*truth);
        assert_eq!(of("position_error", &*lane), Some(0.0));
        assert_eq!(of("energy_drift", &*lane), Some(0.0));
        assert_eq!(of("relative_speed_error", &*lane), None);
        assert!(lane.input(0.0, Input::Kick(1.0)));
        assert_eq!(of("velocity_error", &*lane), Some(2.0));
        assert_eq!(of("energy_drift", &*lane), Some(100.0));
        assert_eq!(of("evaluations", &*lane), Some(0.0));
        assert_eq!(of("lost_time", &*lane), None);
    }

    #[test]
    fn time_lost_as_printed_stays_lost_through_resets_and_switches() {
        let ship = kind("ship").unwrap();
        let under = |id| Solver::Method(method(id).unwrap());
        let truth = (ship.build)(&[2e4, 1e3, 1e4, 0.0, 0.0, 2e4], Solver::Truth);
        let mut lane = truth.with_solver(under("adaptive-euler-as-printed"), 0.0);
        let lost = |lane: &dyn Stepper| (metric("lost_time").measure)(lane, &*truth).unwrap();
        lane.advance(0.0, 0.5, 1).unwrap();
        let once = lost(&*lane);
        assert!(once > 0.1 && once < 0.5, "{once} s");
        lane.reset();
        assert_eq!(lost(&*lane), once);
        for solver in [under("rk4"), Solver::Truth, under("adaptive-euler-as-printed")] {
            lane = lane.with_solver(solver, 0.5);
            assert_eq!(lost(&*lane), once);
        }
        lane.advance(0.5, 0.5, 1).unwrap();
        assert!(lost(&*lane) > once + 0.1);
    }
}
