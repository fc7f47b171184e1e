//! Work beside the run. It is done in slices between frames, because a page has one thread.

use std::sync::Arc;

use regatta::loops::loop_lab::LoopWorker;
use regatta::measure::AnalysisWorker;
use regatta::measure::cloud::CloudWorker;
use regatta::run::Replay;
use regatta::scene::Check;
use regatta::studio::{CurrentRequest, Found, Studio, Work, cloud_request, loop_request};

/// A worker and its present request.
struct Worker<W: Work> {
    worker: W,
    current: CurrentRequest<W>,
    has_more: bool,
}

impl<W: Work<Found = Found>> Worker<W> {
    fn new(worker: W, request: W::Request) -> Self {
        Self { worker, current: CurrentRequest(request), has_more: true }
    }

    fn set_request(&mut self, request: W::Request) {
        if let Some(request) = self.current.replace(request) {
            self.worker.set_request(request);
            self.has_more = true;
        }
    }

    /// Does one step if the worker has work. Returns whether the step found something.
    fn step(&mut self, studio: &mut Studio) -> bool {
        if !self.has_more {
            return false;
        }
        // A step is never stopped, because a stopped loop would begin again with the next slice.
        let (found, has_more) = self.worker.step(&|| false);
        self.has_more = has_more;
        found.map(|found| studio.accept(found)).is_some()
    }
}

/// The workers beside the run.
pub(crate) struct Workers {
    analysis: Worker<AnalysisWorker>,
    loops: Worker<LoopWorker>,
    clouds: Worker<CloudWorker>,
}

impl Workers {
    pub(crate) fn new(studio: &Studio) -> Self {
        let request = studio.analysis_request();
        Self {
            analysis: Worker::new(AnalysisWorker::new(request.clone()), request),
            loops: Worker::new(LoopWorker::default(), None),
            clouds: Worker::new(CloudWorker::default(), None),
        }
    }

    /// Passes the studio's present requests to the workers.
    pub(crate) fn set_requests(&mut self, studio: &Studio) {
        self.analysis.set_request(studio.analysis_request());
        self.loops.set_request(loop_request(studio));
        self.clouds.set_request(cloud_request(studio).map(Arc::new));
    }

    /// Whether a worker has more to do.
    pub(crate) fn have_more(&self) -> bool {
        self.analysis.has_more || self.loops.has_more || self.clouds.has_more
    }

    /// Does one step of each worker. Returns whether any of them found something.
    pub(crate) fn step(&mut self, studio: &mut Studio) -> bool {
        let found = [self.clouds.step(studio), self.loops.step(studio), self.analysis.step(studio)];
        found.contains(&true)
    }
}

/// Number of ticks in a slice of a replay. They are little work even with many lanes.
const TICKS: u64 = 50;

/// Continues the replay for a slice. Returns a notice about the run once the outcome is known.
pub(crate) fn replay_notice(replay: &mut Replay) -> Option<String> {
    let last = replay.scene().checks.iter().map(|check| check.tick).max()?;
    let reached = replay.run_to_next_check(TICKS, &mut ());
    if let Some(reached) = reached {
        let Check { tick, hash, .. } = replay.scene().checks[reached.row];
        if reached.hash != Some(hash) {
            return Some(format!("not the run of the link: they differ from tick {tick} on"));
        }
    }
    replay.is_over().then(|| format!("the same to the bit as where it was made, to tick {last}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta::run::Session;
    use regatta::scene::Scene;

    #[test]
    fn a_linked_run_is_the_same_or_differs_from_a_named_tick_on() {
        let mut session = Session::racing(Scene::built_in("ship").unwrap().into());
        session.run(200);
        let mut recording = session.recording(200);
        let notice = |scene: &Scene| {
            let mut replay = Replay::new(scene.clone().into());
            std::iter::from_fn(|| Some(replay_notice(&mut replay))).find_map(|notice| notice)
        };
        assert!(notice(&recording).unwrap().ends_with("where it was made, to tick 200"));
        recording.checks.last_mut().unwrap().hash ^= 1;
        assert!(notice(&recording).unwrap().ends_with("from tick 200 on"));
    }
}
