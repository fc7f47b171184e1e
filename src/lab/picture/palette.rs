//! The colours of the night chart: one for each method, white for the truth.

use super::Rgba;
use crate::sim::integrators::{METHODS, Method};

/// The exact solution.
pub const TRUTH: Rgba = [240, 244, 250, 255];
/// Quiet text on the stage.
pub const TEXT: Rgba = [150, 168, 190, 255];
/// Distance marks, scale bars, walls.
pub const MARK: Rgba = [112, 132, 158, 255];
/// What went wrong.
pub const ALARM: Rgba = [255, 122, 89, 255];

/// The palette of Okabe and Ito, which people with any kind of colour vision can tell apart; its black
/// is left out, and its dark blue is made lighter for the dark stage.
const COLOURS: [Rgba; 7] = [
    [213, 94, 0, 255],
    [86, 180, 233, 255],
    [240, 228, 66, 255],
    [0, 178, 130, 255],
    [204, 121, 167, 255],
    [230, 159, 0, 255],
    [70, 130, 220, 255],
];

/// Drawn length and gap in points. Five patterns against seven colours: no two of the first 35 methods
/// share both.
const DASHES: [[f32; 2]; 5] = [[9.0, 4.0], [14.0, 3.0], [3.0, 3.0], [1.0, 0.0], [6.0, 6.0]];

/// The colour of a method, and its dash pattern as the second cue: drawn length and gap in points, a
/// gap of 0 being solid.
pub fn style(method: &Method) -> (Rgba, [f32; 2]) {
    let index = METHODS.iter().position(|listed| listed == method).unwrap_or(0);
    (COLOURS[index % COLOURS.len()], DASHES[index % DASHES.len()])
}

/// Chart paper, as the shader paints it.
const PAPER: Rgba = [11, 19, 30, 255];

/// The same colour at this part of its strength on chart paper, opaque.
pub fn dimmed(colour: Rgba, part: f32) -> Rgba {
    let part = part.clamp(0.0, 1.0) * f32::from(colour[3]) / 255.0;
    let mix = |i: usize| f32::from(PAPER[i]) + part * (f32::from(colour[i]) - f32::from(PAPER[i]));
    [mix(0) as u8, mix(1) as u8, mix(2) as u8, 255]
}

/// The same colour, less opaque.
pub fn faded([r, g, b, a]: Rgba, part: f32) -> Rgba {
    [r, g, b, (f32::from(a) * part.clamp(0.0, 1.0)) as u8]
}
