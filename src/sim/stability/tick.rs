//! A tick.

use crate::sim::integrators::Method;

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
