//! How far a lane goes beyond what the stage shows. A stage that is watched zooms out after it. That follows from the run and
//! the moment shown: what is gone back to looks the same again.

use glam::DVec2;

use super::moment::DrawContext;
use crate::look::Look;
use crate::run::Metric;
use crate::run::past::{History, Sample};
use crate::run::race::Entrant;
use crate::scene::Outline;

/// For how long the zoom is evened out, in seconds: a swing of the harbour's spring; and in how many parts.
const EVENED_S: f64 = 1.0;
const PARTS: u32 = 12;
/// How much more room than it takes an even growth gets.
const MARGIN: f64 = 1.15;
/// No cubic between two ticks goes further than a line between its ends does that is so many times ahead, from where each
/// end is with so much of a tick's motion more.
const AHEAD: f64 = 1.125;
const OVERSHOT: f64 = 0.25;
/// For how long it is remembered how far a lane strayed, in seconds: longer than a swing that anybody waits for.
const REMEMBERED_S: f64 = 2.0;

/// Where a lane moves: the room that the stage has for it, and for how long it stays.
pub(super) struct Room {
    pub(super) centre_m: DVec2,
    /// How far the stage reaches without the lane, across and up, in metres.
    pub(super) base_m: DVec2,
    /// For how long a swing needs its room, in seconds: as long as its trail shows.
    pub(super) window_s: f64,
}

impl Room {
    /// How far the stage reaches with the lane, across and up, in metres.
    pub(super) fn taken(&self, moment: &DrawContext<'_>, lane: &Entrant, body: usize) -> DVec2 {
        let history = moment.history(lane, body);
        let furthest = |t: f64| self.furthest(history, [t - self.window_s, t]);
        let part_s = EVENED_S / f64::from(PARTS);
        let ln = |reach: DVec2| DVec2::new(libm::log(reach.x), libm::log(reach.y));
        let evened = (0..PARTS).map(|i| {
            let reach = MARGIN * furthest(moment.t - f64::from(i) * part_s);
            ln(reach.max(self.base_m) / self.base_m) / f64::from(PARTS)
        });
        let evened: DVec2 = evened.sum();
        let evened = self.base_m * DVec2::new(libm::exp(evened.x), libm::exp(evened.y));
        evened.max(furthest(moment.t)).max(self.present(moment, lane, body))
    }

    /// The same in steps that double it, and back to its base with the next swing only: between two steps the stage rests.
    pub(super) fn taken_in_steps(
        &self,
        moment: &DrawContext<'_>,
        lane: &Entrant,
        body: usize,
    ) -> DVec2 {
        let since_s = moment.studio.past().swing_since_s(moment.studio.race().t());
        let is_alone = lane.lane.bodies()[body].coordinates().len() == 1;
        // With what it went over between samples: else the stage would shrink when a peak is between two.
        let reach = |sample: &Sample| {
            let place = sample.at - self.centre_m;
            let [low, high] = sample.swept.ends().map(|q| (q - sample.q).abs());
            let beyond = |x: f64| if x < 0.0 { low } else { high };
            let swept = DVec2::new(beyond(place.x), beyond(place.y));
            let swept = if is_alone && swept.is_finite() { swept } else { DVec2::ZERO };
            place.abs() + swept
        };
        let reaches = moment.history(lane, body).since(since_s).map(reach);
        let furthest = reaches.filter(|reach| reach.is_finite()).fold(DVec2::ZERO, DVec2::max);
        let taken = (MARGIN * furthest).max(self.present(moment, lane, body)).max(self.base_m);
        let times = taken / self.base_m;
        self.base_m * DVec2::new(in_steps(times.x), in_steps(times.y))
    }

    /// How far a body went within a time in seconds.
    fn furthest(&self, history: &History, [from, to]: [f64; 2]) -> DVec2 {
        let samples = history.samples().rev().skip_while(|sample| sample.t > to);
        let samples = samples.take_while(|sample| sample.t >= from);
        let places = samples.map(|sample| (sample.at - self.centre_m).abs());
        places.filter(|place| place.is_finite()).fold(DVec2::ZERO, DVec2::max)
    }

    /// How far the parts of a body are now, at most.
    fn present(&self, moment: &DrawContext<'_>, lane: &Entrant, body: usize) -> DVec2 {
        let body = &lane.lane.bodies()[body];
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

/// The next power of two that is below `times` by no more than rounding.
pub(super) fn in_steps(times: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    libm::exp2(libm::ceil(libm::log2(times.max(1.0)) - ROUNDING))
}

/// The places of what moves of a body.
fn parts(outline: &Outline) -> impl Iterator<Item = DVec2> {
    use crate::scene::Mark::Disc;
    let discs = outline.marks.iter().filter_map(|mark| match mark {
        Disc { centre, .. } => Some(*centre),
        _ => None,
    });
    let nodes = outline.threads.iter().flat_map(|thread| &thread.points).copied();
    discs.chain(nodes).chain([outline.at])
}

/// How far from the truth a lane has been lately, in metres.
pub(super) fn strayed_m(moment: &DrawContext<'_>, lane: &Entrant, body: usize) -> f64 {
    let lately = moment.history(lane, body).since(moment.t - REMEMBERED_S);
    let errors = lately.map(|sample| sample.metrics[Metric::POSITION_ERROR]);
    errors.filter(|error| error.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::stage::{Whose, compose};
    use crate::studio::{Motion, StageCommand, Studio};

    const SIZE: [f32; 2] = [780.0, 500.0];

    fn watched(scene: &str) -> Studio {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        studio
    }

    /// Whether the lane's body is on the stage, and how many points a metre has there.
    fn hero(studio: &Studio) -> (bool, f64) {
        let picture = compose(studio, SIZE);
        let cell = &picture.cells[0];
        let is_lane = |whose| matches!(whose, Whose::Lane { .. });
        let grip = cell.grips(studio).find(|grip| is_lane(grip.whose)).expect("it can be grabbed");
        (cell.rect.contains(grip.at), cell.camera.points_per_metre)
    }

    #[test]
    fn the_stage_zooms_out_evenly_after_a_swing_that_outgrows_it_and_keeps_it_in_sight() {
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
        // The swing that another method keeps has the stage that it found.
        studio.apply(StageCommand::Pick(1));
        (0..300).for_each(|_| _ = studio.advance(16_666_667));
        let (is_seen, held) = hero(&studio);
        assert!(is_seen && (0.7..1.4).contains(&(held / last)), "{last} to {held}");
        studio.apply(StageCommand::Restart);
        assert_eq!(hero(&studio).1, first);
    }

    #[test]
    fn what_is_recorded_keeps_its_stage() {
        let mut studio = watched("harbour");
        studio.viewer.preferences.display.motion = Motion::Recorded;
        (0..15 * 60).for_each(|_| studio.tick());
        let (_, scale) = hero(&studio);
        studio.viewer.preferences.display.motion = Motion::Live;
        assert!(hero(&studio).1 < scale / 8.0);
    }

    #[test]
    fn with_reduced_motion_the_stage_zooms_out_as_far_but_in_few_steps_and_the_trail_is_there() {
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
            let has_trail = |shape: &crate::stage::Shape| match shape {
                crate::stage::Shape::Path(path) => {
                    let is_own = path.points.iter().all(|at| at.colour[..3] == explicit.0[..3]);
                    path.points.len() > 60 && is_own
                }
                _ => false,
            };
            assert!(compose(&studio, SIZE).shapes.iter().any(has_trail), "{scene}");
        }
    }

    #[test]
    fn what_blows_up_stays_on_the_stage_to_its_last_tick() {
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
