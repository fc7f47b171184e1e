//! Ctrl-C, SIGTERM and SIGHUP: each sets a flag in place of ending the process, so that finished work can be kept.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

use super::error::Error;
use super::jobs;

/// Whom the signals reach, once they are watched.
struct Watched {
    interrupted: Arc<AtomicBool>,
    tell: Arc<Mutex<Tell>>,
}

/// What is called at each signal.
type Tell = Option<Box<dyn Fn() + Send>>;

static WATCHED: OnceLock<Watched> = OnceLock::new();

/// How long the other end of a stream may stand still after an interrupt.
const GRACE: Duration = Duration::from_millis(100);

/// A flag that is set once Ctrl-C is pressed or the system asks the process to end. Whoever begins a file watches first: a
/// signal that ends the process would leave the file's temporary name.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    Arc::clone(&watch().interrupted)
}

/// Calls `tell` at each of these signals, and now if one has come before.
#[cfg(feature = "window")]
pub(super) fn tell_of_interrupt(tell: Box<dyn Fn() + Send>) {
    let Watched { interrupted, tell: told } = watch();
    let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
    if interrupted.load(Ordering::SeqCst) {
        tell();
    }
    *told = Some(tell);
}

fn watch() -> &'static Watched {
    WATCHED.get_or_init(|| {
        let interrupted = Arc::new(AtomicBool::new(false));
        let tell = Arc::new(Mutex::new(Tell::None));
        let (set, told) = (Arc::clone(&interrupted), Arc::clone(&tell));
        let heed = move || {
            set.store(true, Ordering::SeqCst);
            if let Some(tell) = &*told.lock().unwrap_or_else(PoisonError::into_inner) {
                tell();
            }
        };
        if let Err(error) = ctrlc::set_handler(heed) {
            log::warn!("Ctrl-C will stop the run at once: {error}");
        }
        Watched { interrupted, tell }
    })
}

/// Has a write beyond the largest file that the system allows (`ulimit -f`) fail with a message. By default the signal for it
/// ends the process, and temporary files stay.
pub(super) fn survive_large_files() {
    // A signal with a handler ends nothing; the flag that this one sets is not read.
    #[cfg(unix)]
    if let Err(error) = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default()) {
        log::warn!("a file beyond the limit of its size will stop the run at once: {error}");
    }
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
    let Some(Watched { interrupted, .. }) = WATCHED.get() else { return wait() };
    let done = jobs::result_within(GRACE, interrupted, wait);
    done.unwrap_or_else(|| Err(io::Error::other(Error::interrupted_while_waiting_for(name))))
}
