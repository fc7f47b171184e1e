//! Semi-implicit Euler with implicit drag. The kick is divided by `1 − h ∂a/∂v`, so that drag cannot overshoot.

use super::prelude::*;
use super::shared::linearisation::Linearisation;

pub(super) const CARD: Method = Method {
    id: "semi-implicit-euler-implicit-drag",
    name: "Semi-implicit Euler, implicit drag",
    about: "semi-implicit Euler whose drag is stable at any step: what engines write as v / (1 + h c)",
    order: 1,
    order_with_drag: 1,
    symplectic: true,
    stability_limit: Some(2.0),
    // These are z = 2 ζ + 2 √(1 + ζ²).
    damped_limits: Some([2.102, 2.44, 4.828]),
    source: "Ascher, Ruuth & Wetton, Implicit-explicit methods for time-dependent partial differential equations (1995)",
    formula: &["(I − h ∂a/∂v) (v′ − v) = h a(t, q, v)", "q′ = q + h v′"],
    ..LINEARISED
};

/// Semi-implicit Euler, implicit drag, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct SemiImplicitEulerImplicitDrag<V> {
    a: V,
    equations: Linearisation<V, 1>,
}

impl<S: System<Vector: Vector>> Integrator<S> for SemiImplicitEulerImplicitDrag<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self { a: like.clone(), equations: Linearisation::new(like, coupling) }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { a, equations } = self;
        system.acceleration(t, &y.q, &y.v, a);
        equations.slopes.reach_for(h, y, a);
        equations.solve_at(system, t, y, [0.0, h], a)?;
        S::Vector::kick_and_drift(h, a, &mut y.v, h, &mut y.q);
        Ok(())
    }
}
