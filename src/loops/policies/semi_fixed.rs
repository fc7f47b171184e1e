//! The frame's duration in equal parts.

use crate::loops::policy::{Policy, Steps};

/// The most steps in a frame; those of a longer one are longer than a tick.
const MAX_STEPS: i128 = 6;

/// The fewest equal steps of at most a tick.
#[derive(Clone, Copy)]
pub(super) struct SemiFixed {
    pub(super) tick: i128,
}

impl Policy for SemiFixed {
    fn frame(&mut self, duration: i128) -> Steps {
        let fewest = -(-duration).div_euclid(self.tick);
        Steps { count: fewest.min(MAX_STEPS) as u32, span: duration, dropped: 0 }
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
