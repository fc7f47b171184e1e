//! The lab: a run with its past, the clock that drives it, and how it is looked at. Commands in, state out.

use std::sync::Arc;

use super::action::Action;
use super::analysis::{Findings, Question, Thinker};
use super::clock::{Clock, Due};
use super::display::{Display, Pace};
use super::lane_spec::LaneSpec;
use super::notices::Notices;
use super::past::{History, Past};
use super::race::{Mode, Race};
use super::scene::Scene;
use super::session::Timeline;
use super::shelf::Shelf;
use super::start::Start;
use super::viewer::Viewer;

mod apply;
mod opening;

/// A scene being run and looked at.
pub struct Lab {
    pub(super) shelf: Shelf,
    pub(super) start: Start,
    pub(super) timeline: Timeline,
    pub(super) clock: Clock,
    pub(super) running: bool,
    pub(super) dropped: u64,
    pub(super) viewer: Viewer,
}

impl Lab {
    /// Opens a scene, running, in solo mode, under the method that [it names](Scene::opening_method), else
    /// under the first of its lanes.
    pub fn new(scene: Scene) -> Self {
        let shelf = Shelf::of(&scene);
        let start = Start::of(scene);
        Self {
            shelf,
            timeline: Timeline::new(start.session()),
            clock: Clock::new(start.tick_hz),
            running: true,
            dropped: 0,
            viewer: Viewer::new(start.entry),
            start,
        }
    }

    /// The scene that is open, with the parameters that a person has set.
    pub fn scene(&self) -> &Scene {
        &self.start.scene
    }
    /// The run, its past and its future.
    pub fn timeline(&self) -> &Timeline {
        &self.timeline
    }
    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        self.timeline.session().lanes()
    }
    /// What is remembered of them.
    pub fn past(&self) -> &Past {
        self.timeline.past()
    }
    /// The methods that digits and lanes refer to: the scene's lanes, which race, then all others.
    pub fn entries(&self) -> &[LaneSpec] {
        self.race().list()
    }
    /// Solo or race.
    pub fn mode(&self) -> Mode {
        self.race().mode()
    }
    /// The method flown in solo, the lane selected in a race, by its place on the list.
    pub fn active(&self) -> usize {
        match self.mode() {
            Mode::Solo => self.race().entrants()[0].entry,
            Mode::Race => self.viewer.selected,
        }
    }
    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }
    /// Whether it is not paused.
    pub fn running(&self) -> bool {
        self.running
    }
    /// Whether time runs: it is not paused, and no body is in hand.
    pub fn time_runs(&self) -> bool {
        self.running && self.viewer.held.is_none()
    }
    /// The simulated time in seconds with the part of a tick that is owed: it goes evenly with real time, while
    /// the race goes on tick by tick.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race().t() + self.clock.alpha() / f64::from(self.clock.tick_hz())
    }
    /// Ticks given up since the scene was opened or restarted.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
    /// What a person looks at and reads.
    pub fn viewer(&self) -> &Viewer {
        &self.viewer
    }
    /// How the lab is looked at.
    pub fn display(&self) -> &Display {
        &self.viewer.display
    }
    /// Whether any body takes an input, by its name on the body's [card](crate::sim::bodies::Kind).
    pub fn takes(&self, input: &str) -> bool {
        self.scene().bodies.iter().any(|body| body.kind.inputs.contains(&input))
    }
    /// The history of the displayed body in each lane, with the lane's place on the list.
    pub fn plotted(&self) -> impl Iterator<Item = (usize, &History)> {
        let body = self.display().body;
        let entries = self.race().entrants().iter().map(|entrant| entrant.entry);
        entries.enumerate().map(move |(place, entry)| (entry, &self.past().histories(place)[body]))
    }

    /// Says how the bodies move when nothing is to fade or glide.
    pub fn set_motion(&mut self, motion: bool) {
        self.viewer.display.motion = motion;
    }
    /// Tells the lab how fast its driver goes.
    pub fn set_pace(&mut self, pace: Pace) {
        self.viewer.pace = Some(pace);
    }
    /// Gives people something to read.
    pub fn set_notice(&mut self, notice: impl Into<String>) {
        self.viewer.notice = Some(notice.into());
    }

    /// The window's title: people and tests read it.
    pub fn title(&self) -> String {
        let race = if self.mode() == Mode::Race { "race: " } else { "" };
        let tick = self.race().tick();
        let paused = if self.running { String::new() } else { format!(" (paused, tick {tick})") };
        format!(
            "Regatta - {} - {race}{} - {} Hz{paused}",
            self.scene_name(),
            self.entries()[self.active()].method.name,
            self.clock.tick_hz(),
        )
    }

    /// What there is to be found out: a verdict on each method of the list at the present tick rate and
    /// throttle, and advice while it is shown. For a [`Thinker`].
    pub fn question(&self) -> Question {
        Question {
            scene: Arc::clone(&self.start.scene),
            entries: self.entries().to_vec(),
            tick_hz: self.clock.tick_hz(),
            throttle: self.race().throttle(),
            advice: self.display().instrument == super::Instrument::Advice,
        }
    }

    /// Takes in what was found out, unless it is of another scene.
    pub fn learn(&mut self, findings: Findings) {
        if findings.question.is_of(&self.start.scene) {
            self.viewer.findings = Some(findings);
        }
    }

    /// Finds out here and now whatever there is to be.
    pub fn think(&mut self) {
        let question = self.question();
        let known = &self.viewer.findings;
        if !known.as_ref().is_some_and(|known| known.answer(&question)) {
            self.learn(Thinker::new(question).finish());
        }
    }

    /// Takes in a frame of `frame_ns` nanoseconds of real time, and steps what is due.
    pub fn advance(&mut self, frame_ns: i64) -> Due {
        self.advance_seen(frame_ns, |_| ())
    }

    /// As [`Lab::advance`], and shows itself to `after_tick` after every tick.
    pub fn advance_seen(&mut self, frame_ns: i64, mut after_tick: impl FnMut(&Lab)) -> Due {
        if !self.time_runs() {
            return Due::default();
        }
        // A tick rate that the script sets at this tick is that of the time from here on.
        let ((), told) = self.watched(|timeline, notices| timeline.catch_up(notices));
        self.tell(told);
        let due = self.clock.advance(frame_ns);
        for _ in 0..due.ticks {
            self.tick();
            after_tick(self);
        }
        if due.ticks > 0 {
            self.timeline.show_present();
        }
        self.dropped += due.dropped;
        due
    }

    /// Does what there is to be done at this tick, and steps to the next.
    pub fn tick(&mut self) {
        let ((), told) = self.watched(|timeline, notices| timeline.tick_seen(notices));
        self.tell(told);
    }

    fn tell(&mut self, told: Option<String>) {
        if told.is_some() {
            self.viewer.notice = told;
        }
    }

    /// Has something done to the run, and returns with it what there is to tell of it.
    fn watched<T>(
        &mut self,
        change: impl FnOnce(&mut Timeline, &mut Notices<'_>) -> T,
    ) -> (T, Option<String>) {
        let mut notices = Notices::new(&self.start.scene);
        let done = self.timeline.session().lanes().done();
        let changed = change(&mut self.timeline, &mut notices);
        let told = notices.told;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.select_as_scripted(done);
        (changed, told)
    }

    /// Selects the lane of the method that the script has named since `done` rows of the journal were done: in a race
    /// that is all that it does.
    fn select_as_scripted(&mut self, done: usize) {
        let race = self.timeline.session().lanes();
        if race.mode() == Mode::Solo || race.done() <= done {
            return;
        }
        for row in &race.journal().rows()[done..race.done()] {
            let Action::Method(method) = row.action else { continue };
            let lane = race.entrants().iter().find(|e| race.list()[e.entry].method == method);
            if let Some(lane) = lane {
                self.viewer.selected = lane.entry;
            }
        }
    }
}
