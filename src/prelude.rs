//! What a game's loop needs, in one import, with [`glam`] in the version whose vectors the systems use.
//!
//! With the feature `lab` it also has bodies, scenes, races and verdicts.

pub use glam;

#[cfg(feature = "lab")]
pub use crate::measure::{Adviser, CRITERIA, Judge, Report, Verdict};
#[cfg(feature = "lab")]
pub use crate::run::{Lane, METRICS, Race, Session};
#[cfg(feature = "lab")]
pub use crate::scene::Mark;
#[cfg(feature = "lab")]
pub use crate::scene::{LaneSpec, Options, SCENES, Scene};
#[cfg(feature = "lab")]
pub use crate::sim::bodies::{BODIES, Extras};
pub use crate::sim::integrators::{
    Family, Integrator, METHODS, Method, StepFailure, custom_integrator, integrator, method,
};
pub use crate::sim::{
    Body, Clock, Due, Elementwise, Input, ParameterOf, Range, Solver, State, Stepper, System,
    Vector, stepper,
};
#[cfg(feature = "window")]
pub use crate::window::Window;
