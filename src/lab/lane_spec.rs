//! The method of a lane, with its substeps and its tolerance.

use crate::sim::Solver;
use crate::sim::integrators::Method;

/// A lane of the race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSpec {
    /// The method of its bodies.
    pub method: &'static Method,
    /// Equal steps per tick, 1 to [`MOST_SUBSTEPS`](super::MOST_SUBSTEPS).
    pub substeps: u32,
    /// Overrides the absolute and the relative tolerance of an adaptive method's card, within
    /// [`TOLERANCES`](super::TOLERANCES); `None` keeps the card's tolerance, and is the only value for other methods.
    pub tolerance: Option<f64>,
}

impl LaneSpec {
    /// A method with its card's tolerance and substeps.
    pub fn plain(method: &'static Method) -> Self {
        Self { method, substeps: method.default_substeps, tolerance: None }
    }

    /// The solver of the lane's bodies.
    pub fn solver(&self) -> Solver {
        match self.tolerance {
            Some(tolerance) => Solver::WithTolerance(self.method, tolerance),
            None => Solver::Method(self.method),
        }
    }
}
