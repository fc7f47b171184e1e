//! A spring with the user's own numbers: a field for each number, and a button that asks for advice on the spring.

use egui::{Align, Align2, Button, ComboBox, FontId, Id, Layout, Rect, RichText, Sense, Ui, vec2};

use super::number_field::NumberField;
use super::parts::dialog;
use super::text_field::select;
use crate::scene::TickRate;
use crate::studio::{Command, MySpring, SpringField, StageCommand, Studio, ViewCommand};
use crate::theme::{TYPE, palette};
use crate::tools::port::{UI_SPRINGS, USUAL_FRAME_HZ, UiSpring, UiSpringPort};
use crate::tools::source_code::Language;

const TITLE: &str = "My spring";
/// Width of a name, width of a number, height of a line, and width of a line, in points.
const NAME: f32 = 118.0;
const NUMBER: f32 = 150.0;
const LINE: f32 = 22.0;
const WIDTH: f32 = NAME + NUMBER + 8.0;
/// Gap between the numbers and the spring that swings, and the frame of the dialog on all sides, in points.
const BETWEEN: f32 = 16.0;
const FRAME: f32 = 40.0;
/// Height of the dialog's numbers, and of the curves below and beside them, in points.
const NUMBERS: f32 = 480.0;
const CURVES: f32 = 160.0;
const WIDE_CURVES: f32 = 300.0;

mod response;

pub(super) fn show(
    ui: &Ui,
    studio: &Studio,
    tick_hz: TickRate,
    over: Rect,
    commands: &mut Vec<Command>,
) {
    let ctx = ui.ctx();
    let spring = studio.viewer.my_spring();
    let is_wide = over.width() >= WIDTH + BETWEEN + response::WIDTH + FRAME;
    let left = over.height() - NUMBERS - response::BESIDES_CURVES - FRAME;
    let curves = if is_wide { WIDE_CURVES } else { left.min(CURVES) };
    dialog(TITLE, over).show(ctx, |ui| {
        let columns = if is_wide { Layout::left_to_right(Align::Min) } else { Layout::default() };
        ui.with_layout(columns, |ui| {
            ui.vertical(|ui| numbers(ui, spring, tick_hz, commands));
            if curves >= CURVES {
                ui.add_space(if is_wide { BETWEEN } else { 0.0 });
                ui.vertical(|ui| response::show(ui, spring, tick_hz, curves, commands));
            }
        });
    });
}

/// Shows the numbers, and the buttons below them.
fn numbers(ui: &mut Ui, spring: MySpring, tick_hz: TickRate, commands: &mut Vec<Command>) {
    ui.set_width(WIDTH);
    ui.spacing_mut().item_spacing.y = 4.0;
    let has_focus = ui.memory(|m| m.focused().is_some());
    let is_new = is_new(ui);
    for (i, number) in SpringField::constant_fields(spring).into_iter().enumerate() {
        line(ui, "", number, is_new && i == 0, commands);
    }
    ui.label(RichText::new("or as frequency and damping").color(palette(ui).dim));
    for number in SpringField::motion_fields(spring) {
        line(ui, "", number, false, commands);
    }
    let seen = spring.response_in_words();
    ui.label(RichText::new(seen).color(palette(ui).dim));
    if let Some((dialect, port)) = show_dialect(ui, spring)
        && dialect.is_read()
    {
        for number in SpringField::of_dialect(dialect, &port.values, spring) {
            line(ui, dialect.id, number, false, commands);
        }
    }
    ui.label(RichText::new("release").color(palette(ui).dim));
    for number in SpringField::of_release(spring) {
        line(ui, "", number, false, commands);
    }
    ui.label(RichText::new("run").color(palette(ui).dim));
    line(ui, "", SpringField::tick_rate(tick_hz), false, commands);
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        let words = format!("Run it at {tick_hz:.3} Hz");
        let advise = ui.add(Button::new(RichText::new(words).size(TYPE).strong()));
        // A number that the user has just clicked keeps the focus.
        if !is_new && !has_focus && ui.memory(|m| m.focused().is_none()) {
            // After a number was typed, Enter presses the button.
            advise.request_focus();
        }
        if advise.clicked() {
            commands.push(Command::Stage(StageCommand::OpenSpring));
        }
        if ui.button("Close (Esc)").clicked() {
            commands.push(Command::View(ViewCommand::CloseDialog));
        }
    });
    let [others @ .., last] = Language::ALL.map(Language::name);
    let told =
        format!("Under the recommended method, with its code in {} or {last}.", others.join(", "));
    ui.label(RichText::new(told).size(11.5).color(palette(ui).dim));
}

/// Whether this is the first frame that shows the dialog.
fn is_new(ui: &Ui) -> bool {
    let (id, now) = (Id::unique("my spring was shown"), ui.ctx().cumulative_frame_nr());
    let last = ui.data_mut(|data| {
        let last = data.get_temp::<u64>(id);
        data.insert_temp(id, now);
        last
    });
    last.is_none_or(|last| last + 1 < now)
}

/// Shows the spring's numbers in the selected library, below a menu of libraries. A button copies the line of code for
/// it.
fn show_dialect(ui: &mut Ui, spring: MySpring) -> Option<(&'static UiSpring, UiSpringPort)> {
    let id = Id::unique("my spring speaks");
    let chosen = ui.data(|data| data.get_temp::<Option<usize>>(id)).flatten();
    let name = |index: Option<usize>| index.map_or("as a UI spring of…", |i| UI_SPRINGS[i].name);
    let dialect = chosen.map(|index| &UI_SPRINGS[index]);
    let told = dialect.map(|dialect| (dialect, dialect.port(&spring.wish(), USUAL_FRAME_HZ)));
    ui.horizontal(|ui| {
        let menu =
            ComboBox::from_id_salt(id).selected_text(name(chosen)).width(NAME + NUMBER - 56.0);
        let menu = menu.truncate().show_ui(ui, |ui| {
            for index in [None].into_iter().chain((0..UI_SPRINGS.len()).map(Some)) {
                if ui.selectable_label(index == chosen, name(index)).clicked() {
                    ui.data_mut(|data| data.insert_temp(id, index));
                }
            }
        });
        let about = format!("the library for its numbers: {}", name(chosen));
        menu.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &about));
        let code = told.as_ref().map(|(_, port)| port.code.clone()).filter(|code| !code.is_empty());
        let copy = ui.add_enabled(code.is_some(), Button::new("Copy"));
        if let Some(code) = code
            && copy.on_hover_text(&code).clicked()
        {
            ui.copy_text(code);
        }
    });
    told
}

fn line(
    ui: &mut Ui,
    among: &str,
    field: SpringField,
    takes_focus: bool,
    commands: &mut Vec<Command>,
) {
    let SpringField { name, unit, value, is_whole, set } = field;
    let id = Id::unique(("my spring", among, name));
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(NAME, LINE), Sense::hover());
        let font = FontId::proportional(TYPE);
        ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, name, font, palette(ui).text);
        let field = NumberField { id, value, unit, name, is_whole };
        let (response, entered) =
            field.show(ui, vec2(NUMBER, LINE), |entered| set(entered).map(drop));
        if takes_focus {
            response.request_focus();
            select(ui.ctx(), response.id, 0);
        }
        commands.extend(entered.and_then(|entered| set(entered).ok()).map(Command::View));
    });
}

#[cfg(test)]
mod tests {
    use egui::{Event, Key, Modifiers};

    use super::*;
    use crate::scene::Scene;
    use crate::tests::testing::{TestWindow, button};

    #[test]
    fn the_spring_swings_beside_its_numbers_or_below_them_where_there_is_room() {
        for (size, is_shown) in
            [([1280.0, 720.0], true), ([800.0, 600.0], true), ([390.0, 844.0], true)]
                .into_iter()
                .chain([([600.0, 400.0], false)])
        {
            let mut studio = Studio::new(Scene::built_in("spring").unwrap());
            studio.apply(ViewCommand::ToggleMeasure);
            studio.apply(ViewCommand::AskForSpring);
            let mut window = TestWindow::new(size);
            let mut seen = |studio: &Studio| {
                (0..3).for_each(|_| drop(window.panels(studio, Vec::new())));
                window.panels(studio, Vec::new()).1.whole()
            };
            let all = seen(&studio);
            let words: Vec<&str> = all.iter().map(|(_, words)| words.as_str()).collect();
            for part in ["60 Hz: overshoots 94 %", "144 Hz: overshoots 94 %", "time, s"] {
                assert_eq!(words.contains(&part), is_shown, "{part} at {size:?}: {words:?}");
            }
            let button = words.iter().any(|words| words.starts_with("Run it at"));
            assert!(button || size[1] < 500.0, "{size:?}: {words:?}");
        }
    }

    #[test]
    fn an_error_message_moves_no_field_of_the_dialog() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(ViewCommand::AskForSpring);
        let mut window = TestWindow::new([1280.0, 800.0]);
        let mut frames = |events: Vec<Event>| {
            for event in events.into_iter().map(Some).chain(vec![None; 4]) {
                for command in window.panels(&studio, event.into_iter().collect()).0 {
                    studio.apply(command);
                }
            }
            window.panels(&studio, Vec::new()).1.all()
        };
        let key = |key| Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        let names =
            ["mass", "stiffness", "damping ratio", "gravity", "tick rate", "Run it at 60 Hz"];
        let places = |all: &[(Rect, String)]| {
            names.map(|name| {
                let found = all.iter().find(|(_, words)| words == name);
                found.unwrap_or_else(|| panic!("{name}: {all:?}")).0
            })
        };
        let before = places(&frames(Vec::new()));
        // The first field has the focus at the start.
        for (typed, sentence) in [
            ("nan", "`nan` is not a number"),
            ("-5", "mass would be -5; it must be from 1e-12 to 1e12"),
        ] {
            let all = frames(vec![Event::Text(typed.into()), key(Key::Enter)]);
            assert!(all.iter().any(|(_, words)| words == sentence), "{sentence}: {all:?}");
            assert_eq!(places(&all), before, "{typed}");
            assert!(all.iter().any(|(_, words)| words.trim() == "12"), "it keeps its number");
            let at = before[0].left_center() + vec2(NAME + NUMBER / 2.0, 0.0);
            frames(vec![Event::PointerMoved(at), button(at, true), button(at, false)]);
        }
    }
}
