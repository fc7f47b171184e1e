//! The guide below the stage, with the question of its stop, the choices, the key to press, and the answer.

use egui::{Align, Button, Layout, RichText, ScrollArea, Ui, vec2};

use super::{breakpoints, focus, keycap};
use crate::studio::guide::{STOPS, Tour};
use crate::studio::{Command, Step, ViewCommand};
use crate::theme::{palette, strong_font};

/// The guide's usual height, its minimum height, and the height left for the stage if possible, in points.
const HEIGHT: f32 = 172.0;
const MIN_HEIGHT: f32 = 96.0;
const FOR_STAGE: f32 = 150.0;

/// Returns the height of the guide, if the guide and the stage have `room` points together. A low guide scrolls.
pub(super) fn height(room: f32) -> f32 {
    HEIGHT.min((room - FOR_STAGE).max(MIN_HEIGHT)).min(0.6 * room)
}

pub(super) fn show(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing = vec2(6.0, 5.0);
    head(ui, tour, commands);
    // A low guide would otherwise exceed its height and lie over the stage.
    let scrolled = ScrollArea::vertical().auto_shrink(false).min_scrolled_height(0.0);
    scrolled.show(ui, |ui| {
        let stop = tour.stop();
        ui.label(stop.question);
        choices(ui, tour, commands);
        if tour.is_done() {
            let said = match tour.guess() {
                Some(guess) if guess == stop.right => "Right. ",
                Some(_) => "Not quite. ",
                None => "",
            };
            keycap::paragraph(ui, &format!("{said}{}", stop.answer), palette(ui).text, commands);
        } else {
            keycap::paragraph(ui, stop.task, palette(ui).text, commands);
        }
        focus::follow(ui);
    });
}

fn head(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    let index = tour.index();
    let count = STOPS.len();
    let is_wide = ui.available_width() >= breakpoints::KEYS_OF_GUIDE;
    let title = RichText::new(format!("{}. {}", index + 1, tour.stop().title));
    let title = title.font(strong_font(15.0));
    let show_title = |ui: &mut Ui| ui.add(egui::Label::new(title.clone()).truncate());
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text("close the guide (Esc)").clicked() {
                commands.push(Command::View(ViewCommand::ToggleGuide));
            }
            let dim = palette(ui).dim;
            let named = |name: &'static str, key: &str| match is_wide {
                true => Button::new(name).right_text(RichText::new(key).size(11.0).color(dim)),
                false => Button::new(name),
            };
            let next = named("Next", "Page Down");
            let next = if tour.is_done() { next.selected(true) } else { next };
            let next = ui.add_enabled(index + 1 < count, next);
            next.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Button, index + 1 < count, "Next (Page Down)")
            });
            if next.clicked() {
                commands.push(Command::View(ViewCommand::StopBeside(Step::Next)));
            }
            let back = ui.add_enabled(index > 0, named("Back", "Page Up"));
            back.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Button, index > 0, "Back (Page Up)")
            });
            if back.clicked() {
                commands.push(Command::View(ViewCommand::StopBeside(Step::Previous)));
            }
            if ui.button("⏮").on_hover_text("show this stop again").clicked() {
                commands.push(Command::View(ViewCommand::GoToStop(index)));
            }
            ui.label(RichText::new(format!("{} of {count}", index + 1)).color(palette(ui).dim));
            if is_wide {
                ui.with_layout(Layout::left_to_right(Align::Center), show_title);
            }
        });
    });
    if !is_wide {
        show_title(ui);
    }
}

/// Shows the predictions to choose from. Once the task is done, a mark shows the right prediction.
fn choices(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    let stop = tour.stop();
    ui.horizontal_wrapped(|ui| {
        let colour = if tour.is_asking() { palette(ui).accent } else { palette(ui).dim };
        ui.label(RichText::new("Your prediction:").color(colour));
        for (index, choice) in stop.choices.iter().enumerate() {
            let is_guess = tour.guess() == Some(index);
            let is_right = tour.is_done() && index == stop.right;
            let words = if is_right { format!("✓ {choice}") } else { (*choice).to_owned() };
            let colour = if is_right { palette(ui).good } else { palette(ui).text };
            let button = Button::new(RichText::new(words).color(colour)).selected(is_guess);
            let response = ui.add(button);
            let role = egui::Role::RadioButton;
            response.widget_info(|| egui::WidgetInfo::selected(role, true, is_guess, *choice));
            if response.clicked() {
                commands.push(Command::View(ViewCommand::Predict(index)));
            }
        }
    });
}
