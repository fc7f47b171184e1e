//! The body in one loop, frame by frame, and what is measured of a frame.

use crate::loops::{FrameTrace, LoopRun, MIN_RUN_S, PacingReport, PolicyCard};
use crate::run::past::Energies;
use crate::run::race::LaneBody;
use crate::run::{Scale, Unit};
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::Method;

/// The longest run, in seconds of the display.
const MAX_S: f64 = 20.0;

/// The body in one loop: all its frames, once it was run.
pub struct LoopLane {
    card: &'static PolicyCard,
    frames: Vec<LoopFrame>,
    report: Option<PacingReport>,
}

/// A displayed frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopFrame {
    /// When it is displayed, in nanoseconds.
    pub displayed_ns: i64,
    /// The simulated moment that it shows, in milliseconds.
    pub shown_ms: f64,
    /// The steps made for it, with those for frames before that were not displayed.
    pub ticks: u32,
    /// The animation error in milliseconds; 0 for the first.
    pub animation_error_ms: f64,
    /// The coordinates of the body as it shows them.
    pub q: Box<[f64]>,
    /// The exact coordinates at the moment of display.
    pub exact: Box<[f64]>,
    /// The body after the last step, which is not always what is shown.
    pub stepped: LoopState,
    /// The exact body at the moment of display.
    pub exact_state: LoopState,
}

/// A state of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopState {
    /// The first coordinate.
    pub q: f64,
    /// Its velocity.
    pub v: f64,
    /// The energies, if the body conserves energy.
    pub energies: Option<Energies>,
}

impl LoopState {
    fn of(body: &LaneBody) -> Self {
        let stepper = &*body.stepper;
        Self { q: stepper.q()[0], v: stepper.v()[0], energies: Energies::of(stepper) }
    }
}

impl LoopFrame {
    /// How far the moment shown is behind the display, in milliseconds.
    pub fn latency_ms(&self) -> f64 {
        self.displayed_ns as f64 / 1e6 - self.shown_ms
    }
}

impl LoopLane {
    /// A loop that was not run yet: no frames.
    pub(super) fn awaited(card: &'static PolicyCard) -> Self {
        Self { card, frames: Vec::new(), report: None }
    }

    /// Runs a loop, or the part of it before `stop` says so.
    pub(super) fn run(
        scene: &Scene,
        method: &'static Method,
        card: &'static PolicyCard,
        trace: &FrameTrace,
        stop: &dyn Fn() -> bool,
    ) -> Self {
        let mut frames: Vec<LoopFrame> = Vec::new();
        let mut ticks = 0;
        let until_ns = (scene.seconds.clamp(MIN_RUN_S, MAX_S) * 1e9) as i64;
        let run = LoopRun::new(scene, LaneSpec::plain(method), card, trace);
        let report = run.measure(until_ns, stop, |run, record| {
            ticks += record.steps.count;
            let Some(displayed_ns) = record.frame.displayed_ns else { return };
            frames.push(LoopFrame {
                displayed_ns,
                shown_ms: record.shown_ms,
                ticks: std::mem::take(&mut ticks),
                animation_error_ms: record.animation_error_ms.unwrap_or_default(),
                q: run.lane().drawn(0).into(),
                exact: run.exact(0).into(),
                stepped: LoopState::of(&run.lane().lane().bodies()[0]),
                exact_state: LoopState::of(run.exact_body(0)),
            });
        });
        Self { card, frames, report: Some(report) }
    }

    /// Its policy.
    pub fn card(&self) -> &'static PolicyCard {
        self.card
    }
    /// The frames that are displayed, in order.
    pub fn frames(&self) -> &[LoopFrame] {
        &self.frames
    }
    /// Whether it was run.
    pub fn was_run(&self) -> bool {
        self.report.is_some()
    }
    /// What is seen over all frames, once it was run.
    pub fn report(&self) -> Option<&PacingReport> {
        self.report.as_ref()
    }
    /// The index of the frame that the display holds at `now_ns`.
    pub fn frame_at(&self, now_ns: i64) -> Option<usize> {
        self.frames.partition_point(|frame| frame.displayed_ns <= now_ns).checked_sub(1)
    }
}

/// A measure of a displayed frame.
#[derive(Debug)]
pub struct FrameMetric {
    /// Its name in output, `snake_case`.
    pub id: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// How it is plotted.
    pub scale: Scale,
    /// Its value.
    pub measure: fn(&LoopFrame) -> f64,
}

/// Every measure of a frame, in menu order.
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
