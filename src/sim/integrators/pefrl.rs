//! PEFRL, position-extended Forest-Ruth-like. It has one more kick than Yoshida 4, for a far smaller error.

use super::prelude::*;
use super::shared::compose;

pub(super) const CARD: Method = Method {
    id: "pefrl",
    name: "PEFRL",
    about: "fourth order and symplectic for four evaluations, more accurate than Yoshida 4; drag leaves it first order",
    caveat: STEPS_BACK,
    order: 4,
    order_with_drag: 1,
    evaluations: Some(4),
    stability_limit: Some(2.989),
    damped_limits: Some([2.67, 2.947, 1.078]),
    source: "Omelyan, Mryglod & Folk, Optimized Forest-Ruth- and Suzuki-like algorithms for integration of motion in many-body systems (2002)",
    formula: &[
        "drift ξ, kick ½ − λ, drift χ, kick λ",
        "drift 1 − 2 (χ + ξ), kick λ",
        "drift χ, kick ½ − λ, drift ξ",
        "ξ = 0.1786178958448091",
        "λ = −0.2123418310626054",
        "χ = −0.0662645826698185",
    ],
    ..SYMPLECTIC
};

const XI: f64 = 0.178_617_895_844_809_1;
const LAMBDA: f64 = -0.212_341_831_062_605_4;
const CHI: f64 = -0.066_264_582_669_818_5;
/// Drift and kick of each stage, as fractions of the step.
const STAGES: [(f64, f64); 4] = [
    (XI, (1.0 - 2.0 * LAMBDA) / 2.0),
    (CHI, LAMBDA),
    (1.0 - 2.0 * (CHI + XI), LAMBDA),
    (CHI, (1.0 - 2.0 * LAMBDA) / 2.0),
];
/// The drift after the last kick.
const LAST: f64 = XI;

/// PEFRL, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Pefrl<V> {
    a: V,
}

impl<S: System> Integrator<S> for Pefrl<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        compose(system, t, h, y, &mut self.a, &STAGES, LAST);
        Ok(())
    }
}
