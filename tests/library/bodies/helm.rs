//! The steered ship: its thrust curve, its straight course, its turning circle.

use glam::{DVec2, DVec3};
use regatta::sim::bodies::{Body, Curve, Helm, Input, Ship};
use regatta::sim::{Solver, State, Stepper, System, stepper};

fn helm(thrust: Curve) -> Helm {
    Helm {
        mass: 40_000.0,
        inertia: 1.7e6,
        drag: 2_000.0,
        side_drag: 40_000.0,
        yaw_drag: 1.7e6,
        rudder_moment: 34_000.0,
        thrust,
        throttle: 1.0,
        rudder: 0.0,
        q0: DVec3::new(3.0, -2.0, 0.7),
        u0: 1.5,
        kick: 40_000.0,
    }
}

fn curve() -> Curve {
    Curve::new([[0.0, 40_000.0], [5.0, 36_000.0], [10.0, 24_000.0], [15.0, 8_000.0]])
}

/// Runs the truth at 60 Hz.
fn run(body: Helm, seconds: u32) -> Box<dyn Stepper> {
    let mut stepper = stepper(body, Solver::Truth);
    for tick in 0..60 * seconds {
        stepper.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    stepper
}

#[test]
fn the_curve_is_straight_between_its_points_and_level_beyond_them() {
    for (speed, thrust) in [
        (-3.0, 40_000.0),
        (0.0, 40_000.0),
        (2.5, 38_000.0),
        (5.0, 36_000.0),
        (9.0, 26_400.0),
        (10.0, 24_000.0),
        (14.999_999, 8_000.003_2),
        (15.0, 8_000.0),
        (1e300, 8_000.0),
        (f64::NEG_INFINITY, 40_000.0),
    ] {
        let found = curve().at(speed);
        assert!((found - thrust).abs() < 1e-6, "{found} N at {speed} m/s");
    }
    assert_eq!(Curve::new([[2.0, 7.0]]).at(-1.0), 7.0);
    for bad in [vec![], vec![[1.0, 2.0], [1.0, 3.0]], vec![[1.0, 2.0], [0.5, 3.0]]] {
        assert!(std::panic::catch_unwind(|| Curve::new(bad)).is_err());
    }
}

#[test]
fn a_helm_on_a_straight_course_is_the_chapters_ship() {
    let level = helm(Curve::new([[0.0, 30_000.0], [1.0, 30_000.0]]));
    let ship = Ship {
        thrust: 30_000.0,
        throttle: 0.8,
        drag: level.drag,
        mass: level.mass,
        s0: 0.0,
        v0: level.u0,
        kick: 0.0,
    };
    let start = level.q0;
    let sailed = run(Helm { throttle: 0.8, ..level }, 40);
    let exact = ship.exact(40.0, &ship.start()).unwrap();
    let along = DVec3::new(libm::cos(start.z), libm::sin(start.z), 0.0);
    let (q, v) = (start + exact.q * along, exact.v * along);
    for (found, wanted) in sailed.q().iter().zip(q.as_ref()) {
        assert!((found - wanted).abs() < 1e-10 * exact.q, "{:?}, {q}", sailed.q());
    }
    for (found, wanted) in sailed.v().iter().zip(v.as_ref()) {
        assert!((found - wanted).abs() < 1e-11 * exact.v, "{:?}, {v}", sailed.v());
    }
}

#[test]
fn a_helm_under_constant_rudder_settles_into_a_circle() {
    for rudder in [1.0, -0.5] {
        let body = Helm { rudder, ..helm(curve()) };
        let sailed = run(body.clone(), 400);
        let [_, _, heading] = sailed.q() else { panic!("three coordinates") };
        let [vx, vy, r] = *sailed.v() else { panic!("three velocities") };
        let (sin, cos) = (libm::sin(*heading), libm::cos(*heading));
        let (u, w) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        assert!(u > 5.0 && r * rudder > 0.04, "it turns to the rudder: {u} m/s, {r} rad/s");
        assert!(near(body.yaw_drag * r, rudder * body.rudder_moment * u), "yaw: {r}");
        assert!(near(-body.side_drag * w, body.mass * r * u), "sway: {w}");
        let ahead = body.thrust.at(u) - body.drag * u;
        assert!(near(-ahead, body.mass * r * w), "surge: {ahead}, {}", body.mass * r * w);
    }
}

#[test]
fn the_force_rotates_with_the_ship() {
    let body = Helm { rudder: 0.3, ..helm(curve()) };
    let turned = |angle: f64| {
        let turn = DVec2::from_angle(angle);
        let q = DVec3::new(0.0, 0.0, 0.4 + angle);
        let v = turn.rotate(DVec2::new(4.0, 1.0)).extend(0.2);
        let mut a = DVec3::NAN;
        body.acceleration(0.0, &q, &v, &mut a);
        DVec2::from_angle(-angle).rotate(a.truncate()).extend(a.z)
    };
    for angle in [0.5, 2.0, -3.0] {
        assert!((turned(angle) - turned(0.0)).abs().max_element() < 1e-14);
    }
}

#[test]
fn a_kick_acts_ahead_and_keeps_throttle_and_rudder() {
    let mut body = helm(curve());
    let mut state = State { q: DVec3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2), v: DVec3::ZERO };
    assert!(body.input(Input::Kick(2.0), &mut state));
    assert!((state.v - DVec3::new(0.0, 2.0, 0.0)).length() < 1e-15, "{}", state.v);
    assert!(body.input(Input::Rudder(-0.5), &mut state));
    assert!(body.input(Input::Throttle(0.25), &mut state));
    assert_eq!((body.rudder, body.throttle), (-0.5, 0.25));
    assert_eq!(body.exact(0.0, &state), None);
    assert_eq!(body.energy(&state), None);
}
