//! Backgrounds: night water or chart paper under a thin grid, a cell for each body.

use bytemuck::{Pod, Zeroable};

use super::gpu::Gpu;
use super::place::{Place, pipeline};
use super::quads::Quads;
use crate::lab::picture::Sea;

const SHADER: &str =
    concat!(include_str!("../../shaders/place.wgsl"), include_str!("../../shaders/sea.wgsl"));

/// Red, green, blue and opacity of the lines of a grid, and of the border of a cell.
const GRID: [f32; 4] = [0.45, 0.65, 0.85, 0.085];
const BORDER: [f32; 4] = [0.40, 0.58, 0.76, 0.22];
/// The radius of a cell's corners.
const CORNER_POINTS: f32 = 5.0;
/// Lines closer than the first, in pixels, are a grey wash, so they are left out; from the second on they
/// are full.
const GRID_FADE_PX: [f32; 2] = [4.0, 14.0];

/// `Part` in `shaders/sea.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Part {
    cell_px: [f32; 4],
    part_px: [f32; 4],
    grid_px: [f32; 3],
    waves: [f32; 2],
    line: [f32; 4],
    corner_px: [f32; 2],
}

const ATTRIBUTES: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
    0 => Float32x4, 1 => Float32x4, 2 => Float32x3, 3 => Float32x2, 4 => Float32x4, 5 => Float32x2
];

/// Draws a picture's seas: water and chart paper apart, for only water pays for a swell, and corners for
/// their shape.
#[derive(Debug)]
pub(super) struct SeaPipeline {
    water: (wgpu::RenderPipeline, Quads<Part>),
    chart: (wgpu::RenderPipeline, Quads<Part>),
    corners: (wgpu::RenderPipeline, Quads<Part>),
}

impl SeaPipeline {
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let kind = |fragment, blend| {
            let names = ["seas", SHADER, fragment];
            let pipeline = pipeline::<Part>(gpu, layout, format, names, &ATTRIBUTES, blend);
            (pipeline, Quads::new(gpu, "seas"))
        };
        Self {
            water: kind("water", None),
            chart: kind("chart", None),
            corners: kind("corner", Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING)),
        }
    }

    pub(super) fn upload(&mut self, gpu: &Gpu, seas: &[Sea], place: &Place) {
        let cells = seas.iter().map(|sea| Cell::new(sea, place));
        let cells: Vec<Cell> = cells.filter(|cell| !cell.is_empty()).collect();
        let opaque = |moves: bool| {
            let of_kind = cells.iter().filter(move |cell| (cell.whole.waves[0] > 0.0) == moves);
            of_kind.flat_map(|cell| cell.parts().chain(cell.grid()).chain(cell.border()))
        };
        self.water.1.upload(gpu, opaque(true));
        self.chart.1.upload(gpu, opaque(false));
        self.corners.1.upload(gpu, cells.iter().flat_map(Cell::corners));
    }

    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        for (pipeline, parts) in [&self.water, &self.chart, &self.corners] {
            pass.set_pipeline(pipeline);
            parts.draw_all(pass);
        }
    }
}

/// A sea on whole pixels, so that neighbours neither overlap nor leave a seam.
struct Cell {
    /// All of it, as if it had no corners.
    whole: Part,
    corner_px: f32,
    line_px: f32,
}

impl Cell {
    fn new(sea: &Sea, place: &Place) -> Self {
        let [left, top] = place.px(sea.rect.min).map(f32::round);
        let [right, bottom] = place.px(sea.rect.max).map(f32::round);
        let half_px = ((right - left).min(bottom - top) / 2.0).floor().max(0.0);
        let [x, y] = place.px(sea.grid_origin);
        let step_px = (sea.grid_step * place.px_per_point).max(1.0);
        let whole = Part {
            cell_px: [left, top, right, bottom],
            part_px: [left, top, right, bottom],
            grid_px: [x, y, step_px],
            waves: [sea.waves, sea.phase],
            line: [0.0; 4],
            corner_px: [0.0; 2],
        };
        let corner_px = (CORNER_POINTS * place.px_per_point).round().min(half_px);
        Self { whole, corner_px, line_px: place.px_per_point.round().max(1.0) }
    }

    fn is_empty(&self) -> bool {
        let [left, top, right, bottom] = self.whole.cell_px;
        right <= left || bottom <= top
    }

    fn part(&self, part_px: [f32; 4], line: [f32; 4]) -> Part {
        Part { part_px, line, ..self.whole }
    }

    /// Everything but the corners: the middle, and what is above and below it.
    fn parts(&self) -> impl Iterator<Item = Part> + '_ {
        let ([left, top, right, bottom], corner) = (self.whole.cell_px, self.corner_px);
        [
            [left, top + corner, right, bottom - corner],
            [left + corner, top, right - corner, top + corner],
            [left + corner, bottom - corner, right - corner, bottom],
        ]
        .into_iter()
        .map(|part_px| self.part(part_px, [0.0; 4]))
    }

    fn corners(&self) -> impl Iterator<Item = Part> + '_ {
        let ([left, top, right, bottom], corner) = (self.whole.cell_px, self.corner_px);
        let places = [(left, top), (right - corner, top), (left, bottom - corner)];
        places.into_iter().chain([(right - corner, bottom - corner)]).map(move |(x, y)| Part {
            corner_px: [corner, self.line_px],
            ..self.part([x, y, x + corner, y + corner], BORDER)
        })
    }

    fn border(&self) -> impl Iterator<Item = Part> + '_ {
        let ([left, top, right, bottom], corner) = (self.whole.cell_px, self.corner_px);
        let line = self.line_px;
        [
            [left + corner, top, right - corner, top + line],
            [left + corner, bottom - line, right - corner, bottom],
            [left, top + corner, left + line, bottom - corner],
            [right - line, top + corner, right, bottom - corner],
        ]
        .into_iter()
        .map(|part_px| self.part(part_px, BORDER))
    }

    /// Lines on whole pixels: one that lies across two of them is half as bright.
    fn grid(&self) -> impl Iterator<Item = Part> + '_ {
        let ([left, top, right, bottom], corner) = (self.whole.cell_px, self.corner_px);
        let [x, y, step] = self.whole.grid_px;
        let part = (step - GRID_FADE_PX[0]) / (GRID_FADE_PX[1] - GRID_FADE_PX[0]);
        let part = part.clamp(0.0, 1.0);
        let alpha = GRID[3] * part * part * (3.0 - 2.0 * part);
        let line = self.line_px;
        // The first pixels of the lines between two edges, and how far from the other two edges each
        // line ends: it leaves corners alone.
        let lines = move |origin: f32, low: f32, high: f32| {
            let seen = if alpha > 0.0 { high } else { low };
            let first = ((low + 0.5 * line - 0.5 - origin) / step).ceil();
            (0..)
                .map(move |i| (origin + (first + i as f32) * step - 0.5 * line).round())
                .take_while(move |at| at + line <= seen)
                .filter(move |&at| at >= low)
                .map(move |at| {
                    let in_corner = at < low + corner || at + line > high - corner;
                    (at, if in_corner { corner } else { 0.0 })
                })
        };
        let down =
            lines(x, left, right).map(move |(x, inset)| [x, top + inset, x + line, bottom - inset]);
        let across =
            lines(y, top, bottom).map(move |(y, inset)| [left + inset, y, right - inset, y + line]);
        let [red, green, blue, _] = GRID;
        down.chain(across).map(move |part_px| self.part(part_px, [red, green, blue, alpha]))
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
