//! The static bottom of the stage, such as water, depth lines and quay. An executor keeps its pixels and copies them
//! into each frame.

use super::screen_transform::ScreenTransform;
use crate::stage::{Picture, Sea, Shape};

/// A backdrop is replaced once it could cover this many more shapes, and they have stayed still for this many frames.
const WORTH_DRAWING: (usize, u32) = (16, 8);

/// Finds the static part of pictures that follow each other.
#[derive(Debug, Default)]
pub(super) struct BackdropFinder {
    /// Sea and shapes of the previous frame.
    last: Option<Scenery>,
    current: Option<Cover>,
    /// Number of backdrops so far.
    found: u64,
    /// Number of frames in a row in which the backdrop could have covered many more shapes.
    frames_with_more: u32,
}

#[derive(Debug)]
struct Scenery {
    transform: ScreenTransform,
    sea: Sea,
    shapes: Vec<Shape>,
}

/// The shapes of a picture, from the bottom, that the backdrop covers besides the sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cover {
    /// [`Backdrop::id`](super::drawing::Backdrop::id).
    pub(super) id: u64,
    pub(super) shapes: usize,
}

impl BackdropFinder {
    /// The part of the picture that the backdrop covers; `None` if nothing of it has stayed the same.
    pub(super) fn choose_cover(
        &mut self,
        transform: &ScreenTransform,
        picture: &Picture,
    ) -> Option<Cover> {
        let alike = self.last.as_ref().and_then(|last| last.matching_shapes(transform, picture));
        let Some(alike) = alike else {
            self.current = None;
            return None;
        };
        if let Some(current) = self.current.filter(|current| current.shapes <= alike) {
            let is_more = alike >= current.shapes + WORTH_DRAWING.0;
            self.frames_with_more = if is_more { self.frames_with_more + 1 } else { 0 };
            if self.frames_with_more < WORTH_DRAWING.1 {
                return self.current;
            }
        }
        self.frames_with_more = 0;
        self.found += 1;
        self.current = Some(Cover { id: self.found, shapes: alike });
        self.current
    }

    /// Keeps the picture to compare the next one with.
    pub(super) fn keep_picture(
        &mut self,
        transform: ScreenTransform,
        Picture { sea, shapes, .. }: Picture,
    ) {
        self.last = sea.map(|sea| Scenery { transform, sea, shapes });
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
    use crate::tests::testing::{EVERYWHERE, draw_picture, executor, paint, stage_alone};

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
        let mut executor = executor();
        let mut backdrops = BackdropFinder::default();
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
            let drawing = stage_alone(&mut backdrops, size_px, 1.0, &picture);
            if n % 5 != 1 {
                let drawn = paint(&mut executor, &drawing);
                let alone = draw_picture(size_px, 1.0, &picture);
                assert!(drawn.rows == alone.rows, "frame {n}");
            }
        }
    }

    #[test]
    fn an_unchanged_backdrop_is_drawn_once_and_grows_with_its_unchanged_part() {
        let mut backdrops = BackdropFinder::default();
        let edges_px = [0.0, 0.0, 64.0, 64.0];
        let transform =
            ScreenTransform { size_px: [64; 2], origin_px: [0.0; 2], px_per_point: 1.0, edges_px };
        let mut cover = |lines, own| {
            let picture = picture([40, 60, 90, 255], lines, own);
            let cover = backdrops.choose_cover(&transform, &picture);
            backdrops.keep_picture(transform, picture);
            cover.map(|cover| (cover.id, cover.shapes))
        };
        assert_eq!(cover(25, 0.0), None);
        assert_eq!(cover(25, 1.0), Some((1, 25)));
        assert_eq!(cover(25, 2.0), Some((1, 25)));
        assert_eq!(cover(9, 2.0), Some((2, 9)));
        assert_eq!(cover(30, 2.0), Some((2, 9)));
        let covers: Vec<_> = (0..9).map(|n| cover(30, 3.0 + n as f32)).collect();
        let mut expected = vec![Some((2, 9)); 7];
        expected.extend([Some((3, 30)); 2]);
        assert_eq!(covers, expected);
    }
}
