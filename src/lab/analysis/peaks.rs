//! How far a body swings in each half turn, from its states at ticks.

use super::limits::{FREQUENCY_TOLERANCE, VISIBLE};
use super::truth::{BodyTruth, Swing};
use crate::sim::Stepper;

/// The fewest ticks per turn at which every half turn shows its peak.
const FEW_TICKS: f64 = 8.0;

/// The half turns that are compared together where not each shows its peak.
const TOGETHER: usize = 8;

/// Finds the peaks of the coordinates, interpolated between ticks by harmonic motion.
pub(super) struct Peaks {
    /// The last two distances of each coordinate from its centre, the older one first.
    last: Vec<[f64; 2]>,
    /// The coordinate whose passages through its centre divide the half turns.
    coordinate: usize,
    /// The largest distance of any coordinate from its centre in each half turn so far, in amplitudes.
    pub(super) half_turns: Vec<f64>,
}

impl Peaks {
    /// The peaks of a run of `truth`'s body from the state of `stepper`; `None` if the body does not swing.
    pub(super) fn new(truth: &BodyTruth, stepper: &dyn Stepper) -> Option<Self> {
        let coordinate = truth.swing.as_ref()?.coordinate;
        let distances = stepper.q().iter().zip(&truth.centres).map(|(q, centre)| q - centre);
        let last: Vec<[f64; 2]> = distances.map(|distance| [f64::NAN, distance]).collect();
        let parts = last.iter().zip(&truth.amplitudes).map(|(last, a)| last[1].abs() / a);
        let half_turns = vec![parts.fold(0.0, f64::max)];
        Some(Self { last, coordinate, half_turns })
    }

    /// Adds the state after another tick.
    pub(super) fn take_in(&mut self, stepper: &dyn Stepper, truth: &BodyTruth) {
        let (mut before, mut after) = (0.0_f64, 0.0_f64);
        for (i, last) in self.last.iter_mut().enumerate() {
            let [older, here] = *last;
            let next = stepper.q()[i] - truth.centres[i];
            *last = [here, next];
            if here.abs() >= older.abs() && here.abs() >= next.abs() {
                before = before.max(harmonic_peak(older, here, next) / truth.amplitudes[i]);
            }
            after = after.max(next.abs() / truth.amplitudes[i]);
        }
        self.add_to_last(before);
        let [here, next] = self.last[self.coordinate];
        if (here < 0.0) == (next < 0.0) {
            self.add_to_last(after);
        } else {
            self.half_turns.push(after);
        }
    }

    fn add_to_last(&mut self, peak: f64) {
        let last = self.half_turns.last_mut().expect("the first begins with the run");
        *last = last.max(peak);
    }
}

impl Swing {
    /// Whether a lane swings as wide as the truth in each of its half turns, which may come earlier or later. The last of
    /// each may be cut off by the end of the horizon.
    pub(super) fn is_as_wide(&self, lane: &[f64], tick_hz: u32) -> bool {
        let whole = |half_turns: &[f64]| half_turns.len().saturating_sub(1).max(1);
        let (wanted, found) = (whole(&self.half_turns), whole(lane));
        let together = if self.period() * f64::from(tick_hz) < FEW_TICKS { TOGETHER } else { 1 };
        let widest = |half_turns: &[f64]| half_turns.iter().copied().fold(0.0, f64::max);
        let both = wanted.min(found);
        let lanes = lane[..both].chunks(together);
        let mut pairs = lanes.zip(self.half_turns[..both].chunks(together));
        // A slow lane makes fewer half turns and a fast one more. What has come to rest makes no more.
        let unpaired = |half_turns: &[f64], count: usize| {
            let fewest = (1.0 - FREQUENCY_TOLERANCE) * count as f64 - 2.0;
            widest(&half_turns[both..(fewest.max(both as f64) as usize)])
        };
        pairs.all(|(lane, truth)| (widest(lane) - widest(truth)).abs() <= VISIBLE)
            && unpaired(&self.half_turns, wanted) <= VISIBLE
            && unpaired(lane, found) <= VISIBLE
    }
}

/// The amplitude of the harmonic motion through three values at equal intervals, the middle one being the largest.
fn harmonic_peak(before: f64, here: f64, next: f64) -> f64 {
    let cos = (before + next) / (2.0 * here);
    let sin_squared = 1.0 - cos * cos;
    let side = (next - before) / 2.0;
    let peak = libm::hypot(here, side / sin_squared.sqrt());
    // Values more than a third of a turn apart do not determine the peak.
    if sin_squared > 0.0 && peak <= 2.0 * here.abs() { peak } else { here.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_turns_are_compared_one_by_one_and_what_is_left_over_is_at_rest() {
        let turns = 50;
        let decaying = |rate: f64, count: usize| -> Vec<f64> {
            (0..count).map(|i| libm::exp(-rate * i as f64)).collect()
        };
        let swing = |half_turns: Vec<f64>| Swing {
            coordinate: 0,
            crossings: (0..=turns).map(f64::from).collect(),
            half_turns,
        };
        for (truth, lane, is_as_wide) in [
            (decaying(0.1, 100), decaying(0.1, 100), true),
            (decaying(0.1, 100), decaying(0.11, 100), true),
            (decaying(0.1, 100), decaying(0.12, 100), false),
            (decaying(0.1, 100), decaying(0.08, 100), false),
            // One in a hundred more or fewer, and those at the ends.
            (decaying(0.0, 100), decaying(0.0, 98), true),
            (decaying(0.0, 98), decaying(0.0, 100), true),
            (decaying(0.0, 100), decaying(0.0, 90), false),
            (decaying(0.0, 90), decaying(0.0, 100), false),
            (decaying(0.1, 100), decaying(0.1, 40), true),
            (decaying(0.1, 40), decaying(0.1, 100), true),
        ] {
            let found = swing(truth.clone()).is_as_wide(&lane, 60);
            assert_eq!(found, is_as_wide, "{truth:?}\n{lane:?}");
        }
    }
}
