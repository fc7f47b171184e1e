//! Steps a scene's bodies under one method in a game loop.

use super::pacer::Pacer;
use super::policy::Steps;
use crate::run::race::Lane;

/// A lane in a game loop.
#[derive(Clone)]
pub struct PacedLane {
    pacer: Pacer,
    lane: Lane,
    /// The drawn copy of the lane, in a loop with a render tick.
    ahead: Option<Lane>,
    /// Evaluations by all drawn copies so far.
    evaluations_ahead: u64,
    steps: u64,
    /// Length of the last step in seconds; at the start, the length of a tick.
    last_step_s: f64,
}

impl PacedLane {
    /// Puts a lane at its start into a loop before its first frame.
    pub fn new(pacer: Pacer, lane: Lane) -> Self {
        let last_step_s = pacer.base().seconds(pacer.base().tick());
        Self { pacer, lane, ahead: None, evaluations_ahead: 0, steps: 0, last_step_s }
    }

    /// Returns the game loop.
    pub fn pacer(&self) -> &Pacer {
        &self.pacer
    }
    /// Returns the lane with the bodies.
    pub fn lane(&self) -> &Lane {
        &self.lane
    }
    /// Returns the number of steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Returns the evaluations of accelerations so far, including those of drawn copies.
    pub fn evaluations(&self) -> u64 {
        self.lane.evaluations() + self.evaluations_ahead
    }

    /// Makes the steps of a frame that lasted `duration_ns` nanoseconds, or `ms` milliseconds on a clock in double
    /// precision. Before each step it calls `before_step` with the number of steps made and the time in seconds.
    pub fn frame(
        &mut self,
        duration_ns: i64,
        ms: f64,
        mut before_step: impl FnMut(u64, f64, &mut Lane),
    ) -> Steps {
        let from = self.pacer.simulated();
        let steps = self.pacer.frame_in_ms(duration_ns, ms);
        let base = self.pacer.base();
        let edge = |i: u32| from + steps.span * i128::from(i) / i128::from(steps.count.max(1));
        for i in 0..steps.count {
            let (t, h) = (base.seconds(edge(i)), base.seconds(edge(i + 1) - edge(i)));
            before_step(self.steps, t, &mut self.lane);
            if h != 0.0 {
                self.lane.tick(self.steps, t, h);
            }
            self.steps += 1;
            self.last_step_s = h;
        }
        let (t, owed) =
            (self.pacer.simulated(), self.pacer.drawn_moment() - self.pacer.simulated());
        let has_ahead = self.pacer.card().has_render_tick && owed > 0;
        self.ahead = has_ahead.then(|| {
            let mut ahead = self.lane.clone();
            ahead.tick(self.steps, base.seconds(t), base.seconds(owed));
            self.evaluations_ahead += ahead.evaluations() - self.lane.evaluations();
            ahead
        });
        steps
    }

    /// Returns the coordinates in the picture of the body with this index.
    pub fn drawn_coordinates(&self, body: usize) -> Vec<f64> {
        let drawing = self.pacer.card().drawing;
        let lane = self.ahead.as_ref().unwrap_or(&self.lane);
        drawing.coordinates(&lane.bodies()[body], self.pacer.alpha(), self.last_step_s)
    }
}
