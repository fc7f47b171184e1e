//! Maps the keyboard events of a window or a browser to the program's keys and their commands.

use crate::studio::{Command, Key, command_for};

/// The modifier keys that are held down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// Shift.
    pub shift: bool,
    /// Control, or Command on a Mac.
    pub control: bool,
    /// Any other modifier. The program binds no chord with it.
    pub other: bool,
}

/// Meaning of a key in the active keyboard layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning<'a> {
    /// A key without text.
    Named(Key),
    /// Text, mostly of one character.
    Text(&'a str),
}

/// The bindable key of an event, if it has one. `place` is the character at the key's position on a US keyboard. Only
/// digits, the comma and the point depend on it.
pub fn bound_key(place: Option<char>, meaning: Meaning<'_>, held: Modifiers) -> Option<Key> {
    if held.other {
        return None;
    }
    let shift = held.shift;
    match meaning {
        // Goes by layout, unless the layout turns the chord into a control character.
        Meaning::Text(text) if held.control => {
            let sign = sign_of(text).filter(|sign| !sign.is_control())?;
            Some(match shift && sign.is_alphabetic() {
                true => Key::ControlShiftSign(lower(sign)),
                false => Key::ControlSign(lower(sign)),
            })
        }
        Meaning::Named(_) if held.control => None,
        Meaning::Text("<" | ">" | "," | ".") if shift && matches!(place, Some(',' | '.')) => {
            place.map(Key::ShiftSign)
        }
        // Digits go by position, because some layouts have them behind Shift. But if a digit's key yields one of
        // these signs, through Shift or AltGr, the sign counts.
        meaning => match (place.and_then(|place| place.to_digit(10)), meaning) {
            (Some(digit), meaning) if !matches!(meaning, Meaning::Text("[" | "]" | "=")) => {
                Some(Key::Digit(digit as u8))
            }
            (_, Meaning::Named(key)) => Some(key),
            (_, Meaning::Text(text)) => {
                let sign = sign_of(text)?;
                // A keyboard on a screen has digits without a place.
                if let Some(digit) = sign.to_digit(10).filter(|_| place.is_none()) {
                    return Some(Key::Digit(digit as u8));
                }
                Some(match shift && sign.is_alphabetic() {
                    true => Key::ShiftSign(lower(sign)),
                    false => Key::Sign(lower(sign)),
                })
            }
        },
    }
}

/// The only character of a text. The name of a key, such as `Control` or `Dead`, has none.
fn sign_of(text: &str) -> Option<char> {
    let mut signs = text.chars();
    signs.next().filter(|_| signs.next().is_none())
}

fn lower(sign: char) -> char {
    sign.to_lowercase().next().unwrap_or(sign)
}

/// The command of a pressed key. `None` if the key is for a panel or has no binding. `Some(None)` if the key is held
/// and its command does not repeat.
pub fn command_of(key: Key, is_repeated: bool, panels: &egui::Context) -> Option<Option<Command>> {
    // Escape closes a menu.
    let closes_menu = key == Key::Escape
        && (egui::Popup::is_any_open(panels) || super::panels::has_faults(panels));
    let focus = Focus::of(panels.egui_wants_keyboard_input(), panels.text_edit_focused());
    if focus.takes_key(key) || closes_menu {
        return None;
    }
    let (command, binding) = command_for(key)?;
    Some((!is_repeated || binding.repeats).then_some(command))
}

/// The kind of widget with the keyboard focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Focus {
    /// No widget: every key goes to the program.
    Nothing,
    /// A widget that responds to some keys.
    Widget,
    /// A text field.
    Text,
}

impl Focus {
    fn of(widget_has_focus: bool, text_is_typed: bool) -> Self {
        match (widget_has_focus, text_is_typed) {
            (_, true) => Focus::Text,
            (true, false) => Focus::Widget,
            (false, false) => Focus::Nothing,
        }
    }

    /// Whether the focused widget takes a key.
    fn takes_key(self, key: Key) -> bool {
        match self {
            Focus::Nothing => false,
            Focus::Widget => works_widgets(key),
            Focus::Text => !matches!(key, Key::Function(_)),
        }
    }
}

/// Whether a focused widget responds to this key.
fn works_widgets(key: Key) -> bool {
    matches!(
        key,
        Key::Space
            | Key::Up
            | Key::Down
            | Key::Left
            | Key::Right
            | Key::Home
            | Key::Enter
            | Key::Escape
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::{KEYS, StageCommand};

    fn pressed(place: Option<char>, text: &str, shift: bool) -> Option<Key> {
        held(place, text, Modifiers { shift, ..Modifiers::default() })
    }

    fn held(place: Option<char>, text: &str, held: Modifiers) -> Option<Key> {
        bound_key(place, Meaning::Text(text), held)
    }

    #[test]
    fn digits_are_bound_by_position_and_letters_by_layout() {
        assert_eq!(pressed(Some('1'), "&", false), Some(Key::Digit(1)));
        assert_eq!(pressed(None, "a", false), Some(Key::Sign('a')));
        assert_eq!(pressed(None, "M", true), Some(Key::ShiftSign('m')));
        assert_eq!(pressed(None, "M", false), Some(Key::Sign('m')));
        assert_eq!(pressed(None, "?", true), Some(Key::Sign('?')));
        assert_eq!(pressed(Some('8'), "[", false), Some(Key::Sign('[')));
        assert_eq!(pressed(Some('0'), "=", true), Some(Key::Sign('=')));
        let end = bound_key(Some('1'), Meaning::Named(Key::Home), Modifiers::default());
        assert_eq!(end, Some(Key::Digit(1)));
    }

    /// Browser names of keys that are not signs. `Control` comes before each chord that begins with it.
    const NAMES: &str = "Alt AltGraph AltLeft AudioVolumeUp Backspace BrowserBack CapsLock Clear ContextMenu Control \
        Convert Copy Cut Dead Delete End Enter Escape Fn FnLock F4 F13 GroupNext Hyper Insert KanaMode LaunchMail \
        MediaPlayPause Meta NumLock OS Paste Pause PrintScreen Process ScrollLock Select Shift Super Symbol Tab \
        Undo Unidentified ZoomIn";

    #[test]
    fn a_named_key_is_no_character_under_any_modifier() {
        for name in NAMES.split_whitespace() {
            for bits in 0..4 {
                let modifiers =
                    Modifiers { control: bits & 1 > 0, shift: bits & 2 > 0, other: false };
                assert_eq!(held(None, name, modifiers), None, "{name}, {modifiers:?}");
            }
        }
    }

    #[test]
    fn shift_and_control_select_other_keys_and_other_modifiers_no_key() {
        assert_eq!(pressed(Some(','), "<", true), Some(Key::ShiftSign(',')));
        assert_eq!(pressed(Some('.'), ">", true), Some(Key::ShiftSign('.')));
        assert_eq!(pressed(Some(','), ",", false), Some(Key::Sign(',')));
        // If Shift turns the comma's key into another sign, that sign counts.
        assert_eq!(pressed(Some(','), "?", true), Some(Key::Sign('?')));
        let control = Modifiers { control: true, ..Modifiers::default() };
        assert_eq!(held(None, "z", control), Some(Key::ControlSign('z')));
        assert_eq!(bound_key(None, Meaning::Named(Key::Home), control), None);
        let both = Modifiers { shift: true, ..control };
        assert_eq!(held(None, "Z", both), Some(Key::ControlShiftSign('z')));
        assert_eq!(held(None, "+", both), Some(Key::ControlSign('+')));
        let alt = Modifiers { other: true, ..Modifiers::default() };
        assert_eq!(held(None, "n", alt), None);
    }

    #[test]
    fn every_bound_key_is_bound_once() {
        let bound: Vec<Key> =
            KEYS.iter().flat_map(|b| b.keys.iter().map(|(key, _)| *key)).collect();
        for (i, key) in bound.iter().enumerate() {
            assert!(!bound[..i].contains(key), "{key:?} is bound twice");
        }
        let (command, _) = command_for(Key::Digit(1)).unwrap();
        assert_eq!(command, Command::Stage(StageCommand::Pick(0)));
    }
}
