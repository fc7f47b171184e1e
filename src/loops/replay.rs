//! A log at work as a loop.

use std::sync::Arc;

use super::policy::Steps;
use super::time_base::TimeBase;

/// Steps by the difference of a log's moments.
#[derive(Clone)]
pub(super) struct Replay {
    base: TimeBase,
    moments_ms: Arc<[f64]>,
    next: usize,
}

impl Replay {
    pub(super) fn new(moments_ms: Arc<[f64]>, base: TimeBase) -> Self {
        Self { base, moments_ms, next: 0 }
    }

    fn moment(&self, index: usize) -> Option<i128> {
        let millisecond = self.base.nanoseconds(1_000_000) as f64;
        self.moments_ms.get(index).map(|ms| (ms * millisecond).round() as i128)
    }

    /// Returns the step of a frame.
    pub(super) fn frame(&mut self, duration: i128) -> Steps {
        let before = self.next.checked_sub(1).and_then(|index| self.moment(index));
        let span =
            self.moment(self.next).zip(before).map_or(duration, |(now, before)| now - before);
        self.next += 1;
        Steps { count: u32::from(span != 0), span, ..Steps::default() }
    }
}
