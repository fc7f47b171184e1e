//! What is said of a loop in a line.

use super::LoopLab;
use super::lane::LoopLane;
use crate::lab::analysis::Severity;
use crate::sim::number::round;

/// An animation error that nobody sees, in milliseconds.
const SMOOTH_MS: f64 = 0.1;
/// One that many see.
const JUDDER_MS: f64 = 2.0;
/// A latency that is worth a word, in ticks.
const LATE_TICKS: f64 = 0.25;
/// Time by which a game is off at half the frame rate that shows that it runs at another speed, in ms.
const OTHER_SPEED_MS: f64 = 100.0;

/// What is said of a loop, and how bad it is.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopVerdict {
    /// How bad it is.
    pub severity: Severity,
    /// The words.
    pub text: String,
}

impl LoopLab {
    /// What is said in the place of plots until every loop on the stage was run.
    pub fn waiting(&self) -> Option<&'static str> {
        (!self.is_stage_complete()).then_some("Running the loops on the stage…")
    }
}

impl LoopLane {
    /// What is said of it, at this tick rate in Hz.
    pub fn verdict(&self, tick_hz: u32) -> LoopVerdict {
        let said = |severity, text: String| LoopVerdict { severity, text };
        let Some(report) = self.report() else {
            return said(Severity::Unknown, "running…".into());
        };
        let (Some(error), Some(latency)) = (report.animation_error_rms_ms, report.latency_mean_ms)
        else {
            return said(Severity::Unknown, "nothing displayed".into());
        };
        if report.time_difference_ms.is_some_and(|ms| ms.abs() > OTHER_SPEED_MS) {
            let text = "speed depends on the frame rate";
            return said(Severity::Bad, text.into());
        }
        let late = latency * f64::from(tick_hz) / 1000.0;
        let late = match late {
            late if late < LATE_TICKS => String::new(),
            late if (late - 1.0).abs() < 0.1 => ", one tick late".into(),
            _ => format!(", shows the past of {} ms ago", round(latency, 2)),
        };
        let [repeated, doubled] = [report.repeated_percent, report.double_percent]
            .map(|percent| round(percent.unwrap_or_default(), 3));
        match error {
            error if error < SMOOTH_MS && report.dropped_ms > 0.0 => {
                let text = format!("smooth, but drops {} ms{late}", round(report.dropped_ms, 3));
                said(Severity::Doubtful, text)
            }
            error if error < SMOOTH_MS => said(Severity::Fine, format!("smooth{late}")),
            error if report.repeated_percent > Some(1.0) => {
                let severity = if error < JUDDER_MS { Severity::Doubtful } else { Severity::Bad };
                let doubled = match report.double_percent > Some(1.0) {
                    true => format!(", {doubled} % jump"),
                    false => String::new(),
                };
                said(severity, format!("judders: {repeated} % of frames repeat{doubled}"))
            }
            error => {
                let (severity, how) = match error < JUDDER_MS {
                    true => (Severity::Doubtful, "uneven"),
                    false => (Severity::Bad, "judders"),
                };
                said(severity, format!("{how} by {} ms{late}", round(error, 2)))
            }
        }
    }
}
