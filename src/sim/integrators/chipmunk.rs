//! Chipmunk, in which the drift comes before the kick.

use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode(
    "damped-spring",
    "cpDampedSpringNew(anchor, body, cpvzero, cpvzero, restLength, {stiffness}, {damping});",
)];

pub(super) const CARD: Method = Method {
    id: "engine-chipmunk",
    name: "Chipmunk",
    about: "semi-implicit Euler on a spring, the drift first; a custom force is explicit Euler",
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.0),
        substeps: Substeps::Ticks(
            "for (int i = 0; i < {n}; i++) cpSpaceStep(space, dt / {n}); // step {n} times with dt / {n}",
        ),
        bounce: Some(EngineBounce::Chipmunk),
        version: "2.0.1 in pymunk 7.3.1",
        logged: Some("2026-11-21"),
        modes: &MODES,
        ..BARE
    }),
    source: "Chipmunk 2.0.1 in pymunk 7.3.1: cpBodyUpdatePosition, cpBodyUpdateVelocity, cpDampedSpring.c",
    formula: &["x′ = x + H v", "v′ = ((v − H K x′) e^(−C H) + H f) e^(−c H)"],
    ..ENGINE
};

/// Chipmunk, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Chipmunk;

impl EngineRule for Chipmunk {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let (kept, damped) = (libm::exp(-set.drag * h), libm::exp(-set.damping * h));
        each(tick.force, q, v, |x, v, f| {
            *x += h * *v;
            *v -= h * set.stiffness * *x;
            *v = *v * kept + h * f;
            *v *= damped;
        });
    }
}
