//! Methods that move each coordinate of a body towards its target.

use std::marker::PhantomData;

use super::card::Carded;
use super::failure::{StepFailure, Stepped};
use super::integrator::Integrator;
use super::only::Needs;
use crate::state::{State, Vector};
use crate::system::{Pursuit, StateOf, System};

/// The rule of a follower.
pub trait FollowerRule: Carded + Clone + Send + Sync + 'static {
    /// Returns the coordinate and the velocity after a step of `h` (s) from `x` and `v`. The target is at `g` at the
    /// end of the step, and `rate` is k or ω of the law, per second.
    fn step(h: f64, rate: f64, g: f64, x: f64, v: f64) -> (f64, f64);
}

/// A follower as a method, which reads the target at the end of a step and applies the follower's rule.
#[derive(Clone)]
pub struct Follower<V, R>(PhantomData<(V, R)>);

impl<S: System<Vector: Vector>, R: FollowerRule> Integrator<S> for Follower<S::Vector, R> {
    fn new(_like: &S::Vector) -> Self {
        Self(PhantomData)
    }

    #[inline]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let only = R::CARD.only.expect("a follower's card says what it follows");
        let pursuit = Pursuit::of(system, t + h);
        let pursuit = pursuit.filter(|found| only.needs == Needs::Law { order: found.order });
        let refused = StepFailure::Refused { reason: only.reason };
        let Pursuit { target, rate, .. } = pursuit.ok_or(refused)?;
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for ((x, v), g) in moved.zip(target.components()) {
            (*x, *v) = R::step(h, rate, *g, *x, *v);
        }
        Ok(())
    }
}

/// Makes a step that covers this part of the way from `x` to the target `g`. Returns the new coordinate, and its
/// velocity by a first-order law of rate `k`.
#[inline]
pub(super) fn lerp(part: f64, k: f64, g: f64, x: f64) -> (f64, f64) {
    let end = x + part * (g - x);
    (end, k * (g - end))
}
