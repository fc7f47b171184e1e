//! Strokes: every line, dot, hull and block of a picture, in painting order.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::gpu::Gpu;
use super::place::pipeline;
use super::quads::Quads;
use crate::lab::picture::{Cap, Stroke};

const SHADER: &str =
    concat!(include_str!("../../shaders/place.wgsl"), include_str!("../../shaders/strokes.wgsl"));

/// `Quad` in `shaders/strokes.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct StrokeQuad {
    ends: [f32; 4],
    radii: [f32; 2],
    colour: [u8; 4],
    butt: f32,
}

const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x2, 2 => Unorm8x4, 3 => Float32];

impl From<&Stroke> for StrokeQuad {
    fn from(stroke: &Stroke) -> Self {
        let Stroke { from, to, radii, colour, cap, clip: _ } = *stroke;
        let butt = match cap {
            Cap::Round => 0.0,
            Cap::Butt => 1.0,
        };
        Self { ends: [from[0], from[1], to[0], to[1]], radii, colour, butt }
    }
}

/// What a stroke's pixels have to find out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StrokeKind {
    /// As wide at one end as at the other: nearly all are so.
    Line,
    Hull,
}

impl StrokeKind {
    pub(super) fn of(stroke: &Stroke) -> Self {
        if stroke.radii[0] == stroke.radii[1] { StrokeKind::Line } else { StrokeKind::Hull }
    }
}

/// Draws a picture's strokes.
#[derive(Debug)]
pub(super) struct StrokePipeline {
    /// One for each [`StrokeKind`], in its order.
    pipelines: [wgpu::RenderPipeline; 2],
    quads: Quads<StrokeQuad>,
    added: Vec<StrokeQuad>,
}

impl StrokePipeline {
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let pipeline = |fragment| {
            let blend = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
            let names = ["strokes", SHADER, fragment];
            pipeline::<StrokeQuad>(gpu, layout, format, names, &ATTRIBUTES, blend)
        };
        Self {
            pipelines: ["line", "hull"].map(pipeline),
            quads: Quads::new(gpu, "strokes"),
            added: Vec::new(),
        }
    }

    pub(super) fn clear(&mut self) {
        self.added.clear();
    }

    /// Adds strokes, and says which quads they got.
    pub(super) fn add<'s>(&mut self, strokes: impl Iterator<Item = &'s Stroke>) -> Range<u32> {
        let first = self.added.len() as u32;
        self.added.extend(strokes.map(StrokeQuad::from));
        first..self.added.len() as u32
    }

    pub(super) fn upload(&mut self, gpu: &Gpu) {
        self.quads.upload(gpu, self.added.iter().copied());
    }

    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        kind: StrokeKind,
        quads: Range<u32>,
    ) {
        pass.set_pipeline(&self.pipelines[kind as usize]);
        self.quads.bind(pass);
        self.quads.draw(pass, quads);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::picture::{Picture, Rect, Shape};
    use crate::view::testing::{EVERYWHERE, Pixels, draw_picture, gpu_or_skip};

    const WHITE: [u8; 4] = [255; 4];

    fn line(from: [f32; 2], to: [f32; 2], radius: f32) -> Stroke {
        Stroke { from, to, radii: [radius; 2], colour: WHITE, cap: Cap::Round, clip: EVERYWHERE }
    }

    fn draw(gpu: &Gpu, strokes: &[Stroke]) -> Pixels {
        let picture = Picture {
            shapes: strokes.iter().copied().map(Shape::Stroke).collect(),
            ..Picture::default()
        };
        draw_picture(gpu, [64, 64], 1.0, &picture)
    }

    #[test]
    fn a_line_covers_its_own_pixels_and_no_others() {
        let Some(gpu) = gpu_or_skip("a_line_covers_its_own_pixels_and_no_others") else { return };
        let stroke = Stroke { cap: Cap::Butt, ..line([10.0, 32.0], [50.0, 32.0], 4.0) };
        let pixels = draw(&gpu, &[stroke]);
        for y in 0..64 {
            for x in 0..64 {
                let inside = (10..50).contains(&x) && (28..36).contains(&y);
                let expected = if inside { WHITE } else { [0, 0, 0, 255] };
                assert_eq!(pixels.at(x, y), expected, "({x}, {y})");
            }
        }
    }

    #[test]
    fn nothing_is_drawn_outside_the_clip() {
        let Some(gpu) = gpu_or_skip("nothing_is_drawn_outside_the_clip") else { return };
        let clip = Rect { min: [20.0, 30.0], max: [40.0, 34.0] };
        let pixels = draw(&gpu, &[Stroke { clip, ..line([0.0, 32.0], [64.0, 32.0], 10.0) }]);
        assert_eq!(pixels.lit(), 20 * 4);
        assert_eq!(pixels.at(20, 30), WHITE);
        assert_eq!(pixels.at(39, 33), WHITE);
    }

    #[test]
    fn a_stroke_of_no_length_is_a_disc() {
        let Some(gpu) = gpu_or_skip("a_stroke_of_no_length_is_a_disc") else { return };
        let pixels = draw(&gpu, &[line([32.0, 32.0], [32.0, 32.0], 10.0)]);
        let area = std::f32::consts::PI * 100.0;
        assert!((pixels.sum(0) - area).abs() < 0.01 * area, "{} of {area}", pixels.sum(0));
        for (x, y) in [(23, 31), (40, 32), (31, 23), (32, 40)] {
            assert_eq!(pixels.at(x, y), WHITE, "({x}, {y}) is inside");
        }
        for (x, y) in [(23, 23), (40, 40), (20, 32), (43, 32)] {
            assert_eq!(pixels.at(x, y)[0], 0, "({x}, {y}) is outside");
        }
    }

    #[test]
    fn different_radii_make_a_taper() {
        let Some(gpu) = gpu_or_skip("different_radii_make_a_taper") else { return };
        let stroke = Stroke { radii: [12.0, 2.0], ..line([16.0, 32.0], [52.0, 32.0], 0.0) };
        let pixels = draw(&gpu, &[stroke]);
        let width = |x| (0..64).filter(|&y| pixels.at(x, y)[0] > 127).count();
        assert!(width(16) >= 24, "{}", width(16));
        assert!((3..=5).contains(&width(52)), "{}", width(52));
        let widths = [16, 24, 32, 40, 48].map(width);
        assert!(widths.is_sorted_by(|a, b| a > b), "{widths:?}");
    }

    #[test]
    fn a_disc_within_the_other_one_does_not_show() {
        let Some(gpu) = gpu_or_skip("a_disc_within_the_other_one_does_not_show") else { return };
        let disc = draw(&gpu, &[line([30.0, 32.0], [30.0, 32.0], 12.0)]);
        for radii in [[12.0, 2.0], [2.0, 12.0]] {
            let (from, to) = if radii[0] > radii[1] { (30.0, 34.0) } else { (34.0, 30.0) };
            let stroke = Stroke { radii, ..line([from, 32.0], [to, 32.0], 0.0) };
            let difference = draw(&gpu, &[stroke]).sum(0) - disc.sum(0);
            assert!(difference.abs() < 0.1, "{radii:?}: {difference}");
        }
    }

    #[test]
    fn thin_strokes_fade_in_proportion() {
        let Some(gpu) = gpu_or_skip("thin_strokes_fade_in_proportion") else { return };
        for cap in [Cap::Butt, Cap::Round] {
            for radius in [0.5, 0.25, 0.1] {
                let stroke = Stroke { cap, ..line([-10.0, 32.2], [74.0, 32.2], radius) };
                let light = draw(&gpu, &[stroke]).sum(0);
                let expected = 64.0 * 2.0 * radius;
                assert!((light / expected - 1.0).abs() < 0.05, "{cap:?} {radius}: {light}");
            }
        }
    }

    #[test]
    fn later_strokes_lie_over_earlier_ones() {
        let Some(gpu) = gpu_or_skip("later_strokes_lie_over_earlier_ones") else { return };
        let [red, green] = [[255, 0, 0, 255], [0, 255, 0, 128]];
        let dot = |colour| Stroke { colour, ..line([32.0; 2], [32.0; 2], 6.0) };
        assert_eq!(draw(&gpu, &[dot(green), dot(red)]).at(32, 32), red);
        let [r, g, b, a] = draw(&gpu, &[dot(red), dot(green)]).at(32, 32);
        assert!(r.abs_diff(127) <= 1 && g.abs_diff(128) <= 1, "{r} {g}");
        assert_eq!([b, a], [0, 255]);
    }

    #[test]
    fn a_point_is_as_many_pixels_as_the_scale_says() {
        let test = "a_point_is_as_many_pixels_as_the_scale_says";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let stroke = Stroke { cap: Cap::Butt, ..line([4.0, 8.0], [12.0, 8.0], 2.0) };
        let picture = Picture { shapes: vec![Shape::Stroke(stroke)], ..Picture::default() };
        assert_eq!(draw_picture(&gpu, [64, 64], 1.0, &picture).lit(), 8 * 4);
        assert_eq!(draw_picture(&gpu, [64, 64], 3.0, &picture).lit(), 9 * 8 * 4);
    }

    #[test]
    fn more_strokes_than_fit_the_first_buffer_are_all_drawn() {
        let test = "more_strokes_than_fit_the_first_buffer_are_all_drawn";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let pixel = |x: u32, y: u32| {
            let (left, middle) = (x as f32, y as f32 + 0.5);
            Stroke { cap: Cap::Butt, ..line([left, middle], [left + 1.0, middle], 0.5) }
        };
        let strokes: Vec<Stroke> =
            (0..64).flat_map(|y| (0..64).map(move |x| pixel(x, y))).collect();
        assert_eq!(draw(&gpu, &strokes).lit(), 64 * 64);
    }
}
