//! The implicit midpoint rule on the angular velocity, and the turn of Cayley.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-midpoint",
    name: "Gyroscopic midpoint",
    about: "keeps L in space and the energy to rounding; the phase lags",
    order: 2,
    order_with_drag: 2,
    reversible: true,
    evaluation_cost: 4,
    source: "Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), VII.5; MuJoCo 3.7 to 3.10, Genesis (2026)",
    formula: &[
        "m = ω + ½h a(m), ω′ = 2 m − ω",
        "turn by the quaternion 1 + ½h m, scaled to length 1",
    ],
    ..GYRO
};

/// Gyroscopic midpoint, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroMidpoint;

impl GyroRule for GyroMidpoint {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let middle =
            fixed_point(omega, |middle| omega + h / 2.0 * free_acceleration(moments, middle))?;
        let half = h / 2.0 * middle;
        let turn = DQuat::from_xyzw(half.x, half.y, half.z, 1.0);
        Ok((2.0 * middle - omega, turn * (1.0 / turn.length())))
    }
}
