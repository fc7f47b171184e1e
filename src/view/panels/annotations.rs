//! Annotations on a plot, namely tinted areas, arrows, and labels with a halo.

use egui::epaint::TextShape;
use egui::{Color32, Painter, Pos2, Shape, Stroke, Vec2};

use crate::theme::strong_font;

/// Width of the halo around a label, in points.
const HALO: f32 = 1.5;
/// Length of an arrow's head and half its width, both relative to the width of the shaft.
const HEAD: [f32; 2] = [4.0, 2.0];

/// Returns a convex polygon in one colour.
pub(super) fn polygon(points: impl IntoIterator<Item = Pos2>, colour: Color32) -> Shape {
    let mut mesh = egui::Mesh::default();
    points.into_iter().for_each(|at| mesh.colored_vertex(at, colour));
    for i in 2..mesh.vertices.len() as u32 {
        mesh.add_triangle(0, i - 1, i);
    }
    Shape::mesh(mesh)
}

/// Draws an arrow. A short arrow shrinks, because its head must fit.
pub(super) fn arrow(painter: &Painter, [from, to]: [Pos2; 2], width: f32, colour: Color32) {
    let along = to - from;
    let length = along.length();
    if length < 1.0 {
        return;
    }
    let width = width.min(length / (1.5 * HEAD[0]));
    let along = along / length;
    let neck = to - along * HEAD[0] * width;
    let side = along.rot90() * HEAD[1] * width;
    painter.line_segment([from, neck], Stroke::new(width, colour));
    painter.add(Shape::convex_polygon(vec![to, neck + side, neck - side], colour, Stroke::NONE));
}

/// Draws a label in strong type, centred at `at` and turned by `angle`, with a halo.
pub(super) fn label(
    painter: &Painter,
    (at, angle): (Pos2, f32),
    text: &str,
    [colour, halo]: [Color32; 2],
) {
    let galley = painter.layout_no_wrap(text.to_owned(), strong_font(12.0), colour);
    let half = galley.size() / 2.0;
    let corner = at - egui::emath::Rot2::from_angle(angle) * half;
    let write = |offset: Vec2, colour: Color32| {
        let shape = TextShape::new(corner + offset, galley.clone(), colour);
        painter.add(shape.with_angle(angle).with_override_text_color(colour));
    };
    for i in 0..8 {
        let angle = i as f32 * std::f32::consts::TAU / 8.0;
        write(HALO * Vec2::angled(angle), halo);
    }
    write(Vec2::ZERO, colour);
}

/// Mixes two colours: `part` 0 gives the first one, and 1 the second.
pub(super) fn mixed(from: Color32, to: Color32, part: f32) -> Color32 {
    let mix = |a: u8, b: u8| (f32::from(a) + part * (f32::from(b) - f32::from(a))).round() as u8;
    Color32::from_rgb(mix(from.r(), to.r()), mix(from.g(), to.g()), mix(from.b(), to.b()))
}
