//! Position Verlet, which makes half a drift, a kick, and half a drift.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "position-verlet",
    name: "Position Verlet",
    about: "second order for one evaluation a step and nothing carried; drag leaves it first order",
    order: 2,
    order_with_drag: 1,
    evaluations: Some(1),
    damped_limits: Some([1.902, 1.64, 0.828]),
    source: "Tuckerman, Berne & Martyna, Reversible multiple time scale molecular dynamics (1992)",
    formula: &["q½ = q + ½h v", "v′ = v + h a(t + ½h, q½, v)", "q′ = q½ + ½h v′"],
    ..SYMPLECTIC
};

/// Position Verlet, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct PositionVerlet<V> {
    a: V,
}

impl<S: System> Integrator<S> for PositionVerlet<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { a } = self;
        q.add_scaled(h / 2.0, v);
        system.acceleration(t + h / 2.0, q, v, a);
        S::Vector::kick_and_drift(h, a, v, h / 2.0, q);
        Ok(())
    }
}
