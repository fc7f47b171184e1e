//! The moment that is shown: at rest that of the tick reached, and while time runs one between ticks.

use super::Studio;
use crate::run::race::{Interpolation, LaneBody};

impl Studio {
    /// How bodies are drawn now: at rest as they are at the tick, however they are drawn between ticks.
    fn drawn(&self) -> Interpolation {
        if self.time_runs() { self.display().interpolation } else { Interpolation::Raw }
    }

    /// The moment shown, in ticks from the one reached.
    fn shown_ticks(&self) -> f64 {
        self.drawn().shown(self.clock.alpha())
    }

    /// The moment shown, in seconds. Everything on the stage, and what is said of it, is of this moment.
    pub fn shown_s(&self) -> f64 {
        self.race().t() + self.race().last_step_s() * self.shown_ticks()
    }

    /// The coordinates and the velocities of a lane's body at the moment shown.
    pub fn shown_state(&self, body: &LaneBody) -> (Vec<f64>, Vec<f64>) {
        let (drawn, alpha, h) = (self.drawn(), self.clock.alpha(), self.race().last_step_s());
        (drawn.coordinates(body, alpha, h), drawn.velocities(body, alpha, h))
    }

    /// The true coordinates and velocities of the body at this index of the scene at the moment shown.
    pub fn shown_truth(&self, body: usize) -> (Vec<f64>, Vec<f64>) {
        self.past().truth_between(self.race(), body, 1.0 + self.shown_ticks())
    }

    /// Lets time run on from the moment that was shown at rest.
    pub(super) fn run_on(&mut self) {
        // Where bodies are drawn a tick late, the tick reached is shown when the next one is due.
        match self.display().interpolation {
            Interpolation::Raw | Interpolation::Extrapolated => self.clock.restart(),
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                self.clock.fill();
            }
        }
    }
}
