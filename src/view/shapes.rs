//! The shapes of a picture, in painting order: lines through points, and filled outlines.

use egui::Rect;

use super::drawing::{Draw, DrawKind, Drawing, Place};
use super::lines::{Joint, visible_runs};
use super::screen_transform::ScreenTransform;
use super::strokes::StrokeMesh;
use super::theme::colour;
use crate::stage;
use crate::stage::{PathPoint, Shape};

fn clip(shape: &Shape) -> stage::Rect {
    match shape {
        Shape::Path(path) => path.clip,
        Shape::Fill(fill) => fill.clip,
    }
}

/// Adds shapes of the stage over everything in the drawing.
pub(super) fn draw_shapes(drawing: &mut Drawing, shapes: &[Shape], transform: &ScreenTransform) {
    for run in shapes.chunk_by(|a, b| clip(a) == clip(b)) {
        let Some(scissor_px) = transform.scissor_px(clip(&run[0])) else { continue };
        let first = drawing.strokes.indices.len() as u32;
        run.iter().for_each(|shape| add(&mut drawing.strokes, shape, transform));
        let indices = first..drawing.strokes.indices.len() as u32;
        let (place, kind) = (Place::Stage, DrawKind::Stroke);
        drawing.draws.push(Draw { scissor_px, place, kind, indices });
    }
}

fn add(mesh: &mut StrokeMesh, shape: &Shape, transform: &ScreenTransform) {
    let window = clip(shape);
    let window = Rect::from_min_max(window.min.into(), window.max.into());
    match shape {
        Shape::Path(path) => {
            let widest = path.points.iter().map(|point| point.radius).fold(0.0, f32::max);
            // Half a pixel more for the blur.
            let window = window.expand(widest + 0.5 / transform.px_per_point);
            for run in visible_runs(path.points.iter().map(joint), window) {
                mesh.add(run, path.dash, transform.px_per_point);
            }
        }
        Shape::Fill(fill) => {
            let corners = fill.corners.iter().map(|&(at, rgba)| (at.into(), colour(rgba)));
            mesh.fill(&corners.collect::<Vec<_>>(), transform.px_per_point);
        }
    }
}

fn joint(point: &PathPoint) -> Joint {
    Joint { at: point.at.into(), radius: point.radius, colour: colour(point.colour) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::{Fill, Path, Picture};
    use crate::tests::testing::{EVERYWHERE, Pixels, draw_picture};

    const SOLID: [f32; 2] = [1.0, 0.0];

    fn point(at: [f32; 2], radius: f32) -> PathPoint {
        PathPoint { at, radius, colour: [255; 4] }
    }

    fn draw(points: &[PathPoint], clip: stage::Rect) -> Pixels {
        let path = Path { points: points.to_vec(), dash: SOLID, clip };
        draw_picture(
            [64, 64],
            1.0,
            &Picture { shapes: vec![Shape::Path(path)], ..Picture::default() },
        )
    }

    #[test]
    fn a_path_covers_exactly_its_own_pixels() {
        let points = [[-5.0, 20.0], [40.0, 20.0], [69.0, 20.0]].map(|at| point(at, 2.0));
        let pixels = draw(&points, EVERYWHERE);
        for y in 0..64 {
            for x in 0..64 {
                let expected = if (18..22).contains(&y) { 255 } else { 0 };
                assert_eq!(pixels.at(x, y)[0], expected, "({x}, {y})");
            }
        }
    }

    #[test]
    fn no_pixel_is_drawn_twice_at_a_bend() {
        let points = [[-5.0, 20.0], [30.0, 20.0], [69.0, 50.0]]
            .map(|at| PathPoint { colour: [255, 255, 255, 128], ..point(at, 4.0) });
        let pixels = draw(&points, EVERYWHERE);
        assert_eq!(pixels.rows.chunks_exact(4).map(|pixel| pixel[0]).max(), Some(128));
    }

    #[test]
    fn nothing_is_drawn_outside_the_clip() {
        let clip = stage::Rect { min: [20.0, 30.0], max: [40.0, 34.0] };
        let pixels = draw(&[[-9e4, 32.0], [9e4, 32.0]].map(|at| point(at, 10.0)), clip);
        assert_eq!(pixels.count_lit(), 20 * 4);
        assert_eq!((pixels.at(20, 30)[0], pixels.at(39, 33)[0]), (255, 255));
    }

    #[test]
    fn width_and_colour_are_interpolated_between_points() {
        let red = PathPoint { colour: [255, 0, 0, 255], ..point([0.0, 32.0], 2.0) };
        let blue = PathPoint { colour: [0, 0, 255, 255], ..point([64.0, 32.0], 18.0) };
        let pixels = draw(&[red, blue], EVERYWHERE);
        let reds = [1, 16, 32, 48, 62].map(|x| pixels.at(x, 32)[0]);
        assert!(reds.is_sorted_by(|a, b| a > b), "{reds:?}");
        assert!(reds[2].abs_diff(127) <= 3, "{reds:?}");
        let width = |x| (0..64).filter(|&y| pixels.at(x, y)[..3] != [0, 0, 0]).count();
        assert!((19..=22).contains(&width(32)), "{}", width(32));
        assert!(width(8) < width(32) && width(32) < width(56));
    }

    #[test]
    fn thin_paths_fade_in_proportion() {
        for radius in [0.5, 0.25, 0.1] {
            let points = [[-10.0, 32.2], [74.0, 32.2]].map(|at| point(at, radius));
            let light = draw(&points, EVERYWHERE).sum(0);
            let expected = 64.0 * 2.0 * radius;
            assert!((light / expected - 1.0).abs() < 0.05, "{radius}: {light}");
        }
    }

    #[test]
    fn a_fill_covers_its_own_pixels_and_blends_its_corners() {
        let [black, white] = [[0, 0, 0, 255], [255; 4]];
        let corners = vec![
            ([10.0, 20.0], black),
            ([50.0, 20.0], white),
            ([50.0, 40.0], white),
            ([10.0, 40.0], black),
        ];
        let fill = |corners| Shape::Fill(Fill { corners, clip: EVERYWHERE });
        let drawn = |shape| {
            draw_picture([64, 64], 1.0, &Picture { shapes: vec![shape], ..Picture::default() })
        };
        let pixels = drawn(fill(corners.clone()));
        assert!((0..64).all(|x| pixels.at(x, 18)[0] == 0 && pixels.at(x, 41)[0] == 0));
        let row: Vec<u8> = [12, 20, 30, 40, 48].map(|x| pixels.at(x, 30)[0]).into();
        assert!(row.is_sorted_by(|a, b| a < b) && row[2].abs_diff(128) < 5, "{row:?}");
        let turned: Vec<_> = corners.iter().rev().copied().collect();
        let difference = drawn(fill(turned)).sum(0) - pixels.sum(0);
        assert!(
            difference.abs() < 1.0,
            "the direction of the corners does not matter: {difference}"
        );
        let solid = drawn(fill(corners.iter().map(|(at, _)| (*at, white)).collect()));
        assert!((solid.sum(0) - 40.0 * 20.0).abs() < 2.0, "{}", solid.sum(0));
    }

    #[test]
    fn later_shapes_lie_over_earlier_ones_of_every_kind() {
        let [green, blue] = [[0, 255, 0, 255], [0, 0, 255, 255]];
        let points =
            [[10.0, 32.0], [50.0, 32.0]].map(|at| PathPoint { at, radius: 6.0, colour: green });
        let path = Shape::Path(Path { points: points.into(), dash: SOLID, clip: EVERYWHERE });
        let corners = [[10.0, 26.0], [50.0, 26.0], [50.0, 38.0], [10.0, 38.0]];
        let fill =
            Shape::Fill(Fill { corners: corners.map(|at| (at, blue)).into(), clip: EVERYWHERE });
        for (shapes, expected) in
            [(vec![path.clone(), fill.clone()], blue), (vec![fill, path], green)]
        {
            let picture = Picture { shapes, ..Picture::default() };
            assert_eq!(draw_picture([64, 64], 1.0, &picture).at(30, 32), expected);
        }
    }
}
