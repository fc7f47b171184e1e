//! The pipelines of a [`GpuExecutor`](super::GpuExecutor). They are made with their device, because some drivers
//! make a device and refuse the pipelines.

use bytemuck::{Pod, Zeroable};
use egui::epaint::Vertex;

use super::drawing::StrokeVertex;

const PANELS: &str = concat!(
    include_str!("../../shaders/screen_transform.wgsl"),
    include_str!("../../shaders/panels.wgsl")
);
const STROKES: &str = concat!(
    include_str!("../../shaders/screen_transform.wgsl"),
    include_str!("../../shaders/strokes.wgsl")
);
const SEA: &str = concat!(
    include_str!("../../shaders/screen_transform.wgsl"),
    include_str!("../../shaders/sea.wgsl")
);

const PANEL_ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
const STROKE_ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Float32x3, 3 => Unorm8x4];
const SEA_ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x4, 1 => Unorm8x4, 2 => Unorm8x4];

/// `Part` in `shaders/sea.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct SeaVertex {
    pub(super) rect_px: [f32; 4],
    pub(super) colours: [[u8; 4]; 2],
}

/// The pipelines for targets of one format. A clone is the same pipelines.
#[derive(Clone, Debug)]
pub(super) struct Pipelines {
    pub(super) format: wgpu::TextureFormat,
    pub(super) transform_layout: wgpu::BindGroupLayout,
    pub(super) atlas_layout: wgpu::BindGroupLayout,
    pub(super) fill: wgpu::RenderPipeline,
    pub(super) textured: wgpu::RenderPipeline,
    pub(super) stroke: wgpu::RenderPipeline,
    pub(super) water: wgpu::RenderPipeline,
}

impl Pipelines {
    /// Makes the pipelines for targets of `format`, or returns the first error of the driver.
    pub(super) async fn new(
        device: &wgpu::Device,
        format: wgpu::TextureFormat,
    ) -> Result<Self, wgpu::Error> {
        // A shader that the driver does not compile is an internal error, a format that it does not draw on one of
        // validation.
        let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let made = Self::make(device, format);
        let (validation, internal) = (validation.pop(), internal.pop());
        match internal.await.or(validation.await) {
            Some(error) => Err(error),
            None => Ok(made),
        }
    }

    fn make(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let transform_layout = bind_group_layout(
            device,
            wgpu::ShaderStages::VERTEX,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
        );
        let atlas_layout = bind_group_layout(
            device,
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
        );
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("frame"),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let plain = layout(&[Some(&transform_layout)]);
        let over_atlas = layout(&[Some(&transform_layout), Some(&atlas_layout)]);
        let over = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let panels = |name, blend| {
            let names = [PANELS, name];
            pipeline::<Vertex>(device, &over_atlas, format, names, &PANEL_ATTRIBUTES, blend)
        };
        let stroke = [STROKES, "stroke"];
        let water = [SEA, "water"];
        Self {
            format,
            fill: panels("fill", None),
            textured: panels("textured", over),
            stroke: pipeline::<StrokeVertex>(
                device,
                &plain,
                format,
                stroke,
                &STROKE_ATTRIBUTES,
                over,
            ),
            water: pipeline::<SeaVertex>(device, &plain, format, water, &SEA_ATTRIBUTES, None),
            transform_layout,
            atlas_layout,
        }
    }
}

/// A layout with one binding.
fn bind_group_layout(
    device: &wgpu::Device,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("frame"),
        entries: &[wgpu::BindGroupLayoutEntry { binding: 0, visibility, ty, count: None }],
    })
}

/// A pipeline of triangles with vertices `V`. `names` are a shader and its fragment function, which returns
/// premultiplied colours.
fn pipeline<V>(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    [shader, fragment]: [&str; 2],
    attributes: &[wgpu::VertexAttribute],
    blend: Option<wgpu::BlendState>,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(fragment),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
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
