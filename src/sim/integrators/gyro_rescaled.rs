//! An explicit step of the momentum, scaled back to its length.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-rescaled",
    name: "Rescaled momentum",
    about: "keeps |L| and drives every spin to the middle axis: a coin tips over and gains energy",
    order: 1,
    order_with_drag: 1,
    source: "Rapier, Avian since avian#738, Jolt and PhysX where switched on (JoltPhysics#803, 2023)",
    formula: &["M = L − h ω × L", "ω′ = I⁻¹(M |L| / |M|), then turn by h ω′"],
    ..GYRO
};

/// Rescaled momentum, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroRescaled;

impl GyroRule for GyroRescaled {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(SpinMap::ScaledMomentum.turn(moments, omega, h))
    }
}
