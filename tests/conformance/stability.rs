//! The step at which the undamped oscillator stops being bounded.

use regatta::sim::State;
use regatta::sim::bodies::Spring;
use regatta::sim::integrators::{GENERAL_METHODS, Method, StepFailure};

use super::systems::{fresh, spring};

/// The largest `√(x² + (v/ω)²)` in `steps` steps of `h` from an amplitude of 1; it stops once that is
/// beyond `enough`.
fn largest_amplitude(
    method: &Method,
    omega: f64,
    h: f64,
    steps: u32,
    enough: f64,
) -> Result<f64, StepFailure> {
    let body: Spring = spring(omega, 0.0);
    let mut integrator = fresh(method);
    let mut state = State { q: 0.6, v: 0.8 * omega };
    let mut largest = 1.0;
    for step in 0..steps {
        integrator.step(&body, h * f64::from(step), h, &mut state)?;
        let amplitude = libm::hypot(state.q, state.v / omega);
        assert!(amplitude.is_finite(), "{} at step {step}", method.id);
        largest = amplitude.max(largest);
        if largest > enough {
            break;
        }
    }
    Ok(largest)
}

#[test]
fn below_its_limit_a_method_stays_bounded() {
    for method in GENERAL_METHODS {
        let Some(limit) = method.stability_limit else { continue };
        for part in [0.1, 0.3, 0.5, 0.7, 0.9, 0.99] {
            // At 0.99 of the limit of a symplectic map the ellipse is 7 to 14 times as long as wide.
            let z = part * limit;
            let most = largest_amplitude(method, 1.0, z, 20_000, 100.0).unwrap();
            assert!(most < 20.0, "{}: amplitude {most} at h ω = {z}", method.id);
        }
    }
}

#[test]
fn beyond_its_limit_a_method_grows() {
    for method in GENERAL_METHODS {
        let Some(limit) = method.stability_limit else { continue };
        let beyond = if limit > 0.0 { vec![1.01 * limit] } else { vec![0.1, 0.3, 1.0] };
        for z in beyond {
            // The slowest is improved Euler at 0.1: z⁴/8 a step.
            let most = largest_amplitude(method, 1.0, z, 1_000_000, 1e3).unwrap();
            assert!(most > 1e3, "{}: amplitude only {most} at h ω = {z}", method.id);
        }
    }
}

#[test]
fn a_method_without_a_limit_stays_bounded_at_any_tick() {
    // A minute of a stiff spring at h ω = 10, five times beyond the usual limit.
    for method in GENERAL_METHODS.iter().filter(|method| method.stability_limit.is_none()) {
        let most = largest_amplitude(method, 100.0, 0.1, 600, 100.0).unwrap();
        println!("{:22} {most}", method.id);
        assert!(most < 2.0, "{}: amplitude {most} after a minute", method.id);
    }
}
