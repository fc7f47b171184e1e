//! Adaptive Euler. The difference between one whole step and two half steps estimates the error, which controls the
//! step size.

use super::prelude::*;
use super::shared::embedded_pair::{EmbeddedPair, Pair};
use super::shared::step_size::factor;

pub(super) const CARD: Method = Method {
    id: "adaptive-euler",
    name: "Adaptive Euler",
    about: "the chapter's step doubling, corrected: covers each tick in as many substeps as its tolerance asks",
    order: 2,
    order_with_drag: 2,
    tolerance: Some(Tableau::TOLERANCE),
    source: "Bourg & Bywalec, Physics for Game Developers 2e, ch. 7, corrected; step control after Hairer, Nørsett & Wanner, Solving ODEs I, II.4",
    formula: &[
        "k₁ = f(t, y), k₂ = f(t + ½h, y + ½h k₁)",
        "error = ½h |k₁ − k₂|",
        "y′ = y + h k₂ if the error is small",
    ],
    ..ADAPTIVE
};

/// Step doubling as a pair. `y1` is the result of one Euler step of `h`, and `y2` that of two Euler steps of `h/2`.
/// Their difference estimates the error. The method keeps the extrapolated `2 y2 - y1`, which is the midpoint method.
pub type AdaptiveEuler<V> = EmbeddedPair<V, Tableau, 3>;

/// The weights of the midpoint method, and their difference from those of `y2`.
#[derive(Clone)]
pub struct Tableau;

impl Pair<3> for Tableau {
    const ORDER: u32 = 2;
    const C: [f64; 3] = [0.0, 1.0 / 2.0, 1.0];
    const A: [[f64; 3]; 3] = [[0.0; 3], [1.0 / 2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    const E: [f64; 3] = [-1.0 / 2.0, 1.0 / 2.0, 0.0];
    /// A millimetre, a millimetre per second, or a thousandth of the value, which are just visible.
    const TOLERANCE: Tolerance = Tolerance { absolute_q: 1e-3, absolute_v: 1e-3, relative: 1e-3 };

    #[inline(always)]
    fn factor(error: f64) -> f64 {
        factor(error.sqrt())
    }
}
