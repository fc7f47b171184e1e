//! Critically damped spring: the exact solution for a target that rests during the step.

use std::marker::PhantomData;

use super::card::{Method, SECOND_ORDER_FOLLOWER};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

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
    code: include_str!("../../../assets/methods/critically-damped-spring.step"),
    ..SECOND_ORDER_FOLLOWER
};

/// With `c = x - g`, for the target `g` at the end of the step, and `b = (v + ω c) h`:
/// `x' = g + (c + b) e^(-ω h)`, `v' = (v - ω b) e^(-ω h)`.
#[derive(Clone)]
pub struct CriticallyDampedSpring<V>(PhantomData<V>);

impl<S: System> Integrator<S> for CriticallyDampedSpring<S::Vector> {
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
        let e = libm::exp(-omega * h);
        each(&g, state, |g, x, v| {
            let change = x - g;
            let b = (v + omega * change) * h;
            (g + (change + b) * e, (v - omega * b) * e)
        });
        Ok(())
    }
}
