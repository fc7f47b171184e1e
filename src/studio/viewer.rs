//! A person's view of a run. It is not part of the run and never changes it.

use super::command::{
    Command, RunCommand, SCALE_LADDER, StageCommand, USUAL_SCALE_PERCENT, ViewCommand,
};
use super::deck::{Deck, LeftRun};
use super::display::{Arrangement, Display, Motion, Pace, Splits, View};
use super::guide::{Hints, Tour};
use super::instrument::Instrument;
use super::my_spring::MySpring;
use super::notice::Notice;
use super::pace::LiveLoop;
use crate::look::palette::Theme;
use crate::measure::cloud::{CloudChoice, FoundCloud};
use crate::measure::{Advice, Findings, StabilityMap, Verdict};
use crate::run::MenuIndex;
use crate::run::race::{Interpolation, Mode};
use crate::scene::{LaneSpec, Scene, ShownError};
use crate::sim::TickRate;
use crate::tools::source_code::Language;

/// The lines of a person who has typed none yet.
pub(super) const EXAMPLE: &str = "v = (v + (target - x) * 0.2) * 0.85\nx += v\n";

/// A reading of a person's own lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadLines {
    /// The faults of the lines, as the command line would print them.
    pub report: Vec<ShownError>,
    /// Code that moves like the rule at any frame rate, in the language of the last copy, or `None` for a method.
    pub code: Option<String>,
}

/// A dialog over the window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// The numbers of a custom spring.
    Spring {
        /// Tick rate of the spring, in Hz.
        tick_hz: TickRate,
    },
    /// A field for the path of a scene file.
    Path {
        /// Whether the file is a recording to compare with the run.
        compares: bool,
        /// Why the scene at the typed path could not be opened, or `None` once the path has been edited.
        refused: Option<Vec<ShownError>>,
    },
    /// A field for a person's own lines.
    Lines(ReadLines),
    /// The list of the chapter's figures, which digits open.
    Figures,
    /// The errors of a scene file.
    Mistakes {
        /// Name of the file.
        file: String,
        /// The errors.
        report: Vec<ShownError>,
    },
}

impl Dialog {
    pub(super) fn path(compares: bool) -> Self {
        Self::Path { compares, refused: None }
    }
}

/// A person's choices that outlast the scene.
#[derive(Clone, Debug)]
pub struct Preferences {
    /// The display settings.
    pub display: Display,
    /// The mode for all scenes, if a person has chosen one that differs from the scene's.
    pub(super) mode: Option<Mode>,
    /// Whether a person has chosen the theme. If so, it no longer follows the system's theme.
    pub(super) theme_is_chosen: bool,
    /// Language of the next copied method.
    pub(super) language: Language,
    pub(super) typed_path: String,
    pub(super) my_spring: MySpring,
    /// Text of the dialog of a person's own lines.
    pub my_lines: String,
    /// Index of the stop at which the guide was last closed.
    pub(super) left_at: usize,
    /// Whether the driver keeps a recording of the run. If so, nothing is lost when the program ends.
    pub is_recorded: bool,
    /// Whether the driver's window fills the screen.
    pub is_full_screen: bool,
    /// Whether the driver is a page in a browser. A browser keeps some keys for itself, and a page cannot quit.
    pub is_page: bool,
}

impl Preferences {
    /// Shows the theme of the system, unless a person has chosen a theme.
    pub fn follow_theme(&mut self, theme: Theme) {
        if !self.theme_is_chosen {
            self.display.theme = theme;
        }
    }

    /// Shows this theme instead of the system's theme.
    pub fn choose_theme(&mut self, theme: Theme) {
        self.theme_is_chosen = true;
        self.display.theme = theme;
    }

    /// Returns the theme that a person has chosen, or `None` while the theme follows the system's.
    pub fn chosen_theme(&self) -> Option<Theme> {
        self.theme_is_chosen.then_some(self.display.theme)
    }

    /// Opens later scenes in this mode, unless it is the mode in which this scene opens anyway.
    pub(super) fn choose_mode(&mut self, mode: Mode, scene: &Scene) {
        self.mode = (mode != Mode::opening(scene)).then_some(mode);
    }

    /// Shows type and panels at this size in percent, within the bounds of [`SCALE_LADDER`].
    pub fn choose_scale(&mut self, percent: u32) {
        let [least, .., most] = SCALE_LADDER;
        self.display.scale_percent = percent.clamp(least, most);
    }
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            display: Display {
                measure: true,
                splits: Splits::default(),
                futures: false,
                ghost: true,
                frame_rate: false,
                interpolation: Interpolation::default(),
                instrument: Instrument::Motion,
                quantity: None,
                enlarged: false,
                metric: 0,
                advises_on_one_body: true,
                cloud: CloudChoice::default(),
                arrangement: Arrangement::Overlay,
                theme: Theme::Dark,
                scale_percent: USUAL_SCALE_PERCENT,
                help: false,
                inspector: false,
                motion: Motion::Recorded,
            },
            mode: None,
            theme_is_chosen: false,
            language: Language::default(),
            typed_path: String::new(),
            my_spring: MySpring::default(),
            my_lines: EXAMPLE.to_owned(),
            left_at: 0,
            is_recorded: false,
            is_full_screen: false,
            is_page: false,
        }
    }
}

/// The display of a run for a person, and the texts beside it.
#[derive(Clone, Debug, Default)]
pub struct Viewer {
    /// The person's choices that outlast the scene.
    pub preferences: Preferences,
    /// The person's view of the scene.
    pub view: View,
    /// Menu index of the lane under the pointer or the keyboard's focus.
    pub(super) pointed: Option<MenuIndex>,
    /// The driver's pace while time runs, or `None` if there is no real time, as in a capture.
    pub pace: Option<Pace>,
    /// Recent mean time (ms) that the driver works on a frame, or `None` if there is no real time.
    pub frame_ms: Option<f64>,
    /// Duration (ns) of each lane's tick, as last measured by the driver, or `None` for a lane that halted.
    pub tick_times: Vec<(LaneSpec, Option<f64>)>,
    /// The latest message, while it is shown.
    pub notice: Option<Notice>,
    /// The question before the program quits, while it is on the stage.
    pub(super) quit_question: Option<Notice>,
    /// The last frames of the studio's own loop.
    pub live: LiveLoop,
    pub(super) findings: Option<Findings>,
    /// Time for which the clouds of the scene have stayed at their start, in nanoseconds. It is negative while they are
    /// not yet computed.
    pub(super) start_shown_ns: i64,
    /// The latest accepted clouds.
    pub(super) cloud: Option<FoundCloud>,
    /// Tick rate (Hz) at the moment when the pointer's button went down, while the button is down.
    pub(super) hz_at_press: Option<TickRate>,
    /// Remaining time for which the stage shows futures after a key has changed the tick rate, in nanoseconds.
    pub(super) futures_left_ns: i64,
    /// Whether no frame has shown those futures yet.
    pub(super) futures_are_new: bool,
    pub(super) dialog: Option<Dialog>,
    pub(super) hints: Hints,
    /// Hints for the run that the person left for the guide.
    pub(super) hints_of_left: Hints,
    /// The person's progress in the guide, if it is open.
    pub(super) tour: Option<Tour>,
}

impl Viewer {
    /// Returns the viewer for another scene. The preferences and an open guide stay.
    pub(super) fn before_next_scene(&mut self) -> Self {
        Self {
            preferences: self.preferences.clone(),
            pace: self.pace,
            frame_ms: self.frame_ms,
            hints: self.hints.of_next_scene(),
            hints_of_left: self.hints_of_left.clone(),
            tour: self.tour.take(),
            ..Self::default()
        }
    }

    /// Returns the display settings.
    pub fn display(&self) -> &Display {
        &self.preferences.display
    }

    /// Returns the amount of motion on the stage besides that of the bodies.
    pub(super) fn motion(&self) -> Motion {
        self.preferences.display.motion
    }

    /// Returns the menu index of the lane under the pointer or the keyboard's focus, if there is one.
    pub fn pointed_lane(&self) -> Option<MenuIndex> {
        self.pointed
    }

    /// Whether the pointer's button is down, according to the last
    /// [`ViewCommand::PointerDown`](super::ViewCommand::PointerDown).
    pub fn pointer_is_down(&self) -> bool {
        self.hz_at_press.is_some()
    }

    /// Returns the language of the next copied method. It is the last one used or chosen, or Rust at first.
    pub fn language(&self) -> Language {
        self.preferences.language
    }

    /// Returns the open dialog, if there is one.
    pub fn dialog(&self) -> Option<&Dialog> {
        self.dialog.as_ref()
    }

    /// Returns the person's progress in the guide, if it is open.
    pub fn tour(&self) -> Option<&Tour> {
        self.tour.as_ref()
    }

    /// Returns the path typed so far.
    pub fn typed_path(&self) -> &str {
        &self.preferences.typed_path
    }

    /// Returns the spring that was last described in the dialog.
    pub fn my_spring(&self) -> MySpring {
        self.preferences.my_spring
    }

    /// Returns the lines that were last typed in their dialog.
    pub fn my_lines(&self) -> &str {
        &self.preferences.my_lines
    }

    /// Whether a stop of the guide waits for a prediction. Until then, nothing on the screen may give away the answer.
    pub fn is_asked(&self) -> bool {
        self.tour.as_ref().is_some_and(Tour::is_asking)
    }

    /// Returns the verdict on the method with this menu index, for the run that
    /// [`Studio::analysis_request`](super::Studio::analysis_request) describes. Returns `None` until the verdict is
    /// [found](super::accept_findings), and while a person is [asked](Self::is_asked).
    pub fn verdict(&self, entry: MenuIndex) -> Option<&Verdict> {
        self.judged(entry).filter(|_| !self.is_asked())
    }

    /// Like [`verdict`](Self::verdict), if it begins at the last change of the run. An earlier one says nothing about
    /// what follows.
    pub fn verdict_from_here(&self, deck: &Deck, entry: MenuIndex) -> Option<&Verdict> {
        let starts_at_s = deck.run().checkpoints().verdicts_start_at_s();
        self.verdict(entry).filter(|verdict| verdict.starts_at_s == starts_at_s)
    }

    /// Whether the verdict on the method with this menu index is of the run as it is now. After a change of the rate,
    /// a verdict at the old rate stays until the next one is found.
    pub fn is_judged_now(&self, deck: &Deck, entry: MenuIndex) -> bool {
        let found = self.findings.as_ref();
        found.is_some_and(|Findings { request, judged, .. }| {
            request.tick_hz == deck.clock().tick_hz()
                && request.by_hand.are_last(deck.run().checkpoints())
                && entry < *judged
        })
    }

    /// Returns the same as [`verdict`](Self::verdict), but also while a person is asked for a prediction.
    pub(super) fn judged(&self, entry: MenuIndex) -> Option<&Verdict> {
        self.findings.as_ref()?.verdicts.get(entry)?.as_ref()
    }

    /// Whether the typed path is that of a recording to compare with the run.
    pub fn compares_typed_path(&self) -> bool {
        matches!(self.dialog, Some(Dialog::Path { compares: true, .. }))
    }

    /// Returns the advice on this scene that was [found](super::accept_findings) so far, or `None` while the advice is
    /// not shown.
    pub fn advice(&self) -> Option<&Advice> {
        self.findings.as_ref()?.advice.as_ref()
    }

    /// Returns the stability map that was [found](super::accept_findings) so far, or `None` while the map is not shown.
    pub fn stability_map(&self) -> Option<&StabilityMap> {
        self.findings.as_ref()?.map.as_ref()
    }

    /// Returns the question whether to quit, while it is shown. Its parts are lines, with keys between backticks.
    pub fn quit_question(&self) -> Option<&Notice> {
        self.quit_question.as_ref()
    }

    /// Shows a message for some seconds.
    pub fn set_notice(&mut self, notice: impl Into<Notice>) {
        self.notice = Some(notice.into());
    }

    /// Lets `ns` nanoseconds of real time pass, and removes a notice and a question whose time is over.
    pub fn pass_time(&mut self, ns: i64) {
        // The time before a key is not that of its futures.
        if !std::mem::take(&mut self.futures_are_new) {
            self.futures_left_ns = self.futures_left_ns.saturating_sub(ns).max(0);
        }
        for shown in [&mut self.notice, &mut self.quit_question] {
            if let Some(notice) = shown {
                notice.pass_time(ns);
            }
            shown.take_if(|notice| notice.left_ns() == 0);
        }
    }

    /// Switches to the next interpolation between ticks, and shows the name of that interpolation.
    pub(super) fn next_interpolation(&mut self) {
        self.preferences.display.interpolation = self.preferences.display.interpolation.next();
        let name = self.preferences.display.interpolation.name();
        self.set_notice(format!("drawing between ticks: {name}"));
    }

    /// Shows type and panels at this size, with a notice.
    pub(super) fn show_scale(&mut self, percent: u32) {
        self.preferences.display.scale_percent = percent;
        self.set_notice(format!("text and panels at {percent} %"));
    }

    /// Shows the lanes of a race in the other arrangement, with a notice.
    pub(super) fn toggle_arrangement(&mut self) {
        let (arrangement, told) = match self.preferences.display.arrangement {
            Arrangement::Overlay => (Arrangement::SideBySide, "lanes side by side"),
            Arrangement::SideBySide => (Arrangement::Overlay, "lanes over each other"),
        };
        self.preferences.display.arrangement = arrangement;
        self.set_notice(told);
    }

    /// Shows the hints from the first one again.
    pub fn begin_hints(&mut self) {
        self.hints = Hints::default();
    }

    /// Closes the guide, because its scene is no longer shown, and restores the choices made before it. The instrument
    /// stays, because it is visible.
    pub(super) fn leave_guide(&mut self, left: Option<&LeftRun>) {
        if let Some(LeftRun { display: before, .. }) = left {
            let display = &mut self.preferences.display;
            display.quantity = before.quantity;
            display.metric = before.metric;
            display.interpolation = before.interpolation;
        }
        if self.close_guide() {
            self.set_notice("the guide is closed: F2 opens it where you left it");
        }
    }

    /// Closes the guide. Returns whether it was open.
    pub(super) fn close_guide(&mut self) -> bool {
        let Some(tour) = self.tour.take() else { return false };
        self.preferences.left_at = tour.index();
        true
    }

    pub(super) fn type_path(&mut self, path: String) {
        if let Some(Dialog::Path { refused, .. }) = &mut self.dialog
            && path != self.preferences.typed_path
        {
            *refused = None;
        }
        self.preferences.typed_path = path;
    }

    pub(super) fn set_notice_parts(&mut self, told: Vec<String>) {
        if !told.is_empty() {
            self.set_notice(told);
        }
    }

    /// Shows the instruments if this command is about one of them.
    pub(super) fn measure_for(&mut self, command: &Command) {
        let is_about = match command {
            Command::Stage(command) => matches!(
                command,
                StageCommand::ToggleRace
                    | StageCommand::Instrument(_)
                    | StageCommand::InstrumentBeside(_)
                    | StageCommand::OpenSpring
            ),
            Command::Run(command) => *command == RunCommand::ToggleInspector,
            Command::View(command) => {
                matches!(command, ViewCommand::ToggleEnlarged | ViewCommand::Enter)
            }
            Command::Loop(_) | Command::Ask(_) => false,
        };
        self.preferences.display.measure |= is_about;
    }
}
