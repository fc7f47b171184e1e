//! Saves the run as a scene file, for `regatta play`, `capture`, `advise` and `verify`.

use std::path::PathBuf;

use crate::atomic_file::{IfExists, write_file};
use crate::studio::Studio;

/// Saves the run so far under a new name, and returns a notice with the name or the error.
pub(super) fn save(studio: &mut Studio) -> String {
    match try_save(studio) {
        Ok(path) => {
            studio.deck.note_saved();
            format!("Saved {0}. Check it with: regatta verify {0}", path.display())
        }
        Err(reason) => format!("no recording: {reason}"),
    }
}

fn try_save(studio: &Studio) -> Result<PathBuf, String> {
    let name = studio.deck.recording_file_name();
    let text = studio.deck.recording().map_err(|error| error.to_string())?;
    write_file(name.as_ref(), text.as_bytes(), IfExists::Beside)
        .map_err(|error| format!("cannot write {name} here: {error}"))
}
