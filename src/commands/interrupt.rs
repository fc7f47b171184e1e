//! Handles Ctrl-C, SIGTERM and SIGHUP. Each signal sets a flag instead of ending the process, so that finished work can
//! be kept.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

use super::error::Error;
use super::jobs;

/// The flag that the signal handler sets, and the callback that it calls.
struct SignalState {
    interrupted: Arc<AtomicBool>,
    tell: Arc<Mutex<InterruptCallback>>,
}

/// Callback that is called at each signal.
type InterruptCallback = Option<Box<dyn Fn() + Send>>;

static SIGNAL_STATE: OnceLock<SignalState> = OnceLock::new();

/// Time that a blocked stream still has after an interrupt.
const GRACE: Duration = Duration::from_millis(100);

/// Returns a flag that is set when Ctrl-C is pressed or the system asks the process to end. Call this function before a
/// file is begun, because an unhandled signal would leave the file's temporary name behind.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    Arc::clone(&signal_state().interrupted)
}

/// Calls `tell` at each of these signals, and at once if a signal came earlier.
pub(super) fn on_interrupt(tell: Box<dyn Fn() + Send>) {
    let SignalState { interrupted, tell: told } = signal_state();
    let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
    if interrupted.load(Ordering::SeqCst) {
        tell();
    }
    *told = Some(tell);
}

fn signal_state() -> &'static SignalState {
    SIGNAL_STATE.get_or_init(|| {
        let interrupted = Arc::new(AtomicBool::new(false));
        let tell = Arc::new(Mutex::new(InterruptCallback::None));
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
        SignalState { interrupted, tell }
    })
}

/// Makes a write fail with a message if it exceeds the system's limit on a file's size (`ulimit -f`). By default, the
/// signal for this ends the process and leaves temporary files behind.
pub(super) fn survive_large_files() {
    // A signal that has a handler does not end the process. Nobody reads the flag that this handler sets.
    #[cfg(unix)]
    if let Err(error) = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default()) {
        log::warn!("a file beyond the limit of its size will stop the run at once: {error}");
    }
}

/// Runs `wait`, which may block for ever on the other end of the stream `name`.
///
/// # Errors
/// The errors of `wait`, and an [`Error`] if the other end has not moved a moment after an interrupt. In that case the
/// blocked thread stays behind, because the process is about to end.
pub(super) fn wait_for<T: Send + 'static>(
    name: &str,
    wait: impl FnOnce() -> io::Result<T> + Send + 'static,
) -> io::Result<T> {
    // A signal without a handler ends the process anyway, even while it waits.
    let Some(SignalState { interrupted, .. }) = SIGNAL_STATE.get() else { return wait() };
    let done = jobs::result_within(GRACE, interrupted, wait);
    done.unwrap_or_else(|| Err(io::Error::other(Error::interrupted_while_waiting_for(name))))
}
