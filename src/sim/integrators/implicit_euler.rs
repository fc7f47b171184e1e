//! Implicit Euler, which follows the tangent at the end of the step.

use super::prelude::*;
use super::shared::newton::Newton;

pub(super) const CARD: Method = Method {
    id: "implicit-euler",
    name: "Implicit Euler",
    about: "stable at any step, and takes energy: a spring dies away, the faster the coarser the tick",
    caveat: DAMPS_BY_RATE,
    order: 1,
    order_with_drag: 1,
    source: "Curtiss & Hirschfelder, Integration of stiff equations (1952)",
    formula: &["y′ = y + h f(t + h, y′)"],
    ..IMPLICIT
};

/// Implicit Euler, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImplicitEuler<V> {
    newton: Newton<V, 1>,
}

impl<S: System<Vector: Vector>> Integrator<S> for ImplicitEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self { newton: Newton::new(like, coupling) }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        self.newton.backward_euler(system, t + h, h, y)
    }
}
