//! One step a frame, as long as the frame was.

use crate::loops::policy::{Policy, Steps};

/// One step of the frame's duration.
#[derive(Clone, Copy)]
pub(super) struct Variable {
    /// The longest step; the rest of a longer frame is dropped.
    pub(super) longest: Option<i128>,
}

impl Policy for Variable {
    fn frame(&mut self, duration: i128) -> Steps {
        let step = self.longest.map_or(duration, |longest| duration.min(longest));
        Steps { dropped: duration - step, ..Steps::one(step) }
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
