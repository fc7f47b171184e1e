//! The sea under the bodies, drawn as a chart: depth contours, waves, the quay, and rulers.

use std::f32::consts::TAU;
use std::sync::LazyLock;

use glam::DVec2;

use super::sketch::{Camera, Pen, SOLID};
use super::{Align, Label, Picture, Rect, Sea};
use crate::look::palette::{Palette, fade, mix};
use crate::sim::number::round;

/// Height of the ruler along the top of the stage, in points.
pub(super) const RULER: f32 = 24.0;
/// Least distance between the numbers of a ruler, relative to its length.
const NAMED_APART: f64 = 0.19;
/// Height of its striped bar, in points.
const STRIPES: f32 = 6.0;
/// Number of waves on a stage of the usual size, and the area of such a stage in square points.
const USUAL_WAVES: u16 = 150;
const AREA_OF_USUAL_WAVES: f32 = 800.0 * 480.0;

pub(super) fn sea(picture: &mut Picture, stage: Rect, palette: &Palette) {
    picture.sea = Some(Sea { rect: stage, colours: palette.sea });
    let pen = &mut picture.pen(stage);
    contours(pen, stage, palette);
    waves(pen, stage, palette);
}

/// Lines of equal depth around a shoal, relative to its middle, in widths of the stage.
static CONTOURS: LazyLock<[[[f32; 2]; 57]; 8]> = LazyLock::new(|| {
    std::array::from_fn(|n| {
        let number = n as f32;
        let radius = 0.1 + 0.135 * number;
        std::array::from_fn(|i| {
            let angle = TAU * i as f32 / 56.0;
            let bumps = 0.07 * libm::sinf(3.0 * angle + 0.8 * number)
                + 0.05 * libm::sinf(5.0 * angle - 1.1 * number);
            let reach = radius * (1.0 + bumps);
            [reach * libm::cosf(angle), 0.8 * reach * libm::sinf(angle)]
        })
    })
});

fn contours(pen: &mut Pen<'_>, stage: Rect, palette: &Palette) {
    let [width, height] = stage.sides();
    let middle = [stage.min[0] + 0.93 * width, stage.min[1] + 0.3 * height];
    for (n, contour) in CONTOURS.iter().enumerate() {
        let points = contour.iter().map(|[x, y]| [middle[0] + width * x, middle[1] + width * y]);
        let dash = if n % 2 == 0 { SOLID } else { [1.5, 5.0] };
        pen.dashed(points, 1.0, fade(palette.chart, 0.13), dash);
    }
}

/// A short stroke on the water.
struct Wave {
    /// Its start, in widths and heights of the stage.
    at: [f32; 2],
    /// Length in points.
    length: f32,
    /// Opacity.
    strength: f32,
}

/// Waves in the same scatter on every stage; a small stage shows fewer.
static WAVES: LazyLock<Vec<Wave>> = LazyLock::new(|| {
    let mut dice = 0x9E37_79B9_u32;
    let mut roll = || {
        // Marsaglia's xorshift with 13, 17 and 5.
        dice ^= dice << 13;
        dice ^= dice >> 17;
        dice ^= dice << 5;
        (dice >> 8) as f32 / (1 << 24) as f32
    };
    let wave = |_| Wave {
        at: [roll(), roll()],
        length: 6.0 + 10.0 * roll(),
        strength: 0.08 + 0.1 * roll(),
    };
    (0..4 * USUAL_WAVES).map(wave).collect()
});

fn waves(pen: &mut Pen<'_>, stage: Rect, palette: &Palette) {
    let size = stage.sides();
    let count = f32::from(USUAL_WAVES) * size[0] * size[1] / AREA_OF_USUAL_WAVES;
    for wave in WAVES.iter().take(count as usize) {
        let [x, y] = [0, 1].map(|axis| stage.min[axis] + size[axis] * wave.at[axis]);
        let crest = [x + wave.length / 2.0, y - 1.6];
        let colour = fade(palette.chart, wave.strength);
        pen.line([x, y], crest, 1.0, colour);
        pen.line(crest, [x + wave.length, y], 1.0, colour);
    }
}

/// Draws the quay at the left of a camera's cell, with its shadow on the water.
pub(super) fn quay(picture: &mut Picture, camera: &Camera, palette: &Palette) {
    const SLAB: f32 = 36.0;
    let clip = camera.rect;
    let pen = &mut picture.pen(clip);
    let edge = camera.points(DVec2::new(camera.quay_m, 0.0))[0];
    let (top, bottom) = (clip.min[1], clip.max[1]);
    if edge <= clip.min[0] {
        return;
    }
    let left = clip.min[0];
    let [stone, rim] = palette.quay;
    let shadow = |at: [f32; 2]| if at[0] > edge { [0; 4] } else { [0, 0, 0, 110] };
    let reach = edge + 22.0;
    let water = [[edge, top], [reach, top], [reach, bottom], [edge, bottom]];
    pen.shaded(&water, shadow);
    pen.fill(&[[left, top], [edge, top], [edge, bottom], [left, bottom]], stone);
    let joint = mix(stone, [0, 0, 0, 255], 0.35);
    let first = (top / SLAB).floor() * SLAB;
    for i in 0..=((bottom - first) / SLAB) as u16 {
        let y = first + f32::from(i) * SLAB;
        pen.line([left, y], [edge - 6.0, y], 1.0, joint);
    }
    pen.line([edge - 3.0, top], [edge - 3.0, bottom], 5.0, rim);
}

/// Draws the ring on the quay to which a spring is moored.
pub(super) fn mooring(picture: &mut Picture, camera: &Camera, palette: &Palette) {
    let pen = &mut picture.pen(camera.rect);
    let [x, y] = camera.points(DVec2::new(camera.quay_m, 0.0));
    let radius = 0.17 * camera.block;
    let at = [x - 1.7 * radius, y];
    let rim = palette.quay[1];
    pen.disc(at, radius, mix(rim, [0, 0, 0, 255], 0.5));
    pen.disc(at, 0.72 * radius, rim);
    pen.line(at, [x + 2.0, y], 0.4 * radius, mix(rim, palette.text, 0.4));
}

/// Divides a rectangle into the strip of a ruler, if it has one, and the room below.
pub(super) fn under_ruler(rect: Rect, has_ruler: bool) -> (Option<Rect>, Rect) {
    let Rect { min, max } = rect;
    let top = min[1] + if has_ruler { RULER } else { 0.0 };
    (has_ruler.then_some(Rect { min, max: [max[0], top] }), Rect { min: [min[0], top], max })
}

/// Draws a ruler along the top of the stage, in the metres of the camera below it.
pub(super) fn ruler(picture: &mut Picture, strip: Rect, camera: &Camera, palette: &Palette) {
    let Rect { min, max } = strip;
    picture.pen(strip).fill(
        &[min, [max[0], min[1]], max, [min[0], max[1]]],
        mix(palette.panel, palette.background, 0.4),
    );
    let step_m = camera.round_length_m(NAMED_APART * f64::from(max[0] - min[0]));
    let (left, right) = camera.span_m();
    let [top, bottom] = [max[1] - STRIPES, max[1]];
    let x = |i: i64| camera.points(DVec2::new(i as f64 * step_m / 2.0, 0.0))[0];
    let light = mix(palette.panel, palette.text, 0.75);
    let first = libm::floor(2.0 * left / step_m) as i64;
    let last = libm::ceil(2.0 * right / step_m) as i64;
    // Beyond 10¹⁸ marks, both ends saturate at the last whole number.
    let last = last.min(first.saturating_add(400));
    for i in first..last {
        let shade = if i.rem_euclid(2) == 0 { light } else { palette.line };
        let (from, to) = (x(i).max(min[0]), x(i + 1).min(max[0]));
        if to > from {
            let stripe = [[from, top], [to, top], [to, bottom], [from, bottom]];
            picture.pen(strip).fill(&stripe, shade);
        }
    }
    for i in (first..=last).filter(|i| i.rem_euclid(2) == 0) {
        let at = x(i);
        if at < min[0] + 22.0 || at > max[0] - 22.0 {
            continue;
        }
        let metres = (i / 2) as f64 * step_m;
        let text = match i {
            0 => format!("0 {}", camera.unit),
            _ if camera.quay_m != 0.0 && metres > 0.0 => format!("+{}", round(metres, 6)),
            _ => round(metres, 6),
        };
        let at = [at, min[1] + 9.0];
        picture.labels.push(Label::new(at, Align::Centre, 12.5, palette.text, text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::palette::Theme;

    #[test]
    fn a_ruler_has_marks_only_within_the_whole_numbers() {
        let rect = Rect { min: [0.0, 0.0], max: [800.0, RULER] };
        let marks = |x: f64| {
            let camera = Camera { centre_m: DVec2::new(x, 0.0), ..Camera::of(rect, 50.0) };
            let mut picture = Picture::default();
            ruler(&mut picture, rect, &camera, Theme::Dark.palette());
            picture.labels.len()
        };
        for x in [0.0, -3e6, 1e12] {
            assert!((2..=8).contains(&marks(x)), "{} at {x}", marks(x));
        }
        for x in [1e30, -1e30, 1e300, -1e300] {
            assert_eq!(marks(x), 0, "{x}");
        }
    }
}
