//! Lines on the device: trails, wakes, the curves of plots.

use std::ops::Range;

use super::gpu::Gpu;
use super::lines::{LineMesh, LineVertex};
use super::place::pipeline;
use super::triangles::Triangles;

const SHADER: &str =
    concat!(include_str!("../../shaders/place.wgsl"), include_str!("../../shaders/lines.wgsl"));

const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Float32x3, 3 => Unorm8x4];

/// Draws lines on targets of one format.
#[derive(Debug)]
pub(super) struct Strips {
    solid: wgpu::RenderPipeline,
    dashed: wgpu::RenderPipeline,
    triangles: Triangles<LineVertex>,
}

/// Lines that were added.
#[derive(Clone, Debug)]
pub(super) struct Strip {
    is_dashed: bool,
    indices: Range<u32>,
}

impl Strips {
    /// Drawn where the bind group of `layout` says.
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let [solid, dashed] = ["solid", "dashed"].map(|fragment| {
            let blend = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
            let names = ["lines", SHADER, fragment];
            pipeline::<LineVertex>(gpu, layout, format, names, &ATTRIBUTES, blend)
        });
        Self { solid, dashed, triangles: Triangles::new(gpu, "lines") }
    }

    pub(super) fn clear(&mut self) {
        self.triangles.clear();
    }

    pub(super) fn add(&mut self, mesh: &LineMesh) -> Strip {
        let indices = self.triangles.add(&mesh.vertices, &mesh.indices);
        Strip { is_dashed: mesh.dash[1] > 0.0, indices }
    }

    pub(super) fn upload(&mut self, gpu: &Gpu) {
        self.triangles.upload(gpu);
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, strip: &Strip) {
        pass.set_pipeline(if strip.is_dashed { &self.dashed } else { &self.solid });
        self.triangles.bind(pass);
        pass.draw_indexed(strip.indices.clone(), 0, 0..1);
    }
}
