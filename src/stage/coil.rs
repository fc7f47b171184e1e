//! A coil spring between the quay and a block: a wire around a drum, seen from the side.

use std::f32::consts::{PI, TAU};

use super::sketch::{Pen, rounded};
use crate::look::palette::{Palette, Rgba, fade};

/// Turns of the wire. Their number is fixed; the pitch stretches.
const TURNS: u16 = 13;
/// Radius of the drum, and length of the straight wire at either end, in blocks.
const RADIUS: f32 = 0.35;
const LEAD: f32 = 0.09;
/// Segments per half turn.
const PIECES: u16 = 7;
/// Least drawn length of a spring, in points. A shorter one has its block at the quay or beyond.
const MIN_LENGTH: f32 = 6.0;

/// Ends of a spring, in points.
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub(super) quay: f32,
    /// Middle of the block.
    pub(super) block: [f32; 2],
    /// Side of the block.
    pub(super) size: f32,
}

impl Span {
    /// Where the turns begin and end.
    fn ends(self) -> Option<(f32, f32)> {
        let lead = LEAD * self.size;
        let (from, to) = (self.quay + lead, self.block[0] - self.size / 2.0 - lead);
        (to - from >= MIN_LENGTH).then_some((from, to))
    }

    /// The point of the wire at this angle (radians) from its first turn.
    fn wire(self, (from, to): (f32, f32), angle: f32) -> [f32; 2] {
        let (pitch, radius) = ((to - from) / f32::from(TURNS), RADIUS * self.size);
        let lean = (0.22 * pitch).min(0.34 * radius);
        let x = from + pitch * angle / TAU + lean * libm::sinf(angle);
        [x, self.block[1] - radius * libm::cosf(angle)]
    }
}

/// Draws the spring in metal.
pub(super) fn coil(pen: &mut Pen<'_>, span: Span, palette: &Palette) {
    let Some(ends) = span.ends() else { return };
    let thick = (span.size / 60.0).clamp(0.25, 1.0);
    let [edge, shade, light, gleam] = palette.wire;
    let dark = fade(edge, 0.75);
    let y = span.block[1];
    for (from, to) in [(span.quay, ends.0), (ends.1, span.block[0])] {
        pen.path([[from, y], [to, y]], 5.0 * thick, shade);
    }
    let half = |turn: u16, back: bool| {
        let first = f32::from(turn) * TAU + if back { PI } else { 0.0 };
        (0..=PIECES).map(move |i| span.wire(ends, first + PI * f32::from(i) / f32::from(PIECES)))
    };
    let mut layer = |back: bool, width: f32, colour: Rgba| {
        for turn in 0..TURNS {
            pen.path(half(turn, back), width * thick, colour);
        }
    };
    layer(true, 6.0, dark);
    layer(true, 3.8, shade);
    layer(false, 6.8, dark);
    layer(false, 4.2, light);
    layer(false, 1.5, gleam);
}

/// Draws a spring between two points, seen from the side, with turns of this radius.
pub(super) fn strut(pen: &mut Pen<'_>, [from, to]: [[f32; 2]; 2], radius: f32, palette: &Palette) {
    const BENDS: u8 = 12;
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypotf(dx, dy).max(1.0);
    let across = [-dy / length * radius, dx / length * radius];
    let bend = |i: u8| {
        let part = f32::from(i) / f32::from(BENDS);
        let side = match i {
            0 | BENDS => 0.0,
            _ if i.is_multiple_of(2) => 1.0,
            _ => -1.0,
        };
        [from[0] + part * dx + side * across[0], from[1] + part * dy + side * across[1]]
    };
    let thick = (radius / 12.0).clamp(0.3, 1.0);
    let [edge, _, light, _] = palette.wire;
    for (width, colour) in [(6.0, fade(edge, 0.75)), (3.4, light)] {
        pen.path((0..=BENDS).map(bend), width * thick, colour);
    }
}

/// Draws the silhouette of a spring and its block, with one line around both.
pub(super) fn silhouette(pen: &mut Pen<'_>, span: Span, palette: &Palette) {
    let half = span.size / 2.0 + 1.5;
    let [x, y] = span.block;
    let block = rounded([x - half, y - half], [x + half, y + half], 0.15 * span.size);
    let veil = fade(palette.exact, 0.12);
    pen.fill(&block, veil);
    let mut round = block;
    if let Some((from, _)) = span.ends() {
        let (edge, swell) = (RADIUS * span.size + 3.0, 0.05 * span.size);
        let left = from - 2.0;
        let right = x - half;
        pen.fill(&[[left, y - edge], [right, y - edge], [right, y + edge], [left, y + edge]], veil);
        let scallop = |i: u16, side: f32| {
            let part = f32::from(i) / f32::from(4 * TURNS);
            let bulge = libm::fabsf(libm::sinf(PI * f32::from(i) / 4.0));
            [left + part * (right - left), y + side * (edge - swell + swell * bulge)]
        };
        // The corners of the block start at the upper right and go clockwise to the upper left.
        let upper = (0..=4 * TURNS).map(|i| scallop(i, -1.0));
        let lower = (0..=4 * TURNS).rev().map(|i| scallop(i, 1.0));
        let (right_side, left_side) = round.split_at(round.len() / 2);
        let (below, above) = left_side.split_at(left_side.len() / 2);
        round = [above, right_side, below].concat();
        round.extend(lower);
        round.extend(upper);
    }
    pen.ghost_rim(&round, palette);
}
