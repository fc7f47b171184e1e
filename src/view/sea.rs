//! The background of the stage: water, lighter towards the top and under a light.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::gpu::Gpu;
use super::mesh_buffer::MeshBuffer;
use super::screen_transform::{ScreenTransform, pipeline};
use crate::stage::Sea;

const SHADER: &str = concat!(
    include_str!("../../shaders/screen_transform.wgsl"),
    include_str!("../../shaders/sea.wgsl")
);

/// `Part` in `shaders/sea.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Part {
    rect_px: [f32; 4],
    top: [u8; 4],
    bottom: [u8; 4],
}

const ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x4, 1 => Unorm8x4, 2 => Unorm8x4];

/// Draws a picture's sea.
#[derive(Debug)]
pub(super) struct SeaPipeline {
    pipeline: wgpu::RenderPipeline,
    triangles: MeshBuffer<Part>,
    indices: Range<u32>,
}

impl SeaPipeline {
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let names = ["sea", SHADER, "water"];
        let pipeline = pipeline::<Part>(gpu, layout, format, names, &ATTRIBUTES, None);
        Self { pipeline, triangles: MeshBuffer::new(gpu, "sea"), indices: 0..0 }
    }

    pub(super) fn upload(&mut self, gpu: &Gpu, sea: Option<&Sea>, transform: &ScreenTransform) {
        let part = |sea: &Sea| {
            let [[left, top], [right, bottom]] =
                [sea.rect.min, sea.rect.max].map(|at| transform.px(at));
            let rect_px = [left, top, right, bottom].map(f32::round);
            Part { rect_px, top: sea.colours[0], bottom: sea.colours[1] }
        };
        self.triangles.clear();
        self.indices = sea.map_or(0..0, |sea| {
            // The index of a vertex determines its corner.
            self.triangles.add(&[part(sea); 4], &[0, 1, 2, 2, 1, 3])
        });
        self.triangles.upload(gpu);
    }

    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        self.triangles.draw(pass, self.indices.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::{Picture, Rect};
    use crate::view::testing::{draw_picture, gpu_or_skip};

    #[test]
    fn a_sea_fills_exactly_its_rectangle_and_is_lighter_above() {
        let test = "a_sea_fills_exactly_its_rectangle_and_is_lighter_above";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let rect = Rect { min: [8.0, 8.0], max: [56.0, 56.0] };
        let sea = Sea { rect, colours: [[40, 60, 90, 255], [10, 20, 30, 255]] };
        let pixels =
            draw_picture(&gpu, [64, 64], 1.0, &Picture { sea: Some(sea), ..Picture::default() });
        for (x, y) in [(7, 30), (56, 30), (30, 7), (30, 56)] {
            assert_eq!(pixels.at(x, y)[..3], [0, 0, 0], "({x}, {y}) is outside");
        }
        assert_eq!(pixels.count_lit(), 48 * 48);
        let [above, below] = [9, 54].map(|y| pixels.at(9, y)[2]);
        assert!(above > below + 30, "{above} and {below}");
        let [lit, shaded] = [[38, 18], [9, 18]].map(|[x, y]| pixels.at(x, y)[2]);
        assert!(lit > shaded, "{lit} under the light, {shaded} away from it");
    }
}
