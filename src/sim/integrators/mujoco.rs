//! MuJoCo with its Euler integrator, which is implicit in the damping and explicit in the stiffness.

use super::joint_mode::JointQuantity::{Damping, Stiffness};
use super::prelude::*;
use crate::system::EngineSettings;

const MODES: [JointMode; 5] = [
    si_mode("joint", "<joint type=\"slide\" stiffness=\"{stiffness}\" damping=\"{damping}\"/>"),
    mode(
        "actuator",
        ("kp", Stiffness),
        ("kv", Damping),
        "<option integrator=\"implicitfast\"/>\n<position joint=\"slide\" kp=\"{kp}\" kv=\"{kv}\"/>",
    ),
    JointMode {
        is_explicit: true,
        ..mode(
            "actuator-euler",
            ("kp", Stiffness),
            ("kv", Damping),
            "<option integrator=\"Euler\"/>\n<position joint=\"slide\" kp=\"{kp}\" kv=\"{kv}\"/>",
        )
    },
    si_mode(
        "prismatic-spring",
        "joint = plant.AddJoint(PrismaticJoint(name, parent, child, axis, damping={damping}))\nplant.AddForceElement(PrismaticSpring(joint, 0.0, {stiffness}))",
    )
    .of("engine-drake", "1.51.1"),
    newton_mode!("newton-mujoco", "SolverMuJoCo"),
];

pub(super) const CARD: Method = Method {
    id: "engine-mujoco",
    name: "MuJoCo",
    also: &["engine-drake", "engine-newton-mujoco"],
    about: "semi-implicit Euler with implicit damping, which drag is too; the same under its implicit integrators",
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 500,
        damping_ratio: Some(0.0),
        substeps: Substeps::Own,
        bounce: Some(EngineBounce::Mujoco),
        free_spin: Some(FreeSpin {
            opt_in: Some(SpinMap::NewtonStep),
            ..FreeSpin::of(SpinMap::Explicit)
        }),
        version: "4.0.0",
        logged: Some("2026-11-21"),
        modes: &MODES,
    }),
    source: "MuJoCo 4.0.0: engine_forward.c mj_Euler",
    formula: &[
        "n times: a = f − K x − (c + C) v",
        "if max(|x|, |v|, |a|) > 10¹⁰: x = 0, v = 0, f = 0",
        "v = (v + h (f − K x)) / (1 + h (c + C)), x = x + h v",
    ],
    ..ENGINE
};

/// The largest coordinate, velocity or acceleration in SI units. Beyond this value, MuJoCo warns and resets the model.
const MAX_VALUE: f64 = 1e10;

/// Before a step, resets a body with a value out of range to the origin at rest, where the model is defined (`qpos0`).
/// Returns whether it reset the body. With a reset, the force of user code is lost until the next tick.
pub(super) fn reset_if_out_of_range<V: Vector>(
    settings: EngineSettings,
    force: &V,
    q: &mut V,
    v: &mut V,
) -> bool {
    let damping = settings.damping + settings.drag;
    let is_within = |x: f64| x.abs() <= MAX_VALUE;
    let mut moved = q.components().iter().zip(v.components()).zip(force.components());
    let is_sound = moved.all(|((x, v), f)| {
        is_within(*x) && is_within(*v) && is_within(f - settings.stiffness * x - damping * v)
    });
    if !is_sound {
        q.components_mut().fill(0.0);
        v.components_mut().fill(0.0);
    }
    !is_sound
}

/// MuJoCo, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Mujoco;

impl EngineRule for Mujoco {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let resistance = 1.0 + h * (set.damping + set.drag);
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
