//! The directory that a capture fills with numbered pictures and a manifest, each of which appears whole
//! or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::manifest;
use super::output::{AtomicFile, DirectoryLock, FileError, sync_directory, write_whole};

pub(super) mod blessing;
mod entries;
mod errors;
mod queue;
#[cfg(test)]
mod tests;

use super::frame_names::{frame_name, is_pending};
use blessing::Blessing;
use entries::{Entries, is_a_captures};
pub(super) use errors::FrameFolderError;
use queue::{FrameQueue, Settled};

/// What may become of the frames that a folder holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Existing {
    /// The folder has to be empty or new.
    Refuse,
    /// Frames make way for the new ones; other entries stay.
    Replace,
    /// Frames make way once all the new ones are written.
    Bless,
}

/// A folder of frames. While it exists no other process may write there.
#[derive(Debug)]
pub(super) struct FrameFolder {
    path: PathBuf,
    existing: Existing,
    /// The command-line option that names the folder.
    option: &'static str,
    entries: Entries,
    /// How many frames were added.
    frames: u32,
    // What follows is dropped in this order: no frame comes after its directory or its lock is gone.
    queue: FrameQueue,
    /// The directory of new frames that will be swapped in.
    blessing: Option<Blessing>,
    /// `None` while the folder does not exist.
    lock: Option<DirectoryLock>,
}

impl FrameFolder {
    /// Examines the folder at `path`, which need not exist yet and which the command-line option `option`
    /// names. Changes nothing, except that a blessing interrupted during its swap is completed, where frames may be
    /// replaced.
    pub(super) fn inspect(
        path: &Path,
        existing: Existing,
        option: &'static str,
    ) -> Result<Self, FrameFolderError> {
        let mut folder = Self {
            path: path.to_owned(),
            existing,
            option,
            entries: Entries::default(),
            frames: 0,
            queue: FrameQueue::default(),
            blessing: None,
            lock: None,
        };
        match fs::metadata(path) {
            Ok(entry) if !entry.is_dir() => {
                Err(FrameFolderError::NotADirectory { path: path.to_owned() })
            }
            Ok(_) => folder.look().map(|()| folder),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(folder),
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                Err(FrameFolderError::NotADirectory { path: path.to_owned() })
            }
            Err(error) => Err(FileError::of("read", path, option)(error).into()),
        }
    }

    /// The first of `name`, `name-2`, `name-3` … that is new or an empty directory.
    pub(super) fn beside(name: &str) -> Result<Self, FrameFolderError> {
        let siblings = (2..).map(|n: u32| format!("{name}-{n}"));
        for sibling in std::iter::once(name.to_owned()).chain(siblings) {
            match Self::inspect(Path::new(&sibling), Existing::Refuse, "working directory") {
                Err(
                    FrameFolderError::NotEmpty { .. }
                    | FrameFolderError::NotADirectory { .. }
                    | FrameFolderError::Busy { .. },
                ) => {}
                found => return found,
            }
        }
        unreachable!("no file system holds as many directories")
    }

    /// Locks the folder and reads its entries.
    fn look(&mut self) -> Result<(), FrameFolderError> {
        let (path, option) = (&self.path, self.option);
        let lock = DirectoryLock::exclusive(path).map_err(FileError::of("lock", path, option))?;
        if lock.is_none() {
            return Err(FrameFolderError::Busy { path: path.clone(), option });
        }
        self.lock = lock;
        let read = || Entries::read(path).map_err(FileError::of("read", path, option));
        let mut entries = read()?;
        if self.existing == Existing::Refuse && !entries.is_empty() {
            return Err(FrameFolderError::NotEmpty { path: path.clone() });
        }
        if self.existing == Existing::Bless {
            // A capture may stop before the frame that a directory blocks; a swap replaces all frames.
            entries.foreign = entries.foreign.or(entries.in_the_way.take());
        }
        if let Some(path) = entries.foreign {
            return Err(FrameFolderError::NotOurs { path, option });
        }
        if self.existing != Existing::Refuse && is_pending(path) {
            let fail = FileError::of("finish the --bless in", path, option);
            blessing::complete(path).map_err(fail)?;
            entries = read()?;
        }
        if self.existing == Existing::Bless
            && let Some(path) = blessing::in_the_way(path)
        {
            return Err(FrameFolderError::NotOurs { path, option });
        }
        self.entries = entries;
        Ok(())
    }

    /// The path of the folder.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether an incomplete set of frames is worth keeping.
    pub(super) fn takes_a_part(&self) -> bool {
        self.existing != Existing::Bless
    }

    /// The directory that files are written to.
    fn place(&self) -> &Path {
        self.blessing.as_ref().map_or(&self.path, Blessing::place)
    }

    /// Creates the folder if necessary and removes the files of an earlier capture. The folder never holds frames of two
    /// captures.
    pub(super) fn clear(&mut self) -> Result<(), FrameFolderError> {
        if self.lock.is_none() {
            fs::create_dir_all(&self.path).map_err(FileError::of(
                "make the directory",
                &self.path,
                self.option,
            ))?;
            self.look()?;
        }
        let fail = |path: &Path| FileError::of("replace", path, self.option);
        for name in self.entries.our_directories.drain(..) {
            let path = self.path.join(name);
            fs::remove_dir_all(&path).map_err(fail(&path))?;
        }
        let goes = |name: &OsString| match self.existing {
            Existing::Bless => name.to_str().is_some_and(|name| !is_a_captures(name)),
            _ => true,
        };
        // The manifest, which speaks of the frames, goes before them.
        for name in self.entries.ours.iter().rev().filter(|name| goes(name)) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(fail(&path))?;
        }
        if self.existing == Existing::Bless {
            let blessing = Blessing::begin(&self.path);
            let failed = FileError::of("make a directory in", &self.path, self.option);
            self.blessing = Some(blessing.map_err(failed)?);
        }
        self.queue = FrameQueue::open();
        Ok(())
    }

    /// Adds the next frame. The error may be that of an earlier frame.
    pub(super) fn push(&mut self, picture: &[u8]) -> Result<(), FrameFolderError> {
        let name = frame_name(self.frames);
        let shown = self.path.join(&name);
        let written = AtomicFile::create(&self.place().join(name)).and_then(|mut file| {
            file.write_all(picture)?;
            Ok(file)
        });
        let file = written.map_err(FileError::of("write", &shown, self.option))?;
        if !self.queue.push(file, shown) {
            return self.settle();
        }
        self.frames += 1;
        Ok(())
    }

    /// Waits until every frame is written under its name. At the first failure only the frames before it
    /// remain.
    pub(super) fn settle(&mut self) -> Result<(), FrameFolderError> {
        let Some(Settled { frames, failed }) = self.queue.close() else { return Ok(()) };
        self.frames = frames;
        match failed {
            Some((error, path)) => Err(FileError::of("write", &path, self.option)(error).into()),
            None => Ok(()),
        }
    }

    /// Writes the manifest after all frames, and completes a blessing.
    pub(super) fn finish(mut self, manifest: &str) -> Result<(), FrameFolderError> {
        self.settle()?;
        let path = self.place().join(manifest::FILE_NAME);
        let shown = self.path.join(manifest::FILE_NAME);
        sync_directory(self.place())
            .and_then(|()| write_whole(&path, manifest.as_bytes()))
            .map_err(FileError::of("write", &shown, self.option))?;
        let swapped = self.blessing.take().map_or(Ok(()), Blessing::swap);
        Ok(swapped.map_err(FileError::of("put the new frames into", &self.path, self.option))?)
    }

    /// The names of the first and the last frame written.
    pub(super) fn range(&self) -> String {
        let name = |frame| self.path.join(frame_name(frame)).display().to_string();
        match self.frames {
            0 => "none".into(),
            1 => name(0),
            frames => format!("{} … {}", name(0), frame_name(frames - 1)),
        }
    }

    /// The names of the entries that no capture made, and that were left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.entries.others
    }
}
