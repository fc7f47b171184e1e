//! The stability of a method on a motion. The eigenvalues of the method's one-step map are compared with the true modes
//! of the motion.

use super::Tick;
use super::spectrum::{Eigenvalue, eigenvalues, has_memory, linear_maps};
use crate::Stepper;
use crate::integrators::StepFailure;

/// The effect of a method on small deviations of a body from its present state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability {
    /// The spectral radius of the one-tick map; infinite if the map overflows.
    pub spectral_radius: f64,
    /// The largest growth rate of a mode in excess of its true growth, or in excess of zero if the mode truly decays.
    /// The rate is the natural logarithm of the factor per second, and negative if all modes decay.
    pub growth_per_s: f64,
    /// The largest decay rate of a mode that is truly conserved, as the natural logarithm of the factor per second; 0
    /// if there is no such mode.
    pub loss_per_s: f64,
    /// The largest frequency error of a mode, relative to its true frequency. `None` if no mode oscillates, or if the
    /// method turns an oscillation into a real eigenvalue. Also `None` if a mode makes half a turn or more in the
    /// tick, because the one-tick map does not determine the number of turns.
    pub frequency_error: Option<f64>,
}

/// A year, in seconds. An amplitude that takes longer than this time to double counts as bounded. No game runs as long,
/// and at 10 000 Hz a smaller growth is indistinguishable from rounding.
pub const FOREVER_S: f64 = 365.0 * 86_400.0;

impl Stability {
    /// The stability of a map that overflows.
    const OVERFLOW: Self = Self {
        spectral_radius: f64::INFINITY,
        growth_per_s: f64::INFINITY,
        loss_per_s: 0.0,
        frequency_error: None,
    };

    /// Whether the excess growth takes longer than [`FOREVER_S`] to double an amplitude.
    pub fn is_bounded(&self) -> bool {
        self.growth_per_s * FOREVER_S < std::f64::consts::LN_2
    }

    /// Returns the time in seconds in which the excess growth doubles an amplitude; `None` if the amplitude is bounded.
    pub fn doubling_s(&self) -> Option<f64> {
        (!self.is_bounded()).then(|| std::f64::consts::LN_2 / self.growth_per_s)
    }
}

/// The growth rate and the frequency of a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mode {
    /// The growth rate, as the natural logarithm of the factor per second.
    pub(super) growth_per_s: f64,
    /// The frequency in radians per second; not negative.
    pub(super) frequency: f64,
}

impl Mode {
    pub(super) fn new(value: Eigenvalue, h: f64) -> Self {
        Self { growth_per_s: libm::log(value.modulus) / h, frequency: value.angle / h }
    }

    /// Whether no force acts on the mode.
    pub(super) fn is_still(&self) -> bool {
        self.growth_per_s == 0.0 && self.frequency == 0.0
    }
}

/// A motion of a linear body whose coordinates a method steps together.
#[derive(Clone, Debug)]
pub(super) struct LinearMotion {
    /// The shapes of the motion, orthogonal and of length 1.
    pub(super) shapes: Vec<Vec<f64>>,
    pub(super) truth: Vec<Mode>,
    /// The unit of velocity, per second, in which the fastest mode moves on circles; 0 if no force acts.
    pub(super) rate: f64,
}

impl LinearMotion {
    /// Returns the stability of a tick in which the method of `stepper` repeats `step` for this number of `times`. The
    /// stability comes from runs that start at this `amplitude`. Also returns whether the method has memory.
    ///
    /// # Errors
    /// The failure of the method in the first steps.
    pub(super) fn stability(
        &self,
        stepper: &mut dyn Stepper,
        (step, times): (Tick, u32),
        amplitude: f64,
    ) -> Result<(Stability, bool), StepFailure> {
        let rate = if self.rate > 0.0 { self.rate } else { 1.0 / step.h };
        let maps = linear_maps(stepper, &self.shapes, step, [amplitude, rate])?;
        let mut stability = Stability::OVERFLOW;
        if let Some(mut values) = eigenvalues(&maps) {
            self.snap_force_free_to_one(&mut values);
            stability = compare(&self.truth, &values, step.h);
            // The map of a tick is a power of the map of a step, in which the modes turn less.
            stability.spectral_radius = libm::pow(stability.spectral_radius, f64::from(times));
        }
        Ok((stability, has_memory(&maps)))
    }

    /// Sets the eigenvalues nearest to 1 to exactly 1, one for each force-free mode. Methods preserve uniform drift,
    /// but rounding splits a double eigenvalue by √ε.
    fn snap_force_free_to_one(&self, values: &mut [Eigenvalue]) {
        let still = self.truth.iter().filter(|mode| mode.is_still()).count();
        if still == 0 {
            return;
        }
        let distance = |value: &Eigenvalue| value.distance_from(1.0);
        values.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        for value in values.iter_mut().take(still).filter(|value| distance(value) < SPLIT) {
            *value = Eigenvalue { modulus: 1.0, angle: 0.0 };
        }
    }
}

/// The largest shift of a double eigenvalue by rounding.
const SPLIT: f64 = 1e-6;

/// A growth per tick below this number counts as zero, because it is only the rounding of the differences.
const NO_GROWTH: f64 = 1e-9;

/// A mode that truly grows may grow faster or slower than in truth by this fraction, because neither rate predicts the
/// long run.
const IGNORED_EXCESS: f64 = 0.1;

/// Pairs the eigenvalues of a map over `h` (s) with the true modes and compares them.
fn compare(truth: &[Mode], values: &[Eigenvalue], h: f64) -> Stability {
    let (pairs, frequency_error) = pairs(truth, values, h);
    let excess = pairs.iter().map(|&(truth, found)| match truth {
        Some(Mode { growth_per_s: own, .. }) if own * h > NO_GROWTH => {
            let excess = found.growth_per_s - own;
            if excess.abs() < IGNORED_EXCESS * own { 0.0 } else { excess }
        }
        _ => found.growth_per_s,
    });
    let conserved = |mode: Mode| (mode.growth_per_s * h).abs() < NO_GROWTH;
    let losses = pairs.iter().filter(|(truth, _)| truth.is_some_and(conserved));
    Stability {
        spectral_radius: values.iter().map(|value| value.modulus).fold(0.0, f64::max),
        growth_per_s: excess.fold(f64::NEG_INFINITY, f64::max),
        loss_per_s: losses.map(|(_, found)| -found.growth_per_s).fold(0.0, f64::max),
        frequency_error,
    }
}

/// A mode of the method, with its true mode if it has one.
type Pair = (Option<Mode>, Mode);

/// Pairs each eigenvalue of a map over `h` (s) with its true mode; eigenvalues without a true mode belong to the method
/// alone. Also returns the [error](Stability::frequency_error) of the frequencies.
fn pairs(truth: &[Mode], values: &[Eigenvalue], h: f64) -> (Vec<Pair>, Option<f64>) {
    let (swinging, creeping): (Vec<Mode>, Vec<Mode>) =
        truth.iter().partition(|m| m.frequency > 0.0);
    // If there are more eigenvalues than true modes, the smallest belong to the memory of the method.
    let mut by_modulus = values.to_vec();
    by_modulus.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
    let memory = by_modulus.split_off(truth.len().min(by_modulus.len()));
    let (mut turning, mut rest): (Vec<Eigenvalue>, Vec<Eigenvalue>) =
        by_modulus.into_iter().partition(|value| value.is_complex());

    let mut pairs: Vec<Pair> = Vec::new();
    let mut frequency_error = None;
    if turning.len() == swinging.len() {
        turning.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        let mut swinging = swinging;
        swinging.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        let turning = turning.iter().map(|&value| Mode::new(value, h));
        pairs.extend(swinging.into_iter().map(Some).zip(turning));
        let errors = pairs.iter().filter_map(|(truth, found)| {
            truth.map(|truth| found.frequency / truth.frequency - 1.0)
        });
        frequency_error = errors.max_by(|a, b| a.abs().total_cmp(&b.abs())).filter(|_| {
            let fastest = truth.iter().map(|mode| mode.frequency).fold(0.0, f64::max);
            fastest * h < std::f64::consts::PI
        });
    } else {
        rest.append(&mut turning);
    }
    for mode in creeping {
        let expected = libm::exp(mode.growth_per_s * h);
        let distance = |index: &usize| rest[*index].distance_from(expected);
        let nearest = (0..rest.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(nearest) = nearest {
            pairs.push((Some(mode), Mode::new(rest.swap_remove(nearest), h)));
        }
    }
    let unpaired = rest.iter().chain(&memory).map(|&value| (None, Mode::new(value, h)));
    pairs.extend(unpaired);
    (pairs, frequency_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Returns modes that do not swing, with these growth rates per second.
    fn creeping<const N: usize>(rates: [f64; N]) -> [Mode; N] {
        rates.map(|growth_per_s| Mode { growth_per_s, frequency: 0.0 })
    }

    fn values<const N: usize>(values: [(f64, f64); N]) -> [Eigenvalue; N] {
        values.map(|(modulus, angle)| Eigenvalue { modulus, angle })
    }

    fn near(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-9 * wanted.abs()
    }

    #[test]
    fn an_overdamped_mode_is_compared_with_the_nearest_eigenvalue() {
        let h = 0.1;
        for (case, nearest) in [
            // The real eigenvalue is nearer than the pair at a sixth of a turn, whose real part is a quarter.
            ([(0.5, PI / 3.0), (0.5, PI / 3.0), (0.4, 0.0)], 0.4),
            // The real eigenvalue is farther than the pair that hardly turns.
            ([(0.9, 0.2), (0.9, 0.2), (0.7, 0.0)], 0.9),
            // A negative eigenvalue is far away, however close its modulus.
            ([(0.99, PI), (0.99, PI), (0.8, 0.0)], 0.8),
        ] {
            let found = compare(&creeping([0.0, -1.0, -1.0]), &values(case), h);
            assert!(near(found.loss_per_s, -libm::log(nearest) / h), "{case:?}: {found:?}");
        }
        // The eigenvalues are compared with e^0.2 and e³.
        let found = compare(&creeping([2.0, 30.0]), &values([(19.0, 0.0), (1.2, 0.0)]), h);
        assert_eq!(found.growth_per_s, 0.0);
    }

    #[test]
    fn growth_counts_in_excess_of_true_growth_beyond_a_tenth() {
        for h in [0.1, 4.0] {
            for (own, grows, counted) in [
                (2.0, 2.15, 0.0),
                (2.0, 1.85, 0.0),
                (2.0, 2.3, 0.3),
                (2.0, 1.5, -0.5),
                (-2.0, 0.5, 0.5),
                (-2.0, -0.5, -0.5),
                (0.0, 0.1, 0.1),
            ] {
                let value = (libm::exp(grows * h), 0.0);
                let found = compare(&creeping([own]), &values([value]), h).growth_per_s;
                assert!((found - counted).abs() < 1e-9, "{own}, {grows}: {found}");
            }
        }
        // A true growth of 1e-10 per tick counts as zero.
        let found = compare(&creeping([1e-6]), &values([(1.0 + 1e-10, 0.0)]), 1e-4);
        assert!((found.growth_per_s / 1e-6 - 1.0).abs() < 1e-3, "{found:?}");
        let found = compare(&creeping([1e-6]), &values([(0.5, 0.0)]), 1e-4);
        assert!(near(found.loss_per_s, libm::log(2.0) / 1e-4), "{found:?}");
        // A decaying mode has no loss.
        let found = compare(&creeping([-1.0]), &values([(0.5, 0.0)]), 1.0);
        assert_eq!(found.loss_per_s, 0.0);
    }

    #[test]
    fn the_largest_frequency_error_is_reported() {
        let swing = |frequency: f64| Mode { growth_per_s: 0.0, frequency };
        let truth = [swing(40.0), swing(10.0), swing(40.0), swing(10.0)];
        let turning = |of: [f64; 2]| values([of[0], of[0], of[1], of[1]].map(|a| (1.0, a * 0.01)));
        let error = |of| compare(&truth, &turning(of), 0.01).frequency_error.unwrap();
        assert!(near(error([10.1, 38.8]), -0.03));
        assert!(near(error([40.4, 10.3]), 0.03));
        // A mode that becomes a negative eigenvalue does not oscillate, so that no frequency error is known.
        let flipped = values([(1.0, 0.1), (1.0, 0.1), (1.0, PI), (1.0, PI)]);
        assert_eq!(compare(&truth, &flipped, 0.01).frequency_error, None);
    }

    #[test]
    fn a_growing_memory_mode_counts() {
        let h = 0.1;
        let found = compare(&creeping([-1.0]), &values([(1.1, PI), (0.9, 0.0)]), h);
        assert!(near(found.growth_per_s, libm::log(1.1) / h), "{found:?}");
        assert_eq!(found.spectral_radius, 1.1);
    }
}
