//! The implicit midpoint rule on the group of rotations, with the momentum fixed in space.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "lie-midpoint",
    name: "Lie midpoint",
    about: "keeps L in space, and the energy within a bound",
    order: 2,
    order_with_drag: 2,
    reversible: true,
    evaluation_cost: 6,
    source: "Simo & Wong, Unconditionally stable algorithms for rigid body dynamics (1991)",
    formula: &["I m = exp(−½h m) L, turn by h m", "L stays in space: ω′ = I⁻¹ exp(−h m) L"],
    ..GYRO
};

/// Lie midpoint, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct LieMidpoint;

impl GyroRule for LieMidpoint {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let momentum = moments * omega;
        let middle =
            fixed_point(omega, |middle| seen_from(turn_by(h / 2.0 * middle), momentum) / moments)?;
        Ok(turned(moments, omega, h * middle))
    }
}
