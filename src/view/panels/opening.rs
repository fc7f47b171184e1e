//! Dialogs for opening a file: a field for the file's path, and a report of the mistakes in the file.

use egui::{Id, Key, Label, Rect, RichText, ScrollArea, TextStyle, TextWrapMode, Ui};

use super::parts::dialog;
use super::text_field::{select, text_field};
use crate::run::link::MAX_LETTERS;
use crate::scene::ShownError;
use crate::studio::{Command, DriverRequest, Studio, ViewCommand};
use crate::theme::palette;

/// Width of the field for a path, in points. It shows a usual path without scrolling.
const WIDTH: f32 = 460.0;

/// Shows a field for a path. The field has the focus as long as it is open, because all typing is meant for it.
pub(super) fn path(
    ui: &Ui,
    studio: &Studio,
    refused: Option<&[ShownError]>,
    over: Rect,
    commands: &mut Vec<Command>,
) {
    let ctx = ui.ctx();
    let width = WIDTH.min(over.width() - 40.0).max(40.0);
    let (title, hint, does) = match studio.viewer.compares_typed_path() {
        true => ("Compare the run with a recording", "path of a recording", "compares"),
        false => ("Open a scene or a frame log", "path of a scene or of a frame log", "opens"),
    };
    dialog(title, over).show(ctx, |ui| {
        ui.set_min_width(width);
        let id = Id::unique("path of a scene file");
        let is_new = !ui.memory(|memory| memory.has_focus(id));
        if is_new {
            // The last path is selected, so that it can be edited or typed over.
            select(ctx, id, 0);
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = studio.viewer.typed_path();
        let mut text = typed.to_owned();
        let field = text_field(&mut text, id, MAX_LETTERS).desired_width(width).lock_focus(true);
        let field = field.hint_text(hint).show(ui);
        field.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, hint));
        if text != typed {
            commands.push(Command::View(ViewCommand::TypePath(text)));
        }
        if ui.input(|input| input.key_pressed(Key::Tab)) {
            commands.push(Command::Ask(DriverRequest::CompletePath));
            select(ctx, id, usize::MAX);
        }
        if ui.input(|input| input.key_pressed(Key::Enter)) {
            commands.push(Command::Ask(DriverRequest::OpenTypedPath));
            // The path can be edited at its end after Enter, in case the path is refused.
            ui.memory_mut(|memory| memory.request_focus(id));
            select(ctx, id, usize::MAX);
        }
        let mut keys = format!("Enter {does}, Tab completes, Esc closes.");
        if !studio.viewer.compares_typed_path() {
            keys += " Or drop a file onto the window.";
        }
        ui.label(RichText::new(keys).color(palette(ui).dim));
        if let Some(report) = refused {
            ui.separator();
            let room = egui::vec2(width, ctx.content_rect().height() - 240.0);
            report_within(ui, report, room);
        }
    });
}

/// Shows a dialog with the report that the command line would print.
pub(super) fn mistakes(
    ui: &Ui,
    file: &str,
    report: &[ShownError],
    over: Rect,
    commands: &mut Vec<Command>,
) {
    let ctx = ui.ctx();
    let room = over.size() - egui::vec2(40.0, 240.0);
    let title = format!("{file} cannot be opened");
    dialog(&title, over).show(ctx, |ui| {
        let font = TextStyle::Monospace.resolve(ui.style());
        let width = |text: &String| {
            let text = ui.painter().layout_no_wrap(text.clone(), font.clone(), palette(ui).dim);
            text.size().x
        };
        let texts = report.iter().flat_map(|mistake| [&mistake.message, &mistake.quoted]);
        ui.set_min_width(texts.map(width).fold(0.0, f32::max).min(room.x).max(0.0));
        report_within(ui, report, room);
        ui.add_space(4.0);
        if ui.button("Close (Esc)").clicked() {
            commands.push(Command::View(ViewCommand::CloseDialog));
        }
    });
}

/// Writes a report into this room, and scrolls it if it is larger. Messages wrap, but the lines of the file do not,
/// because the marks below them would no longer match.
pub(super) fn report_within(ui: &mut Ui, report: &[ShownError], room: egui::Vec2) {
    let room = room.max(egui::Vec2::ZERO);
    ScrollArea::both().max_width(room.x).max_height(room.y).show(ui, |ui| {
        for ShownError { message, quoted } in report {
            let message = RichText::new(message).monospace().color(palette(ui).bad);
            // A scroll area has no right edge of its own at which text could wrap.
            ui.scope(|ui| {
                ui.set_max_width(room.x);
                ui.add(Label::new(message).wrap());
            });
            if !quoted.is_empty() {
                let quoted = RichText::new(quoted).monospace();
                ui.add(Label::new(quoted).wrap_mode(TextWrapMode::Extend));
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{Dialog, refuse_typed_path, show_mistakes};
    use crate::tests::testing::TestWindow;

    /// Returns the size of the only dialog over the studio, in points.
    fn size_of_dialog(studio: &Studio, title: &str) -> egui::Vec2 {
        let mut window = TestWindow::new([800.0, 600.0]);
        for _ in 0..3 {
            window.show(Vec::new(), |ui| match studio.viewer.dialog() {
                Some(Dialog::Path { refused, .. }) => {
                    path(ui, studio, refused.as_deref(), ui.max_rect(), &mut Vec::new());
                }
                Some(Dialog::Mistakes { file, report }) => {
                    mistakes(ui, file, report, ui.max_rect(), &mut Vec::new());
                }
                _ => panic!("no dialog about a file"),
            });
        }
        let area = window.context.memory(|memory| memory.area_rect(Id::unique(title)));
        area.expect("the dialog is open").size()
    }

    #[test]
    fn a_long_message_is_wrapped_and_a_quoted_line_is_not() {
        let message = |words: usize| format!("a.toml:1:1: {}", "words ".repeat(words));
        let shown = |report: ShownError| {
            let mut studio = Studio::new(Scene::built_in("spring").unwrap());
            show_mistakes(&mut studio, std::path::Path::new("a.toml"), vec![report]);
            size_of_dialog(&studio, "a.toml cannot be opened")
        };
        let [short, long] = [8, 80].map(|words| shown(message(words).into()));
        assert!(long.x <= 800.0 && long.y > short.y + 20.0, "{short:?} {long:?}");
        let quoted = format!("1 | {}", "words ".repeat(80));
        let quoted = shown(ShownError { message: message(8), quoted });
        assert!(quoted.x <= 800.0 && quoted.y < long.y, "{quoted:?} {long:?}");
    }

    #[test]
    fn a_long_paste_is_truncated_at_the_longest_link() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(ViewCommand::AskForPath);
        let mut window = TestWindow::new([800.0, 600.0]);
        for _ in 0..6 {
            let mut commands = Vec::new();
            let paste = egui::Event::Paste("tick,x,v\n".repeat(3000));
            window.show(vec![paste], |ui| {
                path(ui, &studio, None, ui.max_rect(), &mut commands);
            });
            for command in commands {
                studio.apply(command);
            }
        }
        assert_eq!(studio.viewer.typed_path().chars().count(), MAX_LETTERS);
    }

    #[test]
    fn the_field_shows_why_a_path_is_refused() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(ViewCommand::AskForPath);
        let before = size_of_dialog(&studio, "Open a scene or a frame log");
        refuse_typed_path(
            &mut studio,
            std::path::Path::new("a.toml"),
            vec!["error: none ".repeat(40).into()],
        );
        let after = size_of_dialog(&studio, "Open a scene or a frame log");
        assert!(after.y > before.y + 40.0 && after.x <= before.x + 20.0, "{before:?} {after:?}");
    }
}
