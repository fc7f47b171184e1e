//! The verdict on a method on a scene: its outcome and the numbers behind it.

use super::amplitude::{Measure, Trend};
use super::chase_finding::ChaseFinding;
use super::criterion::TOLERANCE;
use super::energy_finding::EnergyFinding;
use super::outcome::Outcome;
use crate::run::race::StopReason;
use crate::sim::bodies::Truth;
use crate::sim::integrators::StepFailure;

#[cfg(feature = "serde")]
mod schema;
#[cfg(test)]
mod tests;
mod words;

pub use words::VerdictNumber;

/// The largest error in amplitudes that counts as rounding.
const ROUNDING: f64 = 1e-9;

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
#[non_exhaustive]
pub enum NoTruth {
    /// The exact solution or the reference has failed.
    Failed(StepFailure),
    /// Its error may be as large as this part of the amplitude.
    Vague(f64),
}

/// Why a lane is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotJudged {
    /// Its run takes more than [`MAX_WORK`](super::MAX_WORK).
    TooMuchWork,
    /// The scene is shorter than one tick.
    ShorterThanATick,
}

/// What is found of a run on a body.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// It is compared with the truth over the horizon.
    Compared(Comparison),
    /// Its energy tells, as a reference solution would take too much work.
    ByEnergy(EnergyFinding),
    /// It ended early.
    Failed {
        /// Why and when.
        failure: RunFailure,
        /// What its energy said up to then, if there is no reference solution.
        by_energy: Option<EnergyFinding>,
    },
    /// There is no truth to compare it with.
    NoTruth(NoTruth),
    /// It is not judged.
    NotJudged(NotJudged),
}

/// A run compared with the truth over the horizon. Errors are in amplitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// The largest error of a coordinate or a velocity.
    pub error: f64,
    /// The time of the largest error, in seconds.
    pub error_at_s: f64,
    /// The largest error in the last twentieth of the horizon.
    pub last_error: f64,
    /// The largest error of the truth itself.
    pub truth_error: f64,
    /// How the amplitude changes, within the horizon and, where it grows or stays bounded, beyond it.
    pub change: Trend,
    /// Whether it meets [`Criterion::LooksRight`](super::Criterion::LooksRight); `None` if that is not known.
    pub looks_right: Option<bool>,
    /// The widest swing in units of the true one; `None` if nothing swings. Of a body that is not linear it is known at ticks
    /// only, and `None` where it is not wider.
    pub width: Option<f64>,
    /// By how many seconds the motion is early at the end of the horizon, negative if it is late. `None` if this is not the
    /// cause of most of the error.
    pub early_s: Option<f64>,
    /// The change of the energy, in units of the largest true kinetic energy; `None` if energy is not conserved.
    pub energy_change: Option<f64>,
    /// The energy drift of largest magnitude, in percent of the energy that the motion exchanges; `None` if energy is not
    /// conserved.
    pub energy_drift_percent: Option<f64>,
    /// The relative frequency error, positive if the body swings too fast; of several modes, that of the one with the most
    /// energy. `None` if nothing swings or the error is not steady.
    pub frequency_error: Option<f64>,
}

impl Comparison {
    fn outcome(&self) -> Outcome {
        match self.change {
            _ if self.error.max(self.truth_error) <= ROUNDING => Outcome::Rounding,
            _ if self.error <= TOLERANCE => Outcome::Accurate,
            _ if self.looks_right == Some(true) => Outcome::LooksRight,
            Trend::Grows => Outcome::Grows,
            Trend::Dies => Outcome::DiesAway,
            Trend::None => Outcome::Bounded,
        }
    }
}

/// How the amplitude changes beyond the horizon: its doubling and halving times are in seconds, and the energy doubles and
/// halves in half the time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LongTerm {
    /// The quantity that doubles and halves.
    pub measure: Measure,
    /// The time in which the amplitude doubles, if it does not in truth; `None` if it does not double within a year or if
    /// that is not known.
    pub doubles_in_s: Option<f64>,
    /// The time in which the amplitude halves, if it is constant in truth; `None` if it does not halve within a year or if
    /// that is not known.
    pub halves_in_s: Option<f64>,
    /// The doubling time of a mode that has next to no energy at the start.
    pub parasite_doubles_in_s: Option<f64>,
    /// Whether nothing grows that does not grow in truth; `None` if that is not known.
    pub is_bounded: Option<bool>,
}

/// The verdict on a lane over a horizon; displayed as one line. With the feature `serde` it is written as one flat object,
/// by the commands too: `word` is the id of its outcome, `text` the line, and `quantity`, `value` and `unit` the number in it.
/// A field without a meaning is null.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// What is found of the worst body, which the verdict is about.
    pub finding: Finding,
    /// What becomes of its amplitude; of all bodies, whether they stay bounded.
    pub long_term: LongTerm,
    /// How the body closes on a target that stays; `None` if it follows none.
    pub chase: Option<ChaseFinding>,
    /// The body's index in the scene.
    pub body: usize,
    /// The body's name.
    pub body_name: String,
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
    /// What it comes to.
    pub fn outcome(&self) -> Outcome {
        match &self.finding {
            Finding::Compared(comparison) => comparison.outcome(),
            Finding::ByEnergy(found) => found.outcome(),
            Finding::Failed { failure, .. } => failure.outcome(),
            Finding::NoTruth(_) => Outcome::NoTruth,
            Finding::NotJudged(_) => Outcome::NotJudged,
        }
    }

    /// The comparison with the truth, if there is one.
    pub fn comparison(&self) -> Option<&Comparison> {
        if let Finding::Compared(comparison) = &self.finding { Some(comparison) } else { None }
    }

    /// The largest error of a coordinate or a velocity, in amplitudes; `None` without a comparison over the whole horizon.
    pub fn error(&self) -> Option<f64> {
        self.comparison().map(|comparison| comparison.error)
    }

    /// Why and when the run ended early, if it did.
    pub fn failure(&self) -> Option<&RunFailure> {
        if let Finding::Failed { failure, .. } = &self.finding { Some(failure) } else { None }
    }

    /// What the energy says, if there is no reference solution.
    pub fn by_energy(&self) -> Option<&EnergyFinding> {
        match &self.finding {
            Finding::ByEnergy(found) => Some(found),
            Finding::Failed { by_energy, .. } => by_energy.as_ref(),
            _ => None,
        }
    }

    /// The energy drift of largest magnitude, in percent of the energy that the motion exchanges, or without a reference
    /// solution of the lane's largest kinetic energy or of the most that was lost; `None` if energy is not conserved, or if
    /// the run ended early.
    pub fn energy_drift_percent(&self) -> Option<f64> {
        match &self.finding {
            Finding::Compared(comparison) => comparison.energy_drift_percent,
            Finding::ByEnergy(found) => found.drift_percent,
            _ => None,
        }
    }

    /// What it lacks, if it rests on the energy for want of a reference solution: `no reference`.
    pub fn missing_truth(&self) -> Option<&'static str> {
        self.by_energy().map(|_| Truth::Reference.missing())
    }

    /// The same verdict on a part of a run that begins at this time of the run, in seconds.
    pub(super) fn starting_at(self, starts_at_s: f64) -> Self {
        let of_bodies = self.of_bodies.into_iter().map(|of_body| of_body.starting_at(starts_at_s));
        Self { starts_at_s, of_bodies: of_bodies.collect(), ..self }
    }

    /// By which of two verdicts the larger is the worse.
    pub(crate) fn badness(&self) -> (Outcome, f64) {
        (self.outcome(), self.error().unwrap_or(f64::INFINITY))
    }

    fn energy_change(&self) -> Option<f64> {
        match &self.finding {
            Finding::Compared(comparison) => comparison.energy_change,
            Finding::ByEnergy(found) => Some(found.change),
            _ => None,
        }
    }
}
