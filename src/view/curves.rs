//! The curves of a plot, as few shapes as show the same picture.
//!
//! `egui_plot` makes a shape of every piece of a dash between two samples, seen or not: a hundred
//! thousand triangles for a race, most of them smaller than a pixel. Here a straight piece is two.

use egui::epaint::{Mesh, PathStroke, Vertex};
use egui::{Color32, Painter, Pos2, Rect, Shape, Vec2, pos2, vec2};

use super::plot::Curve;

/// Added to half the width of a line in pixels, where other vertices have a place on the atlas; the
/// second coordinate is then the distance from the line's middle. As `LINE` in `shaders/panels.wgsl`.
const LINE: f32 = 2.0;
/// Corners sharper than this, the cosine of the turn, are not mitred: the point would stick out.
const SHARPEST_MITRE: f32 = 0.0;

/// How far a curve may be drawn from its samples, in points: less than anybody sees.
const TOLERANCE: f32 = 0.2;
/// The most samples that one straight piece stands for, so that finding it takes no longer.
const LONGEST_PIECE: usize = 32;
/// A curve that covers more than this part of the room it takes is drawn solid: no pattern could be told.
const CROWDED: f32 = 0.5;
/// Added to that room on all sides, in points, for a curve that has only begun.
const BEGINNING: f32 = 8.0;
/// The radius of an arrow and its distance from the edges of the plot, in points.
const ARROW: f32 = 5.0;
const ARROW_INSET: f32 = 9.0;

/// Draws a curve's line through `points` on the screen, as far as the painter's clip shows it.
pub(super) fn paint(painter: &Painter, points: impl Iterator<Item = Pos2>, curve: &Curve) {
    let &Curve { colour, width, dash: [drawn, gap], .. } = curve;
    let runs: Vec<Vec<Pos2>> =
        visible(points, painter.clip_rect().expand(width)).iter().map(|run| simple(run)).collect();
    let px_per_point = painter.pixels_per_point();
    let mut mesh = Mesh::default();
    if gap > 0.0 && !is_crowded(&runs, width) {
        for dash in runs.iter().flat_map(|run| dashes(run, drawn, gap)) {
            strip(&mut mesh, &dash, colour, width, px_per_point);
        }
    } else {
        runs.iter().for_each(|run| strip(&mut mesh, run, colour, width, px_per_point));
    }
    painter.add(Shape::mesh(mesh));
}

fn is_crowded(runs: &[Vec<Pos2>], width: f32) -> bool {
    let length: f32 = runs.iter().flat_map(|run| run.windows(2)).map(|w| w[0].distance(w[1])).sum();
    let points: Vec<Pos2> = runs.iter().flatten().copied().collect();
    length * width > CROWDED * Rect::from_points(&points).expand(BEGINNING).area()
}

/// Adds a line as quads from point to point, mitred where they meet.
fn strip(mesh: &mut Mesh, line: &[Pos2], colour: Color32, width: f32, px_per_point: f32) {
    let half_px = 0.5 * width * px_per_point;
    // Half a pixel of blur, and a little for the corners of pixels.
    let reach_px = half_px + 1.0;
    let mut add = |at: Pos2, normal: Vec2| {
        for across_px in [reach_px, -reach_px] {
            let pos = at + normal * (across_px / px_per_point);
            mesh.vertices.push(Vertex { pos, uv: pos2(LINE + half_px, across_px), color: colour });
        }
        mesh.vertices.len() as u32 - 2
    };
    let mut quads: Vec<[u32; 2]> = Vec::with_capacity(line.len());
    // The pair of vertices that the next quad shares with this one.
    let mut shared = None;
    for (index, ends) in line.windows(2).enumerate() {
        let along = (ends[1] - ends[0]).normalized();
        let from = shared.unwrap_or_else(|| add(ends[0], along.rot90()));
        let next = line.get(index + 2).map(|&next| (next - ends[1]).normalized());
        let mitre = next.filter(|&next| along.dot(next) > SHARPEST_MITRE);
        let normal = mitre.map_or(along, |next| (along + next) / (1.0 + along.dot(next))).rot90();
        let to = add(ends[1], normal);
        shared = mitre.map(|_| to);
        quads.push([from, to]);
    }
    for [from, to] in quads {
        mesh.indices.extend([from, from + 1, to, to, from + 1, to + 1]);
    }
}

/// An arrow at the top or the bottom edge, below or above the `newest` point of a curve that has left
/// the plot there.
pub(super) fn paint_arrow(painter: &Painter, newest: Pos2, colour: Color32) {
    let frame = painter.clip_rect();
    let (edge, up) = if newest.y < frame.top() {
        (frame.top() + ARROW_INSET, 1.0)
    } else if newest.y > frame.bottom() {
        (frame.bottom() - ARROW_INSET, -1.0)
    } else {
        return;
    };
    let at = Pos2::new(newest.x.clamp(frame.left(), frame.right() - ARROW), edge);
    let corner = |x: f32, y: f32| at + ARROW * vec2(x, -up * y);
    let corners = vec![corner(0.0, 1.0), corner(0.866, -0.5), corner(-0.866, -0.5)];
    painter.add(Shape::convex_polygon(corners, colour, PathStroke::NONE));
}

/// The runs of a curve within a window, cut off at its edges.
fn visible(points: impl Iterator<Item = Pos2>, window: Rect) -> Vec<Vec<Pos2>> {
    let mut runs: Vec<Vec<Pos2>> = Vec::new();
    let mut last: Option<Pos2> = None;
    for point in points {
        if let Some([from, to]) = last.and_then(|last| cut([last, point], window)) {
            match runs.last_mut() {
                Some(run) if run.last() == Some(&from) => run.push(to),
                _ => runs.push(vec![from, to]),
            }
        }
        last = Some(point);
    }
    runs
}

/// The part of a line within a window (Liang and Barsky).
fn cut([from, to]: [Pos2; 2], window: Rect) -> Option<[Pos2; 2]> {
    let along = to - from;
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for axis in 0..2 {
        let (low, high) = (window.min[axis] - from[axis], window.max[axis] - from[axis]);
        if along[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
        } else {
            let (a, b) = (low / along[axis], high / along[axis]);
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
    }
    // The ends themselves where they are within: runs are joined by them.
    let at = |part: f32| match part {
        0.0 => from,
        1.0 => to,
        _ => from + part * along,
    };
    (first <= last).then(|| [at(first), at(last)])
}

/// The same line with fewer points, nowhere further than [`TOLERANCE`] from those left out.
fn simple(line: &[Pos2]) -> Vec<Pos2> {
    let Some(&first) = line.first() else { return Vec::new() };
    let mut kept = vec![first];
    let (mut from, mut to) = (0, 1);
    while to < line.len() {
        let fits = |end: usize| {
            let between = &line[from + 1..end];
            between.iter().all(|&point| distance(point, [line[from], line[end]]) <= TOLERANCE)
        };
        while to + 1 < line.len() && to - from < LONGEST_PIECE && fits(to + 1) {
            to += 1;
        }
        kept.push(line[to]);
        (from, to) = (to, to + 1);
    }
    kept
}

fn distance(point: Pos2, [from, to]: [Pos2; 2]) -> f32 {
    let along = to - from;
    let part = (point - from).dot(along) / along.length_sq().max(f32::MIN_POSITIVE);
    point.distance(from + part.clamp(0.0, 1.0) * along)
}

/// The dashes of a line, each round whatever corners it has.
fn dashes(line: &[Pos2], drawn: f32, gap: f32) -> Vec<Vec<Pos2>> {
    let mut dashes = Vec::new();
    let mut dash: Vec<Pos2> = line.iter().take(1).copied().collect();
    let (mut drawing, mut left) = (true, drawn);
    for ends in line.windows(2) {
        let length = ends[0].distance(ends[1]);
        let mut done = 0.0;
        while length - done >= left {
            done += left;
            dash.push(ends[0].lerp(ends[1], done / length));
            if drawing {
                dashes.push(std::mem::take(&mut dash));
            }
            drawing = !drawing;
            left = if drawing { drawn } else { gap };
        }
        left -= length - done;
        if drawing {
            dash.push(ends[1]);
        }
    }
    if drawing && dash.len() > 1 {
        dashes.push(dash);
    }
    dashes
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn length(line: &[Pos2]) -> f32 {
        line.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    #[test]
    fn a_curve_is_cut_off_at_the_window_and_taken_up_again_where_it_returns() {
        let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let curve = [[1.0, 5.0], [2.0, 5.0], [2.0, 25.0], [4.0, 25.0], [4.0, 5.0], [20.0, 5.0]];
        let runs = visible(curve.iter().copied().map(Pos2::from), window);
        let expected =
            [[[1.0, 5.0], [2.0, 5.0], [2.0, 10.0]], [[4.0, 10.0], [4.0, 5.0], [10.0, 5.0]]];
        assert_eq!(runs, expected.map(|run| run.map(Pos2::from).to_vec()));
        let outside = [[-5.0, -5.0], [-1.0, 20.0], [20.0, 40.0]].map(Pos2::from);
        assert!(visible(outside.into_iter(), window).is_empty());
    }

    #[test]
    fn a_simpler_line_keeps_its_ends_its_spikes_and_within_the_tolerance_all_else() {
        let mut line: Vec<Pos2> =
            (0..400).map(|i| i as f32 / 8.0).map(|x| pos2(x, 20.0 * (x / 5.0).sin())).collect();
        line[200].y += 30.0;
        let kept = simple(&line);
        assert!(kept.len() < line.len() / 4, "{} of {}", kept.len(), line.len());
        assert_eq!((kept.first(), kept.last()), (line.first(), line.last()));
        assert!(kept.contains(&line[200]));
        for &point in &line {
            let nearest =
                kept.windows(2).map(|ends| distance(point, [ends[0], ends[1]])).fold(9.0, f32::min);
            assert!(nearest <= TOLERANCE, "{point:?} is {nearest} off");
        }
    }

    #[test]
    fn dashes_and_gaps_are_as_long_as_asked_for_round_corners_too() {
        let line = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(Pos2::from);
        let dashes = dashes(&line, 8.0, 4.0);
        let lengths: Vec<f32> = dashes.iter().map(|dash| length(dash)).collect();
        assert_eq!(lengths, [8.0, 8.0, 6.0]);
        assert_eq!(dashes[1], [[10.0, 2.0], [10.0, 10.0]].map(Pos2::from));
        assert_eq!(dashes[2].first(), Some(&pos2(6.0, 10.0)));
    }

    #[test]
    fn a_curve_is_crowded_where_its_dashes_would_touch_each_other_sideways() {
        let waves = |count: usize| -> Vec<Pos2> {
            let x = |i: usize| 400.0 * i as f32 / count as f32;
            (0..=count).map(|i| pos2(x(i), if i % 2 == 0 { 0.0 } else { 200.0 })).collect()
        };
        assert!(!is_crowded(&[waves(40)], 1.6));
        assert!(is_crowded(&[waves(400)], 1.6));
        assert!(!is_crowded(&[vec![pos2(0.0, 0.0), pos2(1.0, 60.0)]], 1.6), "it has only begun");
        assert!(!is_crowded(&[], 1.6));
    }

    #[test]
    fn quads_are_joined_at_the_corners_of_a_line_and_not_at_its_spikes() {
        let strip_of = |line: &[[f32; 2]]| {
            let line: Vec<Pos2> = line.iter().copied().map(Pos2::from).collect();
            let mut mesh = Mesh::default();
            strip(&mut mesh, &line, Color32::WHITE, 2.0, 1.0);
            mesh
        };
        let bend = strip_of(&[[0.0, 0.0], [10.0, 0.0], [20.0, 5.0]]);
        assert_eq!((bend.vertices.len(), bend.indices.len()), (6, 12));
        let spike = strip_of(&[[0.0, 0.0], [10.0, 0.0], [0.0, 1.0]]);
        assert_eq!((spike.vertices.len(), spike.indices.len()), (8, 12));
        for vertex in &bend.vertices {
            assert_eq!((vertex.uv.x, vertex.uv.y.abs()), (LINE + 1.0, 2.0));
        }
        assert_eq!(bend.vertices[0].pos.distance(bend.vertices[1].pos), 4.0);
    }

    #[test]
    fn a_dash_has_the_corners_of_its_line() {
        let line = [[0.0, 0.0], [5.0, 0.0], [5.0, 9.0]].map(Pos2::from);
        assert_eq!(
            dashes(&line, 10.0, 2.0)[0],
            [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]].map(Pos2::from)
        );
    }
}
