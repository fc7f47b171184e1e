//! Improved Euler as the chapter prints it. Only the velocity is improved, and the new velocity moves the position.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "improved-euler-as-printed",
    name: "Improved Euler (as printed)",
    about: "the chapter's listing: the position stays first order; without drag it is semi-implicit Euler at twice the cost",
    order: 1,
    order_with_drag: 1,
    evaluations: Some(2),
    damped_limits: Some([2.011, 2.405, 1.0]),
    source: "Bourg & Bywalec, Physics for Game Developers 2e (2013), ch. 7, listing of the improved Euler method",
    formula: &[
        "k₁ = a(t, q, v), k₂ = a(t + h, q, v + h k₁)",
        "v′ = v + ½h (k₁ + k₂)",
        "q′ = q + h v′",
    ],
    ..AS_PRINTED
};

/// Improved Euler (as printed), by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImprovedEulerAsPrinted<V> {
    k1: V,
    k2: V,
    /// The predicted velocity at the end of the step.
    end: V,
}

impl<S: System> Integrator<S> for ImprovedEulerAsPrinted<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { k1: like.clone(), k2: like.clone(), end: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, end } = self;
        system.acceleration(t, q, v, k1);
        end.assign_sum(v, h, k1);
        system.acceleration(t + h, q, end, k2);
        v.add_terms([(h / 2.0, k1), (h / 2.0, k2)]);
        q.add_scaled(h, v);
        Ok(())
    }
}
