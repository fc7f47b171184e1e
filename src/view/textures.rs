//! Textures, and passes that draw on them.

use super::gpu::Gpu;

/// Creates a texture of one level with undefined contents.
pub(super) fn texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// No copy is kept for a larger target, because it would take as much memory again.
const MAX_PIXELS: u64 = 4096 * 4096;

/// Whether a texture of this format and of the target's size can be copied to the target.
pub(super) fn takes_copies(target: &wgpu::Texture, format: wgpu::TextureFormat) -> bool {
    let pixels = u64::from(target.width()) * u64::from(target.height());
    let is_plain = target.depth_or_array_layers() == 1
        && target.mip_level_count() == 1
        && target.sample_count() == 1;
    let usage = target.usage().contains(wgpu::TextureUsages::COPY_DST);
    usage && is_plain && target.format() == format && pixels <= MAX_PIXELS
}

/// Initial contents of a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PassStart {
    /// A black target.
    Black,
    /// The present contents of the target.
    Keep,
}

/// Begins a pass that draws on a target.
pub(super) fn begin_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    target: &wgpu::TextureView,
    start: PassStart,
) -> wgpu::RenderPass<'e> {
    let load = match start {
        PassStart::Black => wgpu::LoadOp::Clear(wgpu::Color::BLACK),
        PassStart::Keep => wgpu::LoadOp::Load,
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}
