//! Bullet, with an explicit spring whose stiffness and damping are limited for the step.

use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode(
    "6dof-spring",
    "// btGeneric6DofSpring2Constraint; the class without the 2, as in ammo.js, is engine-bullet-6dof.\nspring->enableSpring(axis, true);\nspring->setStiffness(axis, {stiffness});\nspring->setDamping(axis, {damping});",
)];

pub(super) const CARD: Method = Method {
    id: "engine-bullet",
    name: "Bullet",
    about: "semi-implicit Euler on a spring, which is softened to turn a quarter radian a substep; a force that pulls with it counts \
            only where it is the larger",
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 60,
        damping_ratio: Some(0.0),
        substeps: Substeps::Own,
        free_spin: Some(FreeSpin::of(SpinMap::NewtonStep)),
        version: "3 main 6c888f4",
        logged: Some("2026-11-21"),
        modes: &MODES,
        ..BARE
    }),
    source: "Bullet 3 main 6c888f4: btRigidBody.cpp applyDamping, btGeneric6DofSpring2Constraint.cpp get_limit_motor_info2",
    formula: &[
        "k = min(K, 1 / (16 h²)), r = min(c, 1 / h)",
        "n times: v = v e^(−C h)",
        "g = −h (k x + r v), b = −h r v",
        "if f ≠ 0: g = min(max(g − h f, min(g, b, 0)), max(g, b, 0))",
        "v = v + g + h f, x = x + h v",
    ],
    ..ENGINE
};

/// Bullet, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Bullet;

impl EngineRule for Bullet {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let softest = 1.0 / (16.0 * h * h);
        let stiffness = set.stiffness.min(softest);
        let damping = set.damping.min(1.0 / h);
        let kept = libm::exp(-set.drag * h);
        let has_spring = set.has_spring();
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v *= kept;
                if has_spring {
                    let pull = -h * (stiffness * *x + damping * *v);
                    let brake = -h * damping * *v;
                    *v += match f {
                        0.0 => pull,
                        f => {
                            let (least, most) =
                                (pull.min(brake).min(0.0), pull.max(brake).max(0.0));
                            (pull - h * f).max(least).min(most)
                        }
                    };
                }
                *v += h * f;
                *x += h * *v;
            });
        }
    }
}
