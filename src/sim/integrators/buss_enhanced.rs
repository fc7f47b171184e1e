//! Buss 2 with the term by which turns do not commute.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "buss-enhanced",
    name: "Buss enhanced",
    about: "as Buss 2, with another error of the same order",
    order: 2,
    order_with_drag: 2,
    source: "Buss, Accurate and efficient simulation of rigid-body rotations (2000)",
    formula: &[
        "w = ω + ½h a + h² (a × ω) / 12, turn by h w",
        "L stays in space: ω′ = I⁻¹ exp(−h w) L",
    ],
    ..GYRO
};

/// Buss enhanced, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct BussEnhanced;

impl GyroRule for BussEnhanced {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let rate = free_acceleration(moments, omega);
        let across = h * h / 12.0 * rate.cross(omega);
        Ok(turned(moments, omega, h * (omega + h / 2.0 * rate + across)))
    }
}
