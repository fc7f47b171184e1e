//! An even display, and a game that is ready for every refresh.

use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// Every frame begins and is displayed at a refresh.
#[derive(Clone, Copy)]
pub(super) struct Steady {
    refresh: RefreshRate,
    next: u64,
}

impl Steady {
    /// The pattern at its first refresh.
    pub(super) fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0 }
    }
}

impl Pattern for Steady {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        self.next += 1;
        Frame { began_ns: at, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
