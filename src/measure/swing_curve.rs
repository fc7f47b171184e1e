//! The swing of a linear body with one coordinate as a curve, which gives its peaks exactly.

use std::f64::consts::{FRAC_PI_2, PI};

/// The curve e^(gt) (q cos ωt + b sin ωt) about the place of rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SwingCurve {
    /// Initial distance from the place of rest.
    pub(super) q: f64,
    /// Amplitude of the sine part, which is a quarter of a turn ahead.
    pub(super) b: f64,
    /// Growth rate g, per second; negative for a decaying swing.
    pub(super) growth_per_s: f64,
    /// Angular frequency ω, in radians per second; positive.
    pub(super) frequency: f64,
}

impl SwingCurve {
    /// Returns the amplitude at the start, as if the swing were at a peak at the start.
    pub(super) fn width(&self) -> f64 {
        libm::hypot(self.q, self.b)
    }

    /// Returns the seconds by which this curve leads `other` after `seconds`, measured in turns of `other`.
    pub(super) fn lead_s(&self, other: &Self, seconds: f64) -> f64 {
        let phase = |curve: &Self| libm::atan2(curve.b, curve.q);
        let at_start = libm::remainder(phase(other) - phase(self), 2.0 * PI);
        (at_start + (self.frequency - other.frequency) * seconds) / other.frequency
    }

    /// Returns the angle of the first passage through the place of rest, in 0 to π.
    fn first_passage(&self) -> f64 {
        let angle = libm::atan2(self.b, self.q);
        [-FRAC_PI_2, FRAC_PI_2, PI + FRAC_PI_2]
            .map(|quarter| angle + quarter)
            .into_iter()
            .find(|&passage| passage > 0.0)
            .unwrap_or(PI)
    }

    /// Returns the angle of the peak of the first half turn, which is not above 0 if it is before the start.
    fn first_peak(&self) -> f64 {
        self.first_passage() - FRAC_PI_2 + libm::atan(self.growth_per_s / self.frequency)
    }

    /// Returns the index of the half turn whose peak is the last one within `seconds`. That half turn need not be
    /// complete.
    fn last_peak(&self, seconds: f64) -> f64 {
        libm::floor((self.frequency * seconds - self.first_peak()) / PI)
    }

    /// Returns the largest distance from the place of rest in the half turn with this index.
    fn reach(&self, half_turn: f64) -> f64 {
        let slope = self.growth_per_s / self.frequency;
        let peak = self.first_peak();
        let cos = 1.0 / libm::hypot(1.0, slope);
        let at_peak = |angle: f64| self.width() * cos * libm::exp(slope * angle);
        match half_turn {
            first if first < 1.0 && peak <= 0.0 => self.q.abs(),
            half_turn => at_peak(peak + half_turn * PI),
        }
    }

    /// Returns the largest distance from the place of rest, if the swing does not grow.
    pub(super) fn widest(&self) -> f64 {
        self.reach(0.0).max(self.reach(1.0))
    }

    /// Like [`Self::reach`] for the first half turn of a swing that begins at its peak, from states that are `step_s`
    /// apart. A first step that turns back at once shows no other peak.
    fn first_reach(&self, step_s: f64) -> f64 {
        let (sin, cos) = libm::sincos(self.frequency * step_s);
        let next = libm::exp(self.growth_per_s * step_s) * (self.q * cos + self.b * sin);
        let turns_back = self.q != 0.0 && next * self.q.signum() <= self.q.abs();
        if turns_back { self.q.abs() } else { self.reach(0.0) }
    }

    /// Returns the largest difference in width between half turns of this curve and of `other` within `seconds`,
    /// relative to this curve's largest width. The states of `other` are `step_s` apart.
    ///
    /// If there is no decay, all half turns are equally wide, and the incomplete first one is not compared.
    pub(super) fn misfit(&self, other: &Self, step_s: f64, seconds: f64) -> f64 {
        let last = self.last_peak(seconds).min(other.last_peak(seconds));
        let first = match self.growth_per_s {
            0.0 => 0.0,
            _ if self.first_peak() > 0.0 => (self.reach(0.0) - other.reach(0.0)).abs(),
            _ => (self.reach(0.0) - other.first_reach(step_s)).abs(),
        };
        // From the second half turn on, both widths are geometric sequences, and their difference has one extreme.
        let [own, others] = [self, other].map(|curve| {
            let decay = curve.growth_per_s * PI / curve.frequency;
            (libm::log(curve.reach(1.0).max(f64::MIN_POSITIVE) * decay.abs()) - decay, decay)
        });
        let extreme = (others.0 - own.0) / (own.1 - others.1);
        let looked_at = [1.0, libm::floor(extreme), libm::ceil(extreme), last];
        let gaps = looked_at
            .into_iter()
            .filter(|half_turn| (1.0..=last).contains(half_turn))
            .map(|half_turn| (self.reach(half_turn) - other.reach(half_turn)).abs());
        gaps.fold(first, f64::max) / self.widest()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest distance in each complete half turn, from small steps.
    fn stepped(curve: &SwingCurve, seconds: f64) -> Vec<f64> {
        let at = |t: f64| {
            let turned = curve.frequency * t;
            libm::exp(curve.growth_per_s * t)
                * (curve.q * libm::cos(turned) + curve.b * libm::sin(turned))
        };
        let mut widest = vec![0.0_f64];
        let steps = 200_000;
        let mut was_below = curve.q < 0.0;
        for step in 0..=steps {
            let x = at(seconds * f64::from(step) / f64::from(steps));
            if (x < 0.0) != was_below {
                widest.push(0.0);
                was_below = x < 0.0;
            }
            let last = widest.last_mut().expect("the first begins at the start");
            *last = last.max(x.abs());
        }
        widest.pop();
        widest
    }

    #[test]
    fn peaks_of_a_curve_match_small_steps_along_it() {
        for growth_per_s in [-3.0, -0.4, 0.0, 0.3] {
            for start in 0..16 {
                let angle = (f64::from(start) + 0.3) * PI / 8.0;
                let (b, q) = libm::sincos(angle);
                let curve = SwingCurve { q, b, growth_per_s, frequency: 4.0 };
                let wanted = stepped(&curve, 10.0);
                // The last half turn may be past its peak, but not complete.
                let last = curve.last_peak(10.0) - (wanted.len() as f64 - 1.0);
                assert!([0.0, 1.0].contains(&last), "{curve:?}: {last}");
                for (half_turn, wanted) in wanted.into_iter().enumerate() {
                    let found = curve.reach(half_turn as f64);
                    assert!((found / wanted - 1.0).abs() < 1e-5, "{curve:?}: {half_turn}");
                }
            }
        }
    }

    #[test]
    fn a_lead_is_the_time_by_which_peaks_come_earlier() {
        let truth = SwingCurve { q: 1.0, b: 0.0, growth_per_s: 0.0, frequency: 5.0 };
        for (angle, frequency) in [(0.0, 5.0), (0.3, 5.0), (-0.3, 5.1), (3.0, 4.9), (0.1, 7.0)] {
            let (b, q) = libm::sincos(angle);
            let other = SwingCurve { q, b, frequency, ..truth };
            for seconds in [0.0, 2.0, 60.0] {
                // The lead is the solution of ω₀ (t + lead) = ω t - angle.
                let wanted = ((frequency - 5.0) * seconds - angle) / 5.0;
                let found = other.lead_s(&truth, seconds);
                assert!((found - wanted).abs() < 1e-12, "{other:?}: {found}, not {wanted}");
            }
        }
    }

    #[test]
    fn the_misfit_is_the_maximum_over_all_half_turns() {
        let truth = SwingCurve { q: 0.6, b: 0.8, growth_per_s: -0.1, frequency: 5.0 };
        for (width, growth_per_s) in
            [(1.0, -0.15), (1.1, -0.1), (1.1, -0.12), (0.9, -0.08), (1.0, 0.0), (1.0, -0.1)]
        {
            let (q, b) = (width * truth.q, width * truth.b);
            let other = SwingCurve { q, b, growth_per_s, ..truth };
            for seconds in [2.0, 12.0, 60.0] {
                let last = truth.last_peak(seconds).min(other.last_peak(seconds)) as u32;
                let gaps =
                    (0..=last).map(f64::from).map(|k| (truth.reach(k) - other.reach(k)).abs());
                let wanted = gaps.fold(0.0, f64::max) / truth.widest();
                let found = truth.misfit(&other, 1e-9, seconds);
                assert!(
                    (found - wanted).abs() <= 1e-12,
                    "{other:?}, {seconds} s: {found}, {wanted}"
                );
            }
        }
        // The difference of two decays has its maximum in between: (r/s)^(s/(s-r)) - (r/s)^(r/(s-r)) of the start.
        let slow = SwingCurve { q: 1.0, b: 0.0, growth_per_s: -0.1, frequency: 100.0 };
        let fast = SwingCurve { growth_per_s: -0.15, ..slow };
        let wanted = libm::pow(2.0 / 3.0, 2.0) - libm::pow(2.0 / 3.0, 3.0);
        assert!((slow.misfit(&fast, 1e-9, 60.0) / wanted - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_peak_within_the_first_step_and_that_of_the_last_half_turn_count() {
        // The first peak is at 0.3 s, and the swing is back where it began at 0.6 s.
        let (b, q) = libm::sincos(0.3);
        let truth = SwingCurve { q, b, growth_per_s: -0.01, frequency: 1.0 };
        for step_s in [0.1, 0.55, 0.61, 1.0] {
            assert_eq!(truth.misfit(&truth, step_s, 60.0), 0.0, "{step_s} s");
        }
        // A curve that begins at its peak has no other one before its first step.
        let at_peak = SwingCurve { q: 1.0, b: 0.0, ..truth };
        let early = SwingCurve { q: 1.0, b: -0.4, ..truth };
        assert!(at_peak.misfit(&early, 0.1, 0.2) < 1e-9);
        // The fourth peak is at 9.7 s, and the fourth half turn ends at 11.3 s.
        let faster = SwingCurve { growth_per_s: -0.02, ..truth };
        let peaks = |k: f64| (truth.reach(k) - faster.reach(k)).abs();
        assert!(
            (truth.misfit(&faster, 0.1, 10.0) * truth.widest() / peaks(3.0) - 1.0).abs() < 1e-9
        );
        assert!((truth.misfit(&faster, 0.1, 9.0) * truth.widest() / peaks(2.0) - 1.0).abs() < 1e-9);
    }
}
