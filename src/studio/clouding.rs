//! The clouds of the studio: which it wants, and how it takes them in.

use std::sync::Arc;

use super::Studio;
use super::instrument::Instrument;
use crate::measure::cloud::{
    CloudKind, CloudRequest, CloudWorker, FoundCloud, MAX_CLOUDS, NoCloud,
};
use crate::run::race::Interventions;

impl Studio {
    /// The clouds that the studio wants at present, for a [`CloudWorker`]: those of its lanes, about the start of the run or where
    /// a person or the script last acted on the bodies. `None` while the instrument is another, or the displayed body has no
    /// cloud.
    pub fn cloud_request(&self) -> Option<CloudRequest> {
        let is_shown = self.display().instrument == Instrument::Cloud && self.loop_lab().is_none();
        if !is_shown || self.cloud_refusal().is_some() {
            return None;
        }
        let changes = Interventions::all(self.run().starts());
        let (tick_hz, choice) = (self.clock.tick_hz(), self.display().cloud);
        let seconds = (self.race().t() - changes.starts_at_s()).max(0.0);
        Some(CloudRequest {
            scene: Arc::clone(&self.run.next().scene),
            body: self.view().body,
            lanes: self.clouded_lanes().map(|entry| (entry, self.entries()[entry])).collect(),
            tick_hz,
            choice,
            tick: match choice.kind {
                CloudKind::Shape(_) => (seconds * f64::from(tick_hz)).round() as u64,
                CloudKind::Section => 0,
            },
            in_time: self.running(),
            changes,
        })
    }

    /// The indices on the list of the lanes that have a cloud: all, or the first and the selected one of very many.
    fn clouded_lanes(&self) -> impl Iterator<Item = usize> {
        let lanes = self.race().entrants();
        let selected = lanes.iter().position(|lane| self.entry(lane) == self.active()).unwrap_or(0);
        let last = selected.max(MAX_CLOUDS - 1);
        let is_shown = move |index: &usize| *index + 1 < MAX_CLOUDS || *index == last;
        (0..lanes.len()).filter(is_shown).map(|index| self.entry(&lanes[index]))
    }

    /// Why the displayed body has no cloud, if it has several coordinates.
    pub fn cloud_refusal(&self) -> Option<NoCloud> {
        let body = &self.race().truth().bodies()[self.view().body];
        let coordinates = body.coordinates().len();
        let name = || self.scene().bodies[self.view().body].name.clone();
        (coordinates > 1).then(|| NoCloud::SeveralCoordinates { body: name(), coordinates })
    }

    /// The clouds, as far as they have been [found](Self::accept_cloud), at a tick near the present one; `None` while none
    /// are, or they are not shown.
    pub fn cloud(&self) -> Option<&FoundCloud> {
        let wanted = self.cloud_request()?;
        self.viewer.cloud.as_ref().filter(|found| found.request.is_alike(&wanted))
    }

    /// Keeps clouds, unless they are of another run.
    pub fn accept_cloud(&mut self, found: FoundCloud) {
        if self.cloud_request().is_some_and(|wanted| wanted.is_alike(&found.request)) {
            self.viewer.cloud = Some(found);
        }
    }

    /// Steps the clouds to the present tick, now, with a worker that may know earlier ones; `stop` ends it early.
    pub fn complete_clouds(&mut self, worker: &mut CloudWorker, stop: impl Fn() -> bool) {
        // Whoever waits for them has all their points.
        let wanted = self.cloud_request().map(|wanted| CloudRequest { in_time: false, ..wanted });
        worker.set_request(wanted.map(Arc::new));
        let mut last = None;
        while !worker.is_done() && !stop() {
            last = worker.work().or(last);
        }
        last.into_iter().for_each(|found| self.accept_cloud(found));
    }
}
