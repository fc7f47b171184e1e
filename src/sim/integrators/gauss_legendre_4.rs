//! Gauss-Legendre of two stages, which is collocation at the two points of Gauss's quadrature.

use super::prelude::*;
use super::shared::newton::Newton;
use super::shared::stages::Stages;

pub(super) const CARD: Method = Method {
    id: "gauss-legendre-4",
    name: "Gauss-Legendre 4",
    about: "stable at any step, accurate, and keeps the energy of springs; the dearest of the implicit ones",
    caveat: RINGS_ON,
    order: 4,
    order_with_drag: 4,
    matrices: 6,
    symplectic: true,
    reversible: true,
    source: "Butcher, Implicit Runge-Kutta processes (1964); Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.3",
    formula: &[
        "k₁ = f(t + (½ − r) h, y + h (¼k₁ + (¼ − r) k₂))",
        "k₂ = f(t + (½ + r) h, y + h ((¼ + r) k₁ + ¼k₂))",
        "y′ = y + ½h (k₁ + k₂), r = √3 / 6",
    ],
    ..IMPLICIT
};

/// The number r of the formula, `√3 / 6`.
const R: f64 = 0.288_675_134_594_812_9;
const C: [f64; 2] = [0.5 - R, 0.5 + R];
const A: [[f64; 2]; 2] = [[0.25, 0.25 - R], [0.25 + R, 0.25]];
/// The square of `A`, which has the weights of the accelerations in the coordinates.
const A2: [[f64; 2]; 2] = [[1.0 / 24.0, 0.125 - R / 2.0], [0.125 + R / 2.0, 1.0 / 24.0]];

/// Gauss-Legendre 4, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GaussLegendre4<V> {
    newton: Newton<V, 2>,
}

impl<S: System<Vector: Vector>> Integrator<S> for GaussLegendre4<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        Self { newton: Newton::new(like, coupling) }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { newton } = self;
        for (base, c) in newton.base.iter_mut().zip(C) {
            base.assign(y);
            base.q.add_scaled(h * c, &y.v);
        }
        newton.solve(
            system,
            &Stages {
                t: C.map(|c| t + h * c),
                alpha: A2.map(|row| row.map(|a| h * h * a)),
                beta: A.map(|row| row.map(|a| h * a)),
            },
        )?;
        let [a1, a2] = &newton.a;
        y.q.add_terms([(h, &y.v), (h * h / 2.0 * C[1], a1), (h * h / 2.0 * C[0], a2)]);
        y.v.add_terms([(h / 2.0, a1), (h / 2.0, a2)]);
        Ok(())
    }
}
