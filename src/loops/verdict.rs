//! The verdict on a loop: a line of words and a severity.
//!
//! The first clause names the worst fault, since a fault hides those after it. A speed that depends on the frame rate
//! makes latency meaningless, and a lost motion makes smoothness meaningless.

use std::fmt;

use super::metrics::PacingReport;
use super::policy::PolicyCard;
use crate::measure::Severity;
use crate::sim::TickRate;
use crate::sim::number::round;

/// Animation error in milliseconds below which nobody sees it.
const SMOOTH_MS: f64 = 0.1;
/// Animation error in milliseconds above which many people see it.
const JUDDER_MS: f64 = 2.0;
/// Latency above which the verdict mentions it, in ticks.
const LATE_TICKS: f64 = 0.25;

/// A verdict on a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopVerdict {
    /// How bad the loop is.
    pub severity: Severity,
    /// Clauses of the verdict, with the most important first.
    pub parts: Vec<String>,
}

impl LoopVerdict {
    /// Returns the verdict on a loop from its report, at a tick rate in Hz.
    pub fn of(card: &PolicyCard, report: &PacingReport, tick_hz: impl Into<TickRate>) -> Self {
        let mut verdict = Self::of_picture(report, tick_hz.into());
        let differs = report.keeps_speed() != Some(false) && report.other_motion().is_some();
        if differs && !card.has_fixed_tick {
            verdict.parts.push("physics varies with the rate".into());
            if verdict.severity == Severity::Fine {
                verdict.severity = Severity::Doubtful;
            }
        }
        verdict
    }

    /// Returns a placeholder for a loop that has not run yet.
    pub(crate) fn awaited() -> Self {
        Self::new(Severity::Unknown, [Some("running…".into())])
    }

    fn new<const N: usize>(severity: Severity, parts: [Option<String>; N]) -> Self {
        Self { severity, parts: parts.into_iter().flatten().collect() }
    }

    /// Returns wordings of decreasing length, from all clauses to the first one only.
    pub fn wordings(&self) -> Vec<String> {
        (1..=self.parts.len()).rev().map(|count| self.parts[..count].join(", ")).collect()
    }

    /// Returns the verdict on the picture as a viewer sees it.
    fn of_picture(report: &PacingReport, tick_hz: TickRate) -> Self {
        let said = |severity, words: &str| Self::new(severity, [Some(words.into())]);
        if report.keeps_speed() == Some(false) && report.animation_error_rms_ms.is_some() {
            return said(Severity::Bad, "speed depends on the frame rate");
        }
        let measured = report.animation_error_rms_ms.zip(report.latency_mean_ms());
        let Some((error, latency)) = measured else {
            return said(Severity::Unknown, "nothing displayed");
        };
        if report.loses_motion() {
            let remedy = "more ticks or another method keep it";
            let parts = ["the motion is lost", remedy].map(|part| Some(part.to_owned()));
            return Self::new(Severity::Bad, parts);
        }
        let late = match latency * f64::from(tick_hz) / 1000.0 {
            late if late < LATE_TICKS => None,
            late if (late - 1.0).abs() < 0.1 => Some("one tick late".into()),
            _ => Some(format!("{} ms behind", round(latency, 2))),
        };
        if error < SMOOTH_MS {
            let (severity, how) = match report.dropped_ms {
                dropped if dropped > 0.0 => {
                    (Severity::Doubtful, format!("smooth, but drops {} ms", round(dropped, 3)))
                }
                _ => (Severity::Fine, "smooth".into()),
            };
            return Self::new(severity, [Some(how), late]);
        }
        let severity = if error < JUDDER_MS { Severity::Doubtful } else { Severity::Bad };
        let many = |percent: Option<f64>| {
            percent.filter(|percent| *percent > 1.0).map(|percent| round(percent, 3))
        };
        if let Some(repeated) = many(report.repeated_percent) {
            let repeated = format!("judders: {repeated} % of frames repeat");
            let doubled = many(report.double_percent).map(|percent| format!("{percent} % jump"));
            return Self::new(severity, [Some(repeated), doubled]);
        }
        let how = if error < JUDDER_MS { "uneven" } else { "judders" };
        let how = format!("{how} by {} ms", round(error, 2));
        Self::new(severity, [Some(how), late])
    }
}

impl fmt::Display for LoopVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_is_shortened_from_its_end() {
        let parts = ["smooth", "loses 3 ms", "late"].map(|part| Some(part.to_owned()));
        let verdict = LoopVerdict::new(Severity::Fine, parts);
        let expected = ["smooth, loses 3 ms, late", "smooth, loses 3 ms", "smooth"];
        assert_eq!(verdict.wordings(), expected);
        assert_eq!(verdict.to_string(), expected[0]);
    }
}
