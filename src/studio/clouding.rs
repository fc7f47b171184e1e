//! The clouds of the studio: which clouds to compute, and which results to accept.

use std::sync::Arc;

use super::Studio;
use super::display::Motion;
use super::instrument::Instrument;
use crate::measure::cloud::{CloudRequest, CloudWorker, FoundCloud, NoCloud};
use crate::run::race::Interventions;

/// Returns the clouds that the studio needs now, as a request to a [`CloudWorker`]. The clouds surround the lanes from
/// the start of the run, or from the last action on the bodies by a person or the script. Returns `None` while another
/// instrument is shown, or if the displayed body has no cloud.
pub fn cloud_request(studio: &Studio) -> Option<CloudRequest> {
    let Studio { deck, viewer, loops } = studio;
    let is_shown = viewer.display().instrument == Instrument::Cloud && loops.is_none();
    if !is_shown || cloud_refusal(studio).is_some() {
        return None;
    }
    let changes = Interventions::after_last_edit(deck.run().checkpoints());
    let (tick_hz, choice) = (deck.clock.tick_hz(), viewer.display().cloud);
    // The points of later ticks may give away the answer at a stop of the guide.
    let seconds = match viewer.is_asked() {
        true => 0.0,
        false => (deck.race().t() - changes.starts_at_s()).max(0.0),
    };
    Some(CloudRequest {
        scene: Arc::clone(&deck.run.next().scene),
        body: viewer.view.body,
        lanes: deck.clouded_lanes().map(|entry| (entry, deck.spec(entry))).collect(),
        tick_hz,
        choice,
        tick: (seconds * f64::from(tick_hz)).round() as u64,
        in_time: deck.running(),
        changes,
    })
}

/// Returns the reason why the displayed body has no cloud, if it has several coordinates.
pub fn cloud_refusal(studio: &Studio) -> Option<NoCloud> {
    let body = &studio.race().truth().bodies()[studio.viewer.view.body];
    let coordinates = body.coordinates().len();
    let name = || studio.scene().bodies[studio.viewer.view.body].name.clone();
    (coordinates > 1).then(|| NoCloud::SeveralCoordinates { body: name(), coordinates })
}

/// Returns the latest [accepted](accept_cloud) clouds, at a tick near the present one. After a change to the run they
/// are those of the run before, until the first new ones are accepted. Returns `None` while there are none, or if they
/// are not shown.
pub fn shown_cloud(studio: &Studio) -> Option<&FoundCloud> {
    let wanted = cloud_request(studio)?;
    studio.viewer.cloud.as_ref().filter(|found| found.request.is_of_one_picture(&wanted))
}

/// Time for which the clouds of an opened scene stay at their start, and maximum time to wait for them, in nanoseconds.
const START_NS: i64 = 1_000_000_000;
const MAX_WAIT_NS: i64 = 3_000_000_000;

/// Frees the clouds if no cloud is needed now.
pub(super) fn free_unshown_cloud(studio: &mut Studio) {
    if studio.viewer.cloud.is_some() && cloud_request(studio).is_none() {
        studio.viewer.cloud = None;
    }
}

/// Whether time waits at the start of a scene that opens with clouds, so that a person sees the clouds whole before
/// they move. Adds this frame to the time waited.
pub(super) fn wait_for_cloud(studio: &mut Studio, frame_ns: i64) -> bool {
    let is_watched = studio.display().motion != Motion::Recorded;
    let is_at_start = studio.race().tick() == 0 && studio.scene().clouds.is_some();
    if !is_watched || !is_at_start || !studio.deck.time_runs() || cloud_request(studio).is_none() {
        return false;
    }
    let shown_ns = studio.viewer.start_shown_ns;
    match shown_cloud(studio).is_some() {
        true => {
            studio.viewer.start_shown_ns = shown_ns.max(0).saturating_add(frame_ns);
            shown_ns < START_NS
        }
        // Time without a picture of the clouds counts as negative.
        false => {
            studio.viewer.start_shown_ns = shown_ns.min(0).saturating_sub(frame_ns);
            shown_ns > -MAX_WAIT_NS
        }
    }
}

/// Accepts clouds, unless they belong to another run. The clouds shown stay until new ones, with other points, have
/// caught up with them.
pub fn accept_cloud(studio: &mut Studio, found: FoundCloud) {
    let Some(wanted) = cloud_request(studio).filter(|wanted| wanted.is_alike(&found.request))
    else {
        return;
    };
    let shown = studio.viewer.cloud.as_ref();
    let of_this_run = shown.filter(|shown| shown.request.is_of_one_run(&found.request));
    let ticks = of_this_run.and_then(|shown| {
        let [shown, found] = [shown, &found].map(|it| it.picture.as_ref().ok().map(|it| it.tick));
        Some((shown?, found?))
    });
    let has_caught_up = ticks.is_none_or(|(shown, found)| {
        found == wanted.tick || (shown.min(wanted.tick)..=shown.max(wanted.tick)).contains(&found)
    });
    if has_caught_up {
        studio.viewer.cloud = Some(found);
    }
}

/// Steps the clouds to the present tick at once. The worker may have earlier clouds already. `stop` ends the work
/// early.
pub fn complete_clouds(studio: &mut Studio, worker: &mut CloudWorker, stop: impl Fn() -> bool) {
    // A caller that waits gets all points of the clouds.
    let wanted = cloud_request(studio).map(|wanted| CloudRequest { in_time: false, ..wanted });
    worker.set_request(wanted.map(Arc::new));
    let mut last = None;
    while !worker.is_done() && !stop() {
        last = worker.work().or(last);
    }
    if let Some(found) = last {
        accept_cloud(studio, found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::cloud::CloudChoice;
    use crate::scene::Action;
    use crate::scene::Scene;
    use crate::{Command, RunCommand, StageCommand, Step, Studio, show_clouds_of_scene};

    #[test]
    fn a_lone_cloud_never_leaves_its_picture() {
        for (scene, pick) in [("spring", 0), ("spring", 1), ("pendulum", 0), ("duffing", 0)] {
            let mut studio = Studio::new(Scene::built_in(scene).unwrap());
            studio.apply(StageCommand::Pick(pick));
            studio.apply(StageCommand::Instrument(Instrument::Cloud));
            let mut worker = CloudWorker::default();
            for _ in 0..4 {
                (0..180).for_each(|_| studio.tick());
                complete_clouds(&mut studio, &mut worker, || false);
                let picture = shown_cloud(&studio).unwrap().picture.as_ref().unwrap();
                let hidden = picture.lanes[0].hidden as f64 / picture.points as f64;
                let method = studio.entries()[studio.active()].method.id;
                assert!(hidden < 0.02, "{scene}, {method}: {hidden} outside");
                let border = picture.border.concat();
                let is_in = |&[q, v]: &[f64; 2]| {
                    let at = picture.view.place(q, v);
                    at.iter().all(|part| (0.0..=1.0).contains(part))
                };
                assert!(border.iter().all(is_in), "{scene}: the exact cloud is in it too");
            }
        }
    }

    #[test]
    fn clouds_stay_until_those_with_more_points_have_caught_up() {
        let mut studio = Studio::new(Scene::built_in("liouville").unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        show_clouds_of_scene(&mut studio);
        let choice = studio.display().cloud;
        let few = CloudChoice { points: 2000, ..choice };
        studio.apply(RunCommand::Cloud(few));
        (0..40).for_each(|_| studio.tick());
        let mut worker = CloudWorker::default();
        complete_clouds(&mut studio, &mut worker, || false);
        let shown = |studio: &Studio| {
            let picture = shown_cloud(studio).expect("clouds").picture.as_ref().unwrap();
            (picture.tick, picture.points)
        };
        assert_eq!(shown(&studio), (40, 2000));
        studio.apply(RunCommand::Cloud(CloudChoice { points: 50_000, ..choice }));
        worker.set_request(cloud_request(&studio).map(Arc::new));
        let mut kept = 0;
        while !worker.is_done() {
            if let Some(found) = worker.work() {
                accept_cloud(&mut studio, found);
            }
            let (tick, points) = shown(&studio);
            assert_eq!(tick, 40);
            kept += usize::from(points == 2000);
        }
        assert_eq!(shown(&studio), (40, 50_000));
        assert!(kept > 1, "kept for {kept} pictures");
        // A run that goes on shows clouds that lag behind it, but none earlier than before.
        (0..20).for_each(|_| studio.tick());
        worker.set_request(cloud_request(&studio).map(Arc::new));
        let mut last = 40;
        while !worker.is_done() {
            if let Some(found) = worker.work() {
                accept_cloud(&mut studio, found);
            }
            assert!(shown(&studio).0 >= last);
            last = shown(&studio).0;
        }
        assert_eq!(last, 60);
    }

    #[test]
    fn clouds_of_a_run_stay_until_those_after_a_change_are_there() {
        let mut studio = Studio::new(Scene::built_in("liouville").unwrap());
        show_clouds_of_scene(&mut studio);
        let mut worker = CloudWorker::default();
        let moment = |studio: &Studio| {
            let FoundCloud { request, picture } = shown_cloud(studio).expect("clouds");
            request.t_s(picture.as_ref().unwrap())
        };
        let kick = RunCommand::Act(Action::Kick(1.0));
        for change in [Command::from(StageCommand::TickRate(Step::Previous)), kick.into()] {
            (0..40).for_each(|_| studio.tick());
            complete_clouds(&mut studio, &mut worker, || false);
            let before = moment(&studio);
            studio.apply(change);
            (0..5).for_each(|_| studio.tick());
            assert_eq!(moment(&studio), before);
            complete_clouds(&mut studio, &mut worker, || false);
            assert!(moment(&studio) > before, "{before}: {}", moment(&studio));
        }
    }

    #[test]
    fn a_scene_of_clouds_shows_its_start_for_a_second() {
        const FRAME_NS: i64 = 16_666_667;
        let mut studio = Studio::new(Scene::built_in("liouville").unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        show_clouds_of_scene(&mut studio);
        // Half a second passes until the first picture.
        (0..30).for_each(|_| _ = studio.advance(FRAME_NS));
        complete_clouds(&mut studio, &mut CloudWorker::default(), || false);
        let frames = (0..600).take_while(|_| {
            studio.advance(FRAME_NS);
            studio.race().tick() == 0
        });
        let frames = frames.count();
        assert!((60..80).contains(&frames), "{frames} frames, and up to a tick of 1/12 s");
        let mut blind = Studio::new(Scene::built_in("liouville").unwrap());
        blind.viewer.preferences.display.motion = Motion::Live;
        show_clouds_of_scene(&mut blind);
        (0..60 * 4).for_each(|_| _ = blind.advance(FRAME_NS));
        assert!(blind.race().tick() > 0, "without a worker it waits no longer than three seconds");
    }
}
