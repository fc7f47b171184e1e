//! Failures of a step.

use std::fmt;
use std::sync::Arc;

use crate::number::round;

/// The result of a step, which is nothing, or the reason why it failed.
pub type Stepped = Result<(), StepFailure>;

/// The reason why a body could not be advanced to the end of its tick.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepFailure {
    /// An adaptive method used up its substeps before the end of the tick.
    TooManySubsteps {
        /// The maximum number of attempts in a tick.
        limit: u32,
    },
    /// The solver of an implicit method did not converge. The equations may still have a solution.
    NewtonFailed {
        /// The maximum number of iterations in a step.
        limit: u32,
    },
    /// The linear equations of a step were not solved within the step's budget of work.
    LinearSolveFailed,
    /// A reference solution exceeded its budget of evaluations.
    ReferenceFailed {
        /// The number of evaluations spent.
        evaluations: u64,
    },
    /// The force jumps back and forth at the present state, so that the motion has no solution in the usual sense.
    Sticks,
    /// A reference solution would take too much work.
    ReferenceTooExpensive {
        /// The estimated work, in evaluations of a spring for each simulated second.
        work_per_s: f64,
        /// The maximum work of a reference solution, [`MAX_REFERENCE_WORK`].
        ///
        /// [`MAX_REFERENCE_WORK`]: crate::MAX_REFERENCE_WORK
        most: f64,
    },
    /// A body met its walls too often in a step.
    TooManyImpacts {
        /// The maximum number of impacts in a step.
        limit: u32,
    },
    /// The caller asked for an invalid step, whose times are not finite or which has no parts.
    InvalidStep {
        /// The time at the start of the step, in seconds.
        t: f64,
        /// The length of the step, in seconds.
        h: f64,
        /// The number of equal parts.
        substeps: u32,
    },
    /// The method does not step this body; see [`Only`](super::Only).
    Refused {
        /// The reason on the method's card.
        reason: &'static str,
    },
    /// A value became infinite or undefined.
    NotFinite {
        /// The coordinate's name.
        coordinate: Arc<str>,
        /// The value of the coordinate.
        value: f64,
    },
    /// A value left the range of simulated bodies, which is `run::race::ESCAPE`.
    Escaped {
        /// The coordinate's name.
        coordinate: Arc<str>,
        /// The value out of range.
        value: f64,
    },
}

impl StepFailure {
    /// Checks the times and the number of parts of a step.
    #[inline]
    pub(crate) fn check_step(t: f64, h: f64, substeps: u32) -> Stepped {
        if (t + h).is_finite() && substeps > 0 {
            return Ok(());
        }
        Err(Self::InvalidStep { t, h, substeps })
    }

    /// Whether the failure is known before the first step, without any attempt. This is so if a reference solution is
    /// too expensive to try.
    pub fn is_foreseen(&self) -> bool {
        matches!(self, Self::ReferenceTooExpensive { .. })
    }
}

impl std::error::Error for StepFailure {}

impl fmt::Display for StepFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManySubsteps { limit } => write!(
                f,
                "needs more than {limit} substeps for one tick; raise the tick rate or the tolerance"
            ),
            Self::NewtonFailed { limit } => write!(
                f,
                "the solver gave up on a step's equations: {limit} of Newton's iterations do not solve them, nor does \
                 following the solution from a shorter step; raise the tick rate or the substeps"
            ),
            Self::LinearSolveFailed => f.write_str(
                "the solver gave up on a step's linear equations; raise the tick rate or the substeps",
            ),
            Self::ReferenceFailed { evaluations } => write!(
                f,
                "has no reference solution: {evaluations} evaluations of the acceleration did not reach the end of a \
                 tick; soften the body"
            ),
            Self::TooManyImpacts { limit } => write!(f, "met its walls more than {limit} times in a step; raise the tick rate"),
            Self::Sticks => f.write_str(
                "sticks where its force jumps back and forth, as under dry friction at rest, and an equation of motion \
                 has no solution there; make the jump a slope, such as tanh(v/0.01) for sign(v)",
            ),
            Self::ReferenceTooExpensive { work_per_s, most } => write!(
                f,
                "has no reference solution: too many springs for an exact comparison, some {} evaluations per simulated \
                 second, and the limit is {}",
                round(*work_per_s, 1),
                round(*most, 1),
            ),
            Self::InvalidStep { t, h, substeps } => write!(
                f,
                "cannot be stepped from {t} s by {h} s in {substeps} parts: both times must be finite numbers, and the parts \
                 at least one"
            ),
            Self::Refused { reason } => write!(f, "cannot be stepped by this method: {reason}"),
            Self::NotFinite { coordinate, value } => {
                let became = if value.is_nan() { "undefined" } else { "infinite" };
                write!(f, "blew up: {coordinate} became {became}")
            }
            Self::Escaped { coordinate, value } => {
                write!(f, "blew up: {coordinate} reached {}", round(*value, 2))
            }
        }
    }
}
