//! A flow against the differential equation itself, by finite differences.

use regatta::sim::bodies::Body;
use regatta::sim::{State, Vector};

/// The largest component.
pub(crate) fn size<V: Vector>(vector: &V) -> f64 {
    vector.components().iter().fold(0.0, |most, x| x.abs().max(most))
}

/// The largest difference between two vectors' components.
pub(crate) fn apart<V: Vector>(a: &V, b: &V) -> f64 {
    let pairs = a.components().iter().zip(b.components());
    // Written so that a NaN shows.
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, |most, x| if x <= most { most } else { x })
}

pub(crate) fn flow<B: Body>(body: &B, dt: f64, from: &State<B::Vector>) -> State<B::Vector> {
    let to = body.exact(dt, from).expect("a closed form");
    let values = to.q.components().iter().chain(to.v.components());
    assert!(values.clone().all(|x| x.is_finite()), "{values:?} after {dt} s");
    to
}

/// The derivative of the flow at `dt`, by central differences of order 8 over `step` seconds.
fn derivative<B: Body>(body: &B, from: &State<B::Vector>, dt: f64, step: f64) -> State<B::Vector> {
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = from.clone();
    sum.q.components_mut().fill(0.0);
    sum.v.components_mut().fill(0.0);
    for (weight, n) in weights.into_iter().zip(1..) {
        sum.add_scaled(weight / step, &flow(body, dt + step * f64::from(n), from));
        sum.add_scaled(-weight / step, &flow(body, dt - step * f64::from(n), from));
    }
    sum
}

/// Compares the derivative of the flow `dt` after `from` with the equation. `time_s` is the time scale of the motion
/// there; `tolerance` is relative to the motion.
pub(crate) fn satisfies_its_equation<B: Body>(
    body: &B,
    from: &State<B::Vector>,
    dt: f64,
    time_s: f64,
    tolerance: f64,
) {
    let there = flow(body, dt, from);
    let change = derivative(body, from, dt, 0.05 * time_s);
    let mut a = there.v.clone();
    body.acceleration(dt, &there.q, &there.v, &mut a);
    let speed = size(&there.v) + size(&a) * time_s;
    let error = [apart(&change.q, &there.v), apart(&change.v, &a) * time_s];
    let allowed = tolerance * (speed + size(&there.q) / time_s);
    assert!(error.iter().all(|error| *error <= allowed), "{error:?} of {allowed}, {dt} s on");
}

#[test]
fn a_wrong_flow_is_detected() {
    use regatta::sim::bodies::Ship;
    let ship =
        Ship { thrust: 2.0, throttle: 1.0, drag: 1.0, mass: 1.0, s0: 0.0, v0: 0.0, kick: 1.0 };
    let from = State { q: 0.3, v: 0.7 };
    satisfies_its_equation(&ship, &from, 0.4, 1.0, 1e-11);
    let check = || {
        // Right in the coordinate, wrong in the velocity by a millionth.
        #[derive(Clone)]
        struct Off(Ship);
        impl regatta::sim::System for Off {
            type Vector = f64;
            fn acceleration(&self, t: f64, q: &f64, v: &f64, a: &mut f64) {
                self.0.acceleration(t, q, v, a);
                *a += 1e-6;
            }
        }
        impl Body for Off {
            fn start(&self) -> State<f64> {
                self.0.start()
            }
            fn exact(&self, dt: f64, from: &State<f64>) -> Option<State<f64>> {
                self.0.exact(dt, from)
            }
            fn energy(&self, state: &State<f64>) -> Option<f64> {
                self.0.energy(state)
            }
            fn input(
                &mut self,
                input: regatta::sim::bodies::Input,
                state: &mut State<f64>,
            ) -> bool {
                self.0.input(input, state)
            }
            fn place(&self, q: &f64) -> glam::DVec2 {
                self.0.place(q)
            }
        }
        satisfies_its_equation(&Off(ship.clone()), &from, 0.4, 1.0, 1e-11);
    };
    assert!(std::panic::catch_unwind(check).is_err());
}
