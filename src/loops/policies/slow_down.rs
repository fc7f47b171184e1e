//! A fixed tick, at most one a frame: where frames are too long, the game is slower.

use crate::loops::policy::{Policy, Steps};

/// An accumulator that gives one tick a frame and keeps at most one more.
#[derive(Clone, Copy)]
pub(super) struct SlowDown {
    tick: i128,
    owed: i128,
}

impl SlowDown {
    pub(super) fn new(tick: i128) -> Self {
        Self { tick, owed: 0 }
    }
}

impl Policy for SlowDown {
    fn frame(&mut self, duration: i128) -> Steps {
        self.owed += duration;
        let span = if self.owed >= self.tick { self.tick } else { 0 };
        let left = self.owed - span;
        // Without the tick that is kept, each frame that timer noise makes long would lose one.
        self.owed = left.min(self.tick);
        Steps { dropped: left - self.owed, ..Steps::one(span) }
    }

    fn owed(&self) -> i128 {
        self.owed
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
