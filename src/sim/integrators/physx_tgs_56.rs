//! PhysX 5.6 with its temporal Gauss-Seidel solver.

use super::physx::DRIVES;
use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "engine-physx-tgs-56",
    name: "PhysX 5.6, TGS",
    about: "implicit Euler of a position iteration on a spring; explicit drag, and a force enters once a tick",
    default_substeps: 4,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.01309),
        substeps: Substeps::Iterations,
        // There is no log of a tumbling body in this version.
        version: "5.6.1 in physx-js-webidl 2.7.3",
        logged: Some("2026-11-24"),
        modes: &DRIVES,
        ..BARE
    }),
    source: "PhysX 5.6.1 in physx-js-webidl 2.7.3: the temporal Gauss-Seidel solver, D6 drive, seen in its logs",
    formula: &[
        "v = (v + H f) max(0, 1 − H C), D = 1 + h c + h² K",
        "n times: v = (v − h K x) / D, x = x + h v",
    ],
    ..ENGINE
};

/// PhysX 5.6, TGS, whose tick follows the [formula](Method::formula) on its card. Here `n` counts position iterations.
/// Velocity iterations do not change the motion of one spring.
#[derive(Clone)]
pub struct PhysxTgs56;

impl EngineRule for PhysxTgs56 {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let (pull, resistance) = (h * set.stiffness, set.resistance(h));
        let kept = (1.0 - tick.length * set.drag).max(0.0);
        each(tick.force, q, v, |x, v, f| {
            *v = (*v + tick.length * f) * kept;
            for _ in 0..tick.substeps {
                *v = (*v - pull * *x) / resistance;
                *x += h * *v;
            }
        });
    }
}
