//! The classical Runge-Kutta method on the angular velocity, and on the group of rotations for the attitude.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-rk4",
    name: "Gyroscopic Runge-Kutta 4",
    about: "accurate at a fine tick; a fast wobble loses energy",
    order: 4,
    order_with_drag: 4,
    evaluation_cost: 4,
    source: "Kutta (1901), on the group of rotations: MuJoCo's integrator RK4",
    formula: &[
        "ω₁ to ω₄ of RK4 on a = −I⁻¹(ω × L), and ω′",
        "du/dt = w + ½ u × w + u × (u × w) / 12 with them, turn by u",
    ],
    ..GYRO
};

/// Gyroscopic Runge-Kutta 4, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroRk4;

impl GyroRule for GyroRk4 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(SpinMap::RungeKutta.turn(moments, omega, h))
    }
}
