//! The classical Runge-Kutta method: four slopes, weighted 1 2 2 1.

use super::card::{EXPLICIT, Method};
use super::failure::Stepped;
use super::integrator::Integrator;
use crate::sim::state::State;
use crate::sim::system::{StateOf, System};

pub(super) const CARD: Method = Method {
    id: "rk4",
    name: "Runge-Kutta 4",
    about: "the general-purpose choice: accurate at a fine tick; at a coarse one a spring dies away",
    order: 4,
    order_with_drag: 4,
    evaluations: Some(4),
    stability_limit: Some(2.0 * std::f64::consts::SQRT_2),
    damped_limits: Some([2.91, 2.94, 2.785]),
    source: "Kutta, Beitrag zur näherungsweisen Integration totaler Differentialgleichungen (1901); Bourg & Bywalec, Physics for Game Developers 2e, ch. 7",
    formula: &[
        "k₁ = f(t, y)",
        "k₂ = f(t + ½h, y + ½h k₁)",
        "k₃ = f(t + ½h, y + ½h k₂)",
        "k₄ = f(t + h, y + h k₃)",
        "y′ = y + h (k₁ + 2 k₂ + 2 k₃ + k₄) / 6",
    ],
    weights: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    code: include_str!("../../../assets/methods/rk4.step"),
    ..EXPLICIT
};

/// Runge-Kutta 4, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Rk4<V> {
    k1: State<V>,
    k2: State<V>,
    k3: State<V>,
    k4: State<V>,
    /// The state at which a stage is evaluated.
    stage: State<V>,
}

impl<S: System> Integrator<S> for Rk4<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { k1: zero.clone(), k2: zero.clone(), k3: zero.clone(), k4: zero.clone(), stage: zero }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, k3, k4, stage } = self;
        system.derivative(t, y, k1);

        stage.assign_sum(y, h / 2.0, k1);
        system.derivative(t + h / 2.0, stage, k2);

        stage.assign_sum(y, h / 2.0, k2);
        system.derivative(t + h / 2.0, stage, k3);

        stage.assign_sum(y, h, k3);
        system.derivative(t + h, stage, k4);

        y.add_terms([(h / 6.0, k1), (h / 3.0, k2), (h / 3.0, k3), (h / 6.0, k4)]);
        Ok(())
    }
}
