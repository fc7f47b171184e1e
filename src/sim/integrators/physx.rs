//! PhysX with its default solver, projected Gauss-Seidel.

use super::joint_mode::JointQuantity::{Damping, DampingPerMass, Stiffness, StiffnessPerMass};
use super::prelude::*;

pub(super) const FREE_SPIN: Option<FreeSpin> = Some(FreeSpin {
    default: SpinMap::Constant,
    opt_in: Some(SpinMap::ScaledMomentum),
    is_once_a_tick: true,
});

/// The drives of PhysX itself, under any of its solvers.
pub(super) const DRIVES: [JointMode; 2] = [
    si_mode(
        "force-drive",
        "joint->setDrive(PxD6Drive::eX, PxD6JointDrive({stiffness}f, {damping}f, PX_MAX_F32, false));\nbody->setLinearDamping(0.0f);",
    ),
    mode(
        "acceleration-drive",
        ("stiffness", StiffnessPerMass),
        ("damping", DampingPerMass),
        "joint->setDrive(PxD6Drive::eX, PxD6JointDrive({stiffness}f, {damping}f, PX_MAX_F32, true));\nbody->setLinearDamping(0.0f);",
    ),
];

const MODES: [JointMode; 3] = [
    DRIVES[0],
    DRIVES[1],
    mode(
        "unity",
        ("positionSpring", Stiffness),
        ("positionDamper", Damping),
        "JointDrive drive = joint.xDrive;\ndrive.positionSpring = {positionSpring}f;\ndrive.positionDamper = {positionDamper}f;\njoint.xDrive = drive;\nbody.linearDamping = 0f;",
    ),
];

pub(super) const CARD: Method = Method {
    id: "engine-physx",
    name: "PhysX, PGS",
    about: "implicit Euler of the whole tick on a spring: its position iterations do not change a single joint; explicit drag",
    default_substeps: 4,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.05219),
        substeps: Substeps::Iterations,
        free_spin: FREE_SPIN,
        version: "5.1.3",
        logged: Some("2026-11-21"),
        modes: &MODES,
        ..BARE
    }),
    source: "PhysX 5.1.3: the projected Gauss-Seidel solver, D6 drive and distance joint",
    formula: &[
        "v = (v + H f) max(0, 1 − H C)",
        "v′ = (v − H K x) / D, x′ = x + H v′",
        "D = 1 + H c + H² K",
    ],
    ..ENGINE
};

/// PhysX, PGS, whose tick follows the [formula](Method::formula) on its card. The substeps are position iterations,
/// which do not change the motion of a single joint.
#[derive(Clone)]
pub struct Physx;

impl EngineRule for Physx {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let (pull, resistance) = (h * set.stiffness, set.resistance(h));
        let kept = (1.0 - h * set.drag).max(0.0);
        let has_spring = set.has_spring();
        each(tick.force, q, v, |x, v, f| {
            *v = (*v + h * f) * kept;
            if has_spring {
                *v = (*v - pull * *x) / resistance;
            }
            *x += h * *v;
        });
    }
}
