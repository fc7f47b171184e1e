//! Implicit midpoint, which follows the slope at the middle of the chord for the whole step.

use super::prelude::*;
use super::shared::newton::Newton;

pub(super) const CARD: Method = Method {
    id: "implicit-midpoint",
    name: "Implicit midpoint",
    about: "stable at any step and keeps the energy of springs; at a coarse tick they swing too slowly",
    caveat: RINGS_ON,
    order: 2,
    order_with_drag: 2,
    symplectic: true,
    reversible: true,
    source: "Feng Kang, On difference schemes and symplectic geometry (1985); Hairer, Lubich & Wanner, Geometric Numerical Integration, VI.4",
    formula: &["m = y + ½h f(t + ½h, m)", "y′ = 2 m − y"],
    ..IMPLICIT
};

/// Implicit midpoint, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImplicitMidpoint<V> {
    newton: Newton<V, 1>,
    /// The middle state `m`.
    middle: State<V>,
}

impl<S: System<Vector: Vector>> Integrator<S> for ImplicitMidpoint<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        let middle = State { q: like.clone(), v: like.clone() };
        Self { newton: Newton::new(like, coupling), middle }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { newton, middle } = self;
        middle.assign(y);
        newton.backward_euler(system, t + h / 2.0, h / 2.0, middle)?;
        y.q.add_scaled(h, &middle.v);
        y.v.add_scaled(h, &newton.a[0]);
        Ok(())
    }
}
