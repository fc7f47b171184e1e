//! Opening a scene file: a field for its path, and what is wrong with it.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align2, Context, Id, Key, Order, RichText, ScrollArea, TextEdit, TextStyle, TextWrapMode, Ui,
    Window,
};

use super::{QUIET, colour};
use crate::lab::picture::palette;
use crate::lab::{Command, Dialog, Lab};

/// The width of a path that can be read without scrolling, in points.
const WIDTH: f32 = 460.0;

pub(super) fn show(ui: &Ui, lab: &Lab, dialog: &Dialog, commands: &mut Vec<Command>) {
    match dialog {
        Dialog::Path => path(ui, lab, commands),
        Dialog::Mistakes { file, report } => mistakes(ui, file, report, commands),
    }
    if ui.input(|input| input.key_pressed(Key::Escape)) {
        commands.push(Command::CloseDialog);
    }
}

fn window(title: &str) -> Window<'_> {
    Window::new(title).order(Order::Foreground).collapsible(false).resizable(false)
}

/// A field that has the focus as long as it is there: what is typed is meant for it.
fn path(ui: &Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let ctx = ui.ctx();
    let width = WIDTH.min(ctx.content_rect().width() - 40.0).max(40.0);
    window("Open a scene file").anchor(Align2::CENTER_TOP, [0.0, 80.0]).show(ctx, |ui| {
        ui.set_min_width(width);
        let id = Id::unique("path of a scene file");
        let is_new = !ui.memory(|memory| memory.has_focus(id));
        if is_new {
            // What was typed last time can be amended, or typed over.
            select(ctx, id, 0);
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = lab.viewer().typed_path();
        let mut text = typed.to_owned();
        let field = TextEdit::singleline(&mut text).id(id).desired_width(width).lock_focus(true);
        let field = field.hint_text("path of a scene file").show(ui);
        field.response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::TextInput, true, "path of a scene file")
        });
        if text != typed {
            commands.push(Command::TypePath(text));
        }
        if ui.input(|input| input.key_pressed(Key::Tab)) {
            commands.push(Command::CompletePath);
            select(ctx, id, usize::MAX);
        }
        if ui.input(|input| input.key_pressed(Key::Enter)) {
            commands.push(Command::OpenTypedPath);
        }
        let keys = "Enter opens, Tab completes, Esc closes. Or drop a file onto the window.";
        ui.label(RichText::new(keys).color(QUIET));
    });
}

/// Selects what is typed from this character on.
fn select(ctx: &Context, id: Id, from: usize) {
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = CCursorRange::two(CCursor::new(from), CCursor::new(usize::MAX));
    state.cursor.set_char_range(Some(range));
    state.store(ctx, id);
}

/// The report, as the command line prints it.
fn mistakes(ui: &Ui, file: &str, report: &str, commands: &mut Vec<Command>) {
    let ctx = ui.ctx();
    let room = ctx.content_rect().size() - egui::vec2(60.0, 120.0);
    let title = format!("{file} cannot be opened");
    window(&title).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        let font = TextStyle::Monospace.resolve(ui.style());
        let text = ui.painter().layout_no_wrap(report.to_owned(), font, QUIET);
        ui.set_min_width(text.size().x.min(room.x).max(0.0));
        let scroll = ScrollArea::both().max_width(room.x.max(0.0)).max_height(room.y.max(0.0));
        scroll.show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
            for line in report.lines() {
                let is_of_file = line.starts_with(file) || line.starts_with("error");
                let text = RichText::new(line).monospace();
                let alarm = colour(palette::ALARM);
                ui.label(if is_of_file { text.color(alarm) } else { text });
            }
        });
        ui.add_space(4.0);
        if ui.button("Close (Esc)").clicked() {
            commands.push(Command::CloseDialog);
        }
    });
}
