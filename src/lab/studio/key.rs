//! The keys that commands are bound to: [`KEYS`] is the one table from which the window, the help overlay and
//! `regatta list keys` are made.

use std::fmt;

use super::command::{Command, RunCommand, StageCommand, ViewCommand};
use super::display::DriverRequest;
use super::step::Step;
use crate::lab::action::Action;
use crate::lab::loop_lab::LoopCommand;

/// A key that a command can be bound to.
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
    /// A letter with Control and Shift held.
    ControlShiftSign(char),
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
    /// Page Up.
    PageUp,
    /// Page Down.
    PageDown,
    /// Enter, or Return.
    Enter,
    /// Escape.
    Escape,
    /// A function key.
    Function(u8),
}

/// As people call it.
impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Key::Digit(digit) => write!(f, "{digit}"),
            Key::Sign(sign) => write!(f, "{}", sign.to_uppercase()),
            Key::ShiftSign(sign) => write!(f, "Shift {}", sign.to_uppercase()),
            Key::ControlSign(sign) => write!(f, "Ctrl {}", sign.to_uppercase()),
            Key::ControlShiftSign(sign) => write!(f, "Ctrl Shift {}", sign.to_uppercase()),
            Key::Function(number) => write!(f, "F{number}"),
            Key::Space => f.write_str("Space"),
            Key::Up => f.write_str("↑"),
            Key::Down => f.write_str("↓"),
            Key::Left => f.write_str("←"),
            Key::Right => f.write_str("→"),
            Key::Home => f.write_str("Home"),
            Key::PageUp => f.write_str("Page Up"),
            Key::PageDown => f.write_str("Page Down"),
            Key::Enter => f.write_str("Enter"),
            Key::Escape => f.write_str("Esc"),
        }
    }
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

/// Every key and its command.
pub static KEYS: &[Binding] = &[
    Binding {
        shown: "1 … 9, 0",
        about: "solo: switch the bodies to that method, in flight; race, loop lab: select that lane",
        keys: &[
            (Key::Digit(1), Command::Stage(StageCommand::Pick(0))),
            (Key::Digit(2), Command::Stage(StageCommand::Pick(1))),
            (Key::Digit(3), Command::Stage(StageCommand::Pick(2))),
            (Key::Digit(4), Command::Stage(StageCommand::Pick(3))),
            (Key::Digit(5), Command::Stage(StageCommand::Pick(4))),
            (Key::Digit(6), Command::Stage(StageCommand::Pick(5))),
            (Key::Digit(7), Command::Stage(StageCommand::Pick(6))),
            (Key::Digit(8), Command::Stage(StageCommand::Pick(7))),
            (Key::Digit(9), Command::Stage(StageCommand::Pick(8))),
            (Key::Digit(0), Command::Stage(StageCommand::Pick(9))),
        ],
        repeats: false,
    },
    Binding {
        shown: "M, Shift M",
        about: "next, previous method",
        keys: &[
            (Key::Sign('m'), Command::Stage(StageCommand::MethodBeside(Step::Next))),
            (Key::ShiftSign('m'), Command::Stage(StageCommand::MethodBeside(Step::Previous))),
        ],
        repeats: false,
    },
    Binding {
        shown: "C",
        about: "solo / race of all methods",
        keys: &[(Key::Sign('c'), Command::Stage(StageCommand::ToggleRace))],
        repeats: false,
    },
    Binding {
        shown: "Space",
        about: "run / pause",
        keys: &[(Key::Space, Command::View(ViewCommand::TogglePause))],
        repeats: false,
    },
    Binding {
        shown: ", .",
        about: "one tick back, forward",
        keys: &[
            (Key::Sign(','), Command::Stage(StageCommand::Tick(Step::Previous))),
            (Key::Sign('.'), Command::Stage(StageCommand::Tick(Step::Next))),
        ],
        repeats: true,
    },
    Binding {
        shown: "Shift , .",
        about: "one second back, forward",
        keys: &[
            (Key::ShiftSign(','), Command::Stage(StageCommand::Second(Step::Previous))),
            (Key::ShiftSign('.'), Command::Stage(StageCommand::Second(Step::Next))),
        ],
        repeats: true,
    },
    Binding {
        shown: "W",
        about: "watch the selected lane blow up again",
        keys: &[(Key::Sign('w'), Command::Run(RunCommand::WatchAgain))],
        repeats: false,
    },
    Binding {
        shown: "Ctrl Z, Ctrl Shift Z",
        about: "undo, redo the last change",
        keys: &[
            (Key::ControlSign('z'), Command::Run(RunCommand::Undo)),
            (Key::ControlShiftSign('z'), Command::Run(RunCommand::Redo)),
        ],
        repeats: false,
    },
    Binding {
        shown: "Home",
        about: "restart",
        keys: &[(Key::Home, Command::Stage(StageCommand::Restart))],
        repeats: false,
    },
    Binding {
        shown: "[ ]",
        about: "tick rate down, up",
        keys: &[
            (Key::Sign('['), Command::Stage(StageCommand::TickRate(Step::Previous))),
            (Key::Sign(']'), Command::Stage(StageCommand::TickRate(Step::Next))),
        ],
        repeats: true,
    },
    Binding {
        shown: "- =",
        about: "speed down, up: ¼× to 16×",
        keys: &[
            (Key::Sign('-'), Command::Stage(StageCommand::Speed(Step::Previous))),
            (Key::Sign('='), Command::Stage(StageCommand::Speed(Step::Next))),
        ],
        repeats: true,
    },
    Binding {
        shown: "↑ ↓",
        about: "throttle (ship, helm, a law that uses it)",
        keys: &[
            (Key::Up, Command::Run(RunCommand::ThrottleUp)),
            (Key::Down, Command::Run(RunCommand::ThrottleDown)),
        ],
        repeats: true,
    },
    Binding {
        shown: "← →",
        about: "rudder (helm, a law that uses it)",
        keys: &[
            (Key::Left, Command::Run(RunCommand::RudderLeft)),
            (Key::Right, Command::Run(RunCommand::RudderRight)),
        ],
        repeats: true,
    },
    Binding {
        shown: "K",
        about: "kick: an impulse at the next tick",
        keys: &[(Key::Sign('k'), Command::Run(RunCommand::Act(Action::Kick(1.0))))],
        repeats: false,
    },
    Binding {
        shown: "N, B",
        about: "next, previous scene",
        keys: &[
            (Key::Sign('n'), Command::Stage(StageCommand::SceneBeside(Step::Next))),
            (Key::Sign('b'), Command::Stage(StageCommand::SceneBeside(Step::Previous))),
        ],
        repeats: false,
    },
    Binding {
        shown: "O",
        about: "open a scene file; or drop one onto the window",
        keys: &[(Key::Sign('o'), Command::View(ViewCommand::AskForPath))],
        repeats: false,
    },
    Binding {
        shown: "S",
        about: "a spring of your own: its numbers, the recommended method, and its code",
        keys: &[(Key::Sign('s'), Command::View(ViewCommand::AskForSpring))],
        repeats: false,
    },
    Binding {
        shown: "G",
        about: "exact ghost on / off",
        keys: &[(Key::Sign('g'), Command::View(ViewCommand::ToggleGhost))],
        repeats: false,
    },
    Binding {
        shown: "I",
        about: "drawing between ticks: raw / extrapolated / linear / Hermite / monotone Hermite",
        keys: &[(Key::Sign('i'), Command::Run(RunCommand::NextInterpolation))],
        repeats: false,
    },
    Binding {
        shown: "L",
        about: "loop lab: one motion under every game loop",
        keys: &[(Key::Sign('l'), Command::Loop(LoopCommand::ToggleLab))],
        repeats: false,
    },
    Binding {
        shown: "V",
        about: "race, loop lab: lanes over each other / side by side",
        keys: &[(Key::Sign('v'), Command::Stage(StageCommand::ToggleArrangement))],
        repeats: false,
    },
    Binding {
        shown: "F3",
        about: "light / dark theme",
        keys: &[(Key::Function(3), Command::View(ViewCommand::ToggleTheme))],
        repeats: false,
    },
    Binding {
        shown: "Ctrl + − 0",
        about: "text and panels larger, smaller, back to normal",
        keys: &[
            (Key::ControlSign('+'), Command::View(ViewCommand::Scale(Step::Next))),
            // The same key unshifted.
            (Key::ControlSign('='), Command::View(ViewCommand::Scale(Step::Next))),
            (Key::ControlSign('-'), Command::View(ViewCommand::Scale(Step::Previous))),
            (Key::ControlSign('0'), Command::View(ViewCommand::UsualScale)),
        ],
        repeats: true,
    },
    Binding {
        shown: "T, Shift T",
        about: "next, previous instrument; loop lab: display",
        keys: &[
            (Key::Sign('t'), Command::Stage(StageCommand::InstrumentBeside(Step::Next))),
            (Key::ShiftSign('t'), Command::Stage(StageCommand::InstrumentBeside(Step::Previous))),
        ],
        repeats: false,
    },
    Binding {
        shown: "Enter",
        about: "enlarge the instrument over the stage",
        keys: &[(Key::Enter, Command::View(ViewCommand::ToggleEnlarged))],
        repeats: false,
    },
    Binding {
        shown: "Ctrl C, Ctrl E",
        about: "copy the instrument's values, or on a lane its method, or an engine's settings, as code; save as PNG, SVG and CSV",
        keys: &[
            (Key::ControlSign('c'), Command::View(ViewCommand::Copy)),
            (Key::ControlSign('e'), Command::Ask(DriverRequest::ExportInstrument)),
        ],
        repeats: false,
    },
    Binding {
        shown: "E",
        about: "inspector: parameters, methods and rates, edited while it runs",
        keys: &[(Key::Sign('e'), Command::Run(RunCommand::ToggleInspector))],
        repeats: false,
    },
    Binding {
        shown: "P, F12",
        about: "screenshot; the file's name is shown",
        keys: &[
            (Key::Sign('p'), Command::Ask(DriverRequest::Screenshot)),
            (Key::Function(12), Command::Ask(DriverRequest::Screenshot)),
        ],
        repeats: false,
    },
    Binding {
        shown: "F5, Ctrl S",
        about: "save the run as a scene file; its name is shown",
        keys: &[
            (Key::Function(5), Command::Ask(DriverRequest::Record)),
            (Key::ControlSign('s'), Command::Ask(DriverRequest::Record)),
        ],
        repeats: false,
    },
    Binding {
        shown: "X",
        about: "equal cost of all lanes on / off: cheap lanes get more substeps",
        keys: &[(Key::Sign('x'), Command::Run(RunCommand::ToggleEqualCost))],
        repeats: false,
    },
    Binding {
        shown: "F11",
        about: "full screen",
        keys: &[(Key::Function(11), Command::Ask(DriverRequest::ToggleFullScreen))],
        repeats: false,
    },
    Binding {
        shown: "F2",
        about: "guide: the chapter in stops, each with a prediction and a key to press",
        keys: &[(Key::Function(2), Command::View(ViewCommand::ToggleGuide))],
        repeats: false,
    },
    Binding {
        shown: "Page Up, Down",
        about: "previous, next stop of the guide, while it is open",
        keys: &[
            (Key::PageUp, Command::View(ViewCommand::StopBeside(Step::Previous))),
            (Key::PageDown, Command::View(ViewCommand::StopBeside(Step::Next))),
        ],
        repeats: false,
    },
    Binding {
        shown: "H, F1, ?",
        about: "help",
        keys: &[
            (Key::Sign('h'), Command::View(ViewCommand::ToggleHelp)),
            (Key::Function(1), Command::View(ViewCommand::ToggleHelp)),
            (Key::Sign('?'), Command::View(ViewCommand::ToggleHelp)),
        ],
        repeats: false,
    },
    Binding {
        shown: "Esc",
        about: "let go of a body, close the overlay, the guide, the instrument, the inspector, leave the loop lab, or quit: twice where something would be lost",
        keys: &[(Key::Escape, Command::View(ViewCommand::Escape))],
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::BODIES;

    #[test]
    fn the_keys_of_an_input_name_the_bodies_that_take_it_and_no_others() {
        for (input, key) in [("throttle", Key::Up), ("rudder", Key::Left)] {
            let (_, binding) = command_for(key).unwrap();
            let words: Vec<&str> = binding.about.split(|c: char| !c.is_alphabetic()).collect();
            assert!(words.contains(&"law"), "{}", binding.about);
            for body in BODIES.iter() {
                let is_named = words.contains(&body.id);
                assert_eq!(
                    is_named,
                    body.inputs.contains(&input),
                    "{}: {}",
                    body.id,
                    binding.about
                );
            }
        }
    }
}
