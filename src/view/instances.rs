//! A buffer of instances that grows as needed and is kept from frame to frame.

use std::ops::Range;

use super::gpu::Gpu;

/// Room for this many at first: a solo scene fits, and growing is by doubling.
const FIRST_CAPACITY: usize = 256;

/// Plain data for one instanced draw of quads.
#[derive(Debug)]
pub(super) struct Instances<T> {
    label: &'static str,
    buffer: wgpu::Buffer,
    /// Kept for its capacity.
    staging: Vec<T>,
}

impl<T: bytemuck::Pod> Instances<T> {
    pub(super) fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self { label, buffer: buffer::<T>(gpu, label, FIRST_CAPACITY), staging: Vec::new() }
    }

    /// Replaces all instances.
    pub(super) fn upload(&mut self, gpu: &Gpu, instances: impl Iterator<Item = T>) {
        self.staging.clear();
        self.staging.extend(instances);
        let bytes: &[u8] = bytemuck::cast_slice(&self.staging);
        if bytes.len() as u64 > self.buffer.size() {
            self.buffer = buffer::<T>(gpu, self.label, self.staging.len().next_power_of_two());
        }
        gpu.queue.write_buffer(&self.buffer, 0, bytes);
    }

    pub(super) fn all(&self) -> Range<u32> {
        0..self.staging.len() as u32
    }

    /// Draws a strip of four vertices for each of some instances, with the pipeline that is set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, some: Range<u32>) {
        if some.is_empty() {
            return;
        }
        // Not by a first instance, which some drivers' GL lacks.
        let first = u64::from(some.start) * size_of::<T>() as u64;
        pass.set_vertex_buffer(0, self.buffer.slice(first..));
        pass.draw(0..4, 0..some.len() as u32);
    }
}

fn buffer<T>(gpu: &Gpu, label: &str, capacity: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: (capacity * size_of::<T>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
