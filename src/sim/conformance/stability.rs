//! The step at which the undamped oscillator stops being bounded.

use super::Claim;
use super::problems::{fresh, problem, spring};
use crate::sim::integrators::{Method, StepFailure};
use crate::sim::state::State;

/// The most that an amplitude of 1 may be below the limit: at 0.99 of the limit of a symplectic map the ellipse
/// is 7 to 14 times as long as wide.
const BOUNDED: f64 = 20.0;

/// What an amplitude of 1 reaches beyond the limit.
const GROWN: f64 = 1e3;

/// The largest `√(x² + (v/ω)²)` in `steps` steps of `h` from an amplitude of 1; it stops once that is
/// beyond `enough`.
fn largest_amplitude(
    method: &Method,
    omega: f64,
    h: f64,
    steps: u32,
    enough: f64,
) -> Result<f64, StepFailure> {
    let body = problem(spring(omega, 0.0));
    let mut integrator = fresh(method);
    let mut state = State { q: 0.6, v: 0.8 * omega };
    let mut largest = 1.0;
    for step in 0..steps {
        integrator.step(&body, h * f64::from(step), h, &mut state)?;
        let amplitude = libm::hypot(state.q, state.v / omega);
        if !amplitude.is_finite() {
            return Ok(f64::INFINITY);
        }
        largest = amplitude.max(largest);
        if largest > enough {
            break;
        }
    }
    Ok(largest)
}

/// What contradicts a limit of `h ω`; `None` if nothing does.
fn contradiction(method: &Method, limit: f64) -> Result<Option<String>, StepFailure> {
    let parts = [0.1, 0.3, 0.5, 0.7, 0.9, 0.99];
    for z in parts.map(|part| part * limit).into_iter().filter(|z| *z > 0.0) {
        let most = largest_amplitude(method, 1.0, z, 20_000, 5.0 * BOUNDED)?;
        if most >= BOUNDED {
            return Ok(Some(format!("an amplitude of 1 grows beyond {most:.0} at h ω = {z:.4}")));
        }
    }
    let beyond = if limit > 0.0 { vec![1.01 * limit] } else { vec![0.1, 0.3, 1.0] };
    for z in beyond {
        // The slowest is improved Euler at 0.1: z⁴/8 a step.
        let most = largest_amplitude(method, 1.0, z, 1_000_000, GROWN)?;
        if most <= GROWN {
            return Ok(Some(format!("an amplitude of 1 grows to {most:.1} only at h ω = {z:.4}")));
        }
    }
    Ok(None)
}

/// What contradicts that there is no limit: a minute of a stiff spring at h ω = 10, five times beyond the usual
/// limit.
fn contradiction_to_none(method: &Method) -> Result<Option<String>, StepFailure> {
    let most = largest_amplitude(method, 100.0, 0.1, 600, 100.0)?;
    let grows = most >= 2.0;
    Ok(grows.then(|| format!("an amplitude of 1 grows to {most:.1} and more at h ω = 10")))
}

/// The largest `h ω`: within it the oscillator stays bounded, and beyond it grows.
pub(super) fn limit(method: &Method) -> Claim {
    let (claimed, found) = match method.stability_limit {
        Some(limit) => (format!("{limit}"), contradiction(method, limit)),
        None => ("none".to_owned(), contradiction_to_none(method)),
    };
    let (measured, holds) = match found {
        Err(failure) => (failure.to_string(), false),
        Ok(Some(contradiction)) => (contradiction, false),
        Ok(None) => {
            let words = match method.stability_limit {
                Some(limit) if limit > 0.0 => "bounded up to 0.99 of it, and grows at 1.01 of it",
                Some(_) => "grows at every step",
                None => "bounded at h ω = 10",
            };
            (words.to_owned(), true)
        }
    };
    Claim { field: "stability_limit", claimed, measured, holds }
}
