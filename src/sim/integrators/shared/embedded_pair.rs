//! Embedded Runge-Kutta pairs, which are two solutions of neighbouring orders from the same stages. The method keeps
//! the more accurate solution, and the difference of the two estimates the error.

use std::marker::PhantomData;

use super::step_size::{StepSize, steady_factor};
use crate::integrators::failure::Stepped;
use crate::integrators::integrator::{Integrator, Override, Tolerance};
use crate::state::{Elementwise, State, Vector};
use crate::system::{StateOf, System};

/// The tableau of a pair of `N` stages. The last stage is at the kept solution, so that its slope is the first of the
/// next step. This slope is evaluated if the error needs it or another step follows. If the error needs it, it is also
/// carried to the next tick.
pub trait Pair<const N: usize>: Clone + Send + Sync + 'static {
    /// The order of the kept solution.
    const ORDER: u32;
    /// The times of the stages, as fractions of the step.
    const C: [f64; N];
    /// The weights of the stages; the last row gives the kept solution.
    const A: [[f64; N]; N];
    /// The weights of the kept solution minus those of the other solution.
    const E: [f64; N];
    /// The default tolerance.
    const TOLERANCE: Tolerance;

    /// Returns the factor for the length of the next step, after a step with this error relative to the tolerance.
    #[inline(always)]
    fn factor(error: f64) -> f64 {
        steady_factor(error, Self::ORDER)
    }
}

/// An adaptive method that steps by the pair `P`.
#[derive(Clone)]
pub struct EmbeddedPair<V, P, const N: usize> {
    step_size: StepSize,
    /// The slopes at the stages. The first slope may carry over to the next tick.
    k: [State<V>; N],
    /// The state of the stage that is evaluated next.
    stage: State<V>,
    error: State<V>,
    pair: PhantomData<P>,
}

impl<V: Vector, P: Pair<N>, const N: usize> EmbeddedPair<V, P, N> {
    /// Returns the method with a tolerance that overrides its card's.
    pub fn with_tolerance(like: &V, tolerance: Tolerance) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        Self {
            step_size: StepSize::new(tolerance),
            k: std::array::from_fn(|_| state.clone()),
            stage: state.clone(),
            error: state,
            pair: PhantomData,
        }
    }

    /// Returns the numbers of substeps accepted and rejected since construction or reset.
    pub fn attempts(&self) -> (u64, u64) {
        self.step_size.attempts
    }
}

impl<S: System<Vector: Vector>, P: Pair<N>, const N: usize> Integrator<S>
    for EmbeddedPair<S::Vector, P, N>
{
    fn new(like: &S::Vector) -> Self {
        Self::with_tolerance(like, P::TOLERANCE)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { step_size, k, stage, error, .. } = self;
        let is_last_in_error = P::E[N - 1] != 0.0;
        let mut progress = step_size.begin_tick(h);
        if !(is_last_in_error && progress.continues) {
            system.derivative(t, y, &mut k[0]);
        }
        while !progress.is_finished() {
            let (t, h) = (t + progress.elapsed(), progress.trial()?);
            for i in 1..N {
                let (known, next) = k.split_at_mut(i);
                stage.assign(y);
                add_weighted(stage, h, &P::A[i], known);
                if i < N - 1 || is_last_in_error {
                    system.derivative(t + h * P::C[i], stage, &mut next[0]);
                }
            }
            error.q.assign_scaled(P::E[0], &k[0].q);
            error.v.assign_scaled(P::E[0], &k[0].v);
            add_weighted(error, 1.0, &P::E[1..], &k[1..]);
            if progress.accepts(error, y, P::factor) {
                y.assign(stage);
                if is_last_in_error {
                    k.swap(0, N - 1);
                } else if !progress.is_finished() {
                    system.derivative(t + h, y, &mut k[0]);
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

/// Computes `sum += h Σ weights k`.
#[inline(always)]
fn add_weighted<V: Vector>(sum: &mut State<V>, h: f64, weights: &[f64], k: &[State<V>]) {
    for (weight, k) in weights.iter().zip(k) {
        if *weight != 0.0 {
            sum.add_scaled(h * weight, k);
        }
    }
}
