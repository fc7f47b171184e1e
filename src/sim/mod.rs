//! Mathematics: a state, an equation of motion, and ways to step it.
//!
//! This layer knows no files, clocks, threads, randomness or pixels. Everything stepped is `f64` and
//! uses only `+ - × ÷ √` and `libm`, so that the same inputs give the same bits on every platform,
//! in every build profile.

pub mod bodies;
mod body;
mod body_stepper;
mod double_double;
mod exact_flow;
mod exact_since_start;
pub mod integrators;
pub mod law;
mod parameter;
mod piece;
mod propagator;
mod reference;
mod solver;
pub mod stability;
mod stepper;
mod system;

pub use body_stepper::stepper;
pub use reference::REFERENCE_ACCURACY;
pub use solver::Solver;
pub use stepper::{RecordedTick, Stepper};
pub use system::{Counted, Counts, Evaluation, Recorded, State, System, Vector};
