//! Matter.js, whose constraint moves positions in iterations, and remembers a part of the way for the next pass.

use super::joint_mode::JointQuantity::{IterationBrake, IterationPart};
use super::joint_mode::{FULL_DAMPING, FULL_STIFFNESS};
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "constraint",
    ("stiffness", IterationPart),
    ("damping", IterationBrake),
    "// The damping ratio is at least about ω h / 3, whatever is asked; below 60 updates a second it is slower.\nConstraint.create({ pointA, bodyB: body, stiffness: {stiffness}, damping: {damping} }) // of a length above 0\nbody.frictionAir = 0",
)];

pub(super) const CARD: Method = Method {
    id: "engine-matter",
    name: "Matter.js",
    about: "a constraint without newtons, whose passes remember 0.4 of their way: its damping ratio is about ω h / 3 at least; \
            explicit drag, 0.6/s unless it is set; x is in pixels",
    restart: Some("without the way of the pass before"),
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.03494),
        substeps: Substeps::Ticks(
            "for (let i = 0; i < {n}; i++) Engine.update(engine, 1000 * dt / {n}) // step {n} times with dt / {n}",
        ),
        version: "0.20.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of Matter.js 0.20.0: Body.update, Constraint.solveAll with constraintIterations 2",
    formula: &[
        "m = min(1, 60 H), s = min(1, m² K / 24000), d = m c / 240",
        "b = x, x = x + H (v (1 − H C) + H f) + S₋₁, S = S₋₁",
        "b = b + d (x − b), S = S − s x, x = x − s x",
        "b = b + d (x − b), S = 0.4 (S − s x), x = x − s x + S",
        "b = b + d (x − b), S = S − s x, x = x − s x",
        "b = b + d (x − b), S = 0.4 (S − s x), x = x − s x",
        "v = (x − b) / H",
    ],
    ..ENGINE
};

/// The rate in hertz below which a constraint no longer follows the length of the tick.
const FULL_HZ: f64 = 60.0;
/// Passes of the constraints in a tick, and iterations in a pass.
const PASSES: u32 = 2;
const ITERATIONS: u32 = 2;
/// The part of a pass that the next pass starts with.
const KEPT: f64 = 0.4;

/// Matter.js, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Matter;

impl EngineRule for Matter {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        // A frame in which no time passes has no velocity.
        if h == 0.0 {
            return;
        }
        let scale = (FULL_HZ * h).min(1.0);
        let part = (scale * scale * set.stiffness / FULL_STIFFNESS).min(1.0);
        let brake = scale * set.damping / FULL_DAMPING;
        let kept = 1.0 - h * set.drag;
        let memory = tick.carried.expect("its card says how it restarts")[0].components_mut();
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (((x, v), f), way) in moved.zip(tick.force.components()).zip(memory) {
            let mut before = *x;
            *x += h * (*v * kept + h * f);
            for _ in 0..PASSES {
                *x += *way;
                for _ in 0..ITERATIONS {
                    before += brake * (*x - before);
                    let pull = part * *x;
                    *way -= pull;
                    *x -= pull;
                }
                *way *= KEPT;
            }
            *v = (*x - before) / h;
        }
    }
}
