//! PhysX 5.1 with its temporal Gauss-Seidel solver.

use super::physx::{DRIVES, FREE_SPIN};
use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "engine-physx-tgs",
    name: "PhysX 5.1, TGS",
    about: "implicit Euler of a position iteration on a spring, and one iteration more that only slows it; explicit drag; \
            5.6 has a card of its own",
    order_with_drag: 0,
    default_substeps: 4,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.01636),
        substeps: Substeps::Iterations,
        free_spin: FREE_SPIN,
        version: "5.1.3",
        logged: Some("2026-11-21"),
        modes: &DRIVES,
        ..BARE
    }),
    source: "PhysX 5.1.3: DyTGSContactPrep.cpp, DyCpuGpu1dConstraint.h",
    formula: &[
        "v = (v + H f) max(0, 1 − H C), d = 0",
        "n times: v = (v − h K (x + d)) / D − E h c d",
        "d = d + h v",
        "then x′ = x + d, v′ = v / D",
        "D = 1 + h c + h² K, E = 1 / (1 + h² (c + K))",
    ],
    ..ENGINE
};

/// The number of velocity iterations.
const VELOCITY_ITERATIONS: u32 = 1;

/// PhysX 5.1, TGS, whose tick follows the [formula](Method::formula) on its card. Here `n` counts position iterations.
#[derive(Clone)]
pub struct PhysxTgs;

impl EngineRule for PhysxTgs {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let (pull, resistance) = (h * set.stiffness, set.resistance(h));
        let bias = h * set.damping / (1.0 + h * h * (set.damping + set.stiffness));
        let kept = (1.0 - tick.length * set.drag).max(0.0);
        if !set.has_spring() {
            return each(tick.force, q, v, |x, v, f| {
                *v = (*v + tick.length * f) * kept;
                *x += tick.length * *v;
            });
        }
        each(tick.force, q, v, |x, v, f| {
            *v = (*v + tick.length * f) * kept;
            let mut moved = 0.0;
            for _ in 0..tick.substeps {
                *v = (*v - pull * (*x + moved)) / resistance - bias * moved;
                moved += h * *v;
            }
            *x += moved;
            for _ in 0..VELOCITY_ITERATIONS {
                *v /= resistance;
            }
        });
    }
}
