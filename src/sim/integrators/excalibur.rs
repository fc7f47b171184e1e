//! Excalibur, which moves a body by its new velocity and by half its acceleration once more.

use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode(
    "force",
    "actor.on('preupdate', () => { actor.acc.x = -({stiffness} * actor.pos.x + {damping} * actor.vel.x) / mass })",
)];

pub(super) const CARD: Method = Method {
    id: "engine-excalibur",
    name: "Excalibur",
    about: "a force of user code, whose way counts it one and a half times; it has neither springs nor drag, which are forces \
            here",
    stability_limit: Some(std::f64::consts::SQRT_2),
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.02621),
        substeps: Substeps::Ticks(
            "new Engine({ fixedUpdateFps: {hz} }) // step {n} times with dt / {n}",
        ),
        version: "0.32.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of Excalibur 0.32.0: MotionSystem",
    formula: &["a = f − K x − (c + C) v", "x′ = x + H v + 1.5 H² a, v′ = v + H a"],
    ..ENGINE
};

/// Excalibur, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Excalibur;

impl EngineRule for Excalibur {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let damping = set.damping + set.drag;
        each(tick.force, q, v, |x, v, f| {
            let a = f - set.stiffness * *x - damping * *v;
            *x += h * *v + 1.5 * h * h * a;
            *v += h * a;
        });
    }
}
