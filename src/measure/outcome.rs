//! The outcomes of a run compared with the truth, and the sign and colour of each.
//!
//! The order is that of harm, because a lane of several bodies has the outcome of its worst one. An unknown outcome is
//! worse than a good one and better than a bad one: it must hide neither.

use super::criterion::Criterion;
use crate::run::race::Halt;

/// The outcome of a run over the horizon, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// The error is at rounding level.
    Rounding,
    /// The run meets [`Criterion::Accurate`].
    Accurate,
    /// The run meets [`Criterion::LooksRight`].
    LooksRight,
    /// Judging takes too much work, or the scene is shorter than a tick.
    NotJudged,
    /// The truth is unknown, or not precise enough.
    NoTruth,
    /// The motion neither grows nor dies away, but looks wrong.
    Bounded,
    /// The amplitude decreases, unlike in truth.
    DiesAway,
    /// The amplitude grows, unlike in truth.
    Grows,
    /// The method's solver failed.
    GaveUp,
    /// A value left the range of [`ESCAPE`](crate::run::race::ESCAPE) or was not finite.
    BlewUp,
}

impl Outcome {
    /// Every outcome, from best to worst.
    pub const ALL: [Self; 10] = [
        Self::Rounding,
        Self::Accurate,
        Self::LooksRight,
        Self::NotJudged,
        Self::NoTruth,
        Self::Bounded,
        Self::DiesAway,
        Self::Grows,
        Self::GaveUp,
        Self::BlewUp,
    ];

    /// Returns the outcome of a body that halted.
    pub fn of_halt(halt: &Halt) -> Self {
        if halt.is_blow_up() { Self::BlewUp } else { Self::GaveUp }
    }

    /// Returns the outcome's name in output, which is the name for people in kebab case.
    pub fn id(self) -> &'static str {
        match self {
            Outcome::Rounding | Outcome::Accurate => "accurate",
            Outcome::LooksRight => "looks-right",
            Outcome::NotJudged => "not-judged",
            Outcome::NoTruth => "no-truth",
            Outcome::Bounded => "bounded",
            Outcome::DiesAway => "dies-away",
            Outcome::Grows => "grows",
            Outcome::GaveUp => "gives-up",
            Outcome::BlewUp => "blows-up",
        }
    }

    /// Returns the outcome's name for people.
    pub fn text(self) -> &'static str {
        match self {
            Outcome::Rounding | Outcome::Accurate => "accurate",
            Outcome::LooksRight => "looks right",
            Outcome::NotJudged => "not judged",
            Outcome::NoTruth => "no truth",
            Outcome::Bounded => "bounded",
            Outcome::DiesAway => "dies away",
            Outcome::Grows => "grows",
            Outcome::GaveUp => "gives up",
            Outcome::BlewUp => "blows up",
        }
    }

    /// Describes the outcome's meaning in one line.
    pub fn about(self) -> &'static str {
        match self {
            Outcome::Rounding | Outcome::Accurate => {
                "no coordinate or velocity is off by more than 1 % of its amplitude"
            }
            Outcome::LooksRight => {
                "the swing is as wide as the true one within 5 %, its frequency right within 1 %; \
                 without a swing, within 5 % of the range"
            }
            Outcome::NotJudged => {
                "it takes too much work, the scene is shorter than a tick, no flight of a ball ends before an input, or a clock drives it"
            }
            Outcome::NoTruth => "the true motion is not known precisely enough",
            Outcome::Bounded => "it neither grows nor dies away, and looks wrong",
            Outcome::DiesAway => "the swing gets narrower, and in truth it does not",
            Outcome::Grows => {
                "the swing gets wider, or a small one would, and in truth it does not"
            }
            Outcome::GaveUp => "the method cannot solve its step",
            Outcome::BlewUp => "a value is beyond all bounds",
        }
    }

    /// Returns the outcome's sign.
    pub fn sign(self) -> Sign {
        match self {
            Outcome::Rounding | Outcome::Accurate | Outcome::LooksRight => Sign::Disc,
            Outcome::NotJudged | Outcome::NoTruth => Sign::Ring,
            Outcome::Bounded => Sign::Diamond,
            Outcome::DiesAway => Sign::Falling,
            Outcome::Grows => Sign::Rising,
            Outcome::GaveUp | Outcome::BlewUp => Sign::Cross,
        }
    }

    /// Returns how bad the outcome is for a developer.
    pub fn severity(self) -> Severity {
        match self {
            Outcome::Rounding | Outcome::Accurate => Severity::Fine,
            Outcome::LooksRight => Severity::Fair,
            Outcome::NotJudged | Outcome::NoTruth => Severity::Unknown,
            Outcome::Bounded => Severity::Doubtful,
            Outcome::DiesAway | Outcome::Grows | Outcome::GaveUp | Outcome::BlewUp => Severity::Bad,
        }
    }
}

impl Criterion {
    /// Returns the outcome of a lane that meets this criterion and no harder one.
    pub fn outcome(self) -> Outcome {
        match self {
            Criterion::Bounded => Outcome::Bounded,
            Criterion::LooksRight => Outcome::LooksRight,
            Criterion::Accurate => Outcome::Accurate,
        }
    }
}

/// The shape that distinguishes verdicts without their colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The motion is accurate or, in a lighter colour, looks right.
    Disc,
    /// The motion is only bounded.
    Diamond,
    /// The motion grows.
    Rising,
    /// The motion dies away.
    Falling,
    /// The motion is lost.
    Cross,
    /// The outcome is unknown.
    Ring,
}

impl Sign {
    /// Returns the character that shows the sign.
    pub fn glyph(self) -> &'static str {
        match self {
            Sign::Disc => "●",
            Sign::Diamond => "◆",
            Sign::Rising => "▲",
            Sign::Falling => "▼",
            Sign::Cross => "×",
            Sign::Ring => "○",
        }
    }
}

/// How bad a verdict is for a developer. Each severity has its own colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The error is invisible.
    Fine,
    /// The error is measurable, but hardly visible.
    Fair,
    /// The error is visible on a closer look.
    Doubtful,
    /// The error is obvious.
    Bad,
    /// Nothing is known.
    Unknown,
}

impl Severity {
    /// Returns the sign of a result without an outcome, such as that of a game loop.
    pub fn sign(self) -> Sign {
        match self {
            Severity::Fine | Severity::Fair => Sign::Disc,
            Severity::Doubtful => Sign::Diamond,
            Severity::Bad => Sign::Cross,
            Severity::Unknown => Sign::Ring,
        }
    }
}
