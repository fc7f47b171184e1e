//! All commands of a person. Keyboard, panels, scene scripts and tests all make the same [`Command`]s.

use std::collections::BTreeMap;

use super::action::Action;
use super::cloud::CloudChoice;
use super::held::HeldBody;
use super::instrument::Instrument;
use super::lane_spec::LaneSpec;
use super::loop_lab::LoopCommand;
use super::my_spring::MySpring;
use super::quantity::Quantity;
use super::source_code::Language;
use super::zoom_pan::ZoomPan;
use crate::sim::integrators::Method;

/// A command of a person. A command on the run becomes an [`Action`], which states the new value rather than a change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Performs this action on the run.
    Act(Action),
    /// Solo: switches the bodies to this method in flight. Race: selects its lane.
    Method(&'static Method),
    /// Solo: switches to the method at this place of the lane list, from 0. Race: selects that lane.
    Pick(usize),
    /// Sets the substeps and the tolerance of this method of the list, and switches to it like [`Command::Method`]. A lane
    /// that races keeps its state.
    SetLane(LaneSpec),
    /// The next method or lane on the list, cyclically.
    NextMethod,
    /// The previous method or lane on the list, cyclically.
    PreviousMethod,
    /// Solo to race, from the start line; race to solo, with the selected lane as it is.
    ToggleRace,
    /// Opens or leaves the loop lab, or changes it.
    Loop(LoopCommand),
    /// Runs or pauses.
    TogglePause,
    /// Pauses and goes one tick forward.
    TickForward,
    /// Pauses and goes one tick back.
    TickBack,
    /// Pauses and goes one second forward.
    SecondForward,
    /// Pauses and goes one second back.
    SecondBack,
    /// Pauses and goes to this tick, at most the last tick reached.
    Seek(u64),
    /// Goes back to before the selected lane blew up, and runs on.
    WatchAgain,
    /// Takes back the last change to the run or to its next start.
    Undo,
    /// Makes the change again that was undone last.
    Redo,
    /// The pointer's button goes down or up. All changes while it is down are undone as one.
    PointerDown(bool),
    /// Back to tick 0, the bodies at their start and the script from its top. The method and the tick
    /// rate that a person chose stay; a script's do not.
    Restart,
    /// Sets the tick rate in Hz.
    TickHz(u32),
    /// The next higher rate of [`TICK_LADDER`].
    TickRateUp,
    /// The next lower rate of [`TICK_LADDER`].
    TickRateDown,
    /// Sets the speed in percent of real time.
    SpeedPercent(u32),
    /// The next higher speed of [`SPEED_LADDER`].
    SpeedUp,
    /// The next lower speed of [`SPEED_LADDER`].
    SpeedDown,
    /// A tenth more throttle.
    ThrottleUp,
    /// A tenth less throttle.
    ThrottleDown,
    /// A tenth more rudder to the left.
    RudderLeft,
    /// A tenth more rudder to the right.
    RudderRight,
    /// Opens the scene at this index of the [list](super::SceneList), from 0.
    Scene(usize),
    /// The next scene of the list, cyclically.
    NextScene,
    /// The previous scene of the list, cyclically.
    PreviousScene,
    /// Opens a field for the path of a scene file.
    AskForPath,
    /// Sets the text of that field.
    TypePath(String),
    /// Completes the typed path as far as it is unambiguous.
    CompletePath,
    /// Opens the file at that path.
    OpenTypedPath,
    /// Opens a dialog with the numbers of a custom spring.
    AskForSpring,
    /// Sets those numbers.
    DescribeSpring(MySpring),
    /// Opens that spring as a scene, with advice on it.
    OpenSpring,
    /// Closes the open dialog.
    CloseDialog,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// The next [way](super::Interpolation::ALL) of drawing between ticks.
    NextInterpolation,
    /// Race: lanes over each other, or side by side.
    ToggleArrangement,
    /// The dark theme or the light one.
    ToggleTheme,
    /// The next larger size of type and panels of [`SCALE_LADDER`].
    ScaleUp,
    /// The next smaller size of type and panels of [`SCALE_LADDER`].
    ScaleDown,
    /// The usual size of type and panels.
    UsualScale,
    /// Shows this instrument.
    Instrument(Instrument),
    /// Shows this quantity in the motion instrument.
    Quantity(Quantity),
    /// Shows this coordinate of a body in the plots.
    Coordinate {
        /// The body's index in the scene.
        body: usize,
        /// The index of the coordinate.
        coordinate: usize,
    },
    /// Zooms and pans the plots to these ranges of their axes, by name; all other axes are fitted.
    PlotRanges(BTreeMap<String, [f64; 2]>),
    /// Shows this parameter of the displayed body on the stability map, by its place.
    MapParameter(usize),
    /// The next instrument, cyclically.
    NextInstrument,
    /// The previous instrument, cyclically.
    PreviousInstrument,
    /// Shows the metric at this place of [`METRICS`](super::METRICS) in the error instrument.
    Metric(usize),
    /// Chooses the clouds of the cloud instrument.
    Cloud(CloudChoice),
    /// Shows the instrument over the stage, or beside it again.
    ToggleEnlarged,
    /// Copies the method of the lane that is [pointed at](Command::PointAt) as source code in the language of the last
    /// copy; of an engine's the lines that tell it the displayed spring; or else the instrument's values.
    Copy,
    /// Copies the instrument's values.
    CopyInstrument,
    /// Copies a method as source code.
    CopyMethod {
        /// Its place in the list of lanes.
        entry: usize,
        /// The language.
        language: Language,
    },
    /// Copies the lines of code that tell the engine at this index of the list of lanes the displayed spring.
    CopyJoint(usize),
    /// The pointer or the keyboard's focus comes to the lane at this index of the list, or leaves the list.
    PointAt(Option<usize>),
    /// Saves the instrument to files.
    ExportInstrument,
    /// Selects the body of the plots and the lane list, by its index in the scene, from 0.
    Body(usize),
    /// Has the advice be about the displayed body alone, or about all bodies.
    AdviseOnOneBody(bool),
    /// Holds a body; time stands still until it is released. To place it is an [`Action`].
    Hold(HeldBody),
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
    /// Opens or closes the inspector.
    ToggleInspector,
    /// Sets how long the scene is, in seconds, within
    /// [`MIN_SECONDS`](super::scene::MIN_SECONDS) and [`MAX_SECONDS`](super::MAX_SECONDS): plots and verdicts cover it.
    Seconds(f64),
    /// Saves what the window shows to a file.
    Screenshot,
    /// Saves the run to a file, as a scene.
    Record,
    /// Switches equal cost on or off: each lane has as many substeps as bring its cost nearest to the dearest lane's.
    ToggleEqualCost,
    /// Enters or leaves full screen.
    ToggleFullScreen,
    /// Opens the guide where it was left, or closes it.
    ToggleGuide,
    /// Opens this stop of the guide, from 0.
    GoToStop(usize),
    /// Opens the next stop of the guide, if the guide is open and has one.
    NextStop,
    /// Opens the previous stop of the guide, if the guide is open and has one.
    PreviousStop,
    /// Predicts this choice of the guide's stop, from 0.
    Predict(usize),
    /// Releases the held body, else closes the overlay, else the guide, else shrinks the
    /// instrument, else closes the inspector, else quits.
    Escape,
}

/// What a command acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Receiver {
    /// The run. The loop lab has none of it.
    Run,
    /// What the stage shows: the run, or the loop lab while it is open.
    Stage,
    /// The window around the stage, and the whole program.
    Window,
}

impl Command {
    pub(super) fn receiver(&self) -> Receiver {
        match self {
            Command::Act(_)
            | Command::SetLane(_)
            | Command::Seek(_)
            | Command::WatchAgain
            | Command::Undo
            | Command::Redo
            | Command::SpeedPercent(_)
            | Command::ThrottleUp
            | Command::ThrottleDown
            | Command::RudderLeft
            | Command::RudderRight
            | Command::Hold(_)
            | Command::Seconds(_)
            | Command::MapParameter(_)
            | Command::Cloud(_)
            | Command::NextInterpolation
            | Command::ToggleInspector
            | Command::Record
            | Command::ToggleEqualCost => Receiver::Run,
            Command::Loop(_)
            | Command::Method(_)
            | Command::Pick(_)
            | Command::NextMethod
            | Command::PreviousMethod
            | Command::ToggleRace
            | Command::TickForward
            | Command::TickBack
            | Command::SecondForward
            | Command::SecondBack
            | Command::Restart
            | Command::TickHz(_)
            | Command::TickRateUp
            | Command::TickRateDown
            | Command::SpeedUp
            | Command::SpeedDown
            | Command::Scene(_)
            | Command::NextScene
            | Command::PreviousScene
            | Command::OpenSpring
            | Command::ToggleArrangement
            | Command::Instrument(_)
            | Command::NextInstrument
            | Command::PreviousInstrument
            | Command::Metric(_)
            | Command::Body(_) => Receiver::Stage,
            Command::TogglePause
            | Command::PointerDown(_)
            | Command::AskForPath
            | Command::TypePath(_)
            | Command::CompletePath
            | Command::OpenTypedPath
            | Command::AskForSpring
            | Command::DescribeSpring(_)
            | Command::CloseDialog
            | Command::ToggleGhost
            | Command::ToggleTheme
            | Command::ScaleUp
            | Command::ScaleDown
            | Command::UsualScale
            | Command::Quantity(_)
            | Command::Coordinate { .. }
            | Command::PlotRanges(_)
            | Command::ToggleEnlarged
            | Command::Copy
            | Command::CopyInstrument
            | Command::CopyMethod { .. }
            | Command::CopyJoint(_)
            | Command::PointAt(_)
            | Command::ExportInstrument
            | Command::AdviseOnOneBody(_)
            | Command::LetGo
            | Command::ZoomPan { .. }
            | Command::ToggleHelp
            | Command::Screenshot
            | Command::ToggleFullScreen
            | Command::ToggleGuide
            | Command::GoToStop(_)
            | Command::NextStop
            | Command::PreviousStop
            | Command::Predict(_)
            | Command::Escape => Receiver::Window,
        }
    }
}

/// The tick rates of the bracket keys in Hz: the usual ones of games and screens, and 49 and 50 next to the limit of the
/// stiff spring.
pub const TICK_LADDER: [u32; 14] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 144, 240, 1000];

/// The speeds of the keys `-` and `=`, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// The sizes of type and panels of the keys `Ctrl +` and `Ctrl −`, in percent of the usual one: type is legible from the
/// smallest on, and the panels fit a screen of 1920 × 1080 up to the largest.
pub const SCALE_LADDER: [u32; 8] = [75, 90, 100, 110, 125, 150, 175, 200];

/// The next higher rung of a ladder; `None` at its top.
pub(super) fn rung_above(ladder: &[u32], rung: u32) -> Option<u32> {
    ladder.iter().copied().find(|&other| other > rung)
}

/// The next lower rung of a ladder; `None` at its bottom.
pub(super) fn rung_below(ladder: &[u32], rung: u32) -> Option<u32> {
    ladder.iter().copied().rfind(|&other| other < rung)
}

/// The size of type and panels that nobody chose, in percent.
pub const USUAL_SCALE_PERCENT: u32 = 100;
