//! Lerp by the frame's duration, which is explicit Euler on the first-order law.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "lerp-dt",
    name: "Lerp by dt",
    about: "the right speed at high frame rates; overshoots above a step of 1 / k and explodes above 2 / k",
    stability_limit: Some(2.0),
    source: "folklore of game code; F. Holmér, Lerp smoothing is broken (2024)",
    formula: &["x′ = x + k h (g − x)", "v′ = k (g − x′)"],
    follower: Some(FollowerSetting::rate("x += (target - x) * {} * dt;")),
    ..FIRST_ORDER_FOLLOWER
};

/// Lerp by dt, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct LerpDt;

impl FollowerRule for LerpDt {
    fn step(h: f64, k: f64, g: f64, x: f64, _v: f64) -> (f64, f64) {
        lerp(k * h, k, g, x)
    }
}
