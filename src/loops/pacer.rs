//! A loop at work: a rule with the time that it has simulated.

use super::policy::{FrameLimits, Policy, PolicyCard, Steps};
use super::time_base::TimeBase;
use crate::run::race::Interpolation;

/// A game loop: frames go in, steps and the moment to show come out. Times are in the unit of its [`TimeBase`].
#[derive(Clone)]
pub struct Pacer {
    card: &'static PolicyCard,
    base: TimeBase,
    policy: Box<dyn Policy>,
    /// The longest frame, if one is set.
    longest: Option<i128>,
    passed: i128,
    simulated: i128,
    dropped: i128,
}

impl Pacer {
    /// The loop before its first frame.
    pub fn new(card: &'static PolicyCard, base: TimeBase) -> Self {
        Self::limited(card, base, FrameLimits::default())
    }

    /// The same loop, which simulates at most so much in a frame.
    pub fn limited(card: &'static PolicyCard, base: TimeBase, limits: FrameLimits) -> Self {
        let policy = (card.build)(base, limits);
        let longest = limits.max_frame_ms.map(|ms| base.nanoseconds(i64::from(ms) * 1_000_000));
        Self { card, base, policy, longest, passed: 0, simulated: 0, dropped: 0 }
    }

    /// What is known of its rule.
    pub fn card(&self) -> &'static PolicyCard {
        self.card
    }
    /// Its unit of time.
    pub fn base(&self) -> TimeBase {
        self.base
    }
    /// The time simulated.
    pub fn simulated(&self) -> i128 {
        self.simulated
    }
    /// The time given up.
    pub fn dropped(&self) -> i128 {
        self.dropped
    }
    /// The time of the frames so far that is neither simulated nor given up; negative where the simulation is ahead.
    pub fn owed(&self) -> i128 {
        self.passed - self.simulated - self.dropped
    }

    /// Decides what a frame simulates. `duration_ns` is that of the last frame, in nanoseconds; a negative one counts as 0.
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

    /// How far the picture is from the last tick to the next: in [0, 1] where it is drawn between them, in [-1/2, 3/2) under
    /// `hysteresis`, and 0 under a rule that has no ticks.
    pub fn alpha(&self) -> f64 {
        self.policy.owed() as f64 / self.base.tick() as f64
    }

    /// The simulated moment that the picture shows. Interpolation shows one a tick before the first, too.
    pub fn shown(&self) -> i128 {
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
