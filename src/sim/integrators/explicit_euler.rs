//! Explicit Euler, which follows the tangent at the start for the whole step.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "explicit-euler",
    name: "Explicit Euler",
    about: "gains energy: a spring's amplitude grows at every step size",
    caveat: "light damping saves a spring only up to a step of 2 ζ / ω; semi-implicit Euler costs the same and does not grow",
    order: 1,
    order_with_drag: 1,
    evaluations: Some(1),
    damped_limits: Some([0.1, 0.4, 2.0]),
    source: "Euler, Institutionum calculi integralis I (1768); Bourg & Bywalec, Physics for Game Developers 2e, ch. 7, Figure 7-5",
    formula: &["y′ = y + h f(t, y)"],
    weights: &[1.0],
    ..EXPLICIT
};

/// Explicit Euler, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ExplicitEuler<V> {
    k1: State<V>,
}

impl<S: System> Integrator<S> for ExplicitEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { k1: State { q: like.clone(), v: like.clone() } }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { k1 } = self;
        system.derivative(t, y, k1);
        y.add_scaled(h, k1);
        Ok(())
    }
}
