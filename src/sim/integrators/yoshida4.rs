//! Yoshida 4, which makes three position Verlet steps, the middle one backwards. Their lengths are chosen so that their
//! third-order errors cancel.

use super::prelude::*;
use super::shared::compose;

pub(super) const CARD: Method = Method {
    id: "yoshida4",
    name: "Yoshida 4",
    about: "fourth order and symplectic for three evaluations; drag leaves it first order",
    caveat: STEPS_BACK,
    order: 4,
    order_with_drag: 1,
    evaluations: Some(3),
    stability_limit: Some(1.573),
    damped_limits: Some([2.046, 1.111, 0.584]),
    source: "Forest & Ruth, Fourth-order symplectic integration (1990); Yoshida, Construction of higher order symplectic integrators (1990)",
    formula: &[
        "drift ½θ, kick θ, drift ½(1 − θ), kick 1 − 2θ",
        "drift ½(1 − θ), kick θ, drift ½θ",
        "θ = 1 / (2 − ∛2)",
    ],
    ..SYMPLECTIC
};

/// θ = 1 / (2 - ∛2), the length of each of the outer two steps, relative to the whole step. The length of the middle
/// step is 1 - 2θ < 0.
const THETA: f64 = 1.351_207_191_959_657_6;
/// Drift and kick of each stage, as fractions of the step.
const STAGES: [(f64, f64); 3] =
    [(THETA / 2.0, THETA), ((1.0 - THETA) / 2.0, 1.0 - 2.0 * THETA), ((1.0 - THETA) / 2.0, THETA)];
/// The drift after the last kick.
const LAST: f64 = THETA / 2.0;

/// Yoshida 4, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Yoshida4<V> {
    a: V,
}

impl<S: System> Integrator<S> for Yoshida4<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        compose(system, t, h, y, &mut self.a, &STAGES, LAST);
        Ok(())
    }
}
