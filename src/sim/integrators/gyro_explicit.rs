//! Explicit Euler on the angular velocity.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-explicit",
    name: "Explicit gyroscopic term",
    about: "gains energy at every step, until it blows up",
    order: 1,
    order_with_drag: 1,
    source: "MuJoCo's integrator Euler; Euler, Theoria motus corporum solidorum (1765)",
    formula: &["ω′ = ω − h I⁻¹(ω × L), then turn by h ω′"],
    ..GYRO
};

/// Explicit gyroscopic term, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroExplicit;

impl GyroRule for GyroExplicit {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(SpinMap::Explicit.turn(moments, omega, h))
    }
}
