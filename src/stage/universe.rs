//! The ruler of the universe. When a stage zooms out after a runaway body, familiar things appear on the water at its
//! scale. All are of one kind, as many as the swing is wide, and a sentence counts them.

use glam::DVec2;

use super::captions::{self, text};
use super::framed::BodyView;
use super::lane::{RaceLane, StageLane};
use super::letters::width;
use super::moment::DrawContext;
use super::sketch::{Camera, PEN, circle};
use super::{Align, Label, Picture, Rect, scale_marks};
use crate::look::landmarks::SilhouetteShape::{Disc, Outline, Ring};
use crate::look::landmarks::{LANDMARKS, Landmark};
use crate::look::palette::{Palette, Rgba, fade, mix};
use crate::sim::number::{round, significant, superscript};
use crate::studio::Motion;

/// Growth of the stage at which the sentence appears.
const GROWN: f64 = 3.0;
/// Least length of a landmark, relative to the width.
const LEAST_LENGTH: f32 = 0.03;
/// Largest extent up and down, relative to the height of the cell.
const HEIGHT: f32 = 0.15;
/// Least distance of a landmark from its measure, in points.
const ABOVE_MEASURE: f32 = 8.0;
/// Least height of a trail above landmarks, in points.
const LEAST_TRAIL: f32 = 24.0;
/// Heights of the middles of landmarks, of their measure, and of the sentence above the foot of the cell, and distance
/// of their name below their measure, in points.
const FEET: [f32; 3] = [92.0, 52.0, 4.0];
const NAME: f32 = 13.0;
/// Height of the sentence's frame, mean width of its letters, and that of a name's, in points.
const SENTENCE: f32 = 26.0;
const LETTER: f32 = 7.1;
const NAME_LETTER: f32 = 6.4;
/// Least size of words on a narrow stage, relative to their usual one. Smaller ones are left out.
const LEAST_SIZE: f32 = 0.65;

/// Whether the stage, for a person who watches, has zoomed out far enough for landmarks.
pub(super) fn is_shown(moment: &DrawContext<'_>, view: &BodyView, camera: &Camera) -> bool {
    let is_zooming = moment.studio.display().motion == Motion::Live && view.grown >= GROWN;
    // Closer up, the stage holds a part of the swing, which would be counted for the whole.
    let is_whole = moment.studio.view().zoom_pan(view.zoomed_as).zoom() <= 1.0;
    is_zooming && is_whole && camera.unit == "m" && view.recorded_m().is_some()
}

/// Lower end of a trail above the landmarks, if the cell has room for both.
fn foot_of_trail(camera: &Camera) -> Option<f32> {
    let height = camera.rect.max[1] - camera.rect.min[1];
    let bottom = camera.rect.max[1] - FEET[1] - ABOVE_MEASURE - 2.0 * HEIGHT * height;
    (bottom >= camera.at[1] + PEN * camera.block + LEAST_TRAIL).then_some(bottom)
}

/// A camera whose paper ends above the landmarks, so that no trail crosses them. In a low cell it ends above the
/// sentence.
pub(super) fn with_short_paper(camera: &Camera) -> Camera {
    let bottom = foot_of_trail(camera).unwrap_or(camera.rect.max[1] - FEET[2] - SENTENCE);
    Camera { paper: f64::from((bottom - camera.at[1]).max(0.0)).min(camera.paper), ..*camera }
}

/// Both ends (m) of the swing of a lane's body on the paper, within the stage.
fn swing_m(camera: &Camera, lane: RaceLane<'_>, index: usize) -> [f64; 2] {
    let since = lane.history(index).since(lane.moment.t - lane.moment.paper_s);
    let places = since.map(|sample| sample.q).filter(|q| q.is_finite());
    let ends = places.fold([0.0_f64; 2], |[low, high], q| [low.min(q), high.max(q)]);
    // The newest tick may be far beyond the moment that the stage shows.
    let (left_m, right_m) = camera.span_m();
    ends.map(|end| end.max(left_m).min(right_m))
}

/// Landmarks of one kind in a row.
struct Row {
    landmark: &'static Landmark,
    /// How many a swing is wide, rounded down. All are drawn.
    count: usize,
    /// Left end of the row and length of one, in points.
    left: f32,
    length: f32,
}

impl Row {
    /// The row of the largest landmark that fits a swing between these places (m); `None` if the cell is too low, or
    /// each landmark would be too large or too small.
    fn of(camera: &Camera, room: Rect, [low_m, high_m]: [f64; 2]) -> Option<Self> {
        foot_of_trail(camera)?;
        let [width, height] = camera.rect.size().map(|side| side as f32);
        let across = camera.length(high_m - low_m).min(room.max[0] - room.min[0]);
        let fits = |landmark: &&Landmark| {
            let length = camera.length(landmark.length_m);
            (LEAST_LENGTH * width..=across).contains(&length)
                && landmark.half_height() * length <= HEIGHT * height
        };
        let landmark = LANDMARKS.iter().rev().find(fits)?;
        let length = camera.length(landmark.length_m);
        let count = (across / length) as usize;
        let whole = count as f32 * length;
        let middle = camera.points(DVec2::new(low_m.midpoint(high_m), 0.0))[0];
        let left = (middle - whole / 2.0).min(room.max[0] - whole).max(room.min[0]);
        Some(Self { landmark, count, left, length })
    }

    /// The row in words, such as `two tennis courts`.
    fn words(&self) -> String {
        let Landmark { names: [one, many], .. } = self.landmark;
        match self.count {
            1 => (*one).to_owned(),
            count => format!("{} {many}", in_words(count)),
        }
    }

    /// Draws the landmarks above their measure, and names them.
    fn draw(&self, picture: &mut Picture, (camera, room): (&Camera, Rect), palette: &Palette) {
        let Self { landmark, count, left, length } = *self;
        let clip = camera.rect;
        let [y, below, _] = FEET.map(|foot| clip.max[1] - foot);
        let y = y.min(below - ABOVE_MEASURE - landmark.half_height() * length);
        let tone = tone(palette);
        for number in 0..count {
            let left = left + number as f32 * length;
            let point = |[across, up]: &[f32; 2]| [left + length * across, y - length * up];
            let pen = &mut picture.pen(clip);
            for part in landmark.silhouette {
                match part {
                    Disc(centre, radius) => pen.disc(point(centre), length * radius, tone),
                    Ring(centre, radii) => {
                        let circle = circle([0.0; 2], 1.0, 96);
                        let at = |[x, y]: &[f32; 2]| {
                            point(&[centre[0] + radii[0] * x, centre[1] + radii[1] * y])
                        };
                        pen.ring(&circle.iter().map(at).collect::<Vec<_>>(), 1.6, tone);
                    }
                    Outline(at) => pen.fill(&at.iter().map(point).collect::<Vec<_>>(), tone),
                }
            }
            let ends = [left, left + length];
            scale_marks::span_line(picture, (ends, below), (1.0, 4.0), palette.dim, clip);
        }
        let each = if count == 1 { "" } else { " each" };
        let words = format!("{}, {}{each}", self.words(), landmark.length);
        let wide = width(NAME_LETTER, &words);
        let middle = left + count as f32 * length / 2.0;
        let Some((smaller, _, middle)) = fitted(room, wide, middle) else { return };
        let at = [middle, below + NAME];
        let label = text(palette, at, Align::Centre, 12.0 * smaller, palette.dim, words);
        picture.labels.push(label);
    }
}

/// Colour of the landmarks.
fn tone(palette: &Palette) -> Rgba {
    fade(mix(palette.chart, palette.sea[1], 0.25), 0.5)
}

/// Draws as many landmarks as a lane's swing is wide.
pub(super) fn landmarks(
    picture: &mut Picture,
    (camera, room): (&Camera, Rect),
    (index, lane): (usize, RaceLane<'_>),
) {
    let has_blown_up = lane.bodies()[index].halted().is_some_and(|halt| halt.is_blow_up());
    let swing_m = swing_m(camera, lane, index);
    if let Some(row) = Row::of(camera, room, swing_m).filter(|_| !has_blown_up) {
        row.draw(picture, (camera, room), lane.moment.palette);
    }
}

/// Writes how far a lane's body has gone instead of its swing, in a frame of the lane's colour.
pub(super) fn write_distance(
    picture: &mut Picture,
    (camera, room): (&Camera, Rect),
    (view, exact_m): (&BodyView, f64),
    (index, lane): (usize, RaceLane<'_>),
) {
    let (moment, body) = (lane.moment, &lane.bodies()[index]);
    let what = format!("{} m {}", round(exact_m, 2), moment.studio.scene().bodies[index].name);
    let words = match body.halted().filter(|halt| halt.is_blow_up()) {
        Some(halt) => {
            let size = body.stepper.q()[0].abs().max(view.reach_m.x);
            let power = superscript(libm::floor(libm::log10(size)) as i32);
            format!("after {} s your {what} is 10{power} m long", round(halt.t, 3))
        }
        None => {
            let swing_m = swing_m(camera, lane, index);
            let wide = match Row::of(camera, room, swing_m) {
                Some(row) => format!("wider than {}", row.words()),
                None => format!("{} m wide", significant(swing_m[1] - swing_m[0], 2)),
            };
            format!("after {} s a {what} swings {wide}", significant(moment.t, 2))
        }
    };
    let palette = moment.palette;
    let wide = width(LETTER, &words) + 32.0;
    let middle = camera.points(DVec2::ZERO)[0];
    let Some((smaller, half, middle)) = fitted(camera.rect, wide, middle) else { return };
    let bottom = camera.rect.max[1] - FEET[2];
    // In a low cell the sentence would cover the body.
    if bottom - SENTENCE < camera.at[1] + PEN * camera.block {
        return;
    }
    let frame = Rect { min: [middle - half, bottom - SENTENCE], max: [middle + half, bottom] };
    captions::plate(picture, frame, lane.colour(), camera.rect, palette);
    let at = [middle, bottom - SENTENCE / 2.0];
    let size = 13.0 * smaller;
    picture.labels.push(Label::new(at, Align::Centre, size, palette.text, words).strong());
}

/// The size of words of this width, relative to the usual one, half their width then, and the middle nearest to this
/// one at which they cross no side; `None` if they would be too small to read.
fn fitted(room: Rect, wide: f32, middle: f32) -> Option<(f32, f32, f32)> {
    let smaller = (room.sides()[0] / wide).min(1.0);
    let half = smaller * wide / 2.0;
    let middle = middle.min(room.max[0] - half).max(room.min[0] + half);
    (smaller >= LEAST_SIZE).then_some((smaller, half, middle))
}

/// A number of at least two, in words if it is small.
fn in_words(count: usize) -> String {
    const WORDS: &str = "two three four five six seven eight nine ten";
    let word = WORDS.split(' ').nth(count - 2);
    word.map_or_else(|| count.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;
    use crate::scene::Scene;
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
    fn a_narrow_stage_has_no_words_that_nobody_can_read() {
        let mut studio = watched("harbour", Motion::Live);
        (0..600).for_each(|_| studio.tick());
        for width in [0.0, 1.0, 30.0, 100.0, 200.0, 300.0, 1280.0] {
            for label in compose(&studio, [width, SIZE[1]]).labels {
                assert!(label.size >= 8.0, "{} of {} at {width}", label.text, label.size);
            }
        }
    }

    #[test]
    fn zooming_out_passes_landmarks_and_reports_the_bodys_distance() {
        let mut studio = watched("harbour", Motion::Live);
        assert!(!texts(&studio).iter().any(|text| text.starts_with("after")));
        let mut passed = Vec::new();
        while studio.race().t() < 19.9 {
            studio.tick();
            let said = texts(&studio);
            passed.extend(LANDMARKS.iter().filter(|landmark| {
                let length = format!(", {}", landmark.length);
                said.iter().any(|text| text.contains(&length))
            }));
        }
        passed.dedup_by_key(|landmark| landmark.names[0]);
        let names: Vec<&str> = passed.iter().map(|landmark| landmark.names[0]).collect();
        for name in ["our ship", "a tennis court", "a jumbo jet", "a container ship"] {
            assert!(names.contains(&name), "{names:?}");
        }
        let last = "after 20 s a 1 m spring swings wider than two container ships";
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

    /// Left, top, right and bottom of a label, in points.
    fn extent(label: &Label) -> [f32; 4] {
        let wide = 0.5 * label.size * label.text.chars().count() as f32;
        let left = match label.align {
            Align::Left => label.at[0],
            Align::Centre => label.at[0] - wide / 2.0,
            Align::Right => label.at[0] - wide,
        };
        let half = 0.5 * label.size;
        [left, label.at[1] - half, left + wide, label.at[1] + half]
    }

    fn meet(a: [f32; 4], b: [f32; 4]) -> bool {
        (0..2).all(|axis| a[axis] < b[axis + 2] && b[axis] < a[axis + 2])
    }

    /// Asserts that the sentence counts the landmarks drawn, that they fit its words, and that nothing lies over a
    /// name. Returns the landmark, if there is one.
    fn check_ruler(studio: &Studio, size: [f32; 2]) -> Option<&'static str> {
        let picture = compose(studio, size);
        let labels = &picture.labels;
        let sentence = labels.iter().find(|it| it.text.starts_with("after"))?;
        if sentence.text.contains("your") {
            return None;
        }
        let about = format!("{size:?}: {}", sentence.text);
        let tone = tone(studio.display().theme.palette());
        let is_drawn = |shape: &&crate::Shape| match shape {
            crate::Shape::Path(path) => path.points[0].colour == tone,
            crate::Shape::Fill(fill) => fill.corners[0].1 == tone,
        };
        let drawn = picture.shapes.iter().filter(is_drawn).count();
        let names = labels.iter().filter_map(|it| {
            let of = |landmark: &&Landmark| it.text.contains(&format!(", {}", landmark.length));
            Some((it, LANDMARKS.iter().find(of)?))
        });
        let names: Vec<(&Label, &Landmark)> = names.collect();
        let (text, found) = match names[..] {
            [] => {
                assert!(drawn == 0 && sentence.text.ends_with(" m wide"), "{about}, {drawn}");
                (None, None)
            }
            [(label, landmark)] => {
                let parts = landmark.silhouette.len();
                let count = drawn / parts;
                assert!(count > 0 && drawn.is_multiple_of(parts), "{about}, {drawn}");
                let row = Row { landmark, count, left: 0.0, length: 0.0 };
                let words = format!("swings wider than {}", row.words());
                assert!(sentence.text.ends_with(&words), "{about}, drawn: {}", row.words());
                assert!(label.text.starts_with(&row.words()), "{about}, {}", label.text);
                let since = studio.past().histories(studio.selected().id)[0]
                    .since(studio.race().t() - DrawContext::of(studio).paper_s);
                let [low, high] = since.fold([0.0_f64; 2], |[low, high], sample| {
                    [low.min(sample.q), high.max(sample.q)]
                });
                let whole_m = count as f64 * landmark.length_m;
                assert!(whole_m <= 1.001 * (high - low), "{about}: only {low} to {high}");
                assert_eq!(label.colour[3], 255, "{about}: its name is faded");
                (Some(label), Some(landmark.names[0]))
            }
            _ => panic!("{about}: {} names", names.len()),
        };
        for (i, a) in labels.iter().enumerate() {
            for b in &labels[i + 1..] {
                assert!(!meet(extent(a), extent(b)), "{about}: {} over {}", a.text, b.text);
            }
        }
        for label in text.into_iter().chain([sentence]) {
            let [left, top, right, bottom] = extent(label);
            assert!(left >= 0.0 && right <= size[0] && bottom <= size[1], "{about}");
            // Dotted marks and trails go down.
            let crosses = |path: &crate::Path| {
                let is_in =
                    |at: [f32; 2]| (left..right).contains(&at[0]) && (top..bottom).contains(&at[1]);
                let along = |ends: &[crate::PathPoint]| {
                    let part = |i: usize| i as f32 / 20.0;
                    let at = |i: usize, axis: usize| {
                        ends[0].at[axis] + part(i) * (ends[1].at[axis] - ends[0].at[axis])
                    };
                    (0..=20).any(|i| is_in([at(i, 0), at(i, 1)]))
                };
                path.dash[1] > 0.0 && path.points.windows(2).any(along)
            };
            let exact = studio.display().theme.palette().exact;
            let marks = picture.paths().filter(|it| it.points[0].colour[..3] == exact[..3]);
            assert!(!marks.into_iter().any(crosses), "{about}: a mark through {}", label.text);
        }
        found
    }

    #[test]
    fn the_ruler_names_and_counts_what_it_draws_at_every_width_and_moment() {
        for (scene, hz) in [("spring", 11), ("harbour", 13), ("stiff", 47)] {
            let mut found = std::collections::BTreeSet::new();
            for size in [[390.0, 420.0], [780.0, 500.0], [1280.0, 620.0], [1200.0, 90.0]] {
                let mut studio = watched(scene, Motion::Live);
                studio.apply(crate::studio::StageCommand::TickHz(hz.into()));
                studio.apply(crate::studio::StageCommand::Restart);
                while studio.race().t() < 60.0 {
                    (0..5).for_each(|_| studio.tick());
                    found.extend(check_ruler(&studio, size));
                    if studio.selected().lane.bodies()[0].halted().is_some() {
                        break;
                    }
                }
            }
            let expected =
                if scene == "stiff" { 0..=LANDMARKS.len() } else { 12..=LANDMARKS.len() };
            assert!(expected.contains(&found.len()), "{scene}: {found:?}");
        }
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
