//! Watches the scene files that were opened, on a thread of its own: a disk can be slow.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::ReadScene;

/// How often files are looked at: often enough for a change to seem at once.
const INTERVAL: Duration = Duration::from_millis(400);
/// How long a file stays as it is once it is written: an editor may empty it first.
const STEADY: Duration = Duration::from_millis(60);

/// The way to the thread that watches. It ends when this is dropped.
pub(super) struct FileWatch {
    files: Sender<Watched>,
}

impl FileWatch {
    /// Watches nothing yet. What changes is read by `read` and comes as an event.
    pub(super) fn new(read: ReadScene, events: EventLoopProxy<Event>) -> Self {
        let (files, added) = channel();
        thread::spawn(move || watch(&read, &added, &events));
        Self { files }
    }

    /// Watches a file that was opened, if one was, and had this text then.
    pub(super) fn watch(&self, opened: Option<(PathBuf, String)>) {
        if let Some((path, text)) = opened {
            // A thread that is gone sees nothing more; the window stays.
            _ = self.files.send(Watched { path, bytes: text.into_bytes() });
        }
    }
}

fn watch(read: &ReadScene, added: &Receiver<Watched>, events: &EventLoopProxy<Event>) {
    let mut files: Vec<Watched> = Vec::new();
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
                for file in files.iter_mut().filter_map(|file| file.has_changed().then_some(file)) {
                    let path = file.path.clone();
                    let read = read(&path);
                    if events.send_event(Event::Changed { path, read }).is_err() {
                        return;
                    }
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// A file as it was last.
struct Watched {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Watched {
    /// Whether the file has other bytes than it had, once it stays as it is. One that is not there has not changed: an
    /// editor may be about to put another in its place.
    ///
    /// The bytes tell, and no time of modification: that can be the same for two changes, and be older for a file that
    /// was put in place of another.
    fn has_changed(&mut self) -> bool {
        let Some(mut bytes) = self.read().filter(|bytes| *bytes != self.bytes) else {
            return false;
        };
        loop {
            thread::sleep(STEADY);
            match self.read() {
                Some(now) if now == bytes => break,
                Some(now) => bytes = now,
                None => return false,
            }
        }
        let has_changed = bytes != self.bytes;
        self.bytes = bytes;
        has_changed
    }

    fn read(&self) -> Option<Vec<u8>> {
        // A pipe would have us wait for its other end.
        self.path.metadata().ok().filter(|found| found.is_file())?;
        std::fs::read(&self.path).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_written_or_replaced_has_changed_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "one").unwrap();
        let mut watched = Watched { path: path.clone(), bytes: b"one".into() };
        assert!(!watched.has_changed());
        std::fs::write(&path, "two").unwrap();
        assert!(watched.has_changed() && !watched.has_changed());
        // As editors save: another file, renamed over it.
        let other = folder.path().join("a.toml~");
        std::fs::write(&other, "three").unwrap();
        std::fs::rename(&other, &path).unwrap();
        assert!(watched.has_changed() && !watched.has_changed());
        std::fs::remove_file(&path).unwrap();
        assert!(!watched.has_changed());
        std::fs::write(&path, "three").unwrap();
        assert!(!watched.has_changed(), "it is back as it was");
        std::fs::write(&path, "").unwrap();
        assert!(watched.has_changed());
    }
}
