//! Godot's own 2D physics.

use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode(
    "damped-spring-joint-2d",
    "joint.stiffness = {stiffness}\njoint.damping = {damping}\nbody.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE\nbody.linear_damp = 0.0",
)];

pub(super) const CARD: Method = Method {
    id: "engine-godot",
    name: "Godot",
    about: "semi-implicit Euler on a spring, whose damping acts eight times; explicit drag, 0.1 unless it is set; read from \
            the source, and not held against a log",
    order_with_drag: 0,
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.0),
        substeps: Substeps::Ticks(
            "Engine.physics_ticks_per_second = {hz} # step {n} times with dt / {n}: Godot has no substeps, and whole ticks",
        ),
        // This is the map of Godot's bodies in space.
        free_spin: Some(FreeSpin::of(SpinMap::Constant)),
        version: "4.x",
        modes: &MODES,
        ..BARE
    }),
    source: "Godot 4.x: godot_body_2d.cpp, godot_joints_2d.cpp GodotDampedSpringJoint2D",
    formula: &["v = v max(0, 1 − H C) + H f − H K x", "v′ = v e^(−8 c H), x′ = x + H v′"],
    ..ENGINE
};

/// How many times per tick the damping of a spring acts, which is in every other one of 16 iterations.
const DAMPINGS: u32 = 8;

/// Godot, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Godot;

impl EngineRule for Godot {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let (kept, damped) = ((1.0 - h * set.drag).max(0.0), libm::exp(-set.damping * h));
        each(tick.force, q, v, |x, v, f| {
            *v = *v * kept + h * f;
            *v -= h * set.stiffness * *x;
            for _ in 0..DAMPINGS {
                *v *= damped;
            }
            *x += h * *v;
        });
    }
}
