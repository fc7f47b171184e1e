//! Avian's distance joint, which is XPBD with explicit damping.

use super::joint_mode::JointQuantity::{Compliance, DampingPerMass};
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "distance-joint",
    ("compliance", Compliance),
    ("linear", DampingPerMass),
    "DistanceJoint::new(anchor, body).with_compliance({compliance}),\nJointDamping { linear: {linear}, angular: 0.0 },",
)];

pub(super) const CARD: Method = Method {
    id: "engine-avian",
    name: "Avian",
    about: "implicit Euler of its substep on a spring without damping; the joint's damping is explicit; ticks of whole \
            nanoseconds",
    default_substeps: 6,
    engine: Some(Engine {
        tick_hz: 64,
        damping_ratio: Some(0.00818),
        substeps: Substeps::Own,
        version: "0.8.0",
        logged: Some("2026-11-22"),
        modes: &MODES,
        ..BARE
    }),
    source: "Avian 0.8.0: integrator/mod.rs, xpbd/plugin.rs, solver/plugin.rs joint_damping",
    formula: &[
        "h = ns(ns(H) / n): whole nanoseconds",
        "n times: v = v / (1 + h C) + h f, x = x + h v",
        "d = −x h² K / (1 + h² K), x = x + d",
        "v = (v + d / h) max(0, 1 − h c)",
    ],
    ..ENGINE
};

/// Avian, which makes a tick by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Avian;

/// Returns the substep, in seconds, of a tick of `length` (s). Tick and substep are rounded to whole nanoseconds, with
/// halves rounded down.
#[inline]
pub(super) fn substep(length: f64, substeps: u32) -> f64 {
    let whole = |ns: f64| libm::ceil(ns - 0.5);
    whole(whole(length * 1e9) / f64::from(substeps)) / 1e9
}

impl EngineRule for Avian {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (substep(tick.length, tick.substeps), tick.settings);
        let (drag, stiff) = (1.0 + h * set.drag, h * h * set.stiffness);
        let kept = 1.0 - (h * set.damping).min(1.0);
        let has_spring = set.has_spring();
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v = *v / drag + h * f;
                *x += h * *v;
                if has_spring {
                    let correction = -*x * stiff / (1.0 + stiff);
                    *x += correction;
                    *v += correction / h;
                    *v *= kept;
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::substep;

    #[test]
    fn ticks_and_substeps_are_whole_nanoseconds_with_halves_rounded_down() {
        assert_eq!(substep(1.0 / 60.0, 1), 16_666_667e-9);
        assert_eq!(substep(1.0 / 60.0, 6), 2_777_778e-9);
        assert_eq!(substep(1.0 / 64.0, 6), 2_604_167e-9);
        // The exact substep is half a nanosecond above 7.
        assert_eq!(substep(15e-9, 2), 7e-9);
    }
}
