//! Frames that begin at the edge of a tick, a little before or after it.

use super::noise::Noise;
use crate::loops::frame::Frame;
use crate::loops::time_base::RefreshRate;
use crate::loops::trace::Pattern;

/// The seed of the noise: one whose noise is near 0 in the mean, so that it adds no latency.
pub(super) const SEED: u64 = 4;

/// The most by which a frame begins early or late: what a sleeping thread is woken off by. Below half the shortest refresh,
/// 1 ms, so that each frame begins after the one before.
const MAX_NS: i64 = 499_999;

/// Frame n begins at refresh n plus noise, the first without; it is displayed at refresh n, by design also where that is
/// before it began, so that the mean latency is that of the loop alone.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    refresh: RefreshRate,
    next: u64,
    noise: Noise,
}

impl Edge {
    /// The pattern at its first refresh.
    pub(super) fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0, noise: Noise::new(SEED) }
    }
}

impl Pattern for Edge {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        let off = if self.next == 0 { 0 } else { self.noise.up_to(2 * MAX_NS) - MAX_NS };
        self.next += 1;
        Frame { began_ns: at + off, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}
