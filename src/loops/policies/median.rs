//! Makes one step per frame, as long as frames typically are.

use crate::loops::policy::{Policy, Steps};
use crate::loops::time_base::TimeBase;

/// Number of recent durations in the mean.
const LAST: usize = 11;
/// Number of the longest and number of the shortest durations that are left out of the mean. Hitches of at most this
/// many frames do not affect the mean.
const LEFT_OUT: usize = 2;
/// Divisor of the difference between the mean and the step, by which the step approaches the mean in each frame. A
/// larger divisor is smoother, but slower to adapt to another rate.
const EASING: i128 = 4;
/// Divisor of the debt that gives the part paid back in each frame. A larger divisor is smoother, but lags longer after
/// a hitch.
const PAYING_BACK: i128 = 16;

/// A smoothed step that makes up for its error over time.
#[derive(Clone, Copy)]
pub(super) struct Median {
    last: [i128; LAST],
    eased: i128,
    /// Real time that is not yet simulated; negative if the simulation is ahead.
    debt: i128,
}

impl Median {
    /// Starts as if all previous frames had lasted one refresh.
    pub(super) fn new(base: TimeBase) -> Self {
        Self { last: [base.refresh(); LAST], eased: base.refresh(), debt: 0 }
    }

    /// Returns the mean of the last durations without the longest and the shortest ones.
    fn mean(&self) -> i128 {
        let mut sorted = self.last;
        sorted.sort_unstable();
        let kept = &sorted[LEFT_OUT..LAST - LEFT_OUT];
        kept.iter().sum::<i128>() / kept.len() as i128
    }
}

impl Policy for Median {
    fn frame(&mut self, duration: i128) -> Steps {
        self.last.rotate_left(1);
        self.last[LAST - 1] = duration;
        self.eased += (self.mean() - self.eased) / EASING;
        let step = (self.eased + self.debt / PAYING_BACK).max(0);
        self.debt += duration - step;
        Steps::one(step)
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::time_base::RefreshRate;

    /// Returns a policy at 60 Hz, and a hundredth of a refresh.
    fn policy() -> (Median, i128) {
        let policy = Median::new(TimeBase::new(60, RefreshRate::new(60, 1)));
        (policy, policy.eased / 100)
    }

    #[test]
    fn noise_is_smoothed_sixteenfold() {
        let (mut policy, unit) = policy();
        let refresh = policy.eased;
        for i in 0..1000 {
            let noise = if i % 2 == 0 { 6 } else { -6 };
            let step = policy.frame(refresh + noise * unit).span;
            // At most four of the seven kept durations are late, so the mean noise is at most 6/7.
            assert!((step - refresh).abs() < 2 * unit, "frame {i}: {}", (step - refresh) / unit);
        }
    }

    #[test]
    fn a_hitch_is_paid_back_and_a_new_rate_is_adopted() {
        let (mut policy, unit) = policy();
        let refresh = policy.eased;
        let before: i128 = policy.frame(1100 * unit).span;
        assert_eq!(before, refresh);
        assert_eq!(policy.frame(refresh).span, refresh + 1000 * unit / PAYING_BACK);
        for _ in 0..200 {
            policy.frame(refresh);
        }
        assert!(policy.debt.abs() < unit, "{} % of a refresh", policy.debt / unit);
        for _ in 0..200 {
            policy.frame(2 * refresh);
        }
        assert!(policy.debt.abs() < unit && (policy.eased - 2 * refresh).abs() < unit);
    }

    #[test]
    fn no_step_is_negative_and_the_debt_is_bounded() {
        let (mut policy, unit) = policy();
        let longest = 60_000 * unit;
        for i in 0..10_000_i128 {
            let duration = match i % 29 {
                0 => longest,
                1..=20 => 0,
                _ => 100 * unit,
            };
            assert!(policy.frame(duration).span >= 0);
            let bound = PAYING_BACK * longest;
            assert!(policy.debt.abs() < bound, "frame {i}: {}", policy.debt);
        }
    }
}
