//! The loop lab, which shows one body under one method in every game loop, over the same frames, in slow motion.
//!
//! A run has few frames, so the lab keeps them all and moves through them by lookup. After each choice a
//! [`LoopWorker`] runs the loops in the background, and the lab shows each loop as soon as it has run.

use std::sync::{Arc, LazyLock};

use super::advice::is_same_rate;
use super::{
    AdvisedLoop, ENGINES, FrameTrace, LoopVerdict, MeasuredLoops, NoLoop, POLICIES, PolicyCard,
    RefreshRate, TRACES, TraceCard, USUAL_LATENCY_MS, own_loop,
};
use crate::run::race::LaneBody;
use crate::scene::Scene;
use crate::sim::integrators::Method;
use crate::sim::{Solver, TickRate};

mod lane;
mod running;

pub use lane::{FRAME_METRICS, FrameMetric, LoopFrame, LoopLane, LoopState};
pub use running::{FoundLoop, LoopRequest, LoopWorker};

/// The opening traces, each with the two policies on the stage. The first trace is noise, on which raw ticks flip
/// between none and two; it shows the raw loop and one that heals noise. The second is a display with too few ticks,
/// and shows the raw loop and the usual remedy.
const OPENING: [(&str, [&str; 2]); 2] =
    [("edge", [RAW, "whole-refresh"]), ("steady-144", [RAW, "fixed-linear"])];
/// Id of the loop that draws its ticks without interpolation.
pub const RAW: &str = "fixed";
/// Length of the opening's first trace, in nanoseconds of the display, which is long enough to see a judder.
const OPENING_NS: i64 = 1_500_000_000;
/// Maximum number of policies on the stage.
pub const MAX_ON_STAGE: usize = 4;
/// Slow-motion factors. In faster playback, the monitor's own judder shows too.
pub const SLOWNESS: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// Initial slow-motion factor.
pub const SLOWNESS_AT_FIRST: u32 = 8;
/// The raw loop with a clock in floats, which runs beside the others where rounding decides on its ticks.
static IN_FLOATS: LazyLock<Arc<PolicyCard>> = LazyLock::new(|| {
    let lines = include_str!("../../assets/loops/fixed-in-floats.loop");
    own_loop("fixed-in-floats", lines).expect("lines that a test runs")
});
/// Refresh rate of a trace that names none.
const DISPLAY: RefreshRate = RefreshRate::new(60, 1);

/// A command in the loop lab.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopCommand {
    /// Opens or closes the loop lab.
    ToggleLab,
    /// Selects the loop with this index in [`POLICIES`] and puts it on the stage.
    Select(usize),
    /// Runs the engine with this index in [`ENGINES`] beside the loops, and puts it on the stage.
    Engine(usize),
    /// Takes the loop with this index off the stage or, if it is not there, puts it on the stage.
    ToggleOnStage(usize),
    /// Chooses the trace with this index.
    Trace(usize),
    /// Sets the slow-motion factor.
    Slowness(u32),
    /// Moves to this time of the display, in nanoseconds.
    Seek(i64),
    /// Shows the game time over real time, or the moments shown.
    ShowGameTime(bool),
}

/// One body under one method in every loop, and the playback position.
pub struct LoopLab {
    /// The scene with this one body only.
    scene: Arc<Scene>,
    method: &'static Method,
    /// The body at its start, from which its look is drawn.
    body: LaneBody,
    traces: Vec<FrameTrace>,
    trace: usize,
    /// The request to run all loops.
    request: Arc<LoopRequest>,
    lanes: Vec<LoopLane>,
    /// The chosen engine or loop of a person, whose lane is the last.
    engine: Option<Arc<PolicyCard>>,
    /// The recommended loop or, if there is none, the reason; `None` until all loops have run.
    advice: Option<Result<AdvisedLoop, NoLoop>>,
    /// Range of the exact first coordinate.
    range: [f64; 2],
    on_stage: Vec<usize>,
    /// Whether a person chose the lanes on the stage.
    is_stage_chosen: bool,
    /// Whether playback continues with the second trace of the opening by itself.
    plays_opening: bool,
    /// Index of the plotted metric in [`FRAME_METRICS`].
    metric: usize,
    /// Whether the lanes on the stage overlap instead of lying below each other.
    pub is_overlaid: bool,
    /// Whether the instrument shows game time over real time instead of the moments shown.
    pub shows_game_time: bool,
    selected: usize,
    now_ns: i64,
    end_ns: i64,
    slowness: u32,
}

impl LoopLab {
    /// Creates the lab for one body of a scene, at the start. No loop has [run](Self::request) yet.
    pub fn new(scene: &Scene, body: usize, method: &'static Method) -> Self {
        let mut cards: Vec<&TraceCard> = TRACES.iter().collect();
        cards.sort_by_key(|card| {
            let first = OPENING.iter().position(|(id, _)| *id == card.id);
            first.unwrap_or(OPENING.len())
        });
        let scene = Arc::new(scene.clone().of_one_body(body));
        let traces: Vec<_> = cards.into_iter().map(|card| card.trace(DISPLAY)).collect();
        let trace = traces[0].clone();
        let mut lab = Self {
            body: at_start(&scene),
            request: Arc::new(LoopRequest {
                scene: scene.clone(),
                method,
                trace,
                first: vec![],
                engine: None,
            }),
            scene,
            method,
            traces,
            trace: 0,
            lanes: Vec::new(),
            engine: None,
            advice: None,
            range: [0.0; 2],
            selected: 0,
            on_stage: Vec::new(),
            is_stage_chosen: false,
            plays_opening: false,
            metric: 0,
            is_overlaid: false,
            shows_game_time: false,
            now_ns: 0,
            end_ns: 0,
            slowness: SLOWNESS_AT_FIRST,
        };
        lab.choose_trace(0);
        lab
    }

    /// Lets playback continue with the second trace of the opening by itself, until [`end_opening`](Self::end_opening).
    pub fn play_opening(&mut self) {
        self.plays_opening = true;
    }

    /// Lets playback stay on the chosen trace.
    pub fn end_opening(&mut self) {
        self.plays_opening = false;
    }

    /// Shows the body with this index in another scene, from its start.
    pub fn show(&mut self, scene: &Scene, body: usize) {
        self.scene = Arc::new(scene.clone().of_one_body(body));
        if self.scene.refusal(self.method).is_some() {
            let mut fitting = self.scene.fitting_methods();
            self.method = fitting.next().expect("some methods step every body");
        }
        self.body = at_start(&self.scene);
        self.now_ns = 0;
        self.request_loops();
    }

    /// Requests all loops again and discards the lanes of the previous choice.
    fn request_loops(&mut self) {
        self.request = Arc::new(LoopRequest {
            scene: self.scene.clone(),
            method: self.method,
            trace: self.traces[self.trace].clone(),
            first: self.on_stage.clone(),
            engine: self.beside(),
        });
        self.lanes = POLICIES.iter().cloned().chain(self.beside()).map(LoopLane::awaited).collect();
        self.on_stage.retain(|&index| index < self.lanes.len());
        if self.on_stage.is_empty() {
            self.on_stage.push(index_of(RAW));
        }
        if self.selected >= self.lanes.len() {
            self.selected = self.on_stage[0];
        }
        self.advice = None;
        self.end_ns = 0;
        self.range = [f64::INFINITY, f64::NEG_INFINITY];
    }

    /// Returns the loop that runs beside the ideal ones. Without a chosen engine it is the raw loop with a clock in
    /// floats, where ticks are as frequent as refreshes.
    fn beside(&self) -> Option<Arc<PolicyCard>> {
        let refresh = self.traces[self.trace].refresh();
        let in_floats = || is_same_rate(self.scene.tick_hz, refresh).then(|| IN_FLOATS.clone());
        self.engine.clone().or_else(in_floats)
    }

    /// Returns the request for a [`LoopWorker`]. Every choice replaces the request with a new one.
    pub fn request(&self) -> &Arc<LoopRequest> {
        &self.request
    }

    /// Shows a loop that has run, or drops the loop if its request is outdated.
    pub fn accept(&mut self, found: FoundLoop) {
        let FoundLoop { request, index, lane } = found;
        if !Arc::ptr_eq(&request, &self.request) {
            return;
        }
        let end_ns = lane.frames().last().map(|frame| frame.displayed_ns);
        self.end_ns = self.end_ns.max(end_ns.unwrap_or_default());
        let exact = lane.frames().iter().map(|frame| frame.exact[0]);
        self.range = exact.fold(self.range, |[least, most], q| [least.min(q), most.max(q)]);
        self.lanes[index] = lane;
        if self.is_complete() {
            self.now_ns = self.now_ns.min(self.end_ns);
            self.advice = self.measured().map(|loops| loops.advised(USUAL_LATENCY_MS));
            self.bring_advised_on_stage();
        }
    }

    /// Shows the raw loop beside the recommended loop or the one nearest to a recommendation, unless a person chose the
    /// lanes on the stage.
    fn bring_advised_on_stage(&mut self) {
        let raw = index_of(RAW);
        if let Some(best) = self.best().filter(|best| *best != raw && !self.is_stage_chosen) {
            self.on_stage = vec![raw.min(best), raw.max(best)];
            // Where the raw loop flutters by itself, rounding adds nothing.
            let is_even =
                self.lanes[raw].report().is_some_and(|raw| raw.repeated_percent == Some(0.0));
            if is_even && self.engine.is_none() && self.lanes.len() > POLICIES.len() {
                self.on_stage.push(POLICIES.len());
            }
            self.selected = raw;
        }
    }

    /// Returns all measured loops; `None` until all have run.
    fn measured(&self) -> Option<MeasuredLoops<'_>> {
        // An engine's loop is not advised to a game that has another.
        let measured =
            self.lanes.iter().take(POLICIES.len()).map(|lane| Some((lane.card(), lane.report()?)));
        let measured: Vec<_> = measured.collect::<Option<_>>()?;
        let trace = &self.traces[self.trace];
        let (refresh, has_one_clock) = (trace.refresh(), trace.has_one_clock());
        Some(MeasuredLoops::new(measured, self.scene.tick_hz, refresh, has_one_clock))
    }

    /// Whether every loop has run.
    pub fn is_complete(&self) -> bool {
        self.lanes.iter().all(LoopLane::was_run)
    }

    /// Whether every loop on the stage has run.
    pub fn is_stage_complete(&self) -> bool {
        self.on_stage.iter().all(|&index| self.lanes[index].was_run())
    }

    /// Returns the scene, reduced to the one body.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// Returns the method that steps the body.
    pub fn method(&self) -> &'static Method {
        self.method
    }
    /// Returns the body at its start.
    pub fn body(&self) -> &LaneBody {
        &self.body
    }
    /// Returns the range of the exact first coordinate over all loops that have run; zeros if none has run.
    pub fn range(&self) -> [f64; 2] {
        if self.range[0] > self.range[1] { [0.0; 2] } else { self.range }
    }
    /// Returns the available traces: first the built-in ones, then the opened ones.
    pub fn traces(&self) -> &[FrameTrace] {
        &self.traces
    }
    /// Returns the index of the chosen trace.
    pub fn trace(&self) -> usize {
        self.trace
    }
    /// Returns the chosen trace.
    pub fn chosen_trace(&self) -> &FrameTrace {
        &self.traces[self.trace]
    }
    /// Returns the chosen engine, or loop of a person.
    pub fn engine(&self) -> Option<&PolicyCard> {
        self.engine.as_deref()
    }

    /// Runs the engine with this index in [`ENGINES`] beside the loops, and puts it on the stage.
    pub fn choose_engine(&mut self, index: usize) {
        if let Some(card) = ENGINES.get(index) {
            self.run_beside(card.clone());
        }
    }

    /// Runs the loop of an engine or of a person beside the others, and puts it on the stage.
    pub fn run_beside(&mut self, card: Arc<PolicyCard>) {
        self.engine = Some(card.clone());
        self.lanes.truncate(POLICIES.len());
        self.lanes.push(LoopLane::awaited(card));
        self.select(POLICIES.len());
        self.request_loops();
    }

    /// Returns the lanes of all loops, in the order of [`POLICIES`], and then that of the loop beside them.
    pub fn lanes(&self) -> &[LoopLane] {
        &self.lanes
    }
    /// Returns the recommended loop, by its index in [`POLICIES`]; `None` until all loops have run, or if none
    /// qualifies.
    pub fn advised(&self) -> Option<AdvisedLoop> {
        self.advice?.ok()
    }
    /// Returns why no loop is recommended, with reasons clause by clause; `None` until all loops have run, or if one is
    /// recommended.
    pub fn none_advised(&self) -> Option<(NoLoop, Vec<String>)> {
        let none = self.advice?.err()?;
        Some((none, self.measured()?.reasons(none, USUAL_LATENCY_MS, |card| &card.name)))
    }
    /// Returns the index of the recommended loop, or of the loop that is nearest to a recommendation.
    fn best(&self) -> Option<usize> {
        self.advice?.map_or_else(NoLoop::nearest, |advised| Some(advised.index))
    }
    /// Returns the order of the lanes in the list. The chosen engine comes first, then the recommended loop or the one
    /// nearest to a recommendation. The raw loop in floats follows that without. The others have the order of
    /// [`POLICIES`].
    pub fn listed(&self) -> Vec<usize> {
        let mut first: Vec<usize> =
            self.engine.as_ref().map(|_| POLICIES.len()).into_iter().collect();
        first.extend(self.best());
        if self.engine.is_none() && self.lanes.len() > POLICIES.len() {
            first.extend([index_of(RAW), POLICIES.len()]);
            first.dedup();
        }
        let others = (0..self.lanes.len()).filter(|index| !first.contains(index));
        first.iter().copied().chain(others).collect()
    }
    /// Returns a text to show instead of the plots until every loop on the stage has run.
    pub fn waiting(&self) -> Option<&'static str> {
        (!self.is_stage_complete()).then_some("Running the loops on the stage…")
    }
    /// Returns the verdict on the loop with this index in [`POLICIES`].
    pub fn verdict(&self, index: usize) -> LoopVerdict {
        let lane = &self.lanes[index];
        let Some(report) = lane.report() else { return LoopVerdict::awaited() };
        let mut verdict = LoopVerdict::of(lane.card(), report, self.scene.tick_hz);
        if self.advised().is_some_and(|advised| advised.index == index) {
            verdict.parts.insert(0, "recommended".into());
        }
        verdict
    }
    /// Returns the indices of the lanes on the stage, from top to bottom.
    pub fn on_stage(&self) -> &[usize] {
        &self.on_stage
    }
    /// Returns the index of the selected lane.
    pub fn selected(&self) -> usize {
        self.selected
    }
    /// Returns the playback position, which is a time of the display in nanoseconds.
    pub fn now_ns(&self) -> i64 {
        self.now_ns
    }
    /// Returns the delay of the frame on the display, in milliseconds. It is the frame's latency. If the display has
    /// held the frame for more than two refreshes, the time since the frame appeared is added.
    pub fn late_ms(&self, frame: &LoopFrame) -> f64 {
        let held_ms = (self.now_ns - frame.displayed_ns) as f64 / 1e6;
        let refresh_ms = 1000.0 / self.traces[self.trace].refresh().hz();
        frame.latency_ms() + if held_ms > 2.0 * refresh_ms { held_ms } else { 0.0 }
    }
    /// Returns the end of the longest loop that has run, in nanoseconds; 0 if none has run.
    pub fn end_ns(&self) -> i64 {
        self.end_ns
    }
    /// Returns the slow-motion factor.
    pub fn slowness(&self) -> u32 {
        self.slowness
    }

    /// Returns the index in [`FRAME_METRICS`] of the metric that the error instrument shows.
    pub fn metric(&self) -> usize {
        self.metric
    }

    /// Shows the metric with this index in [`FRAME_METRICS`] in the error instrument.
    pub fn set_metric(&mut self, index: usize) {
        self.metric = index.min(FRAME_METRICS.len() - 1);
    }

    /// Chooses a trace, and keeps the playback position if the trace is long enough. A trace of the opening puts its
    /// policies on the stage, unless a person chose others.
    pub fn choose_trace(&mut self, index: usize) {
        self.trace = index.min(self.traces.len() - 1);
        let name = self.traces[self.trace].name();
        let opening = OPENING.iter().find(|(id, _)| *id == name && !self.is_stage_chosen);
        if let Some((_, ids)) = opening {
            self.on_stage = ids.map(index_of).into();
            self.selected = self.on_stage[0];
        }
        self.request_loops();
    }

    /// Adds traces and chooses the first of them.
    pub fn add_traces(&mut self, traces: Vec<FrameTrace>) {
        let index = self.traces.len();
        self.traces.extend(traces);
        self.choose_trace(index);
    }

    /// Sets the tick rate, clamped to [`Clock::TICK_HZ`](crate::sim::Clock::TICK_HZ).
    pub fn set_tick_hz(&mut self, tick_hz: impl Into<TickRate>) {
        Arc::make_mut(&mut self.scene).tick_hz = tick_hz.into().clamp(TickRate::MIN, TickRate::MAX);
        self.request_loops();
    }

    /// Restarts all loops with this method.
    pub fn set_method(&mut self, method: &'static Method) {
        self.method = method;
        self.request_loops();
    }

    /// Sets the slow-motion factor, clamped to the range of [`SLOWNESS`].
    pub fn set_slowness(&mut self, slowness: u32) {
        self.slowness = slowness.clamp(SLOWNESS[0], SLOWNESS[SLOWNESS.len() - 1]);
    }

    /// Selects the lane with this index and puts it on the stage.
    pub fn select(&mut self, index: usize) {
        if index >= self.lanes.len() {
            return;
        }
        self.selected = index;
        self.is_stage_chosen = true;
        if !self.on_stage.contains(&index) {
            if self.on_stage.len() == MAX_ON_STAGE {
                self.on_stage.remove(0);
            }
            self.on_stage.push(index);
            self.on_stage.sort_unstable();
        }
    }

    /// Takes the lane with this index off the stage or, if it is not there, puts it on the stage. The last lane on the
    /// stage stays there.
    pub fn toggle(&mut self, index: usize) {
        self.is_stage_chosen = true;
        match self.on_stage.iter().position(|&shown| shown == index) {
            Some(_) if self.on_stage.len() == 1 => {}
            Some(shown) => {
                self.on_stage.remove(shown);
                self.selected = self.on_stage[0];
            }
            None => self.select(index),
        }
    }

    /// Advances playback by `real_ns` nanoseconds of real time, and wraps around at the end. The opening continues with
    /// its next trace. Playback waits until all loops on the stage have run.
    pub fn advance(&mut self, real_ns: i64) {
        if !self.is_stage_complete() {
            return;
        }
        self.now_ns += real_ns.max(0) / i64::from(self.slowness);
        if self.plays_opening && self.now_ns > OPENING_NS {
            self.plays_opening = self.trace + 2 < OPENING.len();
            self.now_ns = 0;
            self.choose_trace(self.trace + 1);
        }
        if self.now_ns > self.end_ns && self.is_complete() {
            self.now_ns = 0;
        }
    }

    /// Moves to a time of the display, in nanoseconds.
    pub fn seek(&mut self, now_ns: i64) {
        self.now_ns = now_ns.clamp(0, self.end_ns);
    }

    /// Moves forward or back by frames of the selected lane.
    pub fn step(&mut self, frames: i64) {
        let frames_of = self.lanes[self.selected].frames();
        let at = self.lanes[self.selected].frame_at(self.now_ns).unwrap_or_default() as i64;
        let index = (at + frames).clamp(0, frames_of.len().max(1) as i64 - 1);
        if let Some(frame) = frames_of.get(index as usize) {
            self.now_ns = frame.displayed_ns;
        }
    }

    /// Returns the card of the selected policy.
    pub fn selected_card(&self) -> &PolicyCard {
        self.lanes[self.selected].card()
    }
}

/// Returns the index of the loop with this id in [`POLICIES`].
fn index_of(id: &str) -> usize {
    POLICIES.iter().position(|card| card.id == id).expect("a built-in loop")
}

/// Returns the scene's only body at its start.
fn at_start(scene: &Scene) -> LaneBody {
    let body = &scene.bodies[0];
    LaneBody::new(body, Solver::Truth)
}

#[cfg(test)]
mod tests;
