//! Smooth damp, as Unity has it: the closed form of the critically damped spring with a rational function for
//! the exponential, and a clamp of overshoot.

use std::marker::PhantomData;

use super::card::{Method, SECOND_ORDER_FOLLOWER};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

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
    code: include_str!("../../../assets/methods/smooth-damp.step"),
    ..SECOND_ORDER_FOLLOWER
};

/// With `z = ω h` and `e = 1 / (1 + z + 0.48 z² + 0.235 z³)`, for the target `g` at the end of the step:
/// `c = x - g`, `b = (v + ω c) h`, `x' = g + (c + b) e`, `v' = (v - ω b) e`. If `x'` is beyond `g`, as seen
/// from `x`, it is put at `g` with velocity 0.
#[derive(Clone)]
pub struct SmoothDamp<V>(PhantomData<V>);

impl<S: System> Integrator<S> for SmoothDamp<S::Vector> {
    fn new(_like: &S::Vector) -> Self {
        Self(PhantomData)
    }

    #[inline]
    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let Pursuit { target: g, rate: omega, .. } = pursuit(&CARD, system, t + h)?;
        let z = omega * h;
        let e = 1.0 / (1.0 + z + 0.48 * z * z + 0.235 * z * z * z);
        each(&g, state, |g, x, v| {
            let change = x - g;
            let b = (v + omega * change) * h;
            let end = g + (change + b) * e;
            if (g - x > 0.0) == (end > g) { (g, 0.0) } else { (end, (v - omega * b) * e) }
        });
        Ok(())
    }
}
