//! The discrete top of Moser and Veselov, which keeps all that the top keeps.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "moser-veselov",
    name: "Moser-Veselov",
    about: "keeps L in space and the energy to rounding; the phase runs ahead",
    order: 2,
    order_with_drag: 2,
    reversible: true,
    evaluation_cost: 4,
    source: "Moser & Veselov, Discrete versions of some classical integrable systems (1991)",
    formula: &["h L = 2 (r₀ I r + r × I r), r₀² + |r|² = 1", "turn by the quaternion r₀ + r"],
    ..GYRO
};

/// Moser-Veselov, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct MoserVeselov;

impl GyroRule for MoserVeselov {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let half = h / 2.0 * (moments * omega);
        let r = fixed_point(h / 2.0 * omega, |r| {
            (half - r.cross(moments * r)) / (1.0 - r.length_squared()).sqrt() / moments
        })?;
        let turn = DQuat::from_xyzw(r.x, r.y, r.z, (1.0 - r.length_squared()).sqrt());
        Ok(carried(moments, omega, turn * (1.0 / turn.length())))
    }
}
