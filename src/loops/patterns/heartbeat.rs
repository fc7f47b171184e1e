//! A game whose clock is read unevenly, while its pictures are displayed evenly.

use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// Every second frame begins a quarter of a refresh late, so that frames last 5/4 and 3/4 of a refresh by turns. Frame n is
/// displayed at refresh n, by design also where that is before it began: as with the steady traces, the latency is that
/// of the loop alone.
#[derive(Clone, Copy)]
pub(super) struct Heartbeat {
    refresh: RefreshRate,
    next: u64,
}

impl Heartbeat {
    /// The pattern at its first refresh.
    pub(super) fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0 }
    }
}

impl Pattern for Heartbeat {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        let late = if self.next.is_multiple_of(2) { 0 } else { self.refresh.refresh_ns(1) / 4 };
        self.next += 1;
        Frame { began_ns: at + late, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
