//! Sorts the entries of a frame folder into those that a capture made and all others.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::blessing;
use crate::commands::frame_names::{
    frame_number, frames_claimed, is_a_captures, is_left_over, is_marked,
};
use crate::commands::manifest;
use crate::commands::output::is_lock;

/// The entries of a folder, sorted by their makers.
#[derive(Debug, Default)]
pub(super) struct Entries {
    /// Files of an earlier capture, whether complete or partial.
    pub(super) ours: BTreeSet<OsString>,
    /// Directories that an interrupted blessing left behind.
    pub(super) our_directories: Vec<OsString>,
    /// Entries that no capture made, except `foreign`.
    pub(super) others: Vec<OsString>,
    /// A file that has the name of a capture's file, although no capture made it.
    pub(super) foreign: Option<PathBuf>,
    /// A directory that has the name of a capture's file.
    pub(super) in_the_way: Option<PathBuf>,
}

impl Entries {
    /// Reads and sorts the entries of the folder at `path`.
    pub(super) fn read(path: &Path) -> io::Result<Self> {
        let mut entries = Self::default();
        let claimed = frames_claimed(&path.join(manifest::FILE_NAME));
        for entry in fs::read_dir(path)? {
            let entry = entry?;
            let is_directory = entry.file_type()?.is_dir();
            let name = entry.file_name();
            let text = name.to_str().unwrap_or_default();
            match (is_a_captures(text), is_directory) {
                (true, true) => {
                    entries.in_the_way = Some(entry.path());
                    entries.others.push(name);
                }
                (true, false) => {
                    let is_ours = match &claimed {
                        Some(claimed) => text == manifest::FILE_NAME || claimed.contains(text),
                        None => false,
                    };
                    if is_ours || frame_number(text).is_some() && is_marked(&entry.path()) {
                        entries.ours.insert(name);
                    } else {
                        entries.foreign = Some(entry.path());
                    }
                }
                (false, true) if blessing::is_left_over(&entry.path())? => {
                    entries.our_directories.push(name);
                }
                (false, false) if is_left_over(&entry.path()) => drop(entries.ours.insert(name)),
                (false, false) if is_lock(text) => {}
                (false, _) => entries.others.push(name),
            }
        }
        entries.others.sort();
        Ok(entries)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ours.is_empty()
            && self.our_directories.is_empty()
            && self.others.is_empty()
            && self.foreign.is_none()
    }
}
