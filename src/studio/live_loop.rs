//! What the studio's own loop did in its last frames.

use std::collections::VecDeque;

/// The frames that are remembered: ten seconds at 60 Hz.
const MAX_FRAMES: usize = 600;

/// A frame of the studio's own loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveFrame {
    /// How long the frame before it took, in nanoseconds.
    pub duration_ns: i64,
    /// The ticks that it made.
    pub ticks: u32,
    /// The ticks that it dropped.
    pub dropped: u64,
    /// The change of the moment shown minus that of real time, in milliseconds of real time. The moment of display is not
    /// known: frames count as displayed when they begin.
    pub animation_error_ms: f64,
}

/// The last frames of the studio's own loop, the latest at the end.
#[derive(Clone, Debug)]
pub struct LiveLoop {
    frames: VecDeque<LiveFrame>,
    /// The moment that the last frame showed, in seconds.
    shown_s: Option<f64>,
}

impl Default for LiveLoop {
    /// No frame, and room for all: adding one allocates nothing.
    fn default() -> Self {
        Self { frames: VecDeque::with_capacity(MAX_FRAMES), shown_s: None }
    }
}

impl LiveLoop {
    /// The frames, the latest at the end.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &LiveFrame> + Clone {
        self.frames.iter()
    }

    /// Adds a frame that shows the moment `shown_s` (s) at `speed` times real time.
    pub(super) fn add(&mut self, frame: LiveFrame, shown_s: f64, speed: f64) {
        let before_s = self.shown_s.replace(shown_s);
        let progress_ms = before_s.map(|before_s| 1000.0 * (shown_s - before_s) / speed);
        let passed_ms = frame.duration_ns as f64 / 1e6;
        let animation_error_ms = progress_ms.map_or(0.0, |progress_ms| progress_ms - passed_ms);
        if self.frames.len() == MAX_FRAMES {
            self.frames.pop_front();
        }
        self.frames.push_back(LiveFrame { animation_error_ms, ..frame });
    }

    /// Forgets the moment shown, which has jumped.
    pub(super) fn jump(&mut self) {
        self.shown_s = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: LiveFrame =
        LiveFrame { duration_ns: 10_000_000, ticks: 1, dropped: 0, animation_error_ms: 0.0 };

    #[test]
    fn a_moment_that_keeps_up_with_real_time_has_no_error_and_a_jump_has_none_either() {
        let mut live = LiveLoop::default();
        for shown_s in [0.0, 0.02, 0.04] {
            live.add(FRAME, shown_s, 2.0);
        }
        live.add(FRAME, 0.05, 2.0);
        live.jump();
        live.add(FRAME, 7.0, 2.0);
        let errors: Vec<f64> = live.frames().map(|frame| frame.animation_error_ms).collect();
        let expected = [0.0, 0.0, 0.0, -5.0, 0.0];
        for (error, expected) in errors.iter().zip(expected) {
            assert!((error - expected).abs() < 1e-9, "{errors:?}");
        }
        assert_eq!(errors.len(), expected.len());
    }

    #[test]
    fn the_last_ten_seconds_are_kept() {
        let mut live = LiveLoop::default();
        (0..2 * MAX_FRAMES).for_each(|_| live.add(FRAME, 0.0, 1.0));
        assert_eq!(live.frames().len(), MAX_FRAMES);
    }
}
