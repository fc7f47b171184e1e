//! A texture of our own to draw on: captures, screenshots, tests.

use super::gpu::{Gpu, GpuError};
use super::textures::texture;

/// A texture that can be drawn on and then read back.
#[derive(Debug)]
pub struct Offscreen {
    /// For [`Readback`](super::Readback).
    pub texture: wgpu::Texture,
    /// For [`FrameRenderer::draw`](super::FrameRenderer::draw).
    pub view: wgpu::TextureView,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

impl Offscreen {
    /// The format of every such texture: gamma space, red first.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    /// A texture of `size_px`, its contents undefined.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::Empty`] or [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self, GpuError> {
        gpu.check_size(size_px)?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST;
        let texture = texture(gpu, "offscreen", size_px, Self::FORMAT, usage);
        if pollster::block_on(scope.pop()).is_some() {
            let [width, height] = size_px;
            return Err(GpuError::OutOfMemory { width, height });
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { texture, view, size_px })
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
