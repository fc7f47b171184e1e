//! The names that a game's own loop needs, in one import. The vectors of the systems are in [`glam`], because a game
//! may use another version of it.

pub use crate::integrators::{
    Family, Integrator, METHODS, Method, StepFailure, UnknownMethod, custom_integrator, integrator,
    method, method_or_nearest,
};
pub use crate::{
    Body, Clock, Due, Elementwise, Input, ParameterOf, Range, Solver, State, Stepper, System,
    Vector, stepper,
};

/// The names of a loop, beside the prelude of an engine that has a `System` and a `State` of its own, such as Bevy's.
pub mod beside {
    pub use crate::integrators::{Integrator, StepFailure, integrator, method};
    pub use crate::{Clock, Due, State as MotionState, System as MotionSystem};
}
