//! Newton's XPBD solver, whose relaxed iterations each push a drive as if it were new.

use super::prelude::*;

const MODES: [JointMode; 1] =
    [JointMode { engine: None, ..newton_mode!("newton-xpbd", "SolverXPBD") }];

pub(super) const CARD: Method = Method {
    id: "engine-newton-xpbd",
    name: "Newton, XPBD",
    about: "seven tenths of an implicit Euler step in each of its iterations, which are 2: a drive is 0.7 times their number as \
            stiff and as damped as asked; Newton has no linear drag",
    caveat: "more iterations make a drive stiffer without a bound: set it at the number that the game runs",
    order: 0,
    order_with_drag: 0,
    default_substeps: 2,
    engine: Some(Engine {
        damping_ratio: Some(0.06169),
        substeps: Substeps::Iterations,
        version: "1.8.0",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of Newton 1.8.0: SolverXPBD with 2 iterations and a joint_linear_relaxation of 0.7",
    formula: &[
        "D = 1 + H c + H² K, v = v e^(−C H) + H f, x = x + H v",
        "n times: p = −0.7 H (K x + c v) / D",
        "v = v + p, x = x + H p",
    ],
    ..ENGINE
};

/// The part of a correction that an iteration makes.
const RELAXATION: f64 = 0.7;

/// Newton's XPBD solver, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct NewtonXpbd;

impl EngineRule for NewtonXpbd {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.length, tick.settings);
        let kept = libm::exp(-set.drag * h);
        let part = -RELAXATION * h / (1.0 + h * set.damping + h * h * set.stiffness);
        each(tick.force, q, v, |x, v, f| {
            *v = *v * kept + h * f;
            *x += h * *v;
            for _ in 0..tick.substeps {
                let push = part * (set.stiffness * *x + set.damping * *v);
                *v += push;
                *x += h * push;
            }
        });
    }
}
