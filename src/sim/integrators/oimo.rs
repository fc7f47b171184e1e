//! OimoPhysics, whose spring is implicit Euler of the tick, and its drag nearly an exponential.

use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "spring-damper",
    ("frequency", Frequency),
    ("dampingRatio", DampingRatio),
    "new SpringDamper().setSpring({frequency}, {dampingRatio})\nbody.setLinearDamping(0)\nbody.setAutoSleep(false)",
)];

pub(super) const OIMO: Engine = Engine {
    tick_hz: 60,
    damping_ratio: Some(0.05219),
    substeps: Substeps::Ticks(
        "for (let i = 0; i < {n}; i++) world.step(dt / {n}) // step {n} times with dt / {n}",
    ),
    version: "1.2.2 of oimophysics, and 1.0.9 of oimo",
    logged: Some("2026-11-27"),
    modes: &MODES,
    ..BARE
};

pub(super) const CARD: Method = Method {
    id: "engine-oimo",
    name: "OimoPhysics",
    also: &["engine-oimophysics"],
    about: "implicit Euler on a spring, whose damping ratio is 1e-6 at least; at most 20 m a tick; oimo 1.0.9 has the same \
            spring, no drag, and a sleep that ends a swing early",
    engine: Some(OIMO),
    source: "runs of oimophysics 1.2.2 and oimo 1.0.9: SpringDamper, linearDamping",
    formula: &[
        "d = H C, E = 1 + d (1 + d (1 + d (1 + d / 4) / 3) / 2)",
        "D = 1 + H c + H² K",
        "v = ((v + H f) / E − H K x) / D, |v| ≤ 20 / H",
        "x = x + H v",
    ],
    ..ENGINE
};

/// The longest way of a tick, in metres.
const MAX_WAY: f64 = 20.0;

/// OimoPhysics, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Oimo;

impl EngineRule for Oimo {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let resistance = tick.settings.resistance(tick.length);
        advance(tick, resistance, q, v);
    }
}

/// Advances by a tick of a spring that the solver divides by this resistance.
pub(super) fn advance<V: Vector>(tick: EngineTick<'_, V>, resistance: f64, q: &mut V, v: &mut V) {
    let h = tick.length;
    let (pull, d) = (h * tick.settings.stiffness, h * tick.settings.drag);
    let drag = 1.0 + d * (1.0 + d * (1.0 + d * (1.0 + d / 4.0) / 3.0) / 2.0);
    each(tick.force, q, v, |x, v, f| *v = ((*v + h * f) / drag - pull * *x) / resistance);
    cap(v, MAX_WAY / h);
    q.add_scaled(h, v);
}
