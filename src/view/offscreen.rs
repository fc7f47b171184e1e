//! A texture of our own to draw on: captures, screenshots, tests.

use super::gpu::{Gpu, GpuError};

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
        let [width, height] = size_px;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("offscreen"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Self::FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        if pollster::block_on(scope.pop()).is_some() {
            return Err(GpuError::OutOfMemory { width, height });
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { texture, view, size_px })
    }

    /// This texture as the target of a pass that begins with `colour`.
    #[cfg(test)]
    pub(super) fn cleared(&self, colour: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: &self.view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(colour),
                store: wgpu::StoreOp::Store,
            },
        }
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
