//! Legends, which name each curve after a piece of its line.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Galley, Pos2, Response, Sense, Stroke, Ui, pos2, vec2};

use super::{Primitive, Text, paint, text_width};
use crate::theme::{PanelPalette, palette, strong_font};

/// Length of a piece of line, gap between a piece and the name, and gap between two entries, in points.
const SWATCH: f32 = 26.0;
const BEFORE_NAME: f32 = 6.0;
pub(crate) const BETWEEN: f32 = 13.0;
/// The height of a row of entries, in points.
pub(crate) const ROW: f32 = 15.0;
/// The size of a name, in points.
const SIZE: f32 = 12.0;

/// An entry of a legend: a curve's name and the style of its line.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) colour: Color32,
    /// Length of a dash and of the gap after it, in points. A line with a gap of 0 is solid.
    pub(crate) dash: [f32; 2],
    /// Whether the name is emphasized.
    pub(crate) is_front: bool,
}

impl Entry {
    fn words(&self, ui: &Ui) -> Arc<Galley> {
        let font = if self.is_front { strong_font(SIZE) } else { FontId::proportional(SIZE) };
        ui.painter().layout_no_wrap(self.name.clone(), font, palette(ui).text)
    }

    /// Returns the width of the entry, in points.
    pub(crate) fn width(&self, ui: &Ui) -> f32 {
        SWATCH + BEFORE_NAME + self.words(ui).size().x
    }

    /// Shows the entry, at least `min_width` points wide.
    fn show(&self, ui: &mut Ui, min_width: f32) -> Response {
        let words = self.words(ui).size();
        let size = vec2((SWATCH + BEFORE_NAME + words.x).max(min_width), words.y);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        paint(ui.painter(), &self.layout(rect.left_center(), palette(ui)));
        response
    }

    /// Lays out the piece of line, which begins at `from` and goes to the right, and the name.
    fn layout(&self, from: Pos2, palette: &PanelPalette) -> Vec<Primitive> {
        let at = from + vec2(SWATCH + BEFORE_NAME, 0.0);
        let colour = if self.is_front { palette.text } else { palette.dim };
        let name = Text::new(at, Align2::LEFT_CENTER, &*self.name, SIZE, colour);
        let mut all = swatch(from, SWATCH, self.dash, self.colour);
        all.push(if self.is_front { name.strong() } else { name }.into());
        all
    }
}

/// Shows a legend in as many rows as its entries need.
pub(crate) fn show(ui: &mut Ui, entries: &[Entry]) -> Vec<Response> {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = ROW;
        ui.horizontal_wrapped(|ui| show_here(ui, entries, 0.0)).inner
    })
    .inner
}

/// Shows a legend in the current row. Each entry is at least `width` points wide.
pub(crate) fn show_here(ui: &mut Ui, entries: &[Entry], width: f32) -> Vec<Response> {
    ui.spacing_mut().item_spacing.x = BETWEEN;
    entries.iter().map(|entry| entry.show(ui, width)).collect()
}

/// Returns a piece of a curve's line as the plots draw it. It begins at `from` and goes to the right.
pub(crate) fn swatch(
    from: Pos2,
    length: f32,
    [drawn, gap]: [f32; 2],
    colour: Color32,
) -> Vec<Primitive> {
    let (mut x, to) = (from.x, from.x + length);
    let mut dashes = Vec::new();
    while x < to {
        let end = if gap > 0.0 { (x + drawn).min(to) } else { to };
        let ends = [pos2(x, from.y), pos2(end, from.y)];
        dashes.push(Primitive::Line(ends, Stroke::new(3.0, colour)));
        x = end + gap.max(1.0);
    }
    dashes
}

/// Lays out a legend in one row. Its lines are at the height of `from`.
pub(crate) fn layout(entries: &[Entry], from: Pos2, palette: &PanelPalette) -> Vec<Primitive> {
    let mut x = from.x;
    let entry = |entry: &Entry| {
        let laid_out = entry.layout(pos2(x, from.y), palette);
        x += SWATCH + BEFORE_NAME + text_width(&entry.name, SIZE) + BETWEEN;
        laid_out
    };
    entries.iter().flat_map(entry).collect()
}
