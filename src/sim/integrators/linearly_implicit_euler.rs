//! Linearly implicit Euler, which is implicit Euler with one Newton iteration from the start of the step.

use super::prelude::*;
use super::shared::linearisation::Linearisation;

pub(super) const CARD: Method = Method {
    id: "linearly-implicit-euler",
    name: "Linearly implicit Euler",
    also: &["xpbd", "soft-constraint"],
    about: "implicit Euler for one linear solution a step; on one spring the step of XPBD and of soft constraints",
    caveat: DAMPS_BY_RATE,
    order: 1,
    order_with_drag: 1,
    source: "Rosenbrock, Some general implicit processes for the numerical solution of differential equations (1963); Baraff & Witkin, Large Steps in Cloth Simulation (1998); Macklin, Müller & Chentanez, XPBD (2016); Catto, Soft Constraints (2011)",
    formula: &["(I − h ∂f/∂y) (y′ − y) = h f(t + h, y)"],
    ..LINEARISED
};

/// Solves `(I - h ∂f/∂y) (y' - y) = h f(t + h, y)` on the whole state `y = (q, v)`. With `v' = v + h x` and `q' = q + h
/// v'`, this equation is `(I - h² ∂a/∂q - h ∂a/∂v) x = a + h ∂a/∂q v`.
///
/// On a linear system the method is implicit Euler.
#[derive(Clone)]
pub struct LinearlyImplicitEuler<V> {
    /// The right-hand side, and then `x`.
    a: V,
    equations: Linearisation<V, 1>,
}

impl<S: System<Vector: Vector>> Integrator<S> for LinearlyImplicitEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self { a: like.clone(), equations: Linearisation::new(like, coupling) }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { a, equations } = self;
        system.acceleration(t + h, &y.q, &y.v, a);
        equations.slopes.reach_for(h, y, a);
        equations.add_slope(system, t + h, y, h, &y.v, a);
        equations.solve_at(system, t + h, y, [h * h, h], a)?;
        S::Vector::kick_and_drift(h, a, &mut y.v, h, &mut y.q);
        Ok(())
    }
}
