//! The help overlay. It shows every key and every gesture of the mouse, from their tables.

use egui::scroll_area::ScrollBarVisibility;
use egui::{Align2, FontId, Order, RichText, ScrollArea, Ui, Vec2, Window, pos2, vec2};

use super::parts::short;
use super::{breakpoints, keycap};
use crate::studio::{Command, GESTURES, KEYS, ViewCommand};
use crate::theme::{TYPE, palette};

/// Width of a column, and width of the keys in a column, in points.
const COLUMN: f32 = 560.0;
const KEY: f32 = 128.0;
/// Size of a window's border and of the margins around its content, in points.
const AROUND: Vec2 = vec2(48.0, 110.0);
/// Minimum height of the list, because egui panics at a press on a scroll bar that is shorter than its handle.
const MIN_LIST: f32 = 32.0;

pub(super) fn show(ui: &Ui, is_page: bool, commands: &mut Vec<Command>) {
    let screen = ui.ctx().content_rect().size();
    let columns = if screen.x >= breakpoints::HELP_IN_TWO_COLUMNS { 2 } else { 1 };
    let width = (COLUMN * columns as f32).min(screen.x - AROUND.x).max(0.0);
    let window =
        Window::new("Keys and mouse").order(Order::Foreground).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ui.ctx(), |ui| {
        ui.set_width(width);
        // The scroll bar stays visible while there is more to see.
        ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
        let height = (screen.y - AROUND.y).max(MIN_LIST);
        let list = ScrollArea::vertical()
            .max_height(height)
            // The window has its full height in the first frame. It would otherwise grow over several frames, and a
            // paused window draws no more frames.
            .min_scrolled_height(height)
            .auto_shrink([false, true])
            .scroll_bar_visibility(ScrollBarVisibility::VisibleWhenNeeded);
        list.show(ui, |ui| {
            ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
            let own = width / columns as f32 - 20.0;
            ui.horizontal_top(|ui| {
                let keys = KEYS.iter().filter_map(|binding| match is_page {
                    true => binding.on_page(),
                    false => Some((binding.shown.to_owned(), binding.about)),
                });
                let keys = keys.map(|(shown, about)| (shown, about, true));
                let mouse = GESTURES.iter();
                let mouse = mouse.map(|gesture| (gesture.shown.to_owned(), gesture.about, false));
                let rows: Vec<_> = keys.chain(mouse).collect();
                for part in rows.chunks(rows.len().div_ceil(columns)) {
                    ui.vertical(|ui| {
                        ui.set_width(own);
                        part.iter().for_each(|(shown, about, is_key)| {
                            row(ui, (shown, about, *is_key), own);
                        });
                    });
                }
            });
        });
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            if ui.button("Close (Esc)").clicked() {
                commands.push(Command::View(ViewCommand::ToggleHelp));
            }
            let note = "The exact solution is white, or black in the light theme; each method has its own colour and dash.";
            if columns == 2 {
                ui.add(egui::Label::new(RichText::new(note).color(palette(ui).dim)).truncate());
            }
        });
    });
}

/// Shows a key or a gesture, and the effect of either.
fn row(ui: &mut Ui, (shown, about, is_key): (&str, &str, bool), width: f32) {
    ui.horizontal(|ui| {
        let size = vec2(KEY, keycap::HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, shown));
        if is_key {
            keycap::paint(ui, rect.left(), rect.center().y, shown, palette(ui).accent);
        } else {
            let colour = palette(ui).accent;
            let (words, _) = short(ui, shown, FontId::proportional(TYPE), KEY, colour);
            let top = rect.center().y - words.size().y / 2.0;
            ui.painter().galley(pos2(rect.left(), top), words, colour);
        }
        ui.scope(|ui| {
            ui.set_max_width((width - KEY - 12.0).max(0.0));
            ui.add(egui::Label::new(about).wrap());
        });
    });
}

#[cfg(test)]
mod tests {
    use egui::Pos2;

    use super::*;
    use crate::scene::Scene;
    use crate::studio::Studio;
    use crate::tests::testing::TestWindow;

    #[test]
    fn a_click_into_the_help_of_a_window_of_any_size_does_not_panic() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(ViewCommand::ToggleHelp);
        let sizes = [[1.0, 1.0], [95.0, 300.0], [200.0, 63.0], [200.0, 64.0], [320.0, 122.0]];
        for [width, height] in sizes {
            let mut window = TestWindow::new([width, height]);
            // The clicks hit every position, and so also the scroll bar of the list.
            for x in (0..width as u32).step_by(5) {
                window.click(&studio, Pos2::new(x as f32, 0.5 * (height - 1.0)));
            }
        }
    }
}
