//! Parts that panels share: the frame of a panel, the window of a dialog, a line of words or of a formula, and the
//! colours of verdicts.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, FontId, Frame, Galley, Id, Margin, Order, Rect, TextFormat, Ui, Window,
};

use crate::measure::{Outcome, Severity};
use crate::run::MenuIndex;
use crate::theme::{colour, formula_font, palette, quantity_font};

/// Tag of the panel that shows the picture of an instrument.
pub(super) const PICTURE: &str = "picture of an instrument";

/// Whether `ui` belongs to a picture. A picture has words in place of buttons and menus.
pub(super) fn is_picture(ui: &Ui) -> bool {
    ui.stack().iter().any(|part| part.tags().contains(PICTURE))
}

/// Returns the frame of a panel, filled with this colour.
pub(super) fn frame(fill: Color32) -> Frame {
    Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 4))
}

/// Returns the name of a method after the digit that selects it, if it has a digit.
pub(super) fn numbered(entry: MenuIndex, name: &str) -> String {
    if entry < 9 { format!("{} {name}", entry + 1) } else { name.to_owned() }
}

/// Lays out words in one line of this width, with an ellipsis if the words are too long. Also returns whether they fit.
pub(super) fn short(
    ui: &Ui,
    words: &str,
    font: FontId,
    room: f32,
    colour: Color32,
) -> (Arc<Galley>, bool) {
    let mut job = LayoutJob::single_section(words.to_owned(), TextFormat::simple(font, colour));
    job.wrap = TextWrapping::truncate_at_width(room.max(0.0));
    let galley = ui.painter().layout_job(job);
    let is_whole = !galley.elided;
    (galley, is_whole)
}

pub(super) fn tone(ui: &Ui, word: Outcome) -> Color32 {
    severity_tone(ui, word.severity())
}

pub(super) fn severity_tone(ui: &Ui, severity: Severity) -> Color32 {
    colour(palette(ui).theme.palette().of_severity(severity))
}

/// Lays out a line of a formula as in print: the quantities in serif italic, the digits and words upright.
pub(super) fn formula(line: &str, size: f32, colour: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let letters: Vec<char> = line.chars().collect();
    for run in letters.chunk_by(|a, b| is_letter(*a) == is_letter(*b)) {
        let is_quantity = run.len() == 1 && is_letter(run[0]);
        let font_id = if is_quantity { quantity_font(size) } else { formula_font(size) };
        let text: String = run.iter().collect();
        job.append(&text, 0.0, TextFormat { font_id, color: colour, ..TextFormat::default() });
    }
    job
}

/// Whether a letter by itself is a quantity. Subscripts and the sum sign are not.
fn is_letter(sign: char) -> bool {
    sign.is_alphabetic() && !matches!(sign, 'ᵢ' | 'ⱼ' | 'Σ')
}

/// Returns the window of a dialog. The dialog lies over the part `over` of the program's window.
pub(super) fn dialog(title: &str, over: Rect) -> Window<'_> {
    Window::new(title)
        .id(Id::unique(title))
        .order(Order::Foreground)
        .collapsible(false)
        .resizable(false)
        .constrain_to(over)
        .anchor(Align2::CENTER_TOP, [0.0, 80.0_f32.min(over.height() / 8.0)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta_sim::integrators::METHODS;

    fn quantities(line: &str) -> Vec<String> {
        let job = formula(line, 13.0, Color32::WHITE);
        assert_eq!(job.text, line);
        let italic =
            |section: &&egui::text::LayoutSection| section.format.font_id == quantity_font(13.0);
        let text = |section: &egui::text::LayoutSection| {
            let [start, end] = [section.byte_range.start, section.byte_range.end].map(usize::from);
            job.text[start..end].to_owned()
        };
        job.sections.iter().filter(italic).map(text).collect()
    }

    #[test]
    fn quantities_are_italic_and_words_and_figures_are_not() {
        assert_eq!(quantities("y′ = y + ½h Σ aᵢⱼ kⱼ if small"), ["y", "y", "h", "a", "k"]);
        for line in METHODS.iter().flat_map(|method| method.formula) {
            assert!(quantities(line).iter().all(|text| text.chars().count() == 1), "{line}");
        }
    }
}
