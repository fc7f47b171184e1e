//! The list of the chapter's figures, each with its key.

use egui::{Button, Rect, Ui};

use super::{keycap, parts};
use crate::studio::{BOOK_FIGURES, BookFigure, Command, ViewCommand};
use crate::theme::palette;

/// Width of the list, and height of a row, in points.
const WIDTH: f32 = 470.0;
const ROW: f32 = 30.0;

/// Shows the list over a part of the window.
pub(super) fn show(ui: &Ui, over: Rect, commands: &mut Vec<Command>) {
    parts::dialog("The figures of the book", over).show(ui.ctx(), |ui| {
        let width = WIDTH.min(over.width() - 40.0).max(40.0);
        ui.set_min_width(width);
        for (index, figure) in BOOK_FIGURES.iter().enumerate() {
            let BookFigure { number, title, .. } = figure;
            ui.horizontal(|ui| {
                let (rect, _) = ui.allocate_exact_size(egui::vec2(26.0, ROW), egui::Sense::hover());
                keycap::paint(ui, rect.left(), rect.center().y, figure.digit(), palette(ui).text);
                let words = format!("Figure {number}: {title}");
                let button = Button::new(words).truncate().min_size(egui::vec2(0.0, ROW - 4.0));
                if ui.add(button).clicked() {
                    commands.push(Command::View(ViewCommand::OpenFigure(index)));
                }
            });
        }
        ui.add_space(4.0);
        if ui.button("Close (Esc)").clicked() {
            commands.push(Command::View(ViewCommand::CloseDialog));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{Studio, ViewCommand};
    use crate::tests::testing::TestWindow;

    #[test]
    fn the_whole_list_is_on_every_window() {
        for size in [[1280.0, 720.0], [800.0, 600.0], [390.0, 700.0]] {
            let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
            studio.apply(ViewCommand::ToggleFigures);
            let mut window = TestWindow::new(size);
            (0..3).for_each(|_| drop(window.panels(&studio, Vec::new())));
            let words = window.panels(&studio, Vec::new()).1.whole();
            for BookFigure { number, .. } in &BOOK_FIGURES {
                let name = format!("Figure {number}");
                assert!(words.iter().any(|(_, words)| words.starts_with(&name)), "{name} {size:?}");
            }
        }
    }
}
