//! The multibody as which pybullet loads a model by default.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "engine-pybullet",
    name: "pybullet, multibody",
    about: "explicit drag that also grows with the square of the speed, so that a driven body stops gaining early",
    only: Some(Only {
        needs: Needs::EngineWithoutJoint,
        reason: "pybullet's multibody has no joint with a spring",
    }),
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 240,
        substeps: Substeps::Ticks(
            "for _ in range({n}): p.stepSimulation()  # step {n} times with dt / {n}",
        ),
        bounce: Some(EngineBounce::Pybullet),
        version: "3.2.7",
        logged: Some("2026-11-21"),
        ..BARE
    }),
    source: "pybullet 3.2.7: btMultiBody.cpp, its default linear damping",
    formula: &["d = 1 − e^(−C)", "v′ = v + H (f − d v (1 + |v|))", "x′ = x + H v′"],
    ..ENGINE
};

/// pybullet, multibody, whose tick follows the [formula](Method::formula) on its card. It computes d over a whole
/// second, as `1 - e^(-C·1 s)`.
#[derive(Clone)]
pub struct Pybullet;

impl EngineRule for Pybullet {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, d) = (tick.length, -libm::expm1(-tick.settings.drag));
        let square: f64 = v.components().iter().map(|v| v * v).sum();
        let drag = d * (1.0 + square.sqrt());
        each(tick.force, q, v, |x, v, f| {
            *v += h * (f - drag * *v);
            *x += h * *v;
        });
    }
}
