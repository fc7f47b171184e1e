//! BDF2, which takes the slope at the end of the step from a parabola through the last two states and the new one.

use super::prelude::*;
use super::shared::LastStep;
use super::shared::newton::Newton;

pub(super) const CARD: Method = Method {
    id: "bdf2",
    name: "BDF2",
    about: "stable at any step, and takes less energy than implicit Euler for the same work",
    caveat: DAMPS_BY_RATE,
    order: 2,
    order_with_drag: 2,
    restart: Some(
        "by a step of Alexander's two-stage SDIRK, which damps as much and has the same order",
    ),
    source: "Curtiss & Hirschfelder, Integration of stiff equations (1952); started by Alexander, Diagonally implicit Runge-Kutta methods for stiff ODEs (1977), the SDIRK of two stages",
    formula: &["y′ = y + ⅓ (y − y₋₁) + ⅔h f(t + h, y′)"],
    ..IMPLICIT
};

/// BDF2, by the [formula](Method::formula) on its card. `y"` is the state one step before `y`.
#[derive(Clone)]
pub struct Bdf2<V> {
    newton: Newton<V, 1>,
    /// The state `y"`.
    before: State<V>,
    /// A copy of `y`, because `y'` is computed in its place.
    start: State<V>,
    /// The first stage of the first step.
    stage: State<V>,
    last_step: LastStep,
}

/// The diagonal of the starting method. With `1 - 1/√2` this method is L-stable, as BDF2 is.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

impl<S: System<Vector: Vector>> Integrator<S> for Bdf2<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        let [before, start, stage] = [zero.clone(), zero.clone(), zero];
        Self {
            newton: Newton::new(like, coupling),
            before,
            start,
            stage,
            last_step: LastStep::NONE,
        }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { newton, before, start, stage, last_step } = self;
        start.assign(y);
        if last_step.is_continued_by(h) {
            y.add_scaled(1.0 / 3.0, start);
            y.add_scaled(-1.0 / 3.0, before);
            newton.backward_euler(system, t + h, h * 2.0 / 3.0, y)?;
        } else {
            stage.assign(y);
            newton.backward_euler(system, t + h * GAMMA, h * GAMMA, stage)?;
            // Computes y + (1 - γ) h f(stage), with γ h f(stage) = stage - y.
            y.add_scaled((1.0 - GAMMA) / GAMMA, stage);
            y.add_scaled((GAMMA - 1.0) / GAMMA, start);
            newton.backward_euler(system, t + h, h * GAMMA, y)?;
        }
        std::mem::swap(before, start);
        last_step.end(h);
        Ok(())
    }

    fn reset(&mut self) {
        self.last_step = LastStep::NONE;
    }
}
