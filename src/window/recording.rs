//! Saves the run as a scene file, for `regatta play`, `capture`, `advise` and `verify`.

use std::path::{Path, PathBuf};

use super::new_file::write_new;
use crate::lab::Lab;

/// Saves the run so far under a new name, and returns a notice with the name or the error.
pub(super) fn save(lab: &Lab) -> String {
    match try_save(lab) {
        Ok(path) => format!("Saved {0}. Check it with: regatta verify {0}", path.display()),
        Err(reason) => format!("no recording: {reason}"),
    }
}

fn try_save(lab: &Lab) -> Result<PathBuf, String> {
    let name = format!("regatta-{}-recording", lab.scene().name);
    let text = lab.recording().map_err(|error| error.to_string())?;
    write_new(Path::new(""), &name, "toml", text.as_bytes())
        .map_err(|error| format!("cannot write {name}.toml here: {error}"))
}
