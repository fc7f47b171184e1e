//! Jakobsen's Verlet, which computes the next position from the last two, with a drag that hides in a factor of 0.99.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "jakobsen-verlet",
    name: "Jakobsen's Verlet",
    about: "as in many cloths and ragdolls: each step takes 1 % of the velocity, so that the drag depends on the tick rate",
    order: 0,
    order_with_drag: 0,
    evaluations: Some(1),
    symplectic: false,
    // This is √(2 + 2 KEPT).
    stability_limit: Some(1.994_993_734_326_0),
    // These are z = √(4 ζ² + 3.98) - 2 ζ.
    damped_limits: Some([1.897, 1.635, 0.825]),
    source: "Jakobsen, Advanced Character Physics (2001), with his drag of 0.99",
    formula: &["p = q − h v, q′ = q + 0.99 (q − p) + h² a", "v′ = (q′ − q) / h"],
    ..AS_PRINTED
};

/// The fraction of the last step's displacement that is kept.
const KEPT: f64 = 0.99;

/// Computes `x' = x + 0.99 (x - p) + h² a`, where `p = x - h v` is the position one step ago. The velocity follows from
/// the positions as `v' = (x' - x) / h = 0.99 v + h a`.
///
/// Positions and velocities agree, so that nothing is carried from step to step. After a kick or a change of step, the
/// velocity determines `p`.
#[derive(Clone)]
pub struct JakobsenVerlet<V> {
    a: V,
}

impl<S: System> Integrator<S> for JakobsenVerlet<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { a } = self;
        system.acceleration(t, q, v, a);
        v.scale(KEPT);
        S::Vector::kick_and_drift(h, a, v, h, q);
        Ok(())
    }
}
