//! The directory that a capture fills with numbered pictures and a manifest. Each file appears whole or not at all.
//!
//! The manifest is removed first and written last, so that a folder with a manifest has every frame that it lists. Only
//! files that a capture made are removed, as their content shows: `--force` with a wrong folder must not cost a
//! person's pictures. A lock keeps other captures out, or two would mix their frames.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::argument::brief;
use super::error::{Error, PlaceOf};
use super::manifest;
use super::output::{DirectoryLock, begin_file};
use crate::atomic_file::{IfExists, sync_directory};

pub(super) mod blessing;
mod entries;
#[cfg(test)]
mod tests;

use super::frame_names::{frame_name, in_the_way, is_a_captures, is_pending, not_ours};
use blessing::Blessing;
use entries::Entries;

/// Policy for frames that a folder already contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FolderPolicy {
    /// The folder must be new or empty.
    Refuse,
    /// New frames replace old ones. Other entries of the folder stay.
    Replace,
    /// New frames replace old ones, but only after all of them have been written.
    Bless,
}

/// A folder of frames. No other process may write to it while this value exists.
#[derive(Debug)]
pub(super) struct FrameFolder {
    path: PathBuf,
    existing: FolderPolicy,
    /// How the user named the folder.
    place: PlaceOf,
    entries: Entries,
    /// Number of frames added.
    frames: u32,
    /// The directory of the new frames of a blessing, which is swapped in at the end.
    blessing: Option<Blessing>,
    /// The lock on the folder. `None` while the folder does not exist.
    lock: Option<DirectoryLock>,
}

impl FrameFolder {
    /// Examines the folder at `path`, which need not exist yet. Changes nothing, with one exception: it completes the
    /// interrupted swap of a blessing if frames may be replaced.
    pub(super) fn inspect(
        path: &Path,
        existing: FolderPolicy,
        place: PlaceOf,
    ) -> Result<Self, Error> {
        let mut folder = Self {
            path: path.to_owned(),
            existing,
            place,
            entries: Entries::default(),
            frames: 0,
            blessing: None,
            lock: None,
        };
        let no_directory =
            || Error::mistake(format!("{} is not a directory; give another --out", brief(path)));
        match fs::metadata(path) {
            Ok(entry) if !entry.is_dir() => Err(no_directory()),
            Ok(_) => folder.lock_and_read().map(|()| folder),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(folder),
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => Err(no_directory()),
            Err(error) => Err(Error::of_place("read", path, place)(error)),
        }
    }

    /// Inspects `name`, `name-2`, `name-3` and so on. Returns the first of these folders that is new or empty.
    pub(super) fn new_sibling(name: &str) -> Result<Self, Error> {
        let siblings = (2..).map(|n: u32| format!("{name}-{n}"));
        for sibling in std::iter::once(name.to_owned()).chain(siblings) {
            let place = PlaceOf::Option("working directory");
            match Self::inspect(Path::new(&sibling), FolderPolicy::Refuse, place) {
                Err(taken) if taken.is_mistake() => {}
                found => return found,
            }
        }
        unreachable!("no file system holds as many directories")
    }

    /// Locks the folder and reads its entries.
    fn lock_and_read(&mut self) -> Result<(), Error> {
        let (path, place) = (&self.path, self.place);
        let lock = DirectoryLock::exclusive(path).map_err(Error::of_place("lock", path, place))?;
        if lock.is_none() {
            let (path, remedy) = (brief(path), place.or_another("wait until it has finished"));
            return Err(Error::mistake(format!("another regatta is writing to {path}; {remedy}")));
        }
        self.lock = lock;
        let read = || Entries::read(path).map_err(Error::of_place("read", path, place));
        let mut entries = read()?;
        if self.existing == FolderPolicy::Refuse && !entries.is_empty() {
            let path = brief(path);
            return Err(Error::mistake(format!(
                "{path} is not empty; give another --out, or --force to replace the frames in it"
            )));
        }
        if self.existing == FolderPolicy::Bless {
            // A directory with the name of a frame stops a plain capture only at that frame. A swap needs to replace
            // all frames, so it is refused at once.
            entries.foreign = entries.foreign.or(entries.in_the_way.take());
        }
        if let Some(path) = entries.foreign {
            return Err(not_ours(&path, place));
        }
        if self.existing == FolderPolicy::Bless
            && let Some(path) = in_the_way(path)
        {
            return Err(not_ours(&path, place));
        }
        if self.existing != FolderPolicy::Refuse && is_pending(path) {
            let fail = Error::of_place("finish the --bless in", path, place);
            blessing::complete(path).map_err(fail)?;
            entries = read()?;
        }
        self.entries = entries;
        Ok(())
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether a set of frames that is not complete is worth keeping.
    pub(super) fn keeps_partial_capture(&self) -> bool {
        self.existing != FolderPolicy::Bless
    }

    /// Returns the directory into which new files are written.
    fn place(&self) -> &Path {
        self.blessing.as_ref().map_or(&self.path, Blessing::place)
    }

    /// Creates the folder if necessary, and removes the files of an earlier capture, so that the folder never mixes
    /// frames of two captures.
    pub(super) fn clear(&mut self) -> Result<(), Error> {
        if self.lock.is_none() {
            fs::create_dir_all(&self.path).map_err(Error::of_place(
                "make the directory",
                &self.path,
                self.place,
            ))?;
            self.lock_and_read()?;
        }
        let fail = |path: &Path| Error::of_place("replace", path, self.place);
        for name in self.entries.our_directories.drain(..) {
            let path = self.path.join(name);
            fs::remove_dir_all(&path).map_err(fail(&path))?;
        }
        let goes = |name: &OsString| match self.existing {
            FolderPolicy::Bless => name.to_str().is_some_and(|name| !is_a_captures(name)),
            _ => true,
        };
        // The manifest is removed first, because it describes the frames.
        for name in self.entries.ours.iter().rev().filter(|name| goes(name)) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(fail(&path))?;
        }
        if self.existing == FolderPolicy::Bless {
            let blessing = Blessing::begin(&self.path);
            let failed = Error::of_place("make a directory in", &self.path, self.place);
            self.blessing = Some(blessing.map_err(failed)?);
        }
        Ok(())
    }

    /// Adds the next frame.
    pub(super) fn push(&mut self, picture: &[u8]) -> Result<(), Error> {
        let name = frame_name(self.frames);
        let written = begin_file(&self.place().join(&name)).and_then(|mut file| {
            file.write_all(picture)?;
            file.rename(IfExists::Replace)
        });
        written.map_err(|error| self.unwritten(&name, error))?;
        self.frames += 1;
        Ok(())
    }

    /// Writes the manifest after all frames, and then completes a blessing.
    pub(super) fn finish(mut self, manifest: &str) -> Result<(), Error> {
        let path = self.place().join(manifest::FILE_NAME);
        sync_directory(self.place())
            .and_then(|()| begin_file(&path)?.write_whole(manifest.as_bytes(), IfExists::Replace))
            .map_err(|error| self.unwritten(manifest::FILE_NAME, error))?;
        let swapped = self.blessing.take().map_or(Ok(()), Blessing::swap);
        swapped.map_err(Error::of_place("put the new frames into", &self.path, self.place))
    }

    /// Returns the error for a file that could not be written.
    fn unwritten(&self, name: &str, error: io::Error) -> Error {
        let error = Error::of_place("write", &self.path.join(name), self.place)(error);
        if !self.keeps_partial_capture() {
            return error;
        }
        let whole = self.range();
        error.and(format!(
            "whole before that: {whole}; the same command with --force draws all frames"
        ))
    }

    /// Returns the path of the first frame that was written, and the name of the last one.
    pub(super) fn range(&self) -> String {
        let name = |frame| self.path.join(frame_name(frame)).display().to_string();
        match self.frames {
            0 => "none".into(),
            1 => name(0),
            frames => format!("{} … {}", name(0), frame_name(frames - 1)),
        }
    }

    /// Returns the names of the entries that no capture made. These entries were left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.entries.others
    }
}
