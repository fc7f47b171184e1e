//! Backgrounds: night water under a thin grid, one quad for each body's cell.

use bytemuck::{Pod, Zeroable};

use super::gpu::Gpu;
use super::instances::Instances;
use super::stage::quad_pipeline;
use crate::lab::picture::Sea;

const SHADER: &str =
    concat!(include_str!("../../shaders/stage.wgsl"), include_str!("../../shaders/sea.wgsl"));

/// `Instance` in `shaders/sea.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct SeaInstance {
    rect: [f32; 4],
    grid_origin: [f32; 2],
    grid_step: f32,
    waves: [f32; 2],
}

const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x2, 2 => Float32, 3 => Float32x2];

impl From<&Sea> for SeaInstance {
    fn from(sea: &Sea) -> Self {
        let Sea { rect, grid_origin, grid_step, waves, phase } = *sea;
        Self {
            rect: [rect.min[0], rect.min[1], rect.max[0], rect.max[1]],
            grid_origin,
            grid_step,
            waves: [waves, phase],
        }
    }
}

/// Draws a picture's seas: water and chart paper apart, for only water pays for a swell.
#[derive(Debug)]
pub(super) struct SeaPipeline {
    water: (wgpu::RenderPipeline, Instances<SeaInstance>),
    chart: (wgpu::RenderPipeline, Instances<SeaInstance>),
}

impl SeaPipeline {
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let kind = |fragment| {
            let instance = wgpu::VertexBufferLayout {
                array_stride: size_of::<SeaInstance>() as u64,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &ATTRIBUTES,
            };
            let pipeline = quad_pipeline(gpu, layout, format, ["seas", SHADER, fragment], instance);
            (pipeline, Instances::new(gpu, "seas"))
        };
        Self { water: kind("water"), chart: kind("chart") }
    }

    pub(super) fn upload(&mut self, gpu: &Gpu, seas: &[Sea]) {
        let (water, chart) = (&mut self.water.1, &mut self.chart.1);
        water.upload(gpu, seas.iter().filter(|sea| sea.waves > 0.0).map(SeaInstance::from));
        chart.upload(gpu, seas.iter().filter(|sea| sea.waves <= 0.0).map(SeaInstance::from));
    }

    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        for (pipeline, instances) in [&self.water, &self.chart] {
            pass.set_pipeline(pipeline);
            instances.draw(pass, instances.all());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::picture::{Picture, Rect};
    use crate::view::testing::{Pixels, draw_picture, gpu_or_skip};

    fn draw_sea(gpu: &Gpu, sea: Sea) -> Pixels {
        draw_picture(gpu, [64, 64], 1.0, &Picture { seas: vec![sea], ..Picture::default() })
    }

    fn sea() -> Sea {
        Sea {
            rect: Rect { min: [8.0, 8.0], max: [56.0, 56.0] },
            grid_origin: [20.5, 20.5],
            grid_step: 16.0,
            waves: 0.0,
            phase: 0.0,
        }
    }

    #[test]
    fn a_sea_fills_its_cell_and_nothing_else() {
        let Some(gpu) = gpu_or_skip("a_sea_fills_its_cell_and_nothing_else") else { return };
        let pixels = draw_sea(&gpu, sea());
        for (x, y) in [(7, 30), (56, 30), (30, 7), (30, 56), (8, 8)] {
            assert_eq!(pixels.at(x, y)[..3], [0, 0, 0], "({x}, {y}) is outside");
        }
        for (x, y) in [(8, 30), (55, 30), (30, 8), (30, 55), (12, 12)] {
            assert!(pixels.at(x, y)[2] > 20, "({x}, {y}) is inside");
        }
    }

    #[test]
    fn the_grid_has_a_line_at_its_origin_and_at_every_step() {
        let test = "the_grid_has_a_line_at_its_origin_and_at_every_step";
        let Some(gpu) = gpu_or_skip(test) else { return };
        for origin in [20.1, 20.5, 20.9] {
            let pixels = draw_sea(&gpu, Sea { grid_origin: [origin; 2], ..sea() });
            let across = |at| pixels.at(at, 30)[2];
            let down = |at| pixels.at(30, at)[2];
            for line in [20, 36, 52] {
                for beside in [line - 1, line + 1] {
                    assert!(across(line) > across(beside) + 8, "{origin}: a line at x {line}");
                    assert!(down(line) > down(beside) + 8, "{origin}: a line at y {line}");
                }
            }
        }
        let no_grid = draw_sea(&gpu, Sea { grid_step: 0.0, ..sea() });
        assert_eq!(no_grid.at(20, 30), no_grid.at(16, 30));
    }

    #[test]
    fn water_moves_and_chart_paper_does_not() {
        let Some(gpu) = gpu_or_skip("water_moves_and_chart_paper_does_not") else { return };
        let at = |waves, phase| draw_sea(&gpu, Sea { waves, phase, ..sea() }).rows;
        assert_eq!(at(0.0, 0.0), at(0.0, 2.0));
        assert_ne!(at(1.0, 0.0), at(1.0, 2.0));
    }

    #[test]
    fn water_does_not_jump_when_the_grid_is_anchored_a_step_further() {
        let test = "water_does_not_jump_when_the_grid_is_anchored_a_step_further";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let at =
            |x| draw_sea(&gpu, Sea { waves: 1.0, phase: 1.0, grid_origin: [x, 20.5], ..sea() });
        let (here, further) = (at(20.5).rows, at(36.5).rows);
        let difference = here.iter().zip(&further).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(difference <= Some(1), "{difference:?}");
    }
}
