//! How far a lane exceeds the view. A stage that a person watches zooms out after it. The zoom depends only on the
//! run and the moment shown, so rewinding shows the same view again.

use glam::DVec2;

use super::lane::RaceLane;
use crate::look::Look;
use crate::run::Metric;
use crate::run::past::{History, Sample};
use crate::scene::Outline;

/// Duration (s) over which the zoom is smoothed, a swing of the harbour's spring, and number of samples in it.
const EVENED_S: f64 = 1.0;
const PARTS: u32 = 12;
/// Room for an even growth, relative to its size.
const MARGIN: f64 = 1.15;
/// Bounds of a cubic between two ticks. It stays within a line that runs ahead by the factor `AHEAD`, between ends
/// extended by the part `OVERSHOT` of a tick's motion.
const AHEAD: f64 = 1.125;
const OVERSHOT: f64 = 0.25;
/// Time (s) for which a ship's straying counts: longer than any swing that people wait for.
const REMEMBERED_S: f64 = 2.0;

/// The room of a lane on the stage, and the time for which a swing needs it.
pub(super) struct Room {
    pub(super) centre_m: DVec2,
    /// Reach of the stage without the lane, across and up, in metres.
    pub(super) base_m: DVec2,
    /// Time (s) for which a swing needs its room: as long as its trail.
    pub(super) window_s: f64,
}

impl Room {
    /// Reach of the stage with the lane, across and up, in metres.
    pub(super) fn reach_m(&self, lane: RaceLane<'_>, body: usize) -> DVec2 {
        let (t, history) = (lane.moment.t, lane.history(body));
        let furthest = |t: f64| self.max_distance_m(history, [t - self.window_s, t]);
        let part_s = EVENED_S / f64::from(PARTS);
        let ln = |reach: DVec2| DVec2::new(libm::log(reach.x), libm::log(reach.y));
        let evened = (0..PARTS).map(|i| {
            let reach = MARGIN * furthest(t - f64::from(i) * part_s);
            ln(reach.max(self.base_m) / self.base_m) / f64::from(PARTS)
        });
        let evened: DVec2 = evened.sum();
        let evened = self.base_m * DVec2::new(libm::exp(evened.x), libm::exp(evened.y));
        evened.max(furthest(t)).max(self.present_bound(lane, body))
    }

    /// The same reach in steps of a factor of 2. It returns to the base only at the next edit or placement, so the
    /// stage rests between steps.
    pub(super) fn taken_in_steps(&self, lane: RaceLane<'_>, body: usize) -> DVec2 {
        let studio = lane.moment.studio;
        let since_s = studio.past().swing_since_s(studio.race().t());
        let is_alone = lane.bodies()[body].coordinates().len() == 1;
        // Include the range swept between samples. Otherwise the stage would shrink whenever a peak falls between
        // two.
        let reach = |sample: &Sample| {
            let place = sample.at - self.centre_m;
            let [low, high] = sample.swept.ends().map(|q| (q - sample.q).abs());
            let beyond = |x: f64| if x < 0.0 { low } else { high };
            let swept = DVec2::new(beyond(place.x), beyond(place.y));
            let swept = if is_alone && swept.is_finite() { swept } else { DVec2::ZERO };
            place.abs() + swept
        };
        let reaches = lane.history(body).since(since_s).map(reach);
        let furthest = reaches.filter(|reach| reach.is_finite()).fold(DVec2::ZERO, DVec2::max);
        let taken = (MARGIN * furthest).max(self.present_bound(lane, body)).max(self.base_m);
        let times = taken / self.base_m;
        self.base_m * DVec2::new(in_steps(times.x), in_steps(times.y))
    }

    /// Largest distance of a body within a time span (s).
    fn max_distance_m(&self, history: &History, [from, to]: [f64; 2]) -> DVec2 {
        let samples = history.samples().rev().skip_while(|sample| sample.t > to);
        let samples = samples.take_while(|sample| sample.t >= from);
        let places = samples.map(|sample| (sample.at - self.centre_m).abs());
        places.filter(|place| place.is_finite()).fold(DVec2::ZERO, DVec2::max)
    }

    /// Upper bound of the present distance of a body's parts.
    fn present_bound(&self, lane: RaceLane<'_>, body: usize) -> DVec2 {
        let (moment, body) = (lane.moment, &lane.bodies()[body]);
        let look = Look::of(body);
        let race = moment.studio.race();
        let h = race.last_step_s();
        let extent = |q: &[f64], v: &[f64]| {
            let reaches = [-OVERSHOT * h, OVERSHOT * h].map(|h| {
                let q: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + h * v).collect();
                let outline = look.outline(moment.t, &q);
                let reach = parts(&outline).map(|place| (place - self.centre_m).abs());
                reach.filter(|reach| reach.is_finite()).fold(self.base_m, DVec2::max)
            });
            reaches[0].max(reaches[1])
        };
        let before = extent(&body.previous_q, &body.previous_v);
        let after = extent(body.stepper.q(), body.stepper.v());
        let part = if h > 0.0 { 1.0 - (race.t() - moment.t) / h } else { 1.0 };
        before.lerp(after, (AHEAD * part).clamp(0.0, 1.0))
    }
}

/// The smallest power of two that is at least `times`, within rounding, and at least 1.
pub(super) fn in_steps(times: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    libm::exp2(libm::ceil(libm::log2(times.max(1.0)) - ROUNDING))
}

/// Places of a body's moving parts.
fn parts(outline: &Outline) -> impl Iterator<Item = DVec2> {
    use crate::scene::Mark::Disc;
    let discs = outline.marks.iter().filter_map(|mark| match mark {
        Disc { centre, .. } => Some(*centre),
        _ => None,
    });
    let nodes = outline.threads.iter().flat_map(|thread| &thread.points).copied();
    discs.chain(nodes).chain([outline.at])
}

/// Largest recent distance (m) of a lane from the truth.
pub(super) fn strayed_m(lane: RaceLane<'_>, body: usize) -> f64 {
    let lately = lane.history(body).since(lane.moment.t - REMEMBERED_S);
    let errors = lately.map(|sample| sample.metrics[Metric::POSITION_ERROR]);
    errors.filter(|error| error.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::studio::{Motion, StageCommand, Studio};
    use crate::{Whose, compose};

    const SIZE: [f32; 2] = [780.0, 500.0];

    fn watched(scene: &str) -> Studio {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        studio
    }

    /// Whether the lane's body is on the stage, and the points per metre there.
    fn hero(studio: &Studio) -> (bool, f64) {
        let picture = compose(studio, SIZE);
        let cell = &picture.cells[0];
        let is_lane = |whose| matches!(whose, Whose::Lane { .. });
        let grip = cell.grips(studio).find(|grip| is_lane(grip.whose)).expect("it can be grabbed");
        (cell.rect.contains(grip.at), cell.camera.points_per_metre)
    }

    #[test]
    fn the_stage_zooms_out_smoothly_to_keep_a_growing_swing_visible() {
        let mut studio = watched("harbour");
        let (_, first) = hero(&studio);
        let mut last = first;
        for frame in 0..15 * 60 {
            studio.advance(16_666_667);
            let (is_seen, scale) = hero(&studio);
            assert!(is_seen, "at frame {frame}");
            assert!((0.95..1.02).contains(&(scale / last)), "{last} to {scale} at frame {frame}");
            last = scale;
        }
        assert!(last < first / 20.0, "{first} to {last} points per metre");
        // A method that keeps the swing keeps the stage at its size.
        studio.apply(StageCommand::Pick(1));
        (0..300).for_each(|_| _ = studio.advance(16_666_667));
        let (is_seen, held) = hero(&studio);
        assert!(is_seen && (0.7..1.4).contains(&(held / last)), "{last} to {held}");
        studio.apply(StageCommand::Restart);
        assert_eq!(hero(&studio).1, first);
    }

    #[test]
    fn a_recorded_stage_does_not_zoom_out() {
        let mut studio = watched("harbour");
        studio.viewer.preferences.display.motion = Motion::Recorded;
        (0..15 * 60).for_each(|_| studio.tick());
        let (_, scale) = hero(&studio);
        studio.viewer.preferences.display.motion = Motion::Live;
        assert!(hero(&studio).1 < scale / 8.0);
    }

    #[test]
    fn reduced_motion_zooms_out_in_few_steps_and_keeps_the_trail() {
        for scene in ["harbour", "spring"] {
            let mut studio = watched(scene);
            studio.viewer.preferences.display.motion = Motion::Reduced;
            studio.apply(StageCommand::Restart);
            let (_, first) = hero(&studio);
            let (mut last, mut steps) = (first, 0);
            for frame in 0..15 * 60 {
                studio.advance(16_666_667);
                let (is_seen, scale) = hero(&studio);
                assert!(is_seen, "{scene} at frame {frame}");
                let ratio = scale / last;
                assert!((ratio - 1.0).abs() < 0.05 || (0.2..0.55).contains(&ratio), "{ratio}");
                steps += u32::from(ratio < 0.9);
                last = scale;
            }
            assert!((3..9).contains(&steps), "{scene}: {steps} steps");
            let stepped = hero(&studio).1;
            studio.viewer.preferences.display.motion = Motion::Live;
            let even = hero(&studio).1;
            assert!((0.3..1.1).contains(&(stepped / even)), "{scene}: {stepped} and {even}");
            studio.viewer.preferences.display.motion = Motion::Reduced;
            let explicit =
                studio.display().theme.lane_style(studio.entries(), &studio.entries()[0]);
            let has_trail = |shape: &crate::Shape| match shape {
                crate::Shape::Path(path) => {
                    let is_own = path.points.iter().all(|at| at.colour[..3] == explicit.0[..3]);
                    path.points.len() > 60 && is_own
                }
                _ => false,
            };
            assert!(compose(&studio, SIZE).shapes.iter().any(has_trail), "{scene}");
        }
    }

    #[test]
    fn a_body_that_blows_up_stays_on_the_stage_to_its_last_tick() {
        for scene in ["stiff", "orbit", "chain", "rope"] {
            let mut studio = watched(scene);
            studio.apply(StageCommand::Pick(0));
            for frame in 0..400 {
                studio.advance(16_666_667);
                let picture = compose(&studio, SIZE);
                let cell = &picture.cells[0];
                let is_lane = |whose| matches!(whose, Whose::Lane { .. });
                let is_near = |at: [f32; 2]| {
                    [0, 1].iter().all(|&i| {
                        let room = 0.1 * (cell.rect.max[i] - cell.rect.min[i]);
                        (cell.rect.min[i] - room..cell.rect.max[i] + room).contains(&at[i])
                    })
                };
                let grips = cell.grips(&studio).filter(|grip| is_lane(grip.whose));
                let away = grips.map(|grip| grip.at).find(|at| !is_near(*at));
                assert_eq!(away, None, "{scene} at frame {frame}");
            }
        }
    }
}
