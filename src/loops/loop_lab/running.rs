//! Runs the loops one at a time, so that they can run outside the window's thread. A [`LoopRequest`] goes in, and each
//! [`FoundLoop`] comes back.

use std::collections::VecDeque;
use std::sync::Arc;

use super::lane::LoopLane;
use crate::scene::Scene;
use crate::sim::integrators::Method;
use crate::{FrameTrace, POLICIES, PolicyCard};

/// One body under one method, to run in every loop over the frames of a trace.
pub struct LoopRequest {
    /// The scene with this one body only.
    pub(super) scene: Arc<Scene>,
    pub(super) method: &'static Method,
    pub(super) trace: FrameTrace,
    /// Indices of the loops in [`POLICIES`] that run first.
    pub(super) first: Vec<usize>,
    /// The engine that runs beside them.
    pub(super) engine: Option<Arc<PolicyCard>>,
}

impl LoopRequest {
    fn all(&self) -> std::ops::Range<usize> {
        0..POLICIES.len() + usize::from(self.engine.is_some())
    }

    /// Returns the indices of all loops, in the order of their runs.
    fn indices(&self) -> VecDeque<usize> {
        let is_first = |index: &usize| self.first.contains(index);
        let (first, others): (VecDeque<_>, VecDeque<_>) = self.all().partition(is_first);
        first.into_iter().chain(others).collect()
    }
}

/// Result of a [`LoopRequest`] for one loop.
pub struct FoundLoop {
    pub(super) request: Arc<LoopRequest>,
    /// Index of the loop in [`POLICIES`].
    pub(super) index: usize,
    pub(super) lane: LoopLane,
}

/// Runs the loops of the current [`LoopRequest`] in the background.
#[derive(Default)]
pub struct LoopWorker {
    request: Option<Arc<LoopRequest>>,
    /// Indices of the loops that have not run yet.
    left: VecDeque<usize>,
}

impl LoopWorker {
    /// Replaces the request; `None` cancels it.
    pub fn set_request(&mut self, request: Option<Arc<LoopRequest>>) {
        self.left = request.as_ref().map(|request| request.indices()).unwrap_or_default();
        self.request = request;
    }

    /// Whether no loop remains to run.
    pub fn is_done(&self) -> bool {
        self.left.is_empty()
    }

    /// Runs the next loop. Returns `None` if none is left, or if `stop` interrupts the run; the next call then runs the
    /// same loop again.
    pub fn work(&mut self, stop: &dyn Fn() -> bool) -> Option<FoundLoop> {
        let (request, index) = (self.request.as_ref()?, *self.left.front()?);
        let LoopRequest { scene, method, trace, engine, .. } = &**request;
        let card = POLICIES.get(index).or(engine.as_ref())?;
        let lane = LoopLane::run(scene, method, card.clone(), trace, stop);
        if stop() {
            return None;
        }
        self.left.pop_front();
        Some(FoundLoop { request: Arc::clone(request), index, lane })
    }
}
