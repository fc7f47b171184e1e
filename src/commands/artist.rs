//! Frames without a window: the same renderer, on a texture of our own.

use crate::lab::Lab;
use crate::view::{
    AdapterPreference, FrameRenderer, Gpu, GpuError, Offscreen, Readback, ReadbackError,
};

/// Draws a lab into memory.
pub(super) struct Artist {
    gpu: Gpu,
    renderer: FrameRenderer,
    canvas: Offscreen,
    readback: Readback,
    /// Pixels to a point.
    scale: f32,
}

impl Artist {
    pub(super) fn new(size_px: [u32; 2], scale: f32) -> Result<Self, GpuError> {
        let gpu = Gpu::headless(AdapterPreference::Any)?;
        let canvas = Offscreen::new(&gpu, size_px)?;
        let renderer = FrameRenderer::new(&gpu, Offscreen::FORMAT);
        log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
        Ok(Self { gpu, renderer, canvas, readback: Readback::default(), scale })
    }

    /// Replaces `rgba` by the frame's pixels, top row first.
    pub(super) fn draw(&mut self, lab: &Lab, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        let Self { gpu, renderer, canvas, readback, scale } = self;
        let input = egui::RawInput { time: Some(lab.race().t()), ..Default::default() };
        // Nobody is there to click, so there are no commands to carry out.
        let _ = renderer.draw(gpu, &canvas.view, canvas.size_px, *scale, input, lab);
        readback.read(gpu, &canvas.texture, rgba)
    }
}
