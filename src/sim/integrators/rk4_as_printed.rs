//! Runge-Kutta 4 as the chapter prints it. It has four slopes of the velocity alone, and the new velocity moves the
//! position.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "rk4-as-printed",
    name: "Runge-Kutta 4 (as printed)",
    about: "the chapter's listing: the position stays first order; without drag it is semi-implicit Euler at four times the cost",
    order: 1,
    order_with_drag: 1,
    evaluations: Some(4),
    damped_limits: Some([2.003, 2.062, 1.393]),
    source: "Bourg & Bywalec, Physics for Game Developers 2e (2013), ch. 7, listing of the Runge-Kutta method",
    formula: &[
        "k₁ = a(t, q, v), k₂ = a(t + ½h, q, v + ½h k₁)",
        "k₃ = a(t + ½h, q, v + ½h k₂), k₄ = a(t + h, q, v + h k₃)",
        "v′ = v + h (k₁ + 2 k₂ + 2 k₃ + k₄) / 6",
        "q′ = q + h v′",
    ],
    ..AS_PRINTED
};

/// Runge-Kutta 4 (as printed), by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Rk4AsPrinted<V> {
    k1: V,
    k2: V,
    k3: V,
    k4: V,
    /// The velocity of the stage that is evaluated next.
    stage: V,
}

impl<S: System> Integrator<S> for Rk4AsPrinted<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let [k1, k2, k3, k4] = [like.clone(), like.clone(), like.clone(), like.clone()];
        Self { k1, k2, k3, k4, stage: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, k3, k4, stage } = self;
        system.acceleration(t, q, v, k1);

        stage.assign_sum(v, h / 2.0, k1);
        system.acceleration(t + h / 2.0, q, stage, k2);

        stage.assign_sum(v, h / 2.0, k2);
        system.acceleration(t + h / 2.0, q, stage, k3);

        stage.assign_sum(v, h, k3);
        system.acceleration(t + h, q, stage, k4);

        v.add_terms([(h / 6.0, k1), (h / 3.0, k2), (h / 3.0, k3), (h / 6.0, k4)]);
        q.add_scaled(h, v);
        Ok(())
    }
}
