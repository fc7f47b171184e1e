//! Semi-implicit Euler, which kicks the velocity, then drifts with the new velocity.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "semi-implicit-euler",
    name: "Semi-implicit Euler",
    about: "bounded on a spring up to h ω = 2; the usual choice of game physics",
    order: 1,
    order_with_drag: 1,
    evaluations: Some(1),
    reversible: false,
    damped_limits: Some([1.902, 1.64, 0.828]),
    source: "de Vogelaere, Methods of integration which preserve the contact transformation property of the Hamilton equations (1956)",
    formula: &["v′ = v + h a(t, q, v)", "q′ = q + h v′"],
    ..SYMPLECTIC
};

/// Semi-implicit Euler, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct SemiImplicitEuler<V> {
    a: V,
}

impl<S: System> Integrator<S> for SemiImplicitEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { a } = self;
        system.acceleration(t, q, v, a);
        S::Vector::kick_and_drift(h, a, v, h, q);
        Ok(())
    }
}
