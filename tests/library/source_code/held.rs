//! Measures the claims in the headers about forces that depend on time.

use std::cell::Cell;
use std::rc::Rc;

use regatta::conformance::problems::{fresh, problem};
use regatta::sim::integrators::{Method, method};
use regatta::sim::{State, System};
use regatta::tools::source_code::{Language, Precision, source_code};

use super::known::sources;

/// A spring under a force that depends on time, which is held during a step.
struct Held {
    time: Cell<f64>,
}

fn acceleration(t: f64, q: f64, v: f64) -> f64 {
    (3.0 * t).sin() - 4.0 * q - 0.3 * v
}

impl System for Held {
    type Vector = f64;

    fn acceleration(&self, _t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = acceleration(self.time.get(), *q, *v);
    }
}

/// The position after one second in `steps` steps, each with the force held at its value after `part` of the step.
fn position(method: &Method, steps: u32, part: f64) -> f64 {
    let h = 1.0 / f64::from(steps);
    let held = Rc::new(Held { time: Cell::new(0.0) });
    let system = problem(held.clone());
    let mut state = State { q: 1.0, v: 0.0 };
    let mut stepper = fresh(method);
    for n in 0..steps {
        let t = f64::from(n) * h;
        held.time.set(t + part * h);
        stepper.steps(&system, t, h, 1, &mut state).unwrap();
    }
    state.q
}

#[test]
fn a_held_force_has_the_order_stated_in_the_header() {
    // Half the difference of halved steps is the error of the midpoint rule: this is exact to 1e-12.
    let exact = {
        let rk4 = method("rk4").unwrap();
        let [coarse, fine] = [1 << 15, 1 << 16].map(|steps| position(rk4, steps, 0.5));
        fine + (fine - coarse) / 3.0
    };
    let mut measured = 0;
    for (method, source) in sources() {
        let takes_acceleration = source.inputs().iter().any(|input| input.name == "a");
        let text = source_code(method, Language::C, Precision::Double).unwrap();
        assert_eq!(text.contains("Forces that depend on time"), takes_acceleration, "{text}");
        // The error of adaptive Euler is its tolerance, and engines do not know such a system.
        let is_measured = takes_acceleration && !method.is_engine() && method.order > 0;
        if !is_measured || method.id.starts_with("adaptive-euler") {
            continue;
        }
        let said = source.claim("held").unwrap_or("in its middle; the order is then 2 at most");
        let part = match () {
            () if said.starts_with("at its start") => 0.0,
            () if said.starts_with("at its end") => 1.0,
            () => 0.5,
        };
        let [coarse, fine] = [64, 128].map(|steps| (position(method, steps, part) - exact).abs());
        let order = (coarse / fine).log2();
        let wanted = if said.contains("then 2 at most") { method.order.min(2) } else { 1 };
        let wanted = wanted.min(method.order_with_drag);
        assert!((order - f64::from(wanted)).abs() < 0.3, "{}: {order}, not {wanted}", method.id);
        measured += 1;
    }
    assert!(measured > 25, "{measured}");
}
