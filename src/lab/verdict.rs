//! What is to be said of a method on a scene: one word, and the number behind it.

use std::fmt;

use super::judge::{Outcome, TOLERANCE};
use super::number::{round, significant, superscript};
use crate::sim::integrators::StepFailure;
use crate::sim::stability::Stability;

/// The word. Stability and accuracy are separate: what is accurate over the horizon may still grow in
/// the long run, and a [`Verdict`] then says both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Word {
    /// No error but rounding over the horizon.
    Exact,
    /// The error stays within the tolerance over the horizon.
    Accurate,
    /// The error does not, though nothing grows or dies away that should not.
    Drifting,
    /// The amplitude dies away that should stay.
    Decays,
    /// The amplitude grows that should not.
    Grows,
    /// A value left the range that is followed.
    Lost,
    /// The method gave up.
    Halted,
}

impl Word {
    /// The word itself.
    pub fn text(self) -> &'static str {
        match self {
            Word::Exact => "exact",
            Word::Accurate => "accurate",
            Word::Drifting => "drifting",
            Word::Decays => "decays",
            Word::Grows => "grows",
            Word::Lost => "lost",
            Word::Halted => "halted",
        }
    }
}

/// What ended a lane.
#[derive(Clone, Debug, PartialEq)]
pub struct Fate {
    /// When, in simulated seconds.
    pub t: f64,
    /// How.
    pub failure: StepFailure,
}

/// What is to be said of a lane over a stretch of a scene. Shows as one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The word.
    pub word: Word,
    /// How deviations fare in the long run; `None` where the method cannot get through its first ticks.
    pub stability: Option<Stability>,
    /// How the lane fared over the horizon.
    pub outcome: Outcome,
    /// The stretch, in simulated seconds.
    pub horizon_s: f64,
}

/// An error of this part of the amplitude is rounding.
const ROUNDING: f64 = 1e-9;

impl Verdict {
    /// Finds the word.
    pub(super) fn new(stability: Option<Stability>, outcome: Outcome, horizon_s: f64) -> Self {
        let shown = |per_s: f64| (per_s * horizon_s).abs() > TOLERANCE;
        let word = match (&outcome.fate, stability) {
            (Some(Fate { failure, .. }), _) => match failure {
                StepFailure::Escaped { .. } | StepFailure::NotFinite { .. } => Word::Lost,
                _ => Word::Halted,
            },
            (None, _) if outcome.error <= ROUNDING => Word::Exact,
            (None, _) if outcome.is_accurate() => Word::Accurate,
            (None, Some(s)) if !s.is_bounded() && shown(s.growth_per_s) => Word::Grows,
            (None, Some(s)) if shown(s.loss_per_s) => Word::Decays,
            _ => Word::Drifting,
        };
        Self { word, stability, outcome, horizon_s }
    }

    /// Whether nothing grows that should not.
    pub fn is_stable(&self) -> bool {
        self.stability.is_some_and(|stability| stability.is_bounded())
    }

    /// Whether the error stays within the tolerance over the horizon.
    pub fn is_accurate(&self) -> bool {
        self.word <= Word::Accurate
    }

    /// The error over the horizon in words.
    fn error(&self) -> String {
        format!("{} in {}", percent(self.outcome.error), duration(self.horizon_s))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let doubling = self.stability.and_then(|stability| stability.doubling_s());
        let doubles = doubling.map(|s| format!("grows, ×2 in {}", duration(s)));
        match (self.word, &self.outcome.fate, &self.stability) {
            (Word::Grows, ..) => return f.write_str(&doubles.unwrap_or_default()),
            (Word::Decays, _, Some(stability)) => {
                let halving = std::f64::consts::LN_2 / stability.loss_per_s;
                return write!(f, "decays, ½ in {}", duration(halving));
            }
            (Word::Lost, Some(fate), _) => {
                let power = superscript(libm::log10(super::ESCAPE).round() as i32);
                return write!(f, "lost, past 10{power} in {}", duration(fate.t));
            }
            (Word::Halted, Some(fate), _) => {
                return write!(f, "halted after {}: {}", duration(fate.t), fate.failure);
            }
            (word, ..) => write!(f, "{}, {}", word.text(), self.error())?,
        }
        let swing = self.stability.and_then(|stability| stability.frequency_error);
        match (doubles, swing) {
            (Some(doubles), _) => write!(f, "; {doubles}"),
            (None, Some(error)) if self.word == Word::Drifting => {
                let sign = if error > 0.0 { "+" } else { "" };
                write!(f, ": bounded, frequency {sign}{}", percent(error))
            }
            _ => Ok(()),
        }
    }
}

fn percent(part: f64) -> String {
    format!("{} %", significant(100.0 * part, 2))
}

/// A length of time to three digits, in the unit that suits it.
pub fn duration(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    const DAY: f64 = 24.0 * HOUR;
    // Up to a thousand seconds as seconds, and two days as hours: they are told from others like them.
    let (unit, name) = match seconds {
        s if s < 999.5 => (1.0, "s"),
        s if s < HOUR => (MINUTE, "min"),
        s if s < 2.0 * DAY => (HOUR, "h"),
        s if s < 999.5 * DAY => (DAY, "days"),
        _ => (365.0 * DAY, "years"),
    };
    format!("{} {name}", round(seconds / unit, 3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Judge, LaneSpec, Scene};
    use crate::sim::integrators::method;

    fn verdict(scene: &str, id: &str, tick_hz: u32) -> Verdict {
        let judge = Judge::new(&Scene::built_in(scene).unwrap(), 1.0);
        judge.verdict(LaneSpec::plain(method(id).unwrap()), tick_hz)
    }

    #[test]
    fn durations_have_three_digits_and_a_fitting_unit() {
        for (seconds, shown) in [
            (0.29, "0.29 s"),
            (2.1234, "2.12 s"),
            (20.0, "20 s"),
            (769.3, "769 s"),
            (1671.0, "27.9 min"),
            (13.7 * 3600.0, "13.7 h"),
            (14.6 * 86_400.0, "14.6 days"),
            (5e8, "15.9 years"),
        ] {
            assert_eq!(duration(seconds), shown);
        }
    }

    #[test]
    fn verdicts_are_a_word_and_its_number() {
        for (scene, id, tick_hz, shown) in [
            ("spring", "explicit-euler", 60, "grows, ×2 in 2.12 s"),
            (
                "spring",
                "semi-implicit-euler",
                60,
                "drifting, 11 % in 20 s: bounded, frequency +0.046 %",
            ),
            ("spring", "improved-euler", 60, "grows, ×2 in 769 s"),
            ("spring", "improved-euler", 300, "accurate, 0.92 % in 20 s; grows, ×2 in 26.7 h"),
            ("spring", "rk4", 60, "accurate, 0.013 % in 20 s"),
            ("spring", "rk4", 10, "decays, ½ in 171 s"),
            ("stiff", "semi-implicit-euler", 49, "lost, past 10³⁸ in 4.14 s"),
            ("ship", "explicit-euler", 2, "drifting, 1.9 % in 60 s"),
            // The worst body speaks.
            ("harbour", "explicit-euler", 60, "grows, ×2 in 2.12 s"),
        ] {
            assert_eq!(verdict(scene, id, tick_hz).to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }
}
