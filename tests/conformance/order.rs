//! Global order, from the error's fall as the step is halved.

use regatta::sim::State;
use regatta::sim::bodies::Body;
use regatta::sim::integrators::{METHODS, Method};

use super::systems::{SHIP, fresh, spring};

/// Errors below this, for values of 1 to 100, are too near round-off to tell an order from.
const FLOOR: f64 = 4e-12;
/// Halvings that have to agree.
const HALVINGS: usize = 4;

/// Steps to begin with. An adaptive method's are its own unless its tolerance lets the whole step pass.
fn coarsest(method: &Method) -> u32 {
    if method.tolerance.is_some() { 2048 } else { 32 }
}

/// Moments at which the error is taken. The leading term of an error has zeros of its own, and beside
/// one the next term shows; at one moment or another it is large.
const MOMENTS: u32 = 8;

/// The largest error of position and of velocity in `steps` steps over `span` seconds.
fn errors<B: Body<Vector = f64>>(method: &Method, body: &B, span: f64, steps: u32) -> [f64; 2] {
    let start = body.start();
    let mut integrator = fresh::<B>(method);
    let mut state = start.clone();
    let mut worst = [0.0, 0.0];
    let stretch = span / f64::from(MOMENTS);
    for moment in 0..MOMENTS {
        let t = stretch * f64::from(moment);
        integrator.steps(body, t, stretch, steps / MOMENTS, &mut state).expect("a gentle motion");
        let truth = body.exact(t + stretch, &start).expect("a closed form");
        let State { q, v } = state;
        assert!(q.is_finite() && v.is_finite(), "{} at {steps} steps: {q}, {v}", method.id);
        worst = [(q - truth.q).abs().max(worst[0]), (v - truth.v).abs().max(worst[1])];
    }
    worst
}

/// The orders that the last halvings above round-off show.
fn orders(errors: impl Iterator<Item = f64>) -> Vec<f64> {
    let above: Vec<f64> = errors.take_while(|&error| error > FLOOR).collect();
    let orders: Vec<f64> = above.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    orders[orders.len().saturating_sub(HALVINGS)..].to_vec()
}

fn has_order<B: Body<Vector = f64>>(method: &Method, body: &B, span: f64, expected: u32) {
    let first = coarsest(method);
    let table: Vec<_> = (0..8).map(|k| errors(method, body, span, first << k)).collect();
    for (part, name) in ["position", "velocity"].into_iter().enumerate() {
        let orders = orders(table.iter().map(|errors| errors[part]));
        println!("{:22} {name} order {orders:.3?}", method.id);
        assert!(orders.len() >= HALVINGS, "{}: {name}: {orders:?} of {table:?}", method.id);
        for order in &orders {
            let off = (order - f64::from(expected)).abs();
            assert!(off < 0.1, "{}: {name}: {orders:?}, card {expected}", method.id);
        }
    }
}

#[test]
fn on_the_undamped_spring_each_method_has_the_order_on_its_card() {
    for method in METHODS {
        // 7.7 s is no multiple of the period 2π, of its half or of its quarter.
        has_order(method, &spring(1.0, 0.0), 7.7, method.order);
    }
}

#[test]
fn on_the_damped_spring_each_method_has_its_order_with_drag() {
    for method in METHODS {
        has_order(method, &spring(1.0, 0.2), 7.7, method.order_with_drag);
    }
}

#[test]
fn on_the_ship_each_method_has_its_order_with_drag() {
    for method in METHODS {
        has_order(method, &SHIP, 40.0, method.order_with_drag);
    }
}
