//! Long work in slices. An `async` function counts its work on a [`Meter`] and pauses when the slice is over, or while
//! another function computes a value that the first one needs. No runtime is necessary, because the caller polls the
//! work.

use std::future::{Future, poll_fn};
use std::mem;
use std::pin::{Pin, pin};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll, Waker};
use std::thread;

/// Counts work in evaluations of one coordinate.
#[derive(Debug)]
pub(super) struct Meter {
    counted: AtomicU64,
    /// All work, including work outside the budget, because such work uses up the slice too.
    passed: AtomicU64,
    /// Value of `passed` at which the slice ends.
    end: AtomicU64,
    /// Maximum of `counted`.
    budget: u64,
}

impl Default for Meter {
    /// Creates a meter without slices or budget.
    fn default() -> Self {
        Self::within(u64::MAX)
    }
}

impl Meter {
    /// Creates a meter without slices that allows `budget` of counted work. Work in progress checks the budget before
    /// each run.
    pub(super) fn within(budget: u64) -> Self {
        let [counted, passed] = [AtomicU64::new(0), AtomicU64::new(0)];
        Self { counted, passed, end: AtomicU64::new(u64::MAX), budget }
    }

    /// Returns the remaining budget.
    pub(super) fn budget_left(&self) -> u64 {
        self.budget.saturating_sub(self.counted())
    }

    /// Returns the work counted up to now.
    pub(super) fn counted(&self) -> u64 {
        self.counted.load(Ordering::Relaxed)
    }

    /// Returns all work up to now.
    #[cfg(test)]
    pub(super) fn passed(&self) -> u64 {
        self.passed.load(Ordering::Relaxed)
    }

    /// Returns the work left in the slice.
    pub(super) fn work_left(&self) -> u64 {
        let passed = self.passed.load(Ordering::Relaxed);
        self.end.load(Ordering::Relaxed).saturating_sub(passed)
    }

    /// Counts work against the budget, and pauses if the slice is over.
    pub(super) async fn count(&self, work: u64) {
        self.counted.fetch_add(work, Ordering::Relaxed);
        self.yield_after(work).await;
    }

    /// Adds work outside the budget, and pauses if the slice is over.
    pub(super) async fn yield_after(&self, work: u64) {
        self.passed.fetch_add(work, Ordering::Relaxed);
        if self.work_left() == 0 {
            pause().await;
        }
    }
}

/// Returns `Pending` once.
async fn pause() {
    let mut goes_on = false;
    poll_fn(|_| if mem::replace(&mut goes_on, true) { Poll::Ready(()) } else { Poll::Pending })
        .await;
}

/// Work that proceeds slice by slice. Dropping this value cancels the work.
pub(super) struct Sliced<T> {
    meter: Arc<Meter>,
    work: Pin<Box<dyn Future<Output = T> + Send>>,
}

impl<T> Sliced<T> {
    pub(super) fn new(meter: Arc<Meter>, work: impl Future<Output = T> + Send + 'static) -> Self {
        Self { meter, work: Box::pin(work) }
    }

    #[cfg(test)]
    pub(super) fn meter(&self) -> &Arc<Meter> {
        &self.meter
    }

    /// Continues for about this much work, and returns the result when it is complete.
    pub(super) fn resume(&mut self, work: u64) -> Option<T> {
        let end = self.meter.passed.load(Ordering::Relaxed).saturating_add(work);
        self.meter.end.store(end, Ordering::Relaxed);
        let found = poll(self.work.as_mut());
        self.meter.end.store(u64::MAX, Ordering::Relaxed);
        found
    }
}

/// Completes all of the work.
pub(super) fn block_on<T>(work: impl Future<Output = T>) -> T {
    let mut work = pin!(work);
    loop {
        if let Some(found) = poll(work.as_mut()) {
            return found;
        }
        // Another thread computes the value that this work waits for.
        thread::yield_now();
    }
}

fn poll<T>(work: Pin<&mut (impl Future<Output = T> + ?Sized)>) -> Option<T> {
    match work.poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(found) => Some(found),
        Poll::Pending => None,
    }
}

/// A value that is computed once, by the first caller, while other callers pause.
pub(super) struct Once<T> {
    found: OnceLock<T>,
    is_sought: AtomicBool,
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self { found: OnceLock::new(), is_sought: AtomicBool::new(false) }
    }
}

impl<T> Once<T> {
    pub(super) fn get_if_known(&self) -> Option<&T> {
        self.found.get()
    }

    /// Returns the value, which `find` computes if it is unknown.
    pub(super) async fn get(&self, find: impl Future<Output = T>) -> &T {
        while self.get_if_known().is_none() && self.is_sought.swap(true, Ordering::Acquire) {
            pause().await;
        }
        if let Some(found) = self.get_if_known() {
            return found;
        }
        let _turn = ComputeClaim(self);
        let found = find.await;
        self.found.get_or_init(|| found)
    }
}

/// Marks the caller that computes the value. Dropping this mark gives up the claim, also if the work is cancelled.
struct ComputeClaim<'a, T>(&'a Once<T>);

impl<T> Drop for ComputeClaim<'_, T> {
    fn drop(&mut self) {
        self.0.is_sought.store(false, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slice_ends_with_the_work_that_uses_it_up() {
        let meter = Arc::<Meter>::default();
        let counts = meter.clone();
        let mut work = Sliced::new(meter.clone(), async move {
            for _ in 0..4 {
                counts.count(3).await;
            }
            counts.yield_after(10).await;
            "found"
        });
        let mut passed = Vec::new();
        let found = loop {
            let found = work.resume(5);
            passed.push(meter.passed());
            if let Some(found) = found {
                break found;
            }
        };
        assert_eq!((found, passed, meter.counted()), ("found", vec![6, 12, 22, 22], 12));
        block_on(meter.count(7));
        assert_eq!(meter.work_left(), u64::MAX - 29);
    }

    #[test]
    fn a_value_is_computed_once_unless_its_computation_was_dropped() {
        let (once, meter) = (Arc::<Once<u32>>::default(), Arc::<Meter>::default());
        let seek = |value: u32| {
            let (once, meter, counts) = (once.clone(), meter.clone(), meter.clone());
            Sliced::new(meter, async move {
                let find = async {
                    counts.count(1).await;
                    value
                };
                *once.get(find).await
            })
        };
        let mut given_up = seek(1);
        assert_eq!((given_up.resume(1), once.get_if_known()), (None, None));
        drop(given_up);
        assert_eq!([2, 3].map(|value| seek(value).resume(9)), [Some(2); 2]);
        assert_eq!(meter.counted(), 2);
    }
}
