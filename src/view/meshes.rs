//! What egui lays out, as pixels.
//!
//! `egui_wgpu` could draw it too, but filters four texels for each pixel of a panel in a way that costs
//! a software adapter more than everything else in a frame. Here a texel is looked up.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use egui::epaint::{self, Mesh, Primitive, WHITE_UV};
use egui::{ClippedPrimitive, ImageData, TextureId};

use super::curves::LINE;
use super::gpu::Gpu;
use super::triangles::Triangles;

const SHADER: &str = include_str!("../../shaders/panels.wgsl");

/// `Frame` in `shaders/panels.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct FrameUniform {
    size_points: [f32; 2],
    padding: [f32; 2],
}

/// What a pixel of a triangle takes, from the least to the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Opaque, in one colour, and large: nothing but storing it.
    Fill,
    /// Part of a line: its coverage.
    Line,
    /// A texel.
    Textured,
}

/// Fills smaller than this, in square pixels, are not worth a draw of their own.
const LEAST_FILL_PX: f32 = 4096.0;

/// Some triangles of one texture.
#[derive(Debug)]
struct Draw {
    kind: Kind,
    texture: TextureId,
    /// Left, top, width and height on the target.
    scissor_px: [u32; 4],
    indices: std::ops::Range<u32>,
}

/// Draws egui's meshes on targets of one format.
#[derive(Debug)]
pub(super) struct MeshRenderer {
    /// One for each [`Kind`], in its order.
    pipelines: [wgpu::RenderPipeline; 3],
    atlas_layout: wgpu::BindGroupLayout,
    atlases: HashMap<TextureId, (wgpu::Texture, wgpu::BindGroup)>,
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    triangles: Triangles,
    draws: Vec<Draw>,
}

impl MeshRenderer {
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let layout = |visibility, ty| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("panels"),
                entries: &[wgpu::BindGroupLayoutEntry { binding: 0, visibility, ty, count: None }],
            })
        };
        let frame_layout = layout(
            wgpu::ShaderStages::VERTEX,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
        );
        let atlas_layout = layout(
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
        );
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("panels"),
            size: size_of::<FrameUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("panels"),
            layout: &frame_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        Self {
            pipelines: pipelines(gpu, format, [&frame_layout, &atlas_layout]),
            atlas_layout,
            atlases: HashMap::new(),
            uniform,
            bind_group,
            triangles: Triangles::new(gpu, "panels"),
            draws: Vec::new(),
        }
    }

    /// Takes over a new texture, or a changed part of an old one.
    pub(super) fn set_texture(&mut self, gpu: &Gpu, id: TextureId, delta: &epaint::ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size.map(|side| side as u32);
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        if delta.pos.is_none() {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("panels"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("panels"),
                layout: &self.atlas_layout,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&view),
                }],
            });
            self.atlases.insert(id, (texture, bind_group));
        }
        let Some((texture, _)) = self.atlases.get(&id) else { return };
        let [x, y] = delta.pos.unwrap_or_default().map(|side| side as u32);
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x, y, z: 0 },
                ..texture.as_image_copy()
            },
            bytemuck::cast_slice(&image.pixels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * width),
                rows_per_image: None,
            },
            size,
        );
    }

    pub(super) fn free_texture(&mut self, id: TextureId) {
        self.atlases.remove(&id);
    }

    /// Uploads what the next [`Self::paint`] is to draw on a target of `size_px`.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        primitives: &[ClippedPrimitive],
        size_px: [u32; 2],
        px_per_point: f32,
    ) {
        self.draws.clear();
        self.triangles.clear();
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            // Nothing here asks egui for a callback.
            let Primitive::Mesh(mesh) = primitive else { continue };
            let scissor_px = scissor(*clip_rect, size_px, px_per_point);
            if scissor_px[2] == 0 || scissor_px[3] == 0 {
                continue;
            }
            let mut first = self.triangles.add(mesh).start;
            let triangles = mesh.indices.as_chunks::<3>().0;
            let kind = |corners: &[u32; 3]| kind(mesh, corners, px_per_point);
            for run in triangles.chunk_by(|a, b| kind(a) == kind(b)) {
                let indices = first..first + 3 * run.len() as u32;
                first = indices.end;
                let texture = mesh.texture_id;
                self.draws.push(Draw { kind: kind(&run[0]), texture, scissor_px, indices });
            }
        }
        let size_points = size_px.map(|side| side as f32 / px_per_point);
        let uniform = FrameUniform { size_points, padding: [0.0; 2] };
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.triangles.upload(gpu);
    }

    /// Draws what was prepared.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, &self.bind_group, &[]);
        self.triangles.bind(pass);
        for Draw { kind, texture, scissor_px: [left, top, width, height], indices } in &self.draws {
            let Some((_, bind_group)) = self.atlases.get(texture) else { continue };
            pass.set_pipeline(&self.pipelines[*kind as usize]);
            pass.set_bind_group(1, bind_group, &[]);
            pass.set_scissor_rect(*left, *top, *width, *height);
            pass.draw_indexed(indices.clone(), 0, 0..1);
        }
    }
}

fn kind(mesh: &Mesh, corners: &[u32; 3], px_per_point: f32) -> Kind {
    let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
    if a.uv.x >= LINE {
        return Kind::Line;
    }
    let (ab, ac) = (px_per_point * (b.pos - a.pos), px_per_point * (c.pos - a.pos));
    let is_large = (ab.x * ac.y - ab.y * ac.x).abs() / 2.0 >= LEAST_FILL_PX;
    let is_plain = [a, b, c].iter().all(|v| v.uv == WHITE_UV && v.color == a.color);
    if is_large && is_plain && a.color.is_opaque() { Kind::Fill } else { Kind::Textured }
}

fn pipelines(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    layouts: [&wgpu::BindGroupLayout; 2],
) -> [wgpu::RenderPipeline; 3] {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("panels"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("panels"),
        bind_group_layouts: &layouts.map(Some),
        immediate_size: 0,
    });
    [Kind::Fill, Kind::Line, Kind::Textured].map(|kind| {
        let (fragment, blend) = match kind {
            Kind::Fill => ("fill", None),
            Kind::Line => ("line", Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING)),
            Kind::Textured => ("textured", Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING)),
        };
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("panels"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(Triangles::LAYOUT)],
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
    })
}

/// The pixels of a rectangle in points, within the target: left, top, width and height.
fn scissor(clip: egui::Rect, size_px: [u32; 2], px_per_point: f32) -> [u32; 4] {
    let px = |points: f32, side: usize| ((points * px_per_point).round() as u32).min(size_px[side]);
    let [left, right] = [clip.min.x, clip.max.x].map(|x| px(x, 0));
    let [top, bottom] = [clip.min.y, clip.max.y].map(|y| px(y, 1));
    [left, top, right.saturating_sub(left), bottom.saturating_sub(top)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, Rect, pos2, vec2};

    #[test]
    fn only_large_opaque_triangles_of_one_colour_are_fills() {
        let kinds = |size: f32, colour: Color32, change: fn(&mut Mesh)| {
            let mut mesh = Mesh::default();
            mesh.add_colored_rect(Rect::from_min_size(pos2(3.0, 4.0), vec2(size, size)), colour);
            change(&mut mesh);
            let kinds = mesh.indices.as_chunks::<3>().0.iter().map(|tri| kind(&mesh, tri, 2.0));
            kinds.collect::<Vec<_>>()
        };
        let grey = Color32::from_gray(40);
        assert_eq!(kinds(50.0, grey, |_| ()), [Kind::Fill; 2]);
        assert_eq!(kinds(40.0, grey, |_| ()), [Kind::Textured; 2]);
        assert_eq!(kinds(50.0, grey.gamma_multiply(0.9), |_| ()), [Kind::Textured; 2]);
        let one_white = |mesh: &mut Mesh| mesh.vertices[1].color = Color32::WHITE;
        assert_eq!(kinds(50.0, grey, one_white), [Kind::Textured; 2]);
        let text = |mesh: &mut Mesh| mesh.vertices[1].uv = pos2(0.5, 0.5);
        assert_eq!(kinds(50.0, grey, text), [Kind::Textured; 2]);
        let line = |mesh: &mut Mesh| {
            mesh.vertices.iter_mut().for_each(|vertex| vertex.uv = pos2(LINE + 0.8, 1.8));
        };
        assert_eq!(kinds(50.0, grey, line), [Kind::Line; 2]);
    }
}
