//! A block with an edge and a weight, a bead, and how the lanes behind are drawn: hollow, in dashes.

use super::sketch::{SOLID, circle, disc, fill, ring, rounded, shaded};
use super::{Rect, Rgba, Shape};
use crate::lab::palette::{BLACK, Palette, WHITE, faded, mixed};

/// How a lane looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneStyle {
    pub(super) colour: Rgba,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub(super) dash: [f32; 2],
    /// How much of its colour fills it, where it is behind.
    pub(super) fill: f32,
}

/// A planet: its air, its water by day and by night, its land.
const AIR: Rgba = [150, 200, 240, 255];
const OCEAN: [Rgba; 2] = [[84, 156, 214, 255], [12, 34, 66, 255]];
const LAND: Rgba = [112, 158, 104, 255];

fn square([x, y]: [f32; 2], side: f32, radius: f32) -> Vec<[f32; 2]> {
    let half = side / 2.0;
    rounded([x - half, y - half], [x + half, y + half], radius)
}

/// A block of this side, with a pen below it.
pub(super) fn block(shapes: &mut Vec<Shape>, at: [f32; 2], side: f32, colour: Rgba, clip: Rect) {
    let [x, y] = at;
    let part = side / 60.0;
    for i in [4.0, 3.0, 2.0, 1.0, 0.0_f32] {
        let shadow =
            square([x + 3.0 * part, y + 5.0 * part], side + 2.4 * i * part, (8.0 + i) * part);
        shapes.push(fill(&shadow, faded(BLACK, 0.11), clip));
    }
    let pen = [
        [x - 7.0 * part, y + 31.0 * part],
        [x + 7.0 * part, y + 31.0 * part],
        [x, y + 40.0 * part],
    ];
    shapes.push(fill(&pen, colour, clip));
    let diagonal = |corner: [f32; 2]| ((corner[0] - x + corner[1] - y) / side + 1.0) / 2.0;
    let lit = |corner: [f32; 2]| match diagonal(corner) {
        light if light < 0.5 => mixed(colour, WHITE, 0.34 * (1.0 - 2.0 * light)),
        dark => mixed(colour, BLACK, 0.38 * (2.0 * dark - 1.0)),
    };
    let face = square(at, side, 8.0 * part);
    shapes.push(shaded(&face, lit, clip));
    shapes.push(ring(&face, (1.5 * part).max(0.7), mixed(colour, BLACK, 0.55), SOLID, clip));
    let rim = square(at, side - 4.0 * part, 6.5 * part);
    shapes.push(ring(&rim, 1.2 * part, faded(WHITE, 0.35), SOLID, clip));
    let inset = square(at, 0.62 * side, 4.0 * part);
    shapes.push(fill(&inset, mixed(colour, BLACK, 0.12), clip));
    shapes.push(ring(&inset, (1.2 * part).max(0.5), faded(BLACK, 0.25), SOLID, clip));
}

/// A ball with a light on it.
pub(super) fn ball(shapes: &mut Vec<Shape>, at: [f32; 2], radius: f32, colour: Rgba, clip: Rect) {
    let [x, y] = at;
    let part = (radius / 12.0).clamp(0.2, 2.0);
    shapes.push(disc([x + part, y + 2.0 * part], radius + part, faded(BLACK, 0.28), clip));
    shapes.push(disc(at, radius, mixed(colour, BLACK, 0.45), clip));
    shapes.push(disc(at, radius - part.min(radius / 5.0), colour, clip));
    for (size, part) in [(0.62, 0.16), (0.4, 0.2), (0.2, 0.3)] {
        let inwards = 0.28 * radius;
        let light = [x - inwards, y - inwards];
        shapes.push(disc(light, size * radius, faded(mixed(colour, WHITE, 0.75), part), clip));
    }
}

/// A block of a lane behind.
pub(super) fn hollow_block(
    shapes: &mut Vec<Shape>,
    at: [f32; 2],
    side: f32,
    coat: LaneStyle,
    clip: Rect,
) {
    let face = square(at, 0.78 * side, 6.0 * side / 60.0);
    shapes.push(fill(&face, faded(coat.colour, coat.fill), clip));
    shapes.push(ring(&face, 2.2, coat.colour, short(coat.dash), clip));
}

/// The corners of a box between its upper left and its lower right, grown by this many points.
fn box_round([min, max]: [[f32; 2]; 2], by: f32) -> Vec<[f32; 2]> {
    let radius = 0.3 * (max[1] - min[1]);
    rounded([min[0] - by, min[1] - by], [max[0] + by, max[1] + by], radius + by)
}

/// A block that is wider than high, with the light from above.
pub(super) fn slab(shapes: &mut Vec<Shape>, at: [[f32; 2]; 2], colour: Rgba, clip: Rect) {
    let [min, max] = at;
    let face = box_round(at, 0.0);
    let shadow: Vec<[f32; 2]> =
        box_round(at, 1.5).iter().map(|[x, y]| [x + 2.0, y + 3.0]).collect();
    shapes.push(fill(&shadow, faded(BLACK, 0.3), clip));
    let lit = |[_, y]: [f32; 2]| {
        let low = (y - min[1]) / (max[1] - min[1]).max(1.0);
        mixed(mixed(colour, WHITE, 0.3), mixed(colour, BLACK, 0.3), low)
    };
    shapes.push(shaded(&face, lit, clip));
    shapes.push(ring(&face, 1.5, mixed(colour, BLACK, 0.55), SOLID, clip));
}

/// A block of a lane behind that is wider than high.
pub(super) fn hollow_slab(shapes: &mut Vec<Shape>, at: [[f32; 2]; 2], coat: LaneStyle, clip: Rect) {
    let face = box_round(at, 0.0);
    shapes.push(fill(&face, faded(coat.colour, coat.fill), clip));
    shapes.push(ring(&face, 2.0, coat.colour, short(coat.dash), clip));
}

/// The rim of a block of the exact solution that is wider than high.
pub(super) fn ghost_slab(
    shapes: &mut Vec<Shape>,
    at: [[f32; 2]; 2],
    palette: &Palette,
    clip: Rect,
) {
    ghost_rim(shapes, &box_round(at, 1.5), palette, clip);
}

/// A planet with its air, the light from the upper left.
pub(super) fn planet(shapes: &mut Vec<Shape>, at: [f32; 2], radius: f32, clip: Rect) {
    for (size, part) in [(1.3, 0.06), (1.18, 0.1), (1.08, 0.16)] {
        shapes.push(disc(at, size * radius, faded(AIR, part), clip));
    }
    let lit = |[x, y]: [f32; 2]| {
        let light = (x - at[0] + y - at[1]) / (2.8 * radius.max(1.0)) + 0.5;
        mixed(OCEAN[0], OCEAN[1], light)
    };
    let face = round(at, radius);
    shapes.push(shaded(&face, lit, clip));
    for ([x, y], size) in [([-0.35, -0.3], 0.3), ([-0.05, -0.45], 0.2), ([0.3, 0.25], 0.34)] {
        let land = [at[0] + x * radius, at[1] + y * radius];
        let night = (x + y + 1.0) / 2.0;
        shapes.push(disc(land, size * radius, mixed(LAND, BLACK, 0.55 * night), clip));
    }
    shapes.push(ring(&face, (0.04 * radius).max(0.8), faded(AIR, 0.8), SOLID, clip));
}

/// The corners of a disc, as many as show a body round.
fn round(at: [f32; 2], radius: f32) -> Vec<[f32; 2]> {
    circle(at, radius, 28)
}

/// A bead of a lane behind.
pub(super) fn hollow_disc(
    shapes: &mut Vec<Shape>,
    at: [f32; 2],
    radius: f32,
    coat: LaneStyle,
    clip: Rect,
) {
    shapes.push(fill(&round(at, radius), faded(coat.colour, coat.fill), clip));
    shapes.push(ring(&round(at, radius), 1.8, coat.colour, short(coat.dash), clip));
}

/// The rim of a disc of the exact solution.
pub(super) fn ghost_disc(
    shapes: &mut Vec<Shape>,
    at: [f32; 2],
    radius: f32,
    palette: &Palette,
    clip: Rect,
) {
    ghost_rim(shapes, &round(at, radius + 1.5), palette, clip);
}

fn ghost_rim(shapes: &mut Vec<Shape>, rim: &[[f32; 2]], palette: &Palette, clip: Rect) {
    shapes.push(fill(rim, faded(palette.exact, 0.12), clip));
    shapes.push(ring(rim, 4.0, faded(palette.sea[1], 0.6), SOLID, clip));
    shapes.push(ring(rim, 1.8, faded(palette.exact, 0.95), SOLID, clip));
}

/// The dashes of something small: a lane's own pattern at half its length.
pub(super) fn short([drawn, gap]: [f32; 2]) -> [f32; 2] {
    if gap > 0.0 { [(drawn / 2.0).max(2.0), 2.5] } else { [drawn, gap] }
}
