//! Keeps the number of ticks per frame constant while it nearly fits.

use crate::loops::policy::{FrameLimits, Policy, Steps};
use crate::loops::time_base::TimeBase;

/// Number of recent frames that are compared.
const FRAMES: usize = 12;
/// Maximum number of ticks in a frame. Further ticks are dropped.
const MAX_TICKS: u32 = 8;

/// Makes whole ticks, the same number in each frame as long as that number is off by at most half a tick.
///
/// Any k successive frames make a typical number of ticks, or one more. At 144 Hz, for example, one frame makes none or
/// one, and twelve make five. Each frame makes the number of ticks that keeps this true for every k.
#[derive(Clone, Copy)]
pub(super) struct Hysteresis {
    tick: i128,
    max_ticks: u32,
    /// Time since the last tick: from -H/2 to 3H/2, because a tick may be early or late by half a tick.
    owed: i128,
    /// At index k, the number of ticks of the last k frames.
    made: [i128; FRAMES],
    /// At index k, the smaller of the two typical numbers of ticks of k + 1 frames.
    typical: [i128; FRAMES],
}

impl Hysteresis {
    /// Starts as if each frame had made one tick. Up to twelve frames together may also make one tick fewer.
    pub(super) fn new(base: TimeBase, limits: FrameLimits) -> Self {
        let counts = std::array::from_fn(|k| k as i128);
        let max_ticks = limits.max_ticks.unwrap_or(MAX_TICKS);
        Self { tick: base.tick(), max_ticks, owed: 0, made: counts, typical: counts }
    }

    /// Returns the number of ticks to make for the time owed.
    fn due(&self) -> i128 {
        let whole = self.owed.div_euclid(self.tick);
        let fewest = (2 * self.owed - self.tick).div_euclid(2 * self.tick).max(0);
        let most = (2 * self.owed + self.tick).div_euclid(2 * self.tick);
        let missing = || self.typical.iter().zip(&self.made).map(|(typical, made)| typical - made);
        let least = missing().max().expect("there are frames to compare");
        let greatest = missing().min().expect("there are frames to compare") + 1;
        let held = if least <= greatest { whole.clamp(least, greatest) } else { whole };
        held.clamp(fewest, most)
    }

    /// Records this frame's ticks, and shifts the typical numbers if they no longer fit.
    fn remember(&mut self, ticks: i128) {
        for (typical, made) in self.typical.iter_mut().zip(&self.made) {
            let now = made + ticks;
            *typical = (*typical).clamp(now - 1, now);
        }
        for k in (1..FRAMES).rev() {
            self.made[k] = self.made[k - 1] + ticks;
        }
    }
}

impl Policy for Hysteresis {
    fn frame(&mut self, duration: i128) -> Steps {
        self.owed += duration;
        let due = self.due();
        self.owed -= due * self.tick;
        let ticks = due.min(self.max_ticks.into());
        self.remember(ticks);
        Steps {
            count: ticks as u32,
            span: ticks * self.tick,
            dropped: (due - ticks) * self.tick,
            returned: None,
        }
    }

    fn owed(&self) -> i128 {
        self.owed
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::time_base::RefreshRate;

    /// Returns the ticks of frames with these durations in hundredths of a tick. Checks that no tick is too early or
    /// too late.
    fn ticks(hundredths: impl IntoIterator<Item = i128>) -> Vec<u32> {
        let mut policy =
            Hysteresis::new(TimeBase::new(60, RefreshRate::new(60, 1)), FrameLimits::default());
        let each = |hundredths| {
            let steps = policy.frame(policy.tick * hundredths / 100);
            let owed = 2 * policy.owed;
            assert!((-policy.tick..3 * policy.tick).contains(&owed), "{owed}");
            steps.count
        };
        hundredths.into_iter().map(each).collect()
    }

    #[test]
    fn noise_at_the_edge_of_a_tick_repeats_and_doubles_no_frame() {
        let noise = (0..1000).map(|i| 100 + [-3, 5, -2, 3, -5, 2][i % 6]);
        let counts = ticks(noise.clone());
        assert!(counts[1..].iter().all(|&count| count == 1), "{counts:?}");
        // Without hysteresis, ticks flip between none and two.
        let mut fixed = crate::sim::Accumulator::default();
        let counts = noise.map(|time| fixed.advance(time, 100, 8).ticks);
        assert!(counts.filter(|&count| count == 0).count() > 100);
    }

    #[test]
    fn a_tick_of_drift_is_corrected_in_one_frame() {
        let counts = ticks([99; 1000]);
        assert_eq!(counts.iter().filter(|&&count| count == 0).count(), 10);
        let counts = ticks([101; 1000]);
        assert_eq!(counts.iter().filter(|&&count| count == 2).count(), 10);
        assert_eq!(counts.iter().filter(|&&count| count == 1).count(), 990);
    }

    #[test]
    fn another_rate_becomes_typical() {
        for (hundredths, counts) in [(200, vec![2]), (50, vec![0, 1]), (40, vec![0, 1])] {
            let made = ticks(vec![100; 50].into_iter().chain(vec![hundredths; 1000]));
            let (settled, total) = (&made[100..], made.iter().sum::<u32>());
            assert!(settled.iter().all(|count| counts.contains(count)), "{hundredths} %");
            assert!(total.abs_diff(50 + 10 * hundredths as u32) <= 1, "{hundredths} %: {total}");
        }
    }

    #[test]
    fn a_hitch_is_caught_up_by_at_most_eight_ticks() {
        for (hundredths, hitch) in [(700, [6, 2]), (60_000, [8, 2])] {
            let counts = ticks([100; 20].into_iter().chain([hundredths]).chain([100; 20]));
            assert_eq!(counts[20..22], hitch);
            assert!(counts[..20].iter().chain(&counts[22..]).all(|&count| count == 1));
        }
    }
}
