//! Storage for the [preferences](SavedPreferences) of the window from one run to the next.
//!
//! The file is `window.toml`, in the folder that the system has for the settings of a program. On Linux it is under
//! `XDG_CONFIG_HOME`. If the file is invalid, it is ignored, and a line on standard error reports this.

use std::path::{Path, PathBuf};

use directories::ProjectDirs;

use crate::atomic_file::IfExists;
use crate::commands::output::begin_file;
use crate::commands::terminal::print_status;
use crate::regular_file;
use crate::scene::MAX_FILE_BYTES;
use crate::studio::{SavedPreferences, Studio};

const FILE_NAME: &str = "window.toml";

/// Loads the saved preferences. Without a file, returns the defaults.
pub(super) fn load() -> SavedPreferences {
    let Some(path) = path() else { return SavedPreferences::default() };
    read(&path).unwrap_or_else(|why| {
        print_status(&format!("{} is ignored: {why}", path.display()));
        SavedPreferences::default()
    })
}

fn read(path: &Path) -> Result<SavedPreferences, String> {
    let bytes = match regular_file::read(path, MAX_FILE_BYTES) {
        Err(missing) if missing.is_missing() => return Ok(SavedPreferences::default()),
        read => read.map_err(|why| why.to_string())?,
    };
    SavedPreferences::parse(str::from_utf8(&bytes).map_err(|_| "it is not text")?)
}

/// Saves the preferences. A failure goes only to the log.
pub(super) fn save(preferences: &SavedPreferences) {
    let Some(path) = path() else { return };
    let write = |path: &Path| {
        let folder = path.parent().unwrap_or(path);
        std::fs::create_dir_all(folder)?;
        // The file is replaced atomically, because another window may close at the same time.
        begin_file(path)?.write_whole(preferences.to_text().as_bytes(), IfExists::Replace)
    };
    if let Err(error) = write(&path) {
        log::info!("cannot write {}: {error}", path.display());
    }
}

/// Returns the studio's open scene in the form that it has in the file, which is a name or an absolute path.
pub(super) fn scene_of(studio: &Studio) -> Option<PathBuf> {
    match studio.deck.scene_list().open_path() {
        // Not the canonical path, which on Windows is a verbatim one (`\\?\C:\…`) that people do not type.
        Some(path) => std::path::absolute(path).ok(),
        None => Some(studio.deck.scene_name().into()),
    }
}

/// Returns the folder that contains the program's settings.
pub(super) fn folder() -> Option<PathBuf> {
    Some(ProjectDirs::from("", "", "regatta")?.config_dir().to_owned())
}

fn path() -> Option<PathBuf> {
    Some(folder()?.join(FILE_NAME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_gives_defaults_and_a_binary_file_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE_NAME);
        assert_eq!(read(&path), Ok(SavedPreferences::default()));
        std::fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
        assert_eq!(read(&path), Err("it is not text".into()));
        assert!(read(folder.path()).is_err());
    }
}
