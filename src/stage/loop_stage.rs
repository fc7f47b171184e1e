//! The stage of the loop lab. Each loop has a band with its frame on display, the frames before it, and the exact
//! solution at the moment of display.

use glam::DVec2;

use super::body::OutlineView;
use super::sketch::{Camera, LaneStyle, SOLID};
use super::{Align, Label, Picture, Rect, breakpoints, captions, chart, hull};
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

/// The picture of the loop lab on a stage of `size` points.
pub(super) fn compose(studio: &Studio, loops: &LoopLab, size: [f32; 2]) -> Picture {
    let palette = studio.display().theme.palette();
    let mut picture = Picture::default();
    let stage = Rect { min: [0.0; 2], max: size };
    chart::sea(&mut picture, stage, palette);
    let has_ruler = size[1] >= breakpoints::RULER;
    let top = if has_ruler { chart::RULER } else { 0.0 };
    let ground = Rect { min: [0.0, top], max: size };
    let ruled = match loops.is_overlaid {
        true => overlay(&mut picture, studio, loops, ground),
        false => side_by_side(&mut picture, studio, loops, ground),
    };
    if let Some(camera) = ruled.filter(|_| has_ruler) {
        let strip = Rect { min: stage.min, max: [size[0], top] };
        chart::ruler(&mut picture, strip, &camera, palette);
    }
    captions::pause(&mut picture, studio, stage, stage.max);
    picture
}

/// Draws a band for each loop on the stage. Returns the camera of the first, if it is fixed.
fn side_by_side(
    picture: &mut Picture,
    studio: &Studio,
    loops: &LoopLab,
    ground: Rect,
) -> Option<Camera> {
    let palette = studio.display().theme.palette();
    let on_stage = loops.on_stage();
    let height = (ground.max[1] - ground.min[1]) / on_stage.len() as f32;
    let mut ruled = None;
    for (row, &place) in on_stage.iter().enumerate() {
        let from = ground.min[1] + height * row as f32;
        let rect = Rect { min: [0.0, from], max: [ground.max[0], from + height] };
        if row > 0 {
            let edge = fade(palette.chart, 0.35);
            picture.pen(rect).line([0.0, from], [ground.max[0], from], 1.0, edge);
        }
        let band = LoopBand::new(studio, loops, place, rect, FOOT);
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
    let on_stage = loops.on_stage();
    let is_selected = |place: usize| place == loops.selected();
    let foot = FOOT + LINE * (on_stage.len() - 1) as f32;
    let mut back_to_front = on_stage.to_vec();
    back_to_front.sort_by_key(|&place| is_selected(place));
    let bands: Vec<LoopBand<'_>> = back_to_front
        .into_iter()
        .map(|place| LoopBand::new(studio, loops, place, ground, foot))
        .collect();
    let front = bands.last()?;
    let exact = front.exact_outline(front.frames()?.last()?);
    let camera = front.camera(exact.at);
    if studio.display().ghost {
        front.ghost(picture, &camera, &exact);
    }
    for band in &bands {
        let Some(frames) = band.frames() else { continue };
        let drawn = band.shown_outline(&frames[frames.len() - 1]);
        if is_selected(band.place) {
            band.before(picture, &camera, frames);
        }
        if band.has_path() {
            band.path(picture, &camera, frames);
        }
        band.body(picture, &camera, &drawn);
    }
    let mut above = camera.at[1] - 0.5 * camera.block - 9.0;
    for (row, &place) in on_stage.iter().enumerate() {
        let Some(band) = bands.iter().find(|band| band.place == place) else { continue };
        let Some(frame) = band.frames().and_then(<[LoopFrame]>::last) else { continue };
        let at = camera.points(band.shown_outline(frame).at);
        let number = band.label([at[0], above], Align::Centre, 12.5, mark_of(place));
        if above > ground.min[1] + 0.5 * LINE {
            picture.labels.push(Label { colour: band.colour, ..number }.strong());
        }
        above -= LINE;
        let y = ground.max[1] - foot + 0.5 * FOOT + LINE * row as f32;
        let bar = [-6.0, 6.0].map(|up| [6.0, y + up]);
        picture.pen(ground).line(bar[0], bar[1], 3.0, band.colour);
        band.name(
            picture,
            y,
            &format!("{} {} · {}", mark_of(place), band.lane.card().name, lateness(loops, frame)),
        );
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
    rect: Rect,
    /// Height of the foot with the names, in points.
    foot: f32,
    colour: Rgba,
    palette: &'static Palette,
}

impl<'a> LoopBand<'a> {
    fn new(studio: &Studio, loops: &'a LoopLab, place: usize, rect: Rect, foot: f32) -> Self {
        let theme = studio.display().theme;
        let (lane, colour) = (&loops.lanes()[place], theme.loop_style(place).0);
        Self { loops, lane, place, rect, foot, colour, palette: theme.palette() }
    }

    /// The frames up to the one on display, if there is one.
    fn frames(&self) -> Option<&'a [LoopFrame]> {
        let present = self.lane.frame_at(self.loops.now_ns())?;
        Some(&self.lane.frames()[..=present])
    }

    fn framing(&self) -> Framing {
        let body = self.loops.body();
        Look::of(body).framing()
    }

    fn is_recorded(&self) -> bool {
        matches!(self.framing(), Framing::Recorder { .. })
    }

    fn size(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.rect.max[axis] - self.rect.min[axis])
    }

    fn outline(&self, t: f64, q: &[f64]) -> Outline {
        let body = self.loops.body();
        Look::of(body).outline(t, q)
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
        let [width, height] = self.size().map(f64::from);
        let plain = Camera::of(self.rect, (BLOCK * height as f32).min(MAX_BLOCK_POINTS));
        match self.framing() {
            Framing::Recorder { half_width_m } => {
                let [least, most] = self.loops.range();
                let reach = least.abs().max(most.abs());
                let reach = if reach > 0.0 { reach } else { half_width_m };
                let above = self.rect.min[1] + 0.38 * height as f32;
                let at = if self.has_path() { [plain.at[0], above] } else { plain.at };
                Camera { at, points_per_metre: width / (2.0 * MARGIN * reach), ..plain }
            }
            Framing::Follow { width_m, height_m, .. } => {
                let points_per_metre = (width / width_m).min(height / height_m);
                Camera { centre_m: exact, points_per_metre, ..plain }
            }
            Framing::Fixed { centre_m, half_m, .. } => {
                let fitting = (width / half_m.x).min(height / half_m.y) / 2.2;
                Camera { centre_m, points_per_metre: fitting, ..plain }
            }
        }
    }

    fn has_path(&self) -> bool {
        self.is_recorded() && self.size()[1] >= breakpoints::PATH
    }

    /// Draws the band. Returns its camera, if it is fixed.
    fn draw(&self, picture: &mut Picture, shows_ghost: bool) -> Option<Camera> {
        let Some((frame, frames)) = self.frames().and_then(|all| Some((all.last()?, all))) else {
            self.title(picture);
            return None;
        };
        let exact = self.exact_outline(frame);
        let camera = self.camera(exact.at);
        self.before(picture, &camera, frames);
        if self.has_path() {
            self.path(picture, &camera, frames);
        }
        if shows_ghost {
            self.ghost(picture, &camera, &exact);
        }
        let drawn = self.shown_outline(frame);
        self.body(picture, &camera, &drawn);
        self.outline_view(&camera, &drawn).number(picture, mark_of(self.place), self.colour);
        self.words(picture, &camera, frame, [&drawn, &exact]);
        self.is_recorded().then_some(camera)
    }

    fn outline_view<'s>(&self, camera: &'s Camera, outline: &'s Outline) -> OutlineView<'s> {
        OutlineView { outline, camera, palette: self.palette }
    }

    /// Draws the frames before the one on display.
    fn before(&self, picture: &mut Picture, camera: &Camera, frames: &[LoopFrame]) {
        for (strength, before) in distinct_before(frames) {
            let outline = self.shown_outline(before);
            let style = LaneStyle { colour: fade(self.colour, strength), dash: SOLID, fill: 0.12 };
            self.outline_view(camera, &outline).draw_behind(picture, style);
        }
    }

    fn ghost(&self, picture: &mut Picture, camera: &Camera, exact: &Outline) {
        let style = LaneStyle { colour: self.palette.exact, dash: SOLID, fill: 0.08 };
        self.outline_view(camera, exact).draw_behind(picture, style);
    }

    fn body(&self, picture: &mut Picture, camera: &Camera, drawn: &Outline) {
        let seen = self.outline_view(camera, drawn);
        let style = || LaneStyle { colour: self.colour, dash: SOLID, fill: 0.0 };
        // A coil would hide the frames before.
        if !self.is_recorded() {
            seen.draw_below_exact(picture, style());
        }
        seen.draw_front(picture, style());
    }

    /// Draws the body's places in the frames as a staircase in time, next to its exact motion.
    fn path(&self, picture: &mut Picture, camera: &Camera, frames: &[LoopFrame]) {
        let now_ns = frames[frames.len() - 1].displayed_ns;
        let [top, bottom] = [camera.at[1] + 0.8 * camera.block, self.rect.max[1] - self.foot];
        let y = |ns: i64| {
            let ago_s = (now_ns - ns) as f64 / 1e9;
            top + (bottom - top) * (ago_s / PATH_S) as f32
        };
        let since =
            frames.partition_point(|frame| (now_ns - frame.displayed_ns) as f64 > PATH_S * 1e9);
        let frames = &frames[since..];
        // The place of a body does not depend on the time.
        let x = |q: &[f64]| camera.points(self.outline(0.0, q).at)[0];
        let mut held = Vec::new();
        for pair in frames.windows(2) {
            let x = x(&pair[0].q);
            held.extend([[x, y(pair[0].displayed_ns)], [x, y(pair[1].displayed_ns)]]);
        }
        held.extend(frames.last().map(|frame| [x(&frame.q), y(frame.displayed_ns)]));
        let ideal = frames.iter().map(|frame| [x(&frame.exact), y(frame.displayed_ns)]);
        let faint = fade(self.palette.exact, 0.75);
        picture.pen(self.rect).path(ideal, 1.3, faint);
        picture.pen(self.rect).path(held, 2.2, self.colour);
    }

    fn label(&self, at: [f32; 2], align: Align, size: f32, text: String) -> Label {
        captions::text(self.palette, at, align, size, self.palette.text, text)
    }

    /// Writes the loop's name at this height, and the longest wording of its verdict that fits.
    fn name(&self, picture: &mut Picture, y: f32, name: &str) {
        let [left, right] = [self.rect.min[0] + 14.0, self.rect.max[0] - 14.0];
        let room = right - left - GAP - NAME_LETTER * name.chars().count() as f32;
        let name = self.label([left, y], Align::Left, 14.5, name.into());
        picture.labels.push(name.strong());
        let [width, height] = self.size();
        if width < breakpoints::WORDS_BESIDE_BODIES || height < breakpoints::LINE_OF_WORDS {
            return;
        }
        let verdict = self.loops.verdict(self.place);
        let colour = self.palette.of_severity(verdict.severity);
        let fits = |words: &String| VERDICT_LETTER * words.chars().count() as f32 <= room;
        if let Some(words) = verdict.wordings().into_iter().find(fits) {
            let verdict = self.label([right, y], Align::Right, 12.5, words);
            picture.labels.push(Label { colour, ..verdict });
        }
    }

    /// Writes the loop's name with its method, and marks it if selected.
    fn title(&self, picture: &mut Picture) {
        if self.loops.selected() == self.place {
            let [top, bottom] = [self.rect.min[1] + 4.0, self.rect.max[1] - 4.0];
            picture.pen(self.rect).line([2.5, top], [2.5, bottom], 3.0, self.colour);
        }
        let name = match self.size()[0] >= breakpoints::METHOD_BESIDE_LOOP {
            true => format!("{} · {}", self.lane.card().name, self.loops.method().name),
            false => self.lane.card().name.to_owned(),
        };
        self.name(picture, self.rect.max[1] - 0.5 * FOOT, &name);
    }

    fn words(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        frame: &LoopFrame,
        outlines: [&Outline; 2],
    ) {
        let [width, height] = self.size();
        self.title(picture);
        let [drawn, exact] = outlines.map(|outline| camera.points(outline.at));
        let body = (0.5 * camera.block).max(hull::half_height(outlines[0], camera));
        let above = drawn[1] - body - 9.0;
        let has_room =
            width >= breakpoints::WORDS_BESIDE_BODIES && height >= breakpoints::LINE_OF_WORDS;
        if has_room && above > self.rect.min[1] + 6.0 {
            let (accent, rect) = (self.palette.accent, self.rect);
            let ends = [drawn[0], exact[0]].map(|x| [x, above]);
            picture.pen(rect).line(ends[0], ends[1], 1.2, accent);
            let right = drawn[0].max(exact[0]) + 8.0;
            let (x, align) = match right + LATENESS <= width {
                true => (right.max(60.0), Align::Left),
                false => (drawn[0].min(exact[0]).min(width) - 8.0, Align::Right),
            };
            let words = self.label([x, above], align, 12.0, lateness(self.loops, frame));
            picture.labels.push(Label { colour: accent, ..words });
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
