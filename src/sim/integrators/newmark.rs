//! Newmark's method with β = 1/4 and γ = 1/2, which uses the mean of the accelerations at both ends of the step.

use super::prelude::*;
use super::shared::newton::Newton;
use super::shared::stages::Stages;

pub(super) const CARD: Method = Method {
    id: "newmark",
    name: "Newmark",
    about: "stable at any step and keeps the energy of springs, though not phase-space area where forces are curved",
    caveat: RINGS_ON,
    order: 2,
    order_with_drag: 2,
    reversible: true,
    source: "Newmark, A method of computation for structural dynamics (1959)",
    formula: &["q′ = q + h v + ¼h² (a + a′)", "v′ = v + ½h (a + a′)", "a′ = a(t + h, q′, v′)"],
    ..IMPLICIT
};

/// Newmark, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Newmark<V> {
    a: V,
    newton: Newton<V, 1>,
}

/// The weight for a mean acceleration over the step. With a smaller β the method is stable only up to some step.
const BETA: f64 = 0.25;
/// The only γ with second order.
const GAMMA: f64 = 0.5;

impl<S: System<Vector: Vector>> Integrator<S> for Newmark<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self { a: like.clone(), newton: Newton::new(like, coupling) }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { a, newton } = self;
        system.acceleration(t, &y.q, &y.v, a);
        y.q.add_scaled(h, &y.v);
        y.q.add_scaled(h * h * (0.5 - BETA), a);
        y.v.add_scaled(h * (1.0 - GAMMA), a);

        newton.base[0].assign(y);
        let (alpha, beta) = (h * h * BETA, h * GAMMA);
        newton.solve(system, &Stages { t: [t + h], alpha: [[alpha]], beta: [[beta]] })?;
        y.q.add_scaled(alpha, &newton.a[0]);
        y.v.add_scaled(beta, &newton.a[0]);
        Ok(())
    }
}
