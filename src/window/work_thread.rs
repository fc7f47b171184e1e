//! Work on threads of its own, because one step of it can take longer than a frame: the analysis, the loops of the
//! loop lab, and clouds.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::lab::analysis::{AnalysisRequest, AnalysisWorker};
use crate::lab::cloud::{CloudRequest, CloudWorker};
use crate::lab::loop_lab::{LoopRequest, LoopWorker};

/// Something that is worked on step by step.
pub(super) trait Work: Send + 'static {
    /// What it works on.
    type Request: Clone + Send;

    /// Whether both requests are the same.
    fn is_same(one: &Self::Request, other: &Self::Request) -> bool;

    /// Replaces the request.
    fn set_request(&mut self, request: Self::Request);

    /// Does one step, which may end early when `stop` says so. Returns what the window is told, and whether there is more
    /// to do.
    fn work(&mut self, stop: &dyn Fn() -> bool) -> (Option<Event>, bool);
}

impl Work for AnalysisWorker {
    type Request = AnalysisRequest;

    fn is_same(one: &AnalysisRequest, other: &AnalysisRequest) -> bool {
        one == other
    }

    fn set_request(&mut self, request: AnalysisRequest) {
        self.set_request(request);
    }

    fn work(&mut self, _: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let more = self.work();
        ((!self.is_within_a_part()).then(|| Event::Analysed(self.findings())), more)
    }
}

impl Work for LoopWorker {
    type Request = Option<Arc<LoopRequest>>;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        one.as_ref().map(Arc::as_ptr) == other.as_ref().map(Arc::as_ptr)
    }

    fn set_request(&mut self, request: Self::Request) {
        self.set_request(request);
    }

    fn work(&mut self, stop: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let found = self.work(stop);
        (found.map(Event::LoopRun), !self.is_done())
    }
}

impl Work for CloudWorker {
    type Request = Option<Arc<CloudRequest>>;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        match (one, other) {
            (Some(one), Some(other)) => {
                one.is_alike(other)
                    && (one.tick(), one.in_time()) == (other.tick(), other.in_time())
            }
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    fn set_request(&mut self, request: Self::Request) {
        self.set_request(request);
    }

    fn work(&mut self, _: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let found = self.work();
        (found.map(|found| Event::Clouds(Box::new(found))), !self.is_done())
    }
}

/// A handle to a thread that works. The thread ends when this is dropped.
pub(super) struct WorkThread<W: Work> {
    requests: Sender<W::Request>,
    current: W::Request,
    /// How many requests were sent.
    sent: Arc<AtomicU64>,
}

impl<W: Work> WorkThread<W> {
    /// Starts the thread with a worker on `request`. It sends an event whenever it has found more.
    pub(super) fn new(worker: W, request: W::Request, events: EventLoopProxy<Event>) -> Self {
        let (requests, received) = channel();
        let sent = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&sent);
        thread::spawn(move || run(worker, &received, &counted, &events));
        Self { requests, current: request, sent }
    }

    /// The request that was sent last.
    pub(super) fn request(&self) -> &W::Request {
        &self.current
    }

    /// Replaces the request, if it has changed.
    pub(super) fn ask(&mut self, request: W::Request) {
        if !W::is_same(&request, &self.current) {
            self.current = request.clone();
            self.sent.fetch_add(1, Ordering::Relaxed);
            // If the thread has ended, nothing more is found; the window stays open.
            _ = self.requests.send(request);
        }
    }
}

fn run<W: Work>(
    mut worker: W,
    requests: &Receiver<W::Request>,
    sent: &AtomicU64,
    events: &EventLoopProxy<Event>,
) {
    let mut received = 0;
    loop {
        let (event, more) = worker.work(&|| sent.load(Ordering::Relaxed) != received);
        if event.is_some_and(|event| events.send_event(event).is_err()) {
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
