//! Draws a [`Drawing`] with the processor, by the rules of the shaders.
//!
//! It calculates with whole numbers, and with floats only by `+`, `-`, `*`, `/` and square roots, which round alike on
//! every machine. So the same drawing has the same bytes everywhere, whatever the number of threads.

mod kept_frame;
mod spans;
mod tiles;
mod triangle;

use std::collections::HashMap;
use std::num::NonZero;
use std::ops::Range;
use std::sync::Arc;
use std::thread;

use egui::epaint::{Vertex, WHITE_UV};
use egui::{Color32, ColorImage, ImageData, TextureId};
use fearless_simd::Level;

use super::drawing::{DrawKind, Drawing, SeaRect, StrokeVertex};
use super::screen_transform::ScreenTransform;
pub use kept_frame::KeptFrame;
use spans::{Pixel, Ramp};
use tiles::Tiles;
use triangle::{Triangle, Window};

/// The textures of a renderer's drawings. A clone shares their pixels.
#[derive(Clone, Debug, Default)]
pub(super) struct Textures {
    present: HashMap<TextureId, Texture>,
    /// Number of changes so far.
    changes: u64,
}

#[derive(Clone, Debug)]
struct Texture {
    image: Arc<ColorImage>,
    /// The last change of texels that an earlier drawing may have shown.
    change: u64,
}

impl Textures {
    /// Applies the changes of the next drawing. Passes the textures to draw it with to `draw`.
    pub(super) fn update<T>(&mut self, drawing: &Drawing, draw: impl FnOnce(&Self) -> T) -> T {
        for (id, delta) in &drawing.textures.set {
            let ImageData::Color(image) = &delta.image;
            self.changes += 1;
            let change = self.changes;
            match (delta.pos, self.present.get_mut(id)) {
                (None, _) => {
                    let image = Arc::clone(image);
                    self.present.insert(*id, Texture { image, change });
                }
                (Some(at), Some(texture)) => {
                    if copy_into(Arc::make_mut(&mut texture.image), image, at) {
                        texture.change = change;
                    }
                }
                (Some(_), None) => {}
            }
        }
        let drawn = draw(self);
        for id in &drawing.textures.freed {
            self.present.remove(id);
        }
        drawn
    }
}

/// Returns whether it changes more than texels that were transparent, as those of new letters are.
fn copy_into(whole: &mut ColorImage, part: &ColorImage, [left, top]: [usize; 2]) -> bool {
    let mut has_changed = false;
    for (y, row) in part.pixels.chunks_exact(part.width().max(1)).enumerate() {
        let first = (top + y) * whole.width() + left;
        let texels = &mut whole.pixels[first..first + row.len()];
        let mut pairs = texels.iter().zip(row);
        has_changed |= pairs.any(|(was, is)| was != is && *was != Color32::TRANSPARENT);
        texels.copy_from_slice(row);
    }
    has_changed
}

/// Draws the drawings of one renderer.
#[derive(Debug)]
pub struct CpuExecutor {
    /// Those of the drawings so far.
    pub(super) textures: Textures,
    rasterizer: Rasterizer,
}

impl CpuExecutor {
    /// Longest side of a texture, in pixels. Letters are packed into textures of this width. Larger ones are slower to
    /// look up.
    pub const MAX_TEXTURE_SIDE_PX: u32 = 4096;

    /// Creates an executor that draws with this number of threads.
    pub fn new(threads: NonZero<usize>) -> Self {
        Self { textures: Textures::default(), rasterizer: Rasterizer::new(threads) }
    }

    /// Creates an executor that draws with one thread per core.
    #[expect(clippy::disallowed_methods, reason = "any number of threads makes the same bytes")]
    pub fn on_all_cores() -> Self {
        Self::new(thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN))
    }

    /// Replaces `rows` by the pixels of the drawing: red, green, blue, alpha, top row first, no padding.
    pub fn execute(&mut self, drawing: &Drawing, rows: &mut Vec<u8>) {
        let Self { textures, rasterizer } = self;
        textures.update(drawing, |textures| rasterizer.draw(drawing, textures, rows));
    }
}

/// Calculates the pixels of drawings of one renderer, in any order.
#[derive(Debug)]
pub struct Rasterizer {
    threads: NonZero<usize>,
    /// The id of the backdrop, if there is one, and its pixels.
    backdrop_id: Option<u64>,
    backdrop: Vec<u8>,
}

impl Rasterizer {
    /// Creates a rasterizer that draws with this number of threads.
    pub fn new(threads: NonZero<usize>) -> Self {
        Self { threads, backdrop_id: None, backdrop: Vec::new() }
    }

    /// [`CpuExecutor::execute`] with these textures.
    pub(super) fn draw(&mut self, drawing: &Drawing, textures: &Textures, rows: &mut Vec<u8>) {
        self.draw_tiles(drawing, textures, rows, None);
    }

    /// [`draw`](Self::draw), but of `tiles` only those that differ from the drawing before, whose pixels `rows` has.
    fn draw_tiles(
        &mut self,
        drawing: &Drawing,
        textures: &Textures,
        rows: &mut Vec<u8>,
        tiles: Option<&mut Tiles>,
    ) {
        let [width, height] = drawing.size_px.map(|side| side as usize);
        rows.resize(4 * width * height, 0);
        let pixels: &mut [Pixel] = rows.as_chunks_mut().0;
        let backdrop = drawing.backdrop.filter(|_| self.has_room_for(pixels.len()));
        let tiles = tiles.map(|tiles| {
            tiles.compare(drawing, textures, backdrop);
            &*tiles
        });
        let Some(backdrop) = backdrop else {
            return self.paint(drawing, textures, pixels, 0..usize::MAX, None, tiles);
        };
        let covered = 1 + backdrop.draws;
        if self.backdrop_id.replace(backdrop.id) != Some(backdrop.id) {
            self.paint(drawing, textures, pixels, 0..covered, None, None);
            self.backdrop.clear();
            self.backdrop.extend_from_slice(pixels.as_flattened());
        }
        let below = self.backdrop.as_chunks().0;
        self.paint(drawing, textures, pixels, covered..usize::MAX, Some(below), tiles);
    }

    /// Whether there is memory for a backdrop of this number of pixels.
    fn has_room_for(&mut self, pixels: usize) -> bool {
        let missing = (4 * pixels).saturating_sub(self.backdrop.len());
        self.backdrop.try_reserve_exact(missing).is_ok()
    }

    /// Paints parts of the drawing over `below` or black: part 0 is the sea, and part `n` is draw `n - 1`. Only tiles
    /// that have changed, if there are `tiles`.
    #[expect(clippy::disallowed_methods, reason = "any number of threads makes the same bytes")]
    fn paint(
        &self,
        drawing: &Drawing,
        textures: &Textures,
        pixels: &mut [Pixel],
        parts: Range<usize>,
        below: Option<&[Pixel]>,
        tiles: Option<&Tiles>,
    ) {
        let [width, height] = drawing.size_px.map(|side| side as usize);
        if pixels.is_empty() {
            return;
        }
        let band_rows = height.div_ceil(self.threads.get());
        let band_pixels = band_rows * width;
        let paint = |n: usize, pixels: &mut [Pixel]| {
            let top = (n * band_rows) as i32;
            let mut band = Band { top, width, pixels, tiles };
            band.clear(below);
            band.paint(drawing, textures, parts.clone());
        };
        let mut bands = pixels.chunks_mut(band_pixels).enumerate();
        let Some((_, first)) = bands.next() else { return };
        if bands.len() == 0 {
            // A scope allocates.
            return paint(0, first);
        }
        thread::scope(|threads| {
            for (n, band) in bands {
                let paint = &paint;
                threads.spawn(move || paint(n, band));
            }
            paint(0, first);
        });
    }
}

/// Some rows of a frame.
struct Band<'p> {
    /// The first row.
    top: i32,
    width: usize,
    pixels: &'p mut [Pixel],
    /// Only those that have changed are drawn.
    tiles: Option<&'p Tiles>,
}

impl Band<'_> {
    /// Replaces the rows by those of `below`, a whole frame, or by black.
    fn clear(&mut self, below: Option<&[Pixel]>) {
        let (top, width) = (self.top, self.width as i32);
        for y in top..self.bottom() {
            self.row(y, 0..width, |pixels, first| match below {
                Some(below) => {
                    let first = (y * width) as usize + first;
                    pixels.copy_from_slice(&below[first..first + pixels.len()]);
                }
                None => pixels.fill([0, 0, 0, 255]),
            });
        }
    }

    fn paint(&mut self, drawing: &Drawing, textures: &Textures, parts: Range<usize>) {
        if let Some(sea) = drawing.sea.filter(|_| parts.start == 0) {
            self.sea(&sea);
        }
        let draws = drawing.draws.iter().take(parts.end - 1);
        let mut first = 0;
        for draw in draws.skip(parts.start.max(1) - 1) {
            let triangles = first..first + draw.indices.len() / 3;
            first = triangles.end;
            let within = [self.top, self.bottom()];
            let Some(window) = window(draw.scissor_px, self.width as i32, within) else { continue };
            let transform = &drawing.transforms[draw.place as usize];
            let at = Placement { window, transform };
            let tiles = self.tiles;
            match draw.kind {
                DrawKind::Stroke => {
                    let corners = drawing.strokes.corners(&draw.indices);
                    changed(tiles, triangles, corners).for_each(|corners| self.stroke(at, corners));
                }
                DrawKind::OpaqueFill => {
                    let corners = drawing.triangles.corners(&draw.indices);
                    changed(tiles, triangles, corners).for_each(|corners| self.fill(at, corners));
                }
                DrawKind::Textured(id) => {
                    let Some(texture) = textures.present.get(&id) else { continue };
                    let corners = drawing.triangles.corners(&draw.indices);
                    changed(tiles, triangles, corners)
                        .for_each(|corners| self.textured(at, corners, &texture.image));
                }
            }
        }
    }

    /// Beyond the last row.
    fn bottom(&self) -> i32 {
        self.top + (self.pixels.len() / self.width) as i32
    }

    /// Passes the parts of a row that are to be drawn to `draw`, each with its distance from the first pixel.
    fn row(&mut self, y: i32, xs: Range<i32>, mut draw: impl FnMut(&mut [Pixel], usize)) {
        let xs = xs.start as usize..xs.end as usize;
        let first = (y - self.top) as usize * self.width;
        let row = &mut self.pixels[first..first + self.width];
        let Some(tiles) = self.tiles else { return draw(&mut row[xs], 0) };
        for part in tiles.changed(y as usize, xs.clone()) {
            let first = part.start - xs.start;
            draw(&mut row[part], first);
        }
    }

    /// `water` in `shaders/sea.wgsl`.
    fn sea(&mut self, &SeaRect { scissor_px, rect_px, colours }: &SeaRect) {
        /// Reach of the light as a part of the sea's height.
        const REACH: f32 = 1.25;
        /// Lightening in its middle.
        const LIGHT: f32 = 0.40;
        let within = [self.top, self.bottom()];
        let Some(window) = window(scissor_px, self.width as i32, within) else { return };
        let [left_px, top_px, right_px, bottom_px] = rect_px.map(|side| side as i32);
        let columns = window.left.max(left_px)..window.right.min(right_px);
        if columns.is_empty() {
            return;
        }
        let unit = |colour: [u8; 4]| [0, 1, 2].map(|channel| f32::from(colour[channel]) / 255.0);
        let [top_colour, bottom_colour] = colours.map(unit);
        let light = top_colour.map(|channel| LIGHT * channel * (1.0 - channel));
        let [left, top, right, bottom] = rect_px;
        let height = bottom - top;
        let middle = [left + (right - left) * 0.62, top + height * 0.22];
        let reach = REACH * height.max(1.0);
        for y in window.top.max(top_px)..window.bottom.min(bottom_px) {
            let at = y as f32 + 0.5;
            let part = (at - top) / height;
            let colour = [0, 1, 2].map(|channel| {
                top_colour[channel] + (bottom_colour[channel] - top_colour[channel]) * part
            });
            let from_light = [columns.start as f32 + 0.5 - middle[0], at - middle[1]];
            let [start, y_part] = from_light.map(|px| px / reach);
            let x = Ramp { start, step: 1.0 / reach };
            self.row(y, columns.clone(), |pixels, first| {
                spans::water(pixels, first, colour, light, x, y_part);
            });
        }
    }

    /// `stroke` in `shaders/strokes.wgsl`.
    fn stroke(&mut self, at: Placement<'_>, corners: [&StrokeVertex; 3]) {
        let Some(triangle) = at.triangle(corners.map(|corner| corner.at)) else { return };
        let colours = corners.map(|corner| corner.colour);
        let is_covered = |corner: &StrokeVertex| {
            let [half, across] = corner.across_px;
            half >= 0.5 && across == 0.0 && corner.along_px[0] == 0.0
        };
        if corners.iter().all(|corner| is_covered(corner)) {
            return self.blend(&triangle, colours);
        }
        let slopes = triangle.slopes();
        let half = slopes.plane(corners.map(|corner| corner.across_px[0]));
        let across = slopes.plane(corners.map(|corner| corner.across_px[1]));
        let turns = slopes.plane(corners.map(|corner| corner.along_px[0] / corner.along_px[2]));
        let [_, reach, period] = corners[0].along_px;
        let line = |x, y| spans::Line {
            half: half.ramp(x, y),
            across: across.ramp(x, y),
            turns: turns.ramp(x, y),
            reach,
            period,
        };
        match one_colour(colours) {
            Some(colour) => triangle.rows(|y, xs| {
                let line = line(xs.start, y);
                self.row(y, xs, |pixels, first| spans::stroke(pixels, first, &line, colour));
            }),
            None => {
                let channels = channels(colours).map(|channel| slopes.plane(channel));
                triangle.rows(|y, xs| {
                    let line = line(xs.start, y);
                    let colour = channels.map(|channel| channel.ramp(xs.start, y));
                    self.row(y, xs, |pixels, first| {
                        spans::stroke_ramped(pixels, first, &line, colour);
                    });
                });
            }
        }
    }

    /// `fill` in `shaders/panels.wgsl`.
    fn fill(&mut self, at: Placement<'_>, corners: [&Vertex; 3]) {
        if let Some(triangle) = at.triangle(corners.map(|corner| corner.pos.into())) {
            self.blend(&triangle, corners.map(|corner| corner.color));
        }
    }

    /// `textured` in `shaders/panels.wgsl`.
    fn textured(&mut self, at: Placement<'_>, corners: [&Vertex; 3], texture: &ColorImage) {
        let is_plain = corners.iter().all(|corner| corner.uv == WHITE_UV);
        if is_plain && texture.pixels.first() == Some(&Color32::WHITE) {
            return self.fill(at, corners);
        }
        let Some(triangle) = at.triangle(corners.map(|corner| corner.pos.into())) else { return };
        let [width, height] = texture.size.map(|side| side as f32);
        let slopes = triangle.slopes();
        let u = slopes.plane(corners.map(|corner| corner.uv.x * width));
        let v = slopes.plane(corners.map(|corner| corner.uv.y * height));
        let colours = channels(corners.map(|corner| corner.color));
        let channels = colours.map(|channel| slopes.plane(channel));
        triangle.rows(|y, xs| {
            let x = xs.start;
            let texels = [u, v].map(|plane| plane.ramp(x, y));
            let colour = channels.map(|channel| channel.ramp(x, y));
            self.row(y, xs, |pixels, first| {
                spans::textured(pixels, first, texture, texels, colour);
            });
        });
    }

    /// Blends a triangle of full cover.
    fn blend(&mut self, triangle: &Triangle, colours: [Color32; 3]) {
        match one_colour(colours) {
            Some(colour) => triangle.rows(|y, xs| {
                self.row(y, xs, |pixels, _| spans::blend(pixels, colour));
            }),
            None => {
                let slopes = triangle.slopes();
                let channels = channels(colours).map(|channel| slopes.plane(channel));
                triangle.rows(|y, xs| {
                    let colour = channels.map(|channel| channel.ramp(xs.start, y));
                    self.row(y, xs, |pixels, first| spans::blend_ramped(pixels, first, colour));
                });
            }
        }
    }
}

/// Those of the triangles, which have these numbers, that may cover a tile that has changed; all without tiles.
fn changed<C>(
    tiles: Option<&Tiles>,
    numbers: Range<usize>,
    triangles: impl Iterator<Item = C>,
) -> impl Iterator<Item = C> {
    let numbered = numbers.zip(triangles);
    let drawn = numbered.filter(move |(n, _)| tiles.is_none_or(|tiles| tiles.is_changed(*n)));
    drawn.map(|(_, corners)| corners)
}

/// The part of a scissor rectangle between two rows of a frame of this width, if any.
fn window(scissor_px: [u32; 4], frame_width: i32, [first, end]: [i32; 2]) -> Option<Window> {
    let [left, top, width, height] = scissor_px.map(|side| side as i32);
    let right = (left + width).min(frame_width);
    let window = Window { left, top: top.max(first), right, bottom: (top + height).min(end) };
    (window.left < window.right && window.top < window.bottom).then_some(window)
}

/// Where the triangles of a draw may lie, and which pixels they may change.
#[derive(Clone, Copy)]
struct Placement<'d> {
    window: Window,
    transform: &'d ScreenTransform,
}

impl Placement<'_> {
    /// The triangle with these corners in points, if it covers any row.
    fn triangle(self, corners: [[f32; 2]; 3]) -> Option<Triangle> {
        Triangle::new(corners.map(|corner| self.transform.px(corner)), self.window)
    }
}

fn one_colour([a, b, c]: [Color32; 3]) -> Option<Pixel> {
    (a == b && b == c).then(|| a.to_array())
}

/// Red, green, blue and alpha of the corners, from 0 to 255.
fn channels(colours: [Color32; 3]) -> [[f32; 3]; 4] {
    [0, 1, 2, 3].map(|channel| colours.map(|colour| f32::from(colour[channel])))
}

/// The vector instructions by which egui fills the outlines of letters on this machine.
///
/// Those that round once after a product and a sum give a pixel of a letter another level than those that round
/// twice: one pixel in some frames. All else in a frame is the same on every machine.
pub fn letter_instructions() -> &'static str {
    match Level::new() {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx2(_) => "avx2",
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => "neon",
        _ => "none",
    }
}

#[cfg(test)]
mod tests;
