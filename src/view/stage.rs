//! The stage: a picture's seas, then its ribbons and its strokes, in their place on the target.

use bytemuck::{Pod, Zeroable};

use super::frame::Stage;
use super::gpu::Gpu;
use super::ribbons::RibbonPipeline;
use super::sea::SeaPipeline;
use super::strokes::StrokePipeline;
use crate::lab::picture::{FAR, Rect};

/// `Stage` in `shaders/stage.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct StageUniform {
    target_px: [f32; 2],
    origin_px: [f32; 2],
    px_per_point: f32,
    padding: [f32; 3],
}

/// Where the stage lies on the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) origin_px: [f32; 2],
    pub(super) px_per_point: f32,
    /// Left, top, right and bottom of what is to be seen of it.
    edges_px: [f32; 4],
}

/// What clips nothing.
const EVERYWHERE: Rect = Rect { min: [-FAR; 2], max: [FAR; 2] };

impl Place {
    /// Where a point of the stage is, in pixels of the target.
    pub(super) fn px(&self, point: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| self.origin_px[axis] + point[axis] * self.px_per_point)
    }

    /// The left, top, width and height of those pixels whose middle is within `clip`.
    pub(super) fn scissor_px(&self, clip: Rect) -> [u32; 4] {
        let [left, top, right, bottom] = self.edges_px;
        let [low, high] = [clip.min, clip.max].map(|corner| {
            let [x, y] = self.px(corner).map(|at| (at - 0.5).ceil());
            [x.clamp(left, right) as u32, y.clamp(top, bottom) as u32]
        });
        [low[0], low[1], high[0].saturating_sub(low[0]), high[1].saturating_sub(low[1])]
    }
}

/// Draws the part of a picture that is not text.
#[derive(Debug)]
pub(super) struct StageRenderer {
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    seas: SeaPipeline,
    ribbons: RibbonPipeline,
    strokes: StrokePipeline,
    /// Left, top, width and height on the target.
    scissor_px: [u32; 4],
}

impl StageRenderer {
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("stage"),
            size: size_of::<StageUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("stage"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("stage"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("stage"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        Self {
            uniform,
            bind_group,
            seas: SeaPipeline::new(gpu, &layout, format),
            ribbons: RibbonPipeline::new(gpu, &layout, format),
            strokes: StrokePipeline::new(gpu, &layout, format),
            scissor_px: [0; 4],
        }
    }

    /// Uploads what [`Self::paint`] will draw on a target of `size_px`.
    pub(super) fn prepare(&mut self, gpu: &Gpu, stage: &Stage, size_px: [u32; 2], scale: f32) {
        // On whole pixels: what the picture puts on whole points stays sharp.
        let low_px = (stage.rect.min.to_vec2() * scale).round();
        let high_px = (stage.rect.max.to_vec2() * scale).round();
        let uniform = StageUniform {
            target_px: size_px.map(|side| side as f32),
            origin_px: low_px.into(),
            px_per_point: scale,
            padding: [0.0; 3],
        };
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let [left, right] = [low_px.x, high_px.x].map(|x| x.clamp(0.0, size_px[0] as f32));
        let [top, bottom] = [low_px.y, high_px.y].map(|y| y.clamp(0.0, size_px[1] as f32));
        let place = Place {
            origin_px: low_px.into(),
            px_per_point: scale,
            edges_px: [left, top, right.max(left), bottom.max(top)],
        };
        self.scissor_px = place.scissor_px(EVERYWHERE);
        self.seas.upload(gpu, &stage.picture.seas, &place);
        self.ribbons.upload(gpu, &stage.picture.ribbons, &place);
        self.strokes.upload(gpu, &stage.picture.strokes, &place);
    }

    /// Draws what was prepared, and nothing outside the stage.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        let [left, top, width, height] = self.scissor_px;
        if width == 0 || height == 0 {
            return;
        }
        pass.set_scissor_rect(left, top, width, height);
        pass.set_bind_group(0, &self.bind_group, &[]);
        self.seas.paint(pass);
        self.ribbons.paint(pass);
        self.strokes.paint(pass);
    }
}

/// A pipeline of triangles over `shaders/stage.wgsl`, named by label, shader and fragment function, the
/// colours of which are premultiplied.
pub(super) fn quad_pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    [label, shader, fragment]: [&str; 3],
    vertex: wgpu::VertexBufferLayout<'_>,
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
            buffers: &[Some(vertex)],
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
