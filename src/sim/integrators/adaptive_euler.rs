//! Adaptive Euler: the difference of one whole step and two half steps is the error, which controls the
//! step size.

use super::prelude::*;
use super::shared::step_size::{StepSize, factor};

pub(super) const CARD: Method = Method {
    id: "adaptive-euler",
    name: "Adaptive Euler",
    about: "the chapter's step doubling, corrected: covers each tick in as many substeps as its tolerance asks",
    order: 2,
    order_with_drag: 2,
    tolerance: Some(TOLERANCE),
    source: "Bourg & Bywalec, Physics for Game Developers 2e, ch. 7, corrected; step control after Hairer, Nørsett & Wanner, Solving ODEs I, II.4",
    formula: &[
        "k₁ = f(t, y), k₂ = f(t + ½h, y + ½h k₁)",
        "error = ½h |k₁ − k₂|",
        "y′ = y + h k₂ if the error is small",
    ],
    code: include_str!("../../../assets/methods/adaptive-euler.step"),
    ..ADAPTIVE
};

/// A millimetre, a millimetre per second, or a thousandth of the value: just visible.
const TOLERANCE: Tolerance = Tolerance { absolute_q: 1e-3, absolute_v: 1e-3, relative: 1e-3 };

/// Step doubling: `y1` by one Euler step of `h`, `y2` by two of `h/2`. Their difference is the error;
/// the extrapolated `2 y2 - y1` is kept, which is second order.
#[derive(Clone)]
pub struct AdaptiveEuler<V> {
    step_size: StepSize,
    k1: State<V>,
    k2: State<V>,
    half: State<V>,
    /// `k1 - k2`; the error is half the step times this.
    difference: State<V>,
}

impl<V: Vector> AdaptiveEuler<V> {
    /// The method with a tolerance that overrides its card's.
    pub fn with_tolerance(like: &V, tolerance: Tolerance) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self {
            step_size: StepSize::new(tolerance),
            k1: zero.clone(),
            k2: zero.clone(),
            half: zero.clone(),
            difference: zero,
        }
    }

    /// Substeps accepted and rejected since construction or reset.
    pub fn attempts(&self) -> (u64, u64) {
        self.step_size.attempts
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for AdaptiveEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self::with_tolerance(like, TOLERANCE)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { step_size, k1, k2, half, difference } = self;
        let mut progress = step_size.begin_tick(h);
        system.derivative(t, y, k1);
        while !progress.is_finished() {
            let (t, h) = (t + progress.elapsed(), progress.trial()?);
            half.assign_sum(y, h / 2.0, k1);
            system.derivative(t + h / 2.0, half, k2);

            difference.assign_sum(k1, -1.0, k2);
            let error = progress.error(h / 2.0, difference, y);
            if progress.accepts(error, |error| factor(error.sqrt())) {
                // 2 y2 - y1 = y + h k2
                y.add_scaled(h, k2);
                if !progress.is_finished() {
                    system.derivative(t + h, y, k1);
                }
            }
        }
        Ok(())
    }

    fn reset(&mut self) {
        self.step_size.reset();
    }

    fn set(&mut self, with: Override) {
        if let Override::Tolerance(tolerance) = with {
            self.step_size.tolerance = tolerance;
        }
    }
}
