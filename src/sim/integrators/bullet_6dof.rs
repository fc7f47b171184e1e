//! Bullet's older spring constraint, a motor whose push is limited to that of the spring.

use super::joint_mode::JointQuantity::{MotorDamping, Stiffness};
use super::joint_mode::MOTOR_LOSS;
use super::prelude::*;

const MODES: [JointMode; 1] = [mode(
    "6dof-spring",
    ("stiffness", Stiffness),
    ("damping", MotorDamping),
    "// btGeneric6DofSpringConstraint, with 10 solver iterations: more damping damps less, and 0 never moves.\nspring->enableSpring(axis, true);\nspring->setStiffness(axis, {stiffness});\nspring->setDamping(axis, {damping});",
)
.usually(1.0)];

pub(super) const CARD: Method = Method {
    id: "engine-bullet-6dof",
    name: "Bullet, btGeneric6DofSpringConstraint",
    about: "semi-implicit Euler on a spring until a motor to the rest, of at most the spring's push, brakes it: more damping \
            damps less, and the damping changes with the tick rate",
    order_with_drag: 0,
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        damping_ratio: Some(0.0),
        version: "0.0.11 of ammojs3, and of ammo.js 0.0.10",
        logged: Some("2026-11-27"),
        modes: &MODES,
        ..BARE
    }),
    source: "runs of ammo.js 0.0.10 and ammojs3 0.0.11: btGeneric6DofSpringConstraint internalUpdateSprings",
    formula: &[
        "n times: v = v e^(−C h) + h f",
        "m = h K |x|, p = −h K x",
        "if c > 0: p = min(max(−√(K √(K) / (56.5 c)) x / (10 h) − v, −m), m)",
        "v = v + p, x = x + h v",
    ],
    ..ENGINE
};

/// Iterations of the solver, by which the constraint divides the speed of its motor.
const ITERATIONS: f64 = 10.0;

/// Bullet's older spring, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Bullet6dof;

impl EngineRule for Bullet6dof {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let kept = libm::exp(-set.drag * h);
        // The speed at which the motor drives the body to its rest, for each metre from it.
        let drive = (set.damping > 0.0 && h > 0.0).then(|| {
            let square = set.stiffness * set.stiffness.sqrt() / (MOTOR_LOSS * set.damping);
            square.sqrt() / (ITERATIONS * h)
        });
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v = *v * kept + h * f;
                let most = h * set.stiffness * x.abs();
                *v += match drive {
                    Some(drive) => (-drive * *x - *v).max(-most).min(most),
                    None => -h * set.stiffness * *x,
                };
                *x += h * *v;
            });
        }
    }
}
