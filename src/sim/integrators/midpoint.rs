//! Midpoint, which follows the slope at the middle for the whole step.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "midpoint",
    name: "Midpoint",
    about: "as accurate as improved Euler at the same cost; an undamped spring gains energy as slowly",
    caveat: SLOW_GROWTH,
    order: 2,
    order_with_drag: 2,
    evaluations: Some(2),
    damped_limits: Some([0.8, 1.394, 2.0]),
    source: "Runge, Über die numerische Auflösung von Differentialgleichungen (1895)",
    formula: &["k₁ = f(t, y)", "k₂ = f(t + ½h, y + ½h k₁)", "y′ = y + h k₂"],
    weights: &[0.0, 1.0],
    ..EXPLICIT
};

/// Midpoint, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Midpoint<V> {
    k1: State<V>,
    k2: State<V>,
    /// The predicted middle of the step.
    middle: State<V>,
}

impl<S: System> Integrator<S> for Midpoint<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { k1: zero.clone(), k2: zero.clone(), middle: zero }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, middle } = self;
        system.derivative(t, y, k1);
        middle.assign_sum(y, h / 2.0, k1);
        system.derivative(t + h / 2.0, middle, k2);
        y.add_scaled(h, k2);
        Ok(())
    }
}
