//! A custom force, applied once a tick over an engine's substeps.

use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode("force", "force = -{stiffness} * x - {damping} * v;")];

pub(super) const CARD: Method = Method {
    id: "held-force",
    name: "Held force",
    about: "a custom force, applied once a tick over an engine's substeps: with more than one a spring gains energy, and \
            with each the faster",
    only: Some(Only { needs: Needs::Force, reason: "a follower has no force" }),
    stability_limit: Some(0.0),
    default_substeps: 4,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(-0.01961),
        substeps: Substeps::Own,
        modes: &MODES,
        ..BARE
    }),
    source: "what Box2D, Rapier and Avian do with a force that is applied before the step; Jolt, Bullet and MuJoCo too where \
             they substep",
    formula: &["f = a(t, x, v)", "n times: v = v + h f, x = x + h v"],
    ..ENGINE
};

/// Held force, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct HeldForce;

impl EngineRule for HeldForce {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let h = tick.substep();
        for _ in 0..tick.substeps {
            V::kick_and_drift(h, tick.force, v, h, q);
        }
    }
}
