//! What the studio's own loop did in its last frames.

use std::collections::VecDeque;

use crate::loops::{Frame, FrameTrace, RefreshRate};

/// The frames that are remembered: ten seconds at 60 Hz.
const MAX_FRAMES: usize = 600;
/// The fewest that make a trace.
const MIN_FRAMES: usize = 60;

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

    /// The trace of these frames, displayed when they begin, if there are enough.
    pub(super) fn trace(&self) -> Option<FrameTrace> {
        let mut durations: Vec<i64> = self.frames.iter().map(|frame| frame.duration_ns).collect();
        if durations.len() < MIN_FRAMES {
            return None;
        }
        let starts = self.frames.iter().scan(0, |began_ns, frame| {
            *began_ns += frame.duration_ns.max(0);
            Some(*began_ns)
        });
        let first = self.frames[0].duration_ns.max(0);
        let frames = starts.map(|began_ns| began_ns - first);
        let frames = frames.map(|began_ns| Frame { began_ns, displayed_ns: Some(began_ns) });
        let frames = frames.collect();
        durations.sort_unstable();
        let refresh = RefreshRate::of_period(durations[durations.len() / 2]);
        Some(FrameTrace::recorded("live", refresh, frames))
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
    fn it_is_a_trace_once_a_second_was_measured_and_never_grows_beyond_ten() {
        let mut live = LiveLoop::default();
        assert!(live.trace().is_none());
        (0..2 * MAX_FRAMES).for_each(|_| live.add(FRAME, 0.0, 1.0));
        assert_eq!(live.frames().len(), MAX_FRAMES);
        let trace = live.trace().unwrap();
        assert_eq!((trace.name(), trace.refresh().hz()), ("live", 100.0));
        let mut frames = trace.frames();
        let began = |frame: Option<Frame>| frame.unwrap().began_ns;
        assert_eq!([began(frames.next(0)), began(frames.next(0))], [0, 10_000_000]);
    }
}
