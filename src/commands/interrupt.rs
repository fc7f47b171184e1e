//! Ctrl-C, SIGTERM and SIGHUP: each sets a flag in place of ending the process, so that finished work can be kept.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use super::error::Error;
use super::jobs;

/// The flag, once the signals are watched.
static INTERRUPTED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// How long the other end of a stream may stand still after an interrupt.
const GRACE: Duration = Duration::from_millis(100);

/// A flag that is set once Ctrl-C is pressed or the system asks the process to end.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    watch(|| ())
}

/// Calls `tell` at each of these signals, unless they are watched already.
#[cfg(feature = "window")]
pub(super) fn tell_of_interrupt(tell: Box<dyn Fn() + Send>) {
    watch(tell);
}

fn watch(tell: impl Fn() + Send + 'static) -> Arc<AtomicBool> {
    let watched = INTERRUPTED.get_or_init(|| {
        let interrupted = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&interrupted);
        let heed = move || {
            set.store(true, Ordering::Relaxed);
            tell();
        };
        if let Err(error) = ctrlc::set_handler(heed) {
            log::warn!("Ctrl-C will stop the run at once: {error}");
        }
        interrupted
    });
    Arc::clone(watched)
}

/// The result of `wait`, which may wait for the other end of the stream `name` for ever.
///
/// # Errors
/// Those of `wait`, and an [`Error`] once an interrupt has come and the other end has still not moved a moment later. What
/// waits is left behind on its thread: the process is about to end.
pub(super) fn wait_for<T: Send + 'static>(
    name: &str,
    wait: impl FnOnce() -> io::Result<T> + Send + 'static,
) -> io::Result<T> {
    // Unwatched, a signal ends the process wherever it waits.
    let Some(interrupted) = INTERRUPTED.get() else { return wait() };
    let done = jobs::result_within(GRACE, interrupted, wait);
    done.unwrap_or_else(|| Err(io::Error::other(Error::interrupted_while_waiting_for(name))))
}
