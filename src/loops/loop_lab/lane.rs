//! The frames of the body in one loop, and the metrics of a frame.

use std::sync::Arc;

use crate::run::past::Energies;
use crate::run::race::LaneBody;
use crate::run::{Scale, Unit};
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::Method;
use crate::{FrameTrace, GameTime, LoopRun, MIN_RUN_S, PacingReport, PolicyCard};

/// Maximum length of a loop's run, in seconds of the display.
const MAX_S: f64 = 20.0;

/// The body in one loop, with all frames once the loop has run.
pub struct LoopLane {
    card: Arc<PolicyCard>,
    frames: Vec<LoopFrame>,
    game_time: GameTime,
    report: Option<PacingReport>,
}

/// A displayed frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopFrame {
    /// Time of display in nanoseconds.
    pub displayed_ns: i64,
    /// Simulated time in the picture, in milliseconds.
    pub shown_ms: f64,
    /// Number of steps since the previous displayed frame.
    pub ticks: u32,
    /// Animation error in milliseconds; 0 for the first frame.
    pub animation_error_ms: f64,
    /// Coordinates of the body in the picture.
    pub q: Box<[f64]>,
    /// Exact coordinates at the time of display.
    pub exact: Box<[f64]>,
    /// State after the last step, which can differ from the picture.
    pub stepped: LoopState,
    /// Exact state at the time of display.
    pub exact_state: LoopState,
}

/// A state of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopState {
    /// First coordinate.
    pub q: f64,
    /// Velocity of the first coordinate.
    pub v: f64,
    /// Energies, if the body conserves energy.
    pub energies: Option<Energies>,
}

impl LoopState {
    fn of(body: &LaneBody) -> Self {
        let stepper = &*body.stepper;
        Self { q: stepper.q()[0], v: stepper.v()[0], energies: Energies::of(stepper) }
    }
}

impl LoopFrame {
    /// Returns the delay between the simulated time in the picture and the display, in milliseconds.
    pub fn latency_ms(&self) -> f64 {
        self.displayed_ns as f64 / 1e6 - self.shown_ms
    }
}

impl LoopLane {
    /// Creates a placeholder without frames for a loop that has not run yet.
    pub(super) fn awaited(card: Arc<PolicyCard>) -> Self {
        Self { card, frames: Vec::new(), game_time: GameTime::default(), report: None }
    }

    /// Runs a loop until it ends or `stop` returns true.
    pub(super) fn run(
        scene: &Scene,
        method: &'static Method,
        card: Arc<PolicyCard>,
        trace: &FrameTrace,
        stop: &dyn Fn() -> bool,
    ) -> Self {
        let mut frames: Vec<LoopFrame> = Vec::new();
        let mut ticks = 0;
        let until_ns = (scene.seconds.clamp(MIN_RUN_S, MAX_S) * 1e9) as i64;
        let mut game_time = GameTime::around_longest(trace, until_ns);
        let run = LoopRun::new(scene, LaneSpec::plain(method), &card, trace);
        let report = run.measure(until_ns, stop, |run, record| {
            ticks += record.steps.count;
            game_time.frame(run, record);
            let Some(displayed_ns) = record.frame.displayed_ns else { return };
            frames.push(LoopFrame {
                displayed_ns,
                shown_ms: record.shown_ms,
                ticks: std::mem::take(&mut ticks),
                animation_error_ms: record.animation_error_ms.unwrap_or_default(),
                q: run.lane().drawn_coordinates(0).into(),
                exact: run.exact(0).into(),
                stepped: LoopState::of(&run.lane().lane().bodies()[0]),
                exact_state: LoopState::of(run.exact_body(0)),
            });
        });
        Self { card, frames, game_time, report: Some(report) }
    }

    /// Returns the card of the loop's policy.
    pub fn card(&self) -> &PolicyCard {
        &self.card
    }
    /// Returns the displayed frames, in order.
    pub fn frames(&self) -> &[LoopFrame] {
        &self.frames
    }
    /// Returns the game time over real time, around the longest frame.
    pub fn game_time(&self) -> &GameTime {
        &self.game_time
    }
    /// Whether the loop has run.
    pub fn was_run(&self) -> bool {
        self.report.is_some()
    }
    /// Returns the measurements over all frames, once the loop has run.
    pub fn report(&self) -> Option<&PacingReport> {
        self.report.as_ref()
    }
    /// Returns the index of the frame on the display at `now_ns`.
    pub fn frame_at(&self, now_ns: i64) -> Option<usize> {
        self.frames.partition_point(|frame| frame.displayed_ns <= now_ns).checked_sub(1)
    }
}

/// A metric of a displayed frame.
#[derive(Debug)]
pub struct FrameMetric {
    /// Name of the metric in output, `snake_case`.
    pub id: &'static str,
    /// Name of the metric for people.
    pub name: &'static str,
    /// Unit of the metric.
    pub unit: Unit,
    /// Scale of the metric's plot.
    pub scale: Scale,
    /// Computes the metric's value.
    pub measure: fn(&LoopFrame) -> f64,
}

/// Every metric of a frame, in menu order.
pub static FRAME_METRICS: &[FrameMetric] = &[
    FrameMetric {
        id: "position_error",
        name: "position error",
        unit: Unit::Coordinate,
        scale: Scale::Log,
        measure: |frame| (frame.q[0] - frame.exact[0]).abs(),
    },
    FrameMetric {
        id: "animation_error",
        name: "animation error",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        measure: |frame| frame.animation_error_ms,
    },
    FrameMetric {
        id: "latency",
        name: "latency",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        measure: LoopFrame::latency_ms,
    },
    FrameMetric {
        id: "ticks",
        name: "ticks per frame",
        unit: Unit::One,
        scale: Scale::Linear,
        measure: |frame| f64::from(frame.ticks),
    },
];
