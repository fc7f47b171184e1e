//! Textures, and passes that draw on them.

use super::gpu::Gpu;

/// A texture of one level, its contents undefined.
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

/// What a pass begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// A black target.
    Black,
    /// What the target holds.
    AsItIs,
}

/// A pass that draws on a target.
pub(super) fn pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    target: &wgpu::TextureView,
    start: Start,
) -> wgpu::RenderPass<'e> {
    let load = match start {
        Start::Black => wgpu::LoadOp::Clear(wgpu::Color::BLACK),
        Start::AsItIs => wgpu::LoadOp::Load,
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
