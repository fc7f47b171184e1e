//! The ruler of the universe. When a stage zooms out after a runaway body, familiar things appear on the water at its
//! scale, and a sentence states how far the body has gone.

use glam::DVec2;

use super::captions::{self, text};
use super::framed::BodyView;
use super::moment::DrawContext;
use super::sketch::{Camera, PEN, circle};
use super::{Align, Label, Picture, Rect};
use crate::look::landmarks::SilhouetteShape::{Disc, Outline, Ring};
use crate::look::landmarks::{LANDMARKS, Landmark};
use crate::look::palette::{Palette, fade, mix};
use crate::run::race::Entrant;
use crate::sim::number::{round, significant, superscript};
use crate::studio::Motion;

/// Growth of the stage at which the sentence appears.
const GROWN: f64 = 3.0;
/// Greatest and least length of a landmark, relative to the width; near both it fades.
const LENGTHS: [f32; 2] = [0.42, 0.035];
/// Largest extent up and down, relative to the height of the cell.
const HEIGHT: f32 = 0.15;
/// Least distance of a landmark from its measure, in points.
const ABOVE_MEASURE: f32 = 8.0;
/// Least height of a trail above landmarks, in points.
const LEAST_TRAIL: f32 = 24.0;
/// Distance (points) of landmarks from the middle, where the true body is; and heights of their middles, their
/// measures and the sentence above the foot of the cell.
const ASIDE: f32 = 16.0;
const FEET: [f32; 3] = [92.0, 52.0, 4.0];
/// Height of the sentence's frame, and mean width of its letters, in points.
const SENTENCE: f32 = 26.0;
const LETTER: f32 = 7.1;

/// Whether the stage, for a person who watches, has zoomed out far enough for landmarks.
pub(super) fn is_shown(moment: &DrawContext<'_>, view: &BodyView, camera: &Camera) -> bool {
    let is_zooming = moment.studio.display().motion == Motion::Live && view.grown >= GROWN;
    is_zooming && camera.unit == "m" && view.recorded_m().is_some()
}

/// A camera whose paper ends above the landmarks, so that no trail crosses them.
pub(super) fn with_short_paper(camera: &Camera) -> Camera {
    let height = camera.rect.max[1] - camera.rect.min[1];
    let bottom = camera.rect.max[1] - FEET[1] - ABOVE_MEASURE - 2.0 * HEIGHT * height;
    // On a low stage they meet, but a trail of no height would show no swing.
    let least = camera.at[1] + PEN * camera.block + LEAST_TRAIL;
    Camera { paper: f64::from(bottom.max(least) - camera.at[1]).min(camera.paper), ..*camera }
}

/// Draws landmarks about as long as the stage is wide: the largest right of the middle, the next left of it.
pub(super) fn landmarks(picture: &mut Picture, camera: &Camera, palette: &Palette) {
    let [width, height] = camera.rect.size().map(|side| side as f32);
    let fits = |landmark: &&Landmark| {
        // A high one needs enough height, too.
        let most = LENGTHS[0].min(HEIGHT * height / (landmark.half_height() * width));
        (LENGTHS[1] * width..most * width).contains(&camera.length(landmark.length_m))
    };
    let middle = camera.points(DVec2::ZERO)[0];
    for (place, landmark) in LANDMARKS.iter().rev().filter(fits).take(2).enumerate() {
        let length = camera.length(landmark.length_m);
        let left = if place == 0 { middle + ASIDE } else { middle - ASIDE - length };
        let part = length / width;
        let strength = ((LENGTHS[0] - part) / 0.06).min((part - LENGTHS[1]) / 0.02).clamp(0.0, 1.0);
        draw_landmark(picture, camera, landmark, (left, strength), palette);
    }
}

/// Draws a landmark from this point to the right with this opacity, and its length below it.
fn draw_landmark(
    picture: &mut Picture,
    camera: &Camera,
    landmark: &Landmark,
    (left, strength): (f32, f32),
    palette: &Palette,
) {
    let (length, clip) = (camera.length(landmark.length_m), camera.rect);
    let [y, below, _] = FEET.map(|foot| clip.max[1] - foot);
    let y = y.min(below - ABOVE_MEASURE - landmark.half_height() * length);
    let tone = fade(mix(palette.chart, palette.sea[1], 0.25), 0.5 * strength);
    let pen = &mut picture.pen(clip);
    let point = |[across, up]: &[f32; 2]| [left + length * across, y - length * up];
    for part in landmark.silhouette {
        match part {
            Disc(centre, radius) => pen.disc(point(centre), length * radius, tone),
            Ring(centre, radius) => {
                pen.ring(&circle(point(centre), length * radius, 96), 1.6, tone);
            }
            Outline(corners) => pen.fill(&corners.iter().map(point).collect::<Vec<_>>(), tone),
        }
    }
    let colour = fade(palette.dim, strength);
    captions::span_line(picture, ([left, left + length], below), (1.0, 4.0), colour, clip);
    let words = format!("{}, {}", landmark.names[0], landmark.length);
    let at = [left + length / 2.0, below + 13.0];
    picture.labels.push(text(palette, at, Align::Centre, 12.0, colour, words));
}

/// Writes how far a lane's body has gone instead of its swing, in a frame of the lane's colour.
pub(super) fn write_distance(
    picture: &mut Picture,
    camera: &Camera,
    moment: &DrawContext<'_>,
    (view, swing_m): (&BodyView, f64),
    (index, lane): (usize, &Entrant),
) {
    let body = &lane.lane.bodies()[index];
    let what = format!("{} m {}", round(swing_m, 2), moment.studio.scene().bodies[index].name);
    let words = match body.halted().filter(|halt| halt.is_blow_up()) {
        Some(halt) => {
            let size = body.stepper.q()[0].abs().max(view.reach_m.x);
            let power = superscript(libm::floor(libm::log10(size)) as i32);
            format!("after {} s your {what} is 10{power} m long", round(halt.t, 3))
        }
        None => {
            let since = moment.history(lane, index).since(moment.t - moment.paper_s);
            let furthest = since.map(|sample| sample.q.abs()).filter(|q| q.is_finite());
            // The newest tick may be far beyond the moment that the stage shows.
            let (left_m, right_m) = camera.span_m();
            let width_m = (2.0 * furthest.fold(0.0, f64::max)).min(right_m - left_m);
            let known = LANDMARKS.iter().rev().find(|landmark| landmark.length_m <= width_m);
            let Some(Landmark { names: [one, many], length_m, .. }) = known else { return };
            let as_wide = match width_m / length_m {
                times if times < 1.5 => (*one).to_owned(),
                times => format!("{} {many}", in_words(times)),
            };
            format!("after {} s a {what} swings as wide as {as_wide}", significant(moment.t, 2))
        }
    };
    let palette = moment.palette;
    let wide = LETTER * words.chars().count() as f32 + 32.0;
    // On a narrow stage, the full size would cross one side, or both.
    let smaller = ((camera.rect.max[0] - camera.rect.min[0]) / wide).min(1.0);
    let half = smaller * wide / 2.0;
    let [least, most] = [camera.rect.min[0] + half, camera.rect.max[0] - half];
    let middle = camera.points(DVec2::ZERO)[0].max(least).min(most);
    let bottom = camera.rect.max[1] - FEET[2];
    let frame = Rect { min: [middle - half, bottom - SENTENCE], max: [middle + half, bottom] };
    let colour = moment.style(moment.studio.entry(lane)).0;
    captions::plate(picture, frame, colour, camera.rect, palette);
    let at = [middle, bottom - SENTENCE / 2.0];
    let size = 13.0 * smaller;
    picture.labels.push(Label::new(at, Align::Centre, size, palette.text, words).strong());
}

/// A number in words if it is small.
fn in_words(times: f64) -> String {
    const WORDS: &str = "two three four five six seven eight nine ten";
    let whole = libm::round(times);
    let word = WORDS.split(' ').nth((whole as usize).saturating_sub(2));
    word.map_or_else(|| significant(times, 2), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::stage::compose;
    use crate::studio::Studio;

    const SIZE: [f32; 2] = [1280.0, 620.0];

    fn watched(scene: &str, motion: Motion) -> Studio {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.viewer.preferences.display.motion = motion;
        studio
    }

    fn texts(studio: &Studio) -> Vec<String> {
        compose(studio, SIZE).labels.into_iter().map(|label| label.text).collect()
    }

    #[test]
    fn zooming_out_passes_landmarks_and_reports_the_bodys_distance() {
        let mut studio = watched("harbour", Motion::Live);
        assert!(!texts(&studio).iter().any(|text| text.starts_with("after")));
        let mut passed = Vec::new();
        while studio.race().t() < 19.9 {
            studio.tick();
            let said = texts(&studio);
            passed.extend(
                LANDMARKS
                    .iter()
                    .filter(|landmark| said.iter().any(|text| text.starts_with(landmark.names[0]))),
            );
        }
        passed.dedup_by_key(|landmark| landmark.names[0]);
        let names: Vec<&str> = passed.iter().map(|landmark| landmark.names[0]).collect();
        for name in ["our ship", "the Eiffel Tower", "a container ship"] {
            assert!(names.contains(&name), "{names:?}");
        }
        let last = "after 20 s a 1 m spring swings as wide as three container ships";
        assert!(texts(&studio).iter().any(|text| text == last), "{:?}", texts(&studio));
        studio.viewer.preferences.display.motion = Motion::Reduced;
        assert!(!texts(&studio).iter().any(|text| text.starts_with("after")));
    }

    #[test]
    fn the_halt_reports_the_length_of_the_spring() {
        let mut studio = watched("stiff", Motion::Live);
        studio.apply(crate::studio::StageCommand::TickHz(30.into()));
        studio.apply(crate::studio::StageCommand::Restart);
        (0..60).for_each(|_| studio.tick());
        let said = texts(&studio);
        let last = "after 1.27 s your 1 m stiff spring is 10³⁶ m long";
        assert!(said.iter().any(|text| text == last), "{said:?}");
    }

    #[test]
    fn the_sentence_fits_a_narrow_stage() {
        let mut studio = watched("harbour", Motion::Live);
        (0..350).for_each(|_| studio.tick());
        for width in [320.0, 390.0, 460.0, 1280.0] {
            let labels = compose(&studio, [width, 620.0]).labels;
            let said = labels.iter().find(|label| label.text.starts_with("after")).unwrap();
            let half = LETTER / 2.0 * said.text.chars().count() as f32 * said.size / 13.0;
            let beside = [said.at[0] - half, width - said.at[0] - half];
            assert!(beside.iter().all(|room| *room >= 0.0), "{beside:?} at {width}");
        }
    }
}
