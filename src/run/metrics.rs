//! The metrics of a body in a lane, compared with the same body in truth.

use std::fmt;

use crate::race::{Chase, LaneBody};
use crate::sim::bodies::{Coordinate, Truth};

mod spin;

/// The scale on which a metric is plotted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// The decimal logarithm of the metric is plotted.
    Log,
    /// The metric itself is plotted.
    Linear,
}

/// The unit of a metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A pure number without a unit.
    One,
    /// Percent of the metric's reference.
    Percent,
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// The amplitude of the body's motion.
    Amplitudes,
    /// Unit of the body's first coordinate. Coordinates in other units are left out.
    Coordinate,
    /// Unit of the body's first coordinate per second.
    Velocity,
}

impl Unit {
    /// Returns the unit's text for a body with this coordinate.
    pub fn on(self, coordinate: &Coordinate) -> String {
        match self {
            Unit::Coordinate => coordinate.shown_unit().into(),
            Unit::Velocity => format!("{}/s", coordinate.unit),
            same => same.to_string(),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unit::One => "",
            Unit::Percent => "%",
            Unit::Seconds => "s",
            Unit::Milliseconds => "ms",
            Unit::Amplitudes => "amplitudes",
            Unit::Coordinate => "m or rad",
            Unit::Velocity => "m/s or rad/s",
        })
    }
}

/// A metric of a body in a lane, compared with the same body in truth.
#[derive(Debug)]
pub struct Metric {
    /// Name of the metric in output, `snake_case`.
    pub id: &'static str,
    /// Name of the metric for people.
    pub name: &'static str,
    /// Text that is shown if no lane has a value.
    pub absent: &'static str,
    /// Unit of the metric's values.
    pub unit: Unit,
    /// Scale on which the metric is plotted.
    pub scale: Scale,
    /// Whether the metric compares the lane with the truth.
    pub is_comparison: bool,
    /// Whether the metric measures the energy that a body conserves; the energy instrument shows such a metric.
    pub is_of_energy: bool,
    /// Description of the metric in one line.
    pub about: &'static str,
    /// Computes the value for a body in a lane, given the same body in truth; `None` if undefined. A comparison is
    /// undefined once one of the two bodies has halted.
    pub measure: fn(lane: &LaneBody, truth: &LaneBody) -> Option<f64>,
}

impl Metric {
    /// The index of the position error in [`METRICS`].
    pub const POSITION_ERROR: usize = place_of("position_error");
    /// The index of the velocity error in [`METRICS`].
    pub const VELOCITY_ERROR: usize = place_of("velocity_error");
    /// The index of the energy drift in [`METRICS`].
    pub const ENERGY_DRIFT: usize = place_of("energy_drift");
    /// The index of the attitude error in [`METRICS`].
    pub const ATTITUDE_ERROR: usize = place_of("attitude_error");
    /// The index of the half-life in [`METRICS`].
    pub const HALF_LIFE: usize = place_of("half_life");
    /// The index of the overshoot in [`METRICS`].
    pub const OVERSHOOT: usize = place_of("overshoot");

    /// Returns the text that is shown if no lane has a value for this body; `truth` is the same body in truth.
    pub fn absent_on(&self, truth: &LaneBody) -> &'static str {
        if self.is_of_energy && truth.false_claims().energy {
            "No drift to show: with these constants the body's `energy` is not conserved."
        } else if self.is_of_energy && truth.stepper.energy().is_none() {
            self.absent
        } else if self.is_comparison && truth.halted().is_some() {
            match truth.truth() {
                Truth::Exact => "Nothing to compare with: there is no exact solution.",
                Truth::Reference => "Nothing to compare with: there is no reference.",
            }
        } else {
            self.absent
        }
    }
}

const fn place_of(id: &str) -> usize {
    let mut index = 0;
    while !is_same(METRICS[index].id.as_bytes(), id.as_bytes()) {
        index += 1;
    }
    index
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    match (a, b) {
        ([], []) => true,
        ([x, a @ ..], [y, b @ ..]) => *x == *y && is_same(a, b),
        _ => false,
    }
}

/// Every metric. The first metric ranks the lanes.
pub const METRICS: &[Metric] = &[
    Metric {
        id: "position_error",
        name: "position error",
        absent: "Nothing to compare yet: no tick was made.",
        unit: Unit::Coordinate,
        scale: Scale::Log,
        is_comparison: true,
        is_of_energy: false,
        about: "largest difference from the exact solution in a coordinate",
        measure: |lane, truth| {
            let [q, exact] =
                unless_halted(lane, truth)?.map(|body| body.like_first(body.stepper.q()));
            if_finite(largest_difference(q, exact))
        },
    },
    Metric {
        id: "velocity_error",
        name: "velocity error",
        absent: "Nothing to compare yet: no tick was made.",
        unit: Unit::Velocity,
        scale: Scale::Log,
        is_comparison: true,
        is_of_energy: false,
        about: "largest difference from the exact solution in a velocity",
        measure: |lane, truth| {
            let [v, exact] =
                unless_halted(lane, truth)?.map(|body| body.like_first(body.stepper.v()));
            if_finite(largest_difference(v, exact))
        },
    },
    Metric {
        id: "relative_speed_error",
        name: "speed error",
        absent: "No speed to compare: the exact motion stands still.",
        unit: Unit::Percent,
        scale: Scale::Linear,
        is_comparison: true,
        is_of_energy: false,
        about: "speed above the exact one, in percent of the largest exact speed so far",
        measure: |lane, truth| {
            let [speed, exact] = unless_halted(lane, truth)?.map(LaneBody::speed);
            let largest = truth.extent()?.largest_speed();
            if_finite(100.0 * (speed - exact) / largest)
        },
    },
    Metric {
        id: "energy_drift",
        name: "energy drift",
        absent: "No drift to show: this body does not conserve its energy.",
        unit: Unit::Percent,
        scale: Scale::Linear,
        is_comparison: true,
        is_of_energy: true,
        about: "energy gained, in percent of the energy that the exact motion exchanges: the range of its kinetic \
                energy, once it has reached both ends",
        measure: |lane, truth| {
            let [lane, exact] = unless_halted(lane, truth)?;
            let exchanged = exact.extent()?.exchanged_j(&*exact.stepper)?;
            if_finite(100.0 * (lane.stepper.energy()? - exact.stepper.energy()?) / exchanged)
        },
    },
    Metric {
        id: "evaluations",
        name: "evaluations",
        absent: "No evaluations yet: no tick was made.",
        unit: Unit::One,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "evaluations of this body's acceleration since the start",
        measure: |lane, _| Some(lane.stepper.evaluations() as f64),
    },
    Metric {
        id: "lost_time",
        name: "lost time",
        absent: "No time lost: every method shown keeps time.",
        unit: Unit::Seconds,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "time by which this body is behind, under a method that does not keep it",
        measure: |lane, _| Some(lane.stepper.lost_time()).filter(|&lost| lost > 0.0),
    },
    Metric {
        id: "half_life",
        name: "half-life",
        absent: "No half-life: this body follows no target that stays, or is not yet half-way.",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "time in which this body covered half of the way to a target that stays, since the last input or placement",
        measure: |lane, _| Some(1e3 * lane.chase()?.half_life_s()?),
    },
    Metric {
        id: "overshoot",
        name: "overshoot",
        absent: "No overshoot: this body follows no target that stays.",
        unit: Unit::Percent,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "furthest that this body went beyond a target that stays, in percent of the way, since the last input or placement",
        measure: |lane, _| lane.chase().map(Chase::overshoot_percent),
    },
    Metric {
        id: "apex",
        name: "apex",
        absent: "No apex: this body meets no wall, or has not yet reached one.",
        unit: Unit::Coordinate,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "height of the last flight above the floor, on the parabola through its highest ticks",
        measure: |lane, _| lane.stepper.bounces()?.apex,
    },
    Metric {
        id: "apex_error",
        name: "apex error",
        absent: "No apex to compare: this body meets no floor, or has not yet bounced.",
        unit: Unit::Percent,
        scale: Scale::Linear,
        is_comparison: true,
        is_of_energy: false,
        about: "height of the last flight above that of the same flight in truth, in percent of it",
        measure: |lane, truth| {
            let bounces = *unless_halted(lane, truth)?[0].stepper.bounces()?;
            let [_, exact] = truth.stepper.true_bounce(bounces.apex_after)?;
            if_finite(100.0 * (bounces.apex? - exact) / exact)
        },
    },
    Metric {
        id: "landing_error",
        name: "landing error",
        absent: "No bounce: this body meets no wall, or has not yet.",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        is_comparison: true,
        is_of_energy: false,
        about: "time of the last impact, as its rule handled it, after that of the same impact in truth",
        measure: |lane, truth| {
            let bounces = *unless_halted(lane, truth)?[0].stepper.bounces()?;
            let [exact, _] = truth.stepper.true_bounce(bounces.impacts)?;
            if_finite(1e3 * (bounces.landed_at_s - exact)).filter(|_| bounces.impacts > 0)
        },
    },
    Metric {
        id: "depth",
        name: "depth",
        absent: "No depth: this body meets no floor.",
        unit: Unit::Coordinate,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "deepest below the floor at a tick since the start",
        measure: |lane, _| Some(lane.stepper.bounces()?.depth),
    },
    Metric {
        id: "impacts",
        name: "impacts",
        absent: "No bounce: this body meets no wall, or has not yet.",
        unit: Unit::One,
        scale: Scale::Linear,
        is_comparison: false,
        is_of_energy: false,
        about: "impacts since the start, or since the last input or placement",
        measure: |lane, _| Some(lane.stepper.bounces()?.impacts as f64),
    },
    spin::ATTITUDE_ERROR,
    spin::AXIS_ERROR,
    spin::MOMENTUM_TURN,
    spin::MOMENTUM_LENGTH,
];

/// Returns the energy of a body in a lane above that in truth, in percent of the energy that the exact motion
/// exchanges. A linear body that exchanges or conserves none is measured against the largest energy that it had. `None`
/// if the body's energies are unknown, or if it is not linear, because its energy then has no natural zero.
pub fn energy_gained_percent(lane: &LaneBody, truth: &LaneBody) -> Option<f64> {
    let of_swing = (METRICS[Metric::ENERGY_DRIFT].measure)(lane, truth);
    of_swing.or_else(|| {
        let [_, exact] = unless_halted(lane, truth).filter(|_| truth.stepper.is_linear())?;
        let most_j = exact.stepper.energy().unwrap_or(exact.extent()?.most_j());
        if_finite(100.0 * energy_gained_j(lane, truth)? / most_j)
    })
}

/// Returns the energy of a body in a lane above that in truth, in joules; `None` if one of the two energies is unknown.
pub fn energy_gained_j(lane: &LaneBody, truth: &LaneBody) -> Option<f64> {
    let [lane, exact] = unless_halted(lane, truth)?.map(energy_j);
    if_finite(lane? - exact?)
}

/// Returns the kinetic plus potential energy of a body, in joules; `None` if the energy is unknown, or once the body
/// has halted.
pub fn energy_j(body: &LaneBody) -> Option<f64> {
    let stepper = &body.stepper;
    let parts = || Some(stepper.mechanical_energy()?.iter().sum());
    let energy = stepper.energy().or_else(parts).filter(|_| body.halted().is_none());
    energy.and_then(if_finite)
}

/// Returns the body in a lane and the body in truth; `None` once one of them has halted.
fn unless_halted<'a>(lane: &'a LaneBody, truth: &'a LaneBody) -> Option<[&'a LaneBody; 2]> {
    let are_running = lane.halted().is_none() && truth.halted().is_none();
    are_running.then_some([lane, truth])
}

/// Returns the value, if it is finite.
fn if_finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Returns the largest difference; NaN if any difference is NaN.
fn largest_difference(a: impl Iterator<Item = f64>, b: impl Iterator<Item = f64>) -> f64 {
    let larger = |largest: f64, x: f64| if x > largest || x.is_nan() { x } else { largest };
    a.zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Action, LaneSpec, Scene, SceneBody};
    use crate::sim::Solver;
    use crate::sim::bodies::{Input, kind};
    use crate::sim::integrators::method;
    use crate::{Lane, Race};

    fn metric(id: &str) -> &'static Metric {
        METRICS.iter().find(|metric| metric.id == id).unwrap()
    }

    /// Returns a race under `id` at 100 Hz, of one spring with 2 kg, 8 N/m and a kick of 4 N s.
    fn race(id: &str, [x0, v0]: [f64; 2]) -> Race {
        let text = format!(
            "title = 'x'\ntick_hz = 100\nseconds = 10\nmethods = ['{id}']\n\
             [[spring]]\nmass_kg = 2\nstiffness_n_per_m = 8\nkick_n_s = 4\nx0_m = {x0}\nv0_m_per_s = {v0}\n"
        );
        Race::of_scene(&Scene::parse("x.toml", &text).unwrap())
    }

    fn measured(id: &str, race: &Race) -> Option<f64> {
        let lane = &race.entrants()[0].lane.bodies()[0];
        (metric(id).measure)(lane, &race.truth().bodies()[0])
    }

    #[test]
    fn metrics_compare_a_lane_with_the_truth() {
        let mut race = race("explicit-euler", [1.0, 0.0]);
        assert_eq!(measured("position_error", &race), Some(0.0));
        assert_eq!(measured("relative_speed_error", &race), None, "nothing has moved");
        assert_eq!(measured("energy_drift", &race), None, "nothing is exchanged yet");
        assert_eq!(measured("evaluations", &race), Some(0.0));
        assert_eq!(measured("lost_time", &race), None);
        // A period is π s, so that the truth is back at its start, and its speed is zero.
        race.run(314);
        let state = |lane: &Lane| {
            let stepper = &lane.bodies()[0].stepper;
            (stepper.q()[0], stepper.v()[0])
        };
        let ((q, v), (x, u)) = (state(&race.entrants()[0].lane), state(race.truth()));
        let near = |id: &str, wanted: f64| {
            let found = measured(id, &race).unwrap();
            assert!((found - wanted).abs() <= 1e-4 * wanted.abs(), "{id}: {found}, not {wanted}");
        };
        near("position_error", (q - x).abs());
        near("velocity_error", (v - u).abs());
        // The largest speed is 2 m/s, and the exchanged energy is 4 J.
        near("relative_speed_error", 100.0 * (v.abs() - u.abs()) / 2.0);
        near("energy_drift", 100.0 * (v * v + 4.0 * q * q - 4.0) / 4.0);
        near("evaluations", 314.0);
        assert!(u.abs() < 0.01, "a speed to divide by that crosses zero: {u} m/s");
    }

    #[test]
    fn energy_gained_is_known_at_once_only_for_linear_bodies() {
        let gained = |scene: &str, id: &str, ticks: u64, body: usize| {
            let scene = Scene::built_in(scene).unwrap();
            let spec = LaneSpec::plain(method(id).unwrap());
            let mut race = Race::of_scene(&Scene { lanes: vec![spec], ..scene });
            race.run(ticks);
            energy_gained_percent(
                &race.entrants()[0].lane.bodies()[body],
                &race.truth().bodies()[body],
            )
        };
        // The first tick of explicit Euler adds (ω h)² of the energy, here (2 π / 60)².
        let first = gained("harbour", "explicit-euler", 1, 0).unwrap();
        assert!((first - 1.0966).abs() < 1e-3, "{first}");
        // All energy of the ship is kinetic. After many time constants this is the energy of the last speed, under any
        // method.
        let ship = gained("harbour", "explicit-euler", 60 * 200, 1).unwrap();
        assert!(ship.abs() < 1e-6, "{ship}");
        let damped = gained("damped", "explicit-euler", 600, 0).unwrap();
        assert!(damped > 100.0, "it grows where it should rest: {damped}");
        assert_eq!(gained("bouncing-bungee", "rk4", 40, 0), None, "its zero is where it jumps off");
    }

    #[test]
    fn a_body_kicked_from_rest_is_compared_with_its_new_speed() {
        let mut race = race("rk4", [0.0, 0.0]);
        race.perform(&Action::Kick(1.0), &mut ());
        assert_eq!(measured("relative_speed_error", &race), Some(0.0));
    }

    #[test]
    fn energy_drift_is_relative_to_the_energy_exchanged() {
        let drifts = |bodies: &str, tick_hz: u32| {
            let head = "seconds = 60\nmethods = ['rk4', 'semi-implicit-euler']";
            let text = format!("title = 'x'\ntick_hz = {tick_hz}\n{head}\n{bodies}");
            let mut race = Race::of_scene(&Scene::parse("x.toml", &text).unwrap());
            let mut drifts = Vec::new();
            for _ in 0..60 * tick_hz {
                race.step(&mut ());
                let truth = &race.truth().bodies()[0];
                let lanes = race.entrants().iter().map(|entrant| &entrant.lane.bodies()[0]);
                drifts
                    .extend(lanes.filter_map(|lane| (metric("energy_drift").measure)(lane, truth)));
            }
            drifts
        };
        // The whole energy of a ship that starts from rest is zero up to rounding.
        let ship = "[[ship]]\nthrust_n = 1234.5\ndrag_n_s_per_m = 0\nmass_kg = 777\n";
        assert_eq!(drifts(ship, 7), [0.0; 0]);
        let stops = drifts(&format!("{ship}v0_m_per_s = -30\n"), 7);
        assert!(stops.len() > 100 && stops.iter().all(|drift| drift.abs() < 15.0), "{stops:?}");
        let circle = "[[orbit]]\nmu_m3_per_s2 = 8\nx0_m = 2\nvy0_m_per_s = 2\n";
        assert_eq!(drifts(circle, 30), [0.0; 0]);
        let swing = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\n";
        let largest = drifts(swing, 60).into_iter().map(f64::abs).fold(0.0, f64::max);
        // The energy of semi-implicit Euler swings by h ω / 2, and not by more at the beginning.
        assert!((4.8..5.8).contains(&largest), "{largest} %");
    }

    #[test]
    fn a_gain_after_a_placement_is_a_part_of_the_new_motion() {
        for body in [
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\n",
            "[[pendulum]]\nlength_m = 1\ntheta0_rad = 1\n",
        ] {
            let head = "title = 'x'\ntick_hz = 60\nseconds = 60\nmethods = ['explicit-euler']";
            let scene = Scene::parse("x.toml", &format!("{head}\n{body}")).unwrap();
            let mut race = Race::of_scene(&scene);
            race.run(300);
            race.perform(&Action::Place { body: 0, q: [0.1].into(), v: [0.0].into() }, &mut ());
            let mut widest = 0.0_f64;
            for _ in 0..240 {
                race.step(&mut ());
                widest = widest.max(race.truth().bodies()[0].stepper.kinetic_energy().unwrap());
            }
            let [lane, truth] = [&race.entrants()[0].lane.bodies()[0], &race.truth().bodies()[0]];
            let gained = 100.0 * energy_gained_j(lane, truth).unwrap() / widest;
            let found = measured("energy_drift", &race).unwrap();
            assert!(
                gained > 10.0 && (found / gained - 1.0).abs() < 0.02,
                "{found} %, not {gained} %"
            );
        }
    }

    #[test]
    fn no_more_energy_is_lost_than_the_motion_has() {
        for body in [
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\nv0_m_per_s = 6\n",
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\nv0_m_per_s = -2\n",
            "[[pendulum]]\nlength_m = 1\ntheta0_rad = 1\nomega0_rad_per_s = 2\n",
            "[[chain]]\nmasses = 8\nmass_kg = 1\nstiffness_n_per_m = 400\nx0_m = 1\n",
        ] {
            let head = "title = 'x'\ntick_hz = 60\nseconds = 60\nmethods = ['implicit-euler']";
            let mut race =
                Race::of_scene(&Scene::parse("x.toml", &format!("{head}\n{body}")).unwrap());
            for _ in 0..3600 {
                race.step(&mut ());
                let drift = measured("energy_drift", &race);
                assert!(drift.is_none_or(|drift| drift > -101.0), "{drift:?} of\n{body}");
            }
            assert!(measured("energy_drift", &race).unwrap() < -80.0);
        }
    }

    #[test]
    fn a_halted_truth_or_lane_has_no_error() {
        let comparing =
            ["position_error", "velocity_error", "relative_speed_error", "energy_drift"];
        let mut lost = race("explicit-euler", [1.0, 0.0]);
        lost.run(400);
        assert!(comparing.iter().all(|id| measured(id, &lost).is_some()));
        while lost.entrants()[0].lane.halted().is_none() {
            lost.perform(&Action::TickHz(1.into()), &mut ());
            lost.step(&mut ());
        }
        assert!(comparing.iter().all(|id| measured(id, &lost).is_none()), "the lane halted");
        assert!(measured("evaluations", &lost).is_some_and(|count| count > 400.0));

        let scene = Scene::built_in("spring").unwrap();
        let [lane, mut truth] = [(); 2].map(|()| Lane::new(&scene, Solver::Truth, 1));
        truth.input(0, 0.0, Input::Kick(1e300));
        assert!(lane.halted().is_none() && truth.halted().is_some());
        let against = |id: &str| (metric(id).measure)(&lane.bodies()[0], &truth.bodies()[0]);
        assert!(comparing.iter().all(|id| against(id).is_none()), "the truth halted");
    }

    #[test]
    fn an_undefined_difference_does_not_rank_as_smallest() {
        let largest = |a: [f64; 3]| largest_difference(a.into_iter(), [0.0; 3].into_iter());
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
        assert_eq!(if_finite(f64::NAN), None);
    }

    #[test]
    fn a_heading_is_no_distance() {
        let scene = Scene::built_in("helm").unwrap();
        let [truth, mut lane] = [(); 2].map(|()| LaneBody::new(&scene.bodies[0], Solver::Truth));
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
    fn time_lost_as_printed_stays_lost_through_placings_and_switches() {
        let ship = kind("ship").unwrap().clone();
        let ship = SceneBody::new("ship", ship, vec![2e4, 1e3, 1e4, 0.0, 0.0, 2e4]);
        let under = |id| Solver::Method(method(id).unwrap());
        let truth = LaneBody::new(&ship, Solver::Truth);
        let mut lane = LaneBody::new(&ship, under("adaptive-euler-as-printed"));
        let lost = |lane: &LaneBody| (metric("lost_time").measure)(lane, &truth).unwrap();
        lane.stepper.advance(0.0, 0.5, 1).unwrap();
        let once = lost(&lane);
        assert!(once > 0.1 && once < 0.5, "{once} s");
        let (q, v) = (lane.stepper.q().to_vec(), lane.stepper.v().to_vec());
        lane.stepper.set(0.5, &q, &v);
        assert_eq!(lost(&lane), once);
        for solver in [under("rk4"), Solver::Truth, under("adaptive-euler-as-printed")] {
            lane.stepper = lane.stepper.with_solver(solver, 0.5);
            assert_eq!(lost(&lane), once);
        }
        lane.stepper.advance(0.5, 0.5, 1).unwrap();
        assert!(lost(&lane) > once + 0.1);
    }
}
