//! Reads opened files, and watches the scenes and the loops among them for changes. This happens on a separate thread,
//! because a disk can be slow.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, SystemTime};

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::{ReadScene, RequestedFile};
use crate::regular_file::{self, Unreadable};
use crate::scene::MAX_FILE_BYTES;

/// Time between two looks at the files, short enough for a change to seem immediate.
const INTERVAL: Duration = Duration::from_millis(400);
/// Time for which a changed file must stay the same before it is read: an editor may empty it first.
const STEADY: Duration = Duration::from_millis(60);
/// Looks in a row that read a file with the same stamp. They cover some two seconds, the coarsest time stamps of file
/// systems.
const READS: u32 = 6;
/// Looks in a row without a file after which it counts as gone. After one, an editor may be about to replace it.
const MISSING_WHEN_GONE: u32 = 2;

/// A handle to the thread that watches files, which ends when this is dropped.
pub(super) struct FileWatch {
    files: Sender<RequestedFile>,
}

impl FileWatch {
    /// Starts the thread. It watches no file at first, except those that are open already, with their texts. It reads
    /// files with `read`. It sends an event for each file that it has read, and for each that changes, is deleted or
    /// comes back.
    pub(super) fn new(
        read: ReadScene,
        opened: Vec<(PathBuf, String)>,
        events: EventLoopProxy<Event>,
    ) -> Self {
        let (files, sent) = channel();
        thread::spawn(move || {
            let watched = opened.into_iter();
            let watched = watched.filter_map(|(path, text)| WatchedFile::of_scene(path, text));
            watch(&read, watched.collect(), &sent, &events);
        });
        Self { files }
    }

    /// Reads a file, and watches it if it is a scene or a loop.
    pub(super) fn open(&self, requested: RequestedFile) {
        // If the thread has ended, the window ends too.
        _ = self.files.send(requested);
    }
}

fn watch(
    read: &ReadScene,
    mut files: Vec<WatchedFile>,
    sent: &Receiver<RequestedFile>,
    events: &EventLoopProxy<Event>,
) {
    loop {
        let requested = if files.is_empty() {
            sent.recv().map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            sent.recv_timeout(INTERVAL)
        };
        match requested {
            Ok(requested) => {
                let found = requested.read(read);
                if let Some((path, text)) = found.watched() {
                    files.retain(|known| known.path != path);
                    files.extend(WatchedFile::of_scene(path, text));
                }
                if events.send_event(Event::FileRead(found)).is_err() {
                    return;
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                for file in &mut files {
                    let path = file.path.clone();
                    let event = match file.check() {
                        FileCheck::Same => continue,
                        FileCheck::Changed => {
                            Event::FileRead(RequestedFile::changed(&path).read(read))
                        }
                        FileCheck::Gone => Event::FileGone(path),
                        FileCheck::Back => Event::FileBack(path),
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

/// Result of a look at a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FileCheck {
    /// Nothing has changed.
    Same,
    /// The file has other bytes.
    Changed,
    /// The file can no longer be read.
    Gone,
    /// The file was gone and exists again with the same bytes.
    Back,
}

/// Metadata that identifies a version of a file, so that it need not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Stamp {
    bytes: u64,
    modified: Option<SystemTime>,
    /// Device and inode, and the time of its last change, which no program can set.
    #[cfg(unix)]
    inode: (u64, u64, i64, i64),
    #[cfg(not(unix))]
    created: Option<SystemTime>,
}

impl Stamp {
    fn of(path: &Path) -> Option<Self> {
        let found = path.metadata().ok()?;
        #[cfg(unix)]
        use std::os::unix::fs::MetadataExt;
        Some(Self {
            bytes: found.len(),
            modified: found.modified().ok(),
            #[cfg(unix)]
            inode: (found.dev(), found.ino(), found.ctime(), found.ctime_nsec()),
            #[cfg(not(unix))]
            created: found.created().ok(),
        })
    }
}

/// A file with its bytes at the last read.
struct WatchedFile {
    path: PathBuf,
    /// `None` if it was too large for a scene.
    bytes: Option<Vec<u8>>,
    /// Looks in a row that found no file.
    missing: u32,
    stamp: Option<Stamp>,
    /// Looks in a row that found this stamp and read the file.
    reads: u32,
}

impl WatchedFile {
    /// Watches the file of a scene with this text. The file of a rule or a capture has other bytes, which are read. A
    /// folder is not watched.
    fn of_scene(path: PathBuf, text: String) -> Option<Self> {
        let bytes = match path.extension().is_some_and(|ending| ending == "toml") {
            true => text.into_bytes(),
            false => regular_file::read(&path, MAX_FILE_BYTES).ok()?,
        };
        Some(Self::new(path, bytes))
    }

    fn new(path: PathBuf, bytes: Vec<u8>) -> Self {
        Self { path, bytes: Some(bytes), missing: 0, stamp: None, reads: 0 }
    }

    /// Looks at the file. While somebody writes it, waits until it no longer changes.
    ///
    /// Compares bytes, because two changes can have the same time and a file that replaces another can be older.
    /// Stops reading after [`READS`] looks with the same stamp: from then on every change gives it another time.
    fn check(&mut self) -> FileCheck {
        let stamp = Stamp::of(&self.path);
        if stamp != self.stamp || stamp.is_none() {
            (self.stamp, self.reads) = (stamp, 0);
        } else if self.reads == READS {
            return FileCheck::Same;
        }
        self.reads += 1;
        let Some(bytes) = self.read_steady() else {
            self.missing = self.missing.saturating_add(1);
            return if self.missing == MISSING_WHEN_GONE {
                FileCheck::Gone
            } else {
                FileCheck::Same
            };
        };
        let was_gone = std::mem::take(&mut self.missing) >= MISSING_WHEN_GONE;
        if bytes != self.bytes {
            self.bytes = bytes;
            return FileCheck::Changed;
        }
        if was_gone { FileCheck::Back } else { FileCheck::Same }
    }

    /// Reads the file. If its bytes are new, waits until they have stayed the same for [`STEADY`].
    fn read_steady(&self) -> Option<Option<Vec<u8>>> {
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

    fn read(&self) -> Option<Option<Vec<u8>>> {
        match regular_file::read(&self.path, MAX_FILE_BYTES) {
            Ok(bytes) => Some(Some(bytes)),
            Err(Unreadable::TooLarge { .. }) => Some(None),
            Err(_) => None,
        }
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

    fn looks(watched: &mut WatchedFile, count: usize) -> Vec<FileCheck> {
        (0..count).map(|_| watched.check()).collect()
    }

    #[test]
    fn a_written_or_replaced_file_is_reported_once() {
        let (folder, mut watched) = watched();
        assert_eq!(watched.check(), FileCheck::Same);
        std::fs::write(&watched.path, "two").unwrap();
        assert_eq!(looks(&mut watched, 2), [FileCheck::Changed, FileCheck::Same]);
        // Save as editors do: another file, renamed over it.
        let other = folder.path().join("a.toml~");
        std::fs::write(&other, "three").unwrap();
        std::fs::rename(&other, &watched.path).unwrap();
        assert_eq!(looks(&mut watched, 2), [FileCheck::Changed, FileCheck::Same]);
        std::fs::write(&watched.path, "").unwrap();
        assert_eq!(watched.check(), FileCheck::Changed);
    }

    #[test]
    fn a_deletion_and_a_return_of_a_file_are_reported_once_each() {
        let (_folder, mut watched) = watched();
        std::fs::remove_file(&watched.path).unwrap();
        // An editor may be about to replace it.
        assert_eq!(watched.check(), FileCheck::Same);
        std::fs::write(&watched.path, "one").unwrap();
        assert_eq!(watched.check(), FileCheck::Same);
        for (text, found) in [("one", FileCheck::Back), ("two", FileCheck::Changed)] {
            std::fs::remove_file(&watched.path).unwrap();
            assert_eq!(
                looks(&mut watched, 4),
                [FileCheck::Same, FileCheck::Gone, FileCheck::Same, FileCheck::Same]
            );
            std::fs::write(&watched.path, text).unwrap();
            assert_eq!(looks(&mut watched, 2), [found, FileCheck::Same]);
        }
    }

    #[test]
    fn an_unchanged_file_is_not_read_again() {
        let (_folder, mut watched) = watched();
        let reads = |watched: &mut WatchedFile| {
            looks(watched, 20);
            watched.reads
        };
        assert_eq!(reads(&mut watched), READS);
        std::fs::write(&watched.path, "two").unwrap();
        assert_eq!(watched.check(), FileCheck::Changed);
        assert!(watched.reads < READS);
        assert_eq!(reads(&mut watched), READS);
        // A file too large for a scene is not read to its end.
        let large = std::fs::File::create(&watched.path).unwrap();
        large.set_len(1 << 40).unwrap();
        assert_eq!(looks(&mut watched, 2), [FileCheck::Changed, FileCheck::Same]);
        assert_eq!(watched.bytes, None);
        std::fs::write(&watched.path, "two").unwrap();
        assert_eq!(looks(&mut watched, 2), [FileCheck::Changed, FileCheck::Same]);
    }

    #[test]
    fn a_capture_is_not_watched_and_a_rule_by_its_own_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let text = || "title = 'x'".to_owned();
        assert!(WatchedFile::of_scene(folder.path().to_owned(), text()).is_none());
        let path = folder.path().join("camera.step");
        std::fs::write(&path, "x += v * dt").unwrap();
        let mut watched = WatchedFile::of_scene(path, text()).unwrap();
        assert_eq!(looks(&mut watched, 2), [FileCheck::Same, FileCheck::Same]);
    }
}
