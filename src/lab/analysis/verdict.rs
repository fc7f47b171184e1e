//! The verdict on a method on a scene: its outcome and the numbers behind it.

use std::fmt;

use super::chase_finding::ChaseFinding;
use super::energy_finding::EnergyFinding;
use super::limits::TOLERANCE;
use super::outcome::Outcome;
use crate::lab::follow::StopReason;
use crate::sim::bodies::Truth;
use crate::sim::integrators::StepFailure;
use crate::sim::number::{round, significant, superscript};

/// The largest relative error of a frequency that may be rounding alone.
const FREQUENCY_ROUNDING: f64 = 1e-9;
/// The largest error of a motion that is only out of phase, in amplitudes.
const ANY_PHASE: f64 = 2.0;

/// Why and when a body's run ended early.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFailure {
    /// When, in simulated seconds.
    pub t: f64,
    /// Why.
    pub cause: StepFailure,
}

impl RunFailure {
    /// That of a run that stopped at `t` (s), if it failed.
    pub(super) fn of(stop: StopReason, t: f64) -> Option<Self> {
        match stop {
            StopReason::Failed(cause) => Some(Self { t, cause }),
            _ => None,
        }
    }

    pub(super) fn outcome(&self) -> Outcome {
        match self.cause {
            StepFailure::Escaped { .. } | StepFailure::NotFinite { .. } => Outcome::BlewUp,
            _ => Outcome::GaveUp,
        }
    }
}

/// Why a lane cannot be compared with the truth.
#[derive(Clone, Debug, PartialEq)]
pub enum NoTruth {
    /// The exact solution or the reference has failed.
    Failed(StepFailure),
    /// Its error may be as large as this part of the amplitude.
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
    /// Its run takes more than [`MAX_WORK`](super::MAX_WORK).
    TooMuchWork,
    /// The scene is shorter than one tick.
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

/// The verdict on a lane over a horizon; displayed as one line. Doubling and halving times are those of the amplitude:
/// the energy doubles and halves in half the time.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The outcome.
    pub outcome: Outcome,
    /// The index in the scene of the worst body, which the verdict is about.
    pub body: usize,
    /// The body's name; `None` in a scene of one body.
    pub body_name: Option<String>,
    /// The largest error of a coordinate or a velocity, in amplitudes; infinite for a body that failed.
    pub error: f64,
    /// The time of the largest error, in seconds.
    pub error_at_s: f64,
    /// The largest error in the last twentieth of the horizon.
    pub last_error: f64,
    /// Whether the body swings in truth.
    pub swings: bool,
    /// The time in seconds in which the amplitude doubles, if it does not in truth; `None` if it does not double within a
    /// year or if that is not known.
    pub doubles_in_s: Option<f64>,
    /// The time in seconds in which the amplitude halves, if it is constant in truth; `None` if it does not halve within a
    /// year or if that is not known.
    pub halves_in_s: Option<f64>,
    /// The doubling time in seconds of a mode that has next to no energy at the start.
    pub parasite_doubles_in_s: Option<f64>,
    /// The change of the energy over the horizon, in units of the largest true kinetic energy; `None` if energy is not
    /// conserved.
    pub energy_change: Option<f64>,
    /// The relative frequency error, positive if the body swings too fast; of several modes, that of the one with the most
    /// energy. `None` if nothing swings or the error is not steady.
    pub frequency_error: Option<f64>,
    /// Whether nothing grows that does not grow in truth, in the long run too; `None` if that is not known.
    pub is_bounded: Option<bool>,
    /// The energy drift of largest magnitude, in percent of the energy that the motion exchanges, or without a reference
    /// solution of the lane's largest kinetic energy or of the most that was lost; `None` if energy is not conserved.
    pub energy_drift: Option<f64>,
    /// How the body closes on a target that stays; `None` if it follows none.
    pub chase: Option<ChaseFinding>,
    /// Why and when the run ended early, if it did.
    pub failure: Option<RunFailure>,
    /// What the energy says of a body whose reference solution would take too much work; `None` if the truth
    /// tells.
    pub by_energy: Option<EnergyFinding>,
    /// Why there is no truth; `None` if there is one.
    pub no_truth: Option<NoTruth>,
    /// Why the lane is not judged; `None` if it is.
    pub not_judged: Option<NotJudged>,
    /// Evaluations of all bodies' accelerations over the horizon.
    pub evaluations: u64,
    /// The simulated seconds that the body got through.
    pub seconds: f64,
    /// The horizon in simulated seconds.
    pub horizon_s: f64,
    /// The time of the run, in seconds, at which the judged part begins: 0, or that of a person's last kick or placement.
    /// The other times count from there; the displayed moments are times of the run.
    pub starts_at_s: f64,
    /// The verdicts on the bodies of the scene, in its order; empty in one of those.
    pub of_bodies: Vec<Verdict>,
}

impl Verdict {
    /// Whether the error stays within the tolerance over the horizon.
    pub fn is_accurate(&self) -> bool {
        self.outcome <= Outcome::Accurate
    }

    /// What it lacks, if it rests on the energy for want of a reference solution: `no reference`.
    pub fn missing_truth(&self) -> Option<&'static str> {
        let rests_on_energy = self.by_energy.is_some() && self.outcome != Outcome::NotJudged;
        rests_on_energy.then(|| Truth::Reference.missing())
    }

    /// The same verdict on a part of a run that begins at this time of the run, in seconds.
    pub(super) fn starting_at(self, starts_at_s: f64) -> Self {
        let of_bodies = self.of_bodies.into_iter().map(|of_body| of_body.starting_at(starts_at_s));
        Self { starts_at_s, of_bodies: of_bodies.collect(), ..self }
    }

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
        let how = match self.outcome {
            Outcome::BlewUp => "blows up",
            Outcome::GaveUp => "gives up",
            _ => return None,
        };
        Some(format!("{how}{}", self.start(Parts::EVERYTHING)))
    }

    pub(super) fn is_worse_than(&self, other: &Self) -> bool {
        (self.outcome, self.error) > (other.outcome, other.error)
    }

    /// The change of the swing: its doubling or halving time, or else its energy change, or else its error.
    fn swing(&self, time: Option<f64>, factor: &str) -> String {
        match (time, self.energy_change) {
            (Some(time), _) => format!("{} {factor} in {}", self.what_grows(), duration(time)),
            (None, Some(change)) => {
                let (sign, horizon) =
                    (if change > 0.0 { "+" } else { "" }, duration(self.horizon_s));
                match percent(change).as_str() {
                    "\u{2212}100 %" => format!("all of it in {horizon}"),
                    part => format!("{sign}{part} in {horizon}"),
                }
            }
            (None, None) => {
                format!("off by {} in {}", percent(self.error), duration(self.horizon_s))
            }
        }
    }

    fn what_grows(&self) -> &'static str {
        if self.swings { "swing" } else { "deviation" }
    }

    /// The error and its time, and whether it is a phase error: a phase error is at most twice the amplitude, and a motion
    /// that dies away has other errors too.
    fn out_of_phase(&self) -> String {
        let (error, horizon) = (percent(self.error), duration(self.horizon_s));
        if self.is_phase_error() {
            return format!("out of phase by {error} after {horizon}");
        }
        if let Some(pitch) = self.pitch_that_tells() {
            return format!("{pitch}: off by up to {error} in {horizon}");
        }
        let at = self.moment(self.error_at_s);
        match self.last_error {
            last if last <= TOLERANCE => {
                let settled = self.moment(self.horizon_s);
                format!("off by {error} at {at}, settled by {settled}")
            }
            last if last < 0.9 * self.error => {
                format!("off by {error} at {at}, by {} after {horizon}", percent(last))
            }
            _ => format!("off by {error} after {horizon}"),
        }
    }

    fn is_phase_error(&self) -> bool {
        self.swings && self.energy_change.is_some() && self.error <= ANY_PHASE
    }

    /// The frequency error, if there is one beyond rounding: `0.18 % fast`.
    fn pitch(&self) -> Option<String> {
        let beyond = self.frequency_error.filter(|error| error.abs() > FREQUENCY_ROUNDING);
        beyond.filter(|_| self.outcome == Outcome::OutOfPhase).map(|error| {
            let how = if error > 0.0 { "fast" } else { "slow" };
            format!("{} {how}", percent(error.abs()))
        })
    }

    /// The frequency error where it says more than the error, which is past all phases and stays.
    fn pitch_that_tells(&self) -> Option<String> {
        self.pitch().filter(|_| self.error > ANY_PHASE && self.last_error > TOLERANCE)
    }

    /// The frequency error and the body's name in brackets, as far as they are said and there are any.
    fn in_brackets(&self, said: Parts) -> String {
        let pitch = self.pitch().filter(|_| said.pitch && self.pitch_that_tells().is_none());
        let name = self.body_name.clone().filter(|_| said.name);
        let parts: Vec<String> = pitch.into_iter().chain(name).collect();
        if parts.is_empty() { String::new() } else { format!(" ({})", parts.join(", ")) }
    }

    /// What is found, without brackets and clauses.
    fn finding(&self, said: Parts) -> String {
        let horizon = duration(self.horizon_s);
        match (self.outcome, &self.failure, &self.no_truth) {
            (Outcome::Rounding, ..) => {
                let bound = libm::ceil(libm::log10(self.error.max(1e-15))) as i32;
                format!("within rounding: error below 10{} in {horizon}", superscript(bound))
            }
            (Outcome::Accurate, ..) => {
                format!("accurate: error {} in {horizon}", percent(self.error))
            }
            (Outcome::OutOfPhase, ..) if said.is_stable && self.is_bounded == Some(true) => {
                format!("stable, {}", self.out_of_phase())
            }
            (Outcome::OutOfPhase, ..) => self.out_of_phase(),
            (Outcome::GainsEnergy, ..) => {
                // Without a swing and an energy nobody can say what it gains.
                let is_known = self.doubles_in_s.or(self.energy_change).is_some();
                let word = if is_known { "gains energy" } else { "grows" };
                format!("{word}: {}", self.swing(self.doubles_in_s, "×2"))
            }
            (Outcome::LosesEnergy, ..) => {
                format!("loses energy: {}", self.swing(self.halves_in_s, "½"))
            }
            (Outcome::BlewUp, Some(failure), _) => {
                format!("will blow up at {}", self.moment(failure.t))
            }
            (Outcome::GaveUp, Some(failure), _) => {
                let start = self.start(said);
                format!("will give up at {}{start}: {}", self.moment(failure.t), failure.cause)
            }
            (Outcome::NoTruth, ..) if let Some(found) = self.by_energy => found.kept(&horizon),
            (Outcome::NoTruth, _, Some(why)) => format!("no truth: {why}"),
            (Outcome::NotJudged, ..) if let Some(why) = self.not_judged => {
                format!("{}: {why}", self.outcome.text())
            }
            (outcome, ..) => outcome.text().to_owned(),
        }
    }

    /// What is said after the finding, each behind a semicolon.
    fn clauses(&self) -> Vec<String> {
        let is_told =
            matches!(self.outcome, Outcome::GainsEnergy | Outcome::BlewUp | Outcome::GaveUp);
        let later = self.doubles_in_s.filter(|_| !is_told);
        let faint = self.parasite_doubles_in_s.filter(|_| self.outcome <= Outcome::GainsEnergy);
        let by_energy = self.by_energy.filter(|_| self.missing_truth().is_some());
        [
            later.map(|s| format!("grows slowly: {} ×2 in {}", self.what_grows(), duration(s))),
            faint.map(|s| format!("a faint mode grows: ×2 in {}", duration(s))),
            by_energy.map(|found| found.to_string()),
            self.chase.as_ref().map(|chase| chase.to_string()),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    fn line(&self, said: Parts) -> String {
        let mut line = self.finding(said) + &self.in_brackets(said);
        if self.outcome == Outcome::BlewUp {
            line += &self.start(said);
        }
        if said.clauses {
            self.clauses().iter().for_each(|clause| line += &format!("; {clause}"));
        }
        line
    }

    /// The verdict in fewer and fewer words, as room is short; the first says everything. The body is named where there are
    /// several, if `is_named`.
    pub fn wordings(&self, is_named: bool) -> Vec<String> {
        let all = Parts { name: is_named, ..Parts::EVERYTHING };
        let whole = Parts { start: false, ..all };
        let first = Parts { clauses: false, ..whole };
        let bare = Parts { pitch: false, ..first };
        let shorter = Parts { is_stable: false, ..bare };
        let outcome = format!("{}{}", self.outcome.text(), self.in_brackets(bare));
        let mut wordings = vec![self.line(all), self.line(whole)];
        let Some(missing) = self.missing_truth() else {
            wordings.extend([first, bare, shorter].map(|said| self.line(said)));
            wordings.push(outcome);
            return wordings;
        };
        // Without its reason such a verdict would look like any other.
        let why = |said: &str| format!("{said}; {missing}");
        wordings.extend([first, shorter].map(|said| why(&self.line(said))));
        match self.outcome {
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

/// In the alternate form, `{:#}`, a method that fails is told with where it is run from.
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
        let told = |error| Verdict { frequency_error: Some(error), ..found.clone() }.to_string();
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
        for outcome in Outcome::ALL {
            let by_energy =
                Some(EnergyFinding { change: 0.5, is_conserved: true, spectral_radius: None });
            for verdict in [
                Verdict { outcome, ..found.clone() },
                Verdict { outcome, by_energy, ..found.clone() },
            ] {
                let said = verdict.wordings(true);
                assert!(said.is_sorted_by_key(|said| std::cmp::Reverse(said.len())), "{said:?}");
                assert_eq!(said[0], format!("{verdict:#}"));
            }
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
        let found = EnergyFinding { change: 0.5, is_conserved: true, spectral_radius: None };
        let by_energy = Verdict { by_energy: Some(found), ..blows_up.clone() };
        let gives_up = Verdict { outcome: Outcome::GaveUp, ..blows_up.clone() };
        let why = &blows_up.failure.as_ref().unwrap().cause;
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
