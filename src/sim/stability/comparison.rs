//! What a method makes of a body's modes, beside what they are in truth.

use super::spectrum::Eigenvalue;

/// How a method treats small deviations of a body from its present state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability {
    /// The largest modulus of an eigenvalue of the one-tick map; infinite where the map overflows.
    pub spectral_radius: f64,
    /// By how much the worst mode grows in a second beyond what it does in truth or, where it decays in
    /// truth, beyond standing still: the natural logarithm of the factor. Negative where all decays.
    pub growth_per_s: f64,
    /// By how much the method damps the mode that it damps most of those that truth conserves: the
    /// natural logarithm in a second, 0 without such a mode.
    pub loss_per_s: f64,
    /// How much too fast the mode turns that is furthest off, as a part of its frequency; `None` where
    /// nothing swings, where the method no longer does, or where a mode makes half a turn or more in the
    /// tick: the map of a tick does not tell one turn and a bit from a bit of a turn.
    pub frequency_error: Option<f64>,
}

/// An amplitude that takes longer than this to double is bounded: a year, in seconds. No game runs as
/// long, and at 10 000 Hz less growth could not be told from rounding.
pub const FOREVER_S: f64 = 365.0 * 86_400.0;

impl Stability {
    /// Of a map that overflows.
    pub(super) const OVERFLOW: Self = Self {
        spectral_radius: f64::INFINITY,
        growth_per_s: f64::INFINITY,
        loss_per_s: 0.0,
        frequency_error: None,
    };

    /// Whether deviations stay as small as they are in truth, for as long as anybody looks.
    pub fn is_bounded(&self) -> bool {
        self.growth_per_s * FOREVER_S < std::f64::consts::LN_2
    }

    /// The seconds in which the amplitude doubles that in truth does not; `None` where it is bounded.
    pub fn doubling_s(&self) -> Option<f64> {
        (!self.is_bounded()).then(|| std::f64::consts::LN_2 / self.growth_per_s)
    }

    /// The seconds in which the amplitude halves that in truth does not; `None` where none does within
    /// [`FOREVER_S`].
    pub fn halving_s(&self) -> Option<f64> {
        let halving = std::f64::consts::LN_2 / self.loss_per_s;
        (halving > 0.0 && halving < FOREVER_S).then_some(halving)
    }
}

/// How fast a mode grows and turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mode {
    /// Natural logarithm of the factor in a second.
    pub(super) growth_per_s: f64,
    /// Radians per second, not negative.
    pub(super) frequency: f64,
}

impl Mode {
    pub(super) fn new(value: Eigenvalue, h: f64) -> Self {
        Self { growth_per_s: libm::log(value.modulus) / h, frequency: value.angle / h }
    }
}

/// What grows less than this in a second, as a part of a turn in a tick, stands still: the rounding of
/// the differences.
const STILL: f64 = 1e-9;

/// What grows in truth may grow by this part faster: neither rate says much of the long run.
const OWN_GROWTH: f64 = 0.1;

/// What the eigenvalues of a map over `h` (s) are beside the modes that the motion has in truth.
pub(super) fn against(truth: &[Mode], values: &[Eigenvalue], h: f64) -> Stability {
    let (swinging, creeping): (Vec<Mode>, Vec<Mode>) =
        truth.iter().partition(|m| m.frequency > 0.0);
    // Beyond as many as truth has, the faintest are what the method remembers.
    let mut by_modulus = values.to_vec();
    by_modulus.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
    let memory = by_modulus.split_off(truth.len().min(by_modulus.len()));
    let (mut turning, mut rest): (Vec<Eigenvalue>, Vec<Eigenvalue>) =
        by_modulus.into_iter().partition(|value| value.turns());

    let mut pairs: Vec<(Option<Mode>, Mode)> = Vec::new();
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
        let distance = |value: &Eigenvalue| {
            let re = value.modulus * libm::cos(value.angle);
            let im = value.modulus * libm::sin(value.angle);
            libm::hypot(re - expected, im)
        };
        let nearest =
            (0..rest.len()).min_by(|&a, &b| distance(&rest[a]).total_cmp(&distance(&rest[b])));
        if let Some(nearest) = nearest {
            pairs.push((Some(mode), Mode::new(rest.swap_remove(nearest), h)));
        }
    }
    let unpaired = rest.iter().chain(&memory).map(|&value| (None, Mode::new(value, h)));
    pairs.extend(unpaired);

    let excess = pairs.iter().map(|&(truth, found)| match truth {
        Some(Mode { growth_per_s: own, .. }) if own * h > STILL => {
            let excess = found.growth_per_s - own;
            if excess.abs() < OWN_GROWTH * own { 0.0 } else { excess }
        }
        _ => found.growth_per_s,
    });
    let conserved = |mode: Mode| (mode.growth_per_s * h).abs() < STILL;
    let losses = pairs.iter().filter(|(truth, _)| truth.is_some_and(conserved));
    Stability {
        spectral_radius: values.iter().map(|value| value.modulus).fold(0.0, f64::max),
        growth_per_s: excess.fold(f64::NEG_INFINITY, f64::max),
        loss_per_s: losses.map(|(_, found)| -found.growth_per_s).fold(0.0, f64::max),
        frequency_error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Modes that grow by these rates per second and do not swing.
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
    fn what_creeps_in_truth_is_held_against_the_nearest_eigenvalue() {
        let h = 0.1;
        for (case, nearest) in [
            // Nearer than what turns a sixth of a turn, whose real part is a quarter.
            ([(0.5, PI / 3.0), (0.5, PI / 3.0), (0.4, 0.0)], 0.4),
            // Further off than what hardly turns.
            ([(0.9, 0.2), (0.9, 0.2), (0.7, 0.0)], 0.9),
            // What flips is far off, however near in modulus.
            ([(0.99, PI), (0.99, PI), (0.8, 0.0)], 0.8),
        ] {
            let found = against(&creeping([0.0, -1.0, -1.0]), &values(case), h);
            assert!(near(found.loss_per_s, -libm::log(nearest) / h), "{case:?}: {found:?}");
        }
        // The nearest to e^0.2 and to e³.
        let found = against(&creeping([2.0, 30.0]), &values([(19.0, 0.0), (1.2, 0.0)]), h);
        assert_eq!(found.growth_per_s, 0.0);
    }

    #[test]
    fn growth_is_counted_beyond_that_of_the_truth_and_from_a_tenth_of_it() {
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
                let found = against(&creeping([own]), &values([value]), h).growth_per_s;
                assert!((found - counted).abs() < 1e-9, "{own}, {grows}: {found}");
            }
        }
        // Truth that seems to grow by 1e-10 in a tick stands still.
        let found = against(&creeping([1e-6]), &values([(1.0 + 1e-10, 0.0)]), 1e-4);
        assert!((found.growth_per_s / 1e-6 - 1.0).abs() < 1e-3, "{found:?}");
        let found = against(&creeping([1e-6]), &values([(0.5, 0.0)]), 1e-4);
        assert!(near(found.loss_per_s, libm::log(2.0) / 1e-4), "{found:?}");
        // A loss of what decays in truth is none.
        let found = against(&creeping([-1.0]), &values([(0.5, 0.0)]), 1.0);
        assert_eq!(found.loss_per_s, 0.0);
    }

    #[test]
    fn of_all_frequencies_the_one_furthest_off_is_told() {
        let swing = |frequency: f64| Mode { growth_per_s: 0.0, frequency };
        let truth = [swing(40.0), swing(10.0), swing(40.0), swing(10.0)];
        let turning = |of: [f64; 2]| values([of[0], of[0], of[1], of[1]].map(|a| (1.0, a * 0.01)));
        let error = |of| against(&truth, &turning(of), 0.01).frequency_error.unwrap();
        assert!(near(error([10.1, 38.8]), -0.03));
        assert!(near(error([40.4, 10.3]), 0.03));
        // One that flips swings no more, and then nothing is told of the other.
        let flipped = values([(1.0, 0.1), (1.0, 0.1), (1.0, PI), (1.0, PI)]);
        assert_eq!(against(&truth, &flipped, 0.01).frequency_error, None);
    }

    #[test]
    fn what_a_method_remembers_counts_where_it_grows() {
        let h = 0.1;
        let found = against(&creeping([-1.0]), &values([(1.1, PI), (0.9, 0.0)]), h);
        assert!(near(found.growth_per_s, libm::log(1.1) / h), "{found:?}");
        assert_eq!(found.spectral_radius, 1.1);
    }
}
