//! Box2D 2, whose soft joint is implicit Euler of the whole tick.

use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::prelude::*;

const MODES: [JointMode; 2] = [
    mode(
        "frequency-and-damping-ratio",
        ("frequencyHz", Frequency),
        ("dampingRatio", DampingRatio),
        "new DistanceJoint({ frequencyHz: {frequencyHz}, dampingRatio: {dampingRatio} }, a, b, p, q)\nbody.setLinearDamping(0)",
    )
    .of("engine-planck", "1.5.0"),
    si_mode(
        "stiffness-and-damping",
        "def.stiffness = {stiffness}f;\ndef.damping = {damping}f;\nbodyDef.linearDamping = 0.0f;",
    ),
];

pub(super) const CARD: Method = Method {
    id: "engine-box2d-2",
    name: "Box2D 2",
    also: &["engine-planck"],
    about: "implicit Euler of the whole tick on a spring, implicit drag, at most 2 m a tick; in Planck, LÖVE and libGDX too",
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.05219),
        substeps: Substeps::Ticks(
            "for (int i = 0; i < {n}; i++) world.Step(dt / {n}, 8, 3); // step {n} times with dt / {n}",
        ),
        version: "2.4 in box2d-wasm 7.0.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of box2d-wasm 7.0.0 and planck 1.5.0: DistanceJoint, linearDamping",
    formula: &[
        "v = (v + H f) / (1 + H C), D = 1 + H c + H² K",
        "v = (v − H K x) / D, |v| ≤ 2 / H",
        "x = x + H v",
    ],
    ..ENGINE
};

/// The longest way of a tick, in metres.
const MAX_WAY: f64 = 2.0;

/// Box2D 2, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Box2dV2;

impl EngineRule for Box2dV2 {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let (pull, resistance, drag) = (h * set.stiffness, set.resistance(h), 1.0 + h * set.drag);
        each(tick.force, q, v, |x, v, f| *v = ((*v + h * f) / drag - pull * *x) / resistance);
        cap(v, MAX_WAY / h);
        q.add_scaled(h, v);
    }
}
