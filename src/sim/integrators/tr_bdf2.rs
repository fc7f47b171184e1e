//! TR-BDF2, which applies the trapezoidal rule over a part of the step, and BDF2 over the whole step.

use super::prelude::*;
use super::shared::newton::Newton;

pub(super) const CARD: Method = Method {
    id: "tr-bdf2",
    name: "TR-BDF2",
    about: "stable at any step and damps stiff motion, like BDF2, but needs no earlier step: it restarts freely",
    caveat: DAMPS_BY_RATE,
    order: 2,
    order_with_drag: 2,
    source: "Bank, Coughran, Fichtner, Grosse, Rose & Smith, Transient simulation of silicon devices and circuits (1985)",
    formula: &[
        "Y = y + ½γh (f(t, y) + f(t + γ h, Y)), γ = 2 − √2",
        "y′ = y + (Y − y) / (γ (2 − γ)) + ½γh f(t + h, y′)",
    ],
    ..IMPLICIT
};

/// TR-BDF2. It solves `Y = y + γ/2 h (f(t, y) + f(t + γ h, Y))`, then `y' = (Y - (1 - γ)² y) / (γ (2 - γ)) + (1 - γ) /
/// (2 - γ) h f(t + h, y')`.
#[derive(Clone)]
pub struct TrBdf2<V> {
    newton: Newton<V, 1>,
    /// The slope `f(t, y)`.
    f: State<V>,
    /// The stage `Y`.
    stage: State<V>,
}

/// The part γ = `2 - √2`. With it, the new slope has the same weight in both equations, and the method is L-stable.
const GAMMA: f64 = 2.0 - std::f64::consts::SQRT_2;
/// The weight of the new slope, `γ/2 = (1 - γ) / (2 - γ)`.
const D: f64 = GAMMA / 2.0;
/// The weight of `Y`, `1 / (γ (2 - γ))`.
const W: f64 = 1.0 / (GAMMA * (2.0 - GAMMA));

impl<S: System<Vector: Vector>> Integrator<S> for TrBdf2<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { newton: Newton::new(like, coupling), f: zero.clone(), stage: zero }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { newton, f, stage } = self;
        system.derivative(t, y, f);
        stage.assign_sum(y, h * D, f);
        newton.backward_euler(system, t + h * GAMMA, h * D, stage)?;
        // This is y + W (Y - y), because W (1 - γ)² = W - 1.
        f.assign(y);
        y.add_terms([(-W, f), (W, stage)]);
        newton.backward_euler(system, t + h, h * D, y)
    }
}
