//! The clipboard of the desktop.

use super::error::reason;

/// The clipboard, opened when something is copied first.
#[derive(Default)]
pub(super) struct Clipboard {
    /// Kept: on X and on Wayland what was copied is there as long as its program offers it.
    open: Option<arboard::Clipboard>,
}

impl Clipboard {
    /// Puts a text on the clipboard.
    ///
    /// # Errors
    /// Why there is none, or why it does not take the text.
    pub(super) fn set_text(&mut self, text: String) -> Result<(), String> {
        let clipboard = match self.open.take() {
            Some(clipboard) => clipboard,
            None => arboard::Clipboard::new().map_err(|error| reason(&error))?,
        };
        self.open.insert(clipboard).set_text(text).map_err(|error| reason(&error))
    }
}
