//! The verdict on a method on a scene, with its outcome and the numbers behind the outcome.
//!
//! A verdict compares a lane with the truth, and never with another lane, so that it stays the same whichever methods
//! race. A missing truth or too much work is a finding of its own: it is no reproach to the method.

use super::amplitude::{Measure, Trend};
use super::bounce_finding::BounceFinding;
use super::chase_finding::ChaseFinding;
use super::criterion::TOLERANCE;
use super::energy_finding::EnergyFinding;
use super::outcome::Outcome;
use super::spin_finding::SpinFinding;
use crate::run::race::StopReason;
use crate::sim::bodies::Truth;
use crate::sim::integrators::StepFailure;

mod schema;
#[cfg(test)]
mod tests;
mod words;

pub use words::VerdictNumber;

/// Largest error in amplitudes that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The reason why a body's run ended early, and the time.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFailure {
    /// Time of the failure, in simulated seconds.
    pub t: f64,
    /// Cause of the failure.
    pub cause: StepFailure,
}

impl RunFailure {
    /// Returns the failure of a run that stopped at `t` (s), if the run failed.
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

/// The reason why a lane cannot be compared with the truth.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoTruth {
    /// The exact solution or the reference has failed.
    Failed(StepFailure),
    /// The error of the truth may be as large as this fraction of the amplitude.
    Vague(f64),
}

/// The reason why a lane is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotJudged {
    /// The lane's run takes more work than [`MAX_WORK`](super::MAX_WORK).
    TooMuchWork,
    /// The scene is shorter than one tick.
    ShorterThanATick,
    /// No flight of a ball ends before the first input.
    NoFlight,
    /// The motion depends on the time of the run, and the verdict would begin in the middle of it.
    Driven,
}

/// The findings of a run on a body.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// A comparison with the truth over the horizon.
    Compared(Comparison),
    /// The bounces of a body with walls.
    Bounced(BounceFinding),
    /// The rotation of a body that turns in space.
    Spun(SpinFinding),
    /// Findings from the energy, because a reference solution would take too much work.
    ByEnergy(EnergyFinding),
    /// The run ended early.
    Failed {
        /// The reason and the time.
        failure: RunFailure,
        /// Findings from the energy up to that time, if there is no reference solution.
        by_energy: Option<EnergyFinding>,
    },
    /// There is no truth with which to compare the run.
    NoTruth(NoTruth),
    /// The run is not judged.
    NotJudged(NotJudged),
}

/// Half the widths of the swing of a lane that was not in the true state at the start, and of the true swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingWidths {
    /// Largest distance of the lane from the middle of its swing, in `unit`.
    pub own: f64,
    /// Largest distance of the exact body.
    pub truth: f64,
    /// Unit of the swinging coordinate, which is empty for a pure number.
    pub unit: &'static str,
}

/// A run compared with the truth over the horizon. Errors are in amplitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// Largest error of a coordinate or a velocity.
    pub error: f64,
    /// Time of the largest error in seconds.
    pub error_at_s: f64,
    /// Largest error in the last twentieth of the horizon.
    pub last_error: f64,
    /// Largest error of the truth itself.
    pub truth_error: f64,
    /// Trend of the amplitude within the horizon and, if it grows or stays bounded, beyond it.
    pub change: Trend,
    /// Whether the run meets [`Criterion::LooksRight`](super::Criterion::LooksRight); `None` if unknown.
    pub looks_right: Option<bool>,
    /// Largest width of the swing relative to the true one; `None` if nothing swings. For a nonlinear body the width is
    /// known only at ticks, and `None` if the swing is not wider than the true one.
    pub width: Option<f64>,
    /// The widths of both swings, if the lane was not in the true state at the start.
    pub widths: Option<SwingWidths>,
    /// Seconds by which the motion is early at the end of the horizon, negative if it is late. `None` if this shift
    /// does not cause most of the error.
    pub early_s: Option<f64>,
    /// Change of the energy at the end of the horizon, in units of the largest true kinetic energy; `None` if energy is
    /// not conserved.
    pub energy_change: Option<f64>,
    /// Energy drift of largest magnitude, in percent of the energy that the motion exchanges; `None` if energy is not
    /// conserved.
    pub energy_drift_percent: Option<f64>,
    /// Relative frequency error, positive if the body swings too fast. With several modes, it is the error of the mode
    /// with the most energy. `None` if nothing swings or the error is not steady.
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

/// The change of the amplitude beyond the horizon. Doubling and halving times are in seconds; the energy doubles and
/// halves in half the time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LongTerm {
    /// The quantity that doubles and halves.
    pub measure: Measure,
    /// Doubling time of the amplitude, if it does not double in truth; `None` if it does not double within a year or
    /// this is unknown.
    pub doubles_in_s: Option<f64>,
    /// Halving time of the amplitude, if it is constant in truth; `None` if it does not halve within a year or this
    /// is unknown.
    pub halves_in_s: Option<f64>,
    /// Doubling time of a mode with almost no initial energy.
    pub parasite_doubles_in_s: Option<f64>,
    /// Whether nothing grows that does not grow in truth; `None` if unknown.
    pub is_bounded: Option<bool>,
}

/// The verdict on a lane over a horizon, displayed as one line.
///
/// The verdict serializes as one flat object, which the commands write too. In this object,
/// `word` is the id of the outcome, `text` the line, and `quantity`, `value` and `unit` the number in the line. A field
/// without a meaning is null.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// The finding on the worst body, which is the subject of the verdict.
    pub finding: Finding,
    /// The long-term change of the worst body's amplitude. Only `is_bounded` is about all bodies.
    pub long_term: LongTerm,
    /// How the body approaches a fixed target; `None` if it follows none.
    pub chase: Option<ChaseFinding>,
    /// Index of the body in the scene.
    pub body: usize,
    /// Name of the body.
    pub body_name: String,
    /// Number of evaluations of all bodies' accelerations over the horizon.
    pub evaluations: u64,
    /// Number of simulated seconds that the body completed.
    pub seconds: f64,
    /// Length of the horizon in simulated seconds.
    pub horizon_s: f64,
    /// Time of the run, in seconds, at which the judged part begins. This is 0, or the time of the last change of the
    /// run. Other times count from there, but displayed moments are times of the run.
    pub starts_at_s: f64,
    /// The verdicts on the bodies of the scene, in the order of the scene; empty in a verdict on one of these bodies.
    pub of_bodies: Vec<Verdict>,
}

impl Verdict {
    /// Returns the outcome.
    pub fn outcome(&self) -> Outcome {
        match &self.finding {
            Finding::Compared(comparison) => comparison.outcome(),
            Finding::Bounced(found) => found.outcome(),
            Finding::Spun(found) => found.outcome(),
            Finding::ByEnergy(found) => found.outcome(),
            Finding::Failed { failure, .. } => failure.outcome(),
            Finding::NoTruth(_) => Outcome::NoTruth,
            Finding::NotJudged(_) => Outcome::NotJudged,
        }
    }

    /// Returns the comparison with the truth, if there is one.
    pub fn comparison(&self) -> Option<&Comparison> {
        if let Finding::Compared(comparison) = &self.finding { Some(comparison) } else { None }
    }

    /// Returns the largest error of a coordinate or a velocity, in amplitudes, or that of a bounce, in flights. `None`
    /// if there is no comparison over the whole horizon.
    pub fn error(&self) -> Option<f64> {
        match &self.finding {
            Finding::Bounced(found) => Some(found.error()),
            Finding::Spun(found) => Some(found.error()),
            _ => self.comparison().map(|comparison| comparison.error),
        }
    }

    /// Returns why and when the run ended early, if it did.
    pub fn failure(&self) -> Option<&RunFailure> {
        if let Finding::Failed { failure, .. } = &self.finding { Some(failure) } else { None }
    }

    /// Returns the findings from the energy, if there is no reference solution.
    pub fn by_energy(&self) -> Option<&EnergyFinding> {
        match &self.finding {
            Finding::ByEnergy(found) => Some(found),
            Finding::Failed { by_energy, .. } => by_energy.as_ref(),
            _ => None,
        }
    }

    /// Returns the energy drift of largest magnitude, in percent of the energy that the motion exchanges. If there is
    /// no reference solution, the unit is the lane's largest kinetic energy, or its largest loss. `None` if energy is
    /// not conserved, or if the run ended early.
    pub fn energy_drift_percent(&self) -> Option<f64> {
        match &self.finding {
            Finding::Compared(comparison) => comparison.energy_drift_percent,
            Finding::ByEnergy(found) => found.drift_percent,
            Finding::Spun(found) => Some(100.0 * (found.energy - 1.0)),
            _ => None,
        }
    }

    /// Returns the missing kind of truth, `no reference`, if the verdict rests on the energy because that truth is
    /// missing.
    pub fn missing_truth(&self) -> Option<&'static str> {
        self.by_energy().map(|_| Truth::Reference.missing())
    }

    /// Returns the same verdict for a part of a run that begins at this time of the run, in seconds.
    pub(super) fn starting_at(self, starts_at_s: f64) -> Self {
        let of_bodies = self.of_bodies.into_iter().map(|of_body| of_body.starting_at(starts_at_s));
        Self { starts_at_s, of_bodies: of_bodies.collect(), ..self }
    }

    /// Returns a sort key. The larger the key, the worse the verdict.
    pub fn badness(&self) -> (Outcome, f64) {
        (self.outcome(), self.error().unwrap_or(f64::INFINITY))
    }

    fn energy_change(&self) -> Option<f64> {
        match &self.finding {
            Finding::Compared(comparison) => comparison.energy_change,
            Finding::ByEnergy(found) => Some(found.change),
            Finding::Spun(found) => Some(found.energy - 1.0),
            _ => None,
        }
    }
}
