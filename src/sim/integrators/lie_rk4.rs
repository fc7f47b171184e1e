//! The classical Runge-Kutta method on the group of rotations, with the momentum fixed in space.

use super::free_spin::on_group;
use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "lie-rk4",
    name: "Lie Runge-Kutta 4",
    about: "keeps L in space; accurate, and loses or gains a little energy",
    order: 4,
    order_with_drag: 4,
    evaluation_cost: 6,
    source: "Munthe-Kaas, Runge-Kutta methods on Lie groups (1998)",
    formula: &[
        "du/dt = w + ½ u × w + u × (u × w) / 12, w = I⁻¹ exp(−u) L",
        "one step of RK4 from u = 0, turn by u",
        "L stays in space: ω′ = I⁻¹ exp(−u) L",
    ],
    ..GYRO
};

/// Lie Runge-Kutta 4, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct LieRk4;

impl GyroRule for LieRk4 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let momentum = moments * omega;
        let spin = |u: DVec3| seen_from(turn_by(u), momentum) / moments;
        let k1 = omega;
        let k2 = on_group(h / 2.0 * k1, spin(h / 2.0 * k1));
        let k3 = on_group(h / 2.0 * k2, spin(h / 2.0 * k2));
        let k4 = on_group(h * k3, spin(h * k3));
        Ok(turned(moments, omega, h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)))
    }
}
