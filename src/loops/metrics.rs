//! Measures how a loop looks to a viewer of the display.
//!
//! The animation error compares the change of the moment shown with the change of the time of display, from frame to
//! frame. A constant delay has none: an eye that follows a motion sees unevenness, while a hand at the controls feels
//! latency.

use super::pacer::Pacer;
use super::policy::Steps;
use super::trace::Frame;
use crate::run::Unit;

/// Tolerance for double steps in nanoseconds, because traces round to nanoseconds.
const LEEWAY_NS: i64 = 1000;

/// Measurements of a loop over a trace.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PacingReport {
    /// Number of frames, displayed or not.
    pub frames: u64,
    /// Number of displayed frames.
    pub displayed: u64,
    /// RMS animation error in milliseconds; `None` until two frames are displayed.
    pub animation_error_rms_ms: Option<f64>,
    /// Largest animation error in magnitude, in milliseconds.
    pub animation_error_max_ms: Option<f64>,
    /// Displayed frames that repeat the previous moment, in percent.
    pub repeated_percent: Option<f64>,
    /// Displayed frames that advance by two ticks or more, and also by at least half a tick more than the display does,
    /// in percent.
    pub double_percent: Option<f64>,
    /// Refreshes of the display that show the previous picture again, in percent.
    pub old_refreshes_percent: Option<f64>,
    /// Mean and maximum of display time minus the moment shown; negative for a game that runs ahead.
    pub(super) latency_ms: [Option<f64>; 2],
    /// Real time that the loop dropped, in milliseconds.
    pub dropped_ms: f64,
    /// Maximum of the real time that was neither simulated nor dropped, in milliseconds.
    pub owed_max_ms: f64,
    /// Real time that is neither simulated nor dropped at the end, in milliseconds; negative for a game that is ahead.
    pub owed_ms: f64,
    /// Simulated time in percent of the real time; `None` until time has passed.
    pub speed_percent: Option<f64>,
    /// Frames that simulate half a tick more than they last, while more than a tick and a half was owed before. A tick
    /// that rounding delays by a frame is none.
    pub fast_forward_frames: u64,
    /// Frames that show an earlier moment than the frame before.
    pub backward_frames: u64,
    /// RMS distance from the exact solution at the time of display, in amplitudes, for the worst body.
    pub position_error_rms: Option<f64>,
    /// Number of steps of the bodies.
    pub ticks: u64,
    /// Number of evaluations of the bodies' accelerations.
    pub evaluations: u64,
    /// Largest distance of the bodies from their positions in the same game at half the frame rate, over all shared
    /// frames, in amplitudes; `None` if not measured.
    pub state_difference: Option<f64>,
    /// Simulated time minus the simulated time at half the frame rate, in milliseconds; `None` if not measured.
    pub time_difference_ms: Option<f64>,
}

/// A game runs at another speed at half the frame rate if its time difference exceeds this, in milliseconds. The limit
/// exceeds a few ticks.
const OTHER_SPEED_MS: f64 = 100.0;
/// Position error above which the motion is lost, in amplitudes. The position error of a motion that is merely late is
/// at most two.
const LOST: f64 = 4.0;
/// Difference of the motion at half the frame rate, in amplitudes, above which it is more than rounding.
const OTHER_MOTION: f64 = 1e-9;

impl PacingReport {
    /// Returns the mean of display time minus the moment shown, in milliseconds. It is `None` until a frame is
    /// displayed. It is also `None` if the speed depends on the frame rate, because such a game runs ever further ahead
    /// of or behind the display.
    pub fn latency_mean_ms(&self) -> Option<f64> {
        self.latency_ms[0].filter(|_| self.keeps_speed() != Some(false))
    }

    /// Returns the maximum latency; `None` as for [`latency_mean_ms`](Self::latency_mean_ms).
    pub fn latency_max_ms(&self) -> Option<f64> {
        self.latency_ms[1].filter(|_| self.keeps_speed() != Some(false))
    }

    /// Whether the game has the same speed at half the frame rate; `None` if not measured.
    pub fn keeps_speed(&self) -> Option<bool> {
        self.time_difference_ms.map(|difference| difference.abs() <= OTHER_SPEED_MS)
    }

    /// Whether the motion no longer resembles the exact one. This happens, for example, if a method is too coarse for
    /// the tick.
    pub fn loses_motion(&self) -> bool {
        self.position_error_rms.is_some_and(|distance| distance.is_nan() || distance > LOST)
    }

    /// Returns the [difference of the motion](Self::state_difference) at half the frame rate, if it exceeds rounding.
    pub fn other_motion(&self) -> Option<f64> {
        self.state_difference.filter(|difference| *difference > OTHER_MOTION)
    }
}

/// A metric of a [`PacingReport`].
#[derive(Debug)]
pub struct PacingMetric {
    /// Name of the metric in output, `snake_case`.
    pub id: &'static str,
    /// Name of the metric for people.
    pub name: &'static str,
    /// Unit of the metric.
    pub unit: Unit,
    /// Description of the metric in one line.
    pub about: &'static str,
    /// Reads the metric's value from a report; `None` if the value has no meaning.
    pub measure: fn(&PacingReport) -> Option<f64>,
}

/// Every metric of a loop, in display order.
pub const PACING_METRICS: &[PacingMetric] = &[
    PacingMetric {
        id: "frames",
        name: "frames",
        unit: Unit::One,
        about: "frames made, displayed or not",
        measure: |report| Some(report.frames as f64),
    },
    PacingMetric {
        id: "animation_error_rms_ms",
        name: "animation error, RMS",
        unit: Unit::Milliseconds,
        about: "change of the moment shown minus change of the moment of display, from frame to frame: judder",
        measure: |report| report.animation_error_rms_ms,
    },
    PacingMetric {
        id: "animation_error_max_ms",
        name: "largest animation error",
        unit: Unit::Milliseconds,
        about: "the largest animation error of a frame, by magnitude",
        measure: |report| report.animation_error_max_ms,
    },
    PacingMetric {
        id: "repeated_percent",
        name: "repeated frames",
        unit: Unit::Percent,
        about: "displayed frames that show the same moment as the one before",
        measure: |report| report.repeated_percent,
    },
    PacingMetric {
        id: "double_percent",
        name: "double steps",
        unit: Unit::Percent,
        about: "displayed frames that show two ticks or more at once, half a tick or more beyond the display's own progress",
        measure: |report| report.double_percent,
    },
    PacingMetric {
        id: "old_refreshes_percent",
        name: "old refreshes",
        unit: Unit::Percent,
        about: "refreshes of the display that show the picture before again, because no frame was ready",
        measure: |report| report.old_refreshes_percent,
    },
    PacingMetric {
        id: "latency_mean_ms",
        name: "mean latency",
        unit: Unit::Milliseconds,
        about: "mean of the moment of display minus the moment shown; none where the speed depends on the frame rate",
        measure: PacingReport::latency_mean_ms,
    },
    PacingMetric {
        id: "latency_max_ms",
        name: "largest latency",
        unit: Unit::Milliseconds,
        about: "largest moment of display minus the moment shown",
        measure: PacingReport::latency_max_ms,
    },
    PacingMetric {
        id: "dropped_ms",
        name: "dropped time",
        unit: Unit::Milliseconds,
        about: "real time that was given up: the game falls behind",
        measure: |report| Some(report.dropped_ms),
    },
    PacingMetric {
        id: "owed_max_ms",
        name: "most owed time",
        unit: Unit::Milliseconds,
        about: "the most real time that was neither simulated nor given up",
        measure: |report| Some(report.owed_max_ms),
    },
    PacingMetric {
        id: "position_error_rms",
        name: "position error, RMS",
        unit: Unit::Amplitudes,
        about: "distance from the exact solution at the moment of display, of the worst body",
        measure: |report| report.position_error_rms,
    },
    PacingMetric {
        id: "ticks",
        name: "ticks",
        unit: Unit::One,
        about: "steps made, of whatever length",
        measure: |report| Some(report.ticks as f64),
    },
    PacingMetric {
        id: "evaluations",
        name: "evaluations",
        unit: Unit::One,
        about: "evaluations of the bodies' accelerations",
        measure: |report| Some(report.evaluations as f64),
    },
    PacingMetric {
        id: "speed_percent",
        name: "speed",
        unit: Unit::Percent,
        about: "simulated time over real time",
        measure: |report| report.speed_percent,
    },
    PacingMetric {
        id: "owed_ms",
        name: "owed time",
        unit: Unit::Milliseconds,
        about: "real time that is neither simulated nor given up at the end; negative where the game is ahead",
        measure: |report| Some(report.owed_ms),
    },
    PacingMetric {
        id: "fast_forward_frames",
        name: "fast-forward",
        unit: Unit::One,
        about: "frames that simulate half a tick more than they last, to catch up on time owed before",
        measure: |report| Some(report.fast_forward_frames as f64),
    },
    PacingMetric {
        id: "backward_frames",
        name: "backward frames",
        unit: Unit::One,
        about: "frames that show an earlier moment than the frame before",
        measure: |report| Some(report.backward_frames as f64),
    },
    PacingMetric {
        id: "state_difference",
        name: "difference at half the frame rate",
        unit: Unit::Amplitudes,
        about: "the largest distance between the bodies with all frames and with every second frame left out",
        measure: |report| report.state_difference,
    },
];

/// Accumulates the metrics of a loop, frame by frame. Times are in the unit of its [`TimeBase`](super::TimeBase).
#[derive(Clone, Debug, Default)]
pub(super) struct PacingMeter {
    frames: u64,
    displayed: u64,
    /// Display time of the last displayed frame, and the moment that it shows.
    last: Option<[i128; 2]>,
    squares_ms2: f64,
    largest_error: i128,
    repeated: u64,
    doubled: u64,
    latency: i128,
    largest_latency: Option<i128>,
    max_owed: i128,
    /// Refreshes of the display since its first picture, and those among them that show the previous picture.
    refreshes: i128,
    old_refreshes: i128,
    /// Time that had passed, time owed and moment shown in the last frame.
    before: Option<[i128; 3]>,
    fast_forward: u64,
    backward: u64,
}

impl PacingMeter {
    pub(super) fn frames(&self) -> u64 {
        self.frames
    }

    /// Adds a frame after its steps. Returns its animation error in milliseconds if this frame and an earlier one were
    /// displayed.
    pub(super) fn frame(&mut self, frame: Frame, steps: Steps, pacer: &Pacer) -> Option<f64> {
        self.frames += 1;
        self.max_owed = self.max_owed.max(pacer.owed());
        let base = pacer.base();
        let (tick, leeway) = (pacer.tick(), base.nanoseconds(LEEWAY_NS));
        let shown = pacer.drawn_moment();
        let now = [pacer.passed(), pacer.owed(), shown];
        if let Some([passed, owed, shown_before]) = self.before.replace(now) {
            let gained = steps.span - (pacer.passed() - passed);
            self.fast_forward += u64::from(2 * owed >= 3 * tick && 2 * gained >= tick);
            self.backward += u64::from(shown + leeway < shown_before);
        }
        let displayed = base.nanoseconds(frame.displayed_ns?);
        self.displayed += 1;
        let latency = displayed - shown;
        self.latency += latency;
        self.largest_latency = self.largest_latency.max(Some(latency));
        let [displayed_before, shown_before] = self.last.replace([displayed, shown])?;
        let progress = shown - shown_before;
        let error = progress - (displayed - displayed_before);
        self.repeated += u64::from(progress == 0);
        let refresh = base.refresh();
        let lasted = (2 * (displayed - displayed_before) + refresh).div_euclid(2 * refresh).max(1);
        self.refreshes += lasted;
        self.old_refreshes += lasted - 1;
        self.doubled += u64::from(progress + leeway >= 2 * tick && 2 * (error + leeway) >= tick);
        if error.abs() > self.largest_error.abs() {
            self.largest_error = error;
        }
        let error_ms = base.milliseconds(error);
        self.squares_ms2 += error_ms * error_ms;
        Some(error_ms)
    }

    /// Returns the report so far on a loop that made `ticks` steps with `evaluations`.
    pub(super) fn report(&self, pacer: &Pacer, ticks: u64, evaluations: u64) -> PacingReport {
        let base = pacer.base();
        let (displayed, changes) = (self.displayed as f64, self.displayed.saturating_sub(1) as f64);
        let of_changes = |value: f64| (changes > 0.0).then(|| value / changes);
        PacingReport {
            frames: self.frames,
            displayed: self.displayed,
            animation_error_rms_ms: of_changes(self.squares_ms2).map(f64::sqrt),
            animation_error_max_ms: of_changes(
                changes * base.milliseconds(self.largest_error.abs()),
            ),
            repeated_percent: of_changes(100.0 * self.repeated as f64),
            double_percent: of_changes(100.0 * self.doubled as f64),
            old_refreshes_percent: (self.refreshes > 0)
                .then(|| 100.0 * self.old_refreshes as f64 / self.refreshes as f64),
            latency_ms: [
                (displayed > 0.0).then(|| base.milliseconds(self.latency) / displayed),
                self.largest_latency.map(|latency| base.milliseconds(latency)),
            ],
            dropped_ms: base.milliseconds(pacer.dropped()),
            owed_max_ms: base.milliseconds(self.max_owed),
            owed_ms: base.milliseconds(pacer.owed()),
            speed_percent: (pacer.passed() != 0)
                .then(|| 100.0 * pacer.simulated() as f64 / pacer.passed() as f64),
            fast_forward_frames: self.fast_forward,
            backward_frames: self.backward,
            position_error_rms: None,
            ticks,
            evaluations,
            state_difference: None,
            time_difference_ms: None,
        }
    }
}

/// A frame that the loop made, with its steps.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRecord {
    /// Index of the frame, from 0.
    pub number: u64,
    /// Times when the frame began and was displayed.
    pub frame: Frame,
    /// Simulated moment that the frame shows, in milliseconds.
    pub shown_ms: f64,
    /// Steps of the frame.
    pub steps: Steps,
    /// Simulated time of the frame's steps, in milliseconds.
    pub step_ms: f64,
    /// Real time that the frame dropped, in milliseconds.
    pub dropped_ms: f64,
    /// Real time that is neither simulated nor dropped after the frame, in milliseconds.
    pub owed_ms: f64,
    /// Position of the picture [between two ticks](Pacer::alpha).
    pub alpha: f64,
    /// Animation error in milliseconds, if this frame and an earlier one were displayed.
    pub animation_error_ms: Option<f64>,
}
