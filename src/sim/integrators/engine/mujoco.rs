//! MuJoCo with its Euler integrator: implicit in the damping, explicit in the stiffness.

use super::{EngineMethod, Rule, Tick, each};
use crate::sim::integrators::card::{ENGINE, Engine, Method};
use crate::sim::integrators::free_spin::{FreeSpin, SpinMap};
use crate::sim::system::Vector;

pub(in crate::sim::integrators) const CARD: Method = Method {
    id: "engine-mujoco",
    name: "MuJoCo",
    about: "semi-implicit Euler with implicit damping, which drag is too; the same under its implicit integrators",
    stability_limit: Some(2.0),
    symplectic: true,
    engine: Some(Engine {
        tick_hz: 500,
        damping_ratio: Some(0.0),
        has_substeps: true,
        free_spin: Some(FreeSpin {
            default: SpinMap::Explicit,
            opt_in: Some(SpinMap::NewtonStep),
            per_substep: true,
        }),
    }),
    source: "MuJoCo 4.0.0: engine_forward.c mj_Euler",
    ..ENGINE
};

/// `n` times: `v = (v + h (f - K x))/(1 + h (c + C))`, `x += h v`.
pub type Mujoco<V> = EngineMethod<V, MujocoRule>;

/// The rule of [`Mujoco`].
#[derive(Clone, Copy, Debug, Default)]
pub struct MujocoRule;

impl Rule for MujocoRule {
    const CARD: &'static Method = &CARD;

    #[inline]
    fn tick<V: Vector>(&self, tick: Tick<'_, V>, _spare: &mut V, q: &mut V, v: &mut V) {
        let (h, set) = (tick.substep(), tick.settings);
        let resistance = 1.0 + h * (set.damping + set.drag);
        for _ in 0..tick.substeps {
            each(tick.force, q, v, |x, v, f| {
                *v = (*v + h * (f - set.stiffness * *x)) / resistance;
                *x += h * *v;
            });
        }
    }
}
