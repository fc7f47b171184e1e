//! The order of a method with a rule for impacts, on both sides.

use regatta::sim::bodies::{Ball, Body};
use regatta::sim::integrators::{GENERAL_METHODS, Method};
use regatta::sim::{IMPACTS, Impact, Solver, stepper};

/// The order of the state 1.9 s after a drop from 2 m with drag, which has two impacts: from the errors by this
/// number of `counts` of steps near `coarse`, and by as many near eight times as many steps.
fn order(method: &'static Method, rule: &'static Impact, [coarse, counts]: [u32; 2]) -> f64 {
    let (gravity, restitution) = (9.81, 0.8);
    let body = Ball { height: 2.0, drag: 0.3, gravity, restitution, ..Ball::default() };
    let exact = body.exact(1.9, &body.start()).unwrap();
    let error = |near: u32| {
        let squares = (0..counts).map(|n| {
            let steps = near + n * 3 * near / (4 * counts);
            let h = 1.9 / f64::from(steps);
            let mut lane = stepper(body.clone(), Solver::Bouncing(method, None, rule));
            (0..steps).for_each(|tick| lane.advance(f64::from(tick) * h, h, 1).unwrap());
            (lane.q()[0] - exact.q).powi(2) + (lane.v()[0] - exact.v).powi(2)
        });
        squares.sum::<f64>().sqrt()
    };
    (error(coarse) / error(8 * coarse)).log2() / 3.0
}

#[test]
fn every_method_has_the_order_with_a_rule_that_its_card_says() {
    for method in GENERAL_METHODS {
        for rule in IMPACTS {
            let Some(claimed) = rule.order(method).filter(|order| *order > 0) else { continue };
            // The drag of this ball is linear, which such a method does without an error.
            if method.exact_if_linear && claimed > 1 {
                continue;
            }
            // At an order above 4 the finer steps reach round-off. The place of an impact within its step scatters the
            // errors of order 1.
            let coarse = if claimed > 4 { 8 } else { 64 };
            let found = order(method, rule, [coarse, if claimed == 1 { 24 } else { 12 }]);
            let is_plain = ["rk4", "velocity-verlet"].contains(&method.id) || claimed > 4;
            let within = match claimed {
                _ if is_plain => 0.05,
                1 => 0.1,
                _ => 0.12,
            };
            let off = (found - f64::from(claimed)).abs();
            assert!(off < within, "{} with {rule:?}: {found}, not {claimed}", method.id);
        }
    }
}
