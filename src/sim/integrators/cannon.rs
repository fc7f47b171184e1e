//! Cannon-es and p2-es, whose springs are forces of the tick's start.

use super::joint_mode::JointQuantity::{NonzeroDamping, Stiffness};
use super::prelude::*;

const MODES: [JointMode; 6] = [
    mode(
        "spring",
        ("stiffness", Stiffness),
        ("damping", NonzeroDamping),
        "// A damping of 0 would count as 1.\nconst spring = new CANNON.Spring(a, b, { stiffness: {stiffness}, damping: {damping} })\nspring.applyForce() // postStep comes after a step: without this, the first has no force\nworld.addEventListener('postStep', () => spring.applyForce())\nbody.linearDamping = 0",
    )
    .usually(1.0),
    si_mode(
        "linear-spring",
        "world.addSpring(new p2.LinearSpring(a, b, { stiffness: {stiffness}, damping: {damping} }))\nbody.damping = 0",
    )
    .usually(1.0)
    .of("engine-p2", "1.2.3 of p2-es"),
    si_mode(
        "prismatic-spring",
        "plant.set_discrete_contact_approximation(DiscreteContactApproximation.kTamsi)\njoint = plant.AddJoint(PrismaticJoint(name, parent, child, axis, damping={damping}))\nplant.AddForceElement(PrismaticSpring(joint, 0.0, {stiffness}))",
    )
    .of("engine-drake-tamsi", "1.51.1"),
    si_mode(
        "generalized",
        "<!-- brax.generalized; under brax.spring and brax.positional neither has an effect -->\n<joint type=\"slide\" stiffness=\"{stiffness}\" damping=\"{damping}\"/>",
    )
    .unlogged_of("engine-brax", "0.14.2"),
    newton_mode!("newton-featherstone", "SolverFeatherstone"),
    newton_mode!("newton-semi-implicit", "SolverSemiImplicit"),
];

pub(super) const CARD: Method = Method {
    id: "engine-cannon",
    name: "cannon-es",
    also: &[
        "engine-p2",
        "engine-drake-tamsi",
        "engine-brax",
        "engine-newton-featherstone",
        "engine-newton-semi-implicit",
    ],
    about: "semi-implicit Euler, whose drag spares the force; cannon-es takes a spring's damping of 0 as 1, and p2-es keeps \
            its numbers in single precision",
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.0),
        substeps: Substeps::Ticks(
            "for (let i = 0; i < {n}; i++) world.step(dt / {n}) // step {n} times with dt / {n}",
        ),
        bounce: Some(EngineBounce::Cannon),
        version: "0.20.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of cannon-es 0.20.0 and p2-es 1.2.3: Spring, linearDamping; Newton 1.8.0, Drake 1.51.1 with TAMSI \
             and Brax 0.14.2 generalized, without drag",
    formula: &["a = f − K x − c v", "v′ = v e^(−C H) + H a, x′ = x + H v′"],
    ..ENGINE
};

/// cannon-es, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Cannon;

impl EngineRule for Cannon {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let kept = libm::exp(-set.drag * h);
        each(tick.force, q, v, |x, v, f| {
            let a = f - set.stiffness * *x - set.damping * *v;
            *v = *v * kept + h * a;
            *x += h * *v;
        });
    }
}
