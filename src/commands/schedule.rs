//! The times of a recording's frames, and the advance of a studio from one frame to the next. These times are computed,
//! and never read from a clock.
//!
//! A slow machine takes longer for a capture, and draws the same frames. The clock drops no time here, since long
//! frames are cut into stretches that it accepts.

use super::error::Error;
use super::frame_names::MAX_FRAMES;
use crate::loops::MAX_FRAME_MS;
use crate::run::race::Observer;
use crate::studio::Studio;

/// Default number of frames per simulated second. It is smooth enough for every scene, with half the files and half the
/// time of 60.
pub(super) const FPS: u32 = 30;

/// Maximum number of frames per simulated second, which is more than any display shows.
pub(super) const MAX_FPS: u32 = 1000;

/// The moments of `frames` frames, with `fps` frames per simulated second. The first frame is at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Schedule {
    pub(super) frames: u32,
    pub(super) fps: u32,
}

const SECOND_NS: u64 = 1_000_000_000;

/// Returns the number of frames in this number of seconds, which is at least one.
pub(super) fn frames_in(seconds: f64, fps: u32) -> Result<u32, Error> {
    let frames = (seconds * f64::from(fps)).round().max(1.0);
    if frames > f64::from(MAX_FRAMES) {
        return Err(Error::mistake(format!(
            "{frames} frames are asked for, and a capture has at most {MAX_FRAMES}; \
             give a lower --fps or fewer --seconds"
        )));
    }
    Ok(frames as u32)
}

impl Schedule {
    /// Returns the time of `frame` in nanoseconds. It is rounded up, so that a tick that is due at that moment is done.
    pub(super) fn time_ns(self, frame: u32) -> u64 {
        (u64::from(frame) * SECOND_NS).div_ceil(u64::from(self.fps))
    }

    /// Returns the tick nearest to the last frame. `studio` must be at its start.
    pub(super) fn ticks(self, studio: &Studio) -> u64 {
        studio.race().nearest_tick(f64::from(self.frames.saturating_sub(1)) / f64::from(self.fps))
    }

    /// Advances a studio to `frame`, and reports each tick to the observer. The studio must be at the previous frame,
    /// or at the start.
    pub(super) fn advance(self, studio: &mut Studio, frame: u32, observer: &mut dyn Observer) {
        let Some(before) = frame.checked_sub(1) else { return };
        let longest = u64::from(MAX_FRAME_MS) * 1_000_000;
        let mut left = self.time_ns(frame) - self.time_ns(before);
        // Time advances in stretches that the clock accepts without dropping ticks.
        while left > 0 {
            let stretch = left.min(longest).min(until_rate_changes(studio));
            let due = studio.advance_in_time(u64::MAX, stretch as i64, &mut || true, observer);
            assert_eq!(due.dropped, 0, "a stretch is no longer than the clock's longest frame");
            left -= stretch;
        }
    }
}

/// Returns the nanoseconds, rounded up, until the next tick at which the tick rate changes.
fn until_rate_changes(studio: &Studio) -> u64 {
    let (tick, clock) = (studio.race().tick(), studio.clock());
    let mut rates = studio.race().rates_to_come();
    let Some((next, _)) = rates.find(|(at, _)| *at > tick) else { return u64::MAX };
    clock.ns_until(next - tick)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Race;
    use crate::scene::Scene;

    #[test]
    fn frames_show_their_moment_under_scripted_tick_rates() {
        let text = "title = 'x'\ntick_hz = 1\nseconds = 9\n[[spring]]\nmass_kg = 1\n\
                    stiffness_n_per_m = 1\n[[command]]\nat_s = 5\ntick_hz = 1000\n\
                    [[command]]\nat_s = 6.5\ntick_hz = 8\n";
        let mut studio = Studio::new(Scene::parse("x.toml", text).unwrap());
        let schedule = Schedule { frames: 301, fps: 30 };
        for frame in 0..schedule.frames {
            schedule.advance(&mut studio, frame, &mut ());
            let present = studio.race().t();
            let next_hz = studio.race().rates_to_come().next();
            let next_hz = next_hz.filter(|(tick, _)| *tick == studio.race().tick());
            let hz = next_hz.map_or(studio.clock().tick_hz(), |(_, hz)| hz);
            let shown = present + studio.clock().alpha() / f64::from(hz);
            let moment = f64::from(frame) / f64::from(schedule.fps);
            assert!((shown - moment).abs() < 1e-6, "frame {frame} shows {shown} s, not {moment} s");
        }
        assert_eq!(schedule.ticks(&Studio::new(studio.scene().clone())), studio.race().tick());
    }

    #[test]
    fn durations_round_to_whole_frames_with_at_least_one() {
        assert_eq!(frames_in(20.0, 30).unwrap(), 600);
        assert_eq!(frames_in(0.0, 30).unwrap(), 1);
        assert_eq!(frames_in(0.05, 30).unwrap(), 2);
        assert!(frames_in(3e7, 1000).is_err());
    }

    /// An observer that counts ticks.
    struct Ticks(u64);

    impl Observer for Ticks {
        fn ticked(&mut self, _race: &Race) {
            self.0 += 1;
        }
    }

    #[test]
    fn each_frame_runs_exactly_the_due_ticks() {
        for (tick_hz, fps) in
            [(60_u32, 30_u32), (60, 60), (49, 30), (60, 24), (7, 1), (10_000, 3), (1, 1000)]
        {
            let mut scene = Scene::built_in("spring").unwrap();
            scene.tick_hz = tick_hz.into();
            let mut studio = Studio::new(scene);
            let schedule = Schedule { frames: 2 * fps, fps };
            let mut seen = Ticks(0);
            for frame in 0..=schedule.frames {
                schedule.advance(&mut studio, frame, &mut seen);
                let due = u64::from(frame) * u64::from(tick_hz) / u64::from(fps);
                assert_eq!(studio.race().tick(), due, "frame {frame}, {tick_hz} Hz, {fps} fps");
                assert_eq!(seen.0, due);
            }
        }
    }
}
