//! Runs a scene in a game loop over the frames of a trace.

use std::sync::Arc;

use super::metrics::{FrameRecord, PacingMeter, PacingReport};
use super::paced_lane::PacedLane;
use super::pacer::Pacer;
use super::policy::{FrameLimits, PolicyCard, Steps};
use super::scripted_truth::{MaxDistances, ScriptedTruth, TimedScript};
use super::time_base::TimeBase;
use super::trace::{Frame, FrameTrace, Frames};
use crate::run::race::{Lane, LaneBody};
use crate::scene::{LaneSpec, Scene};

/// Default minimum length of a run, in seconds. Every one-off event of a built-in trace happens before this time.
pub const MIN_RUN_S: f64 = 10.0;

/// A scene under one method in one loop, frame by frame.
///
/// The first frame starts the clock and shows the start, unless the trace
/// [counts its time](FrameTrace::lead_ns). Each later frame makes the steps that the loop decides on.
/// The scene's script acts before the first step at or after its time.
///
/// ```
/// use regatta_loops::{LoopRun, policy, trace_card, RefreshRate};
/// use regatta_scene::{LaneSpec, Scene};
/// use regatta_sim::integrators::method;
///
/// let scene = Scene::built_in("spring").expect("a built-in scene");
/// let rk4 = LaneSpec::plain(method("rk4").expect("a built-in method"));
/// let trace = trace_card("steady-144").expect("a built-in trace").trace(RefreshRate::new(60, 1));
/// let mut run = LoopRun::new(&scene, rk4, policy("fixed").expect("a built-in policy"), &trace);
/// while run.next_frame().is_some_and(|frame| frame.frame.began_ns < 10_000_000_000) {}
/// // At 144 Hz seven frames in twelve show the same 60 Hz tick again.
/// assert!((run.report().repeated_percent.expect("there were frames") - 58.33).abs() < 0.1);
/// ```
#[derive(Clone)]
pub struct LoopRun {
    lane: PacedLane,
    truth: ScriptedTruth,
    frames: Frames,
    meter: PacingMeter,
    last: Option<(Frame, Steps)>,
    script: TimedScript,
    /// Only every n-th frame of the trace is made.
    stride: u32,
    /// Time from the start of the run to the first frame of the trace, in nanoseconds.
    lead_ns: i64,
}

impl LoopRun {
    /// Prepares the run before its first frame, at the scene's tick rate.
    pub fn new(scene: &Scene, spec: LaneSpec, card: &Arc<PolicyCard>, trace: &FrameTrace) -> Self {
        Self::limited(scene, spec, card, trace, FrameLimits::default())
    }

    /// Like [`new`](Self::new), with limits on the work in a frame.
    pub fn limited(
        scene: &Scene,
        spec: LaneSpec,
        card: &Arc<PolicyCard>,
        trace: &FrameTrace,
        limits: FrameLimits,
    ) -> Self {
        let base = TimeBase::new(scene.tick_hz, trace.refresh());
        let lane = Lane::new(scene, spec.solver(), spec.substeps);
        let mut lane = PacedLane::new(Pacer::limited(card, base, limits), lane);
        if trace.lead_ns().is_some() && card.is_from_outside() {
            lane.frame(0, 0.0, |_, _, _| {});
        }
        Self {
            lane,
            truth: ScriptedTruth::new(scene),
            frames: trace.frames(),
            meter: PacingMeter::default(),
            last: trace
                .lead_ns()
                .is_some()
                .then(|| (Frame { began_ns: 0, displayed_ns: None }, Steps::default())),
            script: TimedScript::new(scene),
            stride: 1,
            lead_ns: trace.lead_ns().unwrap_or_default(),
        }
    }

    /// Returns the same run at half the frame rate, which skips every second frame.
    fn at_half_the_rate(self) -> Self {
        Self { stride: 2, ..self }
    }

    /// Returns the bodies in the loop.
    pub fn lane(&self) -> &PacedLane {
        &self.lane
    }

    /// Returns the exact coordinates of the body with this index at the last displayed frame.
    pub fn exact(&self, body: usize) -> &[f64] {
        self.truth.body(body).stepper.q()
    }

    /// Returns the body with this index in its exact state at the last displayed frame.
    pub(crate) fn exact_body(&self, body: usize) -> &LaneBody {
        self.truth.body(body)
    }

    /// Makes the next frame and returns it; `None` at the end of the trace.
    pub fn next_frame(&mut self) -> Option<FrameRecord> {
        let steps_before = self.last.map_or(0, |(_, steps)| steps.count);
        let mut frame = self.frames.next(steps_before)?;
        let mut ms = self.frames.duration_ms(frame);
        for _ in 1..if self.last.is_some() { self.stride } else { 1 } {
            frame = self.frames.next(0)?;
            ms += self.frames.duration_ms(frame);
        }
        frame.began_ns += self.lead_ns;
        frame.displayed_ns = frame.displayed_ns.map(|ns| ns + self.lead_ns);
        let steps = match self.last {
            None if !self.lane.pacer().card().is_from_outside() => Steps::default(),
            last => {
                let script = &mut self.script;
                let duration_ns = last.map_or(0, |(last, _)| frame.began_ns - last.began_ns);
                self.lane.frame(duration_ns, ms, |step, t, lane| {
                    while let Some((_, action)) = script.next_due(t) {
                        lane.act(step, t, &action);
                    }
                })
            }
        };
        self.last = Some((frame, steps));
        let pacer = self.lane.pacer();
        let animation_error_ms = self.meter.frame(frame, steps, pacer);
        if let Some(displayed_ns) = frame.displayed_ns {
            self.truth.compare(displayed_ns as f64 / 1e9, &self.lane);
        }
        let base = pacer.base();
        Some(FrameRecord {
            number: self.meter.frames() - 1,
            frame,
            shown_ms: base.milliseconds(pacer.drawn_moment()),
            steps,
            step_ms: base.milliseconds(steps.span),
            dropped_ms: base.milliseconds(steps.dropped),
            owed_ms: base.milliseconds(pacer.owed()),
            alpha: pacer.alpha(),
            animation_error_ms,
        })
    }

    /// Makes frames until one begins at or after `until_ns`, or `stop` returns true. Returns the time at which the last
    /// frame began.
    pub fn run_until(
        &mut self,
        until_ns: i64,
        stop: &dyn Fn() -> bool,
        mut seen: impl FnMut(&Self, &FrameRecord),
    ) -> i64 {
        while (self.began_ns() < until_ns || self.last.is_none()) && !stop() {
            let Some(record) = self.next_frame() else { break };
            seen(self, &record);
        }
        self.began_ns()
    }

    /// Returns the start of the last frame in nanoseconds; 0 before the first.
    fn began_ns(&self) -> i64 {
        self.last.map_or(0, |(frame, _)| frame.began_ns)
    }

    /// Runs to `until_ns` and also runs the same game at half the frame rate, to report their
    /// [difference](PacingReport::state_difference). The two runs are compared at every frame that they share, because
    /// motions that are whole periods apart look alike at a single moment. A log has no other rate.
    pub fn measure(
        mut self,
        until_ns: i64,
        stop: &dyn Fn() -> bool,
        mut seen: impl FnMut(&Self, &FrameRecord),
    ) -> PacingReport {
        if self.lane.pacer().card().is_log() {
            self.run_until(until_ns, stop, seen);
            return self.report();
        }
        let mut half = self.clone().at_half_the_rate();
        let mut furthest = MaxDistances::default();
        let mut report = None;
        while (half.began_ns() < until_ns || half.last.is_none()) && !stop() {
            if half.next_frame().is_none() {
                break;
            }
            let common_ns = half.began_ns();
            self.run_until(common_ns.min(until_ns), stop, &mut seen);
            if common_ns > until_ns {
                report = Some(self.report());
                self.run_until(common_ns, stop, |_, _| {});
            }
            self.truth.update_max_distances(&mut furthest, self.lane.lane(), half.lane.lane());
        }
        let [simulated, at_half] = [&self, &half].map(|run| run.lane.pacer().simulated());
        let time_difference = self.lane.pacer().base().milliseconds(simulated - at_half);
        let report = report.unwrap_or_else(|| {
            self.run_until(until_ns, stop, seen);
            self.report()
        });
        PacingReport {
            state_difference: self.truth.in_amplitudes(&furthest),
            time_difference_ms: Some(time_difference),
            ..report
        }
    }

    /// Returns the report on the frames so far.
    pub fn report(&self) -> PacingReport {
        let (steps, evaluations) = (self.lane.steps(), self.lane.evaluations());
        let report = self.meter.report(self.lane.pacer(), steps, evaluations);
        PacingReport { position_error_rms: self.truth.position_error_rms(), ..report }
    }
}
