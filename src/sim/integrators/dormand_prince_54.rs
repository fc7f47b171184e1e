//! Dormand-Prince 5(4), which keeps the result of order 5 and estimates the error by order 4. It has seven slopes, of
//! which six are new in each step.

use super::prelude::*;
use super::shared::embedded_pair::{EmbeddedPair, Pair};

pub(super) const CARD: Method = Method {
    id: "dormand-prince-54",
    name: "Dormand-Prince 5(4)",
    about: "adaptive and accurate: covers each tick in as many substeps of six evaluations as its tolerance asks",
    order: 5,
    order_with_drag: 5,
    tolerance: Some(Tableau::TOLERANCE),
    source: "Dormand & Prince, A family of embedded Runge-Kutta formulae (1980), RK5(4)7M",
    formula: &[
        "kᵢ = f(t + cᵢ h, y + h Σ aᵢⱼ kⱼ), i = 1 … 7",
        "error = h |Σ eⱼ kⱼ|",
        "y′ = y + h Σ a₇ⱼ kⱼ if the error is small",
    ],
    ..ADAPTIVE
};

/// Dormand-Prince 5(4), by the [formula](Method::formula) on its card.
pub type DormandPrince54<V> = EmbeddedPair<V, Tableau, 7>;

/// The coefficients of the paper.
#[derive(Clone)]
pub struct Tableau;

#[rustfmt::skip]
impl Pair<7> for Tableau {
    const ORDER: u32 = 5;
    const C: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
    const A: [[f64; 7]; 7] = [
        [0.0; 7],
        [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0, 0.0],
        [19_372.0 / 6_561.0, -25_360.0 / 2_187.0, 64_448.0 / 6_561.0, -212.0 / 729.0, 0.0, 0.0, 0.0],
        [9_017.0 / 3_168.0, -355.0 / 33.0, 46_732.0 / 5_247.0, 49.0 / 176.0, -5_103.0 / 18_656.0, 0.0, 0.0],
        [35.0 / 384.0, 0.0, 500.0 / 1_113.0, 125.0 / 192.0, -2_187.0 / 6_784.0, 11.0 / 84.0, 0.0],
    ];
    const E: [f64; 7] = [
        71.0 / 57_600.0, 0.0, -71.0 / 16_695.0, 71.0 / 1_920.0, -17_253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0,
    ];
    /// A micrometre, a micrometre per second, or a millionth of the value.
    const TOLERANCE: Tolerance = Tolerance::uniform(1e-6);
}
