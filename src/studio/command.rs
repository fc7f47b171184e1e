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
use crate::run::past::Quantity;
use crate::scene::{Action, LaneSpec};
use crate::sim::TickRate;
use crate::sim::integrators::Method;
use crate::tools::source_code::Language;

/// A command of a person. A command on the run becomes an [`Action`], which states the new value rather than a change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Acts on the run, or on what shows it alone: the loop lab has none of it.
    Run(RunCommand),
    /// Acts on what the stage shows: the run, or the loop lab while it is open.
    Stage(StageCommand),
    /// Opens or leaves the loop lab, or changes it.
    Loop(LoopCommand),
    /// Acts on the window around the stage, and on the whole program.
    View(ViewCommand),
    /// Asks the driver. The loop lab has no run to record.
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

/// What acts on the run, or on what shows it alone.
#[derive(Clone, Debug, PartialEq)]
pub enum RunCommand {
    /// Performs this action on the run.
    Act(Action),
    /// Sets the substeps and the tolerance of this method of the list, and switches to it like [`StageCommand::Method`]. A lane
    /// that races keeps its state.
    SetLane(LaneSpec),
    /// Pauses and goes to this tick, at most the last tick reached: a later one is told to be still to come.
    Seek(u64),
    /// Goes back to before the selected lane blew up, and runs on.
    WatchAgain,
    /// Takes back the last change to the run or to its next start.
    Undo,
    /// Makes the change again that was undone last.
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
    /// The next [way](crate::run::race::Interpolation::ALL) of drawing between ticks.
    NextInterpolation,
    /// Shows this parameter of the displayed body on the stability map, by its index.
    MapParameter(usize),
    /// Chooses the clouds of the cloud instrument.
    Cloud(CloudChoice),
    /// Holds a body; time stands still until it is released. To place it is an [`Action`].
    Hold(HeldBody),
    /// Opens or closes the inspector.
    ToggleInspector,
    /// Sets how long the scene is, in seconds, within
    /// [`MIN_SECONDS`](crate::scene::MIN_SECONDS) and [`MAX_SECONDS`](crate::scene::MAX_SECONDS): plots and verdicts cover it.
    Seconds(f64),
    /// Switches equal cost on or off: each lane has as many substeps as bring its cost nearest to the dearest lane's.
    ToggleEqualCost,
}

/// What acts on what the stage shows: the run, or the loop lab while it is open.
#[derive(Clone, Debug, PartialEq)]
pub enum StageCommand {
    /// Solo: switches the bodies to this method in flight. Race: selects its lane.
    Method(&'static Method),
    /// Solo: switches to the method with this index in the lane list, from 0. Race: selects that lane.
    Pick(usize),
    /// The next or the previous method or lane on the list, cyclically.
    MethodBeside(Step),
    /// Solo to race, from the start line; race to solo, with the selected lane as it is.
    ToggleRace,
    /// Pauses and goes one tick forward or back.
    Tick(Step),
    /// Pauses and goes one second forward or back.
    Second(Step),
    /// Back to tick 0, the bodies at their start and the script from its top. The method and the tick
    /// rate that a person chose stay; a script's do not.
    Restart,
    /// Sets the tick rate in Hz.
    TickHz(TickRate),
    /// The next higher or lower rate of [`TICK_LADDER`].
    TickRate(Step),
    /// The next higher or lower speed of [`SPEED_LADDER`].
    Speed(Step),
    /// Opens the scene at this index of the [list](super::SceneList), from 0.
    Scene(usize),
    /// The next or the previous scene of the list, cyclically.
    SceneBeside(Step),
    /// Opens that spring as a scene, with advice on it.
    OpenSpring,
    /// Race: lanes over each other, or side by side.
    ToggleArrangement,
    /// Shows this instrument.
    Instrument(Instrument),
    /// The next or the previous instrument, cyclically.
    InstrumentBeside(Step),
    /// Shows the metric with this index in [`METRICS`](crate::run::METRICS) in the error instrument.
    Metric(usize),
    /// Selects the body of the plots and the lane list, by its index in the scene, from 0.
    Body(usize),
}

/// What acts on the window around the stage, and on the whole program.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewCommand {
    /// Runs or pauses.
    TogglePause,
    /// The pointer's button goes down or up. All changes while it is down are undone as one.
    PointerDown(bool),
    /// Opens a field for the path of a scene file.
    AskForPath,
    /// Opens the same field for a recording that is to be compared with the run.
    AskForRun,
    /// Sets the text of that field.
    TypePath(String),
    /// Opens a dialog with the numbers of a custom spring.
    AskForSpring,
    /// Sets those numbers.
    DescribeSpring(MySpring),
    /// Sets the tick rate at which the spring of the dialog is to run, in Hz.
    SpringTickHz(TickRate),
    /// Closes the open dialog.
    CloseDialog,
    /// Puts instruments, table and timeline round the stage, or lets the stage fill the window.
    ToggleMeasure,
    /// Puts the boundaries between stage, instruments and table here, as far as they go.
    Split(Splits),
    /// Shows the next second under each method, and pauses for it; or hides it.
    ToggleFutures,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// The dark theme or the light one.
    ToggleTheme,
    /// The next larger or smaller size of type and panels of [`SCALE_LADDER`].
    Scale(Step),
    /// The usual size of type and panels.
    UsualScale,
    /// Shows this quantity in the motion instrument; `None` for that which is usual for each body.
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
    /// Copies the method of the lane that is [pointed at](ViewCommand::PointAt) as source code in the language of the last
    /// copy; of an engine's the lines that tell it the displayed spring; or else the instrument's values.
    Copy,
    /// Has the next method be copied in this language.
    Language(Language),
    /// Copies a method as source code.
    CopyMethod {
        /// Its index in the list of lanes.
        entry: usize,
        /// The language.
        language: Language,
    },
    /// The pointer or the keyboard's focus comes to the lane at this index of the list, or leaves the list.
    PointAt(Option<usize>),
    /// Has the advice be about the displayed body alone, or about all bodies.
    AdviseOnOneBody(bool),
    /// Releases the held body, which goes on from where it was grabbed.
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
    /// Opens the guide where it was left, or closes it.
    ToggleGuide,
    /// Opens this stop of the guide, from 0.
    GoToStop(usize),
    /// Opens the next or the previous stop of the guide, if the guide is open and has one.
    StopBeside(Step),
    /// Predicts this choice of the guide's stop, from 0.
    Predict(usize),
    /// Releases the held body, else closes the overlay, else the guide, else shrinks the
    /// instrument, else closes the inspector, else leaves the loop lab, else quits: at the second time, if the run has
    /// something to lose.
    Escape,
}

/// The tick rates of the bracket keys in Hz: the usual ones of games and screens, and 49 and 50 next to the limit of the
/// stiff spring.
pub const TICK_LADDER: [u32; 14] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 144, 240, 1000];

/// The speeds of the keys `-` and `=`, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// The sizes of type and panels of the keys `Ctrl +` and `Ctrl −`, in percent of the usual one: type is legible from the
/// smallest on, and the panels fit a screen of 1920 × 1080 up to the largest.
pub const SCALE_LADDER: [u32; 8] = [75, 90, 100, 110, 125, 150, 175, 200];

/// The size of type and panels that nobody chose, in percent.
pub(super) const USUAL_SCALE_PERCENT: u32 = 100;
