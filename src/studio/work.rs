//! Work beside a studio's run. A driver does this work on separate threads, or between frames. A step of the work can
//! take longer than a frame.
//!
//! A driver may pass the present request with every frame: only a request for something else replaces the work. So
//! nobody has to decide when the work is out of date.

use std::sync::Arc;

use crate::loops::loop_lab::{FoundLoop, LoopRequest, LoopWorker};
use crate::measure::cloud::{CloudRequest, CloudWorker, FoundCloud};
use crate::measure::{AnalysisRequest, AnalysisWorker, Findings};

/// Work that proceeds step by step.
pub trait Work {
    /// The task that the work is about.
    type Request: Clone;
    /// A result of a step.
    type Found;

    /// Whether two requests ask for the same task, so that work on one also serves the other.
    fn is_same(one: &Self::Request, other: &Self::Request) -> bool;

    /// Replaces the request.
    fn set_request(&mut self, request: Self::Request);

    /// Does one step, which may end early once `stop` returns `true`. Returns the step's result, if there is one, and
    /// whether there is more to do.
    fn step(&mut self, stop: &dyn Fn() -> bool) -> (Option<Self::Found>, bool);
}

/// The present request of a worker.
pub struct CurrentRequest<W: Work>(pub W::Request);

impl<W: Work> CurrentRequest<W> {
    /// Replaces the request. Returns the new request if the worker needs it, or `None` if it asks for the same task as
    /// before.
    pub fn replace(&mut self, request: W::Request) -> Option<W::Request> {
        let is_other = !W::is_same(&request, &self.0);
        if is_other {
            self.0 = request.clone();
        }
        is_other.then_some(request)
    }
}

/// A result for a studio.
pub enum Found {
    /// Further findings of an analysis.
    Analysed(Box<Findings>),
    /// A finished loop of the loop lab.
    LoopRun(Box<FoundLoop>),
    /// Clouds after further steps.
    Clouds(Box<FoundCloud>),
}

impl Work for AnalysisWorker {
    type Request = AnalysisRequest;
    type Found = Found;

    fn is_same(one: &AnalysisRequest, other: &AnalysisRequest) -> bool {
        one == other
    }

    fn set_request(&mut self, request: AnalysisRequest) {
        self.set_request(request);
    }

    fn step(&mut self, _: &dyn Fn() -> bool) -> (Option<Found>, bool) {
        let more = self.work();
        ((!self.is_within_a_part()).then(|| Found::Analysed(self.findings().into())), more)
    }
}

impl Work for LoopWorker {
    type Request = Option<Arc<LoopRequest>>;
    type Found = Found;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        one.as_ref().map(Arc::as_ptr) == other.as_ref().map(Arc::as_ptr)
    }

    fn set_request(&mut self, request: Self::Request) {
        self.set_request(request);
    }

    fn step(&mut self, stop: &dyn Fn() -> bool) -> (Option<Found>, bool) {
        let found = self.work(stop);
        (found.map(|found| Found::LoopRun(found.into())), !self.is_done())
    }
}

impl Work for CloudWorker {
    type Request = Option<Arc<CloudRequest>>;
    type Found = Found;

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

    fn step(&mut self, _: &dyn Fn() -> bool) -> (Option<Found>, bool) {
        let found = self.work();
        (found.map(|found| Found::Clouds(found.into())), !self.is_done())
    }
}
