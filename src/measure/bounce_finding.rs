//! Findings on a lane's bounces. After the first impact a small error of time is a large one of position. A body with
//! walls is therefore judged by the heights and times of its bounces.

use std::fmt;

use super::criterion::{TOLERANCE, VISIBLE};
use super::outcome::Outcome;
use crate::sim::number::{duration, in_unit, round, significant};

/// The bounces of a lane against those of the truth, up to the first input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BounceFinding {
    /// The flight whose height is farthest off, by the impacts before it, with the error in parts of its height.
    pub height: Option<(u64, f64)>,
    /// The impact whose time is farthest off, in parts of the flight before it: its number, that error, and the error
    /// in seconds.
    pub landing: Option<(u64, f64, f64)>,
    /// Whether the heights go farther and farther from the truth.
    pub drifts: bool,
    /// The time (s) since which the ball is below the floor at the end of the run.
    pub sinks_at_s: Option<f64>,
    /// The speed in metres per second at which it passed the floor then, if nothing has turned it since.
    pub falls_through: Option<f64>,
    /// The height in metres to which it still bounces at the end, where the truth rests.
    pub never_rests: Option<f64>,
    /// The time in seconds by which it rests before the truth, negative if it rests later.
    pub rests_early_s: Option<f64>,
    /// The speed (m/s) below which its engine bounces nothing, and the height (m) of a fall to that speed, if the ball
    /// rests early for that.
    pub threshold: Option<[f64; 2]>,
    /// The height in metres by which it gains at each bounce, where the truth keeps its height.
    pub gain: Option<f64>,
    /// Where no flight is long enough to compare, the largest difference of the height, in parts of the highest true
    /// one, and its time (s).
    pub gap: Option<(f64, f64)>,
    /// The height in metres to which it flies, if that is twice as high as the truth ever does.
    pub climbs_to: Option<f64>,
    /// Where no bounce is compared, the largest depth below the wall at a tick, in parts of the largest true height and
    /// in metres.
    pub depth: Option<[f64; 2]>,
    /// The same for the largest height after the truth has come to rest.
    pub hop: Option<[f64; 2]>,
    /// Whether a rule after the step met the wall at its ticks only, so that it had nothing to get wrong.
    pub is_luck: bool,
}

impl BounceFinding {
    /// Returns the largest error of a height, a landing, a depth or a hop, in parts of the flight.
    pub fn error(&self) -> f64 {
        let height = self.height.map_or(0.0, |(_, part)| part.abs());
        let landing = self.landing.map_or(0.0, |(_, part, _)| part.abs());
        let gap = self.gap.map_or(0.0, |(part, _)| part);
        let rest = [self.depth, self.hop].into_iter().flatten().map(|[part, _]| part);
        rest.fold(height.max(landing).max(gap), f64::max)
    }

    /// Whether nothing of the run could be compared.
    pub(super) fn is_empty(&self) -> bool {
        let has_end = self.sinks_at_s.is_some() || self.never_rests.is_some();
        self.height.is_none() && self.landing.is_none() && self.gap.is_none() && !has_end
    }

    /// Adds the distance of a lane from the truth where its verdict begins, as the error of the present flight and of
    /// the next.
    pub(super) fn beside(mut self, offsets: [Option<f64>; 2]) -> Self {
        let offsets = offsets.iter().zip(0..).filter_map(|(part, after)| Some((after, (*part)?)));
        let worst = offsets.max_by(|(_, a): &(u64, f64), (_, b)| a.abs().total_cmp(&b.abs()));
        if let Some((after, offset)) = worst {
            let (after, own) = self.height.unwrap_or((after, 0.0));
            let part = (1.0 + own) * (1.0 + offset) - 1.0;
            self.height = Some((after, part));
            (self.gain, self.rests_early_s) = (None, None);
            self.drifts &= own.abs() > offset.abs();
        }
        self
    }

    /// Returns the same finding on a run in which the judged part begins at this time (s).
    pub(super) fn starting_at(self, starts_at_s: f64) -> Self {
        let later = |at_s: f64| at_s + starts_at_s;
        let gap = self.gap.map(|(part, at_s)| (part, later(at_s)));
        Self { sinks_at_s: self.sinks_at_s.map(later), gap, ..self }
    }

    pub(super) fn outcome(&self) -> Outcome {
        // A landing may be late, and later each time, while each flight has its height.
        let height = self.wrong_height().filter(|_| self.drifts);
        match self.error() {
            _ if self.sinks_at_s.is_some() => Outcome::DiesAway,
            _ if self.climbs_to.is_some() => Outcome::Grows,
            error if self.never_rests.is_none() && error <= TOLERANCE => Outcome::Accurate,
            error if self.never_rests.is_none() && error <= VISIBLE => Outcome::LooksRight,
            _ => match height {
                Some((_, part)) if part > 0.0 => Outcome::Grows,
                Some(_) if self.never_rests.is_none() => Outcome::DiesAway,
                _ => Outcome::Bounded,
            },
        }
    }

    /// Returns the flight whose height is farthest off, with the error in parts of its height, if that matters.
    fn wrong_height(&self) -> Option<(u64, f64)> {
        self.height.filter(|(_, part)| part.abs() > TOLERANCE)
    }

    /// Returns the larger of the depth and the hop, in metres, with its quantity and the words around the number, if it
    /// matters.
    fn wrong_rest(&self) -> Option<(&'static str, [&'static str; 2], f64)> {
        let depth = ("depth", ["sinks", "into the floor"], self.depth);
        let hop = ("height", ["hops", "high"], self.hop);
        let found = [depth, hop].into_iter();
        let found = found.filter_map(|(quantity, words, found)| Some((quantity, words, found?)));
        let worst = found.max_by(|(.., [a, _]), (.., [b, _])| a.total_cmp(b));
        let worst = worst.filter(|(.., [part, _])| *part > TOLERANCE);
        worst.map(|(quantity, words, [_, metres])| (quantity, words, metres))
    }

    /// Returns the quantity that the words are about, its value and its unit.
    pub(super) fn number(&self) -> (&'static str, f64, &'static str) {
        let height = self.wrong_height();
        match (self.sinks_at_s, height, self.never_rests, self.landing) {
            _ if let Some(speed) = self.falls_through => ("speed at the floor", speed, "m/s"),
            (Some(at_s), ..) => ("sinks at", at_s, "s"),
            _ if let Some(gain) = self.gain => ("gain a bounce", gain, "m"),
            (_, Some((_, part)), ..) => ("height error", 100.0 * part, "%"),
            _ if let Some(height) = self.climbs_to => ("height", height, "m"),
            (_, _, Some(height), _) => ("height that stays", height, "m"),
            _ if let Some((quantity, _, metres)) = self.wrong_rest() => (quantity, metres, "m"),
            (.., Some((_, _, late_s))) => ("delay", late_s, "s"),
            _ if self.gap.is_some() => ("largest error", 100.0 * self.error(), "%"),
            _ => ("height error", 0.0, "%"),
        }
    }

    /// Returns what goes with the words, beginning with a comma; empty if nothing does.
    pub(super) fn aside(&self) -> String {
        match (self.threshold, self.rests_early_s) {
            _ if self.is_luck => ", luck: lands on ticks".to_owned(),
            _ if self.never_rests.is_some()
                && (self.wrong_height().is_some() || self.climbs_to.is_some()) =>
            {
                ", never rests".to_owned()
            }
            (Some([speed, height]), _) => format!(
                ", a threshold of {} m/s: no bounce below {} mm",
                round(speed, 3),
                significant(1e3 * height, 2)
            ),
            (None, Some(early_s)) => {
                let way = if early_s > 0.0 { "early" } else { "late" };
                let size = in_unit(early_s.abs(), |value| significant(value, 2));
                format!(", rests {size} {way}")
            }
            (None, None) => String::new(),
        }
    }
}

impl fmt::Display for BounceFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let height = self.wrong_height();
        match (self.sinks_at_s, height, self.never_rests, self.landing) {
            _ if let Some(speed) = self.falls_through => {
                write!(f, "falls through at {} m/s", significant(speed, 2))?;
            }
            (Some(at_s), ..) => write!(f, "sinks through the floor at {}", duration(at_s))?,
            _ if let Some(gain) = self.gain => {
                write!(f, "gains {} cm a bounce", significant(1e2 * gain, 2))?;
            }
            (_, Some((after, part)), ..) => {
                let size = significant(100.0 * part.abs(), 2);
                let way = if part > 0.0 { "high" } else { "low" };
                match after {
                    0 => write!(f, "jumps {size} % too {way}")?,
                    1 => write!(f, "bounces {size} % too {way}")?,
                    after => write!(f, "bounces {size} % too {way} after {after}")?,
                }
            }
            _ if let Some(height) = self.climbs_to => {
                write!(f, "climbs to {} m", significant(height, 2))?;
            }
            (_, _, Some(height), _) => {
                write!(f, "never rests: {} mm for ever", significant(1e3 * height, 2))?;
            }
            _ if let Some((_, [verb, whereto], metres)) = self.wrong_rest() => {
                write!(f, "{verb} {} mm {whereto}", significant(1e3 * metres, 2))?;
            }
            (.., Some((after, part, late_s))) if part.abs() > TOLERANCE => {
                let way = if late_s > 0.0 { "late" } else { "early" };
                write!(f, "lands {} ms {way} after {after}", significant(1e3 * late_s.abs(), 2))?;
            }
            _ if let Some((part, at_s)) = self.gap => {
                let size = significant(100.0 * part, 2);
                write!(f, "off by {size} % at {}", duration(at_s))?;
            }
            _ if self.error() < 1e-6 => f.write_str("bounces right")?,
            _ => write!(f, "bounces within {} %", significant(100.0 * self.error(), 2))?,
        }
        f.write_str(&self.aside())
    }
}
