//! The keys of a page, as the program and its panels receive them.

use regatta::studio::Key;
use regatta::view::{Meaning, Modifiers, bound_key, egui};
use web_sys::KeyboardEvent;

/// A press or a release of a key.
pub(crate) struct Press {
    /// The browser's two names of the key: by the layout, and by its place on the keyboard.
    key: String,
    code: String,
    held: Modifiers,
    pub(crate) is_repeated: bool,
}

impl Press {
    pub(crate) fn of(event: &KeyboardEvent, is_mac: bool) -> Self {
        // AltGr selects another sign of a key, but Windows reports it as Control and Alt.
        let is_alt_gr = event.get_modifier_state("AltGraph");
        let (control, other) = match is_mac {
            true => (event.meta_key(), event.ctrl_key()),
            false => (event.ctrl_key(), event.meta_key()),
        };
        let held = Modifiers {
            shift: event.shift_key(),
            control: control && !is_alt_gr,
            other: (other || event.alt_key()) && !is_alt_gr,
        };
        Self { key: event.key(), code: event.code(), held, is_repeated: event.repeat() }
    }

    /// Returns the program's name of the key, unless the key is the [browser's](Key::is_browsers).
    pub(crate) fn bound(&self) -> Option<Key> {
        let place = self.code.strip_prefix("Digit").or(self.code.strip_prefix("Numpad"));
        let place = match self.code.as_str() {
            "Comma" => Some(','),
            "Period" => Some('.'),
            _ => place.and_then(|digit| digit.chars().next().filter(char::is_ascii_digit)),
        };
        let meaning = named(&self.key).map_or(Meaning::Text(&self.key), Meaning::Named);
        bound_key(place, meaning, self.held).filter(|key| !key.is_browsers())
    }

    /// Whether the key is part of a chord, which writes nothing.
    pub(crate) fn is_chord(&self) -> bool {
        self.held.control || self.held.other
    }

    pub(crate) fn is_tab(&self) -> bool {
        self.key == "Tab"
    }

    /// Whether the key does nothing by itself.
    pub(crate) fn is_modifier(&self) -> bool {
        matches!(&*self.key, "Shift" | "Control" | "Alt" | "AltGraph" | "Meta" | "CapsLock")
    }

    pub(crate) fn is_escape(&self) -> bool {
        self.key == "Escape"
    }

    /// Whether the key writes a letter or another sign.
    fn is_sign(&self) -> bool {
        self.key.chars().count() == 1 && !self.is_chord()
    }

    /// Whether the key changes the text of a field, or moves in the text.
    pub(crate) fn edits(&self) -> bool {
        let moves = named(&self.key).is_some_and(|key| !matches!(key, Key::Function(_)));
        let is_named = moves || matches!(self.key.as_str(), "Backspace" | "Delete" | "End");
        self.is_sign() || is_named && !self.is_chord()
    }

    /// Returns the held modifiers in the type of the panels.
    pub(crate) fn modifiers(&self) -> egui::Modifiers {
        let Modifiers { shift, control, other } = self.held;
        egui::Modifiers { alt: other, ctrl: control, shift, mac_cmd: false, command: control }
    }

    /// Returns the events of this press or release for the panels.
    pub(crate) fn events(&self, pressed: bool) -> Vec<egui::Event> {
        let modifiers = self.modifiers();
        let event = |key| {
            let (physical_key, repeat) = (egui::Key::from_name(&self.code), self.is_repeated);
            egui::Event::Key { key, physical_key, pressed, repeat, modifiers }
        };
        let text = (pressed && self.is_sign()).then(|| egui::Event::Text(self.key.clone()));
        egui::Key::from_name(&self.key).map(event).into_iter().chain(text).collect()
    }
}

fn named(key: &str) -> Option<Key> {
    Some(match key {
        " " => Key::Space,
        "ArrowUp" => Key::Up,
        "ArrowDown" => Key::Down,
        "ArrowLeft" => Key::Left,
        "ArrowRight" => Key::Right,
        "Home" => Key::Home,
        "PageUp" => Key::PageUp,
        "PageDown" => Key::PageDown,
        "Enter" => Key::Enter,
        "Escape" => Key::Escape,
        "F1" => Key::Function(1),
        "F2" => Key::Function(2),
        "F3" => Key::Function(3),
        "F4" => Key::Function(4),
        "F5" => Key::Function(5),
        "F11" => Key::Function(11),
        "F12" => Key::Function(12),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(key: &str, code: &str, control: bool) -> Option<Key> {
        let held = Modifiers { control, ..Modifiers::default() };
        Press { key: key.into(), code: code.into(), held, is_repeated: false }.bound()
    }

    #[test]
    fn keys_of_the_browser_are_left_to_the_browser() {
        assert_eq!(bound("&", "Digit1", false), Some(Key::Digit(1)));
        assert_eq!(bound("End", "Numpad1", false), Some(Key::Digit(1)));
        assert_eq!(bound("c", "KeyC", false), Some(Key::Sign('c')));
        assert_eq!(bound(" ", "Space", false), Some(Key::Space));
        assert_eq!(bound("s", "KeyS", true), Some(Key::ControlSign('s')));
        assert_eq!(bound("F3", "F3", false), Some(Key::Function(3)));
        for (key, code, control) in [
            ("F5", "F5", false),
            ("F12", "F12", false),
            ("l", "KeyL", true),
            ("+", "Equal", true),
            ("0", "Digit0", true),
        ] {
            assert_eq!(bound(key, code, control), None, "{key}");
        }
        // These keys are neither a letter nor a known name.
        assert_eq!(bound("Shift", "ShiftLeft", false), None);
        assert_eq!(bound("Dead", "Quote", false), None);
    }
}
