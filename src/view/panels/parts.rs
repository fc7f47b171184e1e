//! What several panels are made of: the frame of a panel, a line of words, and the colours of verdicts.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Frame, Galley, Margin, TextFormat, Ui};

use crate::measure::{Outcome, Severity};
use crate::view::theme::{colour, palette};

/// The tag of a panel that is a picture of an instrument.
pub(super) const PICTURE: &str = "picture of an instrument";

/// Whether this is part of a picture, which has words where a window has buttons and menus.
pub(super) fn is_picture(ui: &Ui) -> bool {
    ui.stack().iter().any(|part| part.tags().contains(PICTURE))
}

/// The frame of a panel of this colour.
pub(super) fn frame(fill: Color32) -> Frame {
    Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 4))
}

/// The name of a method after the digit that picks it, if there is one.
pub(super) fn numbered(entry: usize, name: &str) -> String {
    if entry < 9 { format!("{} {name}", entry + 1) } else { name.to_owned() }
}

/// Words in one line of this width, with an ellipsis where they do not fit, and whether they fit.
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

/// The colour of a verdict.
pub(super) fn tone(ui: &Ui, word: Outcome) -> Color32 {
    severity_tone(ui, word.severity())
}

/// The colour of a severity.
pub(super) fn severity_tone(ui: &Ui, severity: Severity) -> Color32 {
    colour(palette(ui).theme.palette().of_severity(severity))
}
