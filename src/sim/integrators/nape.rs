//! Nape, whose soft joint is implicit Euler of the tick, after a drag that spares the force.

use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "soft-joint",
    ("frequency", Frequency),
    ("damping", DampingRatio),
    "joint.stiff = false\njoint.frequency = {frequency}\njoint.damping = {damping}\nspace.worldLinearDrag = 0",
)];

pub(super) const CARD: Method = Method {
    id: "engine-nape",
    name: "Nape",
    about: "implicit Euler on a spring; explicit drag, 0.015 unless it is set; x is in pixels; not on the card: it sleeps, \
            where a spring has kept 4 in a million of its swing",
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.05219),
        substeps: Substeps::Ticks(
            "for (let i = 0; i < {n}; i++) space.step(dt / {n}) // step {n} times with dt / {n}",
        ),
        version: "1.0.0 of @newkrok/nape-js",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of @newkrok/nape-js 1.0.0: DistanceJoint with stiff = false, worldLinearDrag",
    formula: &["D = 1 + H c + H² K, v = v (1 − H C) + H f", "v′ = (v − H K x) / D, x′ = x + H v′"],
    ..ENGINE
};

/// Nape, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Nape;

impl EngineRule for Nape {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let (pull, resistance, kept) = (h * set.stiffness, set.resistance(h), 1.0 - h * set.drag);
        each(tick.force, q, v, |x, v, f| {
            *v = (*v * kept + h * f - pull * *x) / resistance;
            *x += h * *v;
        });
    }
}
