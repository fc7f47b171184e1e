//! Box2D, which solves the soft joint twice in every substep.

use super::card;
use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::prelude::*;

const fn spring(id: &'static str) -> JointMode {
    mode(
        id,
        ("hertz", Frequency),
        ("dampingRatio", DampingRatio),
        "def.enableSpring = true;\ndef.hertz = {hertz};\ndef.dampingRatio = {dampingRatio};\nbodyDef.linearDamping = 0.0;",
    )
}

pub(super) const OWN: [JointMode; 1] = [spring("spring")];
const MODES: [JointMode; 2] =
    [OWN[0], spring("phaser-box2d").unlogged_of("engine-phaser-box2d", "1.1.0")];

pub(super) const ENGINE: Engine = Engine {
    tick_hz: 60,
    damping_ratio: Some(0.02617),
    substeps: Substeps::Own,
    bounce: Some(EngineBounce::Soft { threshold: 1.0, is_capped: true }),
    version: "3.x main 617d32a",
    logged: Some("2026-11-21"),
    modes: &MODES,
    ..BARE
};

pub(super) const CARD: Method = Method {
    id: "engine-box2d",
    name: "Box2D",
    also: &["engine-phaser-box2d"],
    about: "its spring is solved twice a substep and loses energy twice as fast as implicit Euler at that step",
    default_substeps: 4,
    engine: Some(ENGINE),
    source: "Box2D 3.x main 617d32a: solver.c b2IntegrateVelocitiesTask, b2IntegratePositionsTask; solver.h b2MakeSoft; \
             distance_joint.c",
    formula: &[
        "D = 1 + h c + h² K",
        "n times: p = v / (1 + h C) + h f",
        "v = (p − h K x) / D, |v| ≤ 400, x = x + h v",
        "v = (p − h K x) / D",
    ],
    ..card::ENGINE
};

/// The speed limit of the engine, in metres per second.
const MAX_SPEED: f64 = 400.0;

/// Box2D, whose tick follows the [formula](Method::formula) on its card. The second solve starts from `p` again.
#[derive(Clone)]
pub struct Box2d;

impl EngineRule for Box2d {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let (drag, pull, resistance) = (1.0 + h * set.drag, h * set.stiffness, set.resistance(h));
        let has_spring = set.has_spring();
        let pushed = |v: f64, f: f64| v / drag + h * f;
        let solved = |p: f64, x: f64| if has_spring { (p - pull * x) / resistance } else { p };
        for _ in 0..tick.substeps {
            let known = q.components().iter().zip(v.components()).zip(tick.force.components());
            let first = known.map(|((x, v), f)| solved(pushed(*v, *f), *x));
            let part = part_below(MAX_SPEED, first);
            each(tick.force, q, v, |x, v, f| {
                let p = pushed(*v, f);
                *v = solved(p, *x) * part;
                *x += h * *v;
                if has_spring {
                    *v = solved(p, *x);
                }
            });
        }
    }
}
