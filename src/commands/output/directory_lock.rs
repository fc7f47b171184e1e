//! A lock that gives a directory one writer at a time, or any number of readers.
//!
//! The operating system keeps the lock, and releases it when the process ends in any way.

use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

/// Name of the lock file, which is used on systems that cannot lock a directory itself. Writers create it.
const LOCK_NAME: &str = ".regatta-lock";

/// A lock on a directory, which is released when the value is dropped.
#[derive(Debug)]
pub(crate) struct DirectoryLock {
    /// `None` if there is nothing to lock yet.
    _file: Option<File>,
}

impl DirectoryLock {
    /// Takes the lock of a writer on a directory, or returns `None` if another process has a lock.
    pub(crate) fn exclusive(directory: &Path) -> io::Result<Option<Self>> {
        Self::lock(directory, open_to_write(directory)?, File::try_lock)
    }

    /// Takes the lock of a reader on a directory, or returns `None` if another process writes.
    pub(crate) fn shared(directory: &Path) -> io::Result<Option<Self>> {
        match open_to_read(directory)? {
            Some(file) => Self::lock(directory, file, File::try_lock_shared),
            None => Ok(Some(Self { _file: None })),
        }
    }

    fn lock(
        directory: &Path,
        file: File,
        lock: impl Fn(&File) -> Result<(), TryLockError>,
    ) -> io::Result<Option<Self>> {
        match lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
                log::warn!("{}: the file system has no locks", directory.display());
            }
            Err(TryLockError::Error(error)) => return Err(error),
        }
        Ok(Some(Self { _file: Some(file) }))
    }
}

pub(crate) fn is_lock(name: &str) -> bool {
    name == LOCK_NAME
}

#[cfg(unix)]
fn open_to_write(directory: &Path) -> io::Result<File> {
    File::open(directory)
}

#[cfg(unix)]
fn open_to_read(directory: &Path) -> io::Result<Option<File>> {
    File::open(directory).map(Some)
}

#[cfg(not(unix))]
fn open_to_write(directory: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.write(true).create(true).truncate(false).open(directory.join(LOCK_NAME))
}

/// A reader leaves no file behind, and may read a disk that it cannot write to. Without a lock file, no writer on this
/// system has been in the directory.
#[cfg(not(unix))]
fn open_to_read(directory: &Path) -> io::Result<Option<File>> {
    match File::open(directory.join(LOCK_NAME)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound && directory.is_dir() => Ok(None),
        opened => opened.map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readers_keep_writers_out_and_a_writer_keeps_everybody_out() {
        let folder = tempfile::tempdir().unwrap();
        let exclusive = || DirectoryLock::exclusive(folder.path()).unwrap();
        let shared = || DirectoryLock::shared(folder.path()).unwrap();
        // Windows has a file to lock only after the first writer.
        drop(exclusive());
        let reader = shared();
        assert!(reader.is_some() && shared().is_some() && exclusive().is_none());
        drop(reader);
        let writer = exclusive();
        assert!(writer.is_some() && shared().is_none() && exclusive().is_none());
        drop(writer);
        assert!(exclusive().is_some());
    }
}
