//! A policy at work, and the time that it has simulated.

use super::policy::{FrameLimits, Policy, PolicyCard, Steps};
use super::time_base::TimeBase;
use crate::run::race::Interpolation;

/// A game loop, which decides for each frame on the steps and the moment to show. Times are in the unit of its
/// [`TimeBase`].
#[derive(Clone)]
pub struct Pacer {
    card: &'static PolicyCard,
    base: TimeBase,
    policy: Box<dyn Policy>,
    /// Maximum frame duration, if one is set.
    longest: Option<i128>,
    passed: i128,
    simulated: i128,
    dropped: i128,
}

impl Pacer {
    /// Creates the loop before its first frame.
    pub fn new(card: &'static PolicyCard, base: TimeBase) -> Self {
        Self::limited(card, base, FrameLimits::default())
    }

    /// Like [`new`](Self::new), with limits on the work in a frame.
    pub fn limited(card: &'static PolicyCard, base: TimeBase, limits: FrameLimits) -> Self {
        let policy = (card.build)(base, limits);
        let longest = limits.max_frame_ms.map(|ms| base.nanoseconds(i64::from(ms) * 1_000_000));
        Self { card, base, policy, longest, passed: 0, simulated: 0, dropped: 0 }
    }

    /// Returns the card of the policy.
    pub fn card(&self) -> &'static PolicyCard {
        self.card
    }
    /// Returns the loop's unit of time.
    pub fn base(&self) -> TimeBase {
        self.base
    }
    /// Returns the simulated time.
    pub fn simulated(&self) -> i128 {
        self.simulated
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
        let duration = self.base.nanoseconds(duration_ns.max(0));
        let kept = self.longest.map_or(duration, |longest| duration.min(longest));
        let mut steps = self.policy.frame(kept);
        steps.dropped += duration - kept;
        self.passed += duration;
        self.simulated += steps.span;
        self.dropped += steps.dropped;
        steps
    }

    /// Returns the position of the picture between the last tick and the next. It is in [0, 1] for policies that draw
    /// between ticks, in [-1/2, 3/2) under `hysteresis`, and 0 for policies without ticks.
    pub fn alpha(&self) -> f64 {
        self.policy.owed() as f64 / self.base.tick() as f64
    }

    /// Returns the simulated moment in the picture. With interpolation, this moment begins one tick before the start.
    pub fn drawn_moment(&self) -> i128 {
        let now = self.simulated + self.policy.owed();
        match self.card.drawing {
            Interpolation::Raw if !self.card.has_render_tick => self.simulated,
            Interpolation::Raw | Interpolation::Extrapolated => now,
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                now - self.base.tick()
            }
        }
    }
}
