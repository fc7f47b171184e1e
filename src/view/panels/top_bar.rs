//! The top bar: the scene, the control of the run and its speed, and the present time.

use egui::{
    Align, Button, ComboBox, Frame, Label, Layout, RichText, Sense, TextWrapMode, Ui, vec2,
};

use super::loops::controls;
use super::{breakpoints, rate_scale};
use crate::loops::loop_lab::{LoopCommand, SLOWNESS};
use crate::run::race::Mode;
use crate::scene::{SCENES, Scene};
use crate::studio::{
    Command, RunCommand, SPEED_LADDER, StageCommand, Step, Studio, ViewCommand, shown_s,
    shown_tick, slowed_in_words,
};
use crate::theme::{TYPE, palette, strong_font};

pub(super) const HEIGHT: f32 = 40.0;

pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let width = ui.available_width();
    ui.horizontal_centered(|ui| {
        scene_menu(ui, studio, width, commands);
        // The menu of scenes offers the spring if the top bar is narrower than this.
        if width >= breakpoints::SPRING {
            let about = "a spring of your own: the recommended method, and its code (S)";
            let words = if width >= breakpoints::MY_SPRING { "My spring" } else { "Spring" };
            button(ui, words, about, Command::View(ViewCommand::AskForSpring), commands);
        }
        transport(ui, studio, width, commands);
        if width >= breakpoints::MENUS {
            word(ui, width, "speed");
            speed_menu(ui, studio, commands);
            word(ui, width, "tick rate");
            tick_rate(ui, studio, commands);
        }
        modes(ui, studio, width, commands);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            button(ui, "?", "help (H)", Command::View(ViewCommand::ToggleHelp), commands);
            let is_wide = width >= breakpoints::WORDS_IN_TOP_BAR;
            let time = match studio.loop_lab() {
                Some(loops) => {
                    if width >= breakpoints::PACE {
                        controls::display(ui, loops);
                    }
                    if controls::has_trace_menu_above(ui) {
                        controls::trace_menu(ui, loops, commands);
                        ui.separator();
                    }
                    controls::moment(loops, is_wide)
                }
                None => {
                    if width >= breakpoints::MENUS {
                        inspector_button(ui, studio, commands);
                    }
                    let t = shown_s(studio);
                    match is_wide {
                        true => {
                            let tick = shown_tick(studio);
                            let slowed = slowed_in_words(studio);
                            let slowed = slowed.map(|words| format!(" · {words}"));
                            format!("t = {t:.3} s · tick {tick}{}", slowed.unwrap_or_default())
                        }
                        false => format!("{t:.3} s"),
                    }
                }
            };
            if ui.available_width() >= breakpoints::TIME_IN_TOP_BAR {
                ui.add(Label::new(RichText::new(time).font(strong_font(TYPE))).truncate());
            }
        });
    });
}

fn word(ui: &mut Ui, width: f32, word: &str) {
    if width >= breakpoints::WORDS_IN_TOP_BAR {
        ui.label(RichText::new(format!("  {word}")).color(palette(ui).dim));
    }
}

/// Shows the menu of scenes by name, with the title beside each name, below the headings of the groups.
fn scene_menu(ui: &mut Ui, studio: &Studio, width: f32, commands: &mut Vec<Command>) {
    let name = studio.deck.scene_name();
    let menu = ComboBox::from_id_salt("scene").selected_text(&name).height(480.0);
    let menu = match width >= breakpoints::WIDE_PARTS_OF_TOP_BAR {
        true => menu.width(92.0),
        false => menu.width(60.0).truncate(),
    };
    let response = menu.show_ui(ui, |ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        for (name, command) in [
            ("My spring … (S)", ViewCommand::AskForSpring),
            ("My lines … (Shift S)", ViewCommand::AskForLines),
            ("Compare with… (Shift O)", ViewCommand::AskForRun),
            ("Figures of the book … (Shift G)", ViewCommand::ToggleFigures),
        ] {
            if ui.selectable_label(false, RichText::new(name).font(strong_font(TYPE))).clicked() {
                commands.push(Command::View(command));
            }
        }
        let group = |index: usize| SCENES.get(index).map_or("Files", |scene| scene.group.title());
        for (index, name) in studio.deck.scene_list().names().enumerate() {
            if index == 0 || group(index) != group(index - 1) {
                ui.label(RichText::new(group(index)).size(11.0).color(palette(ui).dim));
            }
            let is_open = studio.deck.scene_list().open() == Some(index);
            let title = SCENES.get(index).and_then(|scene| Scene::built_in(scene.name));
            let title = title.map(|scene| scene.title).unwrap_or_default();
            let mut line = egui::text::LayoutJob::default();
            let part = |font, colour| egui::TextFormat::simple(font, colour);
            line.append(&name, 0.0, part(strong_font(TYPE), palette(ui).text));
            line.append(&title, 12.0, part(egui::FontId::proportional(TYPE), palette(ui).dim));
            if ui.selectable_label(is_open, line).clicked() {
                commands.push(Command::Stage(StageCommand::Scene(index)));
            }
        }
    });
    let about = format!("{}\n{}", studio.scene().title, studio.scene().about);
    response.response.on_hover_ui(|ui| {
        ui.set_max_width(ui.max_rect().width().min(ui.ctx().content_rect().width() - 32.0));
        ui.label(about);
    });
}

fn transport(ui: &mut Ui, studio: &Studio, width: f32, commands: &mut Vec<Command>) {
    let unit = if studio.loop_lab().is_some() { "frame" } else { "tick" };
    button(ui, "⏮", "restart (Home)", Command::Stage(StageCommand::Restart), commands);
    if width >= breakpoints::TICK_BACK {
        button(
            ui,
            "◀",
            &format!("one {unit} back (,)"),
            Command::Stage(StageCommand::Tick(Step::Previous)),
            commands,
        );
    }
    let (sign, hover) =
        if studio.running() { ("⏸", "pause (Space)") } else { ("▶", "run (Space)") };
    button(ui, sign, hover, Command::View(ViewCommand::TogglePause), commands);
    if width >= breakpoints::TICK_FORWARD {
        button(
            ui,
            "⏭",
            &format!("one {unit} forward (.)"),
            Command::Stage(StageCommand::Tick(Step::Next)),
            commands,
        );
    }
}

/// Shows one control of three parts: solo, race and loop lab.
fn modes(ui: &mut Ui, studio: &Studio, width: f32, commands: &mut Vec<Command>) {
    ui.add_space(4.0);
    let is_in_loops = studio.loop_lab().is_some();
    let toggle_loops = Command::Loop(LoopCommand::ToggleLab);
    // In the loop lab, the command for a race would lead to the mode that is not selected.
    let to_mode = |mode: Mode| match is_in_loops && studio.mode() == mode {
        true => toggle_loops.clone(),
        false => Command::Stage(StageCommand::ToggleRace),
    };
    let is_in = |mode: Mode| !is_in_loops && studio.mode() == mode;
    let parts = [
        (
            "Solo",
            "run one method, and switch it while it runs (C)",
            is_in(Mode::Solo),
            to_mode(Mode::Solo),
        ),
        (
            "Race",
            "race every method from the start line (C)",
            is_in(Mode::Race),
            to_mode(Mode::Race),
        ),
        (
            "Loop lab",
            "see one motion in every game loop, in slow motion (L)",
            is_in_loops,
            toggle_loops,
        ),
    ];
    let frame = Frame::new().fill(palette(ui).raised).corner_radius(5.0);
    frame.show(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        // A bar that has no room for a tick forward has none for wide margins either.
        let margin = match width {
            _ if width >= breakpoints::TICK_FORWARD => 12.0,
            _ if width >= breakpoints::WIDE_PARTS_OF_TOP_BAR => 7.0,
            _ => 4.0,
        };
        for (name, about, is_chosen, command) in parts {
            if part(ui, name, margin, about, is_chosen) && !is_chosen {
                commands.push(command);
            }
        }
    });
}

/// Shows a part of a control, with this margin to the left and right of its name. Returns whether the part was clicked.
fn part(ui: &mut Ui, name: &str, margin: f32, about: &str, is_chosen: bool) -> bool {
    let font = || if is_chosen { strong_font(TYPE) } else { egui::FontId::proportional(TYPE) };
    let text = ui.painter().layout_no_wrap(name.into(), font(), palette(ui).text);
    let size = vec2(text.size().x + 2.0 * margin, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::Role::RadioButton, true, is_chosen, name));
    if is_chosen {
        ui.painter().rect_filled(rect, 6.0, palette(ui).accent);
    } else if response.hovered() || response.has_focus() {
        let stroke = egui::Stroke::new(1.0, palette(ui).accent);
        ui.painter().rect_stroke(rect, 6.0, stroke, egui::StrokeKind::Inside);
    }
    let colour = if is_chosen { palette(ui).on_accent } else { palette(ui).text };
    let at = rect.center();
    ui.painter().text(at, egui::Align2::CENTER_CENTER, name, font(), colour);
    response.on_hover_text(about).clicked()
}

fn speed_menu(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let (chosen, all, name) = match studio.loop_lab() {
        Some(loops) => (loops.slowness(), &SLOWNESS[..], controls::speed as fn(u32) -> String),
        None => (studio.clock().speed_percent(), &SPEED_LADDER[..], multiple as _),
    };
    let menu = ComboBox::from_id_salt("speed").selected_text(name(chosen)).width(54.0);
    let response = menu.height(400.0).show_ui(ui, |ui| {
        for &speed in all {
            let text = format!("{} real time", name(speed));
            if ui.selectable_label(speed == chosen, text).clicked() {
                commands.push(match studio.loop_lab() {
                    Some(_) => Command::Loop(LoopCommand::Slowness(speed)),
                    None => Command::Run(RunCommand::SpeedPercent(speed)),
                });
            }
        }
    });
    response.response.on_hover_text(match studio.loop_lab() {
        Some(_) => {
            "playback speed of the frames (- and =); if faster, a monitor adds its own judder"
        }
        None => "simulated seconds per second (- and =)",
    });
}

fn multiple(percent: u32) -> String {
    match percent {
        25 => "¼×".into(),
        50 => "½×".into(),
        whole if whole % 100 == 0 => format!("{}×", whole / 100),
        other => format!("{:.2}×", f64::from(other) / 100.0),
    }
}

fn tick_rate(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let response = rate_scale::number(ui, studio, vec2(76.0, 26.0), commands);
    response.on_hover_text("ticks per simulated second: drag it, or click and type ([ and ])");
}

fn inspector_button(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let (is_open, about) = (studio.display().inspector, "edit parameters, methods and rates (E)");
    let response = ui.add(Button::new("Edit").selected(is_open)).on_hover_text(about);
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_open, about));
    if response.clicked() {
        commands.push(Command::Run(RunCommand::ToggleInspector));
    }
}

fn button(ui: &mut Ui, text: &str, hover: &str, command: Command, commands: &mut Vec<Command>) {
    let response = ui.add(Button::new(text)).on_hover_text(hover);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, hover));
    if response.clicked() {
        commands.push(command);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::testing::TestWindow;

    #[test]
    fn the_scene_menu_also_offers_a_comparison() {
        let studio = Studio::new(Scene::built_in("spring").unwrap());
        let mut window = TestWindow::new([1280.0, 800.0]);
        let place = |window: &mut TestWindow, words: &str| {
            (0..2).for_each(|_| drop(window.panels(&studio, Vec::new())));
            let all = window.panels(&studio, Vec::new()).1.all();
            let found = all.iter().find(|(_, text)| text == words);
            found.unwrap_or_else(|| panic!("{words}: {all:?}")).0.center()
        };
        let at = place(&mut window, "spring");
        assert_eq!(window.click(&studio, at), []);
        let at = place(&mut window, "Compare with… (Shift O)");
        let asked = window.click(&studio, at);
        assert_eq!(asked, [Command::View(ViewCommand::AskForRun)]);
    }
}
