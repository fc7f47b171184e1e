//! MuJoCo with its Runge-Kutta integrator, which holds the force of user code.

use super::mujoco::reset_if_out_of_range;
use super::prelude::*;

const MODES: [JointMode; 1] = [si_mode(
    "joint",
    "<option integrator=\"RK4\"/>\n<joint type=\"slide\" stiffness=\"{stiffness}\" damping=\"{damping}\"/>",
)];

pub(super) const CARD: Method = Method {
    id: "engine-mujoco-rk4",
    name: "MuJoCo, RK4",
    about: "the classical fourth order on the engine's springs and damping; a custom force is held through its stages",
    order: 4,
    order_with_drag: 4,
    stability_limit: Some(2.0 * std::f64::consts::SQRT_2),
    engine: Some(Engine {
        tick_hz: 500,
        damping_ratio: Some(0.0),
        substeps: Substeps::Own,
        free_spin: Some(FreeSpin::of(SpinMap::RungeKutta)),
        version: "4.0.0",
        logged: Some("2026-11-21"),
        modes: &MODES,
        ..BARE
    }),
    source: "MuJoCo 4.0.0: engine_forward.c mj_RungeKutta",
    formula: &[
        "a(x, v) = f − K x − (c + C) v",
        "n times: if max(|x|, |v|, |a(x, v)|) > 10¹⁰: x = 0, v = 0, f = 0",
        "a₁ = a(x, v), v₂ = v + ½h a₁",
        "a₂ = a(x + ½h v, v₂), v₃ = v + ½h a₂",
        "a₃ = a(x + ½h v₂, v₃), v₄ = v + h a₃",
        "a₄ = a(x + h v₃, v₄)",
        "x = x + h (v + 2 v₂ + 2 v₃ + v₄) / 6",
        "v = v + h (a₁ + 2 a₂ + 2 a₃ + a₄) / 6",
    ],
    ..ENGINE
};

/// MuJoCo, RK4, whose tick follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct MujocoRk4;

impl EngineRule for MujocoRk4 {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let damping = set.damping + set.drag;
        let mut applied = 1.0;
        for _ in 0..tick.substeps {
            if reset_if_out_of_range(set, tick.force, q, v) {
                applied = 0.0;
            }
            each(tick.force, q, v, |x, v, f| {
                let a = |x: f64, v: f64| applied * f - set.stiffness * x - damping * v;
                let (v1, a1) = (*v, a(*x, *v));
                let (v2, a2) = (*v + h / 2.0 * a1, a(*x + h / 2.0 * v1, *v + h / 2.0 * a1));
                let (v3, a3) = (*v + h / 2.0 * a2, a(*x + h / 2.0 * v2, *v + h / 2.0 * a2));
                let (v4, a4) = (*v + h * a3, a(*x + h * v3, *v + h * a3));
                *x += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
                *v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            });
        }
    }
}
