//! A loupe in the corner of a cell, for lanes too close to the truth for the eye.

use glam::DVec2;

use super::moment::DrawContext;
use super::sketch::{Camera, circle, demote};
use super::{Align, Label, Picture, Rect};
use crate::look::palette::{Rgba, fade};
use crate::run::Metric;
use crate::run::past::History;
use crate::run::race::Entrant;
use crate::sim::number::{enlargement, round};

/// Its radius, its distance from the edges of the cell, and the height of its number, in points.
const RADIUS: f32 = 36.0;
const INSET: f32 = 10.0;
const NUMBER: f32 = 10.5;
/// Least size (points) of a cell with room for it.
const ROOM: [f32; 2] = [360.0, 118.0];
/// Distance of the furthest lane, relative to the radius.
const REACH: f64 = 0.5;
/// Distance (points) from the truth at which a lane is visible without it.
const SEEN: f64 = 2.0;
/// Time (s) for which lanes must have been close to the truth: a swing of the harbour's spring.
const LATELY_S: f64 = 1.0;
/// Below this share of the truth's reach, lanes differ by rounding, or by a motion that has died away.
const ROUNDING: f64 = 1e-9;
/// Radius of a lane in it, in points.
const LANE: f32 = 4.0;
/// Corners of a polygon that looks round.
const ROUND: u8 = 48;

/// A lane under the loupe.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoupeLane<'h> {
    /// Offset from the truth at the present tick, in metres.
    off_m: DVec2,
    history: &'h History,
    colour: Rgba,
}

impl<'h> LoupeLane<'h> {
    pub(super) fn of(moment: &DrawContext<'h>, lane: &Entrant, body: usize, colour: Rgba) -> Self {
        let [place, truth] = [&lane.lane, moment.studio.race().truth()]
            .map(|lane| lane.bodies()[body].stepper.place());
        Self { off_m: place - truth, history: moment.history(lane, body), colour }
    }

    /// Largest distance from the truth since `t` (s), in metres.
    fn furthest_m(&self, t: f64) -> f64 {
        let errors = self.history.since(t).map(|sample| sample.metrics[Metric::POSITION_ERROR]);
        errors.fold(self.off_m.length(), f64::max)
    }
}

/// Draws the lanes around the truth in the upper right corner of `room`, if all of them are, and lately were, too
/// close to it to be seen. Skips the loupe if it would cover `busy`. `reach_m` is the truth's reach; the front lane
/// comes last.
pub(super) fn draw(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    camera: &Camera,
    (lanes, reach_m): (&[LoupeLane<'_>], f64),
    (room, busy): (Rect, Rect),
) {
    let t = moment.studio.race().t();
    let has_room = (0..2).all(|axis| room.max[axis] - room.min[axis] >= ROOM[axis]);
    let is_seen = |lane: &LoupeLane<'_>| camera.points_per_metre * lane.off_m.length() > SEEN;
    if lanes.len() < 2 || !has_room || t < LATELY_S || lanes.iter().any(is_seen) {
        return;
    }
    let furthest_m = lanes.iter().map(|lane| lane.furthest_m(t - LATELY_S)).fold(0.0, f64::max);
    let furthest = camera.points_per_metre * furthest_m;
    if furthest > SEEN || furthest_m < ROUNDING * reach_m {
        return;
    }
    let Some(times) = enlargement(furthest, REACH * f64::from(RADIUS)) else { return };
    let palette = moment.palette;
    let at = [room.max[0] - RADIUS - INSET, room.min[1] + RADIUS + INSET];
    if (0..2).all(|i| at[i] - RADIUS < busy.max[i] && at[i] + RADIUS > busy.min[i]) {
        return;
    }
    let [x, y] = at;
    let rim = circle(at, RADIUS, ROUND);
    let pen = &mut picture.pen(camera.rect);
    pen.fill(&rim, fade(palette.panel, 0.94));
    // The number is below.
    let middle = y - 5.0;
    let hair = fade(palette.exact, 0.45);
    let reach = RADIUS - 12.0;
    pen.line([x - reach, middle], [x + reach, middle], 1.0, hair);
    pen.line([x, middle - reach], [x, middle + reach], 1.0, hair);
    pen.ring(&circle([x, middle], 3.0, ROUND), 1.2, palette.exact);
    for lane in lanes {
        let off = lane.off_m * (camera.points_per_metre * times);
        let place = [x + demote(off.x), middle - demote(off.y)];
        pen.disc(place, LANE, lane.colour);
        pen.ring(&circle(place, LANE, ROUND), 1.0, palette.panel);
    }
    pen.ring(&rim, 1.6, palette.dim);
    let (at, words) = ([x, y + RADIUS - 1.2 * NUMBER], format!("loupe ×{}", round(times, 1)));
    picture.labels.push(Label::new(at, Align::Centre, NUMBER, palette.text, words));
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::stage::compose;
    use crate::studio::{StageCommand, Studio};

    /// The labels of the loupes on the stage after some seconds of a race between these methods.
    fn labels(scene: &str, methods: &[&str], seconds: u32) -> Vec<String> {
        let mut scene = Scene::built_in(scene).unwrap();
        let all = Studio::new(scene.clone()).entries().to_vec();
        scene.lanes = all.into_iter().filter(|spec| methods.contains(&spec.method.id)).collect();
        let mut studio = Studio::new(scene);
        studio.apply(StageCommand::ToggleRace);
        (0..seconds * studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
        let picture = compose(&studio, [800.0, 440.0]);
        let texts = picture.labels.into_iter().map(|label| label.text);
        texts.filter(|text| text.starts_with("loupe ×")).collect()
    }

    #[test]
    fn indistinguishable_lanes_get_a_loupe_with_its_scale() {
        let alone = labels("spring", &["rk4"], 3);
        assert_eq!(alone, Vec::<String>::new(), "it stands beside no other");
        let found = labels("spring", &["rk4", "yoshida4", "pefrl"], 3);
        assert_eq!(found.len(), 1, "{found:?}");
        let far = labels("spring", &["explicit-euler", "semi-implicit-euler", "rk4"], 3);
        assert_eq!(far, Vec::<String>::new(), "semi-implicit Euler can be seen");
    }

    #[test]
    fn rounding_is_not_magnified() {
        // A damped spring that has come to rest.
        let text = "title = 't'\ntick_hz = 60\nseconds = 20\nmethods = ['rk4', 'gauss-legendre-4']\n\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 90\ndamping_n_s_per_m = 4\nx0_m = 1\n";
        let mut studio = Studio::new(Scene::parse("t.toml", text).unwrap());
        studio.apply(StageCommand::ToggleRace);
        let mut shown = [2_u32, 16].map(|seconds| {
            while studio.race().t() < f64::from(seconds) {
                studio.tick();
            }
            let labels =
                compose(&studio, [800.0, 440.0]).labels.into_iter().map(|label| label.text);
            labels.filter(|text| text.starts_with("loupe ×")).count()
        });
        shown.reverse();
        assert_eq!(shown, [0, 1], "at rest, and while it moves");
    }
}
