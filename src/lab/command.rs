//! All commands of a person, and their keys.
//!
//! Keyboard, panels, scene scripts and tests all make the same [`Command`]s; [`KEYS`] is the one table
//! from which the window, the help overlay and `regatta list keys` are made.

use super::action::Action;
use super::held::HeldBody;
use super::instrument::Instrument;
use super::key::Key;
use super::lane_spec::LaneSpec;
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
    Fly(LaneSpec),
    /// The next method or lane on the list, cyclically.
    NextMethod,
    /// The previous method or lane on the list, cyclically.
    PreviousMethod,
    /// Solo to race, from the start line; race to solo, with the selected lane as it is.
    ToggleRace,
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
    /// Restores the future that was discarded last.
    Undo,
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
    /// Sets the throttle of every body that has one, -1 to 1.
    Throttle(f64),
    /// A tenth more throttle.
    ThrottleUp,
    /// A tenth less throttle.
    ThrottleDown,
    /// Sets the rudder of every body that has one, from -1, hard right, to 1, hard left.
    Rudder(f64),
    /// A tenth more rudder to the left.
    RudderLeft,
    /// A tenth more rudder to the right.
    RudderRight,
    /// Gives every body an impulse of this many times its own kick.
    Kick(f64),
    /// Opens the scene at this place of the [list](super::SceneList), from 0.
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
    /// Closes the open dialog.
    CloseDialog,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// The next way of drawing between ticks: raw, linear, Hermite.
    NextInterpolation,
    /// Race: lanes over each other, or side by side.
    ToggleArrangement,
    /// The dark theme or the light one.
    ToggleTheme,
    /// Shows this instrument.
    Instrument(Instrument),
    /// Shows this parameter of the displayed body on the stability map, by its place.
    MapParameter(usize),
    /// The next instrument, cyclically.
    NextInstrument,
    /// The previous instrument, cyclically.
    PreviousInstrument,
    /// Shows the metric at this place of [`METRICS`](super::METRICS) in the error instrument.
    Metric(usize),
    /// Shows the instrument over the stage, or beside it again.
    ToggleEnlarged,
    /// Copies the instrument's values.
    CopyInstrument,
    /// Saves the instrument to files.
    ExportInstrument,
    /// Selects the body of the plots and the lane list, by its place in the scene, from 0.
    Body(usize),
    /// Holds a body; time stands still until it is released. To place it is an [`Action`].
    Hold(HeldBody),
    /// Releases the held body, which goes on from where it was grabbed.
    LetGo,
    /// Zooms and pans a body's part of the stage.
    ZoomPan {
        /// The body's place in the scene.
        body: usize,
        /// The zoom and the pan.
        zoom_pan: ZoomPan,
    },
    /// Opens or closes the help overlay.
    ToggleHelp,
    /// Opens or closes the inspector.
    ToggleInspector,
    /// Sets how long the scene is, in seconds, within
    /// [`LEAST_SECONDS`](super::LEAST_SECONDS) and [`MOST_SECONDS`](super::MOST_SECONDS): plots and verdicts cover it.
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
    /// Predicts this choice of the guide's stop, from 0.
    Predict(usize),
    /// Releases the held body, else closes the overlay, else the guide, else shrinks the
    /// instrument, else closes the inspector, else quits.
    Escape,
}

/// The tick rates of the bracket keys in Hz: the usual ones, and 49 and 50 next to the limit of the stiff spring.
pub const TICK_LADDER: [u32; 13] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 240, 1000];

/// The speeds of the keys `-` and `=`, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// One line of the key table.
#[derive(Debug)]
pub struct Binding {
    /// As the help shows it.
    pub shown: &'static str,
    /// What it does, for people.
    pub about: &'static str,
    /// The keys, each with what it does.
    pub keys: &'static [(Key, Command)],
    /// Whether holding the key repeats it.
    pub repeats: bool,
}

/// Every key.
pub static KEYS: &[Binding] = &[
    Binding {
        shown: "1 … 9, 0",
        about: "solo: switch the bodies to that method, in flight; race: select that lane",
        keys: &[
            (Key::Digit(1), Command::Pick(0)),
            (Key::Digit(2), Command::Pick(1)),
            (Key::Digit(3), Command::Pick(2)),
            (Key::Digit(4), Command::Pick(3)),
            (Key::Digit(5), Command::Pick(4)),
            (Key::Digit(6), Command::Pick(5)),
            (Key::Digit(7), Command::Pick(6)),
            (Key::Digit(8), Command::Pick(7)),
            (Key::Digit(9), Command::Pick(8)),
            (Key::Digit(0), Command::Pick(9)),
        ],
        repeats: false,
    },
    Binding {
        shown: "M, Shift M",
        about: "next, previous method",
        keys: &[
            (Key::Sign('m'), Command::NextMethod),
            (Key::ShiftSign('m'), Command::PreviousMethod),
        ],
        repeats: false,
    },
    Binding {
        shown: "C",
        about: "solo / race of all methods",
        keys: &[(Key::Sign('c'), Command::ToggleRace)],
        repeats: false,
    },
    Binding {
        shown: "Space",
        about: "run / pause",
        keys: &[(Key::Space, Command::TogglePause)],
        repeats: false,
    },
    Binding {
        shown: ", .",
        about: "one tick back, forward",
        keys: &[(Key::Sign(','), Command::TickBack), (Key::Sign('.'), Command::TickForward)],
        repeats: true,
    },
    Binding {
        shown: "Shift , .",
        about: "one second back, forward",
        keys: &[
            (Key::ShiftSign(','), Command::SecondBack),
            (Key::ShiftSign('.'), Command::SecondForward),
        ],
        repeats: true,
    },
    Binding {
        shown: "Ctrl Z",
        about: "bring back a future that an action in the past discarded, or else the run before a restart",
        keys: &[(Key::ControlSign('z'), Command::Undo)],
        repeats: false,
    },
    Binding {
        shown: "Home",
        about: "restart",
        keys: &[(Key::Home, Command::Restart)],
        repeats: false,
    },
    Binding {
        shown: "[ ]",
        about: "tick rate down, up",
        keys: &[(Key::Sign('['), Command::TickRateDown), (Key::Sign(']'), Command::TickRateUp)],
        repeats: true,
    },
    Binding {
        shown: "- =",
        about: "speed down, up: ¼× to 16×",
        keys: &[(Key::Sign('-'), Command::SpeedDown), (Key::Sign('='), Command::SpeedUp)],
        repeats: true,
    },
    Binding {
        shown: "↑ ↓",
        about: "throttle (ship, helm)",
        keys: &[(Key::Up, Command::ThrottleUp), (Key::Down, Command::ThrottleDown)],
        repeats: true,
    },
    Binding {
        shown: "← →",
        about: "rudder (helm)",
        keys: &[(Key::Left, Command::RudderLeft), (Key::Right, Command::RudderRight)],
        repeats: true,
    },
    Binding {
        shown: "K",
        about: "kick: an impulse at the next tick",
        keys: &[(Key::Sign('k'), Command::Kick(1.0))],
        repeats: false,
    },
    Binding {
        shown: "N, B",
        about: "next, previous scene",
        keys: &[(Key::Sign('n'), Command::NextScene), (Key::Sign('b'), Command::PreviousScene)],
        repeats: false,
    },
    Binding {
        shown: "O",
        about: "open a scene file; or drop one onto the window",
        keys: &[(Key::Sign('o'), Command::AskForPath)],
        repeats: false,
    },
    Binding {
        shown: "G",
        about: "exact ghost on / off",
        keys: &[(Key::Sign('g'), Command::ToggleGhost)],
        repeats: false,
    },
    Binding {
        shown: "I",
        about: "drawing between ticks: raw / linear / Hermite",
        keys: &[(Key::Sign('i'), Command::NextInterpolation)],
        repeats: false,
    },
    Binding {
        shown: "V",
        about: "race: lanes over each other / side by side",
        keys: &[(Key::Sign('v'), Command::ToggleArrangement)],
        repeats: false,
    },
    Binding {
        shown: "F3",
        about: "light / dark theme",
        keys: &[(Key::Function(3), Command::ToggleTheme)],
        repeats: false,
    },
    Binding {
        shown: "T, Shift T",
        about: "next, previous instrument",
        keys: &[
            (Key::Sign('t'), Command::NextInstrument),
            (Key::ShiftSign('t'), Command::PreviousInstrument),
        ],
        repeats: false,
    },
    Binding {
        shown: "Enter",
        about: "enlarge the instrument over the stage",
        keys: &[(Key::Enter, Command::ToggleEnlarged)],
        repeats: false,
    },
    Binding {
        shown: "Ctrl C, Ctrl E",
        about: "copy the instrument's values; save it as PNG, SVG and CSV",
        keys: &[
            (Key::ControlSign('c'), Command::CopyInstrument),
            (Key::ControlSign('e'), Command::ExportInstrument),
        ],
        repeats: false,
    },
    Binding {
        shown: "E",
        about: "inspector: parameters, methods and rates, edited while it runs",
        keys: &[(Key::Sign('e'), Command::ToggleInspector)],
        repeats: false,
    },
    Binding {
        shown: "P, F12",
        about: "screenshot; the file's name is shown",
        keys: &[(Key::Sign('p'), Command::Screenshot), (Key::Function(12), Command::Screenshot)],
        repeats: false,
    },
    Binding {
        shown: "F5, Ctrl S",
        about: "save the run as a scene file; its name is shown",
        keys: &[(Key::Function(5), Command::Record), (Key::ControlSign('s'), Command::Record)],
        repeats: false,
    },
    Binding {
        shown: "X",
        about: "equal cost of all lanes on / off: cheap lanes get more substeps",
        keys: &[(Key::Sign('x'), Command::ToggleEqualCost)],
        repeats: false,
    },
    Binding {
        shown: "F11",
        about: "full screen",
        keys: &[(Key::Function(11), Command::ToggleFullScreen)],
        repeats: false,
    },
    Binding {
        shown: "F2",
        about: "guide: the chapter in stops, each with a prediction and a key to press",
        keys: &[(Key::Function(2), Command::ToggleGuide)],
        repeats: false,
    },
    Binding {
        shown: "Page Down",
        about: "next stop of the guide, while it is open",
        keys: &[(Key::PageDown, Command::NextStop)],
        repeats: false,
    },
    Binding {
        shown: "H, F1, ?",
        about: "help",
        keys: &[
            (Key::Sign('h'), Command::ToggleHelp),
            (Key::Function(1), Command::ToggleHelp),
            (Key::Sign('?'), Command::ToggleHelp),
        ],
        repeats: false,
    },
    Binding {
        shown: "Esc",
        about: "let go of a body, close the overlay, the guide, the instrument, the inspector, or quit",
        keys: &[(Key::Escape, Command::Escape)],
        repeats: false,
    },
];

/// What `key` does, if anything.
pub fn command_for(key: Key) -> Option<(Command, &'static Binding)> {
    KEYS.iter().find_map(|binding| {
        let (_, command) = binding.keys.iter().find(|(bound, _)| *bound == key)?;
        Some((command.clone(), binding))
    })
}
