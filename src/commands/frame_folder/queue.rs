//! Syncs and renames written frames in order, on a thread of its own: a sync takes about as long as drawing a
//! frame, and is all waiting.

use std::io;
use std::panic;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

use crate::commands::output::{AtomicFile, Older};

/// Frames that may wait for the disk. They are written already and hold no memory of ours; a loss of power
/// loses them.
const MAX_WAITING: usize = 4;

/// A written frame, and its path for messages.
type Frame = (AtomicFile, PathBuf);

/// The outcome of a closed queue.
#[derive(Debug)]
pub(super) struct Settled {
    /// How many frames have their names.
    pub(super) frames: u32,
    /// The error and the path of the next frame, if it failed.
    pub(super) failed: Option<(io::Error, PathBuf)>,
}

/// Waits for its frames when dropped.
#[derive(Debug, Default)]
pub(super) struct FrameQueue {
    /// `None` before the queue is opened and after it is closed.
    open: Option<(SyncSender<Frame>, JoinHandle<Settled>)>,
}

impl FrameQueue {
    /// Starts the thread.
    pub(super) fn open() -> Self {
        let (frames, waiting) = sync_channel(MAX_WAITING);
        Self { open: Some((frames, thread::spawn(move || settle(&waiting)))) }
    }

    /// Adds the next frame. `false` if an earlier frame failed or the queue is closed.
    pub(super) fn push(&self, file: AtomicFile, path: PathBuf) -> bool {
        self.open.as_ref().is_some_and(|(frames, _)| frames.send((file, path)).is_ok())
    }

    /// Waits until every frame has its name, or one cannot have it. Once it is closed, there is nothing
    /// to say.
    pub(super) fn close(&mut self) -> Option<Settled> {
        let (frames, thread) = self.open.take()?;
        drop(frames);
        Some(thread.join().unwrap_or_else(|bug| panic::resume_unwind(bug)))
    }
}

impl Drop for FrameQueue {
    fn drop(&mut self) {
        self.close();
    }
}

fn settle(waiting: &Receiver<Frame>) -> Settled {
    let mut frames = 0;
    for (file, path) in waiting {
        if let Err(error) = file.sync().and_then(|()| file.rename(Older::Replace)) {
            return Settled { frames, failed: Some((error, path)) };
        }
        frames += 1;
    }
    Settled { frames, failed: None }
}
