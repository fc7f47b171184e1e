//! Exponential decay, which is the exact solution for a target that rests during the step.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "exponential-decay",
    name: "Exponential decay",
    about: "exact at any frame rate while the target rests, and as cheap as a lerp",
    source: "exact solution of x' = k (g - x); F. Holmér, Lerp smoothing is broken (2024)",
    formula: &["x′ = g + (x − g) exp(−k h)", "v′ = k (g − x′)"],
    follower: Some(FollowerSetting::rate("x += (target - x) * (1.0 - exp(-{} * dt));")),
    ..FIRST_ORDER_FOLLOWER
};

/// Exponential decay, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ExponentialDecay;

impl FollowerRule for ExponentialDecay {
    fn step(h: f64, k: f64, g: f64, x: f64, _v: f64) -> (f64, f64) {
        lerp(-libm::expm1(-k * h), k, g, x)
    }
}
