//! Rapier, with implicit springs in every substep, and the drag once a tick.

use super::joint_mode::JointQuantity::{DampingPerMass, StiffnessPerMass};
use super::prelude::*;

const MODES: [JointMode; 2] = [
    si_mode("force-based", "SpringJointBuilder::new(rest_length, {stiffness}, {damping})"),
    mode(
        "acceleration-based",
        ("stiffness", StiffnessPerMass),
        ("damping", DampingPerMass),
        "SpringJointBuilder::new(rest_length, {stiffness}, {damping})\n    .spring_model(MotorModel::AccelerationBased)",
    ),
];

pub(super) const CARD: Method = Method {
    id: "engine-rapier",
    name: "Rapier",
    about: "implicit Euler of its substep on a spring; the drag comes after the drift, so that a body moves faster than it \
            says",
    default_substeps: 4,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.01309),
        substeps: Substeps::Own,
        bounce: Some(EngineBounce::Soft { threshold: 0.0, is_capped: false }),
        free_spin: Some(FreeSpin::of(SpinMap::ScaledMomentum)),
        version: "0.36.1",
        logged: Some("2026-11-21"),
        modes: &MODES,
    }),
    source: "Rapier 0.36.1: staged_island_solver/worker.rs, motor_model.rs",
    formula: &[
        "D = 1 + h c + h² K",
        "n times: v = (v + h f − h K x) / D, |v| ≤ 400",
        "x = x + h v",
        "then v = v / (1 + H C)",
    ],
    ..ENGINE
};

/// The speed limit of the engine, in metres per second.
const MAX_SPEED: f64 = 400.0;

/// Rapier, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Rapier;

impl EngineRule for Rapier {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let (pull, resistance) = (h * set.stiffness, set.resistance(h));
        let has_spring = set.has_spring();
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v += h * f;
                if has_spring {
                    *v = (*v - pull * *x) / resistance;
                }
            });
            cap(v, MAX_SPEED);
            q.add_scaled(h, v);
        }
        let drag = 1.0 + tick.length * set.drag;
        v.components_mut().iter_mut().for_each(|v| *v /= drag);
    }
}
