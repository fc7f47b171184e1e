//! A body in front, behind, or exact: draws each part of its outline.

use super::coil::{Span, coil, silhouette, strut};
use super::hull::{self, ShipPose};
use super::sketch::{Camera, LaneStyle};
use super::{Align, Label, Picture, captions, mass};
use crate::look::palette::{BLACK, Palette, Rgba, WHITE, fade, is_bright, mix};
use crate::scene::{Mark, Outline, Thread};

/// Width of a net's threads in front, in points: on the border, and within it.
const BORDER: f32 = 2.2;
const THREAD: f32 = 1.1;

/// An outline as one camera sees it.
#[derive(Clone, Copy)]
pub(super) struct OutlineView<'a> {
    pub(super) outline: &'a Outline,
    pub(super) camera: &'a Camera,
    pub(super) palette: &'static Palette,
}

/// A part that moves with the body, in points.
enum MovingPart {
    /// Its ends.
    Rod([[f32; 2]; 2]),
    /// Its centre and radius.
    Disc([f32; 2], f32),
    Sprung(Span),
    /// Two opposite corners.
    Block([[f32; 2]; 2]),
    Hull(ShipPose),
}

impl OutlineView<'_> {
    fn span(&self) -> Span {
        let quay = self.camera.points(glam::DVec2::new(self.camera.quay_m, 0.0))[0];
        Span { quay, block: self.camera.points(self.outline.at), size: self.camera.block }
    }

    fn pose(&self, bow: glam::DVec2, length: f64) -> ShipPose {
        ShipPose {
            at: self.camera.points(self.outline.at),
            bow: [bow.x as f32, -bow.y as f32],
            length: self.camera.size(length),
        }
    }

    fn box_of(&self, centre: glam::DVec2, half: glam::DVec2) -> [[f32; 2]; 2] {
        let [x, y] = self.camera.points(centre);
        let [w, h] = [self.camera.length(half.x), self.camera.length(half.y)];
        [[x - w, y - h], [x + w, y + h]]
    }

    /// Draws only the fixed parts, for a body that is not shown.
    pub(super) fn draw_fixed_parts(&self, picture: &mut Picture) {
        let is_still = |mark: &&Mark| {
            use Mark::{Anchor, Planet, Rail, Wall};
            matches!(mark, Wall { .. } | Anchor { .. } | Planet { .. } | Rail { .. })
        };
        let marks = self.outline.marks.iter().filter(is_still).copied().collect();
        let Outline { t, at, .. } = *self.outline;
        let outline = Outline { marks, t, at, ..Outline::default() };
        let nothing = LaneStyle::solid(self.palette.chart, 0.0);
        OutlineView { outline: &outline, ..*self }.draw_below_exact(picture, nothing);
    }

    /// Writes a lane's number on a body of this colour, if the body is a single part with enough room.
    pub(super) fn number(&self, picture: &mut Picture, number: impl ToString, on: Rgba) {
        let mut sizes = self.outline.marks.iter().filter_map(|mark| match *mark {
            Mark::Sprung => Some(0.42 * self.camera.block),
            Mark::Disc { radius, .. } => Some(1.1 * self.camera.size(radius)),
            Mark::Block { half, .. } => Some(1.1 * self.camera.size(half.y)),
            _ => None,
        });
        let (Some(size), None) = (sizes.next().filter(|size| *size >= 9.0), sizes.next()) else {
            return;
        };
        let at = self.camera.points(self.outline.at);
        let colour = if is_bright(on) { [16, 24, 32, 255] } else { [255; 4] };
        let words = number.to_string();
        let size = if words.chars().count() > 2 { 0.6 * size } else { size };
        let label = Label::new(at, Align::Centre, size.min(26.0), colour, words);
        picture.labels.push(label.strong());
    }

    /// Draws the parts below the exact solution: springs, rods and fixed parts, with names.
    pub(super) fn draw_below_exact(&self, picture: &mut Picture, style: LaneStyle) {
        let camera = self.camera;
        let pen = &mut picture.pen(camera.rect);
        let still = mix(self.palette.chart, self.palette.sea[1], 0.35);
        let thread = mix(style.colour, self.palette.text, 0.15);
        for Thread { points, is_border } in &self.outline.threads {
            let points = points.iter().map(|point| camera.points(*point));
            let width = if *is_border { BORDER } else { THREAD };
            pen.path(points, width, fade(thread, if *is_border { 1.0 } else { 0.75 }));
        }
        for mark in &self.outline.marks {
            match *mark {
                Mark::Wall { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    pen.line(ends[0], ends[1], 5.0, still);
                }
                Mark::Rail { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    pen.line(ends[0], ends[1], 1.6, fade(still, 0.7));
                }
                Mark::Rod { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    pen.line(ends[0], ends[1], 2.6, mix(style.colour, self.palette.text, 0.3));
                }
                Mark::Sprung => coil(pen, self.span(), self.palette),
                Mark::Anchor { centre, radius } => {
                    mass::ball(pen, camera.points(centre), camera.size(radius), still);
                }
                Mark::Planet { centre, radius } => {
                    mass::planet(pen, camera.points(centre), camera.size(radius));
                }
                Mark::Coil { from, to, radius } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    strut(pen, ends, camera.size(radius), self.palette);
                }
                Mark::Face { corners, light, is_mark } => {
                    let corners = corners.map(|corner| camera.points(corner));
                    let face = mix(style.colour, BLACK, (0.45 - 0.4 * light) as f32);
                    let face = if is_mark { mix(face, WHITE, 0.7) } else { face };
                    pen.fill(&corners, face);
                    pen.ring(&corners, 1.2, mix(face, BLACK, 0.4));
                }
                Mark::Disc { .. }
                | Mark::Block { .. }
                | Mark::Hull { .. }
                | Mark::Hatch { .. }
                | Mark::Edge { .. }
                | Mark::Arrow { .. } => {}
            }
        }
        self.names(picture);
    }

    /// Writes the names of the rails at their left ends.
    fn names(&self, picture: &mut Picture) {
        for (at, text) in &self.outline.names {
            let [x, y] = self.camera.points(*at);
            let (at, colour) = ([x - 6.0, y], self.palette.text);
            let label = captions::text(self.palette, at, Align::Right, 13.0, colour, text.clone());
            picture.labels.push(label.strong());
        }
    }

    /// The moving parts as this camera sees them.
    fn parts(&self) -> impl Iterator<Item = MovingPart> {
        self.outline.marks.iter().filter_map(|mark| {
            Some(match *mark {
                Mark::Rod { from, to } => {
                    MovingPart::Rod([from, to].map(|at| self.camera.points(at)))
                }
                Mark::Disc { centre, radius } => {
                    MovingPart::Disc(self.camera.points(centre), self.camera.size(radius))
                }
                Mark::Sprung => MovingPart::Sprung(self.span()),
                Mark::Block { centre, half } => MovingPart::Block(self.box_of(centre, half)),
                Mark::Hull { bow, length } => MovingPart::Hull(self.pose(bow, length)),
                Mark::Wall { .. }
                | Mark::Anchor { .. }
                | Mark::Planet { .. }
                | Mark::Coil { .. }
                | Mark::Rail { .. }
                | Mark::Hatch { .. }
                | Mark::Face { .. }
                | Mark::Edge { .. }
                | Mark::Arrow { .. } => return None,
            })
        })
    }

    /// Draws the body itself, in front of everything.
    pub(super) fn draw_front(&self, picture: &mut Picture, LaneStyle { colour, .. }: LaneStyle) {
        let camera = self.camera;
        let pen = &mut picture.pen(camera.rect);
        for part in self.parts() {
            match part {
                // Drawn below the exact solution.
                MovingPart::Rod(_) => {}
                MovingPart::Disc(at, radius) => mass::ball(pen, at, radius, colour),
                MovingPart::Sprung(span) => mass::block(pen, span.block, camera.block, colour),
                MovingPart::Block(corners) => mass::slab(pen, corners, colour),
                MovingPart::Hull(pose) => hull::ship(pen, pose, colour, self.palette),
            }
        }
        for mark in &self.outline.marks {
            match *mark {
                Mark::Hatch { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    pen.line(ends[0], ends[1], 1.6, self.palette.sea[1]);
                }
                Mark::Arrow { from, to, is_still } => {
                    let colour = if is_still { self.palette.exact } else { colour };
                    let ends = [from, to].map(|end| camera.points(end));
                    for (width, colour) in [(5.0, fade(self.palette.sea[1], 0.6)), (2.4, colour)] {
                        pen.path(ends, width, colour);
                        pen.path(barbs(ends), width, colour);
                    }
                }
                _ => {}
            }
        }
    }

    /// Draws the edges of a solid that are hidden or not, as `draw` does.
    fn edges(&self, hidden: bool, mut draw: impl FnMut([[f32; 2]; 2])) {
        for mark in &self.outline.marks {
            if let Mark::Edge { from, to, is_hidden } = *mark
                && is_hidden == hidden
            {
                draw([from, to].map(|end| self.camera.points(end)));
            }
        }
    }

    /// Draws a lane behind as hollow outlines, without fixed parts.
    pub(super) fn draw_behind(&self, picture: &mut Picture, style: LaneStyle) {
        let camera = self.camera;
        let pen = &mut picture.pen(camera.rect);
        // A small part has its pattern at half the length.
        let [drawn, gap] = style.dash;
        let dash = if gap > 0.0 { [(drawn / 2.0).max(2.0), 2.5] } else { style.dash };
        let short = LaneStyle { dash, ..style };
        for Thread { points, .. } in self.outline.threads.iter().filter(|it| it.is_border) {
            let points = points.iter().map(|point| camera.points(*point));
            pen.dashed(points, 1.4, fade(style.colour, 0.7), style.dash);
        }
        self.edges(false, |ends| pen.dashed(ends, 1.6, style.colour, short.dash));
        for part in self.parts() {
            match part {
                MovingPart::Rod(ends) => pen.dashed(ends, 1.4, fade(style.colour, 0.7), style.dash),
                MovingPart::Disc(at, radius) => pen.hollow(&mass::round(at, radius), 1.8, short),
                MovingPart::Sprung(span) => {
                    let side = camera.block;
                    let face = mass::square(span.block, 0.78 * side, 6.0 * side / 60.0);
                    pen.hollow(&face, 2.2, short);
                }
                MovingPart::Block(corners) => {
                    pen.hollow(&mass::box_round(corners, 0.0), 2.0, short)
                }
                MovingPart::Hull(pose) => pen.hollow(&pose.hull(0.0), 1.8, style),
            }
        }
    }

    /// Outlines the exact solution.
    pub(super) fn ghost(&self, picture: &mut Picture) {
        let (camera, palette) = (self.camera, self.palette);
        let pen = &mut picture.pen(camera.rect);
        if !self.outline.course.is_empty() {
            let course = self.outline.course.iter().map(|at| camera.points(*at));
            pen.dashed(course, 1.3, fade(palette.exact, 0.6), [2.5, 4.0]);
        }
        for Thread { points, .. } in self.outline.threads.iter().filter(|it| it.is_border) {
            let points = points.iter().map(|point| camera.points(*point));
            pen.path(points.clone(), 3.6, fade(palette.sea[1], 0.6));
            pen.path(points, 1.4, fade(palette.exact, 0.8));
        }
        self.edges(true, |ends| pen.dashed(ends, 1.1, fade(palette.exact, 0.6), [2.5, 4.0]));
        self.edges(false, |ends| {
            pen.path(ends, 3.6, fade(palette.sea[1], 0.6));
            pen.path(ends, 1.5, fade(palette.exact, 0.95));
        });
        for part in self.parts() {
            match part {
                MovingPart::Rod(ends) => {
                    pen.path(ends, 3.6, fade(palette.sea[1], 0.6));
                    pen.path(ends, 1.4, fade(palette.exact, 0.8));
                }
                MovingPart::Disc(at, radius) => pen.ghost(&mass::round(at, radius + 1.5), palette),
                MovingPart::Sprung(span) => silhouette(pen, span, palette),
                MovingPart::Block(corners) => pen.ghost(&mass::box_round(corners, 1.5), palette),
                MovingPart::Hull(pose) => pen.ghost(&pose.hull(-2.0), palette),
            }
        }
    }
}

/// Length of an arrow's barbs, in points.
const BARB: f32 = 9.0;

/// Returns the barbs at the point of an arrow, as a line through it.
fn barbs([from, to]: [[f32; 2]; 2]) -> [[f32; 2]; 3] {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypotf(x, y).max(1.0);
    let [x, y] = [x, y].map(|part| part / length * BARB.min(0.4 * length));
    let barb = |side: f32| [to[0] - x - 0.5 * side * y, to[1] - y + 0.5 * side * x];
    [barb(1.0), to, barb(-1.0)]
}
