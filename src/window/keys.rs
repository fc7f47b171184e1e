//! Translates the window system's keys to the program's and turns them into commands.

use winit::event::{ElementState, KeyEvent};
use winit::keyboard::{Key as Logical, KeyCode, ModifiersState, NamedKey, PhysicalKey};

use super::App;
use crate::studio::{Command, Dialog, Key, ViewCommand};
use crate::view::{Meaning, Modifiers, bound_key, command_of};

/// Translates the window system's modifier keys.
pub(super) fn modifiers(state: ModifiersState) -> Modifiers {
    let (control, other) = match cfg!(target_os = "macos") {
        true => (state.super_key(), state.control_key()),
        false => (state.control_key(), state.super_key()),
    };
    Modifiers { shift: state.shift_key(), control, other: other || state.alt_key() }
}

impl App {
    /// Handles a key unless it is meant for a panel. Returns whether the key was handled.
    pub(super) fn key(&mut self, event: &KeyEvent, panels: &egui::Context) -> bool {
        if event.state != ElementState::Pressed {
            return false;
        }
        let Some(key) = key(event, self.held) else { return false };
        if self.asks_for_path() {
            // Close it at once: the next key is no longer text.
            let closes = key == Key::Escape;
            if closes {
                self.frames.queue([Command::View(ViewCommand::CloseDialog)]);
                if let Some(field) = panels.memory(|memory| memory.focused()) {
                    panels.memory_mut(|memory| memory.surrender_focus(field));
                }
            }
            return closes;
        }
        let Some(command) = command_of(key, event.repeat, panels) else { return false };
        self.frames.queue(command);
        true
    }

    /// Whether the path field is open but has no focus yet, because no frame has shown it.
    pub(super) fn waits_for_field(&self) -> bool {
        let panels = self.canvas.as_ref().map(|canvas| canvas.egui.egui_ctx());
        matches!(self.frames.studio.viewer.dialog(), Some(Dialog::Path { .. }))
            && panels.is_some_and(|panels| !panels.text_edit_focused())
    }

    /// Whether keys are text for the path field, once the queued commands are applied.
    fn asks_for_path(&self) -> bool {
        let is_open = matches!(self.frames.studio.viewer.dialog(), Some(Dialog::Path { .. }));
        self.frames.queued().iter().fold(is_open, |is_open, command| match command {
            Command::View(ViewCommand::AskForPath | ViewCommand::AskForRun) => true,
            // `OpenTypedPath` closes the field only if the scene can be opened.
            Command::View(ViewCommand::CloseDialog) => false,
            _ => is_open,
        })
    }
}

/// The key of an event, if it can be bound to a command.
fn key(event: &KeyEvent, held: Modifiers) -> Option<Key> {
    let meaning = match &event.logical_key {
        Logical::Named(name) => named(*name).map(Meaning::Named),
        Logical::Character(text) => Some(Meaning::Text(text)),
        _ => None,
    };
    let place = match event.physical_key {
        PhysicalKey::Code(code) => place(code),
        PhysicalKey::Unidentified(_) => None,
    };
    // A key at a digit's place is always that digit.
    bound_key(place, meaning.or(place.map(|_| Meaning::Text("")))?, held)
}

fn named(name: NamedKey) -> Option<Key> {
    Some(match name {
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
        NamedKey::F4 => Key::Function(4),
        NamedKey::F5 => Key::Function(5),
        NamedKey::F11 => Key::Function(11),
        NamedKey::F12 => Key::Function(12),
        _ => return None,
    })
}

/// The sign at this place on a keyboard of the United States: a digit, the comma or the point.
fn place(code: KeyCode) -> Option<char> {
    Some(match code {
        KeyCode::Comma => ',',
        KeyCode::Period => '.',
        KeyCode::Digit0 | KeyCode::Numpad0 => '0',
        KeyCode::Digit1 | KeyCode::Numpad1 => '1',
        KeyCode::Digit2 | KeyCode::Numpad2 => '2',
        KeyCode::Digit3 | KeyCode::Numpad3 => '3',
        KeyCode::Digit4 | KeyCode::Numpad4 => '4',
        KeyCode::Digit5 | KeyCode::Numpad5 => '5',
        KeyCode::Digit6 | KeyCode::Numpad6 => '6',
        KeyCode::Digit7 | KeyCode::Numpad7 => '7',
        KeyCode::Digit8 | KeyCode::Numpad8 => '8',
        KeyCode::Digit9 | KeyCode::Numpad9 => '9',
        _ => return None,
    })
}
