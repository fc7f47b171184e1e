//! Bogacki-Shampine 3(2), which keeps the result of order 3 and estimates the error by order 2. It has four slopes, of
//! which three are new in each step.

use super::prelude::*;
use super::shared::embedded_pair::{EmbeddedPair, Pair};

pub(super) const CARD: Method = Method {
    id: "bogacki-shampine-32",
    name: "Bogacki-Shampine 3(2)",
    about: "adaptive: covers each tick in as many substeps of three evaluations as its tolerance asks",
    order: 3,
    order_with_drag: 3,
    tolerance: Some(Tableau::TOLERANCE),
    source: "Bogacki & Shampine, A 3(2) pair of Runge-Kutta formulas (1989)",
    formula: &[
        "k₁ = f(t, y), k₂ = f(t + ½h, y + ½h k₁)",
        "k₃ = f(t + ¾h, y + ¾h k₂), k₄ = f(t + h, y′)",
        "error = h |5 k₁ − 6 k₂ − 8 k₃ + 9 k₄| / 72",
        "y′ = y + h (2 k₁ + 3 k₂ + 4 k₃) / 9 if the error is small",
    ],
    ..ADAPTIVE
};

/// Bogacki-Shampine 3(2), by the [formula](Method::formula) on its card.
pub type BogackiShampine32<V> = EmbeddedPair<V, Tableau, 4>;

/// The coefficients of the paper.
#[derive(Clone)]
pub struct Tableau;

impl Pair<4> for Tableau {
    const ORDER: u32 = 3;
    const C: [f64; 4] = [0.0, 1.0 / 2.0, 3.0 / 4.0, 1.0];
    const A: [[f64; 4]; 4] = [
        [0.0; 4],
        [1.0 / 2.0, 0.0, 0.0, 0.0],
        [0.0, 3.0 / 4.0, 0.0, 0.0],
        [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0],
    ];
    const E: [f64; 4] = [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0];
    /// A tenth of a millimetre, a tenth of a millimetre per second, or a ten thousandth of the value.
    const TOLERANCE: Tolerance = Tolerance::uniform(1e-4);
}
