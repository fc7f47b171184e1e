//! The frames of a driver: their rate, the pace of time in them, and a log of the last ten seconds.

use std::collections::VecDeque;

use super::{Pace, Studio};
use crate::sim::TickRate;

/// Minimum span of a measurement, in nanoseconds. It is long enough for a steady figure, and short enough to follow a
/// change.
const SPAN_NS: u64 = 1_000_000_000;

/// Measures a driver's frames per second and real-time factor.
#[derive(Debug, Default)]
pub struct PaceMeter {
    /// Start of each recent frame in nanoseconds, and the simulated time (s) at that start, with the pending part of a
    /// tick. If only whole ticks counted, the figure would jump at low rates.
    frames: VecDeque<(u64, f64)>,
    /// Tick rate and speed under which the frames were measured.
    under: Option<(TickRate, u32)>,
}

impl PaceMeter {
    /// Adds a frame that began at `now_ns` nanoseconds of real time. The measurement starts again after a pause, a jump
    /// in time, or a change of the rate or the speed.
    pub fn frame(&mut self, now_ns: u64, studio: &Studio) {
        let under = Some((studio.clock().tick_hz(), studio.clock().speed_percent()));
        let t = studio.deck.time_with_owed_s();
        let went_back = self.frames.back().is_some_and(|&(_, last)| t < last);
        if !studio.deck.time_runs() || went_back || under != self.under {
            self.frames.clear();
            self.under = under;
        }
        if !studio.deck.time_runs() {
            return;
        }
        self.frames.push_back((now_ns, t));
        while self.frames.get(1).is_some_and(|&(second, _)| now_ns - second >= SPAN_NS) {
            self.frames.pop_front();
        }
    }

    /// Returns the pace, which is unknown before a second of measurement.
    pub fn pace(&self) -> Pace {
        let (Some(&(first, from)), Some(&(last, to))) = (self.frames.front(), self.frames.back())
        else {
            return Pace::Unknown;
        };
        let span_ns = last - first;
        if span_ns < SPAN_NS {
            return Pace::Unknown;
        }
        let seconds = span_ns as f64 / 1e9;
        Pace::Measured {
            frames_per_second: (self.frames.len() - 1) as f64 / seconds,
            real_time_factor: (to - from) / seconds,
        }
    }
}

/// Maximum number of frames to keep. It is ten seconds at 60 Hz.
const MAX_FRAMES: usize = 600;

/// A frame of the studio's own loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveFrame {
    /// Duration of the previous frame, in nanoseconds.
    pub duration_ns: i64,
    /// Number of ticks made in the frame.
    pub ticks: u32,
    /// Number of ticks dropped in the frame.
    pub dropped: u64,
    /// Change of the displayed moment minus the change of real time, in milliseconds of real time. The moment of
    /// display is unknown, so a frame counts as displayed when it begins.
    pub animation_error_ms: f64,
}

/// The last frames of the studio's own loop, oldest first.
#[derive(Clone, Debug)]
pub struct LiveLoop {
    frames: VecDeque<LiveFrame>,
    /// The moment that the last frame displayed, in seconds.
    shown_s: Option<f64>,
}

impl Default for LiveLoop {
    /// Reserves room for all frames, so that adding one does not allocate.
    fn default() -> Self {
        Self { frames: VecDeque::with_capacity(MAX_FRAMES), shown_s: None }
    }
}

impl LiveLoop {
    /// Returns the frames, oldest first.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &LiveFrame> + Clone {
        self.frames.iter()
    }

    /// Adds a frame that displays the moment `shown_s` (s), at `speed` times real time.
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

    /// Forgets the displayed moment after a jump in time.
    pub(super) fn jump(&mut self) {
        self.shown_s = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::{Command, RunCommand, StageCommand, Step, ViewCommand};

    /// A studio at this tick rate, the meter of its pace, and the start of the last frame.
    struct Run(Studio, PaceMeter, u64);

    impl Run {
        fn at(tick_hz: u32) -> Self {
            let mut studio = Studio::new(Scene::built_in("ship").unwrap());
            studio.apply(StageCommand::TickHz(tick_hz.into()));
            Self(studio, PaceMeter::default(), 0)
        }

        /// Draws frames of 20 ms, and returns the pace after each.
        fn frames(&mut self, count: u32) -> Vec<Pace> {
            let Run(studio, meter, now) = self;
            let frames = (0..count).map(|_| {
                *now += 20_000_000;
                studio.advance(20_000_000);
                meter.frame(*now, studio);
                meter.pace()
            });
            frames.collect()
        }
    }

    fn is_real_time(pace: &Pace) -> bool {
        match *pace {
            Pace::Measured { frames_per_second, real_time_factor } => {
                (frames_per_second - 50.0).abs() < 1e-6 && (real_time_factor - 1.0).abs() < 1e-6
            }
            Pace::Unknown => false,
        }
    }

    #[test]
    fn the_pace_is_shown_after_a_second_and_steady_at_any_tick_rate() {
        for tick_hz in [1, 2, 7, 60, 1000] {
            let mut run = Run::at(tick_hz);
            assert_eq!(run.1.pace(), Pace::Unknown);
            let paces = run.frames(400);
            assert!(paces[..50].iter().all(|pace| *pace == Pace::Unknown), "{tick_hz} Hz");
            assert!(paces[50..].iter().all(is_real_time), "{tick_hz} Hz: {:?}", paces[399]);
        }
    }

    #[test]
    fn a_pause_a_new_speed_and_a_restart_reset_the_pace() {
        let mut run = Run::at(60);
        for command in [
            Command::View(ViewCommand::TogglePause),
            Command::Stage(StageCommand::Speed(Step::Next)),
            Command::Stage(StageCommand::TickHz(2.into())),
            Command::Stage(StageCommand::Restart),
        ] {
            assert!(is_real_time(run.frames(60).last().unwrap()));
            run.0.apply(command.clone());
            assert_eq!(run.frames(1), [Pace::Unknown], "{command:?}");
            if command == Command::View(ViewCommand::TogglePause) {
                assert_eq!(run.frames(100), [Pace::Unknown; 100]);
                run.0.apply(command.clone());
            }
            run.0.apply(RunCommand::SpeedPercent(100));
        }
    }

    #[test]
    fn dropped_time_shows_in_the_pace() {
        let mut run = Run::at(60);
        let Run(studio, meter, now) = &mut run;
        for _ in 0..10 {
            *now += 500_000_000;
            studio.advance(500_000_000);
            meter.frame(*now, studio);
        }
        let Pace::Measured { frames_per_second, real_time_factor } = meter.pace() else { panic!() };
        assert!((frames_per_second - 2.0).abs() < 1e-9 && (real_time_factor - 0.5).abs() < 0.02);
    }

    const FRAME: LiveFrame =
        LiveFrame { duration_ns: 10_000_000, ticks: 1, dropped: 0, animation_error_ms: 0.0 };

    #[test]
    fn frames_in_real_time_and_jumps_have_no_animation_error() {
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
    fn frame_times_are_kept_for_ten_seconds() {
        let mut live = LiveLoop::default();
        (0..2 * MAX_FRAMES).for_each(|_| live.add(FRAME, 0.0, 1.0));
        assert_eq!(live.frames().len(), MAX_FRAMES);
    }
}
