//! Ctrl-C, SIGTERM and SIGHUP: each sets a flag in place of ending the process, so that finished work can be kept.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::Cause;

/// Ctrl-C was pressed, or the system asked the process to end.
#[derive(Debug, thiserror::Error)]
pub(super) enum Interrupted {
    /// The result is written whole or not at all, and was not written.
    #[error("interrupted; nothing was written")]
    NothingWritten,
    /// Part of the work is done.
    #[error("interrupted after {done}")]
    After {
        /// The finished part, such as `3 of 10 frames`.
        done: String,
    },
}

impl Cause for Interrupted {
    fn exit_code(&self) -> u8 {
        130
    }
}

/// A flag that is set once Ctrl-C is pressed or the system asks the process to end.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    if let Err(error) = ctrlc::set_handler(move || set.store(true, Ordering::Relaxed)) {
        log::warn!("Ctrl-C will stop the run at once: {error}");
    }
    interrupted
}
