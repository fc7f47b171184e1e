//! Failures of a step.

/// Why a body could not be advanced to the end of its tick.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// An adaptive method used up its substeps before the end of the tick.
    #[error("needs more than {limit} substeps for one tick; raise the tick rate or the tolerance")]
    TooManySubsteps {
        /// The most attempts that a tick may take.
        limit: u32,
    },
    /// The solver of an implicit method did not solve the equations of a step. They may have a solution
    /// nevertheless.
    #[error(
        "the solver gave up on a step's equations: {limit} of Newton's iterations do not solve them, nor does following the solution from a shorter step; raise the tick rate or the substeps"
    )]
    NewtonFailed {
        /// The most iterations that a step may take.
        limit: u32,
    },
    /// A reference solution exceeded its budget of evaluations.
    #[error(
        "has no reference solution: {evaluations} evaluations of the acceleration did not reach the end of a tick; soften the body"
    )]
    ReferenceFailed {
        /// The evaluations spent.
        evaluations: u64,
    },
    /// The method is not for this body; see [`Only`](super::Only).
    #[error("cannot be stepped by this method: {reason}")]
    Refused {
        /// Why, as on the method's card.
        reason: &'static str,
    },
    /// A value became infinite or undefined.
    #[error("left the numbers: {coordinate} is {value}")]
    NotFinite {
        /// The coordinate's name.
        coordinate: &'static str,
        /// Its value.
        value: f64,
    },
    /// A value left the range in which bodies are simulated; see [`crate::lab::ESCAPE`].
    #[error("left the stage: {coordinate} reached {value:.1e}")]
    Escaped {
        /// The coordinate's name.
        coordinate: &'static str,
        /// The value that was too large.
        value: f64,
    },
}
