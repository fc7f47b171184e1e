//! How the chapter's adaptive Euler chooses its steps, by the times at which it asks for the force.

use std::cell::RefCell;

use regatta::sim::integrators::{AdaptiveEuler, Integrator, Override, Tolerance};
use regatta::sim::{State, System};

/// A body at rest far from where its force would have it; remembers the times it is asked for.
struct Asked(RefCell<Vec<f64>>);

impl System for Asked {
    type Vector = f64;
    fn acceleration(&self, t: f64, q: &f64, _v: &f64, a: &mut f64) {
        self.0.borrow_mut().push(t);
        *a = -q;
    }
}

#[test]
fn step_doubling_changes_its_step_by_a_fifth_to_fivefold() {
    let trials = |absolute_q: f64, from: f64, ticks: &[f64]| {
        let system = Asked(RefCell::default());
        let allowed = Tolerance { absolute_q, absolute_v: f64::INFINITY, relative: 0.0 };
        let mut adaptive = AdaptiveEuler::with_tolerance(&from, allowed);
        let mut state = State { q: from, v: 0.0 };
        let mut before = 0;
        for &h in ticks {
            before = system.0.borrow().len();
            adaptive.step(&system, 0.0, h, &mut state).unwrap();
        }
        system.0.borrow()[before..].to_vec()
    };
    let begins = |found: &[f64], wanted: &[f64]| {
        let close = |(found, wanted): (&f64, &f64)| (found - wanted).abs() < 1e-12;
        assert!(found.iter().zip(wanted).all(close), "{found:?}, wanted {wanted:?}");
        assert!(found.len() >= wanted.len());
    };
    // The error at rest is h²/4. A step of 1 s is tried, then a fifth of it, and again a fifth. Then comes the step
    // from the error, 0.9 √(1e-6 · 4) s, with the second slope taken in its middle.
    let first = trials(1e-6, 1.0, &[1.0]);
    begins(&first, &[0.0, 0.5, 0.1, 0.02, 0.004, 0.0009]);
    // Where any error is allowed from then on, each substep is five times the one before, up to the end of the tick.
    let system = Asked(RefCell::default());
    let allowed = |absolute_q| Tolerance { absolute_q, absolute_v: f64::INFINITY, relative: 0.0 };
    let mut adaptive = AdaptiveEuler::with_tolerance(&1.0, allowed(1e-6));
    let mut state = State { q: 1.0, v: 0.0 };
    adaptive.step(&system, 0.0, 1.0, &mut state).unwrap();
    Integrator::<Asked>::set(&mut adaptive, Override::Tolerance(allowed(f64::INFINITY)));
    system.0.borrow_mut().clear();
    adaptive.step(&system, 0.0, 1.0, &mut state).unwrap();
    let asked = system.0.into_inner();
    let starts: Vec<f64> = asked.iter().step_by(2).copied().chain([1.0]).collect();
    let steps: Vec<f64> = starts.windows(2).map(|ends| ends[1] - ends[0]).collect();
    assert!(steps.len() >= 3 && steps[0] < 0.05, "{steps:?}");
    for (n, pair) in steps.windows(2).enumerate() {
        let factor = pair[1] / pair[0];
        let is_last = n + 2 == steps.len();
        assert!((factor - 5.0).abs() < 1e-9 || is_last && factor < 5.0, "{steps:?}");
        let middle = (starts[n] + starts[n + 1]) / 2.0;
        assert!((asked[2 * n + 1] - middle).abs() < 1e-12, "{asked:?}");
    }
}
