//! Runs the loops one by one, so that it can be done on another thread than the window's: a [`LoopRequest`] goes there,
//! and each [`FoundLoop`] comes back.

use std::collections::VecDeque;
use std::sync::Arc;

use super::lane::LoopLane;
use crate::loops::{FrameTrace, POLICIES};
use crate::scene::Scene;
use crate::sim::integrators::Method;

/// A body under a method, to be run in every loop over the frames of a trace.
pub struct LoopRequest {
    /// With one body.
    pub(super) scene: Arc<Scene>,
    pub(super) method: &'static Method,
    pub(super) trace: FrameTrace,
    /// The indices of the loops in [`POLICIES`] that are run before the others.
    pub(super) first: Vec<usize>,
}

impl LoopRequest {
    /// The indices of all loops, in the order in which they are run.
    fn indices(&self) -> VecDeque<usize> {
        let is_first = |index: &usize| self.first.contains(index);
        let (first, others): (VecDeque<_>, VecDeque<_>) = (0..POLICIES.len()).partition(is_first);
        first.into_iter().chain(others).collect()
    }
}

/// The answer to a [`LoopRequest`] for one loop.
pub struct FoundLoop {
    pub(super) request: Arc<LoopRequest>,
    /// Its index in [`POLICIES`].
    pub(super) index: usize,
    pub(super) lane: LoopLane,
}

/// Runs the loops of one [`LoopRequest`] at a time, beside the window.
#[derive(Default)]
pub struct LoopWorker {
    request: Option<Arc<LoopRequest>>,
    /// The indices of the loops that are still to be run.
    left: VecDeque<usize>,
}

impl LoopWorker {
    /// Replaces the request; `None` asks for nothing.
    pub fn set_request(&mut self, request: Option<Arc<LoopRequest>>) {
        self.left = request.as_ref().map(|request| request.indices()).unwrap_or_default();
        self.request = request;
    }

    /// Whether there is nothing more to do.
    pub fn is_done(&self) -> bool {
        self.left.is_empty()
    }

    /// Runs one more loop. Returns `None` if there is none, or if `stop` ends it early: the loop is then run again by
    /// the next call.
    pub fn work(&mut self, stop: &dyn Fn() -> bool) -> Option<FoundLoop> {
        let (request, index) = (self.request.as_ref()?, *self.left.front()?);
        let LoopRequest { scene, method, trace, .. } = &**request;
        let lane = LoopLane::run(scene, method, &POLICIES[index], trace, stop);
        if stop() {
            return None;
        }
        self.left.pop_front();
        Some(FoundLoop { request: Arc::clone(request), index, lane })
    }
}
