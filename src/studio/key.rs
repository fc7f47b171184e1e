//! The keys and their commands. The table [`KEYS`] is the only source for the window, the help overlay and `regatta
//! list keys`.

use std::fmt;

use super::command::Command::{self, Ask, Loop, Run, Stage, View};
use super::command::{RunCommand, StageCommand, ViewCommand};
use super::display::DriverRequest;
use super::step::Step;
use crate::loops::loop_lab::LoopCommand;
use crate::scene::Action;

/// A key that can have a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A digit by its position on the keyboard, so that it needs no Shift on any layout.
    Digit(u8),
    /// A lower-case letter or a sign, as the keyboard's layout produces it.
    Sign(char),
    /// A lower-case letter or a sign with Shift held.
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

/// The name of the key for people.
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

impl Key {
    /// Whether browsers use the key for something that visitors expect on every page: the address, reload, developer
    /// tools, full screen, zoom. A page leaves such a key to the browser.
    pub fn is_browsers(self) -> bool {
        matches!(
            self,
            Key::Function(5 | 11 | 12) | Key::ControlSign('l' | '+' | '=' | '-' | '0' | '1'..='9')
        )
    }
}

/// An entry of the key table.
#[derive(Debug)]
pub struct Binding {
    /// The keys, as the help shows them.
    pub shown: &'static str,
    /// Description of the keys' effect, for people.
    pub about: &'static str,
    /// Description of the effect on a page, if it differs there.
    pub about_on_page: Option<&'static str>,
    /// Each key with its command.
    pub keys: &'static [(Key, Command)],
    /// Whether the command repeats while the key is held.
    pub repeats: bool,
}

impl Binding {
    /// Returns the keys and their effect, as the help of a page shows them, or `None` if all the keys belong to the
    /// browser.
    pub fn on_page(&self) -> Option<(String, &'static str)> {
        let about = self.about_on_page.unwrap_or(self.about);
        let own = self.keys.iter().map(|(key, _)| key).filter(|key| !key.is_browsers());
        let own: Vec<String> = own.map(Key::to_string).collect();
        match own.len() {
            0 => None,
            count if count == self.keys.len() => Some((self.shown.to_owned(), about)),
            _ => Some((own.join(", "), about)),
        }
    }
}

/// Builds the table of keys. An entry has `once` or `repeating`, the keys as shown, their effect, their effect on a
/// page if it differs, and each key with its command.
macro_rules! keys {
    ($($often:ident $shown:literal $about:literal $(or $page:literal)?: $($key:ident $(($of:literal))? => $command:expr),+;)+) => {
        &[$(Binding {
            about_on_page: keys!(@page $($page)?),
            ..$often($shown, $about, &[$((Key::$key $(($of))?, $command)),+])
        }),+]
    };
    (@page) => { None };
    (@page $page:literal) => { Some($page) };
}

/// Number of methods that digits pick: with the keys 1 to 9, and 0.
pub const DIGITS: usize = 10;

/// Returns the digit of the key that picks the entry with this index, one of the first [`DIGITS`].
pub fn digit_of(index: usize) -> usize {
    (index + 1) % DIGITS
}

/// Returns the digit of the key that picks the entry with this index, or a dot if it has no key.
pub fn mark_of(index: usize) -> String {
    if index < DIGITS { digit_of(index).to_string() } else { "•".into() }
}

/// Every key and its command.
pub static KEYS: &[Binding] = keys! {
    once "1 … 9, 0" "solo: this method takes over at once; race, loop lab: select that lane; bands: show its band or take it away":
        Digit(1) => Stage(StageCommand::Pick(0)), Digit(2) => Stage(StageCommand::Pick(1)),
        Digit(3) => Stage(StageCommand::Pick(2)), Digit(4) => Stage(StageCommand::Pick(3)),
        Digit(5) => Stage(StageCommand::Pick(4)), Digit(6) => Stage(StageCommand::Pick(5)),
        Digit(7) => Stage(StageCommand::Pick(6)), Digit(8) => Stage(StageCommand::Pick(7)),
        Digit(9) => Stage(StageCommand::Pick(8)), Digit(0) => Stage(StageCommand::Pick(9));
    once "M, Shift M" "next, previous method":
        Sign('m') => Stage(StageCommand::MethodBeside(Step::Next)),
        ShiftSign('m') => Stage(StageCommand::MethodBeside(Step::Previous));
    once "C" "solo / race of all methods":
        Sign('c') => Stage(StageCommand::ToggleRace);
    once "Space" "run / pause":
        Space => View(ViewCommand::TogglePause);
    repeating ", ." "one tick back, forward":
        Sign(',') => Stage(StageCommand::Tick(Step::Previous)), Sign('.') => Stage(StageCommand::Tick(Step::Next));
    repeating "Shift , ." "one second back, forward":
        ShiftSign(',') => Stage(StageCommand::Second(Step::Previous)),
        ShiftSign('.') => Stage(StageCommand::Second(Step::Next));
    once "W" "watch the selected lane blow up again":
        Sign('w') => Run(RunCommand::WatchAgain);
    once "Ctrl Z, Ctrl Shift Z" "undo, redo the last change":
        ControlSign('z') => Run(RunCommand::Undo), ControlShiftSign('z') => Run(RunCommand::Redo);
    once "Home" "restart":
        Home => Stage(StageCommand::Restart);
    repeating "[ ]" "tick rate down, up":
        Sign('[') => Stage(StageCommand::TickRate(Step::Previous)),
        Sign(']') => Stage(StageCommand::TickRate(Step::Next));
    repeating "- =" "speed down, up: ¼× to 16×":
        Sign('-') => Stage(StageCommand::Speed(Step::Previous)), Sign('=') => Stage(StageCommand::Speed(Step::Next));
    repeating "↑ ↓" "throttle (ship, helm, a law that uses it)":
        Up => Run(RunCommand::ThrottleUp), Down => Run(RunCommand::ThrottleDown);
    repeating "← →" "rudder (helm, a law that uses it)":
        Left => Run(RunCommand::RudderLeft), Right => Run(RunCommand::RudderRight);
    once "K" "kick: an impulse at the next tick":
        Sign('k') => Run(RunCommand::Act(Action::Kick(1.0)));
    once "J" "bounce: the next rule for impacts (ball)":
        Sign('j') => Run(RunCommand::NextImpact);
    once "N, B" "next, previous scene":
        Sign('n') => Stage(StageCommand::SceneBeside(Step::Next)),
        Sign('b') => Stage(StageCommand::SceneBeside(Step::Previous));
    once "O" "open a scene file; or drop one onto the window" or "open a scene file; or drop one onto the page; Ctrl V opens a copied link":
        Sign('o') => View(ViewCommand::AskForPath);
    once "Shift O" "compare the run with a recording: it runs beside as a ghost, from the first difference on":
        ShiftSign('o') => View(ViewCommand::AskForRun);
    once "S" "a spring of your own: its numbers, the recommended method, and its code":
        Sign('s') => View(ViewCommand::AskForSpring);
    once "Shift S" "my lines: type or paste a rule or a method, and watch it":
        ShiftSign('s') => View(ViewCommand::AskForLines);
    once "F" "a fan of futures: the next second under each method, a dot a tick":
        Sign('f') => View(ViewCommand::ToggleFutures);
    once "G" "exact ghost on / off":
        Sign('g') => View(ViewCommand::ToggleGhost);
    once "Shift G" "list of the book's figures 7-2 to 7-8: a digit opens one":
        ShiftSign('g') => View(ViewCommand::ToggleFigures);
    once "I" "drawing between ticks: raw / extrapolated / linear / Hermite / monotone Hermite":
        Sign('i') => Run(RunCommand::NextInterpolation);
    once "L" "loop lab: one motion under every game loop":
        Sign('l') => Loop(LoopCommand::ToggleLab);
    once "V" "race, loop lab: lanes over each other / side by side":
        Sign('v') => Stage(StageCommand::ToggleArrangement);
    once "F3" "light / dark theme":
        Function(3) => View(ViewCommand::ToggleTheme);
    repeating "Ctrl + − 0" "text and panels larger, smaller, back to normal":
        ControlSign('+') => View(ViewCommand::Scale(Step::Next)),
        ControlSign('=') => View(ViewCommand::Scale(Step::Next)),
        ControlSign('-') => View(ViewCommand::Scale(Step::Previous)),
        ControlSign('0') => View(ViewCommand::UsualScale);
    once "T" "measure: instruments, table and timeline round the stage; or the stage alone":
        Sign('t') => View(ViewCommand::ToggleMeasure);
    once "D, Shift D" "next, previous instrument; loop lab: display":
        Sign('d') => Stage(StageCommand::InstrumentBeside(Step::Next)),
        ShiftSign('d') => Stage(StageCommand::InstrumentBeside(Step::Previous));
    once "Enter" "enlarge the instrument over the stage":
        Enter => View(ViewCommand::Enter);
    once "Ctrl C, Ctrl E" "copy the instrument's values, or on a lane its method, or an engine's settings, as code; save as PNG, SVG and CSV":
        ControlSign('c') => View(ViewCommand::Copy), ControlSign('e') => Ask(DriverRequest::ExportInstrument);
    once "E" "Edit: parameters, methods and rates, while it runs":
        Sign('e') => Run(RunCommand::ToggleInspector);
    once "P, F12" "screenshot; the file's name is shown":
        Sign('p') => Ask(DriverRequest::Screenshot), Function(12) => Ask(DriverRequest::Screenshot);
    once "Shift P" "report: a picture with the run in it, which the program opens and checks" or "report: save the picture and the run":
        ShiftSign('p') => Ask(DriverRequest::Report);
    once "F5, Ctrl S" "save the run as a scene file; its name is shown":
        Function(5) => Ask(DriverRequest::Record), ControlSign('s') => Ask(DriverRequest::Record);
    once "Ctrl L" "copy the run as a link, which `regatta play` opens":
        ControlSign('l') => Ask(DriverRequest::CopyLink);
    once "X" "equal cost of all lanes on / off: cheap lanes get more substeps":
        Sign('x') => Run(RunCommand::ToggleEqualCost);
    once "F4" "frames drawn in a second, and milliseconds of work on each, on / off":
        Function(4) => View(ViewCommand::ToggleFrameRate);
    once "F11" "full screen":
        Function(11) => Ask(DriverRequest::ToggleFullScreen);
    once "F2" "guide: the chapter in stops, each with a prediction and a key to press":
        Function(2) => View(ViewCommand::ToggleGuide);
    once "Page Up, Down" "previous, next stop of the guide, while it is open":
        PageUp => View(ViewCommand::StopBeside(Step::Previous)),
        PageDown => View(ViewCommand::StopBeside(Step::Next));
    once "H, F1, ?" "help":
        Sign('h') => View(ViewCommand::ToggleHelp), Function(1) => View(ViewCommand::ToggleHelp),
        Sign('?') => View(ViewCommand::ToggleHelp);
    once "Esc" "take away, in turn: a body or the tick rate in hand, dialog, help, guide, Edit, instrument, fan, comparison, run beside, loop lab, race, full screen; then ask whether to quit: Enter quits"
        or "take away, in turn: a body or the tick rate in hand, dialog, help, guide, Edit, instrument, fan, comparison, run beside, loop lab, race; with Tab after it, leave the stage":
        Escape => View(ViewCommand::Escape);
};

/// Creates an entry whose keys do not repeat while held.
const fn once(
    shown: &'static str,
    about: &'static str,
    keys: &'static [(Key, Command)],
) -> Binding {
    Binding { shown, about, about_on_page: None, keys, repeats: false }
}

/// Creates an entry whose keys repeat while held.
const fn repeating(
    shown: &'static str,
    about: &'static str,
    keys: &'static [(Key, Command)],
) -> Binding {
    Binding { repeats: true, ..once(shown, about, keys) }
}

/// Returns the command of `key`, and the entry of the table that has the key.
pub fn command_for(key: Key) -> Option<(Command, &'static Binding)> {
    KEYS.iter().find_map(|binding| {
        let (_, command) = binding.keys.iter().find(|(bound, _)| *bound == key)?;
        Some((command.clone(), binding))
    })
}

/// Returns the commands of the key that has this name for people, such as `Home` or `2`.
pub fn commands_named(name: &str) -> impl Iterator<Item = &'static Command> {
    let bound = KEYS.iter().flat_map(|binding| binding.keys);
    bound.filter(move |(key, _)| key.to_string() == name).map(|(_, command)| command)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::BODIES;

    #[test]
    fn the_help_of_the_page_omits_only_the_browsers_keys() {
        let shown: Vec<_> = KEYS.iter().filter_map(Binding::on_page).collect();
        for (key, _) in KEYS.iter().flat_map(|binding| binding.keys) {
            let is_word = |words: &str| words.split(", ").any(|word| word == key.to_string());
            let is_shown = shown.iter().any(|(keys, _)| is_word(keys));
            assert!(!(is_shown && key.is_browsers()), "{key}");
        }
        let browsers = [Key::Function(5), Key::Function(11), Key::Function(12)];
        assert!(browsers.into_iter().all(Key::is_browsers));
        let keys: Vec<&str> = shown.iter().map(|(keys, _)| &**keys).collect();
        for own in ["1 … 9, 0", "P", "Ctrl S", "Ctrl Z, Ctrl Shift Z", "H, F1, ?", "Esc"] {
            assert!(keys.contains(&own), "{own}: {keys:?}");
        }
        assert_eq!(shown.len() + 3, KEYS.len(), "F11, the address, and the size of type");
        assert!(shown.iter().all(|(_, about)| !about.contains("quit") && !about.contains('`')));
    }

    #[test]
    fn the_keys_of_an_input_name_exactly_its_bodies() {
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
