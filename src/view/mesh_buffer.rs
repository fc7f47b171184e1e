//! Triangle buffers that grow as needed and stay from frame to frame.

use std::ops::Range;

use super::gpu::Gpu;

/// Initial capacity in bytes. It grows by doubling.
const FIRST_CAPACITY: u64 = 1 << 16;

/// The triangles of some meshes, with one type of vertex.
#[derive(Debug)]
pub(super) struct MeshBuffer<V> {
    label: &'static str,
    vertex_buffer: wgpu::Buffer,
    index_buffer: wgpu::Buffer,
    /// Kept for their capacity.
    vertices: Vec<V>,
    indices: Vec<u32>,
}

impl<V: bytemuck::Pod> MeshBuffer<V> {
    pub(super) fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self {
            label,
            vertex_buffer: buffer(gpu, label, wgpu::BufferUsages::VERTEX, FIRST_CAPACITY),
            index_buffer: buffer(gpu, label, wgpu::BufferUsages::INDEX, FIRST_CAPACITY),
            vertices: Vec::new(),
            indices: Vec::new(),
        }
    }

    pub(super) fn clear(&mut self) {
        self.vertices.clear();
        self.indices.clear();
    }

    /// Adds a mesh. Returns the range of its indices.
    pub(super) fn add(&mut self, vertices: &[V], indices: &[u32]) -> Range<u32> {
        let first_vertex = self.add_vertices(vertices);
        self.add_indices(first_vertex, indices.iter().copied())
    }

    /// Adds vertices. Returns the index of the first.
    pub(super) fn add_vertices(&mut self, vertices: &[V]) -> u32 {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(vertices);
        first
    }

    /// Adds the corners of triangles, counted from `first_vertex`. Returns the range of their indices.
    pub(super) fn add_indices(
        &mut self,
        first_vertex: u32,
        indices: impl Iterator<Item = u32>,
    ) -> Range<u32> {
        let first = self.indices.len() as u32;
        self.indices.extend(indices.map(|index| first_vertex + index));
        first..self.indices.len() as u32
    }

    pub(super) fn upload(&mut self, gpu: &Gpu) {
        write(gpu, self.label, &mut self.vertex_buffer, bytemuck::cast_slice(&self.vertices));
        write(gpu, self.label, &mut self.index_buffer, bytemuck::cast_slice(&self.indices));
    }

    /// Binds the uploaded triangles for the draws that follow.
    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertex_buffer.slice(..));
        pass.set_index_buffer(self.index_buffer.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Draws a range of the uploaded triangles with the current pipeline.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, indices: Range<u32>) {
        self.bind(pass);
        pass.draw_indexed(indices, 0, 0..1);
    }
}

fn buffer(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Writes to the start of a buffer, or replaces the buffer by a larger one.
fn write(gpu: &Gpu, label: &str, into: &mut wgpu::Buffer, bytes: &[u8]) {
    if bytes.len() as u64 > into.size() {
        let usage = into.usage() & !wgpu::BufferUsages::COPY_DST;
        *into = buffer(gpu, label, usage, (bytes.len() as u64).next_power_of_two());
    }
    gpu.queue.write_buffer(into, 0, bytes);
}
