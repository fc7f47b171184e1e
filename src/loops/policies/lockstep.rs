//! One tick a frame, however long it was.

use crate::loops::policy::{Policy, Steps};

/// One tick a frame: the game is as fast as the display.
#[derive(Clone, Copy)]
pub(super) struct Lockstep {
    pub(super) tick: i128,
}

impl Policy for Lockstep {
    fn frame(&mut self, _duration: i128) -> Steps {
        Steps::one(self.tick)
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}
