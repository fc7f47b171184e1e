//! Translates the window system's keys to the program's and turns them into commands.

use winit::event::{ElementState, KeyEvent};
use winit::keyboard::{Key as Logical, KeyCode, ModifiersState, NamedKey, PhysicalKey};

use super::App;
use crate::lab::studio::{Command, Dialog, Key, ViewCommand, command_for};

/// The modifier keys that are held down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Modifiers {
    pub(super) shift: bool,
    /// Control, or Command on a Mac.
    pub(super) control: bool,
    /// Any other modifier. The program binds no chord with it.
    pub(super) other: bool,
}

impl From<ModifiersState> for Modifiers {
    fn from(state: ModifiersState) -> Self {
        let (control, other) = match cfg!(target_os = "macos") {
            true => (state.super_key(), state.control_key()),
            false => (state.control_key(), state.super_key()),
        };
        Self { shift: state.shift_key(), control, other: other || state.alt_key() }
    }
}

impl App {
    /// Handles a key unless it is meant for a panel. Returns whether it did.
    pub(super) fn key(
        &mut self,
        event: &KeyEvent,
        widget_has_focus: bool,
        panels: &egui::Context,
    ) -> bool {
        if event.state != ElementState::Pressed {
            return false;
        }
        let Some(key) = key(event, self.held) else { return false };
        if self.asks_for_path() {
            // At once: the next key is not text any more.
            let closes = key == Key::Escape;
            if closes {
                self.asked.push(Command::View(ViewCommand::CloseDialog));
                let field = panels.memory(|memory| memory.focused());
                field.into_iter().for_each(|id| panels.memory_mut(|m| m.surrender_focus(id)));
            }
            return closes;
        }
        let menu_is_open = egui::Popup::is_any_open(panels);
        // Escape closes a menu.
        let focus = Focus::of(widget_has_focus, panels.text_edit_focused());
        if focus.takes(key) || menu_is_open && key == Key::Escape {
            return false;
        }
        let Some((command, binding)) = command_for(key) else { return false };
        if !event.repeat || binding.repeats {
            self.asked.push(command);
        }
        true
    }

    /// Whether the path field is open but has no focus yet, because no frame has shown it.
    pub(super) fn waits_for_field(&self) -> bool {
        let panels = self.canvas.as_ref().map(|canvas| canvas.egui.egui_ctx());
        matches!(self.studio.viewer().dialog(), Some(Dialog::Path { .. }))
            && panels.is_some_and(|panels| !panels.text_edit_focused())
    }

    /// Whether keys are text for the path field, once the commands that wait for the next frame are applied.
    fn asks_for_path(&self) -> bool {
        let is_open = matches!(self.studio.viewer().dialog(), Some(Dialog::Path { .. }));
        self.asked.iter().fold(is_open, |is_open, command| match command {
            Command::View(ViewCommand::AskForPath | ViewCommand::AskForRun) => true,
            // `OpenTypedPath` closes the field only if the scene can be opened.
            Command::View(ViewCommand::CloseDialog) => false,
            _ => is_open,
        })
    }
}

/// The key of an event, if it can be bound to a command.
fn key(event: &KeyEvent, held: Modifiers) -> Option<Key> {
    from_parts(event.physical_key, &event.logical_key, held)
}

/// The kind of widget that has the keyboard focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Focus {
    /// No widget: every key is for the program.
    Nothing,
    /// A widget that responds to some keys.
    Widget,
    /// A text field.
    Text,
}

impl Focus {
    pub(super) fn of(widget_has_focus: bool, text_is_typed: bool) -> Self {
        match (widget_has_focus, text_is_typed) {
            (_, true) => Focus::Text,
            (true, false) => Focus::Widget,
            (false, false) => Focus::Nothing,
        }
    }

    /// Whether a key is for the focused widget.
    pub(super) fn takes(self, key: Key) -> bool {
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

fn from_parts(physical: PhysicalKey, logical: &Logical, held: Modifiers) -> Option<Key> {
    if held.other {
        return None;
    }
    if held.control {
        // By the layout, unless it turns the chord into a control character.
        let Logical::Character(text) = logical else { return None };
        let sign = text.chars().next().filter(|sign| !sign.is_control());
        let sign = sign.and_then(|sign| sign.to_lowercase().next());
        return sign.map(|sign| match held.shift && sign.is_alphabetic() {
            true => Key::ControlShiftSign(sign),
            false => Key::ControlSign(sign),
        });
    }
    let shift = held.shift;
    if let PhysicalKey::Code(code @ (KeyCode::Comma | KeyCode::Period)) = physical
        && shift
        && matches!(logical, Logical::Character(sign) if ["<", ">", ",", "."].contains(&sign.as_str()))
    {
        return Some(Key::ShiftSign(if code == KeyCode::Comma { ',' } else { '.' }));
    }
    // By position, because some layouts have the digits behind Shift. But if a digit's key yields one of these
    // signs, through Shift or AltGr, the sign is meant.
    if let PhysicalKey::Code(code) = physical
        && let Some(digit) = digit(code)
        && !matches!(logical, Logical::Character(sign) if ["[", "]", "="].contains(&sign.as_str()))
    {
        return Some(Key::Digit(digit));
    }
    match logical {
        Logical::Named(named) => Some(match named {
            NamedKey::Space => Key::Space,
            NamedKey::ArrowUp => Key::Up,
            NamedKey::ArrowDown => Key::Down,
            NamedKey::ArrowLeft => Key::Left,
            NamedKey::ArrowRight => Key::Right,
            NamedKey::Home => Key::Home,
            NamedKey::PageUp => Key::PageUp,
            NamedKey::PageDown => Key::PageDown,
            NamedKey::Enter => Key::Enter,
            NamedKey::Escape => Key::Escape,
            NamedKey::F1 => Key::Function(1),
            NamedKey::F2 => Key::Function(2),
            NamedKey::F3 => Key::Function(3),
            NamedKey::F5 => Key::Function(5),
            NamedKey::F11 => Key::Function(11),
            NamedKey::F12 => Key::Function(12),
            _ => return None,
        }),
        Logical::Character(text) => {
            let mut chars = text.chars();
            let (Some(sign), None) = (chars.next(), chars.next()) else { return None };
            let lower = sign.to_lowercase().next().unwrap_or(sign);
            Some(if shift && sign.is_alphabetic() {
                Key::ShiftSign(lower)
            } else {
                Key::Sign(lower)
            })
        }
        _ => None,
    }
}

fn digit(code: KeyCode) -> Option<u8> {
    Some(match code {
        KeyCode::Digit0 | KeyCode::Numpad0 => 0,
        KeyCode::Digit1 | KeyCode::Numpad1 => 1,
        KeyCode::Digit2 | KeyCode::Numpad2 => 2,
        KeyCode::Digit3 | KeyCode::Numpad3 => 3,
        KeyCode::Digit4 | KeyCode::Numpad4 => 4,
        KeyCode::Digit5 | KeyCode::Numpad5 => 5,
        KeyCode::Digit6 | KeyCode::Numpad6 => 6,
        KeyCode::Digit7 | KeyCode::Numpad7 => 7,
        KeyCode::Digit8 | KeyCode::Numpad8 => 8,
        KeyCode::Digit9 | KeyCode::Numpad9 => 9,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::studio::{KEYS, StageCommand};

    fn pressed(code: KeyCode, text: &str, shift: bool) -> Option<Key> {
        held(code, text, Modifiers { shift, ..Modifiers::default() })
    }

    fn held(code: KeyCode, text: &str, held: Modifiers) -> Option<Key> {
        from_parts(PhysicalKey::Code(code), &Logical::Character(text.into()), held)
    }

    #[test]
    fn digits_go_by_place_and_letters_by_layout() {
        assert_eq!(pressed(KeyCode::Digit1, "&", false), Some(Key::Digit(1)));
        assert_eq!(pressed(KeyCode::KeyQ, "a", false), Some(Key::Sign('a')));
        assert_eq!(pressed(KeyCode::KeyM, "M", true), Some(Key::ShiftSign('m')));
        assert_eq!(pressed(KeyCode::KeyM, "M", false), Some(Key::Sign('m')));
        assert_eq!(pressed(KeyCode::Slash, "?", true), Some(Key::Sign('?')));
        assert_eq!(pressed(KeyCode::Digit8, "[", false), Some(Key::Sign('[')));
        assert_eq!(pressed(KeyCode::Digit0, "=", true), Some(Key::Sign('=')));
    }

    #[test]
    fn shift_and_control_make_other_keys_and_other_modifiers_none() {
        assert_eq!(pressed(KeyCode::Comma, "<", true), Some(Key::ShiftSign(',')));
        assert_eq!(pressed(KeyCode::Period, ">", true), Some(Key::ShiftSign('.')));
        assert_eq!(pressed(KeyCode::Comma, ",", false), Some(Key::Sign(',')));
        // If Shift and the comma's key make another sign, that sign is meant.
        assert_eq!(pressed(KeyCode::Comma, "?", true), Some(Key::Sign('?')));
        let control = Modifiers { control: true, ..Modifiers::default() };
        assert_eq!(held(KeyCode::KeyZ, "z", control), Some(Key::ControlSign('z')));
        assert_eq!(held(KeyCode::KeyY, "z", control), Some(Key::ControlSign('z')));
        let both = Modifiers { shift: true, ..control };
        assert_eq!(held(KeyCode::KeyZ, "Z", both), Some(Key::ControlShiftSign('z')));
        assert_eq!(held(KeyCode::Equal, "+", both), Some(Key::ControlSign('+')));
        let alt = Modifiers { other: true, ..Modifiers::default() };
        assert_eq!(held(KeyCode::KeyN, "n", alt), None);
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
