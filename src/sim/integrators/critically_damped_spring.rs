//! Critically damped spring, which is the exact solution for a target that rests during the step.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "critically-damped-spring",
    name: "Critically damped spring",
    about: "exact at any frame rate while the target rests; starts and stops softly",
    source: "Juckett, Damped Springs (2012); Holden, Spring-It-On: The Game Developer's Spring-Roll-Call (2021)",
    formula: &[
        "b = (v + ω (x − g)) h",
        "x′ = g + (x − g + b) exp(−ω h)",
        "v′ = (v − ω b) exp(−ω h)",
    ],
    follower: Some(FollowerSetting::rate(
        "(x, v) = critically_damped_spring(x, v, dt, target, {});",
    )),
    ..SECOND_ORDER_FOLLOWER
};

/// Critically damped spring, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct CriticallyDampedSpring;

impl FollowerRule for CriticallyDampedSpring {
    fn step(h: f64, omega: f64, g: f64, x: f64, v: f64) -> (f64, f64) {
        let e = libm::exp(-omega * h);
        let change = x - g;
        let b = (v + omega * change) * h;
        (g + (change + b) * e, (v - omega * b) * e)
    }
}
