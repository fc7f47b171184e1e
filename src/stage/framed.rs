//! The view of a body's world: room for the true motion, and for that of the lane in front.

use glam::DVec2;

use super::Rect;
use super::lane::RaceLane;
use super::moment::{DrawContext, has_several_coordinates};
use super::outgrown::{Room, in_steps, strayed_m};
use super::sketch::Camera;
use crate::look::{Framing, Look, drawn_unit};
use crate::studio::{Motion, ZoomPan, exact_future, shown_state, shows_futures};

/// Height (points) at the head of a cell that a fixed camera leaves to the caption.
const HEAD: f64 = 36.0;
/// Width of the quay to which springs are moored, relative to the cell, and at most in points.
const QUAY: f32 = 0.07;
const MAX_QUAY: f32 = 56.0;
/// Side of a block relative to its cell's height, its least and greatest size in points, and its largest share of the
/// height.
const BLOCK: f32 = 0.31;
const BLOCKS: (f32, f32) = (12.0, 88.0);
const MAX_BLOCK: f32 = 0.65;
/// The largest motion of a lane that the camera still shows, relative to the true one. The first
/// applies along a chart recorder, the second to bodies that move across and up.
const MAX_SWING: f64 = 2.3;
const MAX_ROOM: f64 = 5.0;
/// Largest distance of a ship from the true body before the stage zooms out, relative to the view.
const STRAYED: f64 = 0.35;
/// Chart recorders share one scale if theirs differ by less than this factor.
const ALIKE: f64 = 5.0;

/// The part of the world that a camera fits into its cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyView {
    pub(super) framing: Framing,
    /// Place (m) at which a camera looks if it follows its body.
    pub(super) followed: DVec2,
    /// Largest distance of a body from the camera's centre, along x and along y, in metres.
    pub(super) reach_m: DVec2,
    pub(super) turns: bool,
    /// Index in the scene of the body whose zoom and pan apply.
    pub(super) zoomed_as: usize,
    /// Factor by which the view has grown because a lane outgrew the stage.
    pub(super) grown: f64,
}

/// The views of a scene's bodies that share a stage. The lane in front gets enough room. Chart recorders share one
/// quay and one zoom; those of similar scales share one scale.
pub(super) fn on_one_stage(mut views: Vec<BodyView>, front: RaceLane<'_>) -> Vec<BodyView> {
    let first = views.iter().position(|view| view.recorded_m().is_some());
    let recorded = |view: &BodyView| view.recorded_m().unwrap_or_default();
    let widest_m = views.iter().map(recorded).fold(0.0, f64::max);
    let is_alike: Vec<bool> = views.iter().map(|view| recorded(view) * ALIKE > widest_m).collect();
    share(&mut views, &is_alike);
    let before: Vec<f64> = views.iter().map(BodyView::half_m).collect();
    for (index, view) in views.iter_mut().enumerate() {
        *view = view.widened(front, index);
    }
    share(&mut views, &is_alike);
    for (view, before_m) in views.iter_mut().zip(before) {
        if front.moment.studio.display().motion != Motion::Recorded {
            view.grown = view.half_m() / before_m;
        }
        if let Framing::Recorder { .. } = view.framing {
            view.zoomed_as = first.unwrap_or(view.zoomed_as);
        }
    }
    views
}

/// Gives similar chart recorders the scale of the widest.
fn share(views: &mut [BodyView], is_alike: &[bool]) {
    let alike = views.iter().zip(is_alike).filter(|(_, is_alike)| **is_alike);
    let widest_m = alike.filter_map(|(view, _)| view.recorded_m()).fold(0.0, f64::max);
    for (view, _) in views.iter_mut().zip(is_alike).filter(|(_, is_alike)| **is_alike) {
        if let Framing::Recorder { half_width_m } = &mut view.framing {
            *half_width_m = widest_m;
        }
    }
}

impl BodyView {
    /// Half the width (m) that a chart recorder shows.
    pub(super) fn recorded_m(&self) -> Option<f64> {
        match self.framing {
            Framing::Recorder { half_width_m } => Some(half_width_m.max(1.1 * self.reach_m.x)),
            Framing::Follow { .. } | Framing::Fixed { .. } => None,
        }
    }

    /// Half the size (m) of the view, along the larger axis.
    fn half_m(&self) -> f64 {
        match self.framing {
            Framing::Recorder { half_width_m } => half_width_m.max(1.1 * self.reach_m.x),
            Framing::Fixed { half_m, .. } => half_m.max(1.05 * self.reach_m).max_element(),
            Framing::Follow { width_m, .. } => width_m / 2.0,
        }
    }

    /// Makes room for the lane in front: up to some times the true motion, or without limit for a person
    /// who watches.
    fn widened(mut self, lane: RaceLane<'_>, body: usize) -> Self {
        let studio = lane.moment.studio;
        if studio.display().motion != Motion::Recorded {
            return self.outgrown(lane, body);
        }
        let since_s = studio.past().swing_since_s(studio.race().t());
        let furthest = |centre_m: DVec2| {
            let samples = lane.history(body).since(since_s);
            let places = samples.map(|s| (s.at - centre_m).abs()).filter(|at| at.is_finite());
            places.fold(DVec2::ZERO, DVec2::max)
        };
        match self.framing {
            Framing::Recorder { half_width_m } => {
                let most = MAX_SWING * half_width_m.max(self.reach_m.x);
                self.reach_m.x = self.reach_m.x.max(furthest(DVec2::ZERO).x.min(most));
            }
            Framing::Fixed { centre_m, half_m, .. } => {
                let most = MAX_ROOM * half_m.max(self.reach_m);
                self.reach_m = self.reach_m.max(furthest(centre_m).min(most));
            }
            Framing::Follow { .. } => {}
        }
        self
    }

    /// Makes room for all of a lane's motion; with reduced motion, in steps. Where futures are shown, the exact one has
    /// room. It is the same at every tick rate, so that the view rests while a person drags the rate.
    fn outgrown(mut self, lane: RaceLane<'_>, body: usize) -> Self {
        let studio = lane.moment.studio;
        let future = shows_futures(studio).then(|| exact_future(&studio.deck, lane.entrant, body));
        let future = future.flatten().map_or(Vec::new(), |future| future.moments);
        let ahead_m = |centre_m: DVec2| {
            let places = future.iter().map(|moment| (moment.at - centre_m).abs());
            places.filter(|place| place.is_finite()).fold(DVec2::ZERO, DVec2::max)
        };
        let is_stepped = studio.display().motion == Motion::Reduced;
        let taken = |room: Room| match is_stepped {
            true => room.taken_in_steps(lane, body),
            false => room.reach_m(lane, body),
        };
        match &mut self.framing {
            Framing::Recorder { half_width_m } => {
                let base_m = DVec2::new(half_width_m.max(1.1 * self.reach_m.x) / 1.1, f64::MAX);
                let room = Room { centre_m: DVec2::ZERO, base_m, window_s: lane.moment.paper_s };
                self.reach_m.x = taken(room).x.max(ahead_m(DVec2::ZERO).x);
            }
            Framing::Fixed { centre_m, half_m, trail_s } => {
                let base_m = half_m.max(1.05 * self.reach_m) / 1.05;
                let room = Room { centre_m: *centre_m, base_m, window_s: *trail_s };
                self.reach_m = taken(room).max(ahead_m(*centre_m));
            }
            Framing::Follow { width_m, height_m, .. } => {
                let wide = if self.turns { width_m.min(*height_m) } else { *width_m };
                let times = (strayed_m(lane, body) / (STRAYED * wide)).max(1.0);
                let times = if is_stepped { in_steps(times) } else { times };
                (*width_m, *height_m) = (times * *width_m, times * *height_m);
            }
        }
        self
    }
}

/// Width of the quay at the left of a cell, in points.
pub(super) fn quay_width(cell: Rect) -> f32 {
    (QUAY * cell.size()[0] as f32).min(MAX_QUAY)
}

impl DrawContext<'_> {
    /// The camera of a cell for the body with this index in the scene, with the person's zoom and pan.
    pub(super) fn camera(&self, rect: Rect, index: usize, view: &BodyView) -> Camera {
        let unit = drawn_unit(&self.studio.race().truth().bodies()[index].kind);
        let camera = Camera { unit, ..self.fitted(rect, view) }.grown(view.grown);
        let zoom_pan = self.studio.view().zoom_pan(view.zoomed_as);
        if zoom_pan == ZoomPan::default() {
            return camera;
        }
        // Bodies on one ruler move together across.
        let [across, own] = [view.zoomed_as, index].map(|body| {
            let body = &self.studio.selected().lane.bodies()[body];
            let (q, _) = shown_state(self.studio, body);
            rect.part(camera.points(Look::of(body).outline(self.t, &q).at))
        });
        camera.zoomed(zoom_pan.keeping([across[0], own[1]]))
    }

    fn fitted(&self, rect: Rect, view: &BodyView) -> Camera {
        let [width, height] = rect.size();
        let block = (BLOCK * height as f32).clamp(BLOCKS.0, BLOCKS.1);
        let plain = Camera::of(rect, block.min(MAX_BLOCK * height as f32));
        let middle = plain.at;
        match view.framing {
            Framing::Follow { width_m, height_m, .. } => {
                let centre_m = if self.studio.display().motion != Motion::Reduced {
                    view.followed
                } else {
                    // The view moves page by page, so that only the ship moves.
                    let (page, leaf) = (0.6 * width_m, 0.5 * height_m);
                    let x = (libm::floor(view.followed.x / page) + 0.5) * page;
                    DVec2::new(x, libm::round(view.followed.y / leaf) * leaf)
                };
                // On a straight course, a place ahead of the middle leaves room for the wake.
                let ahead = if view.turns { 0.0 } else { 0.1 };
                let at = [middle[0] + ahead * width as f32, middle[1] + 0.06 * height as f32];
                let half_m = DVec2::new(width_m, height_m) / 2.0;
                Camera { at, ..plain.fitting(centre_m, half_m, [width, height]) }
            }
            Framing::Recorder { half_width_m } => {
                let half_width_m = view.recorded_m().unwrap_or(half_width_m);
                let quay = quay_width(rect);
                let half = (width as f32 - quay) / 2.0;
                let head = (HEAD as f32).min(0.22 * height as f32);
                let at = [rect.min[0] + quay + half, rect.min[1] + head + 0.55 * plain.block];
                let points_per_metre = f64::from(half) / (1.03 * half_width_m);
                let paper = f64::from(rect.max[1] - at[1]);
                let quay_m = -f64::from(half) / points_per_metre;
                Camera { at, points_per_metre, paper, quay_m, ..plain }
            }
            Framing::Fixed { centre_m, half_m, .. } => {
                let half_m = half_m.max(1.05 * view.reach_m);
                let head = HEAD.min(height / 4.0);
                let at = [middle[0], middle[1] + head as f32 / 2.0];
                Camera { at, ..plain.fitting(centre_m, half_m, [width, height - head]) }
            }
        }
    }

    /// Width and height (m) of the view, for the only body of a scene that moves across and up. Other bodies move
    /// along rows.
    pub(super) fn shape(&self, view: &BodyView) -> Option<DVec2> {
        let [body] = self.studio.race().truth().bodies() else { return None };
        match view.framing {
            Framing::Fixed { half_m, .. } => Some(half_m),
            Framing::Follow { width_m, height_m, .. } if has_several_coordinates(body) => {
                Some(DVec2::new(width_m, height_m))
            }
            Framing::Follow { .. } | Framing::Recorder { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio, ViewCommand};

    #[test]
    fn the_view_follows_the_stray_orbit_of_the_selected_lane() {
        for (is_race, selected, is_seen) in [(false, 0, true), (true, 0, true), (true, 1, false)] {
            let mut studio = Studio::new(Scene::built_in("orbit").unwrap());
            studio.apply(StageCommand::Pick(0));
            if is_race {
                studio.apply(StageCommand::ToggleRace);
                studio.apply(StageCommand::Pick(selected));
            }
            (0..9 * studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
            let picture = compose(&studio, [800.0, 440.0]);
            let camera = &picture.cells[0].camera;
            let place = studio.race().entrants()[0].lane.bodies()[0].stepper.place();
            let truth = studio.race().truth().bodies()[0].stepper.place();
            assert!(camera.rect.contains(camera.points(truth)));
            assert_eq!(camera.rect.contains(camera.points(place)), is_seen, "{place}");
        }
    }

    #[test]
    fn bodies_on_one_ruler_zoom_together_with_it() {
        for over in [0, 1] {
            let mut studio = Studio::new(Scene::with_two_springs());
            studio.advance(100_000_000);
            let before = compose(&studio, [780.0, 500.0]);
            let zoomed_as = before.cells[over].zoomed_as;
            let zoom_pan = studio.view().zoom_pan(zoomed_as).zoomed(0.5, [0.1, 0.0]);
            studio.apply(ViewCommand::ZoomPan { body: zoomed_as, zoom_pan });
            let after = compose(&studio, [780.0, 500.0]);
            let [free, damped, ship] = [0, 1, 2].map(|body| after.cells[body].camera);
            assert_eq!(free.points_per_metre, before.cells[0].camera.points_per_metre / 2.0);
            let scale = |camera: &Camera| (camera.points_per_metre, camera.at[0], camera.quay_m);
            assert_eq!(scale(&free), scale(&damped), "over {over}");
            let nought = after.labels.iter().find(|it| it.text == "0 m" && it.at[1] < 24.0);
            assert_eq!(nought.map(|label| label.at[0]), Some(free.points(DVec2::ZERO)[0]));
            assert_eq!(ship, before.cells[2].camera, "it has marks of its own");
        }
    }
}
