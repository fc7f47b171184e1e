//! The wording of a verdict, which is a word and a number, and the details behind both.
//!
//! A person compares lanes by one word and one number, and a table has room for no more. The number is the one behind
//! the word: the time in which a swing doubles if it grows, the error if it is off.

use std::fmt;

use super::{Comparison, Finding, LongTerm, NoTruth, NotJudged, SwingWidths, Verdict};
use crate::amplitude::Measure;
use crate::chase_finding::ChaseFinding;
use crate::criterion::{TOLERANCE, VISIBLE};
use crate::energy_finding::EnergyFinding;
use crate::outcome::Outcome;
use crate::sim::number::{duration, in_unit, round, significant, superscript};

/// Largest relative frequency error that is too small to cause anything.
const FAINT_PITCH: f64 = 1e-4;

/// Longest plausible halving time, in horizons. A swing that visibly dies away within the horizon, by at least 5 %,
/// halves within 13.5 horizons at a constant rate. A longer halving time belongs to something else.
const MOST_HALVING_HORIZONS: f64 = 20.0;
/// Width of a swing, relative to the true one, from which on it is written as a multiple.
const MULTIPLE: f64 = 1.5;

/// Error in amplitudes from which on it is written as a multiple.
const MANY: f64 = 10.0;

/// Energy change at or below which nothing visible is left, in units of the largest kinetic energy.
const ALL_ENERGY: f64 = -0.995;

/// The number of a verdict, displayed as in the verdict's line.
#[derive(Clone, Debug, PartialEq)]
pub struct VerdictNumber {
    /// The measured quantity, as in `swing doubles`.
    pub quantity: String,
    /// Value of the quantity, in `unit`.
    pub value: f64,
    /// Unit of the value: `s`, `%`, or `×` for a multiple of the true quantity.
    pub unit: &'static str,
    text: String,
}

impl fmt::Display for VerdictNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl VerdictNumber {
    fn new(quantity: impl Into<String>, value: f64, unit: &'static str, text: String) -> Self {
        Self { quantity: quantity.into(), value, unit, text }
    }

    /// Creates a number from a fraction, in percent.
    fn part(quantity: impl Into<String>, part: f64, text: String) -> Self {
        Self::new(quantity, 100.0 * part, "%", text)
    }
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

impl fmt::Display for NotJudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NotJudged::TooMuchWork => "too much work",
            NotJudged::ShorterThanATick => "the scene is shorter than a tick",
            NotJudged::NoFlight => "no flight before the first input",
            NotJudged::Driven => "driven by the clock: only from the start",
        })
    }
}

impl Comparison {
    /// Describes the frequency error of a motion that keeps its size, unless the error is faint: `0.18 % fast`.
    fn pitch(&self) -> Option<String> {
        let error = self.frequency_error.filter(|error| error.abs() > FAINT_PITCH)?;
        let how = if error > 0.0 { "fast" } else { "slow" };
        matches!(self.outcome(), Outcome::LooksRight | Outcome::Bounded)
            .then(|| format!("{} {how}", percent(error.abs())))
    }

    /// Returns the largest width of the swing relative to the true one, if the difference is visible.
    fn wrong_width(&self) -> Option<f64> {
        self.width.filter(|width| (width - 1.0).abs() > VISIBLE)
    }
}

impl Verdict {
    /// Returns the time of the run that is `seconds` after the judged part begins, in words.
    fn moment(&self, seconds: f64) -> String {
        duration(self.starts_at_s + seconds)
    }

    /// Whether nothing grows on the verdict's own body. With several bodies, `long_term` is about all of them.
    fn is_bounded(&self) -> Option<bool> {
        self.of_bodies.get(self.body).unwrap_or(self).long_term.is_bounded
    }

    /// Returns the outcome in a word or two.
    fn word(&self) -> &'static str {
        match (self.outcome(), &self.finding) {
            (Outcome::Bounded, Finding::Bounced(_) | Finding::Spun(_)) => "inaccurate",
            (Outcome::Bounded, _) if self.is_bounded().is_none() => "inaccurate",
            (Outcome::NoTruth, Finding::ByEnergy(found)) => found.word(),
            (outcome, _) => outcome.text(),
        }
    }

    /// Describes the change of the amplitude. It is the time in which the amplitude changes by this factor or, if there
    /// is none, the energy change or, if there is none either, the error.
    fn change(&self, time: Option<f64>, [factor, verb]: [&str; 2]) -> VerdictNumber {
        let horizon = duration(self.horizon_s);
        let measure = self.long_term.measure.name();
        // The energy of a swing varies within a turn, so that at the end it may be on the other side.
        let grows = self.outcome() == Outcome::Grows;
        let change = self.energy_change().filter(|&change| (change > 0.0) == grows);
        match (time, change) {
            (Some(time), _) => {
                let text = format!("{measure} {factor} in {}", brief_duration(time));
                VerdictNumber::new(format!("{measure} {verb}"), time, "s", text)
            }
            (None, Some(change)) => {
                let sign = if change > 0.0 { "+" } else { "" };
                let text = match change <= ALL_ENERGY {
                    true => format!("all its energy in {horizon}"),
                    false => format!("energy {sign}{} in {horizon}", percent(change)),
                };
                VerdictNumber::part("energy change", change, text)
            }
            (None, None) => {
                let error = self.error().unwrap_or(f64::INFINITY);
                VerdictNumber::part(
                    "largest error",
                    error,
                    format!("off by {}", of_amplitude(error)),
                )
            }
        }
    }

    /// Describes the error of a motion that keeps its size, by the first that applies of a wrong width, a delay or
    /// lead, a frequency error and the largest error.
    fn gap(&self, found: &Comparison) -> VerdictNumber {
        let (error, horizon) = (of_amplitude(found.error), duration(self.horizon_s));
        if let Some(width) = found.wrong_width().filter(|_| found.looks_right != Some(true)) {
            let text = match found.widths {
                Some(widths) => widths.to_string(),
                None => format!("swings {}", too_wide(width)),
            };
            return VerdictNumber::new("width", width, "×", text);
        }
        if let Some(early_s) = found.early_s {
            let (way, quantity) = if early_s < 0.0 { ("late", "delay") } else { ("early", "lead") };
            let late_s = early_s.abs();
            let when = if self.starts_at_s > 0.0 {
                format!("at {}", self.moment(self.horizon_s))
            } else {
                format!("after {horizon}")
            };
            let text = format!("{} {way} {when}", short_duration(late_s));
            return VerdictNumber::new(quantity, late_s, "s", text);
        }
        let of_mode = match self.long_term.measure {
            Measure::Modes => Some(("main mode ", "frequency error of the main mode")),
            Measure::Reach => Some(("", "frequency error")),
            Measure::Swing | Measure::Deviation => None,
        };
        let pitch = found.frequency_error.zip(found.pitch());
        if let Some(((mode, quantity), (error, pitch))) = of_mode.zip(pitch) {
            return VerdictNumber::part(quantity, error, format!("{mode}{pitch}"));
        }
        let text = match found.last_error < 0.9 * found.error {
            true => format!("off by {error} at {}", self.moment(found.error_at_s)),
            false => format!("off by {error}"),
        };
        VerdictNumber::part("largest error", found.error, text)
    }

    /// Returns the number behind the word, if there is one.
    pub fn number(&self) -> Option<VerdictNumber> {
        let chased = self.chase.as_ref().and_then(ChaseFinding::number);
        let within =
            |quantity, part, bound| VerdictNumber::part(quantity, part, format!("within {bound}"));
        match (self.outcome(), &self.finding) {
            (_, Finding::Bounced(found)) => {
                let found = found.starting_at(self.starts_at_s);
                let (quantity, value, unit) = found.number();
                Some(VerdictNumber::new(quantity, value, unit, found.to_string()))
            }
            (_, Finding::Spun(found)) => {
                let found = found.starting_at(self.starts_at_s);
                let (quantity, value, unit) = found.number();
                Some(VerdictNumber::new(quantity, value, unit, found.to_string()))
            }
            (Outcome::Accurate | Outcome::LooksRight | Outcome::Bounded, _) if chased.is_some() => {
                let (half_life_s, text) = chased?;
                Some(VerdictNumber::new("half-life", half_life_s, "s", text))
            }
            (Outcome::Rounding, Finding::Compared(found)) => {
                let bound = libm::ceil(libm::log10(100.0 * found.error.max(1e-15))) as i32;
                Some(within("largest error", found.error, format!("10{} %", superscript(bound))))
            }
            (Outcome::Accurate, Finding::Compared(found)) => {
                Some(within("largest error", found.error, percent(found.error)))
            }
            (Outcome::LooksRight | Outcome::Bounded, Finding::Compared(found)) => {
                Some(self.gap(found))
            }
            (Outcome::Grows, _) => {
                let LongTerm { doubles_in_s, parasite_doubles_in_s, .. } = self.long_term;
                Some(match (doubles_in_s, parasite_doubles_in_s) {
                    (None, Some(time)) => {
                        let text = format!("a faint mode ×2 in {}", brief_duration(time));
                        VerdictNumber::new("faint mode doubles", time, "s", text)
                    }
                    (time, _) => self.change(time, ["×2", "doubles"]),
                })
            }
            (Outcome::DiesAway, _) => {
                // A body may lose its fast modes at once and keep the slow ones for days.
                let most_s = MOST_HALVING_HORIZONS * self.horizon_s;
                let halves_in_s = self.long_term.halves_in_s.filter(|&time| time <= most_s);
                Some(self.change(halves_in_s, ["½", "halves"]))
            }
            (_, Finding::Failed { failure, .. }) => {
                let text = format!("at {}", self.moment(failure.t));
                Some(VerdictNumber::new("end of the run", self.starts_at_s + failure.t, "s", text))
            }
            (_, Finding::ByEnergy(found)) => {
                let (percent, text) = found.number()?;
                Some(VerdictNumber::new("energy change", percent, "%", text))
            }
            (_, Finding::NoTruth(NoTruth::Vague(part))) if part.is_finite() => {
                Some(VerdictNumber::part(
                    "error of the truth",
                    *part,
                    format!("known to {}", percent(*part)),
                ))
            }
            (_, Finding::NoTruth(_) | Finding::Compared(_) | Finding::NotJudged(_)) => None,
        }
    }

    /// Returns the word and the number, or the reason why there is no number.
    fn words(&self) -> String {
        let number = match &self.finding {
            Finding::NotJudged(why) => Some(why.to_string()),
            _ => self.number().map(|number| number.text),
        };
        let says_widths = self.outcome() == Outcome::Bounded
            && self
                .comparison()
                .is_some_and(|found| found.widths.is_some() && found.wrong_width().is_some());
        let word = (!says_widths).then(|| self.word().to_owned());
        let words = [word, number];
        words.into_iter().flatten().collect::<Vec<_>>().join(BETWEEN)
    }

    /// Returns in brackets the missing truth and, with several bodies, the body's name.
    fn in_brackets(&self, is_named: bool) -> String {
        let name = (is_named && self.of_bodies.len() > 1).then_some(&*self.body_name);
        let parts: Vec<&str> = self.missing_truth().into_iter().chain(name).collect();
        if parts.is_empty() { String::new() } else { format!(" ({})", parts.join(", ")) }
    }

    /// Returns further findings, in one sentence each, for readers who want more than the word and the number.
    pub fn details(&self) -> Vec<String> {
        let outcome = self.outcome();
        let is_told = outcome == Outcome::Grows || self.failure().is_some();
        let LongTerm { doubles_in_s, parasite_doubles_in_s, .. } = self.long_term;
        let grows = self.long_term.measure.name();
        let growth = doubles_in_s.filter(|_| outcome != Outcome::BlewUp).map(|s| match is_told {
            true => format!("its {grows} doubles in {}", duration(s)),
            false => format!("grows slowly: {grows} ×2 in {}", duration(s)),
        });
        let faint = parasite_doubles_in_s.filter(|_| outcome <= Outcome::Grows);
        [
            self.failure().map(|failure| failure.cause.to_string()),
            self.already(),
            self.comparison().and_then(|found| self.error_over_time(found)),
            self.comparison().and_then(Comparison::pitch),
            growth,
            faint.map(|s| format!("a faint mode grows: ×2 in {}", duration(s))),
            self.by_energy().map(EnergyFinding::to_string),
            self.chase.as_ref().map(ChaseFinding::to_string),
            match &self.finding {
                Finding::NoTruth(why) => Some(why.to_string()),
                _ => None,
            },
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Describes the largest error, its time, and the error that remains.
    fn error_over_time(&self, found: &Comparison) -> Option<String> {
        let (error, horizon) = (of_amplitude(found.error), duration(self.horizon_s));
        let at = self.moment(found.error_at_s);
        match self.outcome() {
            Outcome::Accurate => Some(format!("largest error {error} of the amplitude, at {at}")),
            Outcome::LooksRight | Outcome::Bounded if found.last_error <= TOLERANCE => {
                Some(format!("off by {error} at {at}, settled by {}", self.moment(self.horizon_s)))
            }
            Outcome::LooksRight | Outcome::Bounded => {
                let last = of_amplitude(found.last_error);
                Some(format!("off by up to {error} at {at}, by {last} after {horizon}"))
            }
            _ => None,
        }
    }

    fn line(&self, is_named: bool) -> String {
        self.words() + &self.in_brackets(is_named)
    }

    /// Returns ever shorter wordings for limited room, which are the word and the number, and then only the word. What
    /// is already wrong where a growing swing begins comes first, if there is room. If `is_named`, the wordings name
    /// the body if there are several.
    pub fn wordings(&self, is_named: bool) -> Vec<String> {
        let in_brackets = self.in_brackets(is_named);
        let word = self.word().to_owned() + &in_brackets;
        let already = self.already().map(|already| already + BETWEEN + &self.line(is_named));
        let line = self.line(is_named);
        let brief = match &self.finding {
            Finding::Bounced(found) => Some(line.replace(&found.aside(), "")),
            _ => None,
        };
        let brief = brief.filter(|brief| *brief != line);
        already.into_iter().chain([line]).chain(brief).chain([word]).collect()
    }

    /// Describes a swing, whose exact one has this half width, as an eye sees it: `twice as wide every 2.1 s`. Anything
    /// else has its usual words.
    pub fn for_the_eye(&self, exact: f64, unit: &str) -> String {
        let LongTerm { doubles_in_s, measure, .. } = self.long_term;
        let stays = self.comparison().filter(|found| found.widths.is_none());
        match (self.outcome(), measure, doubles_in_s, stays) {
            (Outcome::Grows, Measure::Swing, Some(time), _) => {
                format!("twice as wide every {}", brief_duration(time))
            }
            (
                Outcome::Rounding | Outcome::Accurate | Outcome::LooksRight | Outcome::Bounded,
                Measure::Swing,
                _,
                Some(found),
            ) => {
                let width = round(exact * found.width.unwrap_or(1.0), 2);
                format!("stays ±{width} {unit}").trim_end().to_owned()
            }
            _ => self.line(false),
        }
    }

    /// Describes the wrong width with which a growing swing begins, with the moment: `2.0 × too wide at 3.0 s`.
    fn already(&self) -> Option<String> {
        let found = self.comparison().filter(|_| self.outcome() > Outcome::Bounded)?;
        let widths = found.widths.filter(|_| found.wrong_width().is_some())?;
        Some(format!("{} at {}", too_wide(widths.own / widths.truth), self.moment(0.0)))
    }
}

/// Text between the word and the number of a verdict.
const BETWEEN: &str = " · ";

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.line(true))
    }
}

/// Writes an error that is given in amplitudes: in percent of one, or as their number from [`MANY`] on. A pendulum that
/// tips over is many amplitudes off.
fn of_amplitude(error: f64) -> String {
    match error {
        MANY..f64::INFINITY => format!("{} amplitudes", significant(error, 2)),
        _ => percent(error),
    }
}

/// Writes a wrong width of a swing: in percent, or as a multiple from [`MULTIPLE`] on.
fn too_wide(width: f64) -> String {
    let multiple = significant(width, 2);
    match width {
        width if width >= MULTIPLE => format!("{multiple} × too wide"),
        width if width > 1.0 => format!("{} too wide", percent(width - 1.0)),
        width if width * MULTIPLE > 1.0 => format!("{} too narrow", percent(1.0 - width)),
        _ => format!("{multiple} × as wide"),
    }
}

impl fmt::Display for SwingWidths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [own, truth] = [self.own, self.truth].map(|width| round(width, 3));
        write!(f, "stays ±{own} {}", self.unit)?;
        write!(f, "{}(exact ±{truth})", if self.unit.is_empty() { "" } else { " " })
    }
}

fn percent(part: f64) -> String {
    format!("{} %", significant(100.0 * part, 2))
}

/// Writes a duration to two digits, in milliseconds if it is shorter than a second.
fn short_duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.9995 => format!("{} ms", significant(1e3 * s, 2)),
        s => brief_duration(s),
    }
}

/// Writes a duration to two digits, for a doubling or halving time.
fn brief_duration(seconds: f64) -> String {
    in_unit(seconds, |value| significant(value, 2))
}

#[cfg(test)]
mod tests {
    use super::super::RunFailure;
    use super::*;
    use crate::Judge;
    use crate::amplitude::Trend;
    use crate::scene::{LaneSpec, Scene};
    use crate::sim::integrators::{StepFailure, method};

    fn verdict(scene: &str, id: &str, tick_hz: u32) -> Verdict {
        let judge = Judge::new(&Scene::built_in(scene).unwrap());
        judge.verdict(LaneSpec::plain(method(id).unwrap()), tick_hz)
    }

    #[test]
    fn a_verdict_is_displayed_as_outcome_and_number() {
        for (scene, id, tick_hz, shown) in [
            ("spring", "explicit-euler", 60, "grows · swing ×2 in 2.1 s"),
            ("spring", "semi-implicit-euler", 60, "looks right · 17 ms early after 20 s"),
            ("spring", "improved-euler", 60, "looks right · 36 ms early after 20 s"),
            ("spring", "improved-euler", 300, "accurate · within 0.92 %"),
            ("spring", "rk4", 60, "accurate · within 0.013 %"),
            ("spring", "rk4", 10, "dies away · swing ½ in 171 s"),
            ("stiff", "semi-implicit-euler", 49, "blows up · at 4.14 s"),
            ("stiff", "semi-implicit-euler", 60, "bounded · swings 1.8 × too wide"),
            ("ship", "explicit-euler", 2, "looks right · off by 1.9 % at 10 s"),
            // The verdict is that on the worst body.
            ("harbour", "explicit-euler", 60, "grows · swing ×2 in 2.1 s (spring)"),
        ] {
            assert_eq!(verdict(scene, id, tick_hz).to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }

    #[test]
    fn wordings_of_a_verdict_get_shorter_and_shorter() {
        let found = verdict("harbour", "improved-euler", 60);
        assert_eq!(
            found.wordings(true),
            ["looks right · 36 ms early after 20 s (spring)", "looks right (spring)"]
        );
        assert!(found.wordings(false).iter().all(|said| !said.contains("spring")));
        assert_eq!(
            found.details(),
            [
                "off by up to 23 % at 20 s, by 23 % after 20 s",
                "0.18 % fast",
                "grows slowly: swing ×2 in 769 s"
            ]
        );
        let Finding::Compared(compared) = found.finding else { panic!("{found}") };
        let by_energy = EnergyFinding {
            change: 0.5,
            trend: Trend::None,
            drift_percent: None,
            is_conserved: true,
            spectral_radius: None,
        };
        let escaped = StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN };
        let stopped = StepFailure::LinearSolveFailed;
        let of_change =
            |change| Finding::Compared(Comparison { change, looks_right: None, ..compared });
        let of_trend = |trend| Finding::ByEnergy(EnergyFinding { trend, ..by_energy });
        let failed = |cause: &StepFailure, by_energy| Finding::Failed {
            failure: RunFailure { t: 4.0, cause: cause.clone() },
            by_energy,
        };
        for finding in [
            Finding::Compared(Comparison { error: 1e-12, ..compared }),
            Finding::Compared(Comparison { error: 1e-3, ..compared }),
            of_change(Trend::None),
            of_change(Trend::Grows),
            of_change(Trend::Dies),
            of_trend(Trend::None),
            of_trend(Trend::Grows),
            of_trend(Trend::Dies),
            failed(&escaped, None),
            failed(&escaped, Some(by_energy)),
            failed(&stopped, None),
            failed(&stopped, Some(by_energy)),
            Finding::NoTruth(NoTruth::Vague(0.1)),
            Finding::NotJudged(NotJudged::TooMuchWork),
        ] {
            let verdict = Verdict { finding, ..found.clone() };
            let said = verdict.wordings(true);
            assert!(said.is_sorted_by_key(|said| std::cmp::Reverse(said.len())), "{said:?}");
            assert_eq!(said[0], verdict.to_string());
        }
    }

    #[test]
    fn moments_are_run_times_and_durations_count_from_the_judged_start() {
        for (scene, id, tick_hz, shown) in [
            ("spring", "explicit-euler", 60, "grows · swing ×2 in 2.1 s"),
            ("stiff", "semi-implicit-euler", 49, "blows up · at 104 s"),
            ("ship", "explicit-euler", 2, "looks right · off by 1.9 % at 110 s"),
        ] {
            let verdict = verdict(scene, id, tick_hz).starting_at(100.0);
            assert_eq!(verdict.to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }

    #[test]
    fn the_details_of_a_failure_name_its_cause() {
        let blows_up = verdict("stiff", "semi-implicit-euler", 49);
        let why = StepFailure::LinearSolveFailed;
        let finding = Finding::Failed {
            failure: RunFailure { t: 4.14, cause: why.clone() },
            by_energy: None,
        };
        let gives_up = Verdict { finding, ..blows_up.clone() };
        assert_eq!(gives_up.to_string(), "gives up · at 4.14 s");
        assert_eq!(gives_up.details()[0], why.to_string());
    }
}
