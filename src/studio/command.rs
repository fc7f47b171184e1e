//! All commands of a person. Keyboard, panels, scene scripts and tests all make the same [`Command`]s.

use std::collections::BTreeMap;

use super::deck::HeldBody;
use super::display::{DriverRequest, Splits};
use super::instrument::Instrument;
use super::my_spring::MySpring;
use super::step::Step;
use super::zoom_pan::ZoomPan;
use crate::loops::loop_lab::LoopCommand;
use crate::measure::cloud::CloudChoice;
use crate::run::MenuIndex;
use crate::run::past::Quantity;
use crate::scene::{Action, LaneSpec};
use crate::sim::TickRate;
use crate::sim::integrators::Method;
use crate::tools::source_code::Language;

/// A command of a person. A command on the run becomes an [`Action`], which states the new value rather than a
/// change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Commands on the run and its displays; the loop lab refuses them.
    Run(RunCommand),
    /// Commands on the run, or on the loop lab while it is open.
    Stage(StageCommand),
    /// Opens, leaves or changes the loop lab.
    Loop(LoopCommand),
    /// Commands on the window around the stage, and on the whole program.
    View(ViewCommand),
    /// Requests to the driver. The loop lab has no run to record.
    Ask(DriverRequest),
}

macro_rules! from_each {
    ($($receiver:ident: $command:ty),*) => {$(
        impl From<$command> for Command {
            fn from(command: $command) -> Self {
                Self::$receiver(command)
            }
        }
    )*};
}
from_each! {
    Run: RunCommand, Stage: StageCommand, Loop: LoopCommand, View: ViewCommand, Ask: DriverRequest
}

/// Commands on the run and its displays.
#[derive(Clone, Debug, PartialEq)]
pub enum RunCommand {
    /// Performs this action on the run.
    Act(Action),
    /// Sets the substeps and the tolerance of this menu method, and switches to it like [`StageCommand::Method`]. A
    /// racing lane keeps its state.
    SetLane(LaneSpec),
    /// Pauses and moves to this tick, at most the last one reached. For a later tick, a notice reports how far the
    /// run has come.
    Seek(u64),
    /// Rewinds to before the selected lane blew up, and runs.
    WatchAgain,
    /// Undoes the last edit of the run or of its next start.
    Undo,
    /// Redoes the edit that was undone last.
    Redo,
    /// Sets the speed in percent of real time.
    SpeedPercent(u32),
    /// A tenth more throttle.
    ThrottleUp,
    /// A tenth less throttle.
    ThrottleDown,
    /// A tenth more rudder to the left.
    RudderLeft,
    /// A tenth more rudder to the right.
    RudderRight,
    /// Selects the next [interpolation](crate::run::race::Interpolation::ALL) between ticks.
    NextInterpolation,
    /// Shows this parameter of the displayed body on the stability map, by its index.
    MapParameter(usize),
    /// Chooses the clouds of the cloud instrument.
    Cloud(CloudChoice),
    /// Holds a body; time stands still until its release. Placing it is an [`Action`].
    Hold(HeldBody),
    /// Opens or closes the inspector.
    ToggleInspector,
    /// Sets the length of the scene in seconds, within [`MIN_SECONDS`](crate::scene::MIN_SECONDS) and
    /// [`MAX_SECONDS`](crate::scene::MAX_SECONDS). Plots and verdicts cover it.
    Seconds(f64),
    /// Switches equal cost on or off. With it, substeps bring the cost of each lane nearest to that of the most
    /// expensive one.
    ToggleEqualCost,
}

/// Commands on the run, or on the loop lab while it is open.
#[derive(Clone, Debug, PartialEq)]
pub enum StageCommand {
    /// Solo: switches the bodies to this method in flight. Race: selects its lane.
    Method(&'static Method),
    /// Solo: switches to the method with this menu index, from 0. Race: selects its lane.
    Pick(MenuIndex),
    /// Selects the next or the previous menu entry, cyclically.
    MethodBeside(Step),
    /// Solo to race, from the start line; race to solo, in the present state of the selected lane.
    ToggleRace,
    /// Pauses and moves one tick forward or back.
    Tick(Step),
    /// Pauses and moves one second forward or back.
    Second(Step),
    /// Returns to tick 0, with the bodies at their start and the script at its beginning. A person's choice of method
    /// and tick rate stays; a script's does not.
    Restart,
    /// Sets the tick rate in Hz.
    TickHz(TickRate),
    /// Sets the next higher or lower rate of [`TICK_LADDER`].
    TickRate(Step),
    /// Sets the next higher or lower speed of [`SPEED_LADDER`].
    Speed(Step),
    /// Opens the scene at this index of the [list](super::SceneList), from 0.
    Scene(usize),
    /// Opens the next or the previous scene of the list, cyclically.
    SceneBeside(Step),
    /// Opens the spring of the dialog as a scene, with advice on it.
    OpenSpring,
    /// Race: toggles between overlaid lanes and lanes side by side.
    ToggleArrangement,
    /// Shows this instrument.
    Instrument(Instrument),
    /// Shows the next or the previous instrument, cyclically.
    InstrumentBeside(Step),
    /// Shows the metric with this index in [`METRICS`](crate::run::METRICS) in the error instrument.
    Metric(usize),
    /// Selects the body of the plots and the lane list, by its index in the scene, from 0.
    Body(usize),
}

/// Commands on the window around the stage, and on the whole program.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewCommand {
    /// Runs or pauses.
    TogglePause,
    /// The pointer's button goes down or up. Undo treats all edits while it is down as one.
    PointerDown(bool),
    /// Holds the tick rate: time waits, and the stage shows futures, until the pointer's button goes up.
    HoldTickRate,
    /// Opens a field for the path of a scene file.
    AskForPath,
    /// Opens the same field for a recording to compare with the run.
    AskForRun,
    /// Sets the text of that field.
    TypePath(String),
    /// Opens a dialog with the numbers of a custom spring.
    AskForSpring,
    /// Sets those numbers.
    DescribeSpring(MySpring),
    /// Sets the tick rate (Hz) for the spring of the dialog.
    SpringTickHz(TickRate),
    /// Closes the open dialog.
    CloseDialog,
    /// Puts instruments, table and timeline around the stage, or lets the stage fill the window.
    ToggleMeasure,
    /// Moves the boundaries between stage, instruments and table, within their limits.
    Split(Splits),
    /// Shows the next second under each method, and pauses for it; or hides it.
    ToggleFutures,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// Toggles between the dark and the light theme.
    ToggleTheme,
    /// Sets the next larger or smaller size of type and panels from [`SCALE_LADDER`].
    Scale(Step),
    /// Sets the usual size of type and panels.
    UsualScale,
    /// Shows this quantity in the motion instrument; `None` restores each body's default.
    Quantity(Option<Quantity>),
    /// Shows this coordinate of a body in the plots.
    Coordinate {
        /// The body's index in the scene.
        body: usize,
        /// The index of the coordinate.
        coordinate: usize,
    },
    /// Zooms and pans the plots to these ranges of their axes, by name; all other axes are fitted.
    PlotRanges(BTreeMap<String, [f64; 2]>),
    /// Shows the instrument over the stage, or beside it again.
    ToggleEnlarged,
    /// Copies the method of the lane that is [pointed at](ViewCommand::PointAt) as source code, in the language of
    /// the last copy. For an engine, copies the lines that set the displayed spring; without a lane, the instrument's
    /// values.
    Copy,
    /// Sets the language of the next copied method.
    Language(Language),
    /// Copies a method as source code.
    CopyMethod {
        /// Menu index of the method.
        entry: MenuIndex,
        /// The language.
        language: Language,
    },
    /// The pointer or the keyboard's focus moves to the lane at this menu index, or leaves the list.
    PointAt(Option<MenuIndex>),
    /// Limits the advice to the displayed body, or extends it to all bodies.
    AdviseOnOneBody(bool),
    /// Releases the held body, which resumes from where it was taken.
    LetGo,
    /// Zooms and pans a body's part of the stage.
    ZoomPan {
        /// The body's index in the scene.
        body: usize,
        /// The zoom and the pan.
        zoom_pan: ZoomPan,
    },
    /// Opens or closes the help overlay.
    ToggleHelp,
    /// Opens the guide where the person left it, or closes it.
    ToggleGuide,
    /// Opens this stop of the guide, from 0.
    GoToStop(usize),
    /// Opens the next or the previous stop of the guide, if the guide is open and has one.
    StopBeside(Step),
    /// Predicts this choice at the guide's stop, from 0.
    Predict(usize),
    /// Releases or closes the first of these: held body, overlay, guide, enlarged instrument, inspector, loop lab.
    /// Otherwise quits; with unsaved edits, at the second time.
    Escape,
}

/// Tick rates of the bracket keys in Hz: the usual ones of games and screens, and 49 and 50 next to the limit of the
/// stiff spring.
pub const TICK_LADDER: [u32; 14] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 144, 240, 1000];

/// Speeds of the keys `-` and `=`, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// Sizes of type and panels for the keys `Ctrl +` and `Ctrl −`, in percent of the usual one. Type is legible at the
/// smallest, and the panels fit a screen of 1920 × 1080 up to the largest.
pub const SCALE_LADDER: [u32; 8] = [75, 90, 100, 110, 125, 150, 175, 200];

/// Default size of type and panels, in percent.
pub(super) const USUAL_SCALE_PERCENT: u32 = 100;
