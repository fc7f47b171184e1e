//! What a follower reads of its system.

use crate::sim::integrators::StepFailure;
use crate::sim::integrators::card::Method;
use crate::sim::state::{State, Vector};
use crate::sim::system::{Pursuit, System};

/// The target of `system` at time `t` (s), if it is followed by a law of the order that `card` is for.
///
/// # Errors
/// The reason on the card, for any other system.
pub(in crate::sim::integrators) fn pursuit<S: System>(
    card: &Method,
    system: &S,
    t: f64,
) -> Result<Pursuit<S::Vector>, StepFailure> {
    let only = card.only.expect("a follower's card says what it follows");
    let order = only.with.map(|(_, order)| order);
    let pursuit = system.pursuit(t).filter(|found| order == Some(f64::from(found.order)));
    pursuit.ok_or(StepFailure::Refused { reason: only.reason })
}

/// A step of [`each`] that goes this part of the way to the target, and has the velocity there that the law of
/// first order has at the rate `k` (1/s).
#[inline]
pub(in crate::sim::integrators) fn lerp(part: f64, k: f64) -> impl Fn(f64, f64, f64) -> (f64, f64) {
    move |g, x, _v| {
        let end = x + part * (g - x);
        (end, k * (g - end))
    }
}

/// Applies `step` to each component with its target, coordinate and velocity, and sets the coordinate and
/// the velocity that it returns.
#[inline]
pub(in crate::sim::integrators) fn each<V: Vector>(
    g: &V,
    state: &mut State<V>,
    step: impl Fn(f64, f64, f64) -> (f64, f64),
) {
    let State { q, v } = state;
    let components = q.components_mut().iter_mut().zip(v.components_mut());
    for ((x, v), g) in components.zip(g.components()) {
        (*x, *v) = step(*g, *x, *v);
    }
}
