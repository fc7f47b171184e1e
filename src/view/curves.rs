//! The curves of a plot.
//!
//! `egui_plot` makes a shape of every piece of a dash between two samples, seen or not: a hundred
//! thousand triangles for a race, most of them smaller than a pixel. Here a straight piece is two.

use std::sync::Arc;

use egui::epaint::{PaintCallback, PathStroke};
use egui::{Color32, Painter, Pos2, Rect, Shape, vec2};

use super::lines::{Joint, LineMesh, shown};
use super::plot::Curve;

/// A curve that covers more than this part of the room it takes is drawn solid: no pattern could be told.
const CROWDED: f32 = 0.5;
/// Added to that room on all sides, in points, for a curve that has only begun.
const BEGINNING: f32 = 8.0;
/// The radius of an arrow and its distance from the edges of the plot, in points.
const ARROW: f32 = 5.0;
const ARROW_INSET: f32 = 9.0;

/// Draws a curve's line through `points` on the screen, as far as the painter's clip shows it. What the
/// painter gets is a [`LineMesh`] for [`MeshRenderer`](super::meshes::MeshRenderer).
pub(super) fn paint(painter: &Painter, points: impl Iterator<Item = Pos2>, curve: &Curve) {
    let &Curve { colour, width, dash: [drawn, gap], .. } = curve;
    let joints = points.map(|at| Joint { at, radius: width / 2.0, colour });
    let runs = shown(joints, painter.clip_rect().expand(width));
    let is_solid = gap > 0.0 && is_crowded(&runs, width);
    let mut mesh = LineMesh::new([drawn, if is_solid { 0.0 } else { gap }]);
    runs.iter().for_each(|run| mesh.add(run, painter.pixels_per_point()));
    painter.add(PaintCallback { rect: painter.clip_rect(), callback: Arc::new(mesh) });
}

fn is_crowded(runs: &[Vec<Joint>], width: f32) -> bool {
    let pieces = runs.iter().flat_map(|run| run.windows(2));
    let length: f32 = pieces.map(|ends| ends[0].at.distance(ends[1].at)).sum();
    let points: Vec<Pos2> = runs.iter().flatten().map(|joint| joint.at).collect();
    length * width > CROWDED * Rect::from_points(&points).expand(BEGINNING).area()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_crowded_where_its_dashes_would_touch_each_other_sideways() {
        let run = |points: Vec<[f32; 2]>| -> Vec<Joint> {
            let joint = |at: [f32; 2]| Joint { at: at.into(), radius: 0.8, colour: Color32::WHITE };
            points.into_iter().map(joint).collect()
        };
        let waves = |count: usize| {
            let x = |i: usize| 400.0 * i as f32 / count as f32;
            run((0..=count).map(|i| [x(i), if i % 2 == 0 { 0.0 } else { 200.0 }]).collect())
        };
        assert!(!is_crowded(&[waves(40)], 1.6));
        assert!(is_crowded(&[waves(400)], 1.6));
        assert!(!is_crowded(&[run(vec![[0.0, 0.0], [1.0, 60.0]])], 1.6), "it has only begun");
        assert!(!is_crowded(&[], 1.6));
    }
}
