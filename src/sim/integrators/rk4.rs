//! The classical Runge-Kutta method, which weights four slopes by 1, 2, 2 and 1.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "rk4",
    name: "Runge-Kutta 4",
    about: "the general-purpose choice: accurate at a fine tick; at a coarse one a spring dies away",
    order: 4,
    order_with_drag: 4,
    evaluations: Some(4),
    stability_limit: Some(2.0 * std::f64::consts::SQRT_2),
    damped_limits: Some([2.91, 2.94, 2.785]),
    source: "Kutta, Beitrag zur näherungsweisen Integration totaler Differentialgleichungen (1901); Bourg & Bywalec, Physics for Game Developers 2e, ch. 7",
    formula: &[
        "k₁ = f(t, y)",
        "k₂ = f(t + ½h, y + ½h k₁)",
        "k₃ = f(t + ½h, y + ½h k₂)",
        "k₄ = f(t + h, y + h k₃)",
        "y′ = y + h (k₁ + 2 k₂ + 2 k₃ + k₄) / 6",
    ],
    weights: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    ..EXPLICIT
};

/// Runge-Kutta 4, by the [formula](Method::formula) on its card.
///
/// A slope `k` is a velocity and an acceleration, here `(v, a1)`, `(v2, a2)`, `(v3, a3)` and `(v4, a4)`. The velocity
/// of a stage is also the velocity of its slope, and is not copied.
#[derive(Clone)]
pub struct Rk4<V> {
    a1: V,
    a2: V,
    a3: V,
    a4: V,
    v2: V,
    v3: V,
    v4: V,
    /// The coordinates of the stage that is evaluated next.
    stage: V,
}

impl<S: System> Integrator<S> for Rk4<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let [a1, a2, a3, a4] = [(); 4].map(|()| like.clone());
        let [v2, v3, v4, stage] = [(); 4].map(|()| like.clone());
        Self { a1, a2, a3, a4, v2, v3, v4, stage }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { a1, a2, a3, a4, v2, v3, v4, stage } = self;
        system.acceleration(t, q, v, a1);
        stage.assign_sum(q, h / 2.0, v);
        v2.assign_sum(v, h / 2.0, a1);
        system.acceleration(t + h / 2.0, stage, v2, a2);
        stage.assign_sum(q, h / 2.0, v2);
        v3.assign_sum(v, h / 2.0, a2);
        system.acceleration(t + h / 2.0, stage, v3, a3);
        stage.assign_sum(q, h, v3);
        v4.assign_sum(v, h, a3);
        system.acceleration(t + h, stage, v4, a4);
        q.add_terms([(h / 6.0, v), (h / 3.0, v2), (h / 3.0, v3), (h / 6.0, v4)]);
        v.add_terms([(h / 6.0, a1), (h / 3.0, a2), (h / 3.0, a3), (h / 6.0, a4)]);
        Ok(())
    }
}
