//! Ribbons: trails and wakes, those of a cell in one draw.

use egui::Rect;

use super::gpu::Gpu;
use super::lines::{Joint, LineMesh, shown};
use super::place::Place;
use super::plot::colour;
use super::strips::{Strip, Strips};
use crate::lab::picture::{Ribbon, RibbonPoint};

/// The dash pattern of an unbroken line.
const SOLID: [f32; 2] = [1.0, 0.0];

/// Draws a picture's ribbons.
#[derive(Debug)]
pub(super) struct RibbonPipeline {
    strips: Strips,
    /// Left, top, width and height of what shows on the target, and the ribbons there.
    draws: Vec<([u32; 4], Strip)>,
}

impl RibbonPipeline {
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        Self { strips: Strips::new(gpu, layout, format), draws: Vec::new() }
    }

    pub(super) fn upload(&mut self, gpu: &Gpu, ribbons: &[Ribbon], place: &Place) {
        self.draws.clear();
        self.strips.clear();
        for of_cell in ribbons.chunk_by(|a, b| a.clip == b.clip) {
            let clip = of_cell[0].clip;
            let scissor_px = place.scissor_px(clip);
            if scissor_px[2] == 0 || scissor_px[3] == 0 {
                continue;
            }
            let mut mesh = LineMesh::new(SOLID);
            for ribbon in of_cell {
                let widest = ribbon.points.iter().map(|point| point.radius).fold(0.0, f32::max);
                let window = Rect::from_min_max(clip.min.into(), clip.max.into());
                // Half a pixel more for its blur.
                let window = window.expand(widest + 0.5 / place.px_per_point);
                for run in shown(ribbon.points.iter().map(joint), window) {
                    mesh.add(&run, place.px_per_point);
                }
            }
            self.draws.push((scissor_px, self.strips.add(&mesh)));
        }
        self.strips.upload(gpu);
    }

    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        for ([left, top, width, height], strip) in &self.draws {
            pass.set_scissor_rect(*left, *top, *width, *height);
            self.strips.draw(pass, strip);
        }
    }
}

fn joint(point: &RibbonPoint) -> Joint {
    Joint { at: point.at.into(), radius: point.radius, colour: colour(point.colour) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::picture::{self, Picture};
    use crate::view::testing::{EVERYWHERE, Pixels, draw_picture, gpu_or_skip};

    fn point(at: [f32; 2], radius: f32) -> RibbonPoint {
        RibbonPoint { at, radius, colour: [255; 4] }
    }

    fn draw(gpu: &Gpu, points: &[RibbonPoint], clip: picture::Rect) -> Pixels {
        let ribbons = vec![Ribbon { points: points.to_vec(), clip }];
        draw_picture(gpu, [64, 64], 1.0, &Picture { ribbons, ..Picture::default() })
    }

    #[test]
    fn a_ribbon_covers_its_own_pixels_and_no_others() {
        let Some(gpu) = gpu_or_skip("a_ribbon_covers_its_own_pixels_and_no_others") else { return };
        let points = [[-5.0, 20.0], [40.0, 20.0], [69.0, 20.0]].map(|at| point(at, 2.0));
        let pixels = draw(&gpu, &points, EVERYWHERE);
        for y in 0..64 {
            for x in 0..64 {
                let expected = if (18..22).contains(&y) { 255 } else { 0 };
                assert_eq!(pixels.at(x, y)[0], expected, "({x}, {y})");
            }
        }
    }

    #[test]
    fn where_a_ribbon_bends_nothing_is_drawn_twice() {
        let Some(gpu) = gpu_or_skip("where_a_ribbon_bends_nothing_is_drawn_twice") else { return };
        let points = [[-5.0, 20.0], [30.0, 20.0], [69.0, 50.0]]
            .map(|at| RibbonPoint { colour: [255, 255, 255, 128], ..point(at, 4.0) });
        let pixels = draw(&gpu, &points, EVERYWHERE);
        assert_eq!(pixels.rows.chunks_exact(4).map(|pixel| pixel[0]).max(), Some(128));
    }

    #[test]
    fn nothing_is_drawn_outside_the_clip() {
        let Some(gpu) = gpu_or_skip("nothing_is_drawn_outside_the_clip") else { return };
        let clip = picture::Rect { min: [20.0, 30.0], max: [40.0, 34.0] };
        let pixels = draw(&gpu, &[[-9e4, 32.0], [9e4, 32.0]].map(|at| point(at, 10.0)), clip);
        assert_eq!(pixels.lit(), 20 * 4);
        assert_eq!((pixels.at(20, 30)[0], pixels.at(39, 33)[0]), (255, 255));
    }

    #[test]
    fn width_and_colour_run_from_point_to_point() {
        let Some(gpu) = gpu_or_skip("width_and_colour_run_from_point_to_point") else { return };
        let red = RibbonPoint { colour: [255, 0, 0, 255], ..point([0.0, 32.0], 2.0) };
        let blue = RibbonPoint { colour: [0, 0, 255, 255], ..point([64.0, 32.0], 18.0) };
        let pixels = draw(&gpu, &[red, blue], EVERYWHERE);
        let reds = [1, 16, 32, 48, 62].map(|x| pixels.at(x, 32)[0]);
        assert!(reds.is_sorted_by(|a, b| a > b), "{reds:?}");
        assert!(reds[2].abs_diff(127) <= 3, "{reds:?}");
        let width = |x| (0..64).filter(|&y| pixels.at(x, y)[..3] != [0, 0, 0]).count();
        assert!((19..=22).contains(&width(32)), "{}", width(32));
        assert!(width(8) < width(32) && width(32) < width(56));
    }

    #[test]
    fn thin_ribbons_fade_in_proportion() {
        let Some(gpu) = gpu_or_skip("thin_ribbons_fade_in_proportion") else { return };
        for radius in [0.5, 0.25, 0.1] {
            let points = [[-10.0, 32.2], [74.0, 32.2]].map(|at| point(at, radius));
            let light = draw(&gpu, &points, EVERYWHERE).sum(0);
            let expected = 64.0 * 2.0 * radius;
            assert!((light / expected - 1.0).abs() < 0.05, "{radius}: {light}");
        }
    }
}
