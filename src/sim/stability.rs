//! The stability of a method on a body. The map of a step about rest has a growth and frequencies, which are compared
//! with those of the true motion.
//!
//! The acceleration is linearised about rest, which leaves a linear body unchanged. If damping does not couple the
//! normal modes of the body, a method acts on each mode alone; otherwise all coordinates are analysed together. The map
//! of a step covers the state and the method's memory. The map is measured from the method's own steps, never from a
//! formula, so that it is valid for any method with equal steps. Growth that the true motion shares, such as the fall
//! of an upright pendulum, does not count against a method.
//!
//! For a body of many coordinates, power iteration about the body's present state finds only the spectral radius.

use super::integrators::Method;

mod comparison;
mod deviation;
mod modes;
mod power;
mod search;
mod small_motion;
mod spectrum;

pub use comparison::{FOREVER_S, Stability};
pub use modes::{NormalMode, unforced};
pub use power::PowerIteration;
pub use search::{RATES_HZ, RateSearch};
pub use small_motion::{CoupledMotion, NoSmallMotion, SmallMotion, normal_modes};

/// One tick of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Start of the tick, in seconds.
    pub t: f64,
    /// Length of the tick, in seconds.
    pub h: f64,
    /// Number of equal steps.
    pub substeps: u32,
}

impl Tick {
    /// Returns the step that a method repeats in this tick, as a tick of its own, and the number of repetitions. An
    /// engine's substeps share one force, so that its whole tick is one step.
    pub fn repeated(self, method: Option<&Method>) -> (Tick, u32) {
        if method.is_some_and(Method::is_engine) {
            return (self, 1);
        }
        (Tick { h: self.h / f64::from(self.substeps), substeps: 1, ..self }, self.substeps)
    }
}
