//! OimoPhysics with its symplectic spring, which is explicit in the stiffness.

use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::oimo;
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "symplectic-spring-damper",
    ("frequency", Frequency),
    ("dampingRatio", DampingRatio),
    "new SpringDamper().setSpring({frequency}, {dampingRatio}).setSymplecticEuler(true)\nbody.setLinearDamping(0)\nbody.setAutoSleep(false)",
)];

pub(super) const CARD: Method = Method {
    id: "engine-oimo-symplectic",
    name: "OimoPhysics, symplectic",
    also: &[],
    about: "semi-implicit Euler with implicit damping on a spring, whose damping ratio is 1e-6 at least; with h ω above 2 it leaps \
            20 m a tick",
    symplectic: true,
    engine: Some(Engine { damping_ratio: Some(0.0), modes: &MODES, ..oimo::OIMO }),
    formula: &[
        "d = H C, E = 1 + d (1 + d (1 + d (1 + d / 4) / 3) / 2)",
        "v = ((v + H f) / E − H K x) / (1 + H c), |v| ≤ 20 / H",
        "x = x + H v",
    ],
    ..oimo::CARD
};

/// OimoPhysics, symplectic, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct OimoSymplectic;

impl EngineRule for OimoSymplectic {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let resistance = 1.0 + tick.length * tick.settings.damping;
        oimo::advance(tick, resistance, q, v);
    }
}
