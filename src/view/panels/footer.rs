//! The line under everything: what happened last, what to try next, and the keys.

use egui::{Align, Layout, RichText, Ui};

use super::{ACCENT, QUIET, TEXT, colour};
use crate::lab::Lab;
use crate::lab::number::round;
use crate::lab::picture::palette;

pub(super) const HEIGHT: f32 = 26.0;

/// From this width on, in points, the keys fit beside the hint.
const ROOM_FOR_KEYS: f32 = 900.0;

pub(super) fn show(ui: &mut Ui, lab: &Lab) {
    let width = ui.available_width();
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if lab.dropped() > 0 {
            let text = format!("{} ticks dropped", lab.dropped());
            ui.label(RichText::new(text).color(colour(palette::ALARM)))
                .on_hover_text("the simulation fell behind real time and gave these up");
        } else if width >= ROOM_FOR_KEYS {
            let part = |input, keys: &str, part: f64| {
                let text = format!("{keys} {input} {} %  ", round(part * 100.0, 3));
                if lab.race().takes(input) { text } else { String::new() }
            };
            let keys = format!(
                "{}{}K kick  Space pause  E inspector  H all keys",
                part("throttle", "↑ ↓", lab.race().throttle()),
                part("rudder", "← →", lab.race().rudder()),
            );
            ui.label(RichText::new(keys).color(QUIET));
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let (text, colour) = match (lab.viewer().notice.as_deref(), &lab.scene().hint) {
                (Some(notice), _) => (notice, TEXT),
                (None, Some(hint)) => (hint.as_str(), ACCENT),
                (None, None) => (lab.scene().about.as_str(), QUIET),
            };
            ui.add(egui::Label::new(RichText::new(text).color(colour)).truncate());
        });
    });
}
