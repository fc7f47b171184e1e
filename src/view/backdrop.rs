//! The static bottom of the stage, such as water, depth lines and quay. It is drawn once into a texture and copied
//! from there into each frame.

use super::gpu::Gpu;
use super::screen_transform::ScreenTransform;
use super::textures::{takes_copies, texture};
use crate::stage::{Picture, Sea, Shape};

/// The texture is redrawn once it could cover this many more shapes, and they have stayed still for this many frames.
const WORTH_DRAWING: (usize, u32) = (16, 8);

/// Finds the static part of a picture and keeps it as a texture.
#[derive(Debug)]
pub(super) struct Backdrop {
    format: wgpu::TextureFormat,
    /// Sea and shapes of the previous frame.
    last: Option<Scenery>,
    /// Number of shapes on the texture.
    drawn: Option<usize>,
    /// Number of frames in a row in which the texture could have covered many more shapes.
    frames_with_more: u32,
    /// Has the size and format of the target.
    texture: Option<wgpu::Texture>,
}

#[derive(Debug)]
struct Scenery {
    transform: ScreenTransform,
    sea: Sea,
    shapes: Vec<Shape>,
}

/// Number of a picture's shapes, from the bottom, that the backdrop covers besides the sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Covered {
    /// There is no backdrop.
    Nothing,
    /// The backdrop has yet to be drawn, with this number of shapes.
    Drawing(usize),
    /// The backdrop shows this number of shapes.
    Drawn(usize),
}

impl Covered {
    pub(super) fn shapes(self) -> usize {
        match self {
            Covered::Nothing => 0,
            Covered::Drawing(shapes) | Covered::Drawn(shapes) => shapes,
        }
    }
}

impl Backdrop {
    pub(super) fn new(format: wgpu::TextureFormat) -> Self {
        Self { format, last: None, drawn: None, frames_with_more: 0, texture: None }
    }

    /// Decides which part of the picture the backdrop covers: none if the texture cannot be copied to the target.
    pub(super) fn choose_cover(
        &mut self,
        gpu: &Gpu,
        target: &wgpu::Texture,
        transform: &ScreenTransform,
        picture: &Picture,
    ) -> Covered {
        let alike = self.last.as_ref().and_then(|last| last.matching_shapes(transform, picture));
        let Some(alike) = alike.filter(|_| takes_copies(target, self.format)) else {
            self.drawn = None;
            return Covered::Nothing;
        };
        if let Some(shapes) = self.drawn.filter(|shapes| *shapes <= alike) {
            let is_more = alike >= shapes + WORTH_DRAWING.0;
            self.frames_with_more = if is_more { self.frames_with_more + 1 } else { 0 };
            if self.frames_with_more < WORTH_DRAWING.1 {
                return Covered::Drawn(shapes);
            }
        }
        self.frames_with_more = 0;
        self.drawn = Some(alike);
        if self.texture.as_ref().is_none_or(|texture| texture.size() != target.size()) {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
            self.texture = Some(texture(gpu, "backdrop", transform.size_px, self.format, usage));
        }
        Covered::Drawing(alike)
    }

    /// Keeps the picture to compare the next one with.
    pub(super) fn keep_picture(
        &mut self,
        transform: ScreenTransform,
        Picture { sea, shapes, .. }: Picture,
    ) {
        self.last = sea.map(|sea| Scenery { transform, sea, shapes });
    }

    /// The view to draw the backdrop on.
    pub(super) fn view(&self) -> Option<wgpu::TextureView> {
        let texture = self.texture.as_ref()?;
        Some(texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// Copies the backdrop over the whole target.
    pub(super) fn copy(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::Texture) {
        if let Some(texture) = &self.texture {
            let (from, to) = (texture.as_image_copy(), target.as_image_copy());
            encoder.copy_texture_to_texture(from, to, target.size());
        }
    }
}

impl Scenery {
    /// Number of shapes, from the bottom, that match the picture's; `None` if the sea or the transform differs.
    fn matching_shapes(&self, transform: &ScreenTransform, picture: &Picture) -> Option<usize> {
        (self.transform == *transform && Some(self.sea) == picture.sea).then(|| {
            let pairs = self.shapes.iter().zip(&picture.shapes);
            pairs.take_while(|(one, other)| one == other).count()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::palette::Rgba;
    use crate::stage::{Path, PathPoint, Rect};
    use crate::view::Offscreen;
    use crate::view::stage::{Stage, StageRenderer};
    use crate::view::testing::{EVERYWHERE, draw_next, draw_picture, gpu_or_skip};

    /// Water with this number of pale lines across it, and over them another line at height `own`.
    fn picture(top: Rgba, lines: usize, own: f32) -> Picture {
        let rect = Rect { min: [0.0; 2], max: [64.0; 2] };
        let line = |y: f32, colour| {
            let points =
                [[3.0, y], [60.0, y + 2.3]].map(|at| PathPoint { at, radius: 1.3, colour });
            Shape::Path(Path { points: points.into(), dash: [1.0, 0.0], clip: EVERYWHERE })
        };
        let pale = (0..lines).map(|place| line(2.0 * place as f32, [120, 200, 255, 90]));
        Picture {
            sea: Some(Sea { rect, colours: [top, [10, 20, 30, 255]] }),
            shapes: pale.chain([line(own, [255, 120, 0, 130])]).collect(),
            ..Picture::default()
        }
    }

    #[test]
    fn a_backdrop_changes_no_pixel() {
        let Some(gpu) = gpu_or_skip("a_backdrop_changes_no_pixel") else { return };
        let mut renderer = StageRenderer::new(&gpu, Offscreen::FORMAT);
        let [blue, grey] = [[40, 60, 90, 255], [70, 70, 70, 255]];
        let moving = |n: u8| (blue, 25, 0.5 * f32::from(n));
        let mut frames: Vec<(Rgba, usize, f32)> = (0..4).map(moving).collect();
        // Everything rests for longer than it takes to draw the backdrop, then something moves.
        frames.extend([moving(4); 12]);
        frames.extend((5..8).map(moving));
        frames.extend([
            (grey, 25, 1.0),
            (grey, 25, 2.0),
            (grey, 3, 2.0),
            (grey, 3, 3.0),
            (grey, 30, 3.0),
        ]);
        for (n, (top, lines, own)) in frames.into_iter().enumerate() {
            let picture = picture(top, lines, own);
            let size_px = if n % 7 == 6 { [48, 64] } else { [64, 64] };
            if n % 5 == 1 {
                // A frame that is laid out and never shown.
                let target = Offscreen::new(&gpu, size_px).unwrap().texture;
                let rect = egui::Rect::from_min_size(
                    egui::Pos2::ZERO,
                    size_px.map(|side| side as f32).into(),
                );
                let stage = Stage { rect, picture: picture.clone() };
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                renderer.prepare(&gpu, &mut encoder, &target, stage, 1.0);
            }
            let drawn = draw_next(&gpu, &mut renderer, size_px, 1.0, &picture);
            assert!(drawn.rows == draw_picture(&gpu, size_px, 1.0, &picture).rows, "frame {n}");
        }
    }

    #[test]
    fn an_unchanged_backdrop_is_drawn_once_and_grows_with_its_unchanged_part() {
        let test = "an_unchanged_backdrop_is_drawn_once_and_grows_with_its_unchanged_part";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let target = Offscreen::new(&gpu, [64; 2]).unwrap().texture;
        let mut backdrop = Backdrop::new(Offscreen::FORMAT);
        let edges_px = [0.0, 0.0, 64.0, 64.0];
        let transform =
            ScreenTransform { size_px: [64; 2], origin_px: [0.0; 2], px_per_point: 1.0, edges_px };
        let mut cover = |lines, own| {
            let picture = picture([40, 60, 90, 255], lines, own);
            let covered = backdrop.choose_cover(&gpu, &target, &transform, &picture);
            backdrop.keep_picture(transform, picture);
            covered
        };
        assert_eq!(cover(25, 0.0), Covered::Nothing);
        assert_eq!(cover(25, 1.0), Covered::Drawing(25));
        assert_eq!(cover(25, 2.0), Covered::Drawn(25));
        assert_eq!(cover(9, 2.0), Covered::Drawing(9));
        assert_eq!(cover(30, 2.0), Covered::Drawn(9));
        let covered: Vec<Covered> = (0..9).map(|n| cover(30, 3.0 + n as f32)).collect();
        let mut expected = vec![Covered::Drawn(9); 9];
        expected[7] = Covered::Drawing(30);
        expected[8] = Covered::Drawn(30);
        assert_eq!(covered, expected);
    }
}
