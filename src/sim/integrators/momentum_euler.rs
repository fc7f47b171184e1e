//! A turn by the angular velocity, with the momentum fixed in space.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "momentum-euler",
    name: "Momentum Euler",
    about: "keeps L in space; drives every spin to the axis of the least moment, faster and faster",
    order: 1,
    order_with_drag: 1,
    source: "Buss, Accurate and efficient simulation of rigid-body rotations (2000)",
    formula: &["turn by h ω", "L stays in space: ω′ = I⁻¹ exp(−h ω) L"],
    ..GYRO
};

/// Momentum Euler, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct MomentumEuler;

impl GyroRule for MomentumEuler {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(turned(moments, omega, h * omega))
    }
}
