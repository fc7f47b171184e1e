//! A game whose frames take now more time, now less, and wait for the display in a queue.

use super::noise::Noise;
use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// The seed of the noise.
pub(super) const SEED: u64 = 9;

/// One frame in so many, by chance, is slow.
const SLOW_IN: i64 = 64;

/// Frames take 0.5 to 1.1 refreshes, and a slow one up to 2 more. A picture is displayed at the first refresh when it is
/// ready and none before it waits; the game runs ahead by one waiting picture, so that in good times the latency is two
/// refreshes.
#[derive(Clone, Copy)]
pub(super) struct Jitter {
    refresh: RefreshRate,
    began_ns: i64,
    /// The refresh at which the last picture was displayed.
    shown: u64,
    noise: Noise,
}

impl Jitter {
    /// The pattern at its first frame.
    pub(super) fn new(refresh: RefreshRate) -> Self {
        Self { refresh, began_ns: 0, shown: 0, noise: Noise::new(SEED) }
    }

    fn work_ns(&mut self) -> i64 {
        let period = self.refresh.refresh_ns(1);
        let part = 3 * period / 10;
        let usual = period / 2 + self.noise.up_to(part) + self.noise.up_to(part);
        let slow = self.noise.up_to(SLOW_IN - 1) == 0;
        usual + if slow { self.noise.up_to(2 * period) } else { 0 }
    }
}

impl Pattern for Jitter {
    fn next(&mut self, _steps: u32) -> Frame {
        let began_ns = self.began_ns;
        let ready = began_ns + self.work_ns();
        let before = self.shown;
        self.shown += 1;
        while self.refresh.refresh_ns(self.shown) < ready {
            self.shown += 1;
        }
        // The place in the queue is free again when the picture before this one goes up.
        self.began_ns = ready.max(self.refresh.refresh_ns(before));
        Frame { began_ns, displayed_ns: Some(self.refresh.refresh_ns(self.shown)) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
