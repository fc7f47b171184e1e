//! How fast frames come and simulated time goes, over the last half second.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use crate::lab::Pace;

/// Long enough for a steady figure, short enough to follow a change.
const SPAN: Duration = Duration::from_millis(500);

/// Measures the pace of frames.
#[derive(Debug, Default)]
pub(super) struct Meter {
    /// When recent frames began, and the simulated time they showed.
    frames: VecDeque<(Instant, f64)>,
    any: bool,
}

impl Meter {
    /// Whether no frame was measured before this call.
    pub(super) fn first_frame(&mut self) -> bool {
        !std::mem::replace(&mut self.any, true)
    }

    /// Takes in a frame that began at `now` and showed simulated time `t`.
    pub(super) fn frame(&mut self, now: Instant, t: f64) {
        // A restart or another scene: time went back.
        if self.frames.back().is_some_and(|&(_, last)| t < last) {
            self.frames.clear();
        }
        self.frames.push_back((now, t));
        while self.frames.front().is_some_and(|&(first, _)| now.duration_since(first) > SPAN) {
            self.frames.pop_front();
        }
    }

    /// The pace, once there are two frames to tell it from.
    pub(super) fn pace(&self) -> Option<Pace> {
        let (&(first, from), &(last, to)) = (self.frames.front()?, self.frames.back()?);
        let seconds = last.duration_since(first).as_secs_f64();
        (seconds > 0.0).then(|| Pace {
            frames_per_second: (self.frames.len() - 1) as f64 / seconds,
            real_time_factor: (to - from) / seconds,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_meter_tells_frame_rate_and_real_time_factor() {
        let mut meter = Meter::default();
        let start = Instant::now();
        assert_eq!(meter.pace(), None);
        for i in 0..200_u32 {
            meter.frame(start + Duration::from_millis(20) * i, 0.01 * f64::from(i));
        }
        let pace = meter.pace().unwrap();
        assert!((pace.frames_per_second - 50.0).abs() < 1e-6, "{pace:?}");
        assert!((pace.real_time_factor - 0.5).abs() < 1e-6, "{pace:?}");
        meter.frame(start + Duration::from_secs(5), 0.0);
        assert_eq!(meter.pace(), None);
    }
}
