//! A person at a run: the studio, with the run and its past, the clock that drives it, and its display. Commands come in;
//! state goes out.
//!
//! A [`Studio`] obeys [`Command`]s, to which [`KEYS`] and [`GESTURES`] lead. What it cannot do itself is a
//! [`DriverRequest`]. What a person looks at is in its [`Viewer`]: the [`Preferences`], which survive the scene, and the
//! [`View`], which does not. [`INSTRUMENTS`] stand beside the stage, and the [`guide`] leads through the scenes.

use crate::loops::loop_lab::LoopLab;
use crate::run::past::Past;
use crate::run::race::{Entrant, Mode, Race};
use crate::run::{
    RecordingError, Run, Session, StartSettings, link, recording_among, recording_text,
};
use crate::scene::{LaneSpec, Scene};
use crate::sim::Clock;

mod ahead;
mod apply;
mod clouding;
mod command;
mod display;
mod driving;
mod file_names;
mod findings;
mod frame_loop;
mod gesture;
pub mod guide;
mod guiding;
mod held;
mod instrument;
mod joint;
mod key;
mod live_loop;
mod looping;
mod my_spring;
mod notice;
mod notices;
mod opening;
mod pace;
mod plotting;
mod restarting;
mod resting;
mod saved_preferences;
mod scene_list;
mod showing;
mod slow_motion;
mod step;
mod viewer;
mod work;
mod zoom_pan;

pub use crate::measure::{Future, FutureMoment, OneStep, Slope};
pub use command::{
    Command, RunCommand, SCALE_LADDER, SPEED_LADDER, StageCommand, TICK_LADDER, ViewCommand,
};
pub use display::{Arrangement, Display, DriverRequest, Motion, Pace, Splits, View};
pub use frame_loop::{FrameLoop, ToDo};
pub use gesture::{GESTURES, Gesture};
pub use held::HeldBody;
pub use instrument::{INSTRUMENTS, Instrument, InstrumentCard, InstrumentGroup};
pub use joint::SpringJoint;
pub use key::{Binding, KEYS, Key, command_for};
pub use live_loop::{LiveFrame, LiveLoop};
use looping::Activity;
pub use my_spring::MySpring;
pub use notice::Notice;
pub use opening::{MANY_LANES, lineup};
pub use pace::PaceMeter;
pub use saved_preferences::SavedPreferences;
pub use scene_list::SceneList;
pub use step::Step;
pub use viewer::{Dialog, Preferences, Viewer};
pub use work::{Asked, Found, Work};
pub use zoom_pan::ZoomPan;

/// A scene being run and looked at.
pub struct Studio {
    scene_list: SceneList,
    run: Run,
    clock: Clock,
    running: bool,
    dropped: u64,
    /// How many scenes were opened, of which a driver leaves the time out that it takes.
    openings: u64,
    /// How often a person has changed the run or its start, and how often of that a file has.
    deeds: u64,
    saved_deeds: u64,
    viewer: Viewer,
    /// What the stage shows.
    activity: Activity,
}

impl Studio {
    /// Opens a scene, running, in solo mode, under the method that [it names](Scene::opening_method), else
    /// under the first of its lanes. The caller decides on
    /// [`Scene::opens_as_race`].
    pub fn new(scene: Scene) -> Self {
        let scene_list = SceneList::of(&scene);
        Self::of_run(scene_list, Run::starting_with(StartSettings::of(scene)))
    }

    /// A person before the start of a run, which is running.
    fn of_run(scene_list: SceneList, run: Run) -> Self {
        Self {
            scene_list,
            clock: Clock::new(run.start().tick_hz()),
            running: true,
            dropped: 0,
            openings: 0,
            deeds: 0,
            saved_deeds: 0,
            viewer: Viewer::new(run.race().entrants()[0].id),
            run,
            activity: Activity::Run,
        }
    }

    /// Goes on with a run, where it is, in its mode.
    pub fn of_session(session: Session) -> Self {
        let tick = session.race().tick();
        let run = Run::new(session.before_its_first_tick());
        let mut studio = Self::of_run(SceneList::of(session.scene()), run);
        (0..tick).for_each(|_| studio.run.tick(&mut ()));
        studio
    }

    /// The open scene with the parameters and the length that a person has set.
    pub fn scene(&self) -> &Scene {
        &self.run.next().scene
    }
    /// The scene as it was opened.
    pub fn scene_as_opened(&self) -> &Scene {
        &self.run.next().opened
    }
    /// The run, its past and its future.
    pub fn run(&self) -> &Run {
        &self.run
    }
    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        self.run.session().race()
    }
    /// The recorded past of the lanes and the truth.
    pub fn past(&self) -> &Past {
        self.run.past()
    }
    /// The methods that digits and rows refer to: those of the [menu](crate::run::past::Menu).
    pub fn entries(&self) -> &[LaneSpec] {
        self.run().menu().specs()
    }
    /// The name of the method with this index on the menu, told apart from others of the same method.
    pub fn lane_name(&self, entry: usize) -> String {
        let spec = &self.entries()[entry];
        spec.distinct_name(spec.method.name, self.entries())
    }
    /// How many methods of the menu a person meets at first: the scene's, and all up to the one that is active.
    pub fn offered(&self) -> usize {
        self.scene().lanes.len().max(self.active() + 1).min(self.entries().len())
    }
    /// Solo or race.
    pub fn mode(&self) -> Mode {
        self.race().mode()
    }
    /// The method in solo mode, or of the selected lane in a race, by its index on the menu.
    pub fn active(&self) -> usize {
        self.entry(self.selected())
    }
    /// The method of a lane, by its index on the menu.
    pub fn entry(&self, entrant: &Entrant) -> usize {
        self.run().menu().entry(entrant.id)
    }
    /// The lane under the method with this index on the menu, if one flies it.
    pub fn flown(&self, entry: usize) -> Option<&Entrant> {
        self.race().entrant(self.run().menu().lane(entry)?)
    }
    /// The lane in solo mode, or the selected lane in a race.
    pub fn selected(&self) -> &Entrant {
        let lanes = self.race().entrants();
        self.race().entrant(self.viewer.selected).unwrap_or(&lanes[0])
    }
    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }
    /// The open loop lab; `None` in solo and in a race.
    pub fn loop_lab(&self) -> Option<&LoopLab> {
        match &self.activity {
            Activity::Run => None,
            Activity::Loops(loops) => Some(loops),
        }
    }
    /// Whether it is not paused.
    pub fn running(&self) -> bool {
        self.running
    }
    /// Whether time runs: it is not paused, and no body is in hand.
    pub fn time_runs(&self) -> bool {
        self.running && self.viewer.held.is_none()
    }
    /// The simulated time in seconds with the owed part of a tick. It advances evenly with real time, while the race
    /// advances by ticks.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race().t() + self.clock.alpha() / f64::from(self.clock.tick_hz())
    }
    /// Ticks dropped since the scene was opened or restarted.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
    /// The scenes that were opened, or read again, in place of others.
    pub fn openings(&self) -> u64 {
        self.openings
    }
    /// What a person looks at.
    pub fn viewer(&self) -> &Viewer {
        &self.viewer
    }
    /// What a person looks at, to be changed by a driver.
    pub fn viewer_mut(&mut self) -> &mut Viewer {
        &mut self.viewer
    }
    /// How the studio is displayed.
    pub fn display(&self) -> &Display {
        &self.viewer.preferences.display
    }
    /// Where a person looks in the scene.
    pub fn view(&self) -> &View {
        &self.viewer.view
    }

    /// Sets the memory in bytes that a run may take to be rewound; see [`Run`].
    pub fn set_rewind_bytes(&mut self, bytes: usize) {
        self.run.set_limit(bytes);
    }

    /// The window's title: people and tests read it.
    pub fn title(&self) -> String {
        if let Activity::Loops(loops) = &self.activity {
            return self.title_of_loops(loops);
        }
        let race = if self.mode() == Mode::Race { "race: " } else { "" };
        let tick = self.race().tick();
        let paused = if self.running { String::new() } else { format!(" (paused, tick {tick})") };
        format!(
            "Regatta - {} - {race}{} - {} Hz{paused}",
            self.scene_name(),
            self.lane_name(self.active()),
            self.clock.tick_hz(),
        )
    }

    /// The run up to the last tick reached, as the text of a scene file.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn recording(&self) -> Result<String, RecordingError> {
        recording_text(&self.run.recording())
    }

    /// The link to the run up to the last tick reached, with the methods that stand beside it.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn link(&self) -> Result<String, RecordingError> {
        let recording = self.run.recording();
        // What no file can hold, no link can.
        recording_text(&recording)?;
        let recording = recording_among(recording, &self.scene().lanes);
        link::to(&recording)
            .map_err(|_| RecordingError::TooLong { bytes: recording.to_toml().len() })
    }
}
