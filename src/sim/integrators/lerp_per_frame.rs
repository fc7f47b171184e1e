//! Lerp per frame: a tenth of the way in every step, however long the step is.

use std::marker::PhantomData;

use super::card::{FIRST_ORDER_FOLLOWER, Method};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, lerp, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

pub(super) const CARD: Method = Method {
    id: "lerp-per-frame",
    name: "Lerp per frame",
    about: "a tenth of the way in each frame: four times as fast at 144 frames a second as at 30",
    order: 0,
    order_with_drag: 0,
    source: "folklore of game code; R. Pavlov, Improved Lerp Smoothing, Game Developer (2016)",
    formula: &["x′ = x + 0.1 (g − x)", "v′ = k (g − x′)"],
    code: include_str!("../../../assets/methods/lerp-per-frame.step"),
    ..FIRST_ORDER_FOLLOWER
};

/// The part of the way that each step goes: a usual value. The higher it is, the faster the chase at every rate.
const PART: f64 = 0.1;

/// `x' = x + 0.1 (g - x)`, for the target `g` at the end of the step.
#[derive(Clone)]
pub struct LerpPerFrame<V>(PhantomData<V>);

impl<S: System> Integrator<S> for LerpPerFrame<S::Vector> {
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
        each(&g, state, lerp(PART, k));
        Ok(())
    }
}
