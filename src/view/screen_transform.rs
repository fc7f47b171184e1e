//! Mapping of points to the pixels of a target, in Rust and in shaders.

use bytemuck::{Pod, Zeroable};

use super::gpu::Gpu;
use crate::stage::Rect;

/// `ScreenTransform` in `shaders/screen_transform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniform {
    target_px: [f32; 2],
    origin_px: [f32; 2],
    px_per_point: f32,
    padding: [f32; 3],
}

/// Place on the target of some part of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ScreenTransform {
    pub(super) size_px: [u32; 2],
    /// Origin of the part.
    pub(super) origin_px: [f32; 2],
    pub(super) px_per_point: f32,
    /// Left, top, right and bottom of its visible area.
    pub(super) edges_px: [f32; 4],
}

impl ScreenTransform {
    /// Place of a point, in pixels of the target.
    pub(super) fn px(&self, point: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| self.origin_px[axis] + point[axis] * self.px_per_point)
    }

    /// Left, top, width and height of the visible pixels whose middle is within `clip`.
    pub(super) fn scissor_px(&self, clip: Rect) -> [u32; 4] {
        let [left, top, right, bottom] = self.edges_px;
        let [low, high] = [clip.min, clip.max].map(|corner| {
            let [x, y] = self.px(corner).map(|at| (at - 0.5).ceil());
            [x.clamp(left, right) as u32, y.clamp(top, bottom) as u32]
        });
        [low[0], low[1], high[0].saturating_sub(low[0]), high[1].saturating_sub(low[1])]
    }
}

/// Passes a transform to a shader, as its first bind group.
#[derive(Debug)]
pub(super) struct ScreenBindGroup {
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) group: wgpu::BindGroup,
    buffer: wgpu::Buffer,
}

impl ScreenBindGroup {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("place"),
            size: size_of::<Uniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("place"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("place"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Self { layout, group, buffer }
    }

    pub(super) fn write(&self, gpu: &Gpu, place: &ScreenTransform) {
        let uniform = Uniform {
            target_px: place.size_px.map(|side| side as f32),
            origin_px: place.origin_px,
            px_per_point: place.px_per_point,
            padding: [0.0; 3],
        };
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniform));
    }
}

/// A pipeline of triangles with vertices `V` and `shaders/screen_transform.wgsl`. Its names are a label, a shader,
/// and a fragment function that returns premultiplied colours.
pub(super) fn pipeline<V>(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    [label, shader, fragment]: [&str; 3],
    attributes: &[wgpu::VertexAttribute],
    blend: Option<wgpu::BlendState>,
) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<V>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
