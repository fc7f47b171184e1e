//! The stage: a picture's seas, then its strokes, in their place on the target.

use bytemuck::{Pod, Zeroable};

use super::frame::Stage;
use super::gpu::Gpu;
use super::sea::SeaPipeline;
use super::strokes::StrokePipeline;

/// `Stage` in `shaders/stage.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct StageUniform {
    target_px: [f32; 2],
    origin_px: [f32; 2],
    px_per_point: f32,
    padding: [f32; 3],
}

/// Draws the part of a picture that is not text.
#[derive(Debug)]
pub(super) struct StageRenderer {
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    seas: SeaPipeline,
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
        let [left, right] = [low_px.x, high_px.x].map(|x| (x.max(0.0) as u32).min(size_px[0]));
        let [top, bottom] = [low_px.y, high_px.y].map(|y| (y.max(0.0) as u32).min(size_px[1]));
        self.scissor_px = [left, top, right.saturating_sub(left), bottom.saturating_sub(top)];
        self.seas.upload(gpu, &stage.picture.seas);
        self.strokes.upload(gpu, &stage.picture.strokes);
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
        self.strokes.paint(pass);
    }
}

/// A pipeline of instanced quads over `shaders/stage.wgsl`, blending the premultiplied colours of its
/// fragment function. Named by label, shader and that function.
pub(super) fn quad_pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    [label, shader, fragment]: [&str; 3],
    instance: wgpu::VertexBufferLayout<'_>,
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
            buffers: &[Some(instance)],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
