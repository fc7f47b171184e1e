//! The guide, under the stage: the question of its stop, the choices, the key to press, and the answer.

use egui::{Align, Button, Layout, RichText, ScrollArea, Ui, vec2};

use super::{ink, keycap};
use crate::lab::{Command, STOPS, Tour};
use crate::view::theme::strong_font;

pub(super) const HEIGHT: f32 = 172.0;

pub(super) fn show(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing = vec2(6.0, 5.0);
    head(ui, tour, commands);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let stop = tour.stop();
        ui.label(stop.question);
        choices(ui, tour, commands);
        if tour.is_done() {
            let said = match tour.guess() {
                Some(guess) if guess == stop.right => "Right. ",
                Some(_) => "Not quite. ",
                None => "",
            };
            keycap::paragraph(ui, &format!("{said}{}", stop.answer), ink(ui).text);
        } else {
            keycap::paragraph(ui, stop.task, ink(ui).text);
        }
    });
}

fn head(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    let place = tour.place();
    let count = STOPS.len();
    ui.horizontal(|ui| {
        let title = format!("{}. {}", place + 1, tour.stop().title);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text("close the guide (Esc)").clicked() {
                commands.push(Command::ToggleGuide);
            }
            let dim = ink(ui).dim;
            let key = |name: &str| RichText::new(name).size(11.0).color(dim);
            let next = Button::new("Next").right_text(key("Page Down"));
            let next = if tour.is_done() { next.selected(true) } else { next };
            let next = ui.add_enabled(place + 1 < count, next);
            next.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Button, place + 1 < count, "Next (Page Down)")
            });
            if next.clicked() {
                commands.push(Command::NextStop);
            }
            let back = ui.add_enabled(place > 0, Button::new("Back").right_text(key("Page Up")));
            back.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Button, place > 0, "Back (Page Up)")
            });
            if back.clicked() {
                commands.push(Command::PreviousStop);
            }
            if ui.button("⏮").on_hover_text("show this stop again").clicked() {
                commands.push(Command::GoToStop(place));
            }
            ui.label(RichText::new(format!("{} of {count}", place + 1)).color(ink(ui).dim));
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let title = RichText::new(title).font(strong_font(15.0));
                ui.add(egui::Label::new(title).truncate());
            });
        });
    });
}

/// The predictions to choose from. Once the task is done, the right one is marked.
fn choices(ui: &mut Ui, tour: &Tour, commands: &mut Vec<Command>) {
    let stop = tour.stop();
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Your prediction:").color(ink(ui).dim));
        for (place, choice) in stop.choices.iter().enumerate() {
            let is_guess = tour.guess() == Some(place);
            let is_right = tour.is_done() && place == stop.right;
            let words = if is_right { format!("✓ {choice}") } else { (*choice).to_owned() };
            let colour = if is_right { ink(ui).good } else { ink(ui).text };
            let button = Button::new(RichText::new(words).color(colour)).selected(is_guess);
            let response = ui.add(button);
            let role = egui::Role::RadioButton;
            response.widget_info(|| egui::WidgetInfo::selected(role, true, is_guess, *choice));
            if response.clicked() {
                commands.push(Command::Predict(place));
            }
        }
    });
}
