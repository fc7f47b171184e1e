//! Improved Euler (Heun), which follows the mean of the slopes at both ends of the step.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "improved-euler",
    name: "Improved Euler",
    about: "accurate for its cost; an undamped spring gains energy, slowly at a fine tick",
    caveat: SLOW_GROWTH,
    order: 2,
    order_with_drag: 2,
    evaluations: Some(2),
    damped_limits: Some([0.8, 1.394, 2.0]),
    source: "Heun, Neue Methoden zur approximativen Integration (1900); Bourg & Bywalec, Physics for Game Developers 2e, ch. 7",
    formula: &["k₁ = f(t, y)", "k₂ = f(t + h, y + h k₁)", "y′ = y + ½h (k₁ + k₂)"],
    weights: &[0.5, 0.5],
    ..EXPLICIT
};

/// Improved Euler, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImprovedEuler<V> {
    k1: State<V>,
    k2: State<V>,
    /// The predicted end of the step.
    end: State<V>,
}

impl<S: System> Integrator<S> for ImprovedEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { k1: zero.clone(), k2: zero.clone(), end: zero }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, end } = self;
        system.derivative(t, y, k1);
        end.assign_sum(y, h, k1);
        // The first slope is added early only for speed (`--bench step -- improved-euler`), so that each slope keeps
        // its own registers.
        y.add_scaled(h / 2.0, k1);
        system.derivative(t + h, end, k2);
        y.add_scaled(h / 2.0, k2);
        Ok(())
    }
}
