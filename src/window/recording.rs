//! The run as a scene file, for `regatta play`, `capture`, `advise` and `verify`.

use std::path::Path;

use super::new_file::write_new;
use crate::lab::Lab;

/// Saves the run so far beside nothing that exists, and says in a line for people what became of it.
pub(super) fn save(lab: &Lab) -> String {
    let name = format!("regatta-{}-recording", lab.scene().name);
    match write_new(Path::new(""), &name, "toml", lab.recording().to_toml().as_bytes()) {
        Ok(path) => format!("recorded in {0}: regatta verify {0}", path.display()),
        Err(error) => format!("no recording: cannot write {name}.toml here: {error}"),
    }
}
