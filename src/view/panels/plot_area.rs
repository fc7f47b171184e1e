//! A plot that a panel paints by itself: a frame, marks along two axes, arrows and labels.

use egui::epaint::TextShape;
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2,
};
use egui_plot::{GridInput, GridMark};

use crate::lab::number::{round, superscript};
use crate::view::theme::{Ink, strong_font};
use crate::view::ticks;

/// The height of a number at an axis, in points.
const NUMBER: f32 = 11.0;
/// The width of the halo of a label, in points.
const HALO: f32 = 1.5;
/// The length of an arrow's head and half its width, in widths of its shaft.
const HEAD: [f32; 2] = [4.0, 2.0];

/// A rectangle of the screen that shows a rectangle of a plane.
pub(super) struct PlotArea {
    pub(super) rect: Rect,
    /// The least and the greatest value along each axis.
    pub(super) bounds: [[f64; 2]; 2],
}

impl PlotArea {
    /// The place on the screen of a point of the plane.
    pub(super) fn at(&self, point: [f64; 2]) -> Pos2 {
        // A point far outside stays outside, and fits the f32 of the painter.
        let [x, y] = std::array::from_fn(|axis| {
            let [low, high] = self.bounds[axis];
            ((point[axis] - low) / (high - low)).clamp(-30.0, 30.0) as f32
        });
        pos2(self.rect.left() + x * self.rect.width(), self.rect.bottom() - y * self.rect.height())
    }

    /// The lengths on the screen of a difference between two points: to the right and up.
    pub(super) fn lengths(&self, difference: [f64; 2]) -> [f64; 2] {
        let size = [self.rect.width(), self.rect.height()].map(f64::from);
        std::array::from_fn(|axis| {
            let [low, high] = self.bounds[axis];
            difference[axis] / (high - low) * size[axis]
        })
    }

    /// The point of the plane at a place on the screen, which is moved into the rectangle.
    pub(super) fn point(&self, at: Pos2) -> [f64; 2] {
        let at = self.rect.clamp(at);
        let parts = [
            (at.x - self.rect.left()) / self.rect.width(),
            (self.rect.bottom() - at.y) / self.rect.height(),
        ];
        std::array::from_fn(|axis| {
            let [low, high] = self.bounds[axis];
            low + (high - low) * f64::from(parts[axis])
        })
    }

    /// Round marks along an axis with their numbers, at least `apart` points apart as long as there are three.
    pub(super) fn marks(&self, axis: usize, apart: f64) -> Vec<(f64, String)> {
        let [low, high] = self.bounds[axis];
        let room = if axis == 0 { self.rect.width() } else { self.rect.height() };
        let base_step_size = ticks::FINEST * (high - low) / f64::from(room);
        let marks = ticks::linear(GridInput { bounds: (low, high), base_step_size }, apart);
        let text = |mark: GridMark| ticks::linear_label(mark, &(low..=high), "");
        marks.into_iter().map(|mark| (mark.value, text(mark))).collect()
    }

    /// Paints the marks of both axes with their numbers, and a grid line at each.
    pub(super) fn axes(&self, painter: &Painter, ink: &Ink, marks: [&[(f64, String)]; 2]) {
        let (line, font) = (Stroke::new(1.0, ink.grid), FontId::proportional(NUMBER));
        for (x, text) in marks[0] {
            let at = self.at([*x, self.bounds[1][0]]);
            painter.vline(at.x, self.rect.y_range(), line);
            let at = at + vec2(0.0, 4.0);
            painter.text(at, Align2::CENTER_TOP, text, font.clone(), ink.dim);
        }
        for (y, text) in marks[1] {
            let at = self.at([self.bounds[0][0], *y]);
            painter.hline(self.rect.x_range(), at.y, line);
            let at = at - vec2(6.0, 0.0);
            painter.text(at, Align2::RIGHT_CENTER, text, font.clone(), ink.dim);
        }
        painter.rect_stroke(self.rect, 0.0, Stroke::new(1.0, ink.line), StrokeKind::Inside);
    }
}

/// A convex polygon in one colour.
pub(super) fn polygon(points: impl IntoIterator<Item = Pos2>, colour: Color32) -> Shape {
    let mut mesh = egui::Mesh::default();
    points.into_iter().for_each(|at| mesh.colored_vertex(at, colour));
    for i in 2..mesh.vertices.len() as u32 {
        mesh.add_triangle(0, i - 1, i);
    }
    Shape::mesh(mesh)
}

/// An arrow. One that is shorter than its head is a smaller arrow.
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

/// A label in strong type whose middle is at `at`, turned by `angle`, with a halo.
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

/// A colour between two, `part` of the way to the second.
pub(super) fn mixed(from: Color32, to: Color32, part: f32) -> Color32 {
    let mix = |a: u8, b: u8| (f32::from(a) + part * (f32::from(b) - f32::from(a))).round() as u8;
    Color32::from_rgb(mix(from.r(), to.r()), mix(from.g(), to.g()), mix(from.b(), to.b()))
}

/// Round marks on a logarithmic axis whose values are common logarithms: powers of ten, and 2 and 5 times them where
/// they are `apart` from each other.
pub(super) fn decades([low, high]: [f64; 2], room: f32, apart: f32) -> Vec<(f64, String)> {
    let decade = f64::from(room) / (high - low);
    let steps: &[f64] = if decade * 0.3 >= f64::from(apart) { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let first = (low - 1e-9).floor() as i32;
    let last = (high + 1e-9).floor() as i32;
    let every = (f64::from(apart) / decade).ceil().max(1.0) as i32;
    let exponents = (first..=last).filter(|exponent| exponent.rem_euclid(every) == 0);
    let marks = exponents.flat_map(|exponent| {
        steps.iter().map(move |step| {
            let value = step * libm::pow(10.0, f64::from(exponent));
            (f64::from(exponent) + libm::log10(*step), plain(value, *step, exponent))
        })
    });
    marks.filter(|(at, _)| (low - 1e-9..=high + 1e-9).contains(at)).collect()
}

/// The number `step · 10^exponent`, its thousands apart, or as a power of ten where that is shorter.
fn plain(value: f64, step: f64, exponent: i32) -> String {
    match exponent {
        -3..=3 => return round(value, 4),
        4 | 5 => {}
        _ if step == 1.0 => return format!("10{}", superscript(exponent)),
        _ => return format!("{step}·10{}", superscript(exponent)),
    }
    let digits = format!("{value:.0}");
    let (thousands, rest) = digits.split_at(digits.len() - 3);
    format!("{thousands}\u{202f}{rest}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_the_plane_is_found_again_from_its_place_on_the_screen() {
        let rect = Rect::from_min_max(pos2(100.0, 50.0), pos2(300.0, 250.0));
        let area = PlotArea { rect, bounds: [[-1.0, 3.0], [0.0, 5.0]] };
        assert_eq!(area.at([-1.0, 0.0]), rect.left_bottom());
        assert_eq!(area.at([3.0, 5.0]), rect.right_top());
        let [x, y] = area.point(area.at([0.5, 4.0]));
        assert!((x - 0.5).abs() < 1e-6 && (y - 4.0).abs() < 1e-6, "{x}, {y}");
        assert_eq!(area.point(pos2(0.0, 999.0)), [-1.0, 0.0]);
    }

    #[test]
    fn a_logarithmic_axis_has_round_numbers_and_no_more_than_fit() {
        let texts = |low: f64, high: f64, room: f32| -> Vec<String> {
            decades([low, high].map(libm::log10), room, 30.0).into_iter().map(|(_, t)| t).collect()
        };
        let wide = ["2", "5", "10", "20", "50", "100", "200", "500", "1000"];
        assert_eq!(texts(2.0, 1000.0, 400.0), wide);
        assert_eq!(texts(2.0, 1000.0, 100.0), ["10", "100", "1000"]);
        assert_eq!(texts(1.0, 1e5, 160.0)[4..], ["10\u{202f}000", "100\u{202f}000"]);
        assert_eq!(texts(1.0, 1e5, 100.0).len(), 3);
        assert_eq!(texts(1e-4, 1e8, 400.0)[..2], ["10⁻⁴", "0.001"]);
    }
}
