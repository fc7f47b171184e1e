//! Everything that a game's loop needs, in one import.
//!
//! With the feature `lab` it also has bodies, scenes, races and verdicts. The vectors of the systems are in
//! [`regatta::glam`](crate::glam), because a game may use another version of glam.

#[cfg(feature = "lab")]
pub use crate::measure::{Adviser, CRITERIA, Judge, Report, Verdict};
#[cfg(feature = "lab")]
pub use crate::run::{Lane, METRICS, Race, Session};
#[cfg(feature = "lab")]
pub use crate::scene::Mark;
#[cfg(feature = "lab")]
pub use crate::scene::{LaneSpec, Options, OptionsError, SCENES, Scene};
#[cfg(feature = "lab")]
pub use crate::sim::bodies::{BODIES, Extras};
pub use crate::sim::integrators::{
    Family, Integrator, METHODS, Method, StepFailure, UnknownMethod, custom_integrator, integrator,
    method, method_or_nearest,
};
pub use crate::sim::{
    Body, Clock, Due, Elementwise, Input, ParameterOf, Range, Solver, State, Stepper, System,
    Vector, stepper,
};
#[cfg(feature = "window")]
pub use crate::window::Window;

/// The names of a loop, beside the prelude of an engine that has a `System` and a `State` of its own, such as Bevy's.
pub mod beside {
    pub use crate::sim::integrators::{Integrator, StepFailure, integrator, method};
    pub use crate::sim::{Clock, Due, State as MotionState, System as MotionSystem};
}
