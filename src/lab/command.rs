//! Everything a person or a script can do, and the keys that do it.
//!
//! Keyboard, panels, scene scripts and tests all make the same [`Command`]s; [`KEYS`] is the one table
//! from which the window, the help overlay and `regatta list keys` are made.

use super::action::Action;
use super::display::Instrument;
use super::held::Held;
use super::lane_spec::LaneSpec;
use super::lens::Lens;
use crate::sim::integrators::Method;

/// Something that a person asks for. What touches the run becomes an [`Action`], which says what is to be, and not
/// by how much it changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Does this to the run.
    Act(Action),
    /// Solo: switches the bodies to this method in flight. Race: selects its lane.
    Method(&'static Method),
    /// Solo: switches to the method on this place of the lane list, from 0. Race: selects that lane.
    Pick(usize),
    /// Gives this method of the list these substeps and this tolerance, and switches to it as [`Command::Method`] does;
    /// a lane that races keeps its state.
    Fly(LaneSpec),
    /// The next method or lane on the list, round.
    NextMethod,
    /// The previous method or lane on the list, round.
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
    /// Pauses and goes to this tick, or to the last that was reached.
    Seek(u64),
    /// Brings back the future that was discarded last.
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
    /// Lays the rudder of every body that has one, from -1, hard right, to 1, hard left.
    Rudder(f64),
    /// A tenth more rudder to the left.
    RudderLeft,
    /// A tenth more rudder to the right.
    RudderRight,
    /// Gives every body an impulse of this many times its own kick.
    Kick(f64),
    /// Opens the scene on this place of the [list](super::Shelf), from 0.
    Scene(usize),
    /// The next scene of the list, round.
    NextScene,
    /// The previous scene of the list, round.
    PreviousScene,
    /// Opens a field for the path of a scene file.
    AskForPath,
    /// This is typed in it.
    TypePath(String),
    /// Types as much more of it as is sure.
    CompletePath,
    /// Opens the file at that path.
    OpenTypedPath,
    /// Closes what is open over everything else, but for the help.
    CloseDialog,
    /// Shows or hides the exact ghost.
    ToggleGhost,
    /// The next way of drawing between ticks: raw, linear, Hermite.
    NextInterpolation,
    /// Shows this instrument.
    Instrument(Instrument),
    /// The next instrument, round.
    NextInstrument,
    /// The plots and the lane list speak of the body on this place of the scene, from 0.
    Body(usize),
    /// Holds a body; time stands still until it is let go. To put it where it is held is an [`Action`].
    Hold(Held),
    /// Lets the body in hand go on from where it was taken.
    LetGo,
    /// Zooms and pans a body's part of the stage.
    Lens {
        /// The body's place in the scene.
        body: usize,
        /// The zoom and the pan.
        lens: Lens,
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
    /// Gives each lane as many substeps as bring its cost nearest to the dearest lane's, or takes that back.
    ToggleEqualCost,
    /// Enters or leaves full screen.
    ToggleFullScreen,
    /// Lets the body in hand go on, else closes the overlay, else the inspector, else quits.
    Escape,
}

/// The tick rates that the bracket keys walk, in Hz: the usual ones, with 49 and 50 beside the limit of
/// the stiff spring.
pub const TICK_LADDER: [u32; 13] = [2, 5, 10, 15, 20, 30, 49, 50, 60, 100, 120, 240, 1000];

/// The speeds that `-` and `=` walk, in percent of real time.
pub const SPEED_LADDER: [u32; 6] = [25, 50, 100, 200, 400, 1600];

/// A key as this layer knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A digit by its place on the keyboard, so that it works unshifted on every layout.
    Digit(u8),
    /// A lower-case letter or a sign, as the layout gives it.
    Sign(char),
    /// The same letter with Shift held.
    ShiftSign(char),
    /// A letter or a sign with Control held, or with Command on a Mac.
    ControlSign(char),
    /// The space bar.
    Space,
    /// The up arrow.
    Up,
    /// The down arrow.
    Down,
    /// The left arrow.
    Left,
    /// The right arrow.
    Right,
    /// Home.
    Home,
    /// Escape.
    Escape,
    /// A function key.
    Function(u8),
}

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
        about: "bring back the future that an action in the past discarded",
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
        shown: "T",
        about: "next instrument",
        keys: &[(Key::Sign('t'), Command::NextInstrument)],
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
        about: "lanes of equal cost: substeps for those that are cheap; again: as before",
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
        about: "let go of a body, close the overlay, else the inspector, else quit",
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
