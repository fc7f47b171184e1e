//! The stage of the loop lab: a band for each loop, with the frame that the display holds, the frames before it, and the
//! exact solution at the moment of display.

use glam::DVec2;

use super::body::Seen;
use super::mass::Coat;
use super::sketch::{Camera, SOLID, line, path};
use super::{Align, Framing, Label, Look, Outline, Picture, Rect, Rgba, chart};
use crate::lab::number::round;
use crate::lab::palette::{Palette, faded};
use crate::lab::{Lab, LoopFrame, LoopLab, LoopLane, Severity};

/// From this height of the stage on, in points, a ruler fits above it.
const ROOM_FOR_RULER: f32 = 260.0;
/// From this height of a band on, in points, the path of the frames fits below the body.
const ROOM_FOR_PATH: f32 = 90.0;
/// From this width of the stage on, and this height of a band, in points, words fit beside bodies.
const ROOM_FOR_WORDS: f32 = 420.0;
const LEAST_FOR_WORDS: f32 = 46.0;
/// From this width of the stage on, in points, the method fits beside the loop's name.
const ROOM_FOR_METHOD: f32 = 620.0;
/// How many frames before the present one are seen.
const FRAMES_BEFORE: usize = 14;
/// How strong the first of them is, and the last.
const STRENGTHS: (f32, f32) = (0.5, 0.06);
/// The side of a block, as a part of the band's height, at most in points.
const BLOCK: f32 = 0.27;
const LARGEST_BLOCK: f32 = 44.0;
/// The foot of a band, in which its loop is named, in points.
const FOOT: f32 = 30.0;
/// How long the path of frames is, in seconds of the display.
const PATH_S: f64 = 0.16;
/// How much of the swing the stage shows beside it.
const MARGIN: f64 = 1.22;

/// The picture of the loop lab on a stage of `size` points.
pub(super) fn compose(lab: &Lab, loops: &LoopLab, size: [f32; 2]) -> Picture {
    let palette = lab.display().theme.palette();
    let mut picture = Picture::default();
    let stage = Rect { min: [0.0; 2], max: size };
    chart::sea(&mut picture, stage, palette);
    let has_ruler = size[1] >= ROOM_FOR_RULER;
    let top = if has_ruler { chart::RULER } else { 0.0 };
    let on_stage = loops.on_stage();
    let height = (size[1] - top) / on_stage.len() as f32;
    let mut ruled = None;
    for (row, &place) in on_stage.iter().enumerate() {
        let from = top + height * row as f32;
        let rect = Rect { min: [0.0, from], max: [size[0], from + height] };
        if row > 0 {
            let edge = line([0.0, from], [size[0], from], 1.0, faded(palette.chart, 0.35), rect);
            picture.shapes.push(edge);
        }
        let lane = &loops.lanes()[place];
        let colour = lab.display().theme.loop_style(place).0;
        let band = Band { loops, lane, place, rect, colour, palette };
        ruled = ruled.or(band.draw(&mut picture, lab.display().ghost));
    }
    if let Some(camera) = ruled.filter(|_| has_ruler) {
        let strip = Rect { min: stage.min, max: [size[0], top] };
        chart::ruler(&mut picture, strip, &camera, palette);
    }
    picture
}

/// The band of one loop.
struct Band<'a> {
    loops: &'a LoopLab,
    lane: &'a LoopLane,
    place: usize,
    rect: Rect,
    colour: Rgba,
    palette: &'static Palette,
}

impl Band<'_> {
    fn size(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.rect.max[axis] - self.rect.min[axis])
    }

    fn outline(&self, q: &[f64]) -> Outline {
        let body = self.loops.body();
        Look::of(body.kind).outline(&*body.stepper, q)
    }

    /// What the band shows of the body's world.
    fn camera(&self, exact: DVec2) -> Camera {
        let body = self.loops.body();
        let [width, height] = self.size().map(f64::from);
        let [x, y] = [0, 1].map(|axis| (self.rect.min[axis] + self.rect.max[axis]) / 2.0);
        let plain = Camera {
            rect: self.rect,
            centre_m: DVec2::ZERO,
            at: [x, y],
            points_per_metre: 1.0,
            paper: 0.0,
            block: (BLOCK * height as f32).min(LARGEST_BLOCK),
            quay_m: 0.0,
        };
        match Look::of(body.kind).framing(&*body.stepper) {
            Framing::Recorder { half_width_m } => {
                let [least, most] = self.loops.range();
                let reach = least.abs().max(most.abs());
                let reach = if reach > 0.0 { reach } else { half_width_m };
                let above = self.rect.min[1] + 0.38 * height as f32;
                let at = if self.has_path() { [x, above] } else { plain.at };
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
        let body = self.loops.body();
        let framing = Look::of(body.kind).framing(&*body.stepper);
        matches!(framing, Framing::Recorder { .. }) && self.size()[1] >= ROOM_FOR_PATH
    }

    /// Draws the band. Returns its camera, if that stays where it is.
    fn draw(&self, picture: &mut Picture, shows_ghost: bool) -> Option<Camera> {
        let present = self.lane.frame_at(self.loops.now_ns())?;
        let frames = &self.lane.frames()[..=present];
        let frame = &frames[present];
        let exact = self.outline(&frame.exact);
        let camera = self.camera(exact.at);
        let coat = |colour: Rgba, fill: f32| Coat { colour, dash: SOLID, fill };
        for (strength, before) in distinct_before(frames) {
            let outline = self.outline(&before.q);
            let seen = Seen { outline: &outline, camera: &camera, palette: self.palette };
            seen.behind(&mut picture.shapes, coat(faded(self.colour, strength), 0.12));
        }
        if self.has_path() {
            self.path(picture, &camera, frames);
        }
        let drawn = self.outline(&frame.q);
        let seen = Seen { outline: &drawn, camera: &camera, palette: self.palette };
        if shows_ghost {
            let ghost = Seen { outline: &exact, camera: &camera, palette: self.palette };
            ghost.behind(&mut picture.shapes, coat(self.palette.exact, 0.08));
        }
        let framing = Look::of(self.loops.body().kind).framing(&*self.loops.body().stepper);
        let is_recorded = matches!(framing, Framing::Recorder { .. });
        // A coil would hide the frames before.
        if !is_recorded {
            seen.carried(&mut picture.shapes, coat(self.colour, 0.0));
        }
        seen.front(&mut picture.shapes, coat(self.colour, 0.0));
        seen.number(picture, self.place + 1);
        self.words(picture, &camera, frame, [drawn.at, exact.at]);
        is_recorded.then_some(camera)
    }

    /// Where the frames have shown the body, as a staircase in time, beside where it was.
    fn path(&self, picture: &mut Picture, camera: &Camera, frames: &[LoopFrame]) {
        let now_ns = frames[frames.len() - 1].displayed_ns;
        let [top, bottom] = [camera.at[1] + 0.8 * camera.block, self.rect.max[1] - FOOT];
        let y = |ns: i64| {
            let ago_s = (now_ns - ns) as f64 / 1e9;
            top + (bottom - top) * (ago_s / PATH_S) as f32
        };
        let since =
            frames.partition_point(|frame| (now_ns - frame.displayed_ns) as f64 > PATH_S * 1e9);
        let frames = &frames[since..];
        let x = |q: &[f64]| camera.points(self.outline(q).at)[0];
        let mut held = Vec::new();
        for pair in frames.windows(2) {
            let x = x(&pair[0].q);
            held.extend([[x, y(pair[0].displayed_ns)], [x, y(pair[1].displayed_ns)]]);
        }
        held.extend(frames.last().map(|frame| [x(&frame.q), y(frame.displayed_ns)]));
        let ideal = frames.iter().map(|frame| [x(&frame.exact), y(frame.displayed_ns)]);
        let faint = faded(self.palette.exact, 0.75);
        picture.shapes.push(path(ideal, 1.3, faint, SOLID, self.rect));
        picture.shapes.push(path(held, 2.2, self.colour, SOLID, self.rect));
    }

    fn words(&self, picture: &mut Picture, camera: &Camera, frame: &LoopFrame, at: [DVec2; 2]) {
        let [width, height] = self.size();
        let label = |at, align, size, colour, text: String| Label {
            at,
            align,
            size,
            colour,
            is_strong: false,
            halo: faded(self.palette.sea[1], 0.85),
            text,
        };
        let [left, right] = [self.rect.min[0] + 14.0, self.rect.max[0] - 14.0];
        let foot = self.rect.max[1] - 0.5 * FOOT;
        if self.loops.selected() == self.place {
            let [top, bottom] = [self.rect.min[1] + 4.0, self.rect.max[1] - 4.0];
            picture.shapes.push(line([2.5, top], [2.5, bottom], 3.0, self.colour, self.rect));
        }
        let name = match width >= ROOM_FOR_METHOD {
            true => format!("{} · {}", self.lane.card().name, self.loops.method().name),
            false => self.lane.card().name.to_owned(),
        };
        let name = label([left, foot], Align::Left, 14.5, self.palette.text, name);
        picture.labels.push(Label { is_strong: true, ..name });
        if width < ROOM_FOR_WORDS || height < LEAST_FOR_WORDS {
            return;
        }
        let verdict = self.lane.verdict(self.loops.scene().tick_hz);
        let tone = match verdict.severity {
            Severity::Fine => self.palette.good,
            Severity::Doubtful => self.palette.warn,
            Severity::Bad => self.palette.bad,
            Severity::Unknown => self.palette.dim,
        };
        picture.labels.push(label([right, foot], Align::Right, 12.5, tone, verdict.text));
        let [drawn, exact] = at.map(|at| camera.points(at));
        let above = drawn[1] - 0.5 * camera.block - 9.0;
        let words = match frame.latency_ms() {
            late if late.abs() < 0.05 => "on time".into(),
            late if late > 0.0 => format!("{} ms behind", round(late, 3)),
            early => format!("{} ms ahead", round(-early, 3)),
        };
        if above > self.rect.min[1] + 6.0 {
            picture.shapes.push(line(
                [drawn[0], above],
                [exact[0], above],
                1.2,
                self.palette.accent,
                self.rect,
            ));
            let x = drawn[0].max(exact[0]).clamp(60.0, (width - 120.0).max(60.0));
            picture.labels.push(label(
                [x + 8.0, above],
                Align::Left,
                12.0,
                self.palette.accent,
                words,
            ));
        }
    }
}

/// The frames before the last that show another moment, each with its strength, the furthest first.
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
