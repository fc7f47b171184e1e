//! Legends: the names of curves, each after a piece of its line.

use std::sync::Arc;

use egui::{
    Align2, Color32, FontId, Galley, Painter, Pos2, Response, Sense, Stroke, Ui, pos2, vec2,
};

use super::curves::ScreenCurve;
use super::{LineStyle, NAME, Primitive, Text, text_width};
use crate::view::theme::{Ink, ink, strong_font};

/// The length of a line, the room behind it, and between two entries, in points.
const SWATCH: f32 = 26.0;
const BEFORE_NAME: f32 = 6.0;
pub(in crate::view) const BETWEEN: f32 = 13.0;
/// The height of a row of entries, in points.
pub(in crate::view) const ROW: f32 = 15.0;
/// The size of a name, in points.
const SIZE: f32 = 12.0;
/// The width of a line of a legend in a file, in points.
const WIDTH: f32 = 2.4;

/// A curve's name and its line.
#[derive(Clone, Debug)]
pub(in crate::view) struct Entry {
    pub(in crate::view) name: String,
    pub(in crate::view) colour: Color32,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub(in crate::view) dash: [f32; 2],
    /// Whether its name stands out.
    pub(in crate::view) is_front: bool,
}

impl Entry {
    fn words(&self, ui: &Ui) -> Arc<Galley> {
        let (font, inked) = match self.is_front {
            true => (strong_font(SIZE), ink(ui).text),
            false => (FontId::proportional(SIZE), ink(ui).dim),
        };
        ui.painter().layout_no_wrap(self.name.clone(), font, inked)
    }

    /// The width that it takes, in points.
    pub(in crate::view) fn width(&self, ui: &Ui) -> f32 {
        SWATCH + BEFORE_NAME + self.words(ui).size().x
    }

    /// Shows it, at least this wide.
    fn show(&self, ui: &mut Ui, min_width: f32) -> Response {
        let words = self.words(ui);
        let size = vec2(self.width(ui).max(min_width), words.size().y);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        swatch(ui.painter(), rect.left_center(), SWATCH, self.dash, self.colour);
        let at = rect.left_center() + vec2(SWATCH + BEFORE_NAME, -words.size().y / 2.0);
        ui.painter().galley(at, words, ink(ui).text);
        response
    }
}

/// Shows a legend in as many rows as it needs.
pub(in crate::view) fn show(ui: &mut Ui, entries: &[Entry]) -> Vec<Response> {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = ROW;
        ui.horizontal_wrapped(|ui| show_here(ui, entries, 0.0)).inner
    })
    .inner
}

/// Shows a legend in the row that is there, each entry at least this wide.
pub(in crate::view) fn show_here(ui: &mut Ui, entries: &[Entry], width: f32) -> Vec<Response> {
    ui.spacing_mut().item_spacing.x = BETWEEN;
    entries.iter().map(|entry| entry.show(ui, width)).collect()
}

/// A piece of a curve's line, from `from` to the right, as the plots draw it.
pub(in crate::view) fn swatch(
    painter: &Painter,
    from: Pos2,
    length: f32,
    [drawn, gap]: [f32; 2],
    colour: Color32,
) {
    let (mut x, to) = (from.x, from.x + length);
    while x < to {
        let end = if gap > 0.0 { (x + drawn).min(to) } else { to };
        painter.line_segment([pos2(x, from.y), pos2(end, from.y)], Stroke::new(3.0, colour));
        x = end + gap.max(1.0);
    }
}

/// A legend in one row, whose line is at the height of `from`.
pub(in crate::view) fn layout(entries: &[Entry], from: Pos2, ink: &Ink) -> Vec<Primitive> {
    let mut x = from.x;
    let entry = |Entry { name, colour, dash, .. }: &Entry| {
        let points = vec![pos2(x, from.y), pos2(x + SWATCH, from.y)];
        let style = LineStyle { dash: *dash, ..LineStyle::solid(*colour, WIDTH) };
        let line = ScreenCurve { style, points, swept: Vec::new() };
        let at = pos2(x + SWATCH + BEFORE_NAME, from.y);
        x = at.x + text_width(name, NAME) + BETWEEN;
        let name = Text::new(at, Align2::LEFT_CENTER, name.as_str(), NAME, ink.text);
        [Primitive::Curves(vec![line]), name.into()]
    };
    entries.iter().flat_map(entry).collect()
}
