//! All commands that a person can give. The keyboard, the panels, the scripts of scenes and the tests all make the same
//! [`Command`]s.

use std::collections::BTreeMap;

use super::deck::{HeldBody, PulledBody};
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

/// A command of a person. A command on the run becomes an [`Action`], which states the new value instead of the change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// A command on the run and its displays. The loop lab refuses it.
    Run(RunCommand),
    /// A command on the run, or on the loop lab while that is open.
    Stage(StageCommand),
    /// A command that opens, leaves or changes the loop lab.
    Loop(LoopCommand),
    /// A command on the window around the stage, or on the whole program.
    View(ViewCommand),
    /// A request to the driver. The loop lab refuses to record, because it has no run.
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
    /// Sets the substeps and the tolerance of this menu method, and then switches to it like [`StageCommand::Method`].
    /// A racing lane keeps its state.
    SetLane(LaneSpec),
    /// Pauses and moves to this tick, but at most to the last one reached. If the tick is later, a notice reports how
    /// far the run has come.
    Seek(u64),
    /// Rewinds to some time before the selected lane blew up, and runs.
    WatchAgain,
    /// Undoes the last edit, whether of the run or of the next start.
    Undo,
    /// Redoes the edit that was undone last.
    Redo,
    /// Sets the speed in percent of real time.
    SpeedPercent(u32),
    /// Raises the throttle by a tenth.
    ThrottleUp,
    /// Lowers the throttle by a tenth.
    ThrottleDown,
    /// Turns the rudder to the left by a tenth.
    RudderLeft,
    /// Turns the rudder to the right by a tenth.
    RudderRight,
    /// Selects the next [interpolation](crate::run::race::Interpolation::ALL) between ticks.
    NextInterpolation,
    /// Gives the selected lane the next [rule for impacts](crate::sim::IMPACTS).
    NextImpact,
    /// Shows the displayed body's parameter with this index on the stability map.
    MapParameter(usize),
    /// Chooses the clouds of the cloud instrument.
    Cloud(CloudChoice),
    /// Holds a body. Time stands still until the person releases it. Placing the body is an [`Action`].
    Hold(HeldBody),
    /// Pulls a body by a spring to the pointer while time runs, until its release. Each tick of it is an [`Action`].
    Pull(PulledBody),
    /// Opens or closes the inspector.
    ToggleInspector,
    /// Sets the length of the scene in seconds, within [`MIN_SECONDS`](crate::scene::MIN_SECONDS) and
    /// [`MAX_SECONDS`](crate::scene::MAX_SECONDS). Plots and verdicts cover this length.
    Seconds(f64),
    /// Switches equal cost on or off. At equal cost, each lane takes the substeps that bring its cost nearest to that
    /// of the most expensive lane.
    ToggleEqualCost,
}

/// Commands on the run, or on the loop lab while that is open.
#[derive(Clone, Debug, PartialEq)]
pub enum StageCommand {
    /// In solo mode, switches the bodies to this method in flight. In a race, selects the method's lane.
    Method(&'static Method),
    /// In solo mode, switches to the method with this menu index, from 0. In a race, selects the method's lane.
    Pick(MenuIndex),
    /// Selects the next or the previous menu entry, cyclically.
    MethodBeside(Step),
    /// Switches from solo to a race, from the start line, or from a race to solo, in the present state of the selected
    /// lane.
    ToggleRace,
    /// Pauses and moves one tick forward or back.
    Tick(Step),
    /// Pauses and moves one second forward or back.
    Second(Step),
    /// Returns to tick 0, with the bodies at their start and the script at its beginning. The method and tick rate that
    /// a person has chosen stay. Those that a script has set do not.
    Restart,
    /// Sets the tick rate in Hz.
    TickHz(TickRate),
    /// Sets the next higher or lower tick rate of [`TICK_LADDER`].
    TickRate(Step),
    /// Sets the next higher or lower speed of [`SPEED_LADDER`].
    Speed(Step),
    /// Opens the scene at this index of the [list](super::SceneList), from 0.
    Scene(usize),
    /// Opens the next or the previous scene of the list, cyclically.
    SceneBeside(Step),
    /// Opens the spring of the dialog as a scene, and shows advice on it.
    OpenSpring,
    /// Toggles between the two arrangements of a race: all lanes over each other, and lanes side by side.
    ToggleArrangement,
    /// Shows this instrument.
    Instrument(Instrument),
    /// Shows the next or the previous instrument, cyclically.
    InstrumentBeside(Step),
    /// Shows the metric with this index in [`METRICS`](crate::run::METRICS) in the error instrument.
    Metric(usize),
    /// Selects the displayed body of the plots and the lane list, by its index in the scene, from 0.
    Body(usize),
}

/// Commands on the window around the stage, and on the whole program.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewCommand {
    /// Runs or pauses.
    TogglePause,
    /// Reports that the pointer's button goes down or up. Undo treats all edits while the button is down as one.
    PointerDown(bool),
    /// Holds the tick rate, or another value of the run, until the pointer's button goes up. Meanwhile time waits, and
    /// the stage shows futures.
    HoldTickRate,
    /// Opens a field for the path of a scene file.
    AskForPath,
    /// Opens the field for the path of a recording to compare with the run.
    AskForRun,
    /// Sets the text of the field for a path.
    TypePath(String),
    /// Opens a dialog with the numbers of a custom spring.
    AskForSpring,
    /// Opens a dialog for a person's own lines.
    AskForLines,
    /// Sets the lines of the dialog.
    TypeLines(String),
    /// Runs the lines of the dialog.
    RunLines,
    /// Sets the numbers of the spring in the dialog.
    DescribeSpring(MySpring),
    /// Sets the tick rate (Hz) for the spring of the dialog.
    SpringTickHz(TickRate),
    /// Ends the comparison with a recording.
    CloseComparison,
    /// Opens or closes the list of the chapter's figures.
    ToggleFigures,
    /// Opens the scene of this figure of [`BOOK_FIGURES`](super::BOOK_FIGURES), in the book's view.
    OpenFigure(usize),
    /// Closes the open dialog.
    CloseDialog,
    /// Puts the instruments, the table and the timeline around the stage, or lets the stage fill the window.
    ToggleMeasure,
    /// Moves the boundaries between stage, instruments and table, as far as their limits allow.
    Split(Splits),
    /// Pauses and shows the next second under each method, or hides it.
    ToggleFutures,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// Shows or hides the frame rate of the driver and the time of a frame.
    ToggleFrameRate,
    /// Toggles between the dark and the light theme.
    ToggleTheme,
    /// Sets the next larger or smaller size of type and panels from [`SCALE_LADDER`].
    Scale(Step),
    /// Restores the usual size of type and panels.
    UsualScale,
    /// Shows this quantity in the motion instrument. `None` restores the usual quantity of each body.
    Quantity(Option<Quantity>),
    /// Shows this coordinate of a body in the plots.
    Coordinate {
        /// The body's index in the scene.
        body: usize,
        /// Index of the coordinate.
        coordinate: usize,
    },
    /// Zooms and pans the plots to these ranges of their axes, by the names of the axes. All other axes are fitted.
    PlotRanges(BTreeMap<String, [f64; 2]>),
    /// Puts the instrument over the stage, or back beside it.
    ToggleEnlarged,
    /// Copies the method of the lane that is [pointed at](ViewCommand::PointAt) as source code, in the language of the
    /// last copy. If the method is an engine, copies the lines that set the displayed spring. If no lane is pointed at,
    /// copies the instrument's values.
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
    /// Reports that the pointer or the keyboard's focus moves to the lane at this menu index, or leaves the list.
    PointAt(Option<MenuIndex>),
    /// Limits the advice to the displayed body, or extends it to all bodies.
    AdviseOnOneBody(bool),
    /// Releases the held body, which moves on from where it was taken.
    LetGo,
    /// Zooms and pans the part of the stage that shows a body.
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
    /// Toggles the enlarged instrument, or quits if the program asks whether to quit.
    Enter,
    /// Takes the foremost of these away: body or tick rate in hand, dialog, help, guide, inspector, enlarged
    /// instrument, futures, comparison, run beside, loop lab, race, full screen. If there is none, asks whether to
    /// quit, or answers that question with no.
    Escape,
}

/// Tick rates that the bracket keys set, in Hz. They are the usual rates of games and screens, and 49 and 50, between
/// which lies the limit of the stiff spring.
pub const TICK_LADDER: [u32; 14] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 144, 240, 1000];

/// Speeds that the keys `-` and `=` set, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// Sizes of type and panels that the keys `Ctrl +` and `Ctrl −` set, in percent of the usual size. Type is legible at
/// the smallest one, and the panels fit a screen of 1920 × 1080 up to the largest one.
pub const SCALE_LADDER: [u32; 8] = [75, 90, 100, 110, 125, 150, 175, 200];

/// Default size of type and panels, in percent.
pub(super) const USUAL_SCALE_PERCENT: u32 = 100;
