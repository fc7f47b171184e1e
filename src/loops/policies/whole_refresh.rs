//! Counts every frame as a whole number of refreshes of the display.

use super::fixed::Fixed;
use crate::loops::policy::{FrameLimits, Policy, Steps};
use crate::loops::time_base::TimeBase;

/// A fixed tick that counts time in whole refreshes.
#[derive(Clone, Copy)]
pub(super) struct WholeRefresh {
    refresh: i128,
    /// Real time that is not yet counted; negative if more than the real time was counted.
    debt: i128,
    fixed: Fixed,
}

impl WholeRefresh {
    pub(super) fn new(base: TimeBase, limits: FrameLimits) -> Self {
        Self { refresh: base.refresh(), debt: 0, fixed: Fixed::new(base, limits) }
    }

    /// Returns the number of refreshes to count, where `time` is the frame's duration plus the debt.
    fn refreshes(&self, time: i128) -> i128 {
        let nearest = (2 * time + self.refresh).div_euclid(2 * self.refresh);
        // A picture stays for at least one refresh. If frames do not wait for the display, however, one refresh per
        // frame would make the game too fast.
        let a_refresh_ahead = 2 * time <= -self.refresh;
        if a_refresh_ahead { 0 } else { nearest.max(1) }
    }
}

impl Policy for WholeRefresh {
    fn frame(&mut self, duration: i128) -> Steps {
        let time = duration + self.debt;
        let counted = self.refreshes(time) * self.refresh;
        self.debt = time - counted;
        self.fixed.frame(counted)
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

    /// Returns the refreshes counted for frames with these durations in hundredths of a refresh.
    fn counted(hundredths: impl IntoIterator<Item = i128>) -> Vec<i128> {
        let mut policy =
            WholeRefresh::new(TimeBase::new(60, RefreshRate::new(60, 1)), FrameLimits::default());
        let each = |hundredths| {
            let time = policy.debt + policy.refresh * hundredths / 100;
            policy.frame(policy.refresh * hundredths / 100);
            (time - policy.debt) / policy.refresh
        };
        hundredths.into_iter().map(each).collect()
    }

    #[test]
    fn a_frame_counts_as_the_nearest_refreshes_and_at_least_one() {
        assert_eq!(counted([100, 97, 104, 99, 240, 60, 100]), [1, 1, 1, 1, 2, 1, 1]);
        assert_eq!(counted([60, 60, 60, 60]), [1, 1, 1, 0]);
    }

    #[test]
    fn frames_that_do_not_wait_for_the_display_make_the_game_no_faster() {
        for hundredths in [1, 10, 37, 50, 90] {
            let frames = 10_000;
            let refreshes: i128 = counted(vec![hundredths; frames]).iter().sum();
            let ahead = refreshes * 100 - hundredths * frames as i128;
            assert!((0..=150).contains(&ahead), "{hundredths} %: {ahead} % of a refresh ahead");
        }
    }
}
