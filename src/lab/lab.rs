//! The lab: a run with its past, the clock that drives it, and how it is looked at. Commands in, state out.

use super::clock::Clock;
use super::display::{Display, Pace};
use super::lane_spec::LaneSpec;
use super::past::{History, Past};
use super::race::{Entrant, Mode, Race};
use super::scene::Scene;
use super::session::{RecordingTooLong, Timeline};
use super::shelf::Shelf;
use super::start::Start;
use super::viewer::Viewer;

mod apply;
mod driving;
mod findings;
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
    /// What comes back with the future that was discarded last.
    before_discard: Option<Kept>,
}

/// What a person had chosen before a future was discarded.
struct Kept {
    start: Start,
    before_equal_cost: Option<Vec<LaneSpec>>,
}

impl Lab {
    /// Opens a scene, running, in solo mode, under the method that [it names](Scene::opening_method), else
    /// under the first of its lanes.
    pub fn new(scene: Scene) -> Self {
        let shelf = Shelf::of(&scene);
        let start = Start::of(scene);
        let timeline = Timeline::new(start.session());
        Self {
            shelf,
            clock: Clock::new(start.tick_hz),
            running: true,
            dropped: 0,
            viewer: Viewer::new(timeline.session().race().entrants()[0].lane_number),
            timeline,
            before_discard: None,
            start,
        }
    }

    /// The scene that is open, with the parameters and the length that a person has set.
    pub fn scene(&self) -> &Scene {
        &self.start.scene
    }
    /// The scene as it was opened.
    pub fn scene_as_opened(&self) -> &Scene {
        &self.start.opened
    }
    /// The run, its past and its future.
    pub fn timeline(&self) -> &Timeline {
        &self.timeline
    }
    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        self.timeline.session().race()
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
        self.selected().entry
    }
    /// The lane flown in solo, the lane selected in a race.
    pub fn selected(&self) -> &Entrant {
        let lanes = self.race().entrants();
        lanes.iter().find(|lane| lane.lane_number == self.viewer.selected).unwrap_or(&lanes[0])
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

    /// The run to the last tick that it reached, as the text of a scene file.
    ///
    /// # Errors
    /// As [`Session::recording_text`](super::Session::recording_text).
    pub fn recording(&self) -> Result<String, RecordingTooLong> {
        self.timeline.session().recording_text(self.timeline.end())
    }
}
