//! The directory that the figures go to, each file of which appears whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::atomic_file::{IfExists, final_name, write_file};
use crate::commands::error::Error;

/// A folder for figures.
pub(super) struct FigureFolder {
    path: PathBuf,
    /// Figures of an earlier run, whole or not.
    old: Vec<OsString>,
    /// Names of the entries that are none of ours.
    others: Vec<OsString>,
}

impl FigureFolder {
    /// Looks at the folder at `path`, which need not exist yet, and changes nothing.
    pub(super) fn inspect(path: &Path) -> Result<Self, Error> {
        let fail = Error::of_file("read", path, "--out");
        let mut folder = Self { path: path.to_owned(), old: Vec::new(), others: Vec::new() };
        let entries = match fs::read_dir(path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(folder),
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return Err(Error::mistake(format!(
                    "{} is not a directory; give another --out",
                    path.display()
                )));
            }
            Err(error) => return Err(fail(error)),
        };
        for entry in entries {
            let entry = entry.map_err(&fail)?;
            let is_file = !entry.file_type().map_err(&fail)?.is_dir();
            let name = entry.file_name();
            let is_old = is_file && name.to_str().is_some_and(is_ours);
            let list = if is_old { &mut folder.old } else { &mut folder.others };
            list.push(name);
        }
        folder.others.sort();
        Ok(folder)
    }

    /// Whether nothing is there.
    pub(super) fn is_empty(&self) -> bool {
        self.old.is_empty() && self.others.is_empty()
    }

    /// Makes the folder where there is none, and removes the figures of an earlier run.
    pub(super) fn clear(&mut self) -> Result<(), Error> {
        fs::create_dir_all(&self.path).map_err(Error::of_file(
            "make the directory",
            &self.path,
            "--out",
        ))?;
        for name in self.old.drain(..) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(Error::of_file("replace", &path, "--out"))?;
        }
        Ok(())
    }

    /// Writes a file: under a name of its own until it is whole.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let path = self.path.join(name);
        let written = write_file(&path, bytes, IfExists::Replace);
        written.map(drop).map_err(Error::of_file("write", &path, "--out"))
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the entries that are none of ours and have been left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.others
    }
}

/// Whether a file of this name is a figure or its data, whole or under way.
fn is_ours(name: &str) -> bool {
    let whole = final_name(name).unwrap_or(name);
    let stem = whole.strip_suffix(".png").or_else(|| whole.strip_suffix(".csv"));
    let number = stem.and_then(|stem| stem.strip_prefix("figure-7-"));
    number.is_some_and(|n| n.len() == 1 && n.bytes().all(|b| (b'2'..=b'8').contains(&b)))
}
