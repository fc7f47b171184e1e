//! Words and marks on the stage: names, distances, verdicts and halts.

use glam::DVec2;

use super::lane::{Chip, RaceLane, StageLane, fates};
use super::letters::{fitting, width};
use super::moment::{DrawContext, has_several_coordinates};
use super::sketch::{Camera, rounded};
use super::{Align, Label, Picture, Rect, breakpoints};
use crate::look::Look;
use crate::look::palette::{Palette, Rgba, fade};
use crate::run::Checked;
use crate::run::race::{Halt, LaneBody};
use crate::scene::Mark;
use crate::sim::number::significant;
use crate::studio::Studio;
use crate::studio::{pace_in_words, shown_state, shown_truth};

/// Height of a chip, in points.
const CHIP: f32 = 27.0;
/// Distance (points) between the two lines beside a lane.
const LINE: f32 = 16.0;
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
/// Distance (points) between the verdicts of two lanes.
const BETWEEN_LANES: f32 = 14.0;
/// Side of the sign of a pause, in points.
const PAUSE: f32 = 34.0;
/// Height (points) of an answer's lines above the foot of a cell, clear of the halts there.
const ANSWER: [f32; 2] = [60.0, 44.0];
/// Height (points) of a failed check above the foot of a cell, over the lines of an answer.
const FAILED: f32 = 78.0;
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

/// Width (points) of the left column in which [`lane`] names these lanes, on a stage of width `stage`.
pub(super) fn lanes_width(lanes: &[RaceLane<'_>], stage: f32) -> f32 {
    let width = |lane: &RaceLane<'_>| LANE_INSET + width(LETTER, &lane.numbered_name());
    let widest = lanes.iter().map(width).fold(LANES.0, f32::max);
    if stage >= breakpoints::LANE_NAMES { widest.min(MAX_FOR_LANES * stage) } else { LANES.1 }
}

/// Names a lane at the left of its row, and marks the selected one with a bar.
pub(super) fn lane(picture: &mut Picture, rect: Rect, lane: RaceLane<'_>) {
    let (left, right) = (rect.min[0] + LANE_INSET, rect.max[0]);
    let middle = (rect.min[1] + rect.max[1]) / 2.0;
    lane.mark(picture, rect);
    // With many lanes, a row is lower than a line of the usual size.
    let height = rect.max[1] - rect.min[1];
    let size = (0.78 * height).min(12.0);
    let mut write = |y, colour, words: String| {
        let at = [left, y];
        picture.labels.push(text(lane.moment.palette, at, Align::Left, size, colour, words));
    };
    if right - left < breakpoints::CAPTION[0] {
        write(middle, lane.colour(), lane.number());
        return;
    }
    // The extra half point allows for a column exactly as wide as its widest name.
    let room = right - left + 0.5;
    let (mut name, letters) = (lane.numbered_name(), (room / LETTER) as usize);
    if name.chars().count() > letters {
        name = name.chars().take(letters - 1).chain(['…']).collect();
    }
    let has_room = height >= 2.0 * LINE || lane.lone_halt().is_some();
    let verdict = lane.verdict_within(LETTER, room).filter(|_| has_room);
    let up = verdict.as_ref().map_or(0.0, |_| LINE / 2.0);
    write(middle - up, lane.colour(), name);
    if let Some((colour, words)) = verdict {
        write(middle + up, colour, words);
    }
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
        None => fitting(fates(halt), LETTER, width - 9.0 - inset(rect))
            .unwrap_or_else(|| halt.ending().into()),
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
        let label = text(palette, at, Align::Left, 11.0, colour, words);
        let [left, right] = span(&label);
        // A net may hang down to here.
        let (min, max) = ([left - 4.0, at[1] - 7.5], [right + 4.0, at[1] + 7.5]);
        let below = [min, [max[0], min[1]], max, [min[0], max[1]]];
        picture.pen(rect).fill(&below, fade(palette.sea[1], 0.85));
        picture.labels.push(label);
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
    let right = x + width(NAME_LETTER, &moment.studio.scene().bodies[index].name);
    Some(Rect { min: [x, y - 7.0], max: [right, y + 7.0] })
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Writes the expected motion beside a body's name, and the method's fault at the right. If both do not fit, only the
/// fault.
pub(super) fn head(picture: &mut Picture, rect: Rect, lane: RaceLane<'_>, index: usize) {
    let (moment, body) = (lane.moment, &lane.bodies()[index]);
    let name = name_room(rect, moment, index).zip(caption_place(rect));
    let Some((name, [_, y])) = name else { return };
    // In a low cell, the words would lie over the body.
    if rect.max[1] - rect.min[1] < breakpoints::SCALE_BAR {
        return;
    }
    let left = name.max[0] + 14.0;
    let (words, colour) = beside_name(moment, index, body);
    let right = left + width(LETTER, &words) + 14.0;
    let chip = Chip::of(lane, index).filter(|_| rect.max[1] - rect.min[1] >= breakpoints::CHIP);
    let room_for = |from: f32| rect.max[0] - 10.0 - from;
    let beside_both = chip.as_ref().filter(|chip| chip.width() <= room_for(right));
    let beside_both = beside_both.and_then(|chip| chip.longest_within(room_for(right)));
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

/// Returns the height below which flags keep clear of the [`verdicts`] of a race.
pub(super) fn foot_of_verdicts(rect: Rect) -> f32 {
    let has_verdicts =
        rect.max[1] - rect.min[1] >= breakpoints::CHIP && caption_place(rect).is_some();
    rect.min[1] + if has_verdicts { 4.0 + CHIP } else { 0.0 }
}

/// Writes the verdicts of a race at the head of a cell: that on the lane in front as a chip, and before it the sign and
/// the number of each other lane, with its words if there is room for all.
pub(super) fn verdicts(
    picture: &mut Picture,
    rect: Rect,
    index: usize,
    (lanes, front): (&[RaceLane<'_>], RaceLane<'_>),
) {
    if foot_of_verdicts(rect) == rect.min[1] {
        return;
    }
    let moment = front.moment;
    let left = name_room(rect, moment, index).map_or(rect.min[0] + 10.0, |name| name.max[0] + 10.0);
    let (mut right, y) = (rect.max[0] - 10.0, rect.min[1] + 4.0 + CHIP / 2.0);
    let chip = Chip::of(front, index).and_then(|chip| chip.longest_within(right - left));
    if let Some(chip) = chip {
        right -= chip.width() + 12.0;
        chip.draw(picture, rect, moment.palette);
    }
    let others = lanes.iter().filter(|lane| lane.id() != front.id());
    let others = others.filter_map(|lane| Some((lane.number(), Chip::of(*lane, index)?)));
    let others: Vec<(String, Chip)> = others.collect();
    let all = |words: fn(&Chip) -> &str| {
        let one = |(number, chip): &(String, Chip)| {
            let words = words(chip);
            let space = if words.is_empty() { "" } else { " " };
            format!("{number} {}{space}{words}", chip.sign)
        };
        others.iter().map(one).collect::<Vec<_>>()
    };
    let widths = |all: &[String]| -> Vec<f32> {
        all.iter().map(|words| width(LETTER, words) + BETWEEN_LANES).collect()
    };
    let wordings: [fn(&Chip) -> &str; 3] =
        [|chip| &chip.wordings[0], |chip| &chip.wordings[chip.wordings.len() - 1], |_| ""];
    let fits = |all: &Vec<String>| widths(all).iter().sum::<f32>() <= right - left;
    let all = wordings.into_iter().map(all).find(fits).unwrap_or_else(|| all(wordings[2]));
    for (((_, chip), words), width) in others.iter().zip(&all).zip(widths(&all)).rev() {
        if right - width < left {
            return;
        }
        right -= width;
        let at = [right, y];
        let colour = chip.colours[0];
        picture.labels.push(text(moment.palette, at, Align::Left, 12.5, colour, words.clone()));
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
            let (q, v) = shown_truth(studio, index);
            let motion = Look::of(truth).describe_motion(&q, &v);
            // The bar above the instruments says it too.
            let is_told = index == 0 && !studio.display().measure;
            let pace = pace_in_words(studio).filter(|_| is_told);
            motion.into_iter().chain(pace).collect::<Vec<_>>().join(" · ")
        }
    };
    (words, palette.dim)
}

/// Writes the speed of a ship on a straight course ahead of its bow, where no other words are.
pub(super) fn speed(picture: &mut Picture, camera: &Camera, lane: RaceLane<'_>, index: usize) {
    let (moment, body) = (lane.moment, &lane.bodies()[index]);
    let (q, v) = shown_state(moment.studio, body);
    let outline = Look::of(body).outline(moment.t, &q);
    let bow = outline.marks.iter().find_map(|mark| match mark {
        Mark::Hull { length, .. } if !has_several_coordinates(body) => {
            Some(DVec2::new(length / 2.0, 0.0))
        }
        _ => None,
    });
    let Some(bow) = bow else { return };
    let [x, y] = camera.points(outline.at + bow);
    let words = format!("{} {}/s", significant(v[0], 3), camera.unit);
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
    let width = width(LETTER / 12.5 * label.size, &label.text);
    let left = match label.align {
        Align::Left => label.at[0],
        Align::Centre => label.at[0] - width / 2.0,
        Align::Right => label.at[0] - width,
    };
    [left, left + width]
}

/// Marks a paused stage by two bars above the scale bar at this lower right corner.
pub(super) fn pause(picture: &mut Picture, studio: &Studio, stage: Rect, corner: [f32; 2]) {
    let is_paused = match studio.loop_lab() {
        Some(_) => !studio.running(),
        None => !studio.deck.runs_or_rests(studio.display().motion),
    };
    let [width, height] = stage.size();
    if !is_paused || width < breakpoints::PAUSE[0].into() || height < breakpoints::PAUSE[1].into() {
        return;
    }
    let palette = studio.display().theme.palette();
    let [right, bottom] = [corner[0] - 12.0, corner[1] - 36.0];
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
    let is_one = studio.deck.offered() < 2 || !studio.bands().is_empty();
    let of = if !is_one { " under each method" } else { "" };
    let words = format!("the next second{of}, a dot a tick");
    let width = width(LETTER, &words);
    let middle = (rect.min[0] + rect.max[0]) / 2.0;
    // In a low band it would lie over the ends of the threads.
    let is_low = !studio.bands().is_empty() && rect.max[1] - rect.min[1] < breakpoints::LOW_BAND;
    if width <= rect.max[0] - left && !is_low {
        let at = [middle.max(left + width / 2.0), rect.max[1] - 10.0];
        picture.labels.push(text(palette, at, Align::Centre, 12.5, palette.text, words));
    }
}

/// Left end of the words at the head of a cell.
pub(super) fn left_of(rect: Rect) -> f32 {
    rect.min[0] + 9.0 + inset(rect)
}

fn caption_place(rect: Rect) -> Option<[f32; 2]> {
    let fits = (0..2).all(|axis| rect.max[axis] - rect.min[axis] >= breakpoints::CAPTION[axis]);
    fits.then_some([left_of(rect), rect.min[1] + 13.0])
}

/// Height below which marks keep clear of the words at the head of a cell.
pub(super) fn foot_of_head(rect: Rect) -> f32 {
    let head = caption_place(rect).map_or(4.0, |_| CHIP);
    rect.min[1] + head
}

impl Chip {
    fn width(&self) -> f32 {
        34.0 + width(VERDICT_LETTER, &self.wordings[0])
    }

    /// The longest version of the chip that fits into this width.
    fn longest_within(&self, width: f32) -> Option<Self> {
        let mut chips =
            self.wordings.iter().map(|words| Self { wordings: vec![words.clone()], ..*self });
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
        write(left + 28.0, 13.5, palette.text, self.wordings[0].clone());
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

/// Reports that the run differs from its recording, on a plate, for trails pass there.
pub(super) fn write_failed_check(
    picture: &mut Picture,
    rect: Rect,
    failed: Checked,
    palette: &Palette,
) {
    let Some([x, _]) = caption_place(rect) else { return };
    let words = failed.fault();
    let (y, half) = (rect.max[1] - FAILED, 0.5 * CHIP);
    let right = x + 8.0 + width(VERDICT_LETTER, &words);
    let room = Rect { min: [x - 8.0, y - half], max: [right, y + half] };
    plate(picture, room, palette.bad, rect, palette);
    picture.labels.push(text(palette, [x, y], Align::Left, 13.5, palette.bad, words));
}

/// Names a ghost in its colour, `beside` points from its middle: below it at a free side, or else above it. On a chart
/// recorder, trails hang below it, so that above comes first.
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
    let width = width(LETTER, name) + BESIDE_NAME;
    let mut sides = [(1.0, Align::Left), (-1.0, Align::Right)];
    if x + beside + width > max[0] {
        sides.reverse();
    }
    let is_recorded = camera.quay_m != 0.0;
    let up = if is_recorded { 0.7 * beside + 8.0 } else { beside + 6.0 };
    let [below, above] = [(y + beside + 6.0).min(max[1] - 8.0), y - up];
    // Below the chip, with half the height of the letters.
    let is_above_free = above > min[1] + 4.0 + CHIP + 7.0;
    let mut places = [(sides[0], below), (sides[0], above), (sides[1], below)];
    if is_recorded {
        places.swap(0, 1);
    }
    for ((way, align), at_y) in places {
        let at = [x + way * (beside + 8.0), at_y];
        let label = text(palette, at, align, 12.0, colour, name.to_owned());
        let [left, right] = span(&label);
        let is_taken = |other: &Label| {
            let [from, to] = span(other);
            (other.at[1] - at_y).abs() < CHIP && from < right + LETTER && to > left - LETTER
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

#[cfg(test)]
mod tests;
