//! A field for a person's own lines, with the code that moves like them at any frame rate.

use egui::{FontId, Id, Key, Label, Rect, RichText, ScrollArea, Ui, vec2};

use super::opening::report_within;
use super::parts::dialog;
use super::text_field::text_area;
use crate::run::link::MAX_LETTERS;
use crate::studio::{Command, ReadLines, Studio, ViewCommand};
use crate::theme::palette;

/// Width of the field, and rows of text in it. Then the most height of the code below it, in points.
const WIDTH: f32 = 470.0;
const ROWS: usize = 7;
const CODE: f32 = 150.0;

pub(super) fn show(
    ui: &Ui,
    studio: &Studio,
    read: &ReadLines,
    over: Rect,
    commands: &mut Vec<Command>,
) {
    let ctx = ui.ctx();
    let width = WIDTH.min(over.width() - 40.0).max(40.0);
    dialog("My lines", over).show(ctx, |ui| {
        ui.set_width(width);
        let id = Id::unique("my lines");
        // All typing is meant for it until a button is pressed.
        if ui.memory(|memory| memory.focused().is_none()) {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = studio.viewer.my_lines();
        let mut text = typed.to_owned();
        let field = text_area(&mut text, id, MAX_LETTERS).desired_rows(ROWS);
        let field = field.desired_width(width).show(ui);
        let about = "lines of a rule or of a method";
        field
            .response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, about));
        if text != typed {
            commands.push(Command::View(ViewCommand::TypeLines(text)));
        }
        let dim = palette(ui).dim;
        let words =
            "A rule moves x towards a target once a frame; a method calls a(x, v) and has h; a loop says tick.";
        ui.label(RichText::new(words).color(dim));
        ui.horizontal(|ui| {
            let is_entered =
                ui.input(|input| input.modifiers.command && input.key_pressed(Key::Enter));
            if ui.button("Run (Ctrl Enter)").clicked() || is_entered {
                commands.push(Command::View(ViewCommand::RunLines));
            }
            if let Some(code) = &read.code
                && ui.button("Copy the code").clicked()
            {
                ui.copy_text(code.clone());
            }
            if ui.button("Close (Esc)").clicked() {
                commands.push(Command::View(ViewCommand::CloseDialog));
            }
        });
        if !read.report.is_empty() {
            report_within(ui, &read.report, vec2(width, CODE));
        } else if let Some(code) = &read.code {
            ui.label(RichText::new("the same at any frame rate:").color(dim));
            ScrollArea::both().max_height(CODE).max_width(width).show(ui, |ui| {
                let code = RichText::new(code).font(FontId::monospace(11.5));
                ui.add(Label::new(code).extend());
            });
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::tests::testing::TestWindow;

    #[test]
    fn the_dialog_shows_lines_code_and_faults_whole_on_every_window() {
        for size in [[1280.0, 720.0], [800.0, 600.0], [390.0, 700.0]] {
            let mut studio = Studio::new(Scene::built_in("spring").unwrap());
            studio.apply(ViewCommand::AskForLines);
            let mut window = TestWindow::new(size);
            let mut words = |studio: &Studio| {
                (0..3).for_each(|_| drop(window.panels(studio, Vec::new())));
                let whole = window.panels(studio, Vec::new()).1.whole();
                whole.into_iter().map(|(_, words)| words).collect::<Vec<_>>().join("\n")
            };
            let shown = words(&studio);
            for part in ["target - x", "Run (Ctrl Enter)", "the same at any frame rate:"] {
                assert!(shown.contains(part), "{part} at {size:?}: {shown}");
            }
            studio.apply(ViewCommand::TypeLines("x += w\n".into()));
            studio.apply(ViewCommand::RunLines);
            let shown = words(&studio);
            assert!(shown.contains("unknown name `w`"), "{size:?}: {shown}");
        }
    }
}
