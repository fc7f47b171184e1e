//! Implicit spring, which is backward Euler of the critically damped spring, solved by hand.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "implicit-spring",
    name: "Implicit spring",
    about: "stable at any frame rate, without an exponential; follows more slowly the lower the rate",
    source: "Holden, Spring-It-On: The Game Developer's Spring-Roll-Call (2021)",
    formula: &["v′ = (v + h ω² (g − x)) / (1 + ω h)²", "x′ = x + h v′"],
    follower: Some(FollowerSetting::rate("(x, v) = implicit_spring(x, v, dt, target, {});")),
    ..SECOND_ORDER_FOLLOWER
};

/// Implicit spring, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImplicitSpring;

impl FollowerRule for ImplicitSpring {
    fn step(h: f64, omega: f64, g: f64, x: f64, v: f64) -> (f64, f64) {
        let (pull, z) = (omega * omega * h, omega * h);
        let end = (v + pull * (g - x)) / (1.0 + 2.0 * z + z * z);
        (x + h * end, end)
    }
}
