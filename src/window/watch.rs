//! Watches the opened scene files for changes, on a thread of its own because a disk can be slow.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::ReadScene;

/// The time between two looks at the files: short enough for a change to seem immediate.
const INTERVAL: Duration = Duration::from_millis(400);
/// How long a changed file must stay the same before it is read: an editor may empty it first.
const STEADY: Duration = Duration::from_millis(60);
/// How many looks in a row must find no file before it counts as gone. After one, an editor may be about to replace it.
const MISSING_WHEN_GONE: u32 = 2;

/// A handle to the thread that watches files. The thread ends when this is dropped.
pub(super) struct FileWatch {
    files: Sender<WatchedFile>,
}

impl FileWatch {
    /// Starts the thread, which has no file to watch yet. It sends an event for each file that changes, is deleted or
    /// comes back; changed files are read by `read`.
    pub(super) fn new(read: ReadScene, events: EventLoopProxy<Event>) -> Self {
        let (files, added) = channel();
        thread::spawn(move || watch(&read, &added, &events));
        Self { files }
    }

    /// Adds a file that was opened, if one was, with the text that it had then.
    pub(super) fn watch(&self, opened: Option<(PathBuf, String)>) {
        if let Some((path, text)) = opened {
            // If the thread has ended, changes go unnoticed; the window stays open.
            _ = self.files.send(WatchedFile::new(path, text.into_bytes()));
        }
    }
}

fn watch(read: &ReadScene, added: &Receiver<WatchedFile>, events: &EventLoopProxy<Event>) {
    let mut files: Vec<WatchedFile> = Vec::new();
    loop {
        let file = if files.is_empty() {
            added.recv().map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            added.recv_timeout(INTERVAL)
        };
        match file {
            Ok(file) => {
                files.retain(|known| known.path != file.path);
                files.push(file);
            }
            Err(RecvTimeoutError::Timeout) => {
                for file in &mut files {
                    let path = file.path.clone();
                    let event = match file.look() {
                        Look::Same => continue,
                        Look::Changed => Event::FileChanged { read: read(&path), path },
                        Look::Gone => Event::FileGone(path),
                        Look::Back => Event::FileBack(path),
                    };
                    if events.send_event(event).is_err() {
                        return;
                    }
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// What a look at a file finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    /// Nothing new.
    Same,
    /// The file has other bytes.
    Changed,
    /// The file cannot be read any more.
    Gone,
    /// The file was gone, and exists again with the same bytes.
    Back,
}

/// A file with the bytes that it had when it was last read.
struct WatchedFile {
    path: PathBuf,
    bytes: Vec<u8>,
    /// How many looks in a row found no file.
    missing: u32,
}

impl WatchedFile {
    fn new(path: PathBuf, bytes: Vec<u8>) -> Self {
        Self { path, bytes, missing: 0 }
    }

    /// Looks at the file; while it is being written, waits until it stays as it is.
    ///
    /// Compares bytes and not times of modification: two changes can have the same time, and a file that replaces
    /// another can be older.
    fn look(&mut self) -> Look {
        let Some(bytes) = self.read_steady() else {
            self.missing = self.missing.saturating_add(1);
            return if self.missing == MISSING_WHEN_GONE { Look::Gone } else { Look::Same };
        };
        let was_gone = std::mem::take(&mut self.missing) >= MISSING_WHEN_GONE;
        if bytes != self.bytes {
            self.bytes = bytes;
            return Look::Changed;
        }
        if was_gone { Look::Back } else { Look::Same }
    }

    /// The bytes of the file. If they are new, waits until they have stayed the same for [`STEADY`].
    fn read_steady(&self) -> Option<Vec<u8>> {
        let mut bytes = self.read()?;
        while bytes != self.bytes {
            thread::sleep(STEADY);
            let before = std::mem::replace(&mut bytes, self.read()?);
            if bytes == before {
                break;
            }
        }
        Some(bytes)
    }

    fn read(&self) -> Option<Vec<u8>> {
        // Reading a pipe would block until its other end is written.
        self.path.metadata().ok().filter(|found| found.is_file())?;
        std::fs::read(&self.path).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file with the text `one`, and its folder.
    fn watched() -> (tempfile::TempDir, WatchedFile) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "one").unwrap();
        (folder, WatchedFile::new(path, b"one".into()))
    }

    fn looks(watched: &mut WatchedFile, count: usize) -> Vec<Look> {
        (0..count).map(|_| watched.look()).collect()
    }

    #[test]
    fn a_file_that_is_written_or_replaced_has_changed_once() {
        let (folder, mut watched) = watched();
        assert_eq!(watched.look(), Look::Same);
        std::fs::write(&watched.path, "two").unwrap();
        assert_eq!(looks(&mut watched, 2), [Look::Changed, Look::Same]);
        // As editors save: another file, renamed over it.
        let other = folder.path().join("a.toml~");
        std::fs::write(&other, "three").unwrap();
        std::fs::rename(&other, &watched.path).unwrap();
        assert_eq!(looks(&mut watched, 2), [Look::Changed, Look::Same]);
        std::fs::write(&watched.path, "").unwrap();
        assert_eq!(watched.look(), Look::Changed);
    }

    #[test]
    fn a_file_that_is_deleted_is_gone_once_and_back_once() {
        let (_folder, mut watched) = watched();
        std::fs::remove_file(&watched.path).unwrap();
        // An editor may be about to put another in its place.
        assert_eq!(watched.look(), Look::Same);
        std::fs::write(&watched.path, "one").unwrap();
        assert_eq!(watched.look(), Look::Same);
        for (text, found) in [("one", Look::Back), ("two", Look::Changed)] {
            std::fs::remove_file(&watched.path).unwrap();
            assert_eq!(looks(&mut watched, 4), [Look::Same, Look::Gone, Look::Same, Look::Same]);
            std::fs::write(&watched.path, text).unwrap();
            assert_eq!(looks(&mut watched, 2), [found, Look::Same]);
        }
    }
}
