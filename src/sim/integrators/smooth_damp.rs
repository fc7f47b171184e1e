//! Smooth damp, as in Unity. It is the closed form of the critically damped spring, with a rational function for the
//! exponential and a clamp of overshoot.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "smooth-damp",
    name: "Smooth damp",
    about: "a critically damped spring within 0.12 % up to a step of 1 / ω; stops dead where it meets a moving target",
    source: "Lowe, Critically Damped Ease-In/Ease-Out Smoothing, Game Programming Gems 4, 1.10 (2004); Unity, Mathf.SmoothDamp",
    formula: &[
        "e = 1 / (1 + z + 0.48 z² + 0.235 z³), z = ω h",
        "b = (v + ω (x − g)) h, p = g + (x − g + b) e",
        "if (g > x) = (p > g): x′ = g, v′ = 0",
        "else: x′ = p, v′ = (v − ω b) e",
    ],
    follower: Some(FollowerSetting {
        name: "smooth_time",
        quantity: FollowerQuantity::SmoothTime,
        code: "x = Mathf.SmoothDamp(x, target, ref velocity, {}f);",
    }),
    ..SECOND_ORDER_FOLLOWER
};

/// Smooth damp, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct SmoothDamp;

impl FollowerRule for SmoothDamp {
    fn step(h: f64, omega: f64, g: f64, x: f64, v: f64) -> (f64, f64) {
        let z = omega * h;
        let e = 1.0 / (1.0 + z + 0.48 * z * z + 0.235 * z * z * z);
        let change = x - g;
        let b = (v + omega * change) * h;
        let end = g + (change + b) * e;
        if (g - x > 0.0) == (end > g) { (g, 0.0) } else { (end, (v - omega * b) * e) }
    }
}
