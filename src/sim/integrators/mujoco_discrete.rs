//! MuJoCo with its discrete integrator, which is implicit in the stiffness too.

use super::joint_mode::JointQuantity::{Damping, Stiffness};
use super::mujoco::reset_if_out_of_range;
use super::prelude::*;

const MODES: [JointMode; 4] = [
    si_mode(
        "joint",
        "<option integrator=\"discrete\"/>\n<joint type=\"slide\" stiffness=\"{stiffness}\" damping=\"{damping}\"/>",
    ),
    mode(
        "actuator",
        ("kp", Stiffness),
        ("kv", Damping),
        "<option integrator=\"discrete\"/>\n<position joint=\"slide\" kp=\"{kp}\" kv=\"{kv}\"/>",
    ),
    newton_mode!("newton-vbd", "SolverVBD"),
    newton_mode!("newton-kamino", "SolverKamino"),
];

pub(super) const CARD: Method = Method {
    id: "engine-mujoco-discrete",
    name: "MuJoCo, discrete",
    also: &["engine-newton-vbd", "engine-newton-kamino"],
    about: "implicit Euler in position and velocity, of joints, tendons and actuators alike; drag is damping of the joint; \
            MuJoCo has it since 3.14",
    engine: Some(Engine {
        tick_hz: 500,
        damping_ratio: Some(0.00628),
        substeps: Substeps::Own,
        version: "4.0.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of MuJoCo 4.0.0: integrator=\"discrete\"",
    formula: &[
        "n times: a = f − K x − (c + C) v",
        "if max(|x|, |v|, |a|) > 10¹⁰: x = 0, v = 0, f = 0",
        "v = (v + h (f − K x)) / (1 + h (c + C) + h² K), x = x + h v",
    ],
    ..ENGINE
};

/// MuJoCo, discrete, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct MujocoDiscrete;

impl EngineRule for MujocoDiscrete {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let resistance = 1.0 + h * (set.damping + set.drag) + h * h * set.stiffness;
        let mut applied = 1.0;
        for _ in 0..tick.substeps {
            if reset_if_out_of_range(set, tick.force, q, v) {
                applied = 0.0;
            }
            each(tick.force, q, v, |x, v, f| {
                *v = (*v + h * (applied * f - set.stiffness * *x)) / resistance;
                *x += h * *v;
            });
        }
    }
}
