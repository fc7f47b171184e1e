//! Jolt, which makes one implicit solve per substep, after the drag and the speed limit.

use super::joint_mode::JointQuantity::{Damping, DampingRatio, Frequency, Stiffness};
use super::prelude::*;

const MODES: [JointMode; 3] = [
    mode(
        "frequency-and-damping",
        ("mFrequency", Frequency),
        ("mDamping", DampingRatio),
        "settings.mLimitsSpringSettings =\n    SpringSettings(ESpringMode::FrequencyAndDamping, {mFrequency}f, {mDamping}f);\nbodySettings.mLinearDamping = 0.0f;",
    ),
    mode(
        "stiffness-and-damping",
        ("mStiffness", Stiffness),
        ("mDamping", Damping),
        "settings.mLimitsSpringSettings =\n    SpringSettings(ESpringMode::StiffnessAndDamping, {mStiffness}f, {mDamping}f);\nbodySettings.mLinearDamping = 0.0f;",
    ),
    mode(
        "crashcat-spring",
        ("frequencyOrStiffness", Frequency),
        ("damping", DampingRatio),
        "springSettings: { mode: SpringMode.FREQUENCY_AND_DAMPING, frequencyOrStiffness: {frequencyOrStiffness}, damping: {damping} }\nlinearDamping: 0",
    )
    .of("engine-crashcat", "0.0.5"),
];

pub(super) const CARD: Method = Method {
    id: "engine-jolt",
    name: "Jolt",
    also: &["engine-crashcat"],
    about: "implicit Euler on a spring; explicit drag; a body has a drag of 0.05 unless it is set to another",
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.05219),
        substeps: Substeps::Own,
        bounce: Some(EngineBounce::Jolt),
        free_spin: Some(FreeSpin {
            opt_in: Some(SpinMap::ScaledMomentum),
            ..FreeSpin::of(SpinMap::Constant)
        }),
        version: "5.5.1 main 3b47ec3",
        logged: Some("2026-11-21"),
        modes: &MODES,
    }),
    source: "Jolt 5.5.1 main 3b47ec3: MotionProperties.inl ApplyForceTorqueAndDragInternal, SpringPart.h",
    formula: &[
        "D = 1 + h c + h² K",
        "n times: v = (v + h f) max(0, 1 − h C), |v| ≤ 500",
        "v = (v − h K x) / D, x = x + h v",
    ],
    ..ENGINE
};

/// The speed limit of the engine, in metres per second.
const MAX_SPEED: f64 = 500.0;

/// Jolt, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Jolt;

impl EngineRule for Jolt {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let (pull, resistance) = (h * set.stiffness, set.resistance(h));
        let kept = (1.0 - h * set.drag).max(0.0);
        let has_spring = set.has_spring();
        for _ in 0..tick.substeps {
            v.add_scaled(h, tick.force);
            v.components_mut().iter_mut().for_each(|v| *v *= kept);
            cap(v, MAX_SPEED);
            each(tick.force, q, v, |x, v, _| {
                if has_spring {
                    *v = (*v - pull * *x) / resistance;
                }
                *x += h * *v;
            });
        }
    }
}
