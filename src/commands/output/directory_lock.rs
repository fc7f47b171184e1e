//! A lock that gives a directory one writer at a time, or any number of readers.
//!
//! The operating system keeps the lock, and releases it when the process ends in any way.

use std::fs::{File, OpenOptions, TryLockError};
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
        Self::lock(directory, File::options().write(true).create(true), File::try_lock)
    }

    /// Takes the lock of a reader on a directory, or returns `None` if another process writes.
    pub(crate) fn shared(directory: &Path) -> io::Result<Option<Self>> {
        Self::lock(directory, File::options().read(true), File::try_lock_shared)
    }

    fn lock(
        directory: &Path,
        options: &OpenOptions,
        lock: impl Fn(&File) -> Result<(), TryLockError>,
    ) -> io::Result<Option<Self>> {
        let file = if cfg!(unix) {
            File::open(directory).map(Some)
        } else {
            open_lock_file(directory, options)
        };
        let Some(file) = file? else { return Ok(Some(Self { _file: None })) };
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

/// Opens the lock file of a directory. If no process has written there, a reader gets `None` and creates nothing,
/// because the disk may be read-only.
fn open_lock_file(directory: &Path, options: &OpenOptions) -> io::Result<Option<File>> {
    match options.open(directory.join(LOCK_NAME)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound && directory.is_dir() => Ok(None),
        opened => opened.map(Some),
    }
}

pub(crate) fn is_lock(name: &str) -> bool {
    name == LOCK_NAME
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

    #[test]
    fn a_reader_creates_no_lock_file() {
        let folder = tempfile::tempdir().unwrap();
        let open = |options: &OpenOptions| open_lock_file(folder.path(), options).unwrap();
        assert!(open(File::options().read(true)).is_none());
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
        assert!(open(File::options().write(true).create(true)).is_some());
        assert!(open(File::options().read(true)).is_some());
        let nowhere = open_lock_file(&folder.path().join("no"), File::options().read(true));
        assert_eq!(nowhere.unwrap_err().kind(), io::ErrorKind::NotFound);
    }
}
