//! The outcomes of a run compared with the truth, and how bad each is.

/// The outcome of a run over the horizon, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// The error is at rounding level.
    Rounding,
    /// The error stays within [`TOLERANCE`](super::TOLERANCE) of the amplitude.
    Accurate,
    /// Judging takes too much work, or the scene is shorter than a tick.
    NotJudged,
    /// The truth is not known, or not precisely enough.
    NoTruth,
    /// The error exceeds the tolerance, though the amplitude is about the true one.
    OutOfPhase,
    /// The amplitude decreases, and in truth it does not.
    LosesEnergy,
    /// The amplitude grows, and in truth it does not.
    GainsEnergy,
    /// The method's solver failed.
    GaveUp,
    /// A value left the range of [`ESCAPE`](crate::lab::race::ESCAPE) or was not finite.
    BlewUp,
}

impl Outcome {
    /// Every outcome, from best to worst.
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
            Outcome::Rounding => "rounding",
            Outcome::Accurate => "accurate",
            Outcome::NotJudged => "not-judged",
            Outcome::NoTruth => "no-truth",
            Outcome::OutOfPhase => "out-of-phase",
            Outcome::LosesEnergy => "loses-energy",
            Outcome::GainsEnergy => "gains-energy",
            Outcome::GaveUp => "gave-up",
            Outcome::BlewUp => "blew-up",
        }
    }

    /// Its name for people.
    pub fn text(self) -> &'static str {
        match self {
            Outcome::Rounding => "within rounding",
            Outcome::Accurate => "accurate",
            Outcome::NotJudged => "not judged",
            Outcome::NoTruth => "no truth",
            Outcome::OutOfPhase => "out of phase",
            Outcome::LosesEnergy => "loses energy",
            Outcome::GainsEnergy => "gains energy",
            Outcome::GaveUp => "gives up",
            Outcome::BlewUp => "blows up",
        }
    }

    /// How bad it is for a developer.
    pub fn severity(self) -> Severity {
        match self {
            Outcome::Rounding | Outcome::Accurate => Severity::Fine,
            Outcome::NotJudged | Outcome::NoTruth => Severity::Unknown,
            Outcome::OutOfPhase => Severity::Doubtful,
            Outcome::LosesEnergy | Outcome::GainsEnergy | Outcome::GaveUp | Outcome::BlewUp => {
                Severity::Bad
            }
        }
    }
}

/// How bad a verdict is for a developer. Each severity has one colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// No error can be seen.
    Fine,
    /// The error can be seen on a closer look.
    Doubtful,
    /// The error is seen at once.
    Bad,
    /// Nothing is known.
    Unknown,
}
