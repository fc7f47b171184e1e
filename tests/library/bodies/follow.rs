//! The exact motion of a body that follows a target, and the bound on its error.

use regatta::sim::State;
use regatta::sim::bodies::{Body, Follow, Input};

use super::flow::satisfies_its_equation;

/// Bodies by both laws behind a step, a ramp, a sine, and all of them.
fn bodies() -> Vec<Follow> {
    let mut bodies = Vec::new();
    for order in [1, 2] {
        for rate in [0.2, 3.0, 40.0] {
            for (step, ramp, sine) in
                [(1.0, 0.0, 0.0), (0.0, 0.7, 0.0), (0.0, 0.0, 0.5), (-2.0, 0.3, 0.8)]
            {
                let (x0, v0) = (-1.5, 0.4);
                bodies.push(Follow {
                    order,
                    rate,
                    step,
                    ramp,
                    sine,
                    sine_hz: 1.3,
                    x0,
                    v0,
                    kick: 0.5,
                });
            }
        }
    }
    bodies
}

#[test]
fn the_exact_motion_satisfies_the_equation_from_any_state() {
    for body in bodies() {
        for from in [body.start(), State { q: 3.0, v: -2.0 }, State { q: 0.0, v: 0.0 }] {
            for dt in [0.05, 0.4, 2.0] {
                satisfies_its_equation(&body, &from, dt, 1.0 / body.rate.max(8.0), 1e-9);
            }
        }
    }
}

#[test]
fn a_first_order_velocity_is_the_rate_times_the_distance() {
    for body in bodies().iter().filter(|body| body.order == 1) {
        for t in [0.0, 0.1, 1.0, 5.0] {
            let State { q, v } = body.exact(t, &body.start()).unwrap();
            let law = body.rate * (body.target(t) - q);
            assert!((v - law).abs() < 1e-12 * (1.0 + body.rate), "{body:?} at {t}: {v}, {law}");
        }
    }
}

#[test]
fn after_a_step_the_motion_is_the_textbook_exponential() {
    for body in bodies().iter().filter(|body| body.is_still()) {
        let z = body.rate * 0.3;
        let part =
            if body.order == 1 { 1.0 } else { 1.0 + z + body.v0 * 0.3 / (body.x0 - body.step) };
        let wanted = body.step + (body.x0 - body.step) * part * libm::exp(-z);
        let found = body.exact(0.3, &body.start()).unwrap().q;
        assert!((found - wanted).abs() < 1e-14, "{body:?}: {found}, {wanted}");
    }
}

#[test]
fn two_strides_equal_one_within_a_tight_error_bound() {
    let mut worst: f64 = 0.0;
    for body in bodies() {
        let from = body.start();
        for (t, a, b) in [(0.0, 0.1, 0.7), (0.3, 2.0, 1.0), (50.0, 0.5, 4.0), (7.0, 0.5, -0.5)] {
            let flown = |t: f64, dt: f64, from: &State<f64>| {
                let mut to = *from;
                body.exact_into(t, dt, from, &mut to);
                to
            };
            let between = flown(t, a, &from);
            let twice = flown(t + a, b, &between);
            let once = flown(t, a + b, &from);
            let bounds = [
                body.exact_error(t, a, &from, &between),
                body.exact_error(t + a, b, &between, &twice),
                body.exact_error(t, a + b, &from, &once),
            ];
            // An error of the first stride is carried by the second, backwards growing.
            let grown = (1.0 + body.rate * b.abs()) * libm::exp((-body.rate * b).max(0.0));
            let carried = [
                grown * (bounds[0][0] + b.abs() * bounds[0][1]),
                grown * (bounds[0][1] + body.rate * bounds[0][0]),
            ];
            for (i, off) in
                [(once.q - twice.q).abs(), (once.v - twice.v).abs()].into_iter().enumerate()
            {
                let bound = carried[i] + bounds[1][i] + bounds[2][i];
                assert!(off <= bound, "{body:?} from {t} by {a} and {b}: {off:e} of {bound:e}");
                worst = worst.max(off / bound);
            }
        }
    }
    assert!(worst > 1e-3, "the bound is {} times too large", 1.0 / worst);
}

#[test]
fn a_kick_displaces_a_follower_and_keeps_it_on_its_law() {
    for mut body in bodies() {
        let mut state = body.start();
        let before = state;
        assert!(body.input(Input::Kick(2.0), &mut state));
        assert_eq!(state.q, before.q + 1.0);
        let slower = if body.order == 1 { body.rate } else { 0.0 };
        assert_eq!(state.v, before.v - slower);
        assert!(!body.input(Input::Throttle(1.0), &mut state));
    }
}
