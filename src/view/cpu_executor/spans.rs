//! Colours of neighbouring pixels in a row.
//!
//! A colour to draw is rounded to 8 bits a channel, and then blended in whole numbers, as graphics hardware does.
//!
//! The pixels may be part of a row: `first` is the index of the first of them, by which ramps go on.
//!
//! Each function is compiled for two sets of instructions. Neither joins a product and a sum in one rounding, so that
//! both have the same bytes.

use egui::ColorImage;
use multiversion::multiversion;

/// Red, green, blue and alpha; colours are premultiplied.
pub(super) type Pixel = [u8; 4];

/// Pixels that are calculated together.
const BLOCK: usize = 8;

/// Values in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp {
    /// In the first pixel.
    pub(super) start: f32,
    /// From a pixel to the next.
    pub(super) step: f32,
}

impl Ramp {
    #[inline(always)]
    fn at(self, pixel: f32) -> f32 {
        self.start + self.step * pixel
    }
}

/// The line of a stroke.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// Half its width.
    pub(super) half: Ramp,
    /// Distance from its middle.
    pub(super) across: Ramp,
    /// Distance along it from the middle of its first dash, in periods.
    pub(super) turns: Ramp,
    /// Distance from the middle of a dash to its round end, in pixels.
    pub(super) reach: f32,
    /// Distance between dashes, in pixels.
    pub(super) period: f32,
}

impl Line {
    /// The covered part of a pixel.
    #[inline(always)]
    fn cover(&self, pixel: f32) -> f32 {
        let (half, across) = (self.half.at(pixel), self.across.at(pixel));
        let turns = self.turns.at(pixel);
        let turns = turns - round(turns);
        let from_dash = max(turns, -turns) * self.period;
        let beyond = max(from_dash - self.reach, 0.0);
        let from_line = (beyond * beyond + across * across).sqrt();
        min(max(half + 0.5 - from_line, 0.0), min(2.0 * half, 1.0))
    }
}

/// Strokes in one colour.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn stroke(pixels: &mut [Pixel], first: usize, line: &Line, colour: Pixel) {
    let [red, green, blue, alpha] = colour.map(f32::from);
    blend_each(pixels, first, |x| {
        let cover = line.cover(x);
        [red * cover, green * cover, blue * cover, alpha * cover]
    });
}

/// Strokes in a varying colour, its channels from 0 to 255.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn stroke_ramped(pixels: &mut [Pixel], first: usize, line: &Line, colour: [Ramp; 4]) {
    let [red, green, blue, alpha] = colour;
    blend_each(pixels, first, |x| {
        let cover = line.cover(x);
        [red.at(x) * cover, green.at(x) * cover, blue.at(x) * cover, alpha.at(x) * cover]
    });
}

/// Blends one colour.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn blend(pixels: &mut [Pixel], colour: Pixel) {
    match colour {
        [0, 0, 0, 0] => {}
        [_, _, _, 255] => pixels.fill(colour),
        _ => {
            for pixel in pixels {
                *pixel = over(colour, u32::from_le_bytes(*pixel)).to_le_bytes();
            }
        }
    }
}

/// Blends a varying colour, its channels from 0 to 255.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn blend_ramped(pixels: &mut [Pixel], first: usize, colour: [Ramp; 4]) {
    let [red, green, blue, alpha] = colour;
    blend_each(pixels, first, |x| [red.at(x), green.at(x), blue.at(x), alpha.at(x)]);
}

/// Blends a varying colour times the nearest texel.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn textured(
    pixels: &mut [Pixel],
    first: usize,
    texture: &ColorImage,
    [u, v]: [Ramp; 2],
    colour: [Ramp; 4],
) {
    let [width, height] = texture.size;
    for (x, pixel) in pixels.iter_mut().enumerate() {
        let x = (first + x) as f32;
        let [column, row] = [(u, width), (v, height)]
            .map(|(ramp, side)| (ramp.at(x) as i32).clamp(0, side as i32 - 1) as usize);
        let texel = texture.pixels[row * width + column].to_array();
        if texel != [0; 4] {
            let source = [0, 1, 2, 3]
                .map(|channel| level(colour[channel].at(x) * (f32::from(texel[channel]) / 255.0)));
            *pixel = over(source, u32::from_le_bytes(*pixel)).to_le_bytes();
        }
    }
}

/// Stores the colours of water. Channels are from 0 to 1, and places relative to the light in its reach.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn water(
    pixels: &mut [Pixel],
    first: usize,
    colour: [f32; 3],
    light: [f32; 3],
    x: Ramp,
    y: f32,
) {
    /// Steps of two levels: equal neighbours make a file smaller and faster to write.
    const LEVELS: f32 = 127.5;
    for (n, pixel) in pixels.iter_mut().enumerate() {
        let x = x.at((first + n) as f32);
        let near = max(1.0 - (x * x + y * y), 0.0);
        let near = near * near;
        let channel = |n: usize| {
            let steps = round(min(colour[n] + light[n] * near, 1.0) * LEVELS);
            min(2.0 * steps, 255.0) as u8
        };
        *pixel = [channel(0), channel(1), channel(2), 255];
    }
}

/// Blends the colour that `source` gives for each pixel, by its index in a row, which the pixels have from `first` on.
///
/// A compiler makes vector instructions of this: blocks of one length, and for each pixel the same plain arithmetic.
#[inline(always)]
fn blend_each(pixels: &mut [Pixel], first: usize, source: impl Fn(f32) -> [f32; 4]) {
    let (blocks, rest) = pixels.as_chunks_mut::<BLOCK>();
    let whole = blocks.len() * BLOCK;
    for (n, block) in blocks.iter_mut().enumerate() {
        blend_block(block, (first + n * BLOCK) as f32, &source);
    }
    if !rest.is_empty() {
        let mut block = [[0; 4]; BLOCK];
        for (n, pixel) in rest.iter().enumerate() {
            block[n] = *pixel;
        }
        blend_block(&mut block, (first + whole) as f32, &source);
        for (n, pixel) in rest.iter_mut().enumerate() {
            *pixel = block[n];
        }
    }
}

/// [`blend_each`] of a block whose first pixel has this index.
#[inline(always)]
fn blend_block(block: &mut [Pixel; BLOCK], first: f32, source: &impl Fn(f32) -> [f32; 4]) {
    let mut words = [0; BLOCK];
    for (word, pixel) in words.iter_mut().zip(&*block) {
        *word = u32::from_le_bytes(*pixel);
    }
    for (n, word) in words.iter_mut().enumerate() {
        let [red, green, blue, alpha] = source(first + n as f32);
        *word = over([level(red), level(green), level(blue), level(alpha)], *word);
    }
    for (pixel, word) in block.iter_mut().zip(words) {
        *pixel = word.to_le_bytes();
    }
}

/// A premultiplied colour over another, which has red in its lowest byte.
#[inline(always)]
fn over([red, green, blue, alpha]: Pixel, below: u32) -> u32 {
    let through = u32::from(255 - alpha);
    let channel = |source: u8, below: u32| {
        // The nearest whole number of 255ths, exactly.
        let sum = (below & 255) * through + 128;
        let sum = u32::from(source) + ((sum + (sum >> 8)) >> 8);
        if sum < 255 { sum } else { 255 }
    };
    channel(red, below)
        | channel(green, below >> 8) << 8
        | channel(blue, below >> 16) << 16
        | channel(alpha, below >> 24) << 24
}

/// Adding and subtracting it rounds a number of moderate size to the nearest whole number, and ties to even.
const ROUND: f32 = 12_582_912.0;

fn round(number: f32) -> f32 {
    (number + ROUND) - ROUND
}

/// The nearest level of a channel between 0 and 255.
fn level(channel: f32) -> u8 {
    let channel = min(max(channel, 0.0), 255.0);
    // The low bits of this sum are the whole number.
    (channel + ROUND).to_bits() as u8
}

// `f32::min` and `f32::max` also consider NaN, which takes longer.
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
