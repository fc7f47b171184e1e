//! What is to be said of a method on a scene: one word, and the number behind it.

use std::fmt;

use super::limits::TOLERANCE;
use crate::lab::number::{round, significant, superscript};
use crate::sim::integrators::StepFailure;

/// The word, from best to worst. It speaks of the scene's length; what shows only later follows it in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Word {
    /// No error but rounding.
    Rounding,
    /// The error stays within [`TOLERANCE`](super::TOLERANCE) of the amplitude.
    Accurate,
    /// It takes too much work to judge, or the scene has no tick to judge.
    NotJudged,
    /// There is no truth to hold it against, or none that is precise enough.
    NoTruth,
    /// The error does not stay within the tolerance, though the amplitude is about what it is in truth.
    OutOfPhase,
    /// The amplitude dies away that should stay.
    LosesEnergy,
    /// The amplitude grows that should not.
    GainsEnergy,
    /// The method's solver failed.
    GaveUp,
    /// A value left the range that is followed.
    BlewUp,
}

impl Word {
    /// Every word, from best to worst.
    pub const ALL: [Self; 9] = [
        Self::Rounding,
        Self::Accurate,
        Self::NotJudged,
        Self::NoTruth,
        Self::OutOfPhase,
        Self::LosesEnergy,
        Self::GainsEnergy,
        Self::GaveUp,
        Self::BlewUp,
    ];

    /// Its name in output, in kebab case.
    pub fn id(self) -> &'static str {
        match self {
            Word::Rounding => "rounding",
            Word::Accurate => "accurate",
            Word::NotJudged => "not-judged",
            Word::NoTruth => "no-truth",
            Word::OutOfPhase => "out-of-phase",
            Word::LosesEnergy => "loses-energy",
            Word::GainsEnergy => "gains-energy",
            Word::GaveUp => "gave-up",
            Word::BlewUp => "blew-up",
        }
    }

    /// As people read it.
    pub fn text(self) -> &'static str {
        match self {
            Word::Rounding => "within rounding",
            Word::Accurate => "accurate",
            Word::NotJudged => "not judged",
            Word::NoTruth => "no truth",
            Word::OutOfPhase => "out of phase",
            Word::LosesEnergy => "loses energy",
            Word::GainsEnergy => "gains energy",
            Word::GaveUp => "gave up",
            Word::BlewUp => "blew up",
        }
    }

    /// How much it should worry a developer.
    pub fn severity(self) -> Severity {
        match self {
            Word::Rounding | Word::Accurate => Severity::Fine,
            Word::NotJudged | Word::NoTruth => Severity::Unknown,
            Word::OutOfPhase => Severity::Doubtful,
            Word::LosesEnergy | Word::GainsEnergy | Word::GaveUp | Word::BlewUp => Severity::Bad,
        }
    }
}

/// How much a verdict should worry a developer; each has one colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Nothing to see.
    Fine,
    /// Seen, if one looks for it.
    Doubtful,
    /// Seen at once.
    Bad,
    /// Nothing is known.
    Unknown,
}

/// What ended a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Fate {
    /// When, in simulated seconds.
    pub t: f64,
    /// How.
    pub failure: StepFailure,
}

/// Why there is no truth to hold a lane against.
#[derive(Clone, Debug, PartialEq)]
pub enum NoTruth {
    /// The exact solution or the reference cannot be found.
    Failed(StepFailure),
    /// It may be off by this part of the amplitude.
    Vague(f64),
}

impl fmt::Display for NoTruth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoTruth::Failed(failure) => write!(f, "the true motion is not known: it {failure}"),
            NoTruth::Vague(part) if part.is_finite() => {
                write!(f, "the true motion is known to {} of the amplitude only", percent(*part))
            }
            NoTruth::Vague(_) => f.write_str("the true motion is not known precisely enough"),
        }
    }
}

/// Why a lane is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotJudged {
    /// It takes more than [`MOST_WORK`](super::MOST_WORK).
    TooMuchWork,
    /// The scene is over before its first tick.
    ShorterThanATick,
}

impl fmt::Display for NotJudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NotJudged::TooMuchWork => "too much work",
            NotJudged::ShorterThanATick => "the scene is shorter than a tick",
        })
    }
}

/// What is to be said of a lane over a stretch of a scene. Shows as one line. Amplitudes and times to double or
/// halve are those of the swing; its energy doubles and halves twice as fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The word.
    pub word: Word,
    /// The body that fares worst, by its place in the scene: the one that all of this is about.
    pub body: usize,
    /// Its name, in a scene of several bodies.
    pub body_name: Option<String>,
    /// The largest error of a coordinate or a velocity, as a part of its amplitude; infinite for a body that did not
    /// get through.
    pub error: f64,
    /// When the error was largest, in seconds.
    pub error_at_s: f64,
    /// The largest error in the last twentieth of the stretch.
    pub last_error: f64,
    /// Whether the body swings in truth.
    pub swings: bool,
    /// The seconds in which the amplitude doubles that in truth does not; `None` where it does not within a year, or
    /// where that cannot be said.
    pub doubles_in_s: Option<f64>,
    /// The seconds in which the amplitude halves that in truth stays; `None` as above.
    pub halves_in_s: Option<f64>,
    /// The seconds in which a mode doubles that carries next to none of the motion.
    pub parasite_doubles_in_s: Option<f64>,
    /// The change of the energy over the stretch, as a part of the energy in motion; `None` where none is conserved.
    pub energy_change: Option<f64>,
    /// How much too fast the body swings, as a part of its frequency; of several modes, the one that carries most of
    /// the motion. `None` where nothing swings, or where the error is not steady enough to be told.
    pub frequency_error: Option<f64>,
    /// Whether nothing grows that should not, in the long run too; `None` where that is not known.
    pub is_bounded: Option<bool>,
    /// The energy drift of largest magnitude, in percent of the energy in motion; `None` where none is conserved.
    pub energy_drift: Option<f64>,
    /// What ended the run, if something did.
    pub fate: Option<Fate>,
    /// Why there is no truth, where there is none.
    pub no_truth: Option<NoTruth>,
    /// Why the lane is not judged, where it is not.
    pub not_judged: Option<NotJudged>,
    /// Evaluations of all bodies' accelerations over the stretch.
    pub evaluations: u64,
    /// How far the body came, in simulated seconds.
    pub seconds: f64,
    /// The stretch, in simulated seconds.
    pub horizon_s: f64,
}

impl Verdict {
    /// Whether the error stays within the tolerance over the stretch.
    pub fn is_accurate(&self) -> bool {
        self.word <= Word::Accurate
    }

    pub(super) fn is_worse_than(&self, other: &Self) -> bool {
        (self.word, self.error) > (other.word, other.error)
    }

    /// What becomes of the swing, by its time or else by its energy.
    fn swing(&self, time: Option<f64>, factor: &str) -> String {
        match (time, self.energy_change) {
            (Some(time), _) => format!("{} {factor} in {}", self.what_grows(), duration(time)),
            (None, Some(change)) => {
                let sign = if change > 0.0 { "+" } else { "" };
                format!("{sign}{} of its energy in {}", percent(change), duration(self.horizon_s))
            }
            (None, None) => {
                format!("off by {} in {}", percent(self.error), duration(self.horizon_s))
            }
        }
    }

    fn what_grows(&self) -> &'static str {
        if self.swings { "swing" } else { "deviation" }
    }

    /// What the error is, when, and whether it is one of time: a phase alone makes no error of more than twice the
    /// amplitude, and what dies away is off for other reasons too.
    fn out_of_phase(&self) -> String {
        let (error, horizon) = (percent(self.error), duration(self.horizon_s));
        let bounded = if self.is_bounded == Some(true) { "stable, " } else { "" };
        let is_phase = self.swings && self.energy_change.is_some() && self.error <= 2.0;
        if is_phase {
            return format!("{bounded}out of phase by {error} after {horizon}");
        }
        let at = duration(self.error_at_s);
        match self.last_error {
            last if last <= TOLERANCE => {
                format!("{bounded}off by {error} at {at}, settled by {horizon}")
            }
            last if last < 0.9 * self.error => {
                format!("{bounded}off by {error} at {at}, by {} after {horizon}", percent(last))
            }
            _ => format!("{bounded}off by {error} after {horizon}"),
        }
    }

    /// What stands in brackets after the word and its number: how fast the body swings, and which it is.
    fn in_brackets(&self) -> String {
        let pitch = self.frequency_error.filter(|_| self.word == Word::OutOfPhase).map(|error| {
            let how = if error > 0.0 { "fast" } else { "slow" };
            format!("{} {how}", percent(error.abs()))
        });
        let parts: Vec<String> = pitch.into_iter().chain(self.body_name.clone()).collect();
        if parts.is_empty() { String::new() } else { format!(" ({})", parts.join(", ")) }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let horizon = duration(self.horizon_s);
        match (self.word, &self.fate, &self.no_truth) {
            (Word::Rounding, ..) => {
                let bound = libm::ceil(libm::log10(self.error.max(1e-15))) as i32;
                write!(f, "within rounding: error below 10{} in {horizon}", superscript(bound))?;
            }
            (Word::Accurate, ..) => {
                write!(f, "accurate: error {} in {horizon}", percent(self.error))?
            }
            (Word::OutOfPhase, ..) => f.write_str(&self.out_of_phase())?,
            (Word::GainsEnergy, ..) => {
                write!(f, "gains energy: {}", self.swing(self.doubles_in_s, "×2"))?;
            }
            (Word::LosesEnergy, ..) => {
                write!(f, "loses energy: {}", self.swing(self.halves_in_s, "½"))?;
            }
            (Word::BlewUp, Some(fate), _) => write!(f, "blew up after {}", duration(fate.t))?,
            (Word::GaveUp, Some(fate), _) => {
                write!(f, "gave up after {}: {}", duration(fate.t), fate.failure)?;
            }
            (Word::NoTruth, _, Some(why)) => write!(f, "no truth: {why}")?,
            (word, ..) => f.write_str(word.text())?,
        }
        if let Some(why) = self.not_judged.filter(|_| self.word == Word::NotJudged) {
            write!(f, ": {why}")?;
        }
        f.write_str(&self.in_brackets())?;
        let is_told = matches!(self.word, Word::GainsEnergy | Word::BlewUp | Word::GaveUp);
        let later = self.doubles_in_s.filter(|_| !is_told);
        if let Some(seconds) = later {
            write!(f, "; {} ×2 in {}", self.what_grows(), duration(seconds))?;
        }
        if let Some(seconds) = self.parasite_doubles_in_s.filter(|_| self.word <= Word::GainsEnergy)
        {
            write!(f, "; a faint mode ×2 in {}", duration(seconds))?;
        }
        Ok(())
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
            ("spring", "explicit-euler", 60, "gains energy: swing ×2 in 2.12 s"),
            (
                "spring",
                "semi-implicit-euler",
                60,
                "stable, out of phase by 11 % after 20 s (0.046 % fast)",
            ),
            (
                "spring",
                "improved-euler",
                60,
                "out of phase by 23 % after 20 s (0.18 % fast); swing ×2 in 769 s",
            ),
            ("spring", "improved-euler", 300, "accurate: error 0.92 % in 20 s; swing ×2 in 26.7 h"),
            ("spring", "rk4", 60, "accurate: error 0.013 % in 20 s"),
            ("spring", "rk4", 10, "loses energy: swing ½ in 171 s"),
            ("stiff", "semi-implicit-euler", 49, "blew up after 4.14 s"),
            ("ship", "explicit-euler", 2, "stable, off by 1.9 % at 10 s, settled by 60 s"),
            // The worst body speaks.
            ("harbour", "explicit-euler", 60, "gains energy: swing ×2 in 2.12 s (free spring)"),
        ] {
            assert_eq!(verdict(scene, id, tick_hz).to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }
}
