//! A body in front, behind, or exact: how each part of its outline is drawn.

use super::coil::{Span, coil, silhouette, strut};
use super::hull::{self, ShipPose};
use super::mass::{self, LaneStyle};
use super::sketch::{Camera, SOLID, line, path};
use super::{Align, Label, Mark, Outline, Picture, Shape};
use crate::lab::palette::{Palette, Rgba, faded, is_bright, mixed};
use crate::lab::scene::Thread;

/// The width of a thread of a net in front, in points: of the border, and within it.
const BORDER: f32 = 2.2;
const THREAD: f32 = 1.1;

/// An outline as one camera sees it.
#[derive(Clone, Copy)]
pub(super) struct OutlineView<'a> {
    pub(super) outline: &'a Outline,
    pub(super) camera: &'a Camera,
    pub(super) palette: &'static Palette,
}

/// A part that moves as the body does, in points.
enum Part {
    /// Its ends.
    Rod([[f32; 2]; 2]),
    /// Its centre and radius.
    Disc([f32; 2], f32),
    Sprung(Span),
    /// Two corners.
    Block([[f32; 2]; 2]),
    Hull(ShipPose),
}

impl OutlineView<'_> {
    fn span(&self) -> Span {
        let quay = self.camera.points(glam::DVec2::new(self.camera.quay_m, 0.0))[0];
        Span { quay, block: self.camera.points(self.outline.at), size: self.camera.block }
    }

    fn berth(&self, bow: glam::DVec2, length: f64) -> ShipPose {
        ShipPose {
            at: self.camera.points(self.outline.at),
            bow: [bow.x as f32, -bow.y as f32],
            length: self.camera.size(length),
        }
    }

    /// The corners of a block.
    fn box_of(&self, centre: glam::DVec2, half: glam::DVec2) -> [[f32; 2]; 2] {
        let [x, y] = self.camera.points(centre);
        let [w, h] = [self.camera.length(half.x), self.camera.length(half.y)];
        [[x - w, y - h], [x + w, y + h]]
    }

    /// What does not move, of a body that is not seen.
    pub(super) fn still(&self, picture: &mut Picture) {
        let is_still = |mark: &&Mark| {
            use Mark::{Anchor, Planet, Rail, Wall};
            matches!(mark, Wall { .. } | Anchor { .. } | Planet { .. } | Rail { .. })
        };
        let marks = self.outline.marks.iter().filter(is_still).copied().collect();
        let Outline { t, at, .. } = *self.outline;
        let outline = Outline { marks, t, at, ..Outline::default() };
        let nothing = LaneStyle { colour: self.palette.chart, dash: SOLID, fill: 0.0 };
        OutlineView { outline: &outline, ..*self }.carried(picture, nothing);
    }

    /// Writes a lane's number on its body of this colour, if that is one thing and has room.
    pub(super) fn number(&self, picture: &mut Picture, number: usize, on: Rgba) {
        let mut sizes = self.outline.marks.iter().filter_map(|mark| match *mark {
            Mark::Sprung => Some(0.42 * self.camera.block),
            Mark::Disc { radius, .. } => Some(1.1 * self.camera.size(radius)),
            Mark::Block { half, .. } => Some(1.1 * self.camera.size(half.y)),
            _ => None,
        });
        let (Some(size), None) = (sizes.next().filter(|size| *size >= 9.0), sizes.next()) else {
            return;
        };
        picture.labels.push(Label {
            at: self.camera.points(self.outline.at),
            align: Align::Centre,
            size: size.min(26.0),
            colour: if is_bright(on) { [16, 24, 32, 255] } else { [255; 4] },
            is_strong: true,
            halo: [0; 4],
            text: number.to_string(),
        });
    }

    /// What carries the body: springs, rods, and what does not move, with names. It is drawn below the exact solution.
    pub(super) fn carried(&self, picture: &mut Picture, coat: LaneStyle) {
        let shapes = &mut picture.shapes;
        let (camera, clip) = (self.camera, self.camera.rect);
        let still = mixed(self.palette.chart, self.palette.sea[1], 0.35);
        let thread = mixed(coat.colour, self.palette.text, 0.15);
        for Thread { points, is_border } in &self.outline.threads {
            let points = points.iter().map(|point| camera.points(*point));
            let width = if *is_border { BORDER } else { THREAD };
            shapes.push(path(
                points,
                width,
                faded(thread, if *is_border { 1.0 } else { 0.75 }),
                SOLID,
                clip,
            ));
        }
        for mark in &self.outline.marks {
            match *mark {
                Mark::Wall { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    shapes.push(line(ends[0], ends[1], 5.0, still, clip));
                }
                Mark::Rail { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    shapes.push(line(ends[0], ends[1], 1.6, faded(still, 0.7), clip));
                }
                Mark::Rod { from, to } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    shapes.push(line(
                        ends[0],
                        ends[1],
                        2.6,
                        mixed(coat.colour, self.palette.text, 0.3),
                        clip,
                    ));
                }
                Mark::Sprung => coil(shapes, self.span(), self.palette, clip),
                Mark::Anchor { centre, radius } => {
                    mass::ball(shapes, camera.points(centre), camera.size(radius), still, clip);
                }
                Mark::Planet { centre, radius } => {
                    mass::planet(shapes, camera.points(centre), camera.size(radius), clip);
                }
                Mark::Coil { from, to, radius } => {
                    let ends = [from, to].map(|end| camera.points(end));
                    strut(shapes, ends, camera.size(radius), self.palette, clip);
                }
                Mark::Disc { .. } | Mark::Block { .. } | Mark::Hull { .. } => {}
            }
        }
        self.names(picture);
    }

    /// Writes the names of the rails, at their left ends.
    fn names(&self, picture: &mut Picture) {
        for (at, text) in &self.outline.names {
            let [x, y] = self.camera.points(*at);
            picture.labels.push(Label {
                at: [x - 6.0, y],
                align: Align::Right,
                size: 13.0,
                colour: self.palette.text,
                is_strong: true,
                halo: faded(self.palette.sea[1], 0.85),
                text: text.clone(),
            });
        }
    }

    /// The parts that move as the body does, where this camera sees them.
    fn parts(&self) -> impl Iterator<Item = Part> {
        self.outline.marks.iter().filter_map(|mark| {
            Some(match *mark {
                Mark::Rod { from, to } => Part::Rod([from, to].map(|at| self.camera.points(at))),
                Mark::Disc { centre, radius } => {
                    Part::Disc(self.camera.points(centre), self.camera.size(radius))
                }
                Mark::Sprung => Part::Sprung(self.span()),
                Mark::Block { centre, half } => Part::Block(self.box_of(centre, half)),
                Mark::Hull { bow, length } => Part::Hull(self.berth(bow, length)),
                Mark::Wall { .. }
                | Mark::Anchor { .. }
                | Mark::Planet { .. }
                | Mark::Coil { .. }
                | Mark::Rail { .. } => return None,
            })
        })
    }

    /// The body itself, in front of everything.
    pub(super) fn front(&self, shapes: &mut Vec<Shape>, coat: LaneStyle) {
        let (camera, clip) = (self.camera, self.camera.rect);
        for part in self.parts() {
            match part {
                // It carries the body.
                Part::Rod(_) => {}
                Part::Disc(at, radius) => mass::ball(shapes, at, radius, coat.colour, clip),
                Part::Sprung(span) => {
                    mass::block(shapes, span.block, camera.block, coat.colour, clip);
                }
                Part::Block(corners) => mass::slab(shapes, corners, coat.colour, clip),
                Part::Hull(berth) => hull::ship(shapes, berth, coat.colour, self.palette, clip),
            }
        }
    }

    /// A lane behind, hollow: what tells where it is, and nothing of what does not move.
    pub(super) fn behind(&self, shapes: &mut Vec<Shape>, coat: LaneStyle) {
        let (camera, clip) = (self.camera, self.camera.rect);
        for Thread { points, .. } in self.outline.threads.iter().filter(|it| it.is_border) {
            let points = points.iter().map(|point| camera.points(*point));
            shapes.push(path(points, 1.4, faded(coat.colour, 0.7), coat.dash, clip));
        }
        for part in self.parts() {
            match part {
                Part::Rod(ends) => {
                    shapes.push(path(ends, 1.4, faded(coat.colour, 0.7), coat.dash, clip));
                }
                Part::Disc(at, radius) => mass::hollow_disc(shapes, at, radius, coat, clip),
                Part::Sprung(span) => {
                    mass::hollow_block(shapes, span.block, camera.block, coat, clip);
                }
                Part::Block(corners) => mass::hollow_slab(shapes, corners, coat, clip),
                Part::Hull(berth) => hull::hollow(shapes, berth, coat, clip),
            }
        }
    }

    /// The exact solution: one line round it.
    pub(super) fn ghost(&self, shapes: &mut Vec<Shape>) {
        let (camera, clip, palette) = (self.camera, self.camera.rect, self.palette);
        if !self.outline.course.is_empty() {
            let course = self.outline.course.iter().map(|at| camera.points(*at));
            shapes.push(path(course, 1.3, faded(palette.exact, 0.6), [2.5, 4.0], clip));
        }
        for Thread { points, .. } in self.outline.threads.iter().filter(|it| it.is_border) {
            let points = points.iter().map(|point| camera.points(*point));
            shapes.push(path(points.clone(), 3.6, faded(palette.sea[1], 0.6), SOLID, clip));
            shapes.push(path(points, 1.4, faded(palette.exact, 0.8), SOLID, clip));
        }
        for part in self.parts() {
            match part {
                Part::Rod(ends) => {
                    shapes.push(path(ends, 3.6, faded(palette.sea[1], 0.6), SOLID, clip));
                    shapes.push(path(ends, 1.4, faded(palette.exact, 0.8), SOLID, clip));
                }
                Part::Disc(at, radius) => mass::ghost_disc(shapes, at, radius, palette, clip),
                Part::Sprung(span) => silhouette(shapes, span, palette, clip),
                Part::Block(corners) => mass::ghost_slab(shapes, corners, palette, clip),
                Part::Hull(berth) => hull::ghost(shapes, berth, palette, clip),
            }
        }
    }
}
