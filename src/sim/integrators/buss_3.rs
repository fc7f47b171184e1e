//! A turn to third order, with the momentum fixed in space.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "buss-3",
    name: "Buss 3",
    about: "keeps L in space, and the energy better than Buss 2",
    order: 3,
    order_with_drag: 3,
    source: "Buss, Accurate and efficient simulation of rigid-body rotations (2000)",
    formula: &[
        "w = ω + ½h a + h² j / 6 − h² (a × ω) / 12, j = da/dt, turn by h w",
        "L stays in space: ω′ = I⁻¹ exp(−h w) L",
    ],
    ..GYRO
};

/// Buss 3, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Buss3;

impl GyroRule for Buss3 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let rate = free_acceleration(moments, omega);
        let second = free_jerk(moments, omega, rate);
        let bend = h * h * (second / 6.0 - rate.cross(omega) / 12.0);
        Ok(turned(moments, omega, h * (omega + h / 2.0 * rate + bend)))
    }
}
