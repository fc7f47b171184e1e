//! A turn by the angular velocity of the middle of the step, with the momentum fixed in space.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "buss-2",
    name: "Buss 2",
    about: "keeps L in space; a wobbling coin still gains energy",
    order: 2,
    order_with_drag: 2,
    source: "Buss, Accurate and efficient simulation of rigid-body rotations (2000)",
    formula: &["w = ω + ½h a, turn by h w", "L stays in space: ω′ = I⁻¹ exp(−h w) L"],
    ..GYRO
};

/// Buss 2, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Buss2;

impl GyroRule for Buss2 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let rate = free_acceleration(moments, omega);
        Ok(turned(moments, omega, h * (omega + h / 2.0 * rate)))
    }
}
