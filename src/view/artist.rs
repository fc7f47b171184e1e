//! Frames without a window: the same renderer, on a texture of our own. Captures, screenshots and tests
//! draw so.

use super::{Figure, FrameRenderer, Gpu, GpuError, Offscreen, Panels, Readback, ReadbackError};
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

    /// The same artist with or without panels, which it draws at first.
    pub fn with_panels(self, shown: Panels) -> Self {
        Self { renderer: self.renderer.with_panels(shown), ..self }
    }

    /// Whether panels are drawn.
    pub fn panels(&self) -> Panels {
        self.renderer.panels()
    }

    /// Name, backend and driver of the adapter that draws.
    pub fn adapter(&self) -> &wgpu::AdapterInfo {
        &self.gpu.info
    }

    /// Width and height of the frames, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.canvas.size_px
    }

    /// Replaces `rgba` by the frame's pixels, top row first. Nothing may be in flight.
    ///
    /// # Errors
    /// A [`ReadbackError`] where the device does not give the frame back.
    pub fn draw(&mut self, lab: &Lab, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        self.submit(lab)?;
        self.collect(rgba)
    }

    /// Sets the device to draw a frame, and does not wait for it.
    ///
    /// # Errors
    /// A [`ReadbackError`] where the device is lost.
    pub fn submit(&mut self, lab: &Lab) -> Result<(), ReadbackError> {
        let Self { gpu, renderer, canvas, readback, scale } = self;
        let input = egui::RawInput { time: Some(lab.race().t()), ..Default::default() };
        // Nobody is there to click, so there are no commands to carry out.
        let (_, output) = renderer.draw(gpu, &canvas.view, canvas.size_px, *scale, input, lab);
        readback.begin(gpu, output.drawing, &canvas.texture)
    }

    /// How many frames are submitted and not collected.
    pub fn in_flight(&self) -> usize {
        self.readback.pending()
    }

    /// Waits for the first frame in flight, and replaces `rgba` by its pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] where the device does not give the frame back.
    ///
    /// # Panics
    /// If no frame is in flight.
    pub fn collect(&mut self, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        self.readback.finish(&self.gpu, rgba)
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
        let drawing = renderer.draw_figure(gpu, &canvas.view, canvas.size_px, *scale, figure);
        readback.read(gpu, drawing, &canvas.texture, rgba)
    }
}
