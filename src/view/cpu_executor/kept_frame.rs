//! A frame whose unchanged parts are kept from drawing to drawing.

use std::num::NonZero;

use super::tiles::Tiles;
use super::{CpuExecutor, Pixel};
use crate::drawing::Drawing;

/// The frames of one renderer, drawn one after the other in the same place.
///
/// Only the parts that differ from the drawing before are drawn. The pixels are those of [`CpuExecutor::execute`].
#[derive(Debug)]
pub struct KeptFrame {
    executor: CpuExecutor,
    tiles: Tiles,
    rows: Vec<u8>,
}

impl KeptFrame {
    /// Creates a frame without pixels that is drawn with this number of threads.
    pub fn new(threads: NonZero<usize>) -> Self {
        Self::of(CpuExecutor::new(threads))
    }

    /// Creates a frame without pixels that is drawn with one thread per core.
    pub fn on_all_cores() -> Self {
        Self::of(CpuExecutor::on_all_cores())
    }

    fn of(executor: CpuExecutor) -> Self {
        Self { executor, tiles: Tiles::default(), rows: Vec::new() }
    }

    /// Replaces the frame by this drawing, the next of its renderer.
    pub fn draw(&mut self, drawing: &Drawing) {
        let Self { executor: CpuExecutor { textures, rasterizer }, tiles, rows } = self;
        textures.update(drawing, |textures| {
            rasterizer.draw_tiles(drawing, textures, rows, Some(tiles));
        });
    }

    /// Width and height, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.tiles.size_px
    }

    /// Red, green, blue and alpha of each pixel, top row first, no padding.
    pub fn pixels(&self) -> &[Pixel] {
        self.rows.as_chunks().0
    }

    /// The rectangles that the last drawing may have changed: left, top, width and height, in pixels.
    pub fn changed(&self) -> impl Iterator<Item = [u32; 4]> {
        self.tiles.rects()
    }
}
