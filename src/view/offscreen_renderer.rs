//! Frames without a window: the frame renderer on its own texture, for captures, screenshots and tests.

use super::gpu_executor::new_texture;
use super::{
    AdapterPreference, Drawing, Figure, FrameRenderer, Gpu, GpuError, GpuExecutor, Panels,
    Readback, ReadbackError,
};
use crate::studio::Studio;

/// A texture to draw on and to read back.
#[derive(Debug)]
pub struct Offscreen {
    /// For [`Readback`](super::Readback).
    pub texture: wgpu::Texture,
    /// For [`GpuExecutor::encode`](super::GpuExecutor::encode).
    pub view: wgpu::TextureView,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

impl Offscreen {
    /// Format of every such texture: gamma space, red first.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    /// Creates a texture of `size_px` with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::Empty`] or [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self, GpuError> {
        gpu.check_size(size_px)?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST;
        let texture = new_texture(gpu, "offscreen", size_px, Self::FORMAT, usage);
        if pollster::block_on(scope.pop()).is_some() {
            let [width, height] = size_px;
            return Err(GpuError::OutOfMemory { width, height });
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { texture, view, size_px })
    }
}

/// Draws a studio into memory.
pub struct OffscreenRenderer {
    gpu: Gpu,
    renderer: FrameRenderer,
    executor: GpuExecutor,
    canvas: Offscreen,
    readback: Readback,
    scale: f32,
}

impl OffscreenRenderer {
    /// Creates a renderer on `gpu` for frames of `size_px` pixels, with `scale` pixels per point.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::Empty`] or [`GpuError::OutOfMemory`].
    pub fn new(gpu: Gpu, size_px: [u32; 2], scale: f32) -> Result<Self, GpuError> {
        let canvas = Offscreen::new(&gpu, size_px)?;
        let renderer = FrameRenderer::new(gpu.max_texture_side_px);
        let executor = GpuExecutor::new(&gpu, Offscreen::FORMAT);
        Ok(Self { gpu, renderer, executor, canvas, readback: Readback::default(), scale })
    }

    /// Like [`OffscreenRenderer::new`], on the best device that needs no display. Blocks until the device is found.
    ///
    /// # Errors
    /// Those of [`Gpu::headless`] and [`OffscreenRenderer::new`].
    pub fn headless(size_px: [u32; 2], scale: f32) -> Result<Self, GpuError> {
        let gpu = pollster::block_on(Gpu::headless(AdapterPreference::Any))?;
        Self::new(gpu, size_px, scale)
    }

    /// Sets which panels to draw. The default is [`Panels::Shown`].
    pub fn with_panels(self, shown: Panels) -> Self {
        Self { renderer: self.renderer.with_panels(shown), ..self }
    }

    /// The panels that frames show.
    pub fn panels(&self) -> Panels {
        self.renderer.panels()
    }

    /// Name, backend and driver of the adapter.
    pub fn adapter(&self) -> &wgpu::AdapterInfo {
        &self.gpu.info
    }

    /// Width and height of the frames, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.canvas.size_px
    }

    /// Draws a frame and replaces `rgba` by its pixels, top row first. No frame may be in flight.
    ///
    /// # Errors
    /// A [`ReadbackError`] if the device does not return the frame.
    pub fn draw(&mut self, studio: &Studio, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        self.submit(studio)?;
        self.collect(rgba)
    }

    /// Submits a frame to the device without waiting for it.
    ///
    /// # Errors
    /// A [`ReadbackError`] if the device is lost.
    pub fn submit(&mut self, studio: &Studio) -> Result<(), ReadbackError> {
        let input = egui::RawInput { time: Some(studio.race().t()), ..Default::default() };
        // Without a pointer, panels issue no commands.
        let (_, output) = self.renderer.draw(self.canvas.size_px, self.scale, input, studio);
        self.execute(&output.drawing)
    }

    /// Number of frames submitted and not yet collected.
    pub fn in_flight(&self) -> usize {
        self.readback.pending()
    }

    /// Waits for the oldest frame in flight and replaces `rgba` by its pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] if the device does not return the frame.
    ///
    /// # Panics
    /// If no frame is in flight.
    pub fn collect(&mut self, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        self.readback.finish(&self.gpu, rgba)
    }

    /// Draws a diagram and replaces `rgba` by its pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] if the device does not return the picture.
    pub fn draw_figure(
        &mut self,
        figure: &Figure,
        rgba: &mut Vec<u8>,
    ) -> Result<(), ReadbackError> {
        let drawing = self.renderer.draw_figure(self.canvas.size_px, self.scale, figure);
        self.execute(&drawing)?;
        self.collect(rgba)
    }

    fn execute(&mut self, drawing: &Drawing) -> Result<(), ReadbackError> {
        let Self { gpu, executor, canvas, readback, .. } = self;
        let commands = executor.encode(gpu, drawing, &canvas.view);
        readback.begin(gpu, commands, &canvas.texture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::gpu_or_skip;

    #[test]
    fn sizes_beyond_the_limit_or_without_pixels_are_refused() {
        let test = "sizes_beyond_the_limit_or_without_pixels_are_refused";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let limit = gpu.max_texture_side_px;
        let error = Offscreen::new(&gpu, [limit + 1, 720]).unwrap_err().to_string();
        let expected = format!(
            "frame size {}x720 is beyond this adapter's limit of {limit}; \
             give at most {limit}x{limit}",
            limit + 1
        );
        assert_eq!(error, expected);
        let error = Offscreen::new(&gpu, [1280, 0]).unwrap_err();
        assert!(matches!(error, GpuError::Empty { width: 1280, height: 0 }), "{error}");
        assert!(Offscreen::new(&gpu, [limit, 1]).is_ok());
    }
}
