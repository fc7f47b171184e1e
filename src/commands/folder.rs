//! A directory that a command fills with files, each of which appears whole or not at all.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What may become of the files that an earlier run left in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Existing {
    /// The folder has to be empty or new.
    Refuse,
    /// They make way for the new ones; other entries stay.
    Replace,
}

/// Why files could not be kept in a folder.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// The path is taken by something else.
    #[error("{} is not a directory; give another --out", .path.display())]
    NotADirectory {
        /// The path.
        path: PathBuf,
    },
    /// The folder is in use.
    #[error(
        "{} is not empty; give another --out, or --force to replace the {ours} in it",
        .path.display()
    )]
    NotEmpty {
        /// The folder.
        path: PathBuf,
        /// What would be replaced.
        ours: &'static str,
    },
    /// The system refused.
    #[error("cannot {doing} {}: {source}{}", .path.display(), remedy(.source))]
    Io {
        /// What was tried.
        doing: &'static str,
        /// On what.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

/// Which names in a folder are a command's own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ours {
    /// What they are, for messages.
    pub(super) what: &'static str,
    /// Whether a name is one of them, whole.
    pub(super) is_ours: fn(&str) -> bool,
}

impl Ours {
    /// Whether a name is one of them, whole or under way.
    fn holds(self, name: &OsStr) -> bool {
        let name = name.to_str().map(|name| name.strip_suffix(PART).unwrap_or(name));
        name.is_some_and(self.is_ours)
    }
}

/// What ends the name of a file that is not whole yet.
const PART: &str = ".part";

/// A folder to write to.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// Files of an earlier run, whole or not.
    old: Vec<OsString>,
    /// Names of the entries that are none of ours.
    others: Vec<OsString>,
}

impl Folder {
    /// Looks at the folder at `path`, which need not exist yet, and changes nothing.
    pub(super) fn inspect(
        path: &Path,
        ours: Ours,
        existing: Existing,
    ) -> Result<Self, FolderError> {
        let fail = failure("read", path);
        let mut folder = Self { path: path.to_owned(), old: Vec::new(), others: Vec::new() };
        match fs::read_dir(path) {
            Ok(entries) => {
                for entry in entries {
                    let entry = entry.map_err(&fail)?;
                    let is_directory = entry.file_type().map_err(&fail)?.is_dir();
                    let name = entry.file_name();
                    let is_old = ours.holds(&name) && !is_directory;
                    let list = if is_old { &mut folder.old } else { &mut folder.others };
                    list.push(name);
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return Err(FolderError::NotADirectory { path: path.to_owned() });
            }
            Err(error) => return Err(fail(error)),
        }
        folder.others.sort();
        let is_empty = folder.old.is_empty() && folder.others.is_empty();
        if existing == Existing::Refuse && !is_empty {
            return Err(FolderError::NotEmpty { path: path.to_owned(), ours: ours.what });
        }
        Ok(folder)
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the folder where there is none, and removes the files of an earlier run, so that it never
    /// holds files of two.
    pub(super) fn clear(&mut self) -> Result<(), FolderError> {
        fs::create_dir_all(&self.path).map_err(failure("make the directory", &self.path))?;
        for name in self.old.drain(..) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(failure("replace", &path))?;
        }
        Ok(())
    }

    /// Writes a file: under a name of its own until it is whole.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), FolderError> {
        let path = self.path.join(name);
        let part = self.path.join(format!("{name}{PART}"));
        let written = fs::write(&part, bytes).and_then(|()| fs::rename(&part, &path));
        if let Err(error) = written {
            // It may never have come to be; then there is nothing to remove.
            let _ = fs::remove_file(&part);
            return Err(failure("write", &path)(error));
        }
        Ok(())
    }

    /// Names of the entries that are none of ours and have been left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.others
    }
}

fn failure(doing: &'static str, path: &Path) -> impl Fn(io::Error) -> FolderError {
    let path = path.to_owned();
    move |source| FolderError::Io { doing, path: path.clone(), source }
}

fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "; free some space, or give another --out"
        }
        _ => "; give an --out that you may write to",
    }
}
