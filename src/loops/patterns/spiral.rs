//! Steps that cost more time than they simulate: the spiral of death.

use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// What a step costs: 5/4 of a tick at 60 Hz.
const STEP_NS: i64 = 20_800_000;

/// A frame lasts a refresh, or as long as its steps take if that is longer. It is displayed when it begins, since what it
/// will cost is not known then.
#[derive(Clone, Copy)]
pub(super) struct Spiral {
    refresh: RefreshRate,
    /// When the last frame that took too long ended.
    since_ns: i64,
    /// The refreshes since then.
    refreshes: u64,
    begun: bool,
}

impl Spiral {
    /// The pattern at its first frame.
    pub(super) fn new(refresh: RefreshRate) -> Self {
        Self { refresh, since_ns: 0, refreshes: 0, begun: false }
    }

    fn now_ns(&self) -> i64 {
        self.since_ns + self.refresh.refresh_ns(self.refreshes)
    }
}

impl Pattern for Spiral {
    fn next(&mut self, steps: u32) -> Frame {
        let cost = STEP_NS * i64::from(steps);
        if self.begun && cost > self.refresh.refresh_ns(1) {
            (self.since_ns, self.refreshes) = (self.now_ns() + cost, 0);
        } else if self.begun {
            self.refreshes += 1;
        }
        self.begun = true;
        let now = self.now_ns();
        Frame { began_ns: now, displayed_ns: Some(now) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
