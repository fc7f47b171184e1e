//! A buffer of quads that grows as needed and is kept from frame to frame.

use std::ops::Range;

use super::gpu::Gpu;

/// Room for this many at first: a solo scene fits, and growing is by doubling.
const FIRST_CAPACITY: usize = 256;

/// Plain data for quads, the same for all four vertices of each: which corner a vertex is, its index says.
///
/// Not by instances: a software adapter starts over with each of them.
#[derive(Debug)]
pub(super) struct Quads<T> {
    label: &'static str,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Kept for its capacity.
    staging: Vec<[T; 4]>,
}

impl<T: bytemuck::Pod> Quads<T> {
    pub(super) fn new(gpu: &Gpu, label: &'static str) -> Self {
        let [vertices, indices] = buffers::<T>(gpu, label, FIRST_CAPACITY);
        Self { label, vertices, indices, staging: Vec::new() }
    }

    /// Replaces all quads.
    pub(super) fn upload(&mut self, gpu: &Gpu, quads: impl Iterator<Item = T>) {
        self.staging.clear();
        self.staging.extend(quads.map(|quad| [quad; 4]));
        let bytes: &[u8] = bytemuck::cast_slice(&self.staging);
        if bytes.len() as u64 > self.vertices.size() {
            let capacity = self.staging.len().next_power_of_two();
            [self.vertices, self.indices] = buffers::<T>(gpu, self.label, capacity);
        }
        gpu.queue.write_buffer(&self.vertices, 0, bytes);
    }

    /// Makes the pass draw of what was uploaded.
    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Draws some of the quads that are bound, with the pipeline that is set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, some: Range<u32>) {
        pass.draw_indexed(6 * some.start..6 * some.end, 0, 0..1);
    }

    /// Draws all quads, with the pipeline that is set.
    pub(super) fn draw_all(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.bind(pass);
        self.draw(pass, 0..self.staging.len() as u32);
    }
}

/// For the vertices of so many quads, and for their triangles.
fn buffers<T>(gpu: &Gpu, label: &str, capacity: usize) -> [wgpu::Buffer; 2] {
    let buffer = |bytes: usize, usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    };
    let quad = |first: u32| [0, 1, 2, 2, 1, 3].map(|corner| first + corner);
    let corners: Vec<u32> = (0..4 * capacity as u32).step_by(4).flat_map(quad).collect();
    let vertices = buffer(4 * capacity * size_of::<T>(), wgpu::BufferUsages::VERTEX);
    let indices = buffer(corners.len() * size_of::<u32>(), wgpu::BufferUsages::INDEX);
    gpu.queue.write_buffer(&indices, 0, bytemuck::cast_slice(&corners));
    [vertices, indices]
}
