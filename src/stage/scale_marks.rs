//! Lengths drawn to scale: the course of a ship with its distances, and a round number of metres.

use glam::DVec2;

use super::captions::text;
use super::sketch::Camera;
use super::{Align, Label, Picture, Rect, breakpoints};
use crate::look::palette::{Palette, Rgba, fade};
use crate::sim::number::round;

/// Room of a scale bar at the right of a cell, in points.
const BAR_MARGIN: f32 = 130.0;

/// Draws the course line of a ship `beam` points wide, with distance marks whose numbers keep clear of the ship.
pub(super) fn course(picture: &mut Picture, camera: &Camera, beam: f32, palette: &Palette) {
    let Rect { min, max } = camera.rect;
    let y = camera.points(DVec2::new(0.0, camera.centre_m.y))[1];
    let chart = fade(palette.chart, 0.45);
    picture.pen(camera.rect).dashed([[min[0], y], [max[0], y]], 1.0, chart, [8.0, 5.0]);
    if max[0] - min[0] < breakpoints::MARKS || max[1] - min[1] < breakpoints::SCALE_BAR {
        return;
    }
    let step_m = camera.round_length_m(96.0);
    let named_m = camera.round_length_m(0.47 * f64::from(max[0] - min[0]));
    let is_named = |x_m: f64| libm::fmod(x_m, named_m).abs() < step_m / 2.0;
    let (left, right) = camera.span_m();
    let first = libm::ceil(left / step_m);
    for i in 0..=((right - left) / step_m) as usize {
        let x_m = (first + i as f64) * step_m;
        let [x, _] = camera.points(DVec2::new(x_m, 0.0));
        if x > min[0] + 30.0 && x < max[0] - 30.0 {
            let colour = palette.dim;
            picture.pen(camera.rect).line([x, y - 5.0], [x, y + 5.0], 1.5, colour);
            if !is_named(x_m) {
                continue;
            }
            let unit = if x_m == 0.0 { " m" } else { "" };
            let words = round(x_m, 6) + unit;
            picture.labels.push(text(
                palette,
                [x, (y + (beam / 2.0 + 14.0).max(32.0)).min(max[1] - 9.0)],
                Align::Centre,
                12.0,
                colour,
                words,
            ));
        }
    }
}

/// A line of this width from side to side, with a stroke across each end that extends `reach` points up and down.
pub(super) fn span_line(
    picture: &mut Picture,
    ([left, right], y): ([f32; 2], f32),
    (width, reach): (f32, f32),
    colour: Rgba,
    clip: Rect,
) {
    picture.pen(clip).line([left, y], [right, y], width, colour);
    for x in [left, right] {
        picture.pen(clip).line([x, y - reach], [x, y + reach], width, colour);
    }
}

/// Draws a round number of metres to scale.
pub(super) fn scale_bar(picture: &mut Picture, camera: &Camera, palette: &Palette) {
    let Rect { min, max } = camera.rect;
    if max[0] - min[0] < BAR_MARGIN || max[1] - min[1] < breakpoints::SCALE_BAR {
        return;
    }
    let length_m = camera.round_length_m(40.0);
    let (right, y, colour) = (max[0] - 10.0, max[1] - 8.0, palette.dim);
    let left = right - camera.length(length_m);
    let at = [(left + right) / 2.0, y - 10.0];
    // In a low cell, the badge of a body beyond the edge needs the room.
    let is_taken =
        |label: &Label| (label.at[1] - at[1]).abs() < 16.0 && (label.at[0] - at[0]).abs() < 60.0;
    if picture.labels.iter().any(is_taken) {
        return;
    }
    span_line(picture, ([left, right], y), (1.5, 3.0), colour, camera.rect);
    let words = format!("{} {}", round(length_m, 4), camera.unit);
    picture.labels.push(text(palette, at, Align::Centre, 11.0, colour, words));
}
