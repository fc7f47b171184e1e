//! The loop lab: one body under one method in every game loop, over the same frames, in slow motion.
//!
//! Frames are few, so that all of them are made when something is chosen: going back and forth is looking them up.

use std::sync::Arc;

use super::action::Action;
use super::lane::LaneBody;
use super::pacing::{FrameTrace, POLICIES, PolicyCard, RefreshRate, TRACES, TraceCard};
use super::scene::Scene;
use crate::sim::Solver;
use crate::sim::integrators::Method;

mod frame_metrics;
mod lane;
mod words;

pub use frame_metrics::{FRAME_METRICS, FrameMetric};
pub use lane::{LoopFrame, LoopLane, LoopState};
pub use words::LoopVerdict;

/// The traces that come first, with the policies on the stage: noise that makes raw ticks flip between none and two, under
/// the raw loop and the one that heals noise; then a display for which ticks are too few, under the raw loop and the usual
/// remedy.
const OPENING: [(&str, [&str; 2]); 2] =
    [("edge", ["fixed", "whole-refresh"]), ("steady-144", ["fixed", "fixed-linear"])];
/// How much of a trace the opening shows before it goes on, in nanoseconds of the display: long enough to see a judder.
const OPENING_NS: i64 = 1_500_000_000;
/// The most policies on the stage.
pub const MOST_ON_STAGE: usize = 4;
/// How many times slower than real time it can be played; a monitor adds its own judder to what is faster.
pub const SLOWNESS: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// How slow it is at first.
const SLOWNESS_AT_FIRST: u32 = 8;
/// The display of a trace that has none of its own.
const DISPLAY: RefreshRate = RefreshRate::new(60, 1);

/// A change of the loop lab.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopCommand {
    /// Opens it, or leaves it.
    ToggleLab,
    /// Selects the loop at this place of [`POLICIES`], and brings it on the stage.
    Select(usize),
    /// Takes the loop at this place off the stage, or brings it on.
    ToggleOnStage(usize),
    /// Chooses the trace at this place.
    Trace(usize),
    /// Plays this many times slower than real time.
    Slowness(u32),
    /// Goes to this moment of the display, in nanoseconds.
    Seek(i64),
}

/// A body in every loop.
pub struct LoopLab {
    /// With one body.
    scene: Arc<Scene>,
    /// The same at its own tick rate.
    original: Arc<Scene>,
    method: &'static Method,
    /// The body at its start, for how it looks.
    body: LaneBody,
    traces: Vec<FrameTrace>,
    trace: usize,
    lanes: Vec<LoopLane>,
    /// The range of the exact first coordinate.
    range: [f64; 2],
    on_stage: Vec<usize>,
    /// Whether a person chose what is on the stage.
    is_stage_chosen: bool,
    /// Whether it goes on by itself to the second trace of the opening.
    plays_opening: bool,
    /// The place of the metric in [`FRAME_METRICS`].
    metric: usize,
    is_overlaid: bool,
    selected: usize,
    now_ns: i64,
    end_ns: i64,
    slowness: u32,
    /// Whether the run goes on when the loop lab is left.
    pub(super) run_goes_on: bool,
}

impl LoopLab {
    /// The body at this place of a scene under a method, in all loops, at the start.
    pub fn new(scene: &Scene, body: usize, method: &'static Method) -> Self {
        let scene = alone(scene, body);
        let mut cards: Vec<&TraceCard> = TRACES.iter().collect();
        cards.sort_by_key(|card| {
            let first = OPENING.iter().position(|(id, _)| *id == card.id);
            first.unwrap_or(OPENING.len())
        });
        let scene = Arc::new(scene);
        let mut lab = Self {
            body: at_start(&scene),
            original: scene.clone(),
            scene,
            method,
            traces: cards.into_iter().map(|card| card.trace(DISPLAY)).collect(),
            trace: 0,
            lanes: Vec::new(),
            range: [0.0; 2],
            selected: 0,
            on_stage: Vec::new(),
            is_stage_chosen: false,
            plays_opening: false,
            metric: 0,
            is_overlaid: false,
            now_ns: 0,
            end_ns: 0,
            slowness: SLOWNESS_AT_FIRST,
            run_goes_on: true,
        };
        lab.choose_trace(0);
        lab
    }

    /// Goes on by itself to the second trace of the opening, until [`end_opening`](Self::end_opening).
    pub(super) fn play_opening(&mut self) {
        self.plays_opening = true;
    }

    /// Stays with the chosen trace.
    pub(super) fn end_opening(&mut self) {
        self.plays_opening = false;
    }

    /// Shows the body at this place of another scene, from its start.
    pub(super) fn show(&mut self, scene: &Scene, body: usize) {
        self.original = Arc::new(alone(scene, body));
        self.scene = self.original.clone();
        if self.scene.refusal(self.method).is_some() {
            let mut fitting = self.scene.fitting_methods();
            self.method = fitting.next().expect("some methods step every body");
        }
        self.body = at_start(&self.scene);
        self.now_ns = 0;
        self.make();
    }

    /// Makes all frames again.
    fn make(&mut self) {
        let trace = &self.traces[self.trace];
        let lane = |card| LoopLane::new(&self.scene, self.method, card, trace);
        self.lanes = POLICIES.iter().map(lane).collect();
        let ends = self.lanes.iter().filter_map(|lane| Some(lane.frames().last()?.displayed_ns));
        self.end_ns = ends.max().unwrap_or_default();
        self.now_ns = self.now_ns.min(self.end_ns);
        let exact = self.lanes.iter().flat_map(LoopLane::frames).map(|frame| frame.exact[0]);
        self.range = exact.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], q| {
            [least.min(q), most.max(q)]
        });
    }

    /// The scene, with the one body.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// The method of the body.
    pub fn method(&self) -> &'static Method {
        self.method
    }
    /// The body at its start.
    pub fn body(&self) -> &LaneBody {
        &self.body
    }
    /// The least and the greatest value of the exact first coordinate.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }
    /// The traces that can be chosen: the built-in ones, then those that were opened.
    pub fn traces(&self) -> &[FrameTrace] {
        &self.traces
    }
    /// The place of the chosen trace.
    pub fn trace(&self) -> usize {
        self.trace
    }
    /// The body in every loop, in the order of [`POLICIES`].
    pub fn lanes(&self) -> &[LoopLane] {
        &self.lanes
    }
    /// The places of the lanes on the stage, from top to bottom.
    pub fn on_stage(&self) -> &[usize] {
        &self.on_stage
    }
    /// Whether the stage has the lanes over each other, and not below each other.
    pub fn is_overlaid(&self) -> bool {
        self.is_overlaid
    }
    /// The place of the selected lane.
    pub fn selected(&self) -> usize {
        self.selected
    }
    /// The moment of the display, in nanoseconds.
    pub fn now_ns(&self) -> i64 {
        self.now_ns
    }
    /// How far a frame that the display holds now is behind, in milliseconds: at the moment of its display, or now if it
    /// has been held for more than two refreshes.
    pub fn late_ms(&self, frame: &LoopFrame) -> f64 {
        let held_ms = (self.now_ns - frame.displayed_ns) as f64 / 1e6;
        let refresh_ms = 1000.0 / self.traces[self.trace].refresh().hz();
        frame.latency_ms() + if held_ms > 2.0 * refresh_ms { held_ms } else { 0.0 }
    }
    /// The last moment, in nanoseconds.
    pub fn end_ns(&self) -> i64 {
        self.end_ns
    }
    /// How many times slower than real time it is played.
    pub fn slowness(&self) -> u32 {
        self.slowness
    }

    /// The place of the metric that the error instrument shows in [`FRAME_METRICS`].
    pub fn metric(&self) -> usize {
        self.metric
    }

    /// Shows the metric at this place of [`FRAME_METRICS`] in the error instrument.
    pub(super) fn set_metric(&mut self, place: usize) {
        self.metric = place.min(FRAME_METRICS.len() - 1);
    }

    /// Chooses the trace at this place; the moment stays, if the trace reaches it. A trace of the opening brings its
    /// policies on the stage, unless a person chose others.
    pub fn choose_trace(&mut self, place: usize) {
        self.trace = place.min(self.traces.len() - 1);
        let name = self.traces[self.trace].name();
        let opening = OPENING.iter().find(|(id, _)| *id == name && !self.is_stage_chosen);
        if let Some((_, ids)) = opening {
            let place = |id: &&str| POLICIES.iter().position(|card| card.id == *id);
            self.on_stage = ids.iter().filter_map(place).collect();
            self.selected = self.on_stage[0];
        }
        self.make();
    }

    /// Adds a trace to choose from, if there is one.
    pub(super) fn offer(&mut self, trace: Option<FrameTrace>) {
        self.traces.extend(trace);
    }

    /// Adds traces, and chooses the first of them.
    pub fn add_traces(&mut self, traces: Vec<FrameTrace>) {
        let place = self.traces.len();
        self.traces.extend(traces);
        self.choose_trace(place);
    }

    /// Chooses the tick rate, in Hz. The script keeps its times, to the nearest tick.
    pub fn set_tick_hz(&mut self, tick_hz: u32) {
        let mut scene = Scene { tick_hz, ..(*self.original).clone() };
        let [to, from] = [tick_hz, self.original.tick_hz].map(u128::from);
        for row in &mut scene.script {
            let tick = (u128::from(row.tick) * to + from / 2) / from;
            row.tick = u64::try_from(tick).unwrap_or(u64::MAX);
        }
        self.scene = Arc::new(scene);
        self.make();
    }

    /// Chooses the method.
    pub fn set_method(&mut self, method: &'static Method) {
        self.method = method;
        self.make();
    }

    /// Sets how many times slower than real time it is played.
    pub fn set_slowness(&mut self, slowness: u32) {
        self.slowness = slowness.clamp(SLOWNESS[0], SLOWNESS[SLOWNESS.len() - 1]);
    }

    /// Puts the lanes of the stage over each other, or below each other.
    pub(super) fn toggle_overlay(&mut self) {
        self.is_overlaid = !self.is_overlaid;
    }

    /// Selects the lane at this place, and brings it on the stage.
    pub fn select(&mut self, place: usize) {
        if place >= self.lanes.len() {
            return;
        }
        self.selected = place;
        self.is_stage_chosen = true;
        if !self.on_stage.contains(&place) {
            if self.on_stage.len() == MOST_ON_STAGE {
                self.on_stage.remove(0);
            }
            self.on_stage.push(place);
            self.on_stage.sort_unstable();
        }
    }

    /// Takes the lane at this place off the stage, or brings it on; one stays.
    pub fn toggle(&mut self, place: usize) {
        self.is_stage_chosen = true;
        match self.on_stage.iter().position(|&shown| shown == place) {
            Some(_) if self.on_stage.len() == 1 => {}
            Some(shown) => {
                self.on_stage.remove(shown);
                self.selected = self.on_stage[0];
            }
            None => self.select(place),
        }
    }

    /// Goes on by `real_ns` nanoseconds of real time; at the end it begins again. The opening goes on to its next trace.
    pub fn advance(&mut self, real_ns: i64) {
        self.now_ns += real_ns.max(0) / i64::from(self.slowness);
        if self.plays_opening && self.now_ns > OPENING_NS {
            self.plays_opening = self.trace + 2 < OPENING.len();
            self.now_ns = 0;
            self.choose_trace(self.trace + 1);
        }
        if self.now_ns > self.end_ns {
            self.now_ns = 0;
        }
    }

    /// Goes to a moment of the display, in nanoseconds.
    pub fn seek(&mut self, now_ns: i64) {
        self.now_ns = now_ns.clamp(0, self.end_ns);
    }

    /// Goes by so many frames of the selected lane.
    pub fn step(&mut self, frames: i64) {
        let frames_of = self.lanes[self.selected].frames();
        let at = self.lanes[self.selected].frame_at(self.now_ns).unwrap_or_default() as i64;
        let place = (at + frames).clamp(0, frames_of.len().max(1) as i64 - 1);
        if let Some(frame) = frames_of.get(place as usize) {
            self.now_ns = frame.displayed_ns;
        }
    }

    /// The selected policy's card.
    pub fn selected_card(&self) -> &'static PolicyCard {
        self.lanes[self.selected].card()
    }
}

/// A scene with the body at this place alone, and what of the script acts on it.
fn alone(scene: &Scene, body: usize) -> Scene {
    let mut alone = Scene { bodies: vec![scene.bodies[body].clone()], ..scene.clone() };
    alone.script.retain_mut(|row| match &mut row.action {
        Action::Set { body: of, .. } | Action::Place { body: of, .. } => std::mem::take(of) == body,
        _ => true,
    });
    alone
}

/// The one body of a scene at its start.
fn at_start(scene: &Scene) -> LaneBody {
    let body = &scene.bodies[0];
    LaneBody::new(body.kind, &body.values, Solver::Truth)
}

#[cfg(test)]
mod tests;
