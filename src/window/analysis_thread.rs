//! Runs the analysis on a thread of its own, because a verdict can take longer than a frame.

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::lab::{AnalysisRequest, AnalysisWorker};

/// A handle to the thread of the analysis. The thread ends when this is dropped.
pub(super) struct AnalysisThread {
    requests: Sender<AnalysisRequest>,
    current: AnalysisRequest,
}

impl AnalysisThread {
    /// Starts the thread with `request`. It sends an event whenever it has found more.
    pub(super) fn new(request: AnalysisRequest, events: EventLoopProxy<Event>) -> Self {
        let (requests, current) = channel();
        let worker = AnalysisWorker::new(request.clone());
        thread::spawn(move || analyse(worker, &current, &events));
        Self { requests, current: request }
    }

    /// Replaces the request, if it has changed.
    pub(super) fn ask(&mut self, request: AnalysisRequest) {
        if request != self.current {
            self.current = request.clone();
            // If the thread has ended, nothing more is found; the window stays open.
            _ = self.requests.send(request);
        }
    }
}

fn analyse(
    mut worker: AnalysisWorker,
    requests: &Receiver<AnalysisRequest>,
    events: &EventLoopProxy<Event>,
) {
    loop {
        let more = worker.work();
        if events.send_event(Event::Analysed(worker.findings())).is_err() {
            return;
        }
        let next = match requests.try_recv() {
            Err(TryRecvError::Empty) if more => continue,
            Err(TryRecvError::Empty) => requests.recv().ok(),
            other => other.ok(),
        };
        let Some(next) = next else { return };
        worker.set_request(requests.try_iter().last().unwrap_or(next));
    }
}
