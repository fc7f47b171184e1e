//! Draws egui's meshes.
//!
//! `egui_wgpu` could draw them too. But its version 0.37 looks up one texel for each pixel, and blends every pixel of
//! a panel. A frame of a race with panels at 1280x720 took a software adapter three times as long: 87 ms of its
//! processors' time instead of 27. Here large opaque triangles are stored without blending or lookup.

use std::collections::HashMap;
use std::ops::Range;

use egui::epaint::{self, Mesh, Primitive, Vertex, WHITE_UV};
use egui::{ClippedPrimitive, ImageData, TextureId};

use super::gpu::Gpu;
use super::mesh_buffer::MeshBuffer;
use super::screen_transform::{ScreenBindGroup, ScreenTransform, pipeline};
use super::strokes::{StrokeMesh, StrokePipeline};
use super::textures::texture;

const SHADER: &str = concat!(
    include_str!("../../shaders/screen_transform.wgsl"),
    include_str!("../../shaders/panels.wgsl")
);

const ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];

/// Work for a pixel of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DrawKind {
    /// Storing only: the triangle is opaque, in one colour, and large.
    OpaqueFill,
    /// Looking up a texel and blending it.
    Textured,
}

/// Smaller fills, in square pixels, do not merit a separate draw.
const MIN_FILL_PX: f32 = 4096.0;

#[derive(Debug)]
struct Draw {
    /// Left, top, width and height on the target.
    scissor_px: [u32; 4],
    what: Drawn,
}

#[derive(Debug)]
enum Drawn {
    Triangles { kind: DrawKind, texture: TextureId, indices: Range<u32> },
    Strokes(Range<u32>),
}

/// Draws egui's meshes on targets of one format.
#[derive(Debug)]
pub(super) struct MeshRenderer {
    /// One for each [`DrawKind`], in its order.
    pipelines: [wgpu::RenderPipeline; 2],
    atlas_layout: wgpu::BindGroupLayout,
    atlases: HashMap<TextureId, (wgpu::Texture, wgpu::BindGroup)>,
    screen: ScreenBindGroup,
    triangles: MeshBuffer<Vertex>,
    strokes: StrokePipeline,
    draws: Vec<Draw>,
}

impl MeshRenderer {
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let screen = ScreenBindGroup::new(gpu);
        let atlas_layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("panels"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("panels"),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let over_atlas = layout(&[Some(&screen.layout), Some(&atlas_layout)]);
        let pipelines =
            [("fill", None), ("textured", Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING))];
        let pipelines = pipelines.map(|(fragment, blend)| {
            let names = ["panels", SHADER, fragment];
            pipeline::<Vertex>(gpu, &over_atlas, format, names, &ATTRIBUTES, blend)
        });
        Self {
            pipelines,
            atlas_layout,
            atlases: HashMap::new(),
            strokes: StrokePipeline::new(gpu, &layout(&[Some(&screen.layout)]), format),
            screen,
            triangles: MeshBuffer::new(gpu, "panels"),
            draws: Vec::new(),
        }
    }

    /// Stores a new texture, or a changed part of an old one.
    pub(super) fn set_texture(&mut self, gpu: &Gpu, id: TextureId, delta: &epaint::ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size.map(|side| side as u32);
        if delta.pos.is_none() {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
            let format = wgpu::TextureFormat::Rgba8Unorm;
            let texture = texture(gpu, "panels", [width, height], format, usage);
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
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    pub(super) fn free_texture(&mut self, id: TextureId) {
        self.atlases.remove(&id);
    }

    /// Uploads the meshes for the next [`Self::paint`] on a target of this size.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        primitives: &[ClippedPrimitive],
        size_px: [u32; 2],
        px_per_point: f32,
    ) {
        self.triangles.clear();
        self.strokes.clear();
        self.draws.clear();
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let scissor_px = scissor(*clip_rect, size_px, px_per_point);
            if scissor_px[2] > 0 && scissor_px[3] > 0 {
                self.add(primitive, scissor_px, px_per_point);
            }
        }
        let [width, height] = size_px.map(|side| side as f32);
        let edges_px = [0.0, 0.0, width, height];
        self.screen
            .write(gpu, &ScreenTransform { size_px, origin_px: [0.0; 2], px_per_point, edges_px });
        self.triangles.upload(gpu);
        self.strokes.upload(gpu);
    }

    /// Adds the draws of a visible primitive.
    fn add(&mut self, primitive: &Primitive, scissor_px: [u32; 4], px_per_point: f32) {
        match primitive {
            Primitive::Mesh(mesh) => {
                let first_vertex = self.triangles.add_vertices(&mesh.vertices);
                let triangles = mesh.indices.as_chunks().0;
                let kinds =
                    triangles.iter().map(|it: &[u32; 3]| (it, kind(mesh, it, px_per_point)));
                let kinds: Vec<_> = kinds.collect();
                for run in kinds.chunk_by(|a, b| a.1 == b.1) {
                    let corners = run.iter().flat_map(|(corners, _)| **corners);
                    let indices = self.triangles.add_indices(first_vertex, corners);
                    let (kind, texture) = (run[0].1, mesh.texture_id);
                    let what = Drawn::Triangles { kind, texture, indices };
                    self.draws.push(Draw { scissor_px, what });
                }
            }
            // Only the curves of plots are callbacks of ours.
            Primitive::Callback(callback) => {
                if let Some(mesh) = callback.callback.downcast_ref::<StrokeMesh>() {
                    let what = Drawn::Strokes(self.strokes.add(mesh));
                    self.draws.push(Draw { scissor_px, what });
                }
            }
        }
    }

    /// Draws the prepared meshes.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, &self.screen.group, &[]);
        let mut set = None;
        for Draw { scissor_px: [left, top, width, height], what } in &self.draws {
            pass.set_scissor_rect(*left, *top, *width, *height);
            match what {
                Drawn::Triangles { kind, texture, indices } => {
                    let Some((_, bind_group)) = self.atlases.get(texture) else { continue };
                    if set.replace((kind, texture)) != Some((kind, texture)) {
                        pass.set_pipeline(&self.pipelines[*kind as usize]);
                        pass.set_bind_group(1, bind_group, &[]);
                        self.triangles.bind(pass);
                    }
                    pass.draw_indexed(indices.clone(), 0, 0..1);
                }
                Drawn::Strokes(indices) => {
                    set = None;
                    self.strokes.draw(pass, indices.clone());
                }
            }
        }
    }
}

fn kind(mesh: &Mesh, corners: &[u32; 3], px_per_point: f32) -> DrawKind {
    let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
    let (ab, ac) = (px_per_point * (b.pos - a.pos), px_per_point * (c.pos - a.pos));
    let is_large = (ab.x * ac.y - ab.y * ac.x).abs() / 2.0 >= MIN_FILL_PX;
    let is_plain = [a, b, c].iter().all(|v| v.uv == WHITE_UV && v.color == a.color);
    if is_large && is_plain && a.color.is_opaque() {
        DrawKind::OpaqueFill
    } else {
        DrawKind::Textured
    }
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
        assert_eq!(kinds(50.0, grey, |_| ()), [DrawKind::OpaqueFill; 2]);
        assert_eq!(kinds(40.0, grey, |_| ()), [DrawKind::Textured; 2]);
        assert_eq!(kinds(50.0, grey.gamma_multiply(0.9), |_| ()), [DrawKind::Textured; 2]);
        let one_white = |mesh: &mut Mesh| mesh.vertices[1].color = Color32::WHITE;
        assert_eq!(kinds(50.0, grey, one_white), [DrawKind::Textured; 2]);
        let text = |mesh: &mut Mesh| mesh.vertices[1].uv = pos2(0.5, 0.5);
        assert_eq!(kinds(50.0, grey, text), [DrawKind::Textured; 2]);
    }
}
