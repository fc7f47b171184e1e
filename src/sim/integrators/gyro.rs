//! Methods for a body that turns freely in space.
//!
//! A step depends on the moments and on the angular velocity in the frame of the body. It gives the angular velocity
//! at its end, and the turn of the body, as seen from it. The letters of the formulas are `I`, the principal moments;
//! `ω`; `L = I ω`; and `exp(v)`, the turn by a vector.

use std::marker::PhantomData;

use glam::{DQuat, DVec3};

use super::card::Carded;
use super::failure::{StepFailure, Stepped};
use super::integrator::Integrator;
use crate::spin::{Spin, seen_from, turn_by, vector_of};
use crate::state::{State, Vector};
use crate::system::{Query, StateOf, System};

/// The angular velocity (rad/s) at the end of a step and the turn of the body during it, or the reason why there is no
/// such step.
pub type Turned = Result<(DVec3, DQuat), StepFailure>;

/// The rule of a free rotation.
pub trait GyroRule: Carded + Clone + Send + Sync + 'static {
    /// Makes a step of `h` (s) from `omega` (rad/s), for these principal moments (kg m²).
    ///
    /// # Errors
    /// If an iteration does not converge.
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned;
}

/// A rule of a free rotation as a method.
#[derive(Clone)]
pub struct Gyro<V, R>(PhantomData<(V, R)>);

impl<S: System<Vector: Vector>, R: GyroRule> Integrator<S> for Gyro<S::Vector, R> {
    fn new(_like: &S::Vector) -> Self {
        Self(PhantomData)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        let only = R::CARD.only.expect("the card of a gyroscopic rule says what it steps");
        let moments = moments_of(system, t);
        let moments = moments.ok_or(StepFailure::Refused { reason: only.reason })?;
        turn_state(state, |omega| R::step(h, moments, omega))
    }
}

/// Returns the principal moments of a body that turns in space; `None` for any other. An answer counts as an
/// evaluation.
pub(super) fn moments_of<S: System + ?Sized>(system: &S, t: f64) -> Option<DVec3> {
    let mut moments = None;
    system.query(t, Query::Spin(&mut moments));
    moments
}

/// Applies a step to the state of a body that turns in space.
pub(super) fn turn_state<V: Vector>(
    State { q, v }: &mut State<V>,
    step: impl FnOnce(DVec3) -> Turned,
) -> Stepped {
    let (q, v) = (q.components_mut(), v.components_mut());
    let before = Spin::of(q, v);
    let (omega, turn) = step(before.omega)?;
    let attitude = before.attitude * turn;
    Spin { turns: before.turns + vector_of(turn), omega, attitude }.write(q, v);
    Ok(())
}

/// Turns the body by the vector `by` (rad), with its momentum fixed in space.
pub(super) fn turned(moments: DVec3, omega: DVec3, by: DVec3) -> (DVec3, DQuat) {
    carried(moments, omega, turn_by(by))
}

/// Turns the body by a quaternion, with its momentum fixed in space.
pub(super) fn carried(moments: DVec3, omega: DVec3, turn: DQuat) -> (DVec3, DQuat) {
    (seen_from(turn, moments * omega) / moments, turn)
}

/// The momentum of a body and its turn so far, in a step that is divided into turns about its axes.
pub(super) struct Split {
    pub(super) momentum: DVec3,
    pub(super) turn: DQuat,
}

impl Split {
    pub(super) fn new(moments: DVec3, omega: DVec3) -> Self {
        Self { momentum: moments * omega, turn: DQuat::IDENTITY }
    }

    /// Turns about an axis by its momentum times `part`, which leaves that momentum alone.
    pub(super) fn turn(&mut self, axis: usize, part: f64) {
        let turn = turn_by(DVec3::AXES[axis] * (part * self.momentum[axis]));
        self.momentum = seen_from(turn, self.momentum);
        self.turn *= turn;
    }
}

/// Iterations of a fixed point, of which a step that a game would make needs ten.
const MAX_ITERATIONS: u32 = 60;

/// The change of an iteration, relative to the vector, at which it has converged, and at which it stops early.
const CONVERGED: f64 = 1e-13;
const ROUNDING: f64 = 1e-16;

/// Returns the vector that `next` maps to itself, by iteration from `start`.
pub(super) fn fixed_point(
    start: DVec3,
    next: impl Fn(DVec3) -> DVec3,
) -> Result<DVec3, StepFailure> {
    let (mut at, mut change) = (start, f64::INFINITY);
    for _ in 0..MAX_ITERATIONS {
        let found = next(at);
        change = (found - at).abs().max_element() / found.length();
        at = found;
        if change <= ROUNDING || found == DVec3::ZERO {
            return Ok(at);
        }
    }
    if change <= CONVERGED {
        Ok(at)
    } else {
        Err(StepFailure::NewtonFailed { limit: MAX_ITERATIONS })
    }
}
