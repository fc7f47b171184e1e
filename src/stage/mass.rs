//! A block with an edge and a weight, a slab, a ball and a planet.

use super::sketch::{Pen, circle, rounded};
use crate::look::palette::{BLACK, Rgba, WHITE, fade, mix};

/// Colours of a planet: its air, its water by day and by night, its land.
const AIR: Rgba = [150, 200, 240, 255];
const OCEAN: [Rgba; 2] = [[84, 156, 214, 255], [12, 34, 66, 255]];
const LAND: Rgba = [112, 158, 104, 255];

/// Outline of a square with round corners.
pub(super) fn square([x, y]: [f32; 2], side: f32, radius: f32) -> Vec<[f32; 2]> {
    let half = side / 2.0;
    rounded([x - half, y - half], [x + half, y + half], radius)
}

/// Draws a block of this side, with a pen below it.
pub(super) fn block(pen: &mut Pen<'_>, at: [f32; 2], side: f32, colour: Rgba) {
    let [x, y] = at;
    let part = side / 60.0;
    for i in [4.0, 3.0, 2.0, 1.0, 0.0_f32] {
        let shadow =
            square([x + 3.0 * part, y + 5.0 * part], side + 2.4 * i * part, (8.0 + i) * part);
        pen.fill(&shadow, fade(BLACK, 0.11));
    }
    let tip = [
        [x - 7.0 * part, y + 31.0 * part],
        [x + 7.0 * part, y + 31.0 * part],
        [x, y + 40.0 * part],
    ];
    pen.fill(&tip, colour);
    let diagonal = |corner: [f32; 2]| ((corner[0] - x + corner[1] - y) / side + 1.0) / 2.0;
    let lit = |corner: [f32; 2]| match diagonal(corner) {
        light if light < 0.5 => mix(colour, WHITE, 0.34 * (1.0 - 2.0 * light)),
        dark => mix(colour, BLACK, 0.38 * (2.0 * dark - 1.0)),
    };
    let face = square(at, side, 8.0 * part);
    pen.shaded(&face, lit);
    pen.ring(&face, (1.5 * part).max(0.7), mix(colour, BLACK, 0.55));
    let rim = square(at, side - 4.0 * part, 6.5 * part);
    pen.ring(&rim, 1.2 * part, fade(WHITE, 0.35));
    let inset = square(at, 0.62 * side, 4.0 * part);
    pen.fill(&inset, mix(colour, BLACK, 0.12));
    pen.ring(&inset, (1.2 * part).max(0.5), fade(BLACK, 0.25));
}

/// Draws a ball with a highlight.
pub(super) fn ball(pen: &mut Pen<'_>, at: [f32; 2], radius: f32, colour: Rgba) {
    let [x, y] = at;
    let part = (radius / 12.0).clamp(0.2, 2.0);
    pen.disc([x + part, y + 2.0 * part], radius + part, fade(BLACK, 0.28));
    pen.disc(at, radius, mix(colour, BLACK, 0.45));
    pen.disc(at, radius - part.min(radius / 5.0), colour);
    for (size, part) in [(0.62, 0.16), (0.4, 0.2), (0.2, 0.3)] {
        let inwards = 0.28 * radius;
        let light = [x - inwards, y - inwards];
        pen.disc(light, size * radius, fade(mix(colour, WHITE, 0.75), part));
    }
}

/// Outline of a rounded box between its upper left and its lower right, grown by this many points.
pub(super) fn box_round([min, max]: [[f32; 2]; 2], by: f32) -> Vec<[f32; 2]> {
    let radius = 0.3 * (max[1] - min[1]);
    rounded([min[0] - by, min[1] - by], [max[0] + by, max[1] + by], radius + by)
}

/// Draws a block that is wider than high, with the light from above.
pub(super) fn slab(pen: &mut Pen<'_>, at: [[f32; 2]; 2], colour: Rgba) {
    let [min, max] = at;
    let face = box_round(at, 0.0);
    let shadow: Vec<[f32; 2]> =
        box_round(at, 1.5).iter().map(|[x, y]| [x + 2.0, y + 3.0]).collect();
    pen.fill(&shadow, fade(BLACK, 0.3));
    let lit = |[_, y]: [f32; 2]| {
        let low = (y - min[1]) / (max[1] - min[1]).max(1.0);
        mix(mix(colour, WHITE, 0.3), mix(colour, BLACK, 0.3), low)
    };
    pen.shaded(&face, lit);
    pen.ring(&face, 1.5, mix(colour, BLACK, 0.55));
}

/// Draws a planet with its air, the light from the upper left.
pub(super) fn planet(pen: &mut Pen<'_>, at: [f32; 2], radius: f32) {
    for (size, part) in [(1.3, 0.06), (1.18, 0.1), (1.08, 0.16)] {
        pen.disc(at, size * radius, fade(AIR, part));
    }
    let lit = |[x, y]: [f32; 2]| {
        let light = (x - at[0] + y - at[1]) / (2.8 * radius.max(1.0)) + 0.5;
        mix(OCEAN[0], OCEAN[1], light)
    };
    let face = round(at, radius);
    pen.shaded(&face, lit);
    for ([x, y], size) in [([-0.35, -0.3], 0.3), ([-0.05, -0.45], 0.2), ([0.3, 0.25], 0.34)] {
        let land = [at[0] + x * radius, at[1] + y * radius];
        let night = (x + y + 1.0) / 2.0;
        pen.disc(land, size * radius, mix(LAND, BLACK, 0.55 * night));
    }
    pen.ring(&face, (0.04 * radius).max(0.8), fade(AIR, 0.8));
}

/// Outline of a disc, with enough corners to look round.
pub(super) fn round(at: [f32; 2], radius: f32) -> Vec<[f32; 2]> {
    circle(at, radius, 28)
}
