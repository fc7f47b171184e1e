//! The help overlay: every key, from the one table of keys.

use egui::{Align2, Grid, Order, RichText, ScrollArea, Ui, Window};

use super::{ACCENT, QUIET};
use crate::lab::{Command, KEYS};

/// What the names of the keys and the scroll bar take of the width, in points.
const ROOM_FOR_KEYS: f32 = 130.0;

pub(super) fn show(ui: &Ui, commands: &mut Vec<Command>) {
    let screen = ui.ctx().content_rect();
    let window = Window::new("Keys").order(Order::Foreground).collapsible(false).resizable(false);
    let size = egui::vec2(600.0, 560.0).min(screen.size() - egui::vec2(24.0, 64.0));
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).fixed_size(size.max(egui::Vec2::ZERO)).show(
        ui.ctx(),
        |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                let room = (size.x - ROOM_FOR_KEYS).max(0.0);
                let grid = Grid::new("keys").num_columns(2).spacing([18.0, 5.0]);
                grid.max_col_width(room).show(ui, |ui| {
                    for binding in KEYS {
                        ui.label(RichText::new(binding.shown).monospace().color(ACCENT));
                        ui.label(binding.about);
                        ui.end_row();
                    }
                });
                ui.add_space(6.0);
                let note = "White is the truth; each method has its own colour and dash.";
                ui.label(RichText::new(note).color(QUIET));
                if ui.button("Close (Esc)").clicked() {
                    commands.push(Command::ToggleHelp);
                }
            });
        },
    );
}
