//! Implicit Euler: the tangent at the end, followed back to the start.

use super::shared::newton::Newton;
use super::{Family, Integrator, Method, State, StepFailure, System};

pub(super) const CARD: Method = Method {
    id: "implicit-euler",
    name: "Implicit Euler",
    about: "stable at any step, and takes energy: a spring dies away, the faster the coarser the tick",
    family: Family::Implicit,
    order: 1,
    order_with_drag: 1,
    evaluations: None,
    symplectic: false,
    reversible: false,
    stability_limit: None,
    tolerance: None,
    restart: None,
    keeps_time: true,
    as_printed: false,
    source: "Curtiss & Hirschfelder, Integration of stiff equations (1952)",
};

/// `y' = y + h f(t + h, y')` on the whole state `y = (q, v)`.
#[derive(Clone)]
pub struct ImplicitEuler<V> {
    newton: Newton<V, 1>,
}

impl<S: System> Integrator<S> for ImplicitEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { newton: Newton::new(like) }
    }

    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        y: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        self.newton.backward(system, t + h, h, y)
    }

    fn heap_bytes(&self) -> usize {
        self.newton.heap_bytes()
    }
}
