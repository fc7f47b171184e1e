//! Measures the frame rate and the ratio of simulated to real time over the last second.

use std::collections::VecDeque;

use super::{Pace, Studio};

/// The shortest span to measure over, in nanoseconds: long enough for a steady figure, short enough to follow a change.
const SPAN_NS: u64 = 1_000_000_000;

/// Measures a driver's frames per second and its real-time factor.
#[derive(Debug, Default)]
pub struct PaceMeter {
    /// When each recent frame began, in nanoseconds, and the simulated time then in seconds, with the part of a tick that
    /// is owed: counted in whole ticks the figure would jump at low rates.
    frames: VecDeque<(u64, f64)>,
    /// The tick rate and the speed of those frames.
    under: (u32, u32),
}

impl PaceMeter {
    /// Adds a frame that began at `now_ns`, in nanoseconds of real time. A pause, a jump in time or a change of rate starts
    /// the measurement again.
    pub fn frame(&mut self, now_ns: u64, studio: &Studio) {
        let under = (studio.clock().tick_hz(), studio.clock().speed_percent());
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

    /// The pace, once a second has been measured.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{Command, RunCommand, StageCommand, Step, ViewCommand};

    /// A studio at this tick rate, its meter, and when the last frame began.
    struct Run(Studio, PaceMeter, u64);

    impl Run {
        fn at(tick_hz: u32) -> Self {
            let mut studio = Studio::new(Scene::built_in("ship").unwrap());
            studio.apply(StageCommand::TickHz(tick_hz));
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
    fn the_pace_is_told_from_a_second_on_and_is_steady_at_any_tick_rate() {
        for tick_hz in [1, 2, 7, 60, 1000] {
            let mut run = Run::at(tick_hz);
            assert_eq!(run.1.pace(), Pace::Unknown);
            let paces = run.frames(400);
            assert!(paces[..50].iter().all(|pace| *pace == Pace::Unknown), "{tick_hz} Hz");
            assert!(paces[50..].iter().all(is_real_time), "{tick_hz} Hz: {:?}", paces[399]);
        }
    }

    #[test]
    fn a_pause_another_speed_and_a_restart_begin_the_measure_again() {
        let mut run = Run::at(60);
        for command in [
            Command::View(ViewCommand::TogglePause),
            Command::Stage(StageCommand::Speed(Step::Next)),
            Command::Stage(StageCommand::TickHz(2)),
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
    fn time_that_is_given_up_shows_in_the_pace() {
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
}
