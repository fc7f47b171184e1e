//! The stage of the loop lab. Each loop has a band with its frame on display, the frames before it, and the exact
//! solution at the moment of display.

use glam::DVec2;

use super::body::OutlineView;
use super::captions::text;
use super::lane::StageLane;
use super::layout::bands;
use super::letters::width;
use super::sketch::{Camera, LaneStyle};
use super::{Align, Picture, Rect, breakpoints, chart, hull};
use crate::look::palette::{Palette, Rgba, fade};
use crate::look::{Framing, Look};
use crate::loops::loop_lab::{LoopFrame, LoopLab, LoopLane};
use crate::scene::Outline;
use crate::sim::number::round;
use crate::studio::{Studio, mark_of};

/// Number of earlier frames shown.
const FRAMES_BEFORE: usize = 14;
/// Opacity of the nearest earlier frame, and of the last.
const STRENGTHS: (f32, f32) = (0.5, 0.06);
/// Side of a block relative to the band's height, and its limit in points.
const BLOCK: f32 = 0.27;
const MAX_BLOCK_POINTS: f32 = 44.0;
/// Width of the words on a frame's latency, in points.
const LATENESS: f32 = 112.0;
/// Height (points) of a band's foot, which names its loop.
const FOOT: f32 = 30.0;
/// Height of a line where several loops are named below each other, in points.
const LINE: f32 = 18.0;
/// Letter widths of a loop's name and of its verdict, and the least gap between the two, in points.
const NAME_LETTER: f32 = 8.0;
const VERDICT_LETTER: f32 = 6.4;
const GAP: f32 = 12.0;
/// Length of the path of frames, in seconds of the display.
const PATH_S: f64 = 0.16;
/// Width of the stage relative to the swing.
const MARGIN: f64 = 1.22;

/// Draws the loops on the stage. Returns the lower right corner of the last one.
pub(super) fn draw(
    picture: &mut Picture,
    studio: &Studio,
    loops: &LoopLab,
    stage: Rect,
) -> [f32; 2] {
    let (strip, ground) = chart::under_ruler(stage, stage.sides()[1] >= breakpoints::RULER);
    let ruled = match loops.is_overlaid {
        true => overlay(picture, studio, loops, ground),
        false => side_by_side(picture, studio, loops, ground),
    };
    if let Some((strip, camera)) = strip.zip(ruled) {
        chart::ruler(picture, strip, &camera, studio.display().theme.palette());
    }
    stage.max
}

/// Draws a band for each loop on the stage. Returns the camera of the first, if it is fixed.
fn side_by_side(
    picture: &mut Picture,
    studio: &Studio,
    loops: &LoopLab,
    ground: Rect,
) -> Option<Camera> {
    let on_stage = loops.on_stage();
    let mut ruled = None;
    for (&place, rect) in on_stage.iter().zip(bands(ground, &vec![1.0; on_stage.len()])) {
        let band = LoopBand::new(studio, loops, place, rect, FOOT);
        if place != on_stage[0] {
            let edge = fade(band.palette.chart, 0.35);
            picture.pen(rect).line(rect.min, [rect.max[0], rect.min[1]], 1.0, edge);
        }
        ruled = ruled.or(band.draw(picture, studio.display().ghost));
    }
    ruled
}

/// Draws all loops on the stage over each other, the selected one in front, and names them below. Returns the camera,
/// if it is fixed.
fn overlay(
    picture: &mut Picture,
    studio: &Studio,
    loops: &LoopLab,
    ground: Rect,
) -> Option<Camera> {
    let foot = FOOT + LINE * (loops.on_stage().len() - 1) as f32;
    let band = |place: &usize| LoopBand::new(studio, loops, *place, ground, foot);
    let lanes: Vec<LoopBand<'_>> = loops.on_stage().iter().map(band).collect();
    let mut back_to_front: Vec<&LoopBand<'_>> = lanes.iter().collect();
    back_to_front.sort_by_key(|band| band.is_selected());
    let front = *back_to_front.last()?;
    let exact = front.exact_outline(front.frames.last()?);
    let camera = front.camera(exact.at);
    if studio.display().ghost {
        front.ghost(picture, &camera, &exact);
    }
    for band in back_to_front {
        let Some(frame) = band.frames.last() else { continue };
        if band.is_selected() {
            band.before(picture, &camera);
        }
        band.path(picture, &camera);
        band.body(picture, &camera, &band.shown_outline(frame));
    }
    let mut above = camera.at[1] - 0.5 * camera.block - 9.0;
    for (row, band) in lanes.iter().enumerate() {
        let Some(frame) = band.frames.last() else { continue };
        if above > ground.min[1] + 0.5 * LINE {
            let at = [camera.points(band.shown_outline(frame).at)[0], above];
            let number = text(band.palette, at, Align::Centre, 12.5, band.colour, band.number());
            picture.labels.push(number.strong());
        }
        above -= LINE;
        let y = ground.max[1] - foot + 0.5 * FOOT + LINE * row as f32;
        let [from, to] = [-6.0, 6.0].map(|up| [6.0, y + up]);
        picture.pen(ground).line(from, to, 3.0, band.colour);
        let named = format!("{} · {}", band.numbered_name(), lateness(loops, frame));
        band.write_name(picture, y, &named);
    }
    front.is_recorded().then_some(camera)
}

/// Describes the latency of a frame.
fn lateness(loops: &LoopLab, frame: &LoopFrame) -> String {
    match loops.late_ms(frame) {
        late if late.abs() < 0.05 => "on time".into(),
        late if late > 0.0 => format!("{} ms behind", round(late, 3)),
        early => format!("{} ms ahead", round(-early, 3)),
    }
}

struct LoopBand<'a> {
    loops: &'a LoopLab,
    lane: &'a LoopLane,
    place: usize,
    /// The frames up to the one on display, if there is one.
    frames: &'a [LoopFrame],
    rect: Rect,
    /// Height of the foot with the names, in points.
    foot: f32,
    colour: Rgba,
    palette: &'static Palette,
}

impl StageLane for LoopBand<'_> {
    fn number(&self) -> String {
        mark_of(self.place)
    }

    fn name(&self) -> String {
        self.lane.card().name.clone()
    }

    fn colour(&self) -> Rgba {
        self.colour
    }

    fn is_selected(&self) -> bool {
        self.loops.selected() == self.place
    }

    fn verdict(&self) -> Option<(Rgba, Vec<String>)> {
        let verdict = self.loops.verdict(self.place);
        Some((self.palette.of_severity(verdict.severity), verdict.wordings()))
    }
}

impl<'a> LoopBand<'a> {
    fn new(studio: &Studio, loops: &'a LoopLab, place: usize, rect: Rect, foot: f32) -> Self {
        let theme = studio.display().theme;
        let (lane, colour) = (&loops.lanes()[place], theme.loop_style(place).0);
        let present = lane.frame_at(loops.now_ns());
        let frames = present.map_or(&[][..], |present| &lane.frames()[..=present]);
        Self { loops, lane, place, frames, rect, foot, colour, palette: theme.palette() }
    }

    fn framing(&self) -> Framing {
        Look::of(self.loops.body()).framing()
    }

    fn is_recorded(&self) -> bool {
        matches!(self.framing(), Framing::Recorder { .. })
    }

    fn outline(&self, t: f64, q: &[f64]) -> Outline {
        Look::of(self.loops.body()).outline(t, q)
    }

    /// The body as a frame shows it.
    fn shown_outline(&self, frame: &LoopFrame) -> Outline {
        self.outline(frame.shown_ms / 1e3, &frame.q)
    }

    /// The exact body at the moment of a frame's display.
    fn exact_outline(&self, frame: &LoopFrame) -> Outline {
        self.outline(frame.displayed_ns as f64 / 1e9, &frame.exact)
    }

    /// The camera of the band.
    fn camera(&self, exact: DVec2) -> Camera {
        let [_, height] = self.rect.sides();
        let mut camera = Camera::of(self.rect, (BLOCK * height).min(MAX_BLOCK_POINTS));
        let (centre_m, half_m) = match self.framing() {
            Framing::Recorder { half_width_m } => {
                if self.has_path() {
                    camera.at[1] = self.rect.min[1] + 0.38 * height;
                }
                let [least, most] = self.loops.range();
                let reach = least.abs().max(most.abs());
                let reach = if reach > 0.0 { reach } else { half_width_m };
                (DVec2::ZERO, DVec2::new(MARGIN * reach, 0.0))
            }
            Framing::Follow { width_m, height_m, .. } => {
                (exact, DVec2::new(width_m, height_m) / 2.0)
            }
            Framing::Fixed { centre_m, half_m, .. } => (centre_m, 1.1 * half_m),
        };
        camera.fitting(centre_m, half_m, self.rect.sides().map(f64::from))
    }

    fn has_path(&self) -> bool {
        self.is_recorded() && self.rect.sides()[1] >= breakpoints::PATH
    }

    /// Whether there is room for words beside the body and the name.
    fn has_words(&self) -> bool {
        let [width, height] = self.rect.sides();
        width >= breakpoints::WORDS_BESIDE_BODIES && height >= breakpoints::LINE_OF_WORDS
    }

    /// Draws the band. Returns its camera, if it is fixed.
    fn draw(&self, picture: &mut Picture, shows_ghost: bool) -> Option<Camera> {
        let Some(frame) = self.frames.last() else {
            self.title(picture);
            return None;
        };
        let [drawn, exact] = [self.shown_outline(frame), self.exact_outline(frame)];
        let camera = self.camera(exact.at);
        self.before(picture, &camera);
        self.path(picture, &camera);
        if shows_ghost {
            self.ghost(picture, &camera, &exact);
        }
        self.body(picture, &camera, &drawn);
        self.seen(&camera, &drawn).number(picture, self.number(), self.colour);
        self.title(picture);
        self.words(picture, &camera, frame, [&drawn, &exact]);
        self.is_recorded().then_some(camera)
    }

    fn seen<'s>(&self, camera: &'s Camera, outline: &'s Outline) -> OutlineView<'s> {
        OutlineView { outline, camera, palette: self.palette }
    }

    /// Draws the frames before the one on display.
    fn before(&self, picture: &mut Picture, camera: &Camera) {
        for (strength, before) in distinct_before(self.frames) {
            let style = LaneStyle::solid(fade(self.colour, strength), 0.12);
            self.seen(camera, &self.shown_outline(before)).draw_behind(picture, style);
        }
    }

    fn ghost(&self, picture: &mut Picture, camera: &Camera, exact: &Outline) {
        let style = LaneStyle::solid(self.palette.exact, 0.08);
        self.seen(camera, exact).draw_behind(picture, style);
    }

    fn body(&self, picture: &mut Picture, camera: &Camera, drawn: &Outline) {
        let (seen, style) = (self.seen(camera, drawn), LaneStyle::solid(self.colour, 0.0));
        // A coil would hide the frames before.
        if !self.is_recorded() {
            seen.draw_below_exact(picture, style);
        }
        seen.draw_front(picture, style);
    }

    /// Draws the body's places in the frames as a staircase in time, next to its exact motion, if there is room.
    fn path(&self, picture: &mut Picture, camera: &Camera) {
        let Some(last) = self.frames.last().filter(|_| self.has_path()) else { return };
        let [top, bottom] = [camera.at[1] + 0.8 * camera.block, self.rect.max[1] - self.foot];
        let ago_s = |frame: &LoopFrame| (last.displayed_ns - frame.displayed_ns) as f64 / 1e9;
        let y = |frame: &LoopFrame| top + (bottom - top) * (ago_s(frame) / PATH_S) as f32;
        let since = self.frames.partition_point(|frame| ago_s(frame) > PATH_S);
        let frames = &self.frames[since..];
        // The place of a body does not depend on the time.
        let x = |q: &[f64]| camera.points(self.outline(0.0, q).at)[0];
        let mut held = Vec::new();
        for pair in frames.windows(2) {
            let x = x(&pair[0].q);
            held.extend([[x, y(&pair[0])], [x, y(&pair[1])]]);
        }
        held.push([x(&last.q), y(last)]);
        let ideal = frames.iter().map(|frame| [x(&frame.exact), y(frame)]);
        let pen = &mut picture.pen(self.rect);
        pen.path(ideal, 1.3, fade(self.palette.exact, 0.75));
        pen.path(held, 2.2, self.colour);
    }

    /// Writes the loop's name at this height, and the longest wording of its verdict that fits.
    fn write_name(&self, picture: &mut Picture, y: f32, name: &str) {
        let [left, right] = [self.rect.min[0] + 14.0, self.rect.max[0] - 14.0];
        let (palette, room) = (self.palette, right - left - GAP - width(NAME_LETTER, name));
        let name = text(palette, [left, y], Align::Left, 14.5, palette.text, name.into());
        picture.labels.push(name.strong());
        let verdict = self.verdict_within(VERDICT_LETTER, room).filter(|_| self.has_words());
        if let Some((colour, words)) = verdict {
            picture.labels.push(text(palette, [right, y], Align::Right, 12.5, colour, words));
        }
    }

    /// Writes the loop's name with its method, and marks it if selected.
    fn title(&self, picture: &mut Picture) {
        self.mark(picture, self.rect);
        let name = match self.rect.sides()[0] >= breakpoints::METHOD_BESIDE_LOOP {
            true => format!("{} · {}", self.name(), self.loops.method().name),
            false => self.name(),
        };
        self.write_name(picture, self.rect.max[1] - 0.5 * FOOT, &name);
    }

    /// Writes the latency of the frame on display above a line between the drawn body and the exact one.
    fn words(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        frame: &LoopFrame,
        outlines: [&Outline; 2],
    ) {
        let [drawn, exact] = outlines.map(|outline| camera.points(outline.at));
        let body = (0.5 * camera.block).max(hull::half_height(outlines[0], camera));
        let above = drawn[1] - body - 9.0;
        if self.has_words() && above > self.rect.min[1] + 6.0 {
            let accent = self.palette.accent;
            let ends = [drawn[0], exact[0]].map(|x| [x, above]);
            picture.pen(self.rect).line(ends[0], ends[1], 1.2, accent);
            let (right, width) = (drawn[0].max(exact[0]) + 8.0, self.rect.sides()[0]);
            let (x, align) = match right + LATENESS <= width {
                true => (right.max(60.0), Align::Left),
                false => (drawn[0].min(exact[0]).min(width) - 8.0, Align::Right),
            };
            let (at, words) = ([x, above], lateness(self.loops, frame));
            picture.labels.push(text(self.palette, at, align, 12.0, accent, words));
        }
    }
}

/// Earlier frames that show other moments than their successors, each with its opacity, the furthest first.
fn distinct_before(frames: &[LoopFrame]) -> Vec<(f32, &LoopFrame)> {
    let mut distinct: Vec<&LoopFrame> = Vec::new();
    let mut shown = frames.last().map(|frame| frame.shown_ms);
    for frame in frames.iter().rev() {
        if Some(frame.shown_ms) != shown {
            distinct.push(frame);
            shown = Some(frame.shown_ms);
        }
        if distinct.len() == FRAMES_BEFORE {
            break;
        }
    }
    let (first, last) = STRENGTHS;
    let strength = |i: usize| first + (last - first) * i as f32 / FRAMES_BEFORE as f32;
    distinct.into_iter().enumerate().rev().map(|(i, frame)| (strength(i), frame)).collect()
}
