//! A person's control of a run: the studio, with the run and its past, its clock, and its display. Commands go in, and
//! state comes out.
//!
//! A [`Studio`] executes [`Command`]s, which come from [`KEYS`] and [`GESTURES`]. It passes anything that it cannot do
//! itself to the driver, as a [`DriverRequest`]. Its [`Viewer`] has the [`Preferences`], which outlast the scene, and
//! the [`View`], which does not. [`INSTRUMENTS`] surround the stage, and the [`guide`] leads through the scenes.
//!
//! `apply.rs` passes each command on. Functions that execute one take the whole [`Studio`]:
//!
//! | Command | File |
//! |---|---|
//! | [`RunCommand`], [`StageCommand`] | `dispatch.rs`, for a run and for the loop lab |
//! | – actions, methods, lanes, ticks, seeking, equal cost | `acting.rs` |
//! | – bands | `bands.rs` |
//! | – restart, undo, redo, plotted coordinates | `restarting.rs` |
//! | – scenes, files, a described spring | `opening.rs` |
//! | – watching a blow-up again | `resting.rs` |
//! | [`LoopCommand`](crate::loops::loop_lab::LoopCommand), and a stage command in the loop lab | `looping.rs` |
//! | [`ViewCommand`] | `apply.rs` |
//! | – stops of the guide | `guiding.rs` |
//! | – a person's lines, the book's figures | `my_lines.rs`, `book_figure.rs` |
//! | – Escape | `escaping.rs` |
//! | [`DriverRequest`] | the driver |
//!
//! Time itself passes in `driving.rs`, a pulled body is pushed in `pulling.rs`, and findings come back in `findings.rs`
//! and `clouding.rs`.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_look as look;
use regatta_loops as loops;
use regatta_measure as measure;
use regatta_run as run;
use regatta_scene as scene;
use regatta_sim as sim;
use regatta_tools as tools;

use crate::loops::Due;
use crate::loops::loop_lab::LoopLab;
use crate::measure::AnalysisWorker;
use crate::run::past::Past;
use crate::run::race::{Entrant, Mode, Observer, Race};
use crate::run::{MenuIndex, Run, Session, StartSettings};
use crate::scene::{LaneSpec, Scene};
use crate::sim::Clock;
use crate::sim::integrators::Method;
use clouding::{free_unshown_cloud, wait_for_cloud};
use driving::{advance, make_tick};
use looping::{OpenLab, title_of_loops};

mod acting;
mod ahead;
mod apply;
mod bands;
mod book_figure;
mod clouding;
mod command;
mod compared;
mod deck;
mod dispatch;
mod display;
mod driving;
mod escaping;
mod file_names;
mod findings;
mod frame_loop;
mod gesture;
pub mod guide;
mod guiding;
mod instrument;
mod joint;
mod key;
mod looping;
mod my_lines;
mod my_spring;
mod notice;
mod notices;
mod opening;
mod pace;
pub mod picture_note;
mod pulling;
mod restarting;
mod resting;
mod run_before;
mod run_beside;
mod saved_preferences;
mod scene_list;
mod spring_field;
mod step;
mod step_response;
mod viewer;
mod work;
mod zoom_pan;

pub use crate::measure::{FutureCurve, FutureMoment, OneStep, Slope};
pub use crate::tools::source_code::bare_lines;
pub use ahead::{
    exact_future, future_of_lane, futures, one_step, orbit, shows_futures, without_futures,
};
pub use book_figure::{BOOK_FIGURES, BookFigure};
pub use clouding::{accept_cloud, cloud_refusal, cloud_request, complete_clouds, shown_cloud};
pub use command::{
    Command, RunCommand, SCALE_LADDER, SPEED_LADDER, StageCommand, TICK_LADDER, ViewCommand,
};
pub use compared::Compared;
pub use deck::{Deck, HeldBody, PulledBody};
pub use display::{Arrangement, Display, DriverRequest, Motion, Pace, Splits, View};
pub use driving::{pace_in_words, shown_s, shown_state, shown_tick, shown_truth, slowed_in_words};
pub use file_names::{instrument_file_name, picture_file_name};
pub use findings::{
    accept_findings, analyse_bounded, mappable_parameters, mapped_parameter, unanswered_request,
};
pub use frame_loop::{FrameLoop, ToDo};
pub use gesture::{GESTURES, Gesture};
pub use instrument::{INSTRUMENTS, Instrument, InstrumentCard, InstrumentGroup};
pub use joint::{SpringJoint, joint_code};
pub use key::mark_of;
pub use key::{Binding, DIGITS, KEYS, Key, command_for, commands_named, digit_of};
pub use looping::{
    accept_loop, loop_lab_refusal, loop_request, open_loop_lab_on, open_own_loop, open_traces,
    read_own_loop, run_loops, runs_beside,
};
pub use my_spring::MySpring;
pub use notice::Notice;
pub use opening::{
    MANY_LANES, described_spring, file_is_back, file_is_gone, lineup, list_as_file,
    open_advised_spring, open_file, race_own_method, races_own_method, refuse_typed_path,
    reload_failed, reload_file, reload_own_method, show_clouds_of_scene, show_comparison,
    show_mistakes,
};
pub use pace::{LiveFrame, LiveLoop, PaceMeter};
pub use run_before::RunBefore;
pub use run_beside::RunBeside;
pub use saved_preferences::SavedPreferences;
pub use scene_list::SceneList;
pub use spring_field::SpringField;
pub use step::Step;
pub use step_response::{StepResponse, StepResponses};
pub use viewer::{Dialog, Preferences, ReadLines, Viewer};
pub use work::{CurrentRequest, Found, Work};
pub use zoom_pan::ZoomPan;

/// A running scene with its display.
pub struct Studio {
    /// The run, its clock and the selected lane.
    pub deck: Deck,
    /// The person's view, and the texts beside it.
    pub viewer: Viewer,
    /// The loop lab, while the stage shows it and the run waits.
    loops: Option<OpenLab>,
}

impl Studio {
    /// Opens a scene in solo mode, without a pause. The method is the scene's [opening method](Scene::opening_method),
    /// or else that of its first lane. The caller decides whether to follow [`Scene::opens_as_race`].
    pub fn new(scene: Scene) -> Self {
        Self::starting_with(StartSettings::of(scene))
    }

    /// Opens a scene at tick 0 as the options ask, under the method `selected`, or else under the scene's opening
    /// method. In a race without `selected`, the verdicts select a lane. A scene with a single lane opens solo.
    pub fn opened(scene: Scene, selected: Option<&'static Method>, mode: Mode) -> Self {
        let method = selected.unwrap_or_else(|| scene.opening_lane().method);
        let mut next = StartSettings::of(scene);
        let listed = next.list.iter().position(|spec| spec.method == method);
        next.entry = listed.unwrap_or(next.entry);
        if next.scene.lanes.len() > 1 {
            next.mode = mode;
        }
        let mut studio = Self::starting_with(next);
        if studio.mode() == Mode::Race {
            studio.viewer.preferences.choose_mode(Mode::Race, studio.deck.scene());
        }
        studio.deck.select_entry_of_start();
        studio.deck.is_selected = listed.is_some() && (mode == Mode::Solo || selected.is_some());
        studio
    }

    fn starting_with(next: StartSettings) -> Self {
        let scene_list = SceneList::of(&next.opened);
        let mut studio = Self::of_deck(Deck::new(scene_list, Run::starting_with(next)));
        // Only the stage alone has bands.
        studio.viewer.preferences.display.measure &= !studio.scene().opens_in_bands;
        studio
    }

    fn of_deck(deck: Deck) -> Self {
        Self { deck, viewer: Viewer::default(), loops: None }
    }

    /// Continues a session at its present tick and in its mode.
    pub fn of_session(session: Session) -> Self {
        let tick = session.race().tick();
        let scene_list = SceneList::of(session.scene());
        let mut run = Run::new(session.before_its_first_tick());
        (0..tick).for_each(|_| run.tick(&mut ()));
        Self::of_deck(Deck::new(scene_list, run))
    }

    /// Returns the open scene, with the person's parameters and length.
    pub fn scene(&self) -> &Scene {
        self.deck.scene()
    }
    /// Returns the run with its past and its future.
    pub fn run(&self) -> &Run {
        self.deck.run()
    }
    /// Returns the lanes and the truth.
    pub fn race(&self) -> &Race {
        self.deck.race()
    }
    /// Returns the recorded past of the lanes and the truth.
    pub fn past(&self) -> &Past {
        self.deck.past()
    }
    /// Returns the methods of the [menu](crate::run::Menu). Digits and rows of the table refer to them.
    pub fn entries(&self) -> &[LaneSpec] {
        self.deck.entries()
    }
    /// Returns the menu index of a lane's method.
    pub fn entry(&self, entrant: &Entrant) -> MenuIndex {
        self.deck.entry(entrant)
    }
    /// Returns the name of the method with this menu index. If another entry has the same method, the name includes the
    /// settings.
    pub fn lane_name(&self, entry: MenuIndex) -> String {
        self.deck.lane_name(entry)
    }
    /// Returns whether the run is solo or a race.
    pub fn mode(&self) -> Mode {
        self.deck.mode()
    }
    /// Returns the menu index of the method in solo mode, or of the selected lane's method in a race.
    pub fn active(&self) -> MenuIndex {
        self.deck.active()
    }
    /// Returns the only lane in solo mode, or the selected lane of a race.
    pub fn selected(&self) -> &Entrant {
        self.deck.selected()
    }
    /// Returns the clock.
    pub fn clock(&self) -> &Clock {
        self.deck.clock()
    }
    /// Whether the run is not paused.
    pub fn running(&self) -> bool {
        self.deck.running()
    }
    /// Returns the display settings.
    pub fn display(&self) -> &Display {
        self.viewer.display()
    }
    /// Returns the person's view of the scene.
    pub fn view(&self) -> &View {
        &self.viewer.view
    }
    /// Returns the open loop lab, or `None` while the stage shows a run.
    pub fn loop_lab(&self) -> Option<&LoopLab> {
        self.loops.as_ref().map(|open| &*open.lab)
    }

    fn loop_lab_mut(&mut self) -> Option<&mut LoopLab> {
        self.loops.as_mut().map(|open| &mut *open.lab)
    }

    /// Returns the title of the window, which people and tests read.
    pub fn title(&self) -> String {
        if let Some(loops) = self.loop_lab() {
            return title_of_loops(&self.deck, loops);
        }
        let race = if self.mode() == Mode::Race { "race: " } else { "" };
        let tick = self.race().tick();
        let paused = if self.running() { String::new() } else { format!(" (paused, tick {tick})") };
        format!(
            "Regatta - {} - {race}{} - {:.3} Hz{paused}",
            self.deck.scene_name(),
            self.lane_name(self.active()),
            self.clock().tick_hz(),
        )
    }

    /// Performs the actions at this tick, and steps to the next tick.
    pub fn tick(&mut self) {
        make_tick(self, &mut ());
        self.deck.follow_with_compared(self.deck.race().t());
    }

    /// Adds a frame of `frame_ns` nanoseconds of real time, and makes the ticks that are due.
    pub fn advance(&mut self, frame_ns: i64) -> Due {
        self.advance_in_time(u64::MAX, frame_ns, &mut || true, &mut ())
    }

    /// Like [`Studio::advance`], but stops at the tick `last`, and notifies an observer. Calls `is_time_left` after
    /// each tick, and drops the remaining ticks if it returns `false`.
    pub fn advance_in_time(
        &mut self,
        last: u64,
        frame_ns: i64,
        is_time_left: &mut dyn FnMut() -> bool,
        observer: &mut dyn Observer,
    ) -> Due {
        free_unshown_cloud(self);
        let waits_for_cloud = wait_for_cloud(self, frame_ns);
        if !self.deck.time_runs() {
            self.viewer.live.jump();
            return Due::default();
        }
        self.viewer.pass_time(frame_ns);
        if let Some(loops) = self.loop_lab_mut() {
            loops.advance(frame_ns);
            return Due::default();
        }
        if waits_for_cloud {
            return Due::default();
        }
        advance(self, last, frame_ns, is_time_left, observer)
    }

    /// Computes all requested verdicts and advice at once.
    pub fn analyse(&mut self) {
        if let Some(request) = unanswered_request(self) {
            let findings = AnalysisWorker::new(request).finish();
            accept_findings(self, findings);
        }
    }

    /// Accepts a result, if the studio still needs it.
    pub fn accept(&mut self, found: Found) {
        match found {
            Found::Analysed(findings) => {
                accept_findings(self, *findings);
            }
            Found::LoopRun(found) => accept_loop(self, *found),
            Found::Clouds(found) => accept_cloud(self, *found),
        }
    }
}
