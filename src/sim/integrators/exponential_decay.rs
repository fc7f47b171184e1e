//! Exponential decay: the exact solution for a target that rests during the step.

use std::marker::PhantomData;

use super::card::{FIRST_ORDER_FOLLOWER, Method};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, lerp, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

pub(super) const CARD: Method = Method {
    id: "exponential-decay",
    name: "Exponential decay",
    about: "exact at any frame rate while the target rests, and as cheap as a lerp",
    source: "exact solution of x' = k (g - x); F. Holmér, Lerp smoothing is broken (2024)",
    formula: &["x′ = g + (x − g) exp(−k h)", "v′ = k (g − x′)"],
    code: include_str!("../../../assets/methods/exponential-decay.step"),
    ..FIRST_ORDER_FOLLOWER
};

/// `x' = x + (1 - e^(-k h)) (g - x)`, for the target `g` at the end of the step.
#[derive(Clone)]
pub struct ExponentialDecay<V>(PhantomData<V>);

impl<S: System> Integrator<S> for ExponentialDecay<S::Vector> {
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
        each(&g, state, lerp(-libm::expm1(-k * h), k));
        Ok(())
    }
}
