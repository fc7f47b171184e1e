//! Global order, from the error's fall as the step is halved.

use regatta::sim::bodies::Body;
use regatta::sim::integrators::{METHODS, Method, integrator};
use regatta::sim::{State, System, Vector};

use super::systems::{Kepler, SHIP, kepler_orbit, spring};

/// Errors below this, for values of 1 to 100, are too near round-off to tell an order from.
const FLOOR: f64 = 4e-12;
/// Halvings that have to agree.
const HALVINGS: usize = 4;

/// Moments at which the error is taken. The leading term of an error has zeros of its own, and beside
/// one the next term shows; at one moment or another it is large.
const MOMENTS: u32 = 8;

/// The state at a time, from the start.
type Flow<S> = fn(&S, f64, &State<<S as System>::Vector>) -> State<<S as System>::Vector>;

/// A motion whose exact course is known.
struct Course<S: System> {
    system: S,
    start: State<S::Vector>,
    exact: Flow<S>,
    /// How long it is followed, in seconds.
    span: f64,
}

/// The course of a body.
fn of_body<B: Body>(body: B, span: f64) -> Course<B> {
    let exact: Flow<B> = |body, t, start| body.exact(t, start).expect("a closed form");
    Course { start: body.start(), system: body, exact, span }
}

impl<S: System + 'static> Course<S> {
    /// The largest error of position and of velocity in `steps` steps.
    fn errors(&self, method: &Method, steps: u32) -> [f64; 2] {
        let mut integrator = integrator::<S>(method, &self.start.q);
        let mut state = self.start.clone();
        let mut worst = [0.0, 0.0];
        let stretch = self.span / f64::from(MOMENTS);
        for moment in 0..MOMENTS {
            let t = stretch * f64::from(moment);
            let n = steps / MOMENTS;
            integrator.steps(&self.system, t, stretch, n, &mut state).expect("a gentle motion");
            let truth = (self.exact)(&self.system, t + stretch, &self.start);
            for (worst, (found, truth)) in
                worst.iter_mut().zip([(&state.q, &truth.q), (&state.v, &truth.v)])
            {
                for (found, truth) in found.components().iter().zip(truth.components()) {
                    assert!(found.is_finite(), "{} at {steps} steps: {found}", method.id);
                    *worst = (found - truth).abs().max(*worst);
                }
            }
        }
        worst
    }

    fn has_order(&self, method: &Method, expected: u32) {
        // Enough for the leading term of the error to show. An adaptive method's steps are its own
        // unless its tolerance lets the whole step pass.
        let first = if method.tolerance.is_some() { 2048 } else { 32 };
        let table: Vec<_> = (0..8).map(|k| self.errors(method, first << k)).collect();
        for (part, name) in ["position", "velocity"].into_iter().enumerate() {
            let orders = orders(table.iter().map(|errors| errors[part]));
            println!("{:26} {name} order {orders:.3?}", method.id);
            assert!(orders.len() >= HALVINGS, "{}: {name}: {orders:?} of {table:?}", method.id);
            for order in &orders {
                let off = order - f64::from(expected);
                // As printed, the velocity has the order of the method that the listing is meant to be.
                let better = method.as_printed && name == "velocity" && off > 0.0;
                assert!(off.abs() < 0.1 || better, "{}: {name}: {orders:?}", method.id);
            }
        }
    }
}

/// The orders that the last halvings above round-off show.
fn orders(errors: impl Iterator<Item = f64>) -> Vec<f64> {
    let above: Vec<f64> = errors.take_while(|&error| error > FLOOR).collect();
    let orders: Vec<f64> = above.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    orders[orders.len().saturating_sub(HALVINGS)..].to_vec()
}

#[test]
fn on_the_undamped_spring_each_method_has_the_order_on_its_card() {
    for method in METHODS {
        // 7.7 s is no multiple of the period 2π, of its half or of its quarter.
        of_body(spring(1.0, 0.0), 7.7).has_order(method, method.order);
    }
}

#[test]
fn on_a_kepler_orbit_each_method_has_the_order_on_its_card() {
    for method in METHODS {
        let exact = |_: &Kepler, t, _: &_| kepler_orbit(0.3, t);
        let start = kepler_orbit(0.3, 0.0);
        Course { system: Kepler, start, exact, span: 2.0 }.has_order(method, method.order);
    }
}

#[test]
fn on_the_damped_spring_each_method_has_its_order_with_drag() {
    for method in METHODS {
        of_body(spring(1.0, 0.2), 7.7).has_order(method, method.order_with_drag);
    }
}

#[test]
fn on_the_ship_each_method_has_its_order_with_drag() {
    for method in METHODS {
        of_body(SHIP, 40.0).has_order(method, method.order_with_drag);
    }
}
