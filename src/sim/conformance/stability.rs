//! Measures the length of a step beyond which a method's motion of an undamped oscillator is unbounded.

use super::Claim;
use super::problems::{fresh, problem, spring};
use crate::bodies::Spring;
use crate::integrators::{DAMPING_RATIOS, Method, StepFailure};
use crate::numerics::bisect;
use crate::stability::{CoupledMotion, SmallMotion};
use crate::state::{State, nan_is_infinite};
use crate::{Solver, stepper};

/// The largest amplitude that counts as bounded, from an amplitude of 1. At 0.99 of the limit of a symplectic map, the
/// ellipse of the motion is 7 to 14 times as long as it is wide.
const BOUNDED: f64 = 20.0;

/// The amplitude that counts as growth, from an amplitude of 1.
const GROWN: f64 = 1e3;

/// Returns the largest amplitude `√(x² + (v/ω)²)` in `steps` steps of `h` from an amplitude of 1. Stops once the
/// amplitude exceeds `enough`.
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

/// The largest product `h ω` that is tried, and the distance between tried products.
const MAX_LIMIT: f64 = 6.0;
const COARSE: f64 = 0.01;
/// The smallest product `h ω` that is tried without damping. Some methods then grow by `(h ω)⁴/8` a step, which is too
/// slow to measure below this product.
const UNSEEN: f64 = 0.06;
/// A spectral radius that exceeds 1 by more than this number counts as growth.
const SEEN: f64 = 1e-9;

/// Returns the map of one step of a fresh method under `a = -k x - c v`. The map has the new `x` and `v` for an `x` of
/// 1, then those for a `v` of 1.
pub(super) fn map_of(
    method: &Method,
    [k, c]: [f64; 2],
    h: f64,
) -> Result<[[f64; 2]; 2], StepFailure> {
    let system = problem(Spring { stiffness: k, damping: c, ..spring(1.0, 0.0) });
    let step = |q: f64, v: f64| {
        let mut state = State { q, v };
        fresh(method).step(&system, 0.0, h, &mut state)?;
        Ok([state.q, state.v])
    };
    let [from, by_q, by_v] = [step(0.3, -0.2)?, step(1.3, -0.2)?, step(0.3, 0.8)?];
    Ok([by_q, by_v].map(|to| [to[0] - from[0], to[1] - from[1]]))
}

/// Returns the spectral radius of the one-step map on an oscillator of 1 rad/s and this damping ratio; infinite if the
/// map has a NaN.
///
/// # Errors
/// If the method fails.
pub(super) fn radius(method: &Method, ratio: f64, h: f64) -> Result<f64, StepFailure> {
    let [[a, c], [b, d]] = map_of(method, [1.0, 2.0 * ratio], h)?;
    let (half_trace, determinant) = ((a + d) / 2.0, a * d - b * c);
    Ok(nan_is_infinite(match half_trace * half_trace - determinant {
        apart if apart > 0.0 => half_trace.abs() + apart.sqrt(),
        _ => determinant.sqrt(),
    }))
}

/// Returns the products `h ω` at which a method becomes unstable. The first is for the undamped oscillator in the long
/// run, and the others are for one step at each of [`DAMPING_RATIOS`]. A product is `None` if the method is stable at
/// all tried products.
///
/// # Errors
/// If the method fails.
pub fn limits(method: &'static Method) -> Result<[Option<f64>; 4], StepFailure> {
    radius(method, 0.0, COARSE)?;
    let undamped = small_motion();
    let in_one = |ratio: f64, h: f64| radius(method, ratio, h).is_ok_and(|it| it < 1.0 + SEEN);
    let for_long = |h: f64| {
        let found = undamped.as_ref().map(|motion| motion.stability(method, h, 1));
        found.is_some_and(|found| found.is_ok_and(|it| it.spectral_radius < 1.0 + SEEN))
    };
    let undamped = first_beyond(|h| h < UNSEEN || for_long(h));
    let undamped = undamped.map(|limit| if limit <= UNSEEN { 0.0 } else { limit });
    let [slight, medium, critical] = DAMPING_RATIOS.map(|ratio| first_beyond(|h| in_one(ratio, h)));
    Ok([undamped, slight, medium, critical])
}

/// Returns the motion of the undamped oscillator. The map of a method on this motion includes the method's memory.
pub(super) fn small_motion() -> Option<CoupledMotion> {
    let body = stepper(spring(1.0, 0.0), Solver::Truth);
    SmallMotion::of(&*body).ok()?.coupled().ok()
}

/// Returns the first `h` beyond which `stable` is false; `None` if it is true for all tried `h`.
fn first_beyond(stable: impl Fn(f64) -> bool) -> Option<f64> {
    let steps = (MAX_LIMIT / COARSE) as u32;
    let beyond = (1..steps).map(|n| COARSE * f64::from(n)).find(|&h| !stable(h))?;
    let [within, _] = bisect([beyond - COARSE, beyond], 20, stable);
    Some(within)
}

/// Returns evidence against a limit of `h ω`; `None` if there is no such evidence.
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
        // The slowest growth is that of improved Euler at 0.1, which grows by z⁴/8 a step.
        let most = largest_amplitude(method, 1.0, z, 1_000_000, GROWN)?;
        if most <= GROWN {
            return Ok(Some(format!("an amplitude of 1 grows to {most:.1} only at h ω = {z:.4}")));
        }
    }
    Ok(None)
}

/// Returns evidence against the absence of a limit. It runs a stiff spring for a minute at h ω = 10, which is five
/// times the usual limit.
fn contradiction_to_none(method: &Method) -> Result<Option<String>, StepFailure> {
    let most = largest_amplitude(method, 100.0, 0.1, 600, 100.0)?;
    let grows = most >= 2.0;
    Ok(grows.then(|| format!("an amplitude of 1 grows to {most:.1} and more at h ω = 10")))
}

/// Measures the limit of `h ω`. The oscillator must stay bounded below the limit, and grow beyond it.
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
