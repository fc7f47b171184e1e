//! Draws a [`Drawing`] with wgpu.

use std::collections::HashMap;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use egui::epaint::ImageDelta;
use egui::{ImageData, TextureId};

use super::drawing::{Draw, DrawKind, Drawing, Mesh, Place, SeaRect};
use super::gpu::Gpu;
use super::pipelines::{Pipelines, SeaVertex};
use super::screen_transform::ScreenTransform;

/// Initial capacity of a buffer in bytes. It grows by doubling.
const FIRST_CAPACITY: u64 = 1 << 16;

/// `ScreenTransform` in `shaders/screen_transform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniform {
    target_px: [f32; 2],
    origin_px: [f32; 2],
    px_per_point: f32,
    padding: [f32; 3],
}

/// Draws the drawings of one renderer on targets of the device's format.
#[derive(Debug)]
pub struct GpuExecutor {
    pipelines: Pipelines,
    /// Indexed by [`Place`].
    transforms: [(wgpu::Buffer, wgpu::BindGroup); 2],
    atlases: HashMap<TextureId, (wgpu::Texture, wgpu::BindGroup)>,
    triangles: MeshBuffer,
    strokes: MeshBuffer,
    sea: MeshBuffer,
    /// The id of the backdrop, and its pixels.
    backdrop: Option<(u64, wgpu::Texture)>,
}

impl GpuExecutor {
    /// Creates an executor for targets of the device's format.
    pub fn new(gpu: &Gpu) -> Self {
        let pipelines = gpu.pipelines.clone();
        Self {
            transforms: [(); 2].map(|()| uniform(gpu, &pipelines.transform_layout)),
            pipelines,
            atlases: HashMap::new(),
            triangles: MeshBuffer::new(gpu),
            strokes: MeshBuffer::new(gpu),
            sea: MeshBuffer::new(gpu),
            backdrop: None,
        }
    }

    /// Encodes the drawing on the whole of `target`, which must have the drawing's size. `None` on a lost device.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        drawing: &Drawing,
        target: &wgpu::TextureView,
    ) -> Option<wgpu::CommandBuffer> {
        if gpu.is_lost() {
            return None;
        }
        for (id, delta) in &drawing.textures.set {
            self.set_texture(gpu, *id, delta);
        }
        self.upload(gpu, drawing);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let covered = self.copy_backdrop(gpu, &mut encoder, drawing, target.texture());
        let mut pass = begin_pass(&mut encoder, target, covered > 0);
        self.paint(&mut pass, drawing, covered..usize::MAX);
        drop(pass);
        for id in &drawing.textures.freed {
            self.atlases.remove(id);
        }
        Some(encoder.finish())
    }

    /// Copies the backdrop to the target. Returns the number of parts it covers: the sea and its draws.
    fn copy_backdrop(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        drawing: &Drawing,
        target: &wgpu::Texture,
    ) -> usize {
        let Some(backdrop) =
            drawing.backdrop.filter(|_| accepts_copies(target, self.pipelines.format))
        else {
            return 0;
        };
        let covered = 1 + backdrop.draws;
        let kept = self.backdrop.take();
        let of_size = kept.filter(|(_, texture)| texture.size() == target.size());
        let texture = match of_size {
            Some((id, texture)) if id == backdrop.id => texture,
            other => {
                let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
                let texture = other.map(|(_, texture)| texture).unwrap_or_else(|| {
                    new_texture(gpu, "backdrop", drawing.size_px, self.pipelines.format, usage)
                });
                let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
                // Submitted at once: later frames need the backdrop, even if the caller never submits this frame.
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                let mut pass = begin_pass(&mut encoder, &view, false);
                self.paint(&mut pass, drawing, 0..covered);
                drop(pass);
                gpu.queue.submit([encoder.finish()]);
                texture
            }
        };
        let (from, to) = (texture.as_image_copy(), target.as_image_copy());
        encoder.copy_texture_to_texture(from, to, target.size());
        self.backdrop = Some((backdrop.id, texture));
        covered
    }

    fn upload(&mut self, gpu: &Gpu, drawing: &Drawing) {
        for ((buffer, _), transform) in self.transforms.iter().zip(&drawing.transforms) {
            gpu.queue.write_buffer(buffer, 0, bytemuck::bytes_of(&Uniform::from(transform)));
        }
        self.triangles.write(gpu, &drawing.triangles);
        self.strokes.write(gpu, &drawing.strokes);
        if let Some(SeaRect { rect_px, colours, .. }) = drawing.sea {
            // The index of a vertex determines its corner.
            let vertices = vec![SeaVertex { rect_px, colours }; 4];
            self.sea.write(gpu, &Mesh { vertices, indices: vec![0, 1, 2, 2, 1, 3] });
        }
    }

    /// Paints parts of the drawing: part 0 is the sea, and part `n` is draw `n - 1`.
    fn paint(&self, pass: &mut wgpu::RenderPass<'_>, drawing: &Drawing, parts: Range<usize>) {
        if let Some(sea) = drawing.sea.filter(|_| parts.start == 0) {
            let [left, top, width, height] = sea.scissor_px;
            pass.set_scissor_rect(left, top, width, height);
            pass.set_pipeline(&self.pipelines.water);
            pass.set_bind_group(0, &self.transforms[Place::Stage as usize].1, &[]);
            self.sea.bind(pass);
            pass.draw_indexed(0..6, 0, 0..1);
        }
        let draws = drawing.draws.iter().take(parts.end - 1);
        let mut set = None;
        for Draw { scissor_px, place, kind, indices } in draws.skip(parts.start.max(1) - 1) {
            if set.replace((place, kind)) != Some((place, kind)) {
                let (pipeline, mesh, atlas) = match kind {
                    // The fill looks nothing up, but its pipeline has an atlas.
                    DrawKind::OpaqueFill => {
                        (&self.pipelines.fill, &self.triangles, Some(TextureId::default()))
                    }
                    DrawKind::Textured(id) => {
                        (&self.pipelines.textured, &self.triangles, Some(*id))
                    }
                    DrawKind::Stroke => (&self.pipelines.stroke, &self.strokes, None),
                };
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.transforms[*place as usize].1, &[]);
                if let Some(id) = atlas {
                    let Some((_, group)) = self.atlases.get(&id) else {
                        set = None;
                        continue;
                    };
                    pass.set_bind_group(1, group, &[]);
                }
                mesh.bind(pass);
            }
            let [left, top, width, height] = *scissor_px;
            pass.set_scissor_rect(left, top, width, height);
            pass.draw_indexed(indices.clone(), 0, 0..1);
        }
    }

    /// Stores a new texture, or a changed part of an old one.
    fn set_texture(&mut self, gpu: &Gpu, id: TextureId, delta: &ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size.map(|side| side as u32);
        if delta.pos.is_none() {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
            let format = wgpu::TextureFormat::Rgba8Unorm;
            let texture = new_texture(gpu, "panels", [width, height], format, usage);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let view = wgpu::BindingResource::TextureView(&view);
            let group = bind_group(gpu, &self.pipelines.atlas_layout, view);
            self.atlases.insert(id, (texture, group));
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
}

impl From<&ScreenTransform> for Uniform {
    fn from(transform: &ScreenTransform) -> Self {
        Self {
            target_px: transform.size_px.map(|side| side as f32),
            origin_px: transform.origin_px,
            px_per_point: transform.px_per_point,
            padding: [0.0; 3],
        }
    }
}

/// Vertices and indices on the device.
#[derive(Debug)]
struct MeshBuffer {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
}

impl MeshBuffer {
    fn new(gpu: &Gpu) -> Self {
        Self {
            vertices: buffer(gpu, wgpu::BufferUsages::VERTEX, FIRST_CAPACITY),
            indices: buffer(gpu, wgpu::BufferUsages::INDEX, FIRST_CAPACITY),
        }
    }

    fn write<V: Pod>(&mut self, gpu: &Gpu, mesh: &Mesh<V>) {
        write(gpu, &mut self.vertices, bytemuck::cast_slice(&mesh.vertices));
        write(gpu, &mut self.indices, bytemuck::cast_slice(&mesh.indices));
    }

    /// Binds the triangles for the draws that follow.
    fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

fn buffer(gpu: &Gpu, usage: wgpu::BufferUsages, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("frame"),
        size: bytes,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Writes to the start of a buffer, or replaces the buffer by a larger one.
fn write(gpu: &Gpu, into: &mut wgpu::Buffer, bytes: &[u8]) {
    if bytes.len() as u64 > into.size() {
        let usage = into.usage() & !wgpu::BufferUsages::COPY_DST;
        *into = buffer(gpu, usage, (bytes.len() as u64).next_power_of_two());
    }
    gpu.queue.write_buffer(into, 0, bytes);
}

fn uniform(gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> (wgpu::Buffer, wgpu::BindGroup) {
    let buffer = buffer(gpu, wgpu::BufferUsages::UNIFORM, size_of::<Uniform>() as u64);
    let group = bind_group(gpu, layout, buffer.as_entire_binding());
    (buffer, group)
}

fn bind_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resource: wgpu::BindingResource<'_>,
) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource }],
    })
}

/// Creates a texture of one level with undefined contents.
pub(super) fn new_texture(
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

/// Whether a texture of this format and of the target's size can be copied to the target.
fn accepts_copies(target: &wgpu::Texture, format: wgpu::TextureFormat) -> bool {
    let is_plain = target.depth_or_array_layers() == 1
        && target.mip_level_count() == 1
        && target.sample_count() == 1;
    let usage = target.usage().contains(wgpu::TextureUsages::COPY_DST);
    usage && is_plain && target.format() == format
}

/// Begins a pass on a black target, or on its present contents.
fn begin_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    is_kept: bool,
) -> wgpu::RenderPass<'e> {
    let load = if is_kept { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::BLACK) };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("frame"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}
