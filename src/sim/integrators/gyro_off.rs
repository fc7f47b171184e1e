//! A spin that keeps its angular velocity, as if the axes were free of the body.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-off",
    name: "No gyroscopic term",
    about: "never flips, wobbles or tips over; an engine that leaves out the gyroscopic term",
    order: 0,
    order_with_drag: 0,
    source: "the default of Jolt and PhysX; Godot 4.3 (2024), godotengine/godot#50173",
    formula: &["ω′ = ω, then turn by h ω′"],
    ..GYRO
};

/// No gyroscopic term, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroOff;

impl GyroRule for GyroOff {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(SpinMap::Constant.turn(moments, omega, h))
    }
}
