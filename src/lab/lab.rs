//! The lab: a run with its past, the clock that drives it, and how it is looked at. Commands in, state out.

use std::sync::Arc;

use super::action::Action;
use super::analysis::{Findings, Question, Thinker};
use super::clock::{Clock, Due};
use super::display::{Display, Pace};
use super::journal::{JournalRow, Source};
use super::lane_spec::LaneSpec;
use super::notices::Notices;
use super::past::{History, Past};
use super::race::{Entrant, Mode, Observer, Race};
use super::scene::Scene;
use super::session::{RecordingTooLong, Timeline};
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
        let timeline = Timeline::new(start.session());
        Self {
            shelf,
            clock: Clock::new(start.tick_hz),
            running: true,
            dropped: 0,
            viewer: Viewer::new(timeline.session().lanes().entrants()[0].lane_number),
            timeline,
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

    /// What there is to be found out: a verdict on each method of the list at the present tick rate and
    /// throttle, and advice while it is shown. For a [`Thinker`].
    pub fn question(&self) -> Question {
        Question {
            scene: Arc::clone(&self.start.scene),
            entries: self.entries().to_vec(),
            tick_hz: self.clock.tick_hz(),
            throttle: self.throttle_by_hand(),
            advice: self.display().instrument == super::Instrument::Advice,
        }
    }

    /// The throttle that a person has set since the start, or else that of the start: what the script sets is in the
    /// scene that is judged.
    fn throttle_by_hand(&self) -> f64 {
        let race = self.race();
        let done = race.journal().rows()[..race.done()].iter();
        let set = done.filter(|row| row.source == Source::Hand).rev();
        let throttle = |row: &JournalRow| match row.action {
            Action::Throttle(part) => Some(part.clamp(-1.0, 1.0)),
            _ => None,
        };
        set.into_iter().find_map(throttle).unwrap_or(1.0)
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
        self.advance_seen(frame_ns, &mut ())
    }

    /// As [`Lab::advance`], and stops at tick `last`.
    pub fn advance_to(&mut self, last: u64, frame_ns: i64) -> Due {
        self.advance_by(frame_ns, last, &mut ())
    }

    /// As [`Lab::advance`], before the eyes of an observer.
    pub fn advance_seen(&mut self, frame_ns: i64, observer: &mut impl Observer) -> Due {
        self.advance_by(frame_ns, u64::MAX, observer)
    }

    fn advance_by(&mut self, frame_ns: i64, last: u64, observer: &mut impl Observer) -> Due {
        if !self.time_runs() {
            return Due::default();
        }
        // A tick rate that the script sets at this tick is that of the time from here on.
        let ((), told) =
            self.watched(|timeline, notices| timeline.catch_up(&mut (notices, &mut *observer)));
        self.tell(told);
        let due = self.clock.advance(frame_ns);
        for _ in 0..due.ticks {
            if self.race().tick() >= last {
                break;
            }
            self.tick_seen(observer);
        }
        if due.ticks > 0 {
            self.timeline.show_present();
        }
        self.dropped += due.dropped;
        due
    }

    /// Does what there is to be done at this tick, and steps to the next.
    pub fn tick(&mut self) {
        self.tick_seen(&mut ());
    }

    /// As [`Lab::tick`], before the eyes of an observer.
    pub fn tick_seen(&mut self, observer: &mut impl Observer) {
        let ((), told) =
            self.watched(|timeline, notices| timeline.tick_seen(&mut (notices, observer)));
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
                self.viewer.selected = lane.lane_number;
            }
        }
    }
}
