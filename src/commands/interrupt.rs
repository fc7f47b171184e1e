//! Ctrl-C, SIGTERM and SIGHUP: each sets a flag in place of ending the process, so that finished work can be kept.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that is set once Ctrl-C is pressed or the system asks the process to end.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    if let Err(error) = ctrlc::set_handler(move || set.store(true, Ordering::Relaxed)) {
        log::warn!("Ctrl-C will stop the run at once: {error}");
    }
    interrupted
}
