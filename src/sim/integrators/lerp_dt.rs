//! Lerp by the frame's duration: explicit Euler of the law of first order.

use std::marker::PhantomData;

use super::card::{FIRST_ORDER_FOLLOWER, Method};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, lerp, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

pub(super) const CARD: Method = Method {
    id: "lerp-dt",
    name: "Lerp by dt",
    about: "the right speed at high frame rates; overshoots above a step of 1 / k and explodes above 2 / k",
    stability_limit: Some(2.0),
    source: "folklore of game code; F. Holmér, Lerp smoothing is broken (2024)",
    formula: &["x′ = x + k h (g − x)", "v′ = k (g − x′)"],
    code: include_str!("../../../assets/methods/lerp-dt.step"),
    ..FIRST_ORDER_FOLLOWER
};

/// `x' = x + k h (g - x)`, for the target `g` at the end of the step.
#[derive(Clone)]
pub struct LerpDt<V>(PhantomData<V>);

impl<S: System> Integrator<S> for LerpDt<S::Vector> {
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
        let Pursuit { target: g, rate: k, .. } = pursuit(&CARD, system, t + h)?;
        each(&g, state, lerp(k * h, k));
        Ok(())
    }
}
