//! Mathematics: a state, an equation of motion, and ways to step it.
//!
//! This layer knows no files, clocks, threads, randomness or pixels. Everything stepped is `f64` and
//! uses only `+ - × ÷ √` and `libm`, so that the same inputs give the same bits on every platform,
//! in every build profile.

pub mod bodies;
mod double_double;
mod drive;
mod driven;
mod exact_flow;
pub mod integrators;
mod reference;
mod solver;
pub mod stability;
mod stepper;
mod system;

pub use driven::stepper;
pub use reference::REFERENCE_ACCURACY;
pub use solver::Solver;
pub use stepper::Stepper;
pub use system::{Counted, Counts, State, System, Vector};
