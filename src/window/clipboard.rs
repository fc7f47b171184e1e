//! The clipboard of the desktop, for copying from text fields and pasting into them. egui's own clipboard keeps a
//! text within the window, so it is filled from the desktop's before each paste.

use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::keyboard::{Key as Logical, KeyCode, NamedKey, PhysicalKey};

use super::App;
use super::error::reason;
use crate::run::link::MAX_LETTERS;
use crate::view::Modifiers;

/// The clipboard, opened at the first copy or paste.
#[derive(Default)]
pub(super) struct Clipboard {
    /// Kept open: on X and on Wayland, a copied text is available only while its program offers it.
    open: Option<arboard::Clipboard>,
}

impl Clipboard {
    /// Puts a text on the clipboard.
    ///
    /// # Errors
    /// The reason why there is no clipboard, or why it refuses the text.
    pub(super) fn set_text(&mut self, text: String) -> Result<(), String> {
        self.open_clipboard()?.set_text(text).map_err(|error| reason(&error))
    }

    /// Puts the texts copied from text fields on the clipboard.
    pub(super) fn set_copied(&mut self, commands: &[egui::OutputCommand]) {
        for command in commands {
            if let egui::OutputCommand::CopyText(text) = command
                && let Err(reason) = self.set_text(text.clone())
            {
                log::warn!("copies can be pasted in this window only: {reason}");
            }
        }
    }

    /// The text on the clipboard, cut to the longest field. Empty if the clipboard has something else; `None` if it
    /// cannot be read.
    fn text(&mut self) -> Option<String> {
        match self.open_clipboard().ok()?.get_text() {
            Ok(text) => Some(text.chars().take(MAX_LETTERS).collect()),
            Err(arboard::Error::ContentNotAvailable) => Some(String::new()),
            Err(error) => {
                log::warn!("cannot paste from other programs: {}", reason(&error));
                None
            }
        }
    }

    fn open_clipboard(&mut self) -> Result<&mut arboard::Clipboard, String> {
        let clipboard = match self.open.take() {
            Some(clipboard) => clipboard,
            None => arboard::Clipboard::new().map_err(|error| reason(&error))?,
        };
        Ok(self.open.insert(clipboard))
    }
}

impl App {
    /// Gives the clipboard's text to egui, if this event pastes.
    pub(super) fn fetch_pasted(&mut self, event: &WindowEvent) {
        if let WindowEvent::KeyboardInput { event, is_synthetic: false, .. } = event
            && is_paste(event, self.held)
            && let Some(text) = self.clipboard.text()
            && let Some(canvas) = &mut self.canvas
        {
            canvas.egui.set_clipboard_text(text);
        }
    }
}

/// Whether egui pastes at this key. A layout without Latin letters pastes with the key in the place of V.
fn is_paste(event: &KeyEvent, held: Modifiers) -> bool {
    let is_v = match &event.logical_key {
        Logical::Character(sign) if sign.is_ascii() => sign.eq_ignore_ascii_case("v"),
        _ => event.physical_key == PhysicalKey::Code(KeyCode::KeyV),
    };
    let is_insert = cfg!(windows) && event.logical_key == Logical::Named(NamedKey::Insert);
    let is_paste = event.logical_key == Logical::Named(NamedKey::Paste);
    event.state == ElementState::Pressed
        && (is_paste || is_v && held.control || is_insert && held.shift)
}
