//! Avian's motor as a spring. It is implicit, and adds the corrections of a tick to the velocity of the next tick.

use super::avian::substep;
use super::joint_mode::JointQuantity::{DampingRatio, Frequency};
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "spring-damper",
    ("frequency", Frequency),
    ("damping_ratio", DampingRatio),
    "LinearMotor::new(MotorModel::SpringDamper {\n    frequency: {frequency},\n    damping_ratio: {damping_ratio},\n})",
)];

pub(super) const CARD: Method = Method {
    id: "engine-avian-motor",
    name: "Avian, motor",
    about: "Avian's spring-damper motor: its damping is implicit, but a tick's corrections in metres are added to the next \
            tick's velocity",
    restart: Some("without corrections of the tick before"),
    default_substeps: 6,
    engine: Some(Engine {
        tick_hz: 64,
        damping_ratio: Some(0.00813),
        substeps: Substeps::Own,
        version: "0.8.0",
        logged: Some("2026-11-22"),
        modes: &MODES,
        ..BARE
    }),
    source: "Avian 0.8.0: integrator/mod.rs, xpbd/plugin.rs, xpbd/joints/prismatic.rs",
    formula: &[
        "h = ns(ns(H) / n): whole nanoseconds",
        "D = 1 + h c + h² K, S = 0",
        "n times: v = v / (1 + h C) + h f",
        "the first time: v = v + S₋₁",
        "x = x + h v, d = −h² (K x + c v) / D",
        "x = x + d, v = v + d / h, S = S + d",
    ],
    ..ENGINE
};

/// Avian, motor, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct AvianMotor;

impl EngineRule for AvianMotor {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (substep(tick.length, tick.substeps), tick.settings);
        let (drag, resistance) = (1.0 + h * set.drag, set.resistance(h));
        let has_spring = set.has_spring();
        let sums = tick.carried.expect("its card says how it restarts")[0].components_mut();
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (((x, v), f), sum) in moved.zip(tick.force.components()).zip(sums) {
            let before = std::mem::take(sum);
            for i in 0..tick.substeps {
                *v = *v / drag + h * f;
                if i == 0 {
                    *v += before;
                }
                *x += h * *v;
                if has_spring {
                    let correction = -h * h * (set.stiffness * *x + set.damping * *v) / resistance;
                    *x += correction;
                    *v += correction / h;
                    *sum += correction;
                }
            }
        }
    }
}
