//! What a verdict says: one line, or fewer words of it.

use std::fmt;

use super::{Comparison, Finding, LongTerm, NoTruth, NotJudged, Verdict};
use crate::lab::analysis::chase_finding::ChaseFinding;
use crate::lab::analysis::energy_finding::EnergyFinding;
use crate::lab::analysis::limits::TOLERANCE;
use crate::lab::analysis::outcome::Outcome;
use crate::sim::number::{round, significant, superscript};

/// The largest relative error of a frequency that may be rounding alone.
const FREQUENCY_ROUNDING: f64 = 1e-9;
/// The largest error of a motion that is only out of phase, in amplitudes.
const ANY_PHASE: f64 = 2.0;

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
        })
    }
}

impl Comparison {
    /// The frequency error, if there is one beyond rounding: `0.18 % fast`.
    fn pitch(&self) -> Option<String> {
        let beyond = self.frequency_error.filter(|error| error.abs() > FREQUENCY_ROUNDING);
        let is_told = self.outcome() == Outcome::OutOfPhase || self.leap.is_some();
        beyond.filter(|_| is_told).map(|error| {
            let how = if error > 0.0 { "fast" } else { "slow" };
            format!("{} {how}", percent(error.abs()))
        })
    }

    /// The frequency error where it says more than the error, which is past all phases and stays.
    fn pitch_that_tells(&self) -> Option<String> {
        let tells = self.error > ANY_PHASE && self.last_error > TOLERANCE && self.leap.is_none();
        self.pitch().filter(|_| tells)
    }
}

impl Verdict {
    /// The time of the run, `seconds` after the judged part begins.
    fn moment(&self, seconds: f64) -> String {
        duration(self.starts_at_s + seconds)
    }

    /// Where the run begins in which the lane fails, if that is said.
    fn start(&self, said: Parts) -> String {
        match self.starts_at_s {
            _ if !said.start => String::new(),
            0.0 => ", if run from the start".to_owned(),
            seconds => format!(", if run from {}", duration(seconds)),
        }
    }

    /// In few words from where it is run that the lane fails, if it does.
    pub(in crate::lab) fn fails_in_brief(&self) -> Option<String> {
        let how = match self.outcome() {
            Outcome::BlewUp => "blows up",
            Outcome::GaveUp => "gives up",
            _ => return None,
        };
        Some(format!("{how}{}", self.start(Parts::EVERYTHING)))
    }

    /// The change of the swing: its doubling or halving time, or else its energy change, or else its error.
    fn swing(&self, time: Option<f64>, factor: &str) -> String {
        let horizon = duration(self.horizon_s);
        match (time, self.energy_change()) {
            (Some(time), _) => format!("{} {factor} in {}", self.what_grows(), duration(time)),
            (None, Some(change)) => {
                let sign = if change > 0.0 { "+" } else { "" };
                match percent(change).as_str() {
                    "\u{2212}100 %" => format!("all of it in {horizon}"),
                    part => format!("{sign}{part} in {horizon}"),
                }
            }
            (None, None) => {
                format!("off by {} in {horizon}", percent(self.error().unwrap_or(f64::INFINITY)))
            }
        }
    }

    fn what_grows(&self) -> &'static str {
        if self.long_term.swings { "swing" } else { "deviation" }
    }

    /// The error and its time, and whether it is a phase error: a phase error is at most twice the amplitude, and a motion
    /// that dies away has other errors too.
    fn out_of_phase(&self, found: &Comparison) -> String {
        let (error, horizon) = (percent(found.error), duration(self.horizon_s));
        if self.long_term.swings && found.energy_change.is_some() && found.error <= ANY_PHASE {
            return format!("out of phase by {error} after {horizon}");
        }
        if let Some(pitch) = found.pitch_that_tells() {
            return format!("{pitch}: off by up to {error} in {horizon}");
        }
        let at = self.moment(found.error_at_s);
        match found.last_error {
            last if last <= TOLERANCE => {
                let settled = self.moment(self.horizon_s);
                format!("off by {error} at {at}, settled by {settled}")
            }
            last if last < 0.9 * found.error => {
                format!("off by {error} at {at}, by {} after {horizon}", percent(last))
            }
            _ => format!("off by {error} after {horizon}"),
        }
    }

    /// The frequency error and, of several, the body's name in brackets, as far as they are said and there are any.
    fn in_brackets(&self, said: Parts) -> String {
        let found =
            self.comparison().filter(|found| said.pitch && found.pitch_that_tells().is_none());
        let pitch = found.and_then(Comparison::pitch);
        let name = (said.name && self.of_bodies.len() > 1).then(|| self.body_name.clone());
        let parts: Vec<String> = pitch.into_iter().chain(name).collect();
        if parts.is_empty() { String::new() } else { format!(" ({})", parts.join(", ")) }
    }

    /// What is found, without brackets and clauses.
    fn words(&self, said: Parts) -> String {
        let horizon = duration(self.horizon_s);
        match (self.outcome(), &self.finding) {
            (Outcome::Rounding, Finding::Compared(found)) => {
                let bound = libm::ceil(libm::log10(found.error.max(1e-15))) as i32;
                format!("within rounding: error below 10{} in {horizon}", superscript(bound))
            }
            (Outcome::Accurate, Finding::Compared(found)) => {
                format!("accurate: error {} in {horizon}", percent(found.error))
            }
            (Outcome::OutOfPhase, Finding::Compared(found)) => {
                let is_stable = said.is_stable && self.long_term.is_bounded == Some(true);
                format!("{}{}", if is_stable { "stable, " } else { "" }, self.out_of_phase(found))
            }
            (Outcome::GainsEnergy, Finding::Compared(Comparison { leap: Some(widest), .. })) => {
                format!("gains energy: {} up to ×{}", self.what_grows(), significant(*widest, 2))
            }
            (Outcome::GainsEnergy, _) => {
                // Without a swing and an energy nobody can say what it gains.
                let is_known = self.long_term.doubles_in_s.or(self.energy_change()).is_some();
                let word = if is_known { "gains energy" } else { "grows" };
                format!("{word}: {}", self.swing(self.long_term.doubles_in_s, "×2"))
            }
            (Outcome::LosesEnergy, _) => {
                format!("loses energy: {}", self.swing(self.long_term.halves_in_s, "½"))
            }
            (Outcome::GaveUp, Finding::Failed { failure, .. }) => {
                let start = self.start(said);
                format!("will give up at {}{start}: {}", self.moment(failure.t), failure.cause)
            }
            (_, Finding::Failed { failure, .. }) => {
                format!("will blow up at {}", self.moment(failure.t))
            }
            (_, Finding::ByEnergy(found)) => found.kept(&horizon),
            (outcome, Finding::NoTruth(why)) => format!("{}: {why}", outcome.text()),
            (outcome, Finding::NotJudged(why)) => format!("{}: {why}", outcome.text()),
            (outcome, Finding::Compared(_)) => outcome.text().to_owned(),
        }
    }

    /// What is said after the finding, each behind a semicolon.
    fn clauses(&self) -> Vec<String> {
        let outcome = self.outcome();
        let is_told = outcome == Outcome::GainsEnergy || self.failure().is_some();
        let LongTerm { doubles_in_s, parasite_doubles_in_s, .. } = self.long_term;
        let later = doubles_in_s.filter(|_| !is_told);
        let faint = parasite_doubles_in_s.filter(|_| outcome <= Outcome::GainsEnergy);
        [
            later.map(|s| format!("grows slowly: {} ×2 in {}", self.what_grows(), duration(s))),
            faint.map(|s| format!("a faint mode grows: ×2 in {}", duration(s))),
            self.by_energy().map(EnergyFinding::to_string),
            self.chase.as_ref().map(ChaseFinding::to_string),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    fn line(&self, said: Parts) -> String {
        let mut line = self.words(said) + &self.in_brackets(said);
        if self.outcome() == Outcome::BlewUp {
            line += &self.start(said);
        }
        if said.clauses {
            self.clauses().iter().for_each(|clause| line += &format!("; {clause}"));
        }
        line
    }

    /// The verdict in fewer and fewer words, each with where the judged run begins: for beside a run that was changed on its
    /// way, of which it tells nothing.
    pub fn wordings_of_another_run(&self, is_named: bool) -> Vec<String> {
        let start = match self.starts_at_s {
            0.0 => "the start".to_owned(),
            seconds => duration(seconds),
        };
        let wordings = self.wordings(is_named).into_iter().skip(1);
        wordings.map(|words| format!("from {start}: {words}")).collect()
    }

    /// The verdict in fewer and fewer words, as room is short; the first says everything. The body is named where there are
    /// several, if `is_named`.
    pub fn wordings(&self, is_named: bool) -> Vec<String> {
        let all = Parts { name: is_named, ..Parts::EVERYTHING };
        let whole = Parts { start: false, ..all };
        let first = Parts { clauses: false, ..whole };
        let bare = Parts { pitch: false, ..first };
        let shorter = Parts { is_stable: false, ..bare };
        let outcome = format!("{}{}", self.outcome().text(), self.in_brackets(bare));
        let mut wordings = vec![self.line(all), self.line(whole)];
        let Some(missing) = self.missing_truth() else {
            wordings.extend([first, bare, shorter].map(|said| self.line(said)));
            wordings.push(outcome);
            return wordings;
        };
        // Without its reason such a verdict would look like any other.
        let why = |said: &str| format!("{said}; {missing}");
        wordings.extend([first, shorter].map(|said| why(&self.line(said))));
        match self.outcome() {
            Outcome::NoTruth => wordings.push(missing.to_owned()),
            _ => wordings.extend([why(&outcome), outcome]),
        }
        wordings
    }
}

/// Which of its parts a verdict says besides its finding.
#[derive(Clone, Copy)]
struct Parts {
    /// Where the run begins in which the lane fails: that run need not be the one on the screen.
    start: bool,
    clauses: bool,
    pitch: bool,
    name: bool,
    /// That a motion out of phase does not grow.
    is_stable: bool,
}

impl Parts {
    const EVERYTHING: Self =
        Self { start: true, clauses: true, pitch: true, name: true, is_stable: true };
}

/// The alternate form, `{:#}`, also says where a failing run begins.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.line(Parts { start: f.alternate(), ..Parts::EVERYTHING }))
    }
}

fn percent(part: f64) -> String {
    format!("{} %", significant(100.0 * part, 2))
}

/// A duration to three digits, in the unit that fits its length.
pub fn duration(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    const DAY: f64 = 24.0 * HOUR;
    // Seconds up to a thousand and hours up to two days, so that similar durations have one unit.
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
    use super::super::RunFailure;
    use super::*;
    use crate::lab::analysis::amplitude::Trend;
    use crate::lab::{Judge, LaneSpec, Scene};
    use crate::sim::integrators::{StepFailure, method};

    fn verdict(scene: &str, id: &str, tick_hz: u32) -> Verdict {
        let judge = Judge::new(&Scene::built_in(scene).unwrap());
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
    fn a_verdict_shows_as_its_outcome_and_the_number_behind_it() {
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
                "out of phase by 23 % after 20 s (0.18 % fast); grows slowly: swing ×2 in 769 s",
            ),
            (
                "spring",
                "improved-euler",
                300,
                "accurate: error 0.92 % in 20 s; grows slowly: swing ×2 in 26.7 h",
            ),
            ("spring", "rk4", 60, "accurate: error 0.013 % in 20 s"),
            ("spring", "rk4", 10, "loses energy: swing ½ in 171 s"),
            ("stiff", "semi-implicit-euler", 49, "will blow up at 4.14 s"),
            ("stiff", "semi-implicit-euler", 60, "gains energy: swing up to ×2.4 (18 % fast)"),
            ("ship", "explicit-euler", 2, "stable, off by 1.9 % at 10 s, settled by 60 s"),
            // The verdict is that of the worst body.
            ("harbour", "explicit-euler", 60, "gains energy: swing ×2 in 2.12 s (free spring)"),
        ] {
            assert_eq!(verdict(scene, id, tick_hz).to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }

    #[test]
    fn a_frequency_that_is_right_but_for_rounding_is_told_of_no_error() {
        let found = verdict("spring", "semi-implicit-euler", 60);
        let Finding::Compared(compared) = found.finding else { panic!("{found}") };
        let told = |error| {
            let finding =
                Finding::Compared(Comparison { frequency_error: Some(error), ..compared });
            Verdict { finding, ..found.clone() }.to_string()
        };
        assert!(told(4e-15).ends_with("after 20 s") && told(1e-6).ends_with("% fast)"));
    }

    #[test]
    fn a_verdict_is_said_in_fewer_and_fewer_words() {
        let found = verdict("harbour", "improved-euler", 60);
        assert_eq!(
            found.wordings(true)[1..],
            [
                "out of phase by 23 % after 20 s (0.18 % fast, free spring); grows slowly: swing ×2 in 769 s",
                "out of phase by 23 % after 20 s (0.18 % fast, free spring)",
                "out of phase by 23 % after 20 s (free spring)",
                "out of phase by 23 % after 20 s (free spring)",
                "out of phase (free spring)",
            ]
        );
        assert!(found.wordings(false).iter().all(|said| !said.contains("free spring")));
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
        let of_change = |change| Finding::Compared(Comparison { change, ..compared });
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
            assert_eq!(said[0], format!("{verdict:#}"));
        }
    }

    #[test]
    fn moments_are_times_of_the_run_and_lengths_count_from_where_it_is_judged() {
        for (scene, id, tick_hz, shown) in [
            ("spring", "explicit-euler", 60, "gains energy: swing ×2 in 2.12 s"),
            ("stiff", "semi-implicit-euler", 49, "will blow up at 104 s"),
            ("ship", "explicit-euler", 2, "stable, off by 1.9 % at 110 s, settled by 160 s"),
        ] {
            let verdict = verdict(scene, id, tick_hz).starting_at(100.0);
            assert_eq!(verdict.to_string(), shown, "{scene} {id} {tick_hz} Hz");
        }
    }

    #[test]
    fn where_a_run_begins_is_said_after_when_it_fails_and_before_why() {
        let blows_up = verdict("stiff", "semi-implicit-euler", 49);
        let found = EnergyFinding {
            change: 0.5,
            trend: Trend::None,
            drift_percent: None,
            is_conserved: true,
            spectral_radius: None,
        };
        let failure = blows_up.failure().unwrap().clone();
        let finding = Finding::Failed { failure: failure.clone(), by_energy: Some(found) };
        let by_energy = Verdict { finding, ..blows_up.clone() };
        let why = StepFailure::LinearSolveFailed;
        let failure = RunFailure { cause: why.clone(), ..failure };
        let finding = Finding::Failed { failure, by_energy: None };
        let gives_up = Verdict { finding, ..blows_up.clone() };
        for (verdict, shown) in [
            (blows_up.clone(), "will blow up at 4.14 s, if run from the start".to_owned()),
            (
                blows_up.clone().starting_at(100.0),
                "will blow up at 104 s, if run from 100 s".into(),
            ),
            (by_energy, format!("will blow up at 4.14 s, if run from the start; {found}")),
            (gives_up, format!("will give up at 4.14 s, if run from the start: {why}")),
        ] {
            assert_eq!(format!("{verdict:#}"), shown);
            let start = verdict.start(Parts::EVERYTHING);
            assert_eq!(verdict.to_string(), shown.replace(&*start, ""));
        }
    }
}
