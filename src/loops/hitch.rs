//! The response of a loop to one long frame among even ones.

use std::fmt;
use std::sync::Arc;

use super::pacer::Pacer;
use super::policy::{FrameLimits, PolicyCard};
use super::time_base::TimeBase;
use crate::sim::number::{counted, round};

/// Even frames before the hitch, after which every loop is in its stride, and as many after it, within which a loop may
/// catch up.
const AROUND: u32 = 2000;

/// The response of a loop to a hitch. Times are in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hitch {
    /// Duration of the long frame.
    pub ms: f64,
    /// Simulated time of the long frame.
    pub jump_ms: f64,
    /// Frames after it that simulate half a tick more than they last.
    pub fast_frames: u32,
    /// Simulated time that is missing in the end; negative for a game that is ahead.
    pub lost_ms: f64,
    /// Length of a tick.
    pub tick_ms: f64,
}

impl Hitch {
    /// Measures the response to a frame of `ms` milliseconds on a display.
    pub fn of(card: &Arc<PolicyCard>, base: TimeBase, limits: FrameLimits, ms: f64) -> Self {
        let mut pacer = Pacer::limited(card, base, limits);
        let even_ms = base.milliseconds(base.refresh());
        let frame = |pacer: &mut Pacer, ms: f64| pacer.frame_in_ms((ms * 1e6).round() as i64, ms);
        frame(&mut pacer, 0.0);
        // The mean of the lag over some frames is free of flutter.
        let lag = |pacer: &mut Pacer| {
            let sum: i128 = (0..100)
                .map(|_| {
                    frame(pacer, even_ms);
                    pacer.passed() - pacer.simulated()
                })
                .sum();
            base.milliseconds(sum / 100)
        };
        // Two ticks after none are flutter, and a regular double tick is there without a hitch too.
        let fast = |pacer: &mut Pacer| {
            let mut before_ms = 2.0 * even_ms;
            let is_fast = |_: &u32| {
                let step_ms = base.milliseconds(frame(pacer, even_ms).span);
                let pair_ms = step_ms + std::mem::replace(&mut before_ms, step_ms);
                step_ms > 1.4 * even_ms && pair_ms > 2.4 * even_ms
            };
            (0..AROUND).filter(is_fast).count() as u32
        };
        let usual = fast(&mut pacer);
        let before_ms = lag(&mut pacer);
        let slope_ms = lag(&mut pacer) - before_ms;
        let jump_ms = base.milliseconds(frame(&mut pacer, ms).span);
        let tick_ms = base.milliseconds(pacer.tick());
        let after = fast(&mut pacer);
        // A loop that is always too fast has no fast-forward, and a hitch may shift regular double ticks.
        let fast_frames = match usual {
            0 => after,
            _ if 2 * usual > AROUND => 0,
            _ => after.saturating_sub(usual + 1),
        };
        let frames = f64::from(AROUND + 200) / 100.0;
        let lost_ms = lag(&mut pacer) - before_ms - slope_ms * frames;
        Self { ms, jump_ms, fast_frames, lost_ms, tick_ms }
    }
}

impl fmt::Display for Hitch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { ms, jump_ms, fast_frames, lost_ms, tick_ms } = *self;
        let lost = match lost_ms {
            _ if lost_ms.abs() < 1.5 * tick_ms.max(10.0) => String::new(),
            _ if lost_ms > 0.0 => format!(", {} ms are lost", round(lost_ms, 4)),
            _ => format!(", {} ms too many", round(-lost_ms, 4)),
        };
        let jumps = jump_ms > 2.5 * tick_ms.min(20.0) || jump_ms > 0.5 * ms;
        match (jumps, fast_frames) {
            (false, 0) => write!(f, "nothing{lost}"),
            (true, 0) => write!(f, "a jump of {} ms{lost}", round(jump_ms, 4)),
            (false, fast) => write!(f, "fast-forward for {}{lost}", counted(fast, "frame")),
            (true, fast) => {
                let jump = round(jump_ms, 4);
                write!(f, "a jump of {jump} ms, fast-forward for {}{lost}", counted(fast, "frame"))
            }
        }
    }
}
