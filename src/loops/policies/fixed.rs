//! Whole ticks from an accumulator, as in "Fix Your Timestep!" and in Regatta's own window, and a variant that never
//! catches up.

use crate::loops::policy::{FrameLimits, Policy, Steps};
use crate::loops::time_base::TimeBase;
use crate::sim::{Accumulator, MAX_FRAME_MS, max_ticks};

/// An accumulator that yields whole ticks.
#[derive(Clone, Copy)]
pub(super) struct Fixed {
    tick: i128,
    max_ticks: u32,
    accumulator: Accumulator,
}

impl Fixed {
    /// Limits the ticks in a frame to those of the longest frame, which lasts [`MAX_FRAME_MS`] unless another limit is
    /// set.
    pub(super) fn new(base: TimeBase, limits: FrameLimits) -> Self {
        let most = match (limits.long_frame, limits.max_frame_ms) {
            (Some(_), None) => u32::MAX,
            (_, longest_ms) => max_ticks(base.tick_hz(), 100, longest_ms.unwrap_or(MAX_FRAME_MS)),
        };
        Self::with_max_ticks(base, limits.max_ticks.unwrap_or(most))
    }

    /// Limits the ticks in a frame to this number.
    pub(super) fn with_max_ticks(base: TimeBase, max_ticks: u32) -> Self {
        Self { tick: base.tick(), max_ticks, accumulator: Accumulator::default() }
    }

    /// Drops the time owed and returns it.
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
            returned: None,
        }
    }

    fn owed(&self) -> i128 {
        self.accumulator.owed()
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

/// Fixed ticks, at most one in a frame or at most a set number. The time of at most one further tick is kept, so that
/// the game slows down when frames are too long.
#[derive(Clone, Copy)]
pub(super) struct SlowDown {
    tick: i128,
    max_ticks: u32,
    owed: i128,
}

impl SlowDown {
    pub(super) fn new(tick: i128, limits: FrameLimits) -> Self {
        Self { tick, max_ticks: limits.max_ticks.unwrap_or(1), owed: 0 }
    }
}

impl Policy for SlowDown {
    fn frame(&mut self, duration: i128) -> Steps {
        self.owed += duration;
        let count = self.owed.div_euclid(self.tick).min(self.max_ticks.into());
        let span = count * self.tick;
        let left = self.owed - span;
        // If no time were kept, each frame that timer noise lengthens would lose a tick.
        self.owed = left.min(self.tick);
        Steps { count: count as u32, span, dropped: left - self.owed, returned: None }
    }

    fn owed(&self) -> i128 {
        self.owed
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
