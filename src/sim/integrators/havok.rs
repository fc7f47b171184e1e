//! Havok, with four explicit substeps of a motor whose damping has a floor, and the drag after them.

use super::joint_mode::JointQuantity::{DampingPerMass, Stiffness, StiffnessPerMass, Undamped};
use super::prelude::*;

const MODES: [JointMode; 3] = [
    si_mode(
        "motor-force",
        "HP_Constraint_SetAxisMotorType(joint, axis, ConstraintMotorType.SPRING_FORCE)\nHP_Constraint_SetAxisMotorStiffness(joint, axis, {stiffness})\nHP_Constraint_SetAxisMotorDamping(joint, axis, {damping})\nHP_Body_SetLinearDamping(body, 0)",
    ),
    mode(
        "motor-acceleration",
        ("stiffness", StiffnessPerMass),
        ("damping", DampingPerMass),
        "HP_Constraint_SetAxisMotorType(joint, axis, ConstraintMotorType.SPRING_ACCELERATION)\nHP_Constraint_SetAxisMotorStiffness(joint, axis, {stiffness})\nHP_Constraint_SetAxisMotorDamping(joint, axis, {damping})\nHP_Body_SetLinearDamping(body, 0)",
    ),
    JointMode {
        is_explicit: true,
        ..mode(
            "limit",
            ("stiffness", Stiffness),
            ("damping", Undamped),
            "// So with a damping of 0 only: with more, the limit is not linear.\nHP_Constraint_SetAxisStiffness(joint, axis, {stiffness})\nHP_Constraint_SetAxisDamping(joint, axis, {damping})",
        )
    },
];

pub(super) const CARD: Method = Method {
    id: "engine-havok",
    name: "Havok",
    about: "semi-implicit Euler in 4 substeps with a floor under a motor's damping; the drag comes last; not on the card: a body \
            below 0.1 m/s is braked by 0.305 m/s² until it stands",
    default_substeps: 4,
    stability_limit: Some(4.6188),
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.01309),
        substeps: Substeps::Own,
        version: "1.3.14 of @babylonjs/havok",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of @babylonjs/havok 1.3.14: motors SPRING_FORCE and SPRING_ACCELERATION, limits, linear damping",
    formula: &[
        "r = max(c, h K)",
        "n times: v = v + h f − h (K x + r v), x = x + h v",
        "then v = v (1 − H C)",
    ],
    ..ENGINE
};

/// Havok, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Havok;

impl EngineRule for Havok {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let damping = set.damping.max(h * set.stiffness);
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v += h * f - h * (set.stiffness * *x + damping * *v);
                *x += h * *v;
            });
        }
        let kept = 1.0 - tick.length * set.drag;
        v.components_mut().iter_mut().for_each(|v| *v *= kept);
    }
}
