//! Measures whether a method is exact on linear systems.

use super::problems::{SHIP, fresh, problem, spring};
use super::{Claim, Measured, yes_or_no};
use crate::body::Body;
use crate::integrators::{Method, StepFailure};
use crate::state::nan_is_infinite;

/// An error below this number is rounding, summed over all steps.
const EXACT: f64 = 1e-13;

/// An error above this number is not rounding. The smallest such error is 1e-6, of Gauss-Legendre 4 on the ship.
const INEXACT: f64 = 1e-8;

/// Number of steps of a run.
const STEPS: u32 = 20;

/// Returns the largest error in steps of `h`, relative to the largest position and velocity.
fn error<B: Body<Vector = f64> + 'static>(
    method: &Method,
    body: &B,
    h: f64,
) -> Result<f64, StepFailure> {
    let (start, system) = (body.start(), problem(body.clone()));
    let (mut integrator, mut state) = (fresh(method), start);
    let (mut worst, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    for step in 0..STEPS {
        integrator.step(&system, h * f64::from(step), h, &mut state)?;
        let truth = body.exact(h * f64::from(step + 1), &start).expect("a closed form");
        for (part, (found, truth)) in
            [(state.q, truth.q), (state.v, truth.v)].into_iter().enumerate()
        {
            worst[part] = nan_is_infinite((found - truth).abs()).max(worst[part]);
            largest[part] = truth.abs().max(largest[part]);
        }
    }
    Ok((worst[0] / largest[0]).max(worst[1] / largest[1]))
}

/// Measures whether the method is exact on springs, with drag and without, and on the ship.
pub(super) fn is_exact(method: &Method) -> Measured {
    let errors = [
        error(method, &spring(1.0, 0.0), 0.7)?,
        error(method, &spring(1.0, 0.2), 0.7)?,
        error(method, &spring(9.0, 0.1), 0.7)?,
        error(method, &SHIP, 1.3)?,
    ];
    let most = errors.into_iter().fold(0.0, f64::max);
    let words = format!("off by {most:.1e} on springs and the ship");
    if (EXACT..=INEXACT).contains(&most) { Err(words.into()) } else { Ok((most < EXACT, words)) }
}

pub(super) fn exact_if_linear(method: &Method) -> Claim {
    yes_or_no("exact_if_linear", method.exact_if_linear, is_exact(method))
}
