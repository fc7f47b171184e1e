//! Snaps a duration to a whole number of refreshes if it is near one, and averages the durations.

use super::fixed::Fixed;
use crate::loops::policy::{FrameLimits, Policy, Steps};
use crate::loops::time_base::TimeBase;

/// Tolerance for snapping, in nanoseconds. It is more than a timer's noise, and less than the 0.5 ms between refreshes
/// of 60 and 62 Hz.
const NEAR_NS: i64 = 200_000;
/// Longest snapped duration, in refreshes.
const MAX_REFRESHES: i128 = 8;
/// Number of durations in the mean.
const AVERAGED: usize = 4;
/// Maximum number of owed ticks. A longer frame counts as one tick.
const MAX_TICKS: u32 = 8;

/// A fixed tick that counts durations snapped to refreshes.
#[derive(Clone, Copy)]
pub(super) struct Snapped {
    tick: i128,
    max_ticks: u32,
    refresh: i128,
    near: i128,
    last: [i128; AVERAGED],
    /// Remainder of the previous division, which is carried over so that averaging loses no time.
    remainder: i128,
    fixed: Fixed,
}

impl Snapped {
    /// Starts as if all previous frames had lasted one refresh.
    pub(super) fn new(base: TimeBase, limits: FrameLimits) -> Self {
        let max_ticks = limits.max_ticks.unwrap_or(MAX_TICKS);
        Self {
            tick: base.tick(),
            max_ticks,
            refresh: base.refresh(),
            near: base.nanoseconds(NEAR_NS),
            last: [base.refresh(); AVERAGED],
            remainder: 0,
            fixed: Fixed::with_max_ticks(base, max_ticks),
        }
    }

    fn snapped(&self, duration: i128) -> i128 {
        let nearest = (2 * duration + self.refresh) / (2 * self.refresh);
        let whole = nearest.clamp(1, MAX_REFRESHES) * self.refresh;
        if (duration - whole).abs() < self.near { whole } else { duration }
    }

    /// Adds this duration and returns the new mean.
    fn mean(&mut self, duration: i128) -> i128 {
        self.last.rotate_left(1);
        self.last[AVERAGED - 1] = duration;
        let sum = self.last.iter().sum::<i128>() + self.remainder;
        self.remainder = sum % AVERAGED as i128;
        sum / AVERAGED as i128
    }
}

impl Policy for Snapped {
    fn frame(&mut self, duration: i128) -> Steps {
        let longest = i128::from(self.max_ticks) * self.tick;
        let counted = if duration > longest { self.tick } else { duration };
        let snapped = self.snapped(counted);
        let mean = self.mean(snapped);
        let lost = duration - counted;
        if self.fixed.owed() + mean > longest {
            return Steps { dropped: lost + self.fixed.clear() + mean, ..Steps::default() };
        }
        let steps = self.fixed.frame(mean);
        Steps { dropped: lost + steps.dropped, ..steps }
    }

    fn owed(&self) -> i128 {
        self.fixed.owed()
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::time_base::RefreshRate;

    fn ms(base: TimeBase, milliseconds: f64) -> i128 {
        base.nanoseconds((milliseconds * 1e6) as i64)
    }

    #[test]
    fn a_duration_near_one_to_eight_refreshes_is_rounded() {
        let base = TimeBase::new(60, RefreshRate::new(100, 1));
        let snapped = |milliseconds| {
            Snapped::new(base, FrameLimits::default()).snapped(ms(base, milliseconds))
        };
        for (given, made) in [
            (9.81, 10.0),
            (10.19, 10.0),
            (19.9, 20.0),
            (80.1, 80.0),
            (0.0, 0.0),
            (0.1, 0.1),
            (9.8, 9.8),
            (10.2, 10.2),
            (15.0, 15.0),
            (90.0, 90.0),
            (90.1, 90.1),
        ] {
            assert_eq!(snapped(given), ms(base, made), "{given} ms");
        }
    }

    #[test]
    fn the_mean_loses_no_time() {
        let mut policy =
            Snapped::new(TimeBase::new(60, RefreshRate::new(60, 1)), FrameLimits::default());
        let durations = (0..1000).map(|i| i * i % 777);
        let (mut given, mut meant) = (0, 0);
        for duration in durations.chain([0; AVERAGED - 1]) {
            given += duration;
            meant += policy.mean(duration);
        }
        // The initial refreshes count with 3, 2 and 1 quarters.
        assert_eq!(given + policy.refresh * 6 / 4, meant + policy.remainder / 4);
        assert!(policy.remainder < AVERAGED as i128);
    }

    #[test]
    fn a_debt_over_eight_ticks_is_dropped_entirely() {
        let base = TimeBase::new(60, RefreshRate::new(60, 1));
        let mut policy = Snapped::new(base, FrameLimits::default());
        let mut total = Steps::default();
        let longest = 8 * base.tick();
        policy.frame(base.tick() + base.tick() / 4);
        for _ in 0..4 {
            let steps = policy.frame(longest);
            total.count += steps.count;
            total.dropped += steps.dropped;
        }
        // The last frame owed a part of a tick, then eight more.
        assert_eq!(policy.owed(), 0);
        assert!(total.dropped > longest && total.dropped < longest + base.tick());
        assert_eq!(policy.frame(longest + 1).dropped, longest + 1 - base.tick());
    }
}
