//! Frames of one refresh each, and now and then a long one.

use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// After every so many frames of one refresh each, one of several: its picture is displayed at the last of them, and the next
/// frame begins after it. So the display sees the long time one frame before the game does.
#[derive(Clone, Copy)]
pub(super) struct LongFrame {
    refresh: RefreshRate,
    /// The frames before a long one.
    short: u64,
    /// The refreshes of a long one, at least 1.
    long: u64,
    /// The refresh at which the next frame begins.
    at: u64,
    /// The frames since the last long one.
    since: u64,
}

impl LongFrame {
    /// A frame of `long` refreshes after every `short` frames of one.
    pub(super) fn new(refresh: RefreshRate, short: u64, long: u64) -> Self {
        Self { refresh, short, long, at: 0, since: 0 }
    }

    /// A frame of `long_ns` after every `short_ns`, both to the next whole refresh.
    pub(super) fn lasting(refresh: RefreshRate, short_ns: i64, long_ns: i64) -> Self {
        let refreshes = |ns| (1..).find(|&n| refresh.refresh_ns(n) >= ns).expect("no end");
        Self::new(refresh, refreshes(short_ns), refreshes(long_ns))
    }
}

impl Pattern for LongFrame {
    fn next(&mut self, _steps: u32) -> Frame {
        let lasts = if self.since == self.short { self.long } else { 1 };
        self.since = if self.since == self.short { 0 } else { self.since + 1 };
        let began = self.at;
        self.at += lasts;
        Frame {
            began_ns: self.refresh.refresh_ns(began),
            displayed_ns: Some(self.refresh.refresh_ns(began + lasts - 1)),
        }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
