//! Words and marks on the stage: names, distances, verdicts and halts.

use glam::DVec2;

use super::moment::{DrawContext, has_several_coordinates};
use super::sketch::{Camera, rounded};
use super::{Align, Label, Picture, Rect, breakpoints};
use crate::look::Look;
use crate::look::palette::{Palette, Rgba, STALE, fade};
use crate::measure::{Outcome, Severity};
use crate::run::race::{Entrant, Halt, LaneBody};
use crate::scene::Mark;
use crate::sim::number::{round, significant};
use crate::studio::Studio;
use crate::studio::{pace_in_words, shown_state, shown_truth};

/// Room of a scale bar at the right of a cell, in points.
const BAR_MARGIN: f32 = 130.0;
/// Height of a chip, in points.
const CHIP: f32 = 27.0;
/// Upper bounds of the mean letter width (points): in a body's name, in a verdict, and in other words at a cell's
/// head.
const NAME_LETTER: f32 = 8.5;
const VERDICT_LETTER: f32 = 7.6;
const LETTER: f32 = 6.7;
/// Least width (points) of the column of lane names at the left of a race: where names fit, and where only numbers
/// do.
const LANES: (f32, f32) = (124.0, 18.0);
/// Largest share of the stage for lane names.
const MAX_FOR_LANES: f32 = 0.28;
/// Distance (points) of a lane's name from the left edge of its column.
const LANE_INSET: f32 = 8.0;
/// Room (points) of a ghost's name besides its letters.
const BESIDE_NAME: f32 = 18.0;
/// Side of the sign of a pause, in points.
const PAUSE: f32 = 34.0;
/// Height (points) of an answer's lines above the foot of a cell, clear of the halts there.
const ANSWER: [f32; 2] = [60.0, 44.0];
/// Distance (points) of captions from the left edge of a wide cell.
const WIDE_INSET: f32 = 62.0;

/// Text on the water.
pub(super) fn text(
    palette: &Palette,
    at: [f32; 2],
    align: Align,
    size: f32,
    colour: Rgba,
    text: String,
) -> Label {
    Label::new(at, align, size, colour, text).on_water(palette)
}

fn lane_name(studio: &Studio, entrant: &Entrant) -> String {
    let entry = studio.entry(entrant);
    format!("{} {}", entry + 1, studio.lane_name(entry))
}

/// Width (points) of the left column in which [`lane`] names these entrants, on a stage of width `stage`.
pub(super) fn lanes_width(studio: &Studio, entrants: &[&Entrant], stage: f32) -> f32 {
    let width =
        |lane: &&Entrant| LANE_INSET + LETTER * lane_name(studio, lane).chars().count() as f32;
    let widest = entrants.iter().map(width).fold(LANES.0, f32::max);
    if stage >= breakpoints::LANE_NAMES { widest.min(MAX_FOR_LANES * stage) } else { LANES.1 }
}

/// Names a lane at the left of its row, and marks the selected one with a bar.
pub(super) fn lane(picture: &mut Picture, rect: Rect, moment: &DrawContext<'_>, entrant: &Entrant) {
    let studio = moment.studio;
    let entry = studio.entry(entrant);
    let (colour, _) = moment.style(entry);
    let (left, right) = (rect.min[0] + LANE_INSET, rect.max[0]);
    let middle = (rect.min[1] + rect.max[1]) / 2.0;
    if entrant.id == studio.selected().id {
        let (top, bottom) = (rect.min[1] + 4.0, rect.max[1] - 4.0);
        let x = rect.min[0] + 2.5;
        picture.pen(rect).line([x, top], [x, bottom.max(top)], 3.0, colour);
    }
    // With many lanes, a row is lower than a line of the usual size.
    let size = (0.78 * (rect.max[1] - rect.min[1])).min(12.0);
    let mut write = |y, colour, words: String| {
        let at = [left, y];
        picture.labels.push(text(moment.palette, at, Align::Left, size, colour, words));
    };
    let mut name = lane_name(studio, entrant);
    if right - left < breakpoints::CAPTION[0] {
        write(middle, colour, format!("{}", entry + 1));
        return;
    }
    // The extra half point allows for a column exactly as wide as its widest name.
    let letters = ((right - left + 0.5) / LETTER) as usize;
    if name.chars().count() > letters {
        name = name.chars().take(letters - 1).chain(['…']).collect();
    }
    // In a scene of several bodies, each body's cell reports its halt.
    let alone = match entrant.lane.bodies() {
        [body] => body.halted(),
        _ => None,
    };
    let y = if alone.is_some() { middle - 8.0 } else { middle };
    write(y, colour, name);
    if let Some(halt) = alone {
        write(middle + 8.0, moment.palette.bad, fate_within(halt, right - left));
    }
}

/// The end of a body and its time, or only the end if the width is too small.
fn fate_within(halt: &Halt, width: f32) -> String {
    let fate = halt.fate();
    if LETTER * fate.chars().count() as f32 <= width {
        return fate;
    }
    halt.ending().into()
}

/// Caption for a body whose exact motion would take too much work.
const NO_COMPARISON: &str = "Too many springs for an exact comparison; judged by its energy.";

/// Reports at the foot of a cell which bodies halted, and whether the truth did. The caller leaves out bodies whose
/// halt shows beside the lane's name.
pub(super) fn halts<'h>(
    picture: &mut Picture,
    rect: Rect,
    bodies: impl Iterator<Item = (Option<usize>, &'h Halt)>,
    truth: &LaneBody,
    palette: &Palette,
) {
    let width = rect.max[0] - rect.min[0];
    if width < breakpoints::CAPTION[0] {
        return;
    }
    let of_bodies = bodies.map(|(lane, halt)| match lane {
        None => fate_within(halt, width - 9.0 - inset(rect)),
        Some(lane) => format!("{lane} {}", halt.fate()),
    });
    let of_bodies: Vec<String> = of_bodies.collect();
    let of_bodies = (!of_bodies.is_empty()).then(|| of_bodies.join(" · "));
    let of_truth = truth.halted().map(|halt| match halt.failure.is_foreseen() {
        true => (NO_COMPARISON.to_owned(), palette.dim),
        false => (format!("{} from tick {} on", truth.truth().missing(), halt.tick), palette.bad),
    });
    let of_bodies = of_bodies.map(|words| (words, palette.bad));
    for ((words, colour), y) in of_bodies.into_iter().chain(of_truth).zip([12.0, 27.0]) {
        let at = [rect.min[0] + 9.0 + inset(rect), rect.max[1] - y];
        picture.labels.push(text(palette, at, Align::Left, 11.0, colour, words));
    }
}

/// Distance of captions from the left edge of a wide cell, where the quay may be.
fn inset(rect: Rect) -> f32 {
    let is_wide = rect.max[0] - rect.min[0] > breakpoints::NUMBERS;
    if is_wide { (WIDE_INSET - rect.min[0]).max(6.0) } else { 0.0 }
}

/// Names a body at the head of its cell.
pub(super) fn name(picture: &mut Picture, rect: Rect, moment: &DrawContext<'_>, index: usize) {
    if let Some(at) = caption_place(rect) {
        let name = capitalised(&moment.studio.scene().bodies[index].name);
        let size = if inset(rect) > 0.0 { 14.0 } else { 11.5 };
        let label = text(moment.palette, at, Align::Left, size, moment.palette.text, name);
        picture.labels.push(label.strong());
    }
}

/// The room of a body's name at the head of its cell, if the cell has one.
pub(super) fn name_room(rect: Rect, moment: &DrawContext<'_>, index: usize) -> Option<Rect> {
    let [x, y] = caption_place(rect)?;
    let letters = moment.studio.scene().bodies[index].name.chars().count();
    Some(Rect { min: [x, y - 7.0], max: [x + NAME_LETTER * letters as f32, y + 7.0] })
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Writes the expected motion beside a body's name, and the method's fault at the right. If both do not fit, only the
/// fault.
pub(super) fn head(
    picture: &mut Picture,
    rect: Rect,
    moment: &DrawContext<'_>,
    index: usize,
    entrant: &Entrant,
) {
    let Some([x, y]) = caption_place(rect) else { return };
    let body = &entrant.lane.bodies()[index];
    let name = moment.studio.scene().bodies[index].name.chars().count();
    let left = x + NAME_LETTER * name as f32 + 14.0;
    let (words, colour) = beside_name(moment, index, body);
    let right = left + LETTER * words.chars().count() as f32 + 14.0;
    let chip =
        Chip::of(moment, index, entrant).filter(|_| rect.max[1] - rect.min[1] >= breakpoints::CHIP);
    let room_for = |from: f32| rect.max[0] - 10.0 - from;
    let beside_both = chip.as_ref().and_then(|chip| chip.longest_within(room_for(right)));
    let alone = chip.as_ref().and_then(|chip| chip.longest_within(room_for(left)));
    // The chip of a halted body already reports the halt.
    if right <= rect.max[0] && (beside_both.is_some() && body.halted().is_none() || alone.is_none())
    {
        let at = [left, y + 0.5];
        picture.labels.push(text(moment.palette, at, Align::Left, 12.5, colour, words));
    }
    if let Some(chip) = beside_both.or(alone) {
        chip.draw(picture, rect, moment.palette);
    }
}

/// Words beside a body's name, and their colour: its halt, its place while a person holds it, or else its expected
/// motion.
fn beside_name(moment: &DrawContext<'_>, index: usize, body: &LaneBody) -> (String, Rgba) {
    let (studio, palette) = (moment.studio, moment.palette);
    if let Some(halt) = body.halted() {
        return (halt.fate(), palette.bad);
    }
    let held = studio.deck.held().filter(|held| held.body == index);
    let words = match held {
        Some(held) => {
            let (coordinate, plotted) = studio.past().coordinate(studio.race(), index);
            let place = significant(held.q[plotted], 4);
            format!("{} = {place} {}", coordinate.name, coordinate.shown_unit())
        }
        // The expected motion may give away the answer at a stop of the guide.
        None if studio.viewer.is_asked() => String::new(),
        None => {
            let truth = &studio.race().truth().bodies()[index];
            let (q, v) = shown_truth(&studio.deck, &studio.viewer, index);
            let motion = Look::of(truth).describe_motion(&q, &v);
            // The bar above the instruments says it too.
            let is_told = index == 0 && !studio.display().measure;
            let pace = pace_in_words(&studio.deck, &studio.viewer).filter(|_| is_told);
            motion.into_iter().chain(pace).collect::<Vec<_>>().join(" · ")
        }
    };
    (words, palette.dim)
}

/// Writes the speed of a ship on a straight course ahead of its bow, where no other words are.
pub(super) fn speed(
    picture: &mut Picture,
    camera: &Camera,
    moment: &DrawContext<'_>,
    index: usize,
    entrant: &Entrant,
) {
    let body = &entrant.lane.bodies()[index];
    let (q, v) = shown_state(&moment.studio.deck, &moment.studio.viewer, body);
    let outline = Look::of(body).outline(moment.t, &q);
    let bow = outline.marks.iter().find_map(|mark| match mark {
        Mark::Hull { length, .. } if !has_several_coordinates(body) => {
            Some(DVec2::new(length / 2.0, 0.0))
        }
        _ => None,
    });
    let Some(bow) = bow else { return };
    let [x, y] = camera.points(outline.at + bow);
    let words = format!("{} {}/s", significant(v[0], 2), camera.unit);
    let (at, palette) = ([x + 14.0, y - 12.0], moment.palette);
    let label = text(palette, at, Align::Left, 14.0, palette.text, words);
    let [left, right] = span(&label);
    let is_taken = |other: &Label| {
        let [from, to] = span(other);
        (other.at[1] - at[1]).abs() < 16.0 && from < right && to > left
    };
    let is_within = camera.rect.contains([left, y]) && right < camera.rect.max[0];
    if is_within && !picture.labels.iter().any(is_taken) {
        picture.labels.push(label.strong());
    }
}

/// Approximate left and right end of a label, in points.
fn span(label: &Label) -> [f32; 2] {
    let width = LETTER / 12.5 * label.size * label.text.chars().count() as f32;
    let left = match label.align {
        Align::Left => label.at[0],
        Align::Centre => label.at[0] - width / 2.0,
        Align::Right => label.at[0] - width,
    };
    [left, left + width]
}

/// Marks a paused stage by two bars above its scale bar.
pub(super) fn pause(picture: &mut Picture, studio: &Studio, stage: Rect) {
    let is_paused = match studio.loop_lab() {
        Some(_) => !studio.running(),
        None => !studio.deck.runs_or_rests(studio.display().motion),
    };
    let [width, height] = stage.size();
    if !is_paused || width < breakpoints::PAUSE[0].into() || height < breakpoints::PAUSE[1].into() {
        return;
    }
    let palette = studio.display().theme.palette();
    let [right, bottom] = [stage.max[0] - 12.0, stage.max[1] - 36.0];
    let sign = Rect { min: [right - PAUSE, bottom - PAUSE], max: [right, bottom] };
    plate(picture, sign, fade(palette.text, 0.5), stage, palette);
    let middle = right - PAUSE / 2.0;
    for x in [middle - 8.0, middle + 2.5] {
        let bar = rounded([x, sign.min[1] + 9.0], [x + 5.5, sign.max[1] - 9.0], 1.5);
        picture.pen(stage).fill(&bar, palette.text);
    }
}

/// Describes the futures at the foot of the cell, under their threads.
pub(super) fn futures(picture: &mut Picture, rect: Rect, studio: &Studio, palette: &Palette) {
    let Some([left, _]) = caption_place(rect) else { return };
    let of = if studio.deck.offered() > 1 { " under each method" } else { "" };
    let words = format!("the next second{of}, a dot a tick");
    let width = LETTER * words.chars().count() as f32;
    let middle = (rect.min[0] + rect.max[0]) / 2.0;
    if width <= rect.max[0] - left {
        let at = [middle.max(left + width / 2.0), rect.max[1] - 10.0];
        picture.labels.push(text(palette, at, Align::Centre, 12.5, palette.text, words));
    }
}

fn caption_place(rect: Rect) -> Option<[f32; 2]> {
    let fits = (0..2).all(|axis| rect.max[axis] - rect.min[axis] >= breakpoints::CAPTION[axis]);
    fits.then_some([rect.min[0] + 9.0 + inset(rect), rect.min[1] + 13.0])
}

/// The verdict on the method, on one line.
struct Chip {
    sign: &'static str,
    /// Colours of the sign and of the rim.
    colours: [Rgba; 2],
    verdict: String,
    /// A shorter version.
    brief: Option<String>,
}

impl Chip {
    /// The chip of a body whose method is inaccurate.
    fn of(moment: &DrawContext<'_>, index: usize, entrant: &Entrant) -> Option<Self> {
        let entry = moment.studio.entry(entrant);
        let verdict = moment.studio.viewer.verdict(entry)?;
        let palette = moment.palette;
        let halt = entrant.lane.bodies()[index].halted();
        let outcome = halt.map_or(verdict.outcome(), Outcome::of_halt);
        let severity = outcome.severity();
        if verdict.body != index || matches!(severity, Severity::Fine | Severity::Unknown) {
            return None;
        }
        // The run on the screen differs from the judged one.
        let is_other = moment.studio.deck.is_judged_apart();
        let viewer = &moment.studio.viewer;
        let is_current = viewer.is_judged_at(entry, moment.studio.clock().tick_hz());
        let tone = palette.of_severity(severity);
        Some(Self {
            sign: outcome.sign().glyph(),
            colours: [
                if is_current || halt.is_some() { tone } else { fade(tone, STALE) },
                moment.style(entry).0,
            ],
            verdict: match halt {
                Some(halt) => halt.fate(),
                None if is_other => verdict.wordings_of_another_run(false)[0].clone(),
                None => verdict.wordings(false)[0].clone(),
            },
            brief: verdict.fails_in_brief().filter(|_| is_other && halt.is_none()),
        })
    }

    fn width(&self) -> f32 {
        34.0 + VERDICT_LETTER * self.verdict.chars().count() as f32
    }

    /// The longest version of the chip that fits into this width.
    fn longest_within(&self, width: f32) -> Option<Self> {
        let said = [Some(&self.verdict), self.brief.as_ref()].into_iter().flatten();
        let mut chips = said.map(|verdict| Self { verdict: verdict.clone(), brief: None, ..*self });
        chips.find(|chip| chip.width() <= width)
    }

    fn draw(self, picture: &mut Picture, rect: Rect, palette: &Palette) {
        let (right, top) = (rect.max[0] - 10.0, rect.min[1] + 4.0);
        let left = right - self.width();
        let chip = Rect { min: [left, top], max: [right, top + CHIP] };
        plate(picture, chip, self.colours[1], rect, palette);
        let middle = top + CHIP / 2.0;
        let mut write = |x, size, colour, words: String| {
            let label = Label::new([x, middle], Align::Left, size, colour, words);
            picture.labels.push(label.strong());
        };
        write(left + 11.0, 12.5, self.colours[0], self.sign.into());
        write(left + 28.0, 13.5, palette.text, self.verdict);
        picture.chip = Some(chip);
    }
}

/// Writes the answer of a comparison with a recording near the foot of a cell.
pub(super) fn write_comparison(
    picture: &mut Picture,
    rect: Rect,
    lines: [String; 2],
    palette: &Palette,
) {
    let Some([x, _]) = caption_place(rect) else { return };
    for (line, up) in lines.into_iter().zip(ANSWER) {
        let at = [x, rect.max[1] - up];
        picture.labels.push(text(palette, at, Align::Left, 12.5, palette.accent, line));
    }
}

/// Names a ghost in its colour, `beside` points from its middle: below it at a free side, or else above it.
pub(super) fn ghost_name(
    picture: &mut Picture,
    camera: &Camera,
    (ghost, beside): (DVec2, f32),
    (name, colour): (&str, Rgba),
    palette: &Palette,
) {
    let Rect { min, max } = camera.rect;
    let [x, y] = camera.points(ghost);
    if max[1] - min[1] < breakpoints::CHIP || !camera.rect.contains([x, y]) {
        return;
    }
    let width = LETTER * name.chars().count() as f32 + BESIDE_NAME;
    let mut sides = [(1.0, Align::Left), (-1.0, Align::Right)];
    if x + beside + width > max[0] {
        sides.reverse();
    }
    let [below, above] = [(y + beside + 6.0).min(max[1] - 8.0), y - beside - 6.0];
    let is_above_free = above > min[1] + CHIP;
    for ((way, align), at_y) in [(sides[0], below), (sides[0], above), (sides[1], below)] {
        let at = [x + way * (beside + 8.0), at_y];
        let label = text(palette, at, align, 12.0, colour, name.to_owned());
        let [left, right] = span(&label);
        let is_taken = |other: &Label| {
            let [from, to] = span(other);
            (other.at[1] - at_y).abs() < CHIP && from < right && to > left
        };
        if picture.labels.iter().any(is_taken) || at_y == above && !is_above_free {
            continue;
        }
        let height = if at_y == above { -0.7 * beside } else { 0.7 * beside };
        let from = [x + 0.7 * way * beside, y + height];
        picture.pen(camera.rect).line(from, [at[0] - 3.0 * way, at_y], 1.0, colour);
        picture.labels.push(label.strong());
        return;
    }
}

/// Draws the course line of a ship `beam` points wide, with distance marks whose numbers keep clear of the ship.
pub(super) fn course(picture: &mut Picture, camera: &Camera, beam: f32, palette: &Palette) {
    let Rect { min, max } = camera.rect;
    let y = camera.points(DVec2::new(0.0, camera.centre_m.y))[1];
    let chart = fade(palette.chart, 0.45);
    picture.pen(camera.rect).dashed([[min[0], y], [max[0], y]], 1.0, chart, [8.0, 5.0]);
    if max[0] - min[0] < breakpoints::MARKS || max[1] - min[1] < breakpoints::SCALE_BAR {
        return;
    }
    let step_m = camera.round_length_m(96.0);
    let named_m = camera.round_length_m(0.47 * f64::from(max[0] - min[0]));
    let is_named = |x_m: f64| libm::fmod(x_m, named_m).abs() < step_m / 2.0;
    let (left, right) = camera.span_m();
    let first = libm::ceil(left / step_m);
    for i in 0..=((right - left) / step_m) as usize {
        let x_m = (first + i as f64) * step_m;
        let [x, _] = camera.points(DVec2::new(x_m, 0.0));
        if x > min[0] + 30.0 && x < max[0] - 30.0 {
            let colour = palette.dim;
            picture.pen(camera.rect).line([x, y - 5.0], [x, y + 5.0], 1.5, colour);
            if !is_named(x_m) {
                continue;
            }
            let unit = if x_m == 0.0 { " m" } else { "" };
            let words = round(x_m, 6) + unit;
            picture.labels.push(text(
                palette,
                [x, (y + (beam / 2.0 + 14.0).max(32.0)).min(max[1] - 9.0)],
                Align::Centre,
                12.0,
                colour,
                words,
            ));
        }
    }
}

/// A plate for words with a rim of this colour.
pub(super) fn plate(
    picture: &mut Picture,
    Rect { min, max }: Rect,
    rim: Rgba,
    clip: Rect,
    palette: &Palette,
) {
    let shape = rounded(min, max, 7.0);
    let pen = &mut picture.pen(clip);
    pen.fill(&shape, fade(palette.panel, 0.94));
    pen.ring(&shape, 1.6, rim);
}

/// A line of this width from side to side, with a stroke across each end that extends `reach` points up and down.
pub(super) fn span_line(
    picture: &mut Picture,
    ([left, right], y): ([f32; 2], f32),
    (width, reach): (f32, f32),
    colour: Rgba,
    clip: Rect,
) {
    picture.pen(clip).line([left, y], [right, y], width, colour);
    for x in [left, right] {
        picture.pen(clip).line([x, y - reach], [x, y + reach], width, colour);
    }
}

/// Draws a round number of metres to scale.
pub(super) fn scale_bar(picture: &mut Picture, camera: &Camera, palette: &Palette) {
    let Rect { min, max } = camera.rect;
    if max[0] - min[0] < BAR_MARGIN || max[1] - min[1] < breakpoints::SCALE_BAR {
        return;
    }
    let length_m = camera.round_length_m(40.0);
    let (right, y, colour) = (max[0] - 10.0, max[1] - 8.0, palette.dim);
    let left = right - camera.length(length_m);
    let at = [(left + right) / 2.0, y - 10.0];
    // In a low cell, the badge of a body beyond the edge needs the room.
    let is_taken =
        |label: &Label| (label.at[1] - at[1]).abs() < 16.0 && (label.at[0] - at[0]).abs() < 60.0;
    if picture.labels.iter().any(is_taken) {
        return;
    }
    span_line(picture, ([left, right], y), (1.5, 3.0), colour, camera.rect);
    let words = format!("{} {}", round(length_m, 4), camera.unit);
    picture.labels.push(text(palette, at, Align::Centre, 11.0, colour, words));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::stage::compose;
    use crate::studio::{HeldBody, RunCommand, StageCommand, ViewCommand};

    /// The words beside the body's name. Asserts that they end before the chip.
    fn beside_name_of(studio: &Studio, width: f32) -> Option<String> {
        let picture = compose(studio, [width, 460.0]);
        let chip = picture.labels.iter().find(|label| label.text == "▲").expect("a chip");
        let name = picture.labels.iter().find(|label| label.text == "Spring").expect("a name");
        let is_beside = |label: &&Label| label.size == 12.5 && label.at[1] == name.at[1] + 0.5;
        let beside = picture.labels.iter().find(is_beside)?;
        let right = beside.at[0] + LETTER * beside.text.chars().count() as f32;
        assert!(right < chip.at[0] - 11.0, "{} ends at {right} of {width}", beside.text);
        Some(beside.text.clone())
    }

    #[test]
    fn text_beside_a_name_ends_before_the_chip_even_while_a_body_is_held() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.analyse();
        (0..60).for_each(|_| studio.tick());
        let promise = Some("should keep to ±1 m".to_owned());
        assert_eq!(beside_name_of(&studio, 780.0), promise);
        assert_eq!(beside_name_of(&studio, 430.0), None, "no room for both");
        let lane = studio.selected().id;
        let mut in_narrow = 0;
        for power in -20..30 {
            let at = -1.2345 * libm::exp10(f64::from(power));
            let (q, v, hand) = ([at].into(), [0.0].into(), DVec2::new(at, 0.0));
            studio.apply(RunCommand::Hold(HeldBody { lane, body: 0, q, v, hand, handle: hand }));
            let words = beside_name_of(&studio, 780.0).expect("room for both");
            assert!(words.starts_with("x = −") && words.ends_with(" m"), "{power}: {words}");
            in_narrow += usize::from(beside_name_of(&studio, 480.0).is_some());
        }
        assert!((1..49).contains(&in_narrow), "{in_narrow}");
        studio.apply(ViewCommand::LetGo);
        assert_eq!(beside_name_of(&studio, 780.0), promise);
    }

    #[test]
    fn the_chip_of_an_edited_run_marks_the_verdict_as_another_runs() {
        let words = |studio: &Studio, size| -> Vec<String> {
            let labels = compose(studio, size).labels.into_iter().map(|label| label.text);
            labels.filter(|text| text.contains("blow")).collect()
        };
        for (ticks, wide, narrow) in [
            (0, "blows up · at 4.14 s", "blows up · at 4.14 s"),
            (20, "if run from the start: blows up · at 4.14 s", "blows up, if run from the start"),
        ] {
            let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
            (0..ticks).for_each(|_| studio.tick());
            studio.apply(StageCommand::TickHz(49.into()));
            studio.analyse();
            (0..20).for_each(|_| studio.tick());
            assert_eq!(words(&studio, [960.0, 560.0]), [wide], "changed at {ticks}");
            assert_eq!(words(&studio, [470.0, 330.0]), [narrow], "changed at {ticks}");
        }
    }

    /// Whether the picture has the two bars of a pause at its foot.
    fn has_sign_of_pause(studio: &Studio, size: [f32; 2]) -> bool {
        let is_bar = |corners: &[([f32; 2], Rgba)]| {
            let right = corners.iter().map(|(at, _)| at[0]).fold(f32::MIN, f32::max);
            let left = corners.iter().map(|(at, _)| at[0]).fold(f32::MAX, f32::min);
            right - left < 7.0 && left > size[0] - 60.0
        };
        let shapes = compose(studio, size).shapes;
        let bars = shapes.iter().filter(|shape| match shape {
            crate::stage::Shape::Fill(fill) => is_bar(&fill.corners),
            crate::stage::Shape::Path(_) => false,
        });
        bars.count() == 2
    }

    #[test]
    fn a_pause_is_marked_in_every_mode_and_a_rest_is_not() {
        use crate::loops::loop_lab::LoopCommand;
        use crate::studio::{Command, Motion, Step};
        let size = [960.0, 560.0];
        let prepared: [Option<Command>; 4] = [
            None,
            Some(StageCommand::ToggleRace.into()),
            Some(LoopCommand::ToggleLab.into()),
            Some(ViewCommand::ToggleMeasure.into()),
        ];
        let pauses: [Command; 3] = [
            ViewCommand::TogglePause.into(),
            ViewCommand::ToggleFutures.into(),
            StageCommand::Tick(Step::Next).into(),
        ];
        for (prepare, pause) in prepared.iter().flat_map(|it| pauses.iter().map(move |p| (it, p))) {
            let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
            studio.viewer.preferences.display.motion = Motion::Live;
            prepare.iter().for_each(|command| _ = studio.apply(command.clone()));
            assert!(!has_sign_of_pause(&studio, size), "{prepare:?}");
            studio.apply(pause.clone());
            assert!(has_sign_of_pause(&studio, size), "{prepare:?}, {pause:?}");
            assert!(!has_sign_of_pause(&studio, [150.0, 100.0]), "no room");
        }
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        while studio.running() {
            studio.advance(16_666_667);
        }
        assert!(!has_sign_of_pause(&studio, size), "a hint speaks of the end");
    }

    #[test]
    fn the_fan_says_what_it_shows_on_the_stage_and_how_it_closes() {
        use crate::studio::shows_futures;
        let says = |studio: &Studio| {
            let labels = compose(studio, [960.0, 560.0]).labels;
            let is_it = |label: &&Label| label.text.starts_with("the next second");
            labels.iter().filter(is_it).map(|label| label.text.clone()).collect::<Vec<_>>()
        };
        let expected = ["the next second under each method, a dot a tick"];
        for scene in ["harbour", "pendulum", "spring"] {
            let mut studio = Studio::new(Scene::built_in(scene).unwrap());
            (0..20).for_each(|_| studio.tick());
            assert_eq!(says(&studio), Vec::<String>::new());
            studio.apply(ViewCommand::ToggleFutures);
            assert_eq!(says(&studio), expected, "{scene}");
            let hint = studio.hint().unwrap();
            assert!(hint.contains("`F`") && hint.contains("`Esc`"), "{hint}");
            studio.apply(ViewCommand::Escape);
            assert!(!shows_futures(&studio) && says(&studio).is_empty(), "{scene}");
            studio.apply(ViewCommand::TogglePause);
            studio.apply(ViewCommand::PointerDown(true));
            studio.apply(ViewCommand::HoldTickRate);
            studio.apply(StageCommand::TickHz(12.into()));
            assert_eq!(says(&studio), expected, "{scene}");
            assert!(studio.hint().unwrap().starts_with("Let go"), "{scene}");
        }
    }

    #[test]
    fn landmarks_slow_time_only_at_real_time_and_the_caption_says_a_set_speed() {
        use crate::studio::{Motion, pace_in_words};
        for (percent, words) in
            [(100, "slowed ×"), (25, "at ¼× speed"), (400, "at 4× speed"), (1600, "at 16× speed")]
        {
            let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
            studio.viewer.preferences.display.motion = Motion::Live;
            studio.viewer.preferences.display.measure = false;
            studio.apply(StageCommand::TickHz(49.into()));
            studio.apply(RunCommand::SpeedPercent(percent));
            let (mut frames, mut said) = (0, Vec::new());
            while studio.running() && frames < 6000 {
                studio.advance(16_666_667);
                let captions = compose(&studio, [960.0, 560.0]).labels.into_iter();
                let captions = captions.map(|label| label.text);
                said.extend(
                    captions.filter(|text| text.contains("speed") || text.contains("slow")),
                );
                frames += 1;
            }
            assert!(!said.is_empty(), "{percent}");
            assert!(said.iter().all(|said| said.contains(words)), "{percent}: {said:?}");
            let (real_s, t) = (f64::from(frames) / 60.0, studio.race().t());
            let set_s = t / (f64::from(percent) / 100.0);
            match percent {
                100 => assert!((1.2 * set_s..99.0).contains(&real_s), "{real_s} s for {t} s"),
                _ => assert!((real_s - set_s).abs() < 0.1, "{real_s} s at {percent} %"),
            }
            studio.apply(ViewCommand::ToggleMeasure);
            let labels = compose(&studio, [960.0, 560.0]).labels;
            assert!(!labels.iter().any(|label| label.text.contains("speed")), "the bar says it");
            assert_eq!(pace_in_words(&studio.deck, &studio.viewer).is_some(), percent != 100);
        }
    }
}
