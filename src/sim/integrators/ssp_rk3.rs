//! Strong-stability-preserving Runge-Kutta 3, which averages three Euler steps.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "ssp-rk3",
    name: "SSP Runge-Kutta 3",
    about: "the cheapest explicit method here whose undamped spring stays bounded: it dies away",
    order: 3,
    order_with_drag: 3,
    evaluations: Some(3),
    // At √3 the growth of the squared amplitude in a step, z⁴ (z² - 3) / 36, changes sign.
    stability_limit: Some(1.732_050_807_568_877_2),
    damped_limits: Some([1.988, 2.369, 2.513]),
    source: "Shu & Osher, Efficient implementation of essentially non-oscillatory shock-capturing schemes (1988)",
    formula: &[
        "k₁ = f(t, y)",
        "k₂ = f(t + h, y + h k₁)",
        "k₃ = f(t + ½h, y + ¼h (k₁ + k₂))",
        "y′ = y + h (k₁ + k₂ + 4 k₃) / 6",
    ],
    weights: &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
    ..EXPLICIT
};

/// SSP Runge-Kutta 3. Its Euler steps are `y1 = y + h f(t, y)`, `y2 = (3 y + y1 + h f(t + h, y1)) / 4` and `y' = (y + 2
/// y2 + 2 h f(t + h/2, y2)) / 3`. Written with the three slopes, they are `y2 = y + h (k1 + k2) / 4` and `y' = y + h
/// (k1 + k2 + 4 k3) / 6`.
#[derive(Clone)]
pub struct SspRk3<V> {
    k1: State<V>,
    k2: State<V>,
    k3: State<V>,
    /// The state of the stage that is evaluated next.
    stage: State<V>,
}

impl<S: System> Integrator<S> for SspRk3<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { k1: zero.clone(), k2: zero.clone(), k3: zero.clone(), stage: zero }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { k1, k2, k3, stage } = self;
        system.derivative(t, y, k1);

        stage.assign_sum(y, h, k1);
        system.derivative(t + h, stage, k2);

        stage.assign_sum(y, h / 4.0, k1);
        stage.add_scaled(h / 4.0, k2);
        system.derivative(t + h / 2.0, stage, k3);

        y.add_terms([(h / 6.0, k1), (h / 6.0, k2), (h / 1.5, k3)]);
        Ok(())
    }
}
