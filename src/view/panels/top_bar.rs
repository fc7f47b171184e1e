//! The top bar: what runs, how fast, and where time has got to.

use egui::{Align, Button, ComboBox, Label, Layout, RichText, Ui};

use super::{ACCENT, QUIET};
use crate::lab::{Command, Lab, Mode, Pace, SPEED_LADDER, TICK_LADDER};

pub(super) const HEIGHT: f32 = 34.0;

/// Widths of the bar, in points, at which more of it fits.
const ROOM_FOR_MENUS: f32 = 600.0;
const ROOM_FOR_LADDERS: f32 = 840.0;
const ROOM_FOR_PACE: f32 = 1100.0;

pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let width = ui.available_width();
    ui.horizontal_centered(|ui| {
        scene_menu(ui, lab, commands);
        transport(ui, lab, commands);
        let (text, hover) = match lab.mode() {
            Mode::Solo => ("Race all", "race every method from the start line (C)"),
            Mode::Race => ("Solo", "fly the selected lane alone (C)"),
        };
        button(ui, text, hover, Command::ToggleRace, commands);
        if width >= ROOM_FOR_LADDERS {
            ui.separator();
            ui.label(RichText::new("speed").color(QUIET));
            button(ui, "−", "slower (-)", Command::SpeedDown, commands);
            speed_menu(ui, lab, commands);
            button(ui, "+", "faster (=)", Command::SpeedUp, commands);
            ui.label(RichText::new("  tick rate").color(QUIET));
            button(ui, "[", "lower tick rate ([)", Command::TickRateDown, commands);
            tick_rate_menu(ui, lab, commands);
            button(ui, "]", "higher tick rate (])", Command::TickRateUp, commands);
        } else if width >= ROOM_FOR_MENUS {
            speed_menu(ui, lab, commands);
            tick_rate_menu(ui, lab, commands);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            button(ui, "?", "help (H)", Command::ToggleHelp, commands);
            if width >= ROOM_FOR_MENUS {
                inspector_button(ui, lab, commands);
            }
            if width >= ROOM_FOR_PACE {
                pace(ui, lab);
                ui.separator();
            }
            let race = lab.race();
            let time = format!("t = {:.3} s · tick {}", race.t(), race.tick());
            ui.add(Label::new(RichText::new(time).monospace()).truncate());
        });
    });
}

fn scene_menu(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let name = lab.scene_name();
    let menu = ComboBox::from_id_salt("scene").selected_text(&name).width(86.0);
    let response = menu.show_ui(ui, |ui| {
        for (place, name) in lab.shelf().names().enumerate() {
            let is_open = lab.shelf().open() == Some(place);
            if ui.selectable_label(is_open, name).clicked() {
                commands.push(Command::Scene(place));
            }
        }
    });
    let about = format!("{}\n{}", lab.scene().title, lab.scene().about);
    response.response.on_hover_ui(|ui| {
        ui.set_max_width(ui.max_rect().width().min(ui.ctx().content_rect().width() - 32.0));
        ui.label(about);
    });
}

fn transport(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    button(ui, "⏮", "restart (Home)", Command::Restart, commands);
    let (sign, hover) =
        if lab.running() { ("⏸", "pause (Space)") } else { ("▶", "run (Space)") };
    button(ui, sign, hover, Command::TogglePause, commands);
    button(ui, "⏭", "one tick forward (.)", Command::TickForward, commands);
}

fn speed_menu(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let percent = lab.clock().speed_percent();
    let text = RichText::new(format!("{:>3}×", multiple(percent))).monospace();
    ComboBox::from_id_salt("speed").selected_text(text).width(48.0).show_ui(ui, |ui| {
        for rung in SPEED_LADDER {
            let text = format!("{}× real time", multiple(rung));
            if ui.selectable_label(rung == percent, text).clicked() {
                commands.push(Command::SpeedPercent(rung));
            }
        }
    });
}

fn multiple(percent: u32) -> String {
    match percent {
        25 => "¼".into(),
        50 => "½".into(),
        whole if whole % 100 == 0 => format!("{}", whole / 100),
        other => format!("{:.2}", f64::from(other) / 100.0),
    }
}

fn tick_rate_menu(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let tick_hz = lab.clock().tick_hz();
    let text = RichText::new(format!("{tick_hz:>4} Hz")).monospace();
    ComboBox::from_id_salt("tick rate").selected_text(text).width(64.0).show_ui(ui, |ui| {
        for rung in TICK_LADDER {
            if ui.selectable_label(rung == tick_hz, format!("{rung} Hz")).clicked() {
                commands.push(Command::TickHz(rung));
            }
        }
    });
}

fn pace(ui: &mut Ui, lab: &Lab) {
    // Paused, no frame is drawn but for an event, and no time goes by.
    if !lab.running() {
        ui.label(RichText::new("paused").color(ACCENT));
        return;
    }
    let text = match lab.viewer().pace {
        Some(Pace::Measured { frames_per_second, real_time_factor }) => {
            format!("{frames_per_second:5.1} fps · {real_time_factor:.2}× real time")
        }
        Some(Pace::Unknown) => return,
        None => "scripted time".into(),
    };
    ui.label(RichText::new(text).monospace().color(QUIET))
        .on_hover_text("frames drawn per second · simulated seconds per second");
}

fn inspector_button(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let (is_open, about) = (lab.display().inspector, "inspector (E)");
    let response = ui.add(Button::new("Edit").selected(is_open)).on_hover_text(about);
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_open, about));
    if response.clicked() {
        commands.push(Command::ToggleInspector);
    }
}

fn button(ui: &mut Ui, text: &str, hover: &str, command: Command, commands: &mut Vec<Command>) {
    let response = ui.add(Button::new(text)).on_hover_text(hover);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, hover));
    if response.clicked() {
        commands.push(command);
    }
}
