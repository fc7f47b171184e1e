//! The rotated momentum as an engine applies it: the velocity first, and a turn by it.

use super::gyro_rotated::circling;
use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-rotated-engine",
    name: "Rotated momentum, in an engine",
    about: "the ω of gyro-rotated, but an attitude that strays, so that L turns in space",
    order: 1,
    order_with_drag: 1,
    evaluation_cost: 2,
    source: "J. Jakubowski, avian#993, velocity form (2026)",
    formula: &[
        "k = ω × L, j = k · I⁻¹k / |k|², Ω = ω − j L",
        "ω′ = I⁻¹ exp(−h Ω) L, then turn by h ω′",
    ],
    ..GYRO
};

/// Rotated momentum, in an engine, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroRotatedEngine;

impl GyroRule for GyroRotatedEngine {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let (_, _, momentum) = circling(h, moments, omega);
        let omega = momentum / moments;
        Ok((omega, turn_by(h * omega)))
    }
}
