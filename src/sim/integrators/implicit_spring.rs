//! Implicit spring: backward Euler of the critically damped spring, solved by hand.

use std::marker::PhantomData;

use super::card::{Method, SECOND_ORDER_FOLLOWER};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, pursuit};
use crate::sim::system::{Pursuit, State, System};

pub(super) const CARD: Method = Method {
    id: "implicit-spring",
    name: "Implicit spring",
    about: "stable at any frame rate, without an exponential; follows more slowly the lower the rate",
    source: "Holden, Spring-It-On: The Game Developer's Spring-Roll-Call (2021)",
    ..SECOND_ORDER_FOLLOWER
};

/// `v' = (v + h ω² (g - x)) / (1 + 2 h ω + h² ω²)`, `x' = x + h v'`, for the target `g` at the end of the step.
#[derive(Clone)]
pub struct ImplicitSpring<V>(PhantomData<V>);

impl<S: System> Integrator<S> for ImplicitSpring<S::Vector> {
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
        let (pull, z) = (omega * omega * h, omega * h);
        let resistance = 1.0 + 2.0 * z + z * z;
        each(&g, state, |g, x, v| {
            let end = (v + pull * (g - x)) / resistance;
            (x + h * end, end)
        });
        Ok(())
    }
}
