//! Frames without a window: the same renderer, on a texture of our own. Captures, screenshots and tests
//! draw so.

use super::{Figure, FrameRenderer, Gpu, GpuError, Offscreen, Readback, ReadbackError};
use crate::lab::Lab;

/// Draws a lab into memory.
pub struct Artist {
    gpu: Gpu,
    renderer: FrameRenderer,
    canvas: Offscreen,
    readback: Readback,
    scale: f32,
}

impl Artist {
    /// Draws with `gpu` frames of `size_px` pixels, `scale` of them to a point.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::Empty`] or [`GpuError::OutOfMemory`].
    pub fn new(gpu: Gpu, size_px: [u32; 2], scale: f32) -> Result<Self, GpuError> {
        let canvas = Offscreen::new(&gpu, size_px)?;
        let renderer = FrameRenderer::new(&gpu, Offscreen::FORMAT);
        Ok(Self { gpu, renderer, canvas, readback: Readback::default(), scale })
    }

    /// Width and height of the frames, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.canvas.size_px
    }

    /// Replaces `rgba` by the frame's pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] where the device does not give the frame back.
    pub fn draw(&mut self, lab: &Lab, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        let Self { gpu, renderer, canvas, readback, scale } = self;
        let input = egui::RawInput { time: Some(lab.race().t()), ..Default::default() };
        // Nobody is there to click, so there are no commands to carry out.
        let _ = renderer.draw(gpu, &canvas.view, canvas.size_px, *scale, input, lab);
        readback.read(gpu, &canvas.texture, rgba)
    }

    /// Replaces `rgba` by the pixels of a diagram, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] where the device does not give the picture back.
    pub fn draw_figure(
        &mut self,
        figure: &Figure,
        rgba: &mut Vec<u8>,
    ) -> Result<(), ReadbackError> {
        let Self { gpu, renderer, canvas, readback, scale } = self;
        renderer.draw_figure(gpu, &canvas.view, canvas.size_px, *scale, figure);
        readback.read(gpu, &canvas.texture, rgba)
    }
}
