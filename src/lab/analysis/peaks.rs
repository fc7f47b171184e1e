//! How far a body swings, from its states at ticks.

use super::truth::{BodyTruth, window};
use crate::sim::Stepper;

/// Finds the peaks of the coordinates, interpolated between ticks by harmonic motion.
pub(super) struct Peaks {
    /// The last two distances of each coordinate from its centre, the older one first.
    last: Vec<[f64; 2]>,
}

impl Peaks {
    pub(super) fn new(truth: &BodyTruth, stepper: &dyn Stepper) -> Self {
        let from = stepper.q().iter().zip(&truth.centres);
        Self { last: from.map(|(q, middle)| [f64::NAN, q - middle]).collect() }
    }

    /// Puts the initial state into the first window.
    pub(super) fn start(&self, truth: &BodyTruth, windows: &mut [f64]) {
        if let Some(first) = windows.first_mut() {
            let parts = self.last.iter().zip(&truth.amplitudes).map(|(last, a)| last[1].abs() / a);
            *first = parts.fold(0.0, f64::max);
        }
    }

    pub(super) fn take_in(
        &mut self,
        stepper: &dyn Stepper,
        truth: &BodyTruth,
        t: f64,
        windows: &mut [f64],
    ) {
        let window = window(t / truth.horizon_s, windows.len());
        for (i, last) in self.last.iter_mut().enumerate() {
            let (before, here, next) = (last[0], last[1], stepper.q()[i] - truth.centres[i]);
            *last = [here, next];
            let mut peak = next.abs();
            if here.abs() >= before.abs() && here.abs() >= next.abs() {
                peak = peak.max(harmonic_peak(before, here, next));
            }
            windows[window] = windows[window].max(peak / truth.amplitudes[i]);
        }
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
