//! Phaser's Arcade physics, whose drag acts only where no force does.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "engine-phaser-arcade",
    name: "Phaser Arcade",
    about: "semi-implicit Euler; its damping acts only while the acceleration is 0; not on the card: without useDamping, drag \
            is a constant brake in px/s²",
    only: Some(Only {
        needs: Needs::EngineWithoutJoint,
        reason: "Phaser's Arcade physics has no joint with a spring",
    }),
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 60,
        substeps: Substeps::Ticks("world.setFPS({hz}) // step {n} times with dt / {n}"),
        version: "4.2.1",
        logged: Some("2026-11-27"),
        ..BARE
    }),
    source: "runs of Phaser 4.2.1: World.updateMotion on an Arcade body with useDamping",
    formula: &["if f ≠ 0: v = v + H f", "else: v = v e^(−C H)", "x = x + H v"],
    ..ENGINE
};

/// Phaser Arcade, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct PhaserArcade;

impl EngineRule for PhaserArcade {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let h = tick.length;
        let kept = libm::exp(-tick.settings.drag * h);
        each(tick.force, q, v, |x, v, f| {
            if f == 0.0 {
                *v *= kept;
            } else {
                *v += h * f;
            }
            *x += h * *v;
        });
    }
}
