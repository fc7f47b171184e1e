//! What a lane is under: a method, and how finely it steps.

use crate::sim::Solver;
use crate::sim::integrators::Method;

/// A lane of the race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSpec {
    /// How its bodies are stepped.
    pub method: &'static Method,
    /// Equal steps in a tick, 1 to [`MOST_SUBSTEPS`](super::MOST_SUBSTEPS).
    pub substeps: u32,
    /// The absolute and the relative error that an adaptive method allows in a substep of its own, within
    /// [`TOLERANCES`](super::TOLERANCES); `None` leaves it at its card's, and does for all other methods.
    pub tolerance: Option<f64>,
}

impl LaneSpec {
    /// A method as its card has it, in one step a tick.
    pub fn plain(method: &'static Method) -> Self {
        Self { method, substeps: 1, tolerance: None }
    }

    /// What carries the lane's bodies forward.
    pub fn solver(&self) -> Solver {
        match self.tolerance {
            Some(tolerance) => Solver::Within(self.method, tolerance),
            None => Solver::Method(self.method),
        }
    }
}
