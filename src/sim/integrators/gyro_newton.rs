//! One Newton step towards implicit Euler on the angular velocity.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-newton",
    name: "Newton gyroscopic step",
    about: "never blows up and loses energy: a wobble dies away and a flip comes late",
    order: 1,
    order_with_drag: 1,
    evaluation_cost: 2,
    source: "Catto, Numerical Methods (2015); Bullet, Box3D, MuJoCo implicit, Avian before avian#738",
    formula: &["J = I + h ([ω] I − [L])", "ω′ = ω − h J⁻¹(ω × L), then turn by h ω′"],
    ..GYRO
};

/// Newton gyroscopic step, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroNewton;

impl GyroRule for GyroNewton {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        Ok(SpinMap::NewtonStep.turn(moments, omega, h))
    }
}
