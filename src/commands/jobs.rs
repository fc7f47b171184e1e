//! Runs jobs on other threads until all of them are done, or until Ctrl-C is pressed.

use std::fmt::Display;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use std::{panic, thread};

use indicatif::ProgressBar;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::error::Error;
use super::terminal::print_status;

/// Maximum delay until an interrupt is noticed.
const PATIENCE: Duration = Duration::from_millis(50);

/// Time between two lines about progress, if no bar is shown.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// Returns a pool of `threads` threads. If the number is zero, `RAYON_NUM_THREADS` sets it, or else there is one thread
/// per core.
///
/// # Errors
/// If the system cannot start the threads.
pub(super) fn pool(threads: usize) -> Result<ThreadPool, Error> {
    ThreadPoolBuilder::new().num_threads(threads).build().map_err(no_threads)
}

/// Returns the error for threads that the system cannot start.
pub(super) fn no_threads(why: impl Display) -> Error {
    Error::failed(format!(
        "cannot start the threads: {why}; give fewer --threads, where a command takes them, or let the \
         system start more (ulimit -u, ulimit -v)"
    ))
}

/// Returns the results of `work` for the jobs 0 to `number` - 1, in order. The result is `None` for a job that was not
/// done when `interrupted` was set. An interrupt does not wait for the threads, because some jobs take minutes and the
/// process is about to end.
pub(super) fn results<R: Send + 'static>(
    pool: &ThreadPool,
    number: usize,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    work: impl Fn(usize) -> R + Send + Sync + 'static,
) -> Vec<Option<R>> {
    let (sender, receiver) = mpsc::channel();
    pool.spawn(move || {
        (0..number).into_par_iter().for_each_with(sender, |sender, job| {
            // The receiver no longer exists after an interrupt.
            let _ = sender.send((job, work(job)));
        });
    });
    let mut results: Vec<Option<R>> = (0..number).map(|_| None).collect();
    let mut told = Instant::now();
    let mut tell_position = || {
        if progress.is_hidden() && told.elapsed() >= BETWEEN_LINES {
            told = Instant::now();
            print_status(&format!("{} of {number} {}", progress.position(), progress.message()));
        }
    };
    while let Some((job, result)) = next(&receiver, interrupted, &mut tell_position) {
        results[job] = Some(result);
        progress.inc(1);
    }
    progress.finish_and_clear();
    results
}

/// Returns the result of `work` on a new thread, or `None` if `interrupted` is set first. An interrupt does not wait
/// for the thread, because the process is about to end.
pub(super) fn result<R: Send + 'static>(
    interrupted: &AtomicBool,
    work: impl FnOnce() -> R + Send + 'static,
) -> Option<R> {
    result_within(Duration::ZERO, interrupted, work)
}

/// Like `result`, but waits for `grace` after an interrupt.
pub(super) fn result_within<R: Send + 'static>(
    grace: Duration,
    interrupted: &AtomicBool,
    work: impl FnOnce() -> R + Send + 'static,
) -> Option<R> {
    let (sender, receiver) = mpsc::channel();
    // The receiver no longer exists after an interrupt.
    let thread = thread::spawn(move || _ = sender.send(work()));
    let found = next(&receiver, interrupted, || ());
    let found = found.or_else(|| receiver.recv_timeout(grace).ok());
    if found.is_none() && !interrupted.load(Ordering::Relaxed) {
        panic::resume_unwind(thread.join().expect_err("a thread that sends nothing has panicked"));
    }
    found
}

/// Returns the next result, or `None` once no result is left or `interrupted` is set. While it waits, calls `meanwhile`
/// at least every [`PATIENCE`].
fn next<R>(
    receiver: &Receiver<R>,
    interrupted: &AtomicBool,
    mut meanwhile: impl FnMut(),
) -> Option<R> {
    while !interrupted.load(Ordering::Relaxed) {
        meanwhile();
        match receiver.recv_timeout(PATIENCE) {
            Ok(result) => return Some(result),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return None,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;

    use super::*;

    #[test]
    fn results_keep_the_order_of_their_jobs() {
        let pool = pool(3).unwrap();
        let square = |job| {
            thread::sleep(Duration::from_millis(if job % 2 == 0 { 2 } else { 0 }));
            job * job
        };
        let results = results(&pool, 20, &ProgressBar::hidden(), &AtomicBool::new(false), square);
        assert_eq!(results, (0..20).map(|job| Some(job * job)).collect::<Vec<_>>());
    }

    #[test]
    fn an_interrupt_ends_the_wait_for_a_result_and_a_panic_propagates() {
        let interrupted = AtomicBool::new(false);
        assert_eq!(result(&interrupted, || 7), Some(7));
        let panics = || -> Option<()> { result(&interrupted, || panic!("a bug")) };
        let panicked = panic::catch_unwind(panic::AssertUnwindSafe(panics));
        assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"a bug"));
        let set = Arc::new(AtomicBool::new(false));
        let (sets, (sender, receiver)) = (Arc::clone(&set), mpsc::channel::<()>());
        let found = result(&set, move || {
            sets.store(true, Ordering::Relaxed);
            // This thread ends only after nobody waits for it any more.
            receiver.recv().unwrap_err();
        });
        assert_eq!(found, None);
        drop(sender);
    }

    #[test]
    fn an_interrupt_keeps_the_finished_results() {
        let pool = pool(1).unwrap();
        let interrupted = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&interrupted);
        let work = move |job| {
            if job == 3 {
                // This thread has sent the earlier results, which need time to arrive.
                thread::sleep(Duration::from_millis(100));
                set.store(true, Ordering::Relaxed);
                thread::sleep(Duration::from_secs(1));
            }
            job
        };
        let results = results(&pool, 8, &ProgressBar::hidden(), &interrupted, work);
        assert_eq!(results[3], None);
        assert!(results[..3].iter().enumerate().all(|(job, result)| *result == Some(job)));
    }
}
