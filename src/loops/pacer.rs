//! A policy at work, and the time that it has simulated.
//!
//! No time is lost in silence: the time of all frames is simulated, dropped or owed, and the pacer counts each. A loop
//! that drops time runs in slow motion, and one that owes time is late.

use std::sync::Arc;

use super::lines::Lines;
use super::policy::{Build, Excess, FrameLimits, LongFrame, PolicyCard, Steps};
use super::replay::Replay;
use super::time_base::TimeBase;
use crate::run::race::Interpolation;

/// A policy at work.
#[derive(Clone)]
enum Policy {
    Lines(Box<Lines>),
    Replay(Replay),
}

/// A game loop, which decides for each frame on the steps and the moment to show. Times are in the unit of its
/// [`TimeBase`].
#[derive(Clone)]
pub struct Pacer {
    card: Arc<PolicyCard>,
    base: TimeBase,
    policy: Policy,
    /// Maximum frame duration, if one is set.
    longest: Option<i128>,
    long_frame: Option<LongFrame>,
    /// The last frame that was not long, in nanoseconds.
    last_ns: i64,
    excess: Excess,
    /// Time of ticks beyond the maximum, which the next frame counts.
    kept: i128,
    passed: i128,
    simulated: i128,
    dropped: i128,
}

impl Pacer {
    /// Creates the loop before its first frame.
    pub fn new(card: &Arc<PolicyCard>, base: TimeBase) -> Self {
        Self::limited(card, base, FrameLimits::default())
    }

    /// Like [`new`](Self::new), with limits on the work in a frame.
    pub fn limited(card: &Arc<PolicyCard>, base: TimeBase, limits: FrameLimits) -> Self {
        let policy = match &card.build {
            Build::Replay(moments_ms) => Policy::Replay(Replay::new(moments_ms.clone(), base)),
            Build::Lines(text) => Policy::Lines(Box::new(Lines::new(text.clone(), base, limits))),
        };
        let longest = limits.max_frame_ms.map(|ms| base.nanoseconds(i64::from(ms) * 1_000_000));
        let FrameLimits { long_frame, excess, .. } = limits;
        Self {
            card: card.clone(),
            base,
            policy,
            longest,
            long_frame,
            last_ns: 0,
            excess,
            kept: 0,
            passed: 0,
            simulated: 0,
            dropped: 0,
        }
    }

    /// Returns the card of the policy.
    pub fn card(&self) -> &PolicyCard {
        &self.card
    }
    /// Returns the loop's unit of time.
    pub fn base(&self) -> TimeBase {
        self.base
    }
    /// Returns the simulated time.
    pub fn simulated(&self) -> i128 {
        self.simulated
    }
    /// Returns the real time of all frames.
    pub fn passed(&self) -> i128 {
        self.passed
    }
    /// Returns the length of a tick.
    pub fn tick(&self) -> i128 {
        match &self.policy {
            Policy::Lines(lines) => lines.tick(),
            Policy::Replay(_) => self.base.tick(),
        }
    }
    /// Returns the dropped time.
    pub fn dropped(&self) -> i128 {
        self.dropped
    }
    /// Returns the time that is neither simulated nor dropped; negative if the simulation is ahead.
    pub fn owed(&self) -> i128 {
        self.passed - self.simulated - self.dropped
    }

    /// Decides on the steps of a frame. `duration_ns` is the duration of the last frame in nanoseconds; a negative
    /// one counts as 0.
    pub fn frame(&mut self, duration_ns: i64) -> Steps {
        self.frame_in_ms(duration_ns, duration_ns as f64 / 1e6)
    }

    /// Decides on the steps of a frame like [`frame`](Self::frame). A loop of lines takes its duration in milliseconds,
    /// which may be negative.
    pub fn frame_in_ms(&mut self, duration_ns: i64, ms: f64) -> Steps {
        if self.card.is_from_outside() || self.card.is_log() {
            let duration = self.base.nanoseconds(duration_ns);
            let steps = self.decide(duration, ms);
            self.passed += duration;
            self.simulated += steps.span;
            self.dropped += steps.dropped;
            return steps;
        }
        let duration = self.base.nanoseconds(duration_ns.max(0));
        let counted_ns = self.counted_ns(duration_ns.max(0));
        let counted = self.base.nanoseconds(counted_ns);
        let counted = self.longest.map_or(counted, |longest| counted.min(longest));
        let mut steps = self.decide(counted + self.kept, ms);
        if self.excess == Excess::Keep {
            self.kept = std::mem::take(&mut steps.dropped);
        }
        steps.dropped += duration - counted;
        self.passed += duration;
        self.simulated += steps.span;
        self.dropped += steps.dropped;
        steps
    }

    fn decide(&mut self, duration: i128, ms: f64) -> Steps {
        match &mut self.policy {
            Policy::Lines(lines) => lines.frame(duration, ms),
            Policy::Replay(replay) => replay.frame(duration),
        }
    }

    /// Returns the time since the last tick, for drawing between ticks.
    fn since_tick(&self) -> i128 {
        match &self.policy {
            Policy::Lines(lines) => lines.owed(),
            Policy::Replay(_) => 0,
        }
    }

    /// Returns the duration in nanoseconds with which a frame counts.
    fn counted_ns(&mut self, duration_ns: i64) -> i64 {
        let over = match self.long_frame {
            Some(
                LongFrame::Clamp(over) | LongFrame::Replace { over, .. } | LongFrame::Last(over),
            ) => over,
            None => return duration_ns,
        };
        match self.long_frame {
            Some(LongFrame::Replace { by, .. }) if duration_ns > over => by,
            Some(LongFrame::Last(_)) if duration_ns > over => self.last_ns,
            _ => {
                self.last_ns = duration_ns.min(over);
                self.last_ns
            }
        }
    }

    /// Returns the position of the picture between the last tick and the next. It is in [0, 1] for policies that draw
    /// between ticks, in [-1/2, 3/2) under `hysteresis`, and 0 for policies without ticks.
    pub fn alpha(&self) -> f64 {
        self.since_tick() as f64 / self.tick() as f64
    }

    /// Returns the simulated moment in the picture. With interpolation, this moment begins one tick before the start.
    pub fn drawn_moment(&self) -> i128 {
        let now = self.simulated + self.since_tick();
        match self.card.drawing {
            Interpolation::Raw if !self.card.has_render_tick => self.simulated,
            Interpolation::Raw | Interpolation::Extrapolated => now,
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                now - self.tick()
            }
        }
    }
}
