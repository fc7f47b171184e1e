//! Work on separate threads, because one step of it can take longer than a frame: the analysis, the loops of the loop
//! lab, clouds, and the growing recording.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::caught::caught;
use crate::studio::{CurrentRequest, Work};

/// A handle to a worker's thread, which ends when this is dropped.
pub(super) struct WorkThread<W: Work> {
    requests: Sender<W::Request>,
    current: CurrentRequest<W>,
    /// Number of requests sent.
    sent: Arc<AtomicU64>,
}

impl<W> WorkThread<W>
where
    W: Work<Request: Send, Found: Into<Event>> + Send + 'static,
{
    /// Starts the thread with a worker on `request`. It sends an event whenever the worker has found something.
    pub(super) fn new(worker: W, request: W::Request, events: EventLoopProxy<Event>) -> Self {
        let (requests, received) = channel();
        let sent = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&sent);
        thread::spawn(move || run(worker, &received, &counted, &events));
        Self { requests, current: CurrentRequest(request), sent }
    }

    /// The last request sent.
    pub(super) fn request(&self) -> &W::Request {
        &self.current.0
    }

    /// Replaces the request if it has changed.
    pub(super) fn set_request(&mut self, request: W::Request) {
        if let Some(request) = self.current.replace(request) {
            self.sent.fetch_add(1, Ordering::Relaxed);
            // If the thread has ended, nothing more is found, but the window stays open.
            _ = self.requests.send(request);
        }
    }
}

fn run<W: Work<Found: Into<Event>>>(
    mut worker: W,
    requests: &Receiver<W::Request>,
    sent: &AtomicU64,
    events: &EventLoopProxy<Event>,
) {
    let mut received = 0;
    loop {
        let stop = || sent.load(Ordering::Relaxed) != received;
        let (found, more) = match caught(|| worker.step(&stop)) {
            Ok((found, more)) => (found.map(Into::into), more),
            // The next request may not meet the bug.
            Err(sentence) => (Some(Event::WorkFailed(sentence)), false),
        };
        if found.is_some_and(|found| events.send_event(found).is_err()) {
            return;
        }
        let next = match requests.try_recv() {
            Err(TryRecvError::Empty) if more => continue,
            Err(TryRecvError::Empty) => requests.recv().ok(),
            other => other.ok(),
        };
        let Some(mut next) = next else { return };
        received += 1;
        for later in requests.try_iter() {
            next = later;
            received += 1;
        }
        worker.set_request(next);
    }
}
