//! Stability of a method on a body: the map of a step about rest, its growth and its frequencies, compared with the true
//! motion.
//!
//! The acceleration of a body is linearised about rest, which changes nothing of a linear body. Where damping does not
//! couple its normal modes, a method acts on each of them alone; otherwise all coordinates are taken together. The map of
//! a step, of the state and of what the method carries from step to step, is found from the method's own steps, never
//! from a formula, so that it holds for any method with equal steps. Growth that the true motion has too, such as
//! the fall of an upright pendulum, is not counted against a method.
//!
//! Of a body of many coordinates the spectral radius alone is found, about its present state, by power iteration.

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
    /// Its start, in seconds.
    pub t: f64,
    /// Its length, in seconds.
    pub h: f64,
    /// Equal steps in it.
    pub substeps: u32,
}

impl Tick {
    /// The step that a method repeats in this tick, as a tick of its own, and how often: an engine's substeps share one
    /// force, so that its whole tick is one step.
    pub fn repeated(self, method: Option<&Method>) -> (Tick, u32) {
        if method.is_some_and(Method::is_engine) {
            return (self, 1);
        }
        (Tick { h: self.h / f64::from(self.substeps), substeps: 1, ..self }, self.substeps)
    }
}
