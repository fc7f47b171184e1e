//! Frames without a window, for captures, screenshots and tests.

use std::mem;

use super::cpu_executor::Textures;
use super::gpu_executor::new_texture;
use super::readback::Readback;
use super::{
    CpuExecutor, Drawing, Figure, FrameRenderer, Gpu, GpuExecutor, Panels, Rasterizer,
    ReadbackError,
};
use crate::studio::Studio;

/// Longest side of a frame that the processor draws, in pixels. Frames are far larger than this only by mistake.
const MAX_SIDE_PX: u32 = 16_384;

/// Why a frame of the requested size cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameSizeError {
    /// A side exceeds the limit.
    #[error(
        "frame size {}x{} is beyond the limit of {limit}; give at most {limit}x{limit}",
        size_px[0], size_px[1]
    )]
    TooLarge {
        /// Requested width and height, in pixels.
        size_px: [u32; 2],
        /// Longest possible side, in pixels.
        limit: u32,
    },
    /// The frame has no pixels.
    #[error("frame size {}x{} has no pixels; give at least 1x1", size_px[0], size_px[1])]
    Empty {
        /// Requested width and height, in pixels.
        size_px: [u32; 2],
    },
    /// The frame is within the limit but not within the memory.
    #[error("no memory for a frame of {}x{}; give a smaller size", size_px[0], size_px[1])]
    OutOfMemory {
        /// Requested width and height, in pixels.
        size_px: [u32; 2],
    },
}

impl FrameSizeError {
    /// Checks that both sides are from 1 to `limit`.
    fn check(size_px: [u32; 2], limit: u32) -> Result<(), Self> {
        if size_px.contains(&0) {
            Err(Self::Empty { size_px })
        } else if size_px.iter().any(|&side| side > limit) {
            Err(Self::TooLarge { size_px, limit })
        } else {
            Ok(())
        }
    }
}

/// A texture to draw on and to read back.
pub(super) struct Offscreen {
    pub(super) texture: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
}

impl Offscreen {
    /// Creates a texture of `size_px` with undefined contents.
    ///
    /// # Errors
    /// A [`FrameSizeError`].
    pub(super) fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self, FrameSizeError> {
        FrameSizeError::check(size_px, gpu.max_texture_side_px)?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST;
        let texture = new_texture(gpu, "offscreen", size_px, Gpu::OFFSCREEN_FORMAT, usage);
        if pollster::block_on(scope.pop()).is_some() {
            return Err(FrameSizeError::OutOfMemory { size_px });
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { texture, view })
    }
}

/// Draws a studio into memory.
pub struct OffscreenRenderer {
    renderer: FrameRenderer,
    size_px: [u32; 2],
    scale: f32,
    drawn_by: DrawnBy,
}

enum DrawnBy {
    Processor(CpuExecutor),
    Device(Box<OnDevice>),
}

struct OnDevice {
    gpu: Gpu,
    executor: GpuExecutor,
    canvas: Offscreen,
    readback: Readback,
}

/// A frame of which at most the pixels are still to be calculated. Any thread can do that.
#[must_use]
pub struct PreparedFrame(Prepared);

enum Prepared {
    Drawing(Box<Drawing>, Textures),
    Rows(Vec<u8>),
}

impl PreparedFrame {
    /// Whether each pixel, in rows from the top, lies in the rectangle of a letter. `None` if a device has drawn the
    /// frame.
    pub fn has_letters(&self) -> Option<Vec<bool>> {
        match &self.0 {
            Prepared::Drawing(drawing, _) => Some(drawing.has_letters()),
            Prepared::Rows(_) => None,
        }
    }

    /// Replaces `rgba` by the frame's pixels, top row first. Call it once.
    pub fn finish(&mut self, rasterizer: &mut Rasterizer, rgba: &mut Vec<u8>) {
        match &mut self.0 {
            Prepared::Drawing(drawing, textures) => rasterizer.draw(drawing, textures, rgba),
            Prepared::Rows(rows) => mem::swap(rows, rgba),
        }
    }
}

impl OffscreenRenderer {
    /// Creates a renderer for frames of `size_px` pixels, with `scale` pixels per point. The processor draws them.
    ///
    /// # Errors
    /// A [`FrameSizeError`].
    pub fn new(size_px: [u32; 2], scale: f32) -> Result<Self, FrameSizeError> {
        FrameSizeError::check(size_px, MAX_SIDE_PX)?;
        Ok(Self {
            renderer: FrameRenderer::new(CpuExecutor::MAX_TEXTURE_SIDE_PX),
            size_px,
            scale,
            drawn_by: DrawnBy::Processor(CpuExecutor::on_all_cores()),
        })
    }

    /// The same with a graphics device, which draws the frames.
    ///
    /// # Errors
    /// A [`FrameSizeError`].
    pub fn on_gpu(gpu: Gpu, size_px: [u32; 2], scale: f32) -> Result<Self, FrameSizeError> {
        let renderer = FrameRenderer::new(gpu.max_texture_side_px);
        let device = OnDevice {
            executor: GpuExecutor::new(&gpu),
            canvas: Offscreen::new(&gpu, size_px)?,
            readback: Readback::default(),
            gpu,
        };
        Ok(Self { renderer, size_px, scale, drawn_by: DrawnBy::Device(Box::new(device)) })
    }

    /// An empty buffer with room for a frame. A buffer that grows without memory would end the process.
    ///
    /// # Errors
    /// [`FrameSizeError::OutOfMemory`].
    pub fn buffer(&self) -> Result<Vec<u8>, FrameSizeError> {
        let size_px = self.size_px;
        let [width, height] = size_px.map(|side| side as usize);
        let mut buffer = Vec::new();
        let reserved = buffer.try_reserve_exact(4 * width * height);
        reserved.map(|()| buffer).map_err(|_| FrameSizeError::OutOfMemory { size_px })
    }

    /// Sets which panels to draw. The default is [`Panels::Shown`].
    pub fn with_panels(self, shown: Panels) -> Self {
        Self { renderer: self.renderer.with_panels(shown), ..self }
    }

    /// The panels that frames show.
    pub fn panels(&self) -> Panels {
        self.renderer.panels()
    }

    /// Name, backend and driver of the adapter; `None` if the processor draws.
    pub fn adapter(&self) -> Option<&wgpu::AdapterInfo> {
        match &self.drawn_by {
            DrawnBy::Processor(_) => None,
            DrawnBy::Device(device) => Some(&device.gpu.info),
        }
    }

    /// Width and height of the frames, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// Draws a frame and replaces `rgba` by its pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] if a device does not return the frame. The processor never fails.
    pub fn draw(&mut self, studio: &Studio, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        let drawing = self.drawing(studio);
        self.execute(drawing, rgba)
    }

    /// Draws a diagram and replaces `rgba` by its pixels, top row first.
    ///
    /// # Errors
    /// A [`ReadbackError`] if a device does not return the picture. The processor never fails.
    pub fn draw_figure(
        &mut self,
        figure: &Figure,
        rgba: &mut Vec<u8>,
    ) -> Result<(), ReadbackError> {
        let drawing = self.renderer.draw_figure(self.size_px, self.scale, figure);
        self.execute(drawing, rgba)
    }

    /// Lays out a frame, so that another thread can calculate its pixels. A device draws it at once.
    ///
    /// # Errors
    /// A [`ReadbackError`] if a device does not return the frame. The processor never fails.
    pub fn prepare(&mut self, studio: &Studio) -> Result<PreparedFrame, ReadbackError> {
        let drawing = self.drawing(studio);
        Ok(PreparedFrame(match &mut self.drawn_by {
            DrawnBy::Processor(executor) => {
                let present = executor.textures.update(&drawing, Textures::clone);
                Prepared::Drawing(Box::new(drawing), present)
            }
            DrawnBy::Device(device) => {
                let mut rows = Vec::new();
                device.execute(&drawing, &mut rows)?;
                Prepared::Rows(rows)
            }
        }))
    }

    fn drawing(&mut self, studio: &Studio) -> Drawing {
        let input = egui::RawInput { time: Some(studio.race().t()), ..Default::default() };
        // Without a pointer, panels issue no commands.
        let (_, output) = self.renderer.draw(self.size_px, self.scale, input, studio);
        output.drawing
    }

    fn execute(&mut self, drawing: Drawing, rgba: &mut Vec<u8>) -> Result<(), ReadbackError> {
        match &mut self.drawn_by {
            DrawnBy::Processor(executor) => {
                executor.execute(&drawing, rgba);
                Ok(())
            }
            DrawnBy::Device(device) => device.execute(&drawing, rgba),
        }
    }
}

impl OnDevice {
    fn execute(&mut self, drawing: &Drawing, rows: &mut Vec<u8>) -> Result<(), ReadbackError> {
        let commands = self.executor.encode(&self.gpu, drawing, &self.canvas.view);
        self.readback.read(&self.gpu, commands, &self.canvas.texture, rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_beyond_the_limit_or_without_pixels_are_refused() {
        let error = |size_px| OffscreenRenderer::new(size_px, 1.0).err().unwrap().to_string();
        assert_eq!(
            error([16_385, 720]),
            "frame size 16385x720 is beyond the limit of 16384; give at most 16384x16384"
        );
        assert_eq!(error([1280, 0]), "frame size 1280x0 has no pixels; give at least 1x1");
        assert!(OffscreenRenderer::new([16_384, 1], 1.0).is_ok());
    }
}
