//! Mathematics: a state, an equation of motion, and ways to step it.
//!
//! This layer knows no files, wall clocks or pixels; threads only share loops, in `cores`, and change no bit.
//! Everything stepped is `f64` and uses only `+ - × ÷ √` and `libm`, so that the same inputs give the same bits on
//! every platform, in every build profile.

mod accumulator;
#[cfg(feature = "batch")]
pub mod batch;
#[cfg(feature = "lab")]
pub(crate) mod bisection;
#[cfg(feature = "lab")]
pub mod bodies;
mod body;
mod body_stepper;
mod clock;
#[cfg(feature = "lab")]
pub mod conformance;
mod cores;
#[cfg(feature = "lab")]
mod curve;
mod difference;
mod double_double;
mod exact_flow;
mod exact_since_start;
pub mod integrators;
#[cfg(feature = "lab")]
pub mod law;
#[cfg(feature = "lab")]
mod least_squares;
#[cfg(feature = "lab")]
mod net_plan;
pub mod number;
mod parameter;
mod piece;
mod propagator;
mod reference;
mod solver;
#[cfg(feature = "lab")]
pub mod stability;
mod state;
mod stepper;
mod system;
mod vec_system;
#[cfg(feature = "lab")]
mod xor_shift;

#[cfg(feature = "lab")]
pub(crate) use accumulator::max_ticks;
pub use accumulator::{Accumulator, Due, MAX_FRAME_MS};
pub use body::{Body, Input};
pub use body_stepper::stepper;
pub use clock::{Clock, TickRateError};
#[cfg(feature = "lab")]
pub use least_squares::least_squares;
pub use parameter::{Acts, Fault, MAX_POINTS, MAX_VALUE, Parameter, ParameterOf, Range, Text};
pub use piece::{Distances, MAX_SWITCHES, NO_BOUNDARIES, Piece};
pub use reference::{MAX_REFERENCE_WORK, REFERENCE_ACCURACY};
pub use solver::Solver;
pub use state::{Elementwise, State, Vector};
pub use stepper::{Change, PlacedBody, RecordedTick, Stepper};
pub use system::{
    BodyClass, Counted, Coupling, EngineSettings, Evaluation, Pursuit, Query, StateOf, System,
};
