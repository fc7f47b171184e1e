//! Primitives of a laid-out chart, in points, and the code that paints them in a panel.

use egui::epaint::PathStroke;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2};

use super::SCATTERED;
use super::curves::{self, Dots, ScreenCurve, dots};
use crate::theme::strong_font;

/// Gap between the words of a text and their tail, in points.
pub(super) const BEFORE_TAIL: f32 = 14.0;

/// A part of a laid-out chart. Later parts lie over earlier ones.
#[derive(Clone, Debug)]
pub(crate) enum Primitive {
    /// A filled rectangle.
    Area(Rect, Color32),
    /// The outer edge of a rectangle.
    Edge(Rect, Stroke),
    Line([Pos2; 2], Stroke),
    /// A circle of this radius.
    Ring(Pos2, f32, Stroke),
    /// A filled circle of this radius.
    Dot(Pos2, f32, Color32),
    /// A filled convex polygon.
    Polygon(Vec<Pos2>, Color32),
    Text(Text),
    /// Curves. The dots of all of them lie over all the lines.
    Curves(Vec<ScreenCurve>),
    /// Primitives clipped to a rectangle.
    Clip(Rect, Vec<Primitive>),
}

/// Text in a chart.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    pub(crate) at: Pos2,
    /// The part of the text that lies at `at`.
    pub(crate) anchor: Align2,
    pub(crate) words: String,
    pub(crate) size: f32,
    pub(crate) is_strong: bool,
    pub(crate) colour: Color32,
    /// The x that the text must not exceed.
    pub(crate) right: f32,
    /// Maximum width of a line, in points.
    pub(crate) wrap: f32,
    /// Further words after the text, in their own colour.
    pub(crate) tail: Option<(String, Color32)>,
}

impl Text {
    /// Creates a text in one line of any length.
    pub(crate) fn new(
        at: Pos2,
        anchor: Align2,
        words: impl Into<String>,
        size: f32,
        colour: Color32,
    ) -> Self {
        let words = words.into();
        let [right, wrap] = [f32::INFINITY; 2];
        Self { at, anchor, words, size, is_strong: false, colour, right, wrap, tail: None }
    }

    /// Returns the same text in strong type.
    pub(crate) fn strong(self) -> Self {
        Self { is_strong: true, ..self }
    }

    fn paint(&self, painter: &Painter) {
        let font = match self.is_strong {
            true => strong_font(self.size),
            false => FontId::proportional(self.size),
        };
        let format = |colour| TextFormat::simple(font.clone(), colour);
        let mut job = LayoutJob::single_section(self.words.clone(), format(self.colour));
        job.wrap.max_width = self.wrap;
        if let Some((words, colour)) = &self.tail {
            job.append(words, BEFORE_TAIL, format(*colour));
        }
        let galley = painter.layout_job(job);
        let corner = self.anchor.anchor_size(self.at, galley.size()).min;
        let left = corner.x.min(self.right - galley.size().x);
        painter.galley(pos2(left, corner.y), galley, self.colour);
    }
}

impl From<Text> for Primitive {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

/// Paints a chart within the painter's clip.
pub(crate) fn paint(painter: &Painter, primitives: &[Primitive]) {
    for primitive in primitives {
        match primitive {
            Primitive::Area(rect, fill) => drop(painter.rect_filled(*rect, 0.0, *fill)),
            Primitive::Edge(rect, stroke) => {
                painter.rect_stroke(*rect, 0.0, *stroke, StrokeKind::Outside);
            }
            Primitive::Line(ends, stroke) => drop(painter.line_segment(*ends, *stroke)),
            Primitive::Ring(at, radius, stroke) => {
                painter.circle_stroke(*at, *radius, *stroke);
            }
            Primitive::Dot(at, radius, fill) => drop(painter.circle_filled(*at, *radius, *fill)),
            Primitive::Polygon(corners, fill) => {
                let corners = corners.clone();
                painter.add(Shape::convex_polygon(corners, *fill, PathStroke::NONE));
            }
            Primitive::Text(text) => text.paint(painter),
            Primitive::Curves(curves) => paint_curves(painter, curves),
            Primitive::Clip(rect, inside) => {
                let seen = rect.intersect(painter.clip_rect());
                if seen.is_positive() {
                    paint(&painter.with_clip_rect(seen), inside);
                }
            }
        }
    }
}

fn paint_curves(painter: &Painter, curves: &[ScreenCurve]) {
    let are_lines: Vec<bool> = curves.iter().map(|curve| curves::paint(painter, curve)).collect();
    let seen = painter.clip_rect();
    for (ScreenCurve { style, points, .. }, is_line) in curves.iter().zip(are_lines) {
        let kind = if is_line { style.dots } else { Dots::Each(SCATTERED) };
        for (at, radius) in dots(points, kind).filter(|(at, _)| seen.contains(*at)) {
            painter.circle_filled(at, radius, style.colour);
        }
    }
}
