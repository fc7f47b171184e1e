//! Whole ticks from an accumulator: the loop of "Fix Your Timestep!", and of Regatta's own window.

use crate::loops::policy::{Policy, Steps};
use crate::loops::time_base::TimeBase;
use crate::sim::{Accumulator, MAX_FRAME_MS, max_ticks};

/// An accumulator that gives whole ticks.
#[derive(Clone, Copy)]
pub(super) struct Fixed {
    tick: i128,
    max_ticks: u32,
    accumulator: Accumulator,
}

impl Fixed {
    /// At most the ticks of [`MAX_FRAME_MS`] in a frame.
    pub(super) fn new(base: TimeBase) -> Self {
        let most = max_ticks(100 * u64::from(base.tick_hz()), MAX_FRAME_MS);
        Self::with_max_ticks(base, most)
    }

    /// At most this many ticks in a frame.
    pub(super) fn with_max_ticks(base: TimeBase, max_ticks: u32) -> Self {
        Self { tick: base.tick(), max_ticks, accumulator: Accumulator::default() }
    }

    /// Forgets the time owed, and returns it.
    pub(super) fn clear(&mut self) -> i128 {
        let owed = self.accumulator.owed();
        self.accumulator.clear();
        owed
    }
}

impl Policy for Fixed {
    fn frame(&mut self, duration: i128) -> Steps {
        let due = self.accumulator.advance(duration, self.tick, self.max_ticks);
        Steps {
            count: due.ticks,
            span: i128::from(due.ticks) * self.tick,
            dropped: i128::from(due.dropped) * self.tick,
        }
    }

    fn owed(&self) -> i128 {
        self.accumulator.owed()
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
