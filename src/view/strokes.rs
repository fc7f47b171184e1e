//! Strokes: every line, dot, fill and curve of a plot, as triangles of one kind.
//!
//! A vertex has the width of its line there, and its place across and along the line, in pixels. From these an
//! executor computes how much of a pixel is covered.

use egui::{Color32, Pos2, Vec2, vec2};

use super::drawing::{Mesh, StrokeVertex};
use super::lines::{Joint, length, unit};

/// Minimum cosine of the turn at a mitred corner. At a sharper corner the tip would stick out.
const MIN_MITRE_COSINE: f32 = 0.0;
/// Reach of a line's triangles beyond its edge, in pixels: half a pixel of blur, and a little for the corners of
/// pixels.
const MARGIN_PX: f32 = 1.0;
/// Distance between the dashes of a line that has only one, in pixels: longer than any line.
const FAR_PX: f32 = 1e9;

/// Lines and fills as triangles.
pub(super) type StrokeMesh = Mesh<StrokeVertex>;

impl StrokeMesh {
    /// Adds a filled outline, with its edge blurred over a pixel. The whole outline must be visible from the mean of
    /// its corners.
    pub(super) fn fill(&mut self, corners: &[(Pos2, Color32)], px_per_point: f32) {
        /// Wider than a pixel on both sides, so all of it is covered.
        const WHOLE_PX: [f32; 2] = [1.0, 0.0];
        let count = corners.len();
        if count < 3 {
            return;
        }
        let first = self.vertices.len() as u32;
        let mut add = |at: Pos2, colour: Color32| {
            let (at, along_px) = (at.into(), [0.0, 0.0, FAR_PX]);
            self.vertices.push(StrokeVertex { at, across_px: WHOLE_PX, along_px, colour });
        };
        let mean = |channel: usize| {
            let sum: u32 = corners.iter().map(|(_, colour)| u32::from(colour[channel])).sum();
            (sum / count as u32) as u8
        };
        let middle =
            corners.iter().fold(Vec2::ZERO, |sum, (at, _)| sum + at.to_vec2()) / count as f32;
        let middle = middle.to_pos2();
        add(middle, Color32::from_rgba_premultiplied(mean(0), mean(1), mean(2), mean(3)));
        for (i, &(at, colour)) in corners.iter().enumerate() {
            let [before, after] = [i + count - 1, i + 1].map(|place| corners[place % count].0);
            let along = unit(after - before);
            let normal = vec2(along.y, -along.x);
            let out = if normal.dot(at - middle) < 0.0 { -normal } else { normal };
            let half = out * (0.5 / px_per_point);
            add(at - half, colour);
            add(at + half, Color32::TRANSPARENT);
        }
        for i in 0..count as u32 {
            let next = (i + 1) % count as u32;
            let [inner, outer] = [1, 2].map(|side| first + 2 * i + side);
            let [next_inner, next_outer] = [1, 2].map(|side| first + 2 * next + side);
            self.indices.extend([first, inner, next_inner]);
            self.indices.extend([inner, outer, next_inner, next_inner, outer, next_outer]);
        }
    }

    /// Adds a line as quads from joint to joint, mitred where they meet. Its dashes have round ends within the drawn
    /// length, which is in points like the gap. A line without a gap has round ends beyond its length, unless it is
    /// closed.
    pub(super) fn add(&mut self, mut line: Vec<Joint>, [drawn, gap]: [f32; 2], px_per_point: f32) {
        let [Some(&start), Some(&end)] = [line.first(), line.last()] else { return };
        let margin = MARGIN_PX / px_per_point;
        let is_closed = line.len() > 3 && start.at == end.at;
        let is_dashed = gap > 0.0;
        let dash = match is_dashed {
            true => drawn,
            false => line.windows(2).map(|ends| length(ends[1].at - ends[0].at)).sum::<f32>(),
        };
        let mut done = -0.5 * dash;
        if !is_dashed && !is_closed {
            round_end(&mut line, margin);
            line.reverse();
            round_end(&mut line, margin);
            line.reverse();
            done -= start.radius + margin;
        }
        self.vertices.reserve(2 * line.len());
        self.indices.reserve(6 * line.len());
        let vertices = &mut self.vertices;
        let mut add = |joint: Joint, normal: Vec2, along: f32| {
            let straight =
                if is_dashed { (0.5 * dash - joint.radius).max(0.0) } else { 0.5 * dash };
            let period_px = if is_dashed { (drawn + gap) * px_per_point } else { FAR_PX };
            for side in [1.0, -1.0] {
                let across = side * (joint.radius + margin);
                vertices.push(StrokeVertex {
                    at: (joint.at + normal * across).into(),
                    across_px: [joint.radius, across].map(|points| points * px_per_point),
                    along_px: [along * px_per_point, straight * px_per_point, period_px],
                    colour: joint.colour,
                });
            }
            vertices.len() as u32 - 2
        };
        // The pair of vertices that the next quad shares with the last.
        let mut shared = None;
        if let [first, second, .., last, _] = line[..]
            && is_closed
        {
            let [before, after] = [start.at - last.at, second.at - start.at].map(unit);
            shared = mitre(before, after).map(|normal| add(first, normal.rot90(), done));
        }
        for (index, ends) in line.windows(2).enumerate() {
            let along = unit(ends[1].at - ends[0].at);
            let from = shared.unwrap_or_else(|| add(ends[0], along.rot90(), done));
            done += length(ends[1].at - ends[0].at);
            let next = line.get(index + 2).or(line.get(1).filter(|_| is_closed));
            let next = next.map(|next| unit(next.at - ends[1].at));
            let mitre = next.and_then(|next| mitre(along, next));
            let to = add(ends[1], mitre.unwrap_or(along).rot90(), done);
            shared = mitre.map(|_| to);
            self.indices.extend([from, from + 1, to, to, from + 1, to + 1]);
        }
    }
}

/// Extends the end of a line by a half disc and `margin`.
fn round_end(line: &mut Vec<Joint>, margin: f32) {
    let [.., before, end] = line[..] else { return };
    let along = unit(end.at - before.at);
    // A dot may end in any direction.
    let out = if along == Vec2::ZERO { Vec2::X } else { along };
    let tip = Joint { at: end.at + out * (end.radius + margin), ..end };
    if (end.radius, end.colour) == (before.radius, before.colour) {
        line.pop();
    }
    line.push(tip);
}

/// Direction along the edge at a corner, as long as its mitre needs; `None` if the corner is too sharp.
fn mitre(before: Vec2, after: Vec2) -> Option<Vec2> {
    let turn = before.dot(after);
    (turn > MIN_MITRE_COSINE).then(|| (before + after) / (1.0 + turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::palette::Rgba;
    use crate::stage::{Path, PathPoint, Picture, Rect, Shape};
    use crate::tests::testing::{EVERYWHERE, Pixels, draw_picture};

    const SOLID: [f32; 2] = [1.0, 0.0];

    fn joint(at: [f32; 2]) -> Joint {
        Joint { at: at.into(), radius: 1.0, colour: Color32::WHITE }
    }

    fn mesh<const N: usize>(points: [[f32; 2]; N], dash: [f32; 2]) -> StrokeMesh {
        let mut mesh = StrokeMesh::default();
        mesh.add(points.map(joint).into(), dash, 1.0);
        mesh
    }

    fn path(points: &[([f32; 2], f32)], colour: Rgba) -> Path {
        let point = |&(at, radius)| PathPoint { at, radius, colour };
        Path { points: points.iter().map(point).collect(), dash: SOLID, clip: EVERYWHERE }
    }

    fn dot(at: [f32; 2], radius: f32, colour: Rgba) -> Path {
        path(&[(at, radius); 2], colour)
    }

    fn draw(scale: f32, paths: impl IntoIterator<Item = Path>) -> Pixels {
        let shapes = paths.into_iter().map(Shape::Path).collect();
        draw_picture([64, 64], scale, &Picture { shapes, ..Picture::default() })
    }

    #[test]
    fn quads_are_joined_at_the_corners_of_a_line_and_not_at_its_spikes() {
        let bend = mesh([[0.0, 0.0], [10.0, 0.0], [20.0, 5.0]], [6.0, 4.0]);
        assert_eq!((bend.vertices.len(), bend.indices.len()), (6, 12));
        let spike = mesh([[0.0, 0.0], [10.0, 0.0], [0.0, 1.0]], [6.0, 4.0]);
        assert_eq!((spike.vertices.len(), spike.indices.len()), (8, 12));
        for vertex in &bend.vertices {
            assert_eq!((vertex.across_px[0], vertex.across_px[1].abs()), (1.0, 2.0));
            assert_eq!(vertex.along_px[1..], [2.0, 10.0]);
        }
        let length = 10.0 + 125.0_f32.sqrt();
        assert_eq!([0, 2, 4].map(|i| bend.vertices[i].along_px[0]), [-3.0, 7.0, length - 3.0]);
        assert_eq!(bend.vertices[0].at, [0.0, -2.0]);
    }

    #[test]
    fn a_solid_line_has_room_for_round_ends_unless_it_is_closed() {
        let straight = mesh([[0.0, 0.0], [10.0, 0.0]], SOLID);
        assert_eq!((straight.vertices.len(), straight.indices.len()), (4, 6));
        assert_eq!([0, 2].map(|i| straight.vertices[i].at), [[-2.0, -2.0], [12.0, -2.0]]);
        assert_eq!([0, 2].map(|i| straight.vertices[i].along_px[0]), [-7.0, 7.0]);
        let square = mesh([[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 0.0]], SOLID);
        assert!(
            square.vertices.iter().all(|vertex| vertex.along_px[0].abs() <= vertex.along_px[1])
        );
        let mut taper = StrokeMesh::default();
        let wide = Joint { radius: 3.0, ..joint([10.0, 0.0]) };
        taper.add(vec![joint([0.0, 0.0]), wide], SOLID, 1.0);
        let ends = [0, 2, 4, 6].map(|i| taper.vertices[i].at[0]);
        assert_eq!((ends, taper.indices.len()), ([-2.0, 0.0, 10.0, 14.0], 18));
    }

    #[test]
    fn a_path_of_zero_length_is_a_disc() {
        let pixels = draw(1.0, [dot([32.0; 2], 10.0, [255; 4])]);
        let area = std::f32::consts::PI * 100.0;
        assert!((pixels.sum(0) - area).abs() < 0.01 * area, "{} of {area}", pixels.sum(0));
        for (x, y) in [(23, 31), (40, 32), (31, 23), (32, 40)] {
            assert_eq!(pixels.at(x, y), [255; 4], "({x}, {y}) is inside");
        }
        for (x, y) in [(23, 23), (40, 40), (20, 32), (43, 32)] {
            assert_eq!(pixels.at(x, y)[0], 0, "({x}, {y}) is outside");
        }
    }

    #[test]
    fn a_path_ends_in_half_a_disc_of_its_width_there() {
        let pixels = draw(1.0, [path(&[([16.0, 32.0], 12.0), ([52.0, 32.0], 2.0)], [255; 4])]);
        let width = |x| (0..64).filter(|&y| pixels.at(x, y)[0] > 127).count();
        assert!((23..=25).contains(&width(15)), "{}", width(15));
        assert!((3..=5).contains(&width(52)), "{}", width(52));
        assert!([2, 55].map(width) == [0; 2] && [5, 53].map(width).iter().all(|&wide| wide > 0));
        let widths = [16, 24, 32, 40, 48].map(width);
        assert!(widths.is_sorted_by(|a, b| a > b), "{widths:?}");
    }

    #[test]
    fn dashes_are_round_and_of_the_right_length() {
        let solid = path(&[([0.0, 32.0], 4.0), ([64.0, 32.0], 4.0)], [255; 4]);
        let pixels = draw(1.0, [Path { dash: [20.0, 12.0], ..solid }]);
        let row = |y| (0..64).filter(|&x| pixels.at(x, y)[0] > 127).count();
        assert_eq!([31, 32].map(row), [40; 2]);
        assert!((30..=34).contains(&row(28)), "{}", row(28));
        assert!((20..32).all(|x| pixels.at(x, 32)[0] < 128));
    }

    #[test]
    fn a_closed_translucent_path_covers_each_pixel_once() {
        let corners =
            [[32.0, 8.0], [56.0, 24.0], [48.0, 52.0], [16.0, 52.0], [8.0, 24.0], [32.0, 8.0]];
        let ring = path(&corners.map(|at| (at, 4.0)), [255, 255, 255, 128]);
        let pixels = draw(1.0, [ring]);
        assert_eq!(pixels.rows.chunks_exact(4).map(|pixel| pixel[0]).max(), Some(128));
    }

    #[test]
    fn later_strokes_lie_over_earlier_ones() {
        let (red, green) = ([255, 0, 0, 255], [0, 255, 0, 128]);
        let drawn = |colours: [Rgba; 2]| {
            draw(1.0, colours.map(|colour| dot([32.0; 2], 6.0, colour))).at(32, 32)
        };
        assert_eq!(drawn([green, red]), red);
        let [r, g, b, a] = drawn([red, green]);
        assert!(r.abs_diff(127) <= 1 && g.abs_diff(128) <= 1, "{r} {g}");
        assert_eq!([b, a], [0, 255]);
    }

    #[test]
    fn the_scale_sets_the_pixels_per_point() {
        let across = path(&[([-9.0, 8.0], 2.0), ([80.0, 8.0], 2.0)], [255; 4]);
        let clip = Rect { min: [4.0, 0.0], max: [12.0, 64.0] };
        let lit = |scale: f32| draw(scale, [Path { clip, ..across.clone() }]).count_lit();
        assert_eq!((lit(1.0), lit(3.0)), (8 * 4, 9 * 8 * 4));
    }

    #[test]
    fn more_strokes_than_fit_the_first_buffer_are_all_drawn() {
        let pixel = |x: u8, y: u8| dot([x, y].map(|side| f32::from(side) + 0.5), 0.5, [255; 4]);
        let pixels = (0..64).flat_map(|y| (0..64).map(move |x| pixel(x, y)));
        assert_eq!(draw(1.0, pixels).count_lit(), 64 * 64);
    }
}
