//! The inspector. It shows everything that can be edited during a run, from the tables of parameters and methods.

use egui::{
    Align, Button, CollapsingHeader, Label, Layout, Response, RichText, ScrollArea, Slider, Ui,
    Vec2, vec2,
};

use self::rows::{Row, SliderRange, Spacing, Values, rows};
pub(crate) use self::sweep::is_sweep_active;
use super::focus;
use super::number_field::NumberField;
use crate::scene::{Action, check_entered, edited_values};
use crate::stage::TakesEffect;
use crate::studio::{Command, RunCommand, Studio, ViewCommand};
use crate::theme::palette;

mod engine;
mod rows;
mod run;
mod sweep;

/// The height of a line, in points.
const LINE: f32 = 20.0;
/// Widths of a name and of a number field as shares of the line, with their maximums in points, and width of the
/// restore button.
const NUMBER_PART: f32 = 0.3;
const MAX_NUMBER: f32 = 108.0;
const RESTORE: f32 = 20.0;
const NAME_PART: f32 = 0.32;
const MAX_NAME: f32 = 150.0;
/// Maximum share of the line for a name that is longer.
const MAX_NAME_PART: f32 = 0.42;
/// Maximum number of bodies in a scene whose bodies all start unfolded. In larger scenes only the displayed body does.
const FEW_BODIES: usize = 3;

pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    ui.spacing_mut().interact_size.y = LINE;
    ui.spacing_mut().button_padding.y = 1.0;
    ui.horizontal(|ui| {
        ui.label(RichText::new("Edit").size(14.0).strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if named_button(ui, Button::new("×").frame(false), "close Edit (E)").clicked() {
                commands.push(Command::Run(RunCommand::ToggleInspector));
            }
            let restoring = restore_commands(studio);
            let is_edited = !restoring.is_empty() || NumberField::has_faults(ui.ctx());
            let all = ui.add_enabled_ui(is_edited, |ui| {
                named_button(ui, Button::new("↺ Restore all"), "restore every value of the scene")
            });
            if all.inner.clicked() {
                NumberField::forget_faults(ui);
                commands.extend(restoring);
            }
        });
    });
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // Leaves room at the right for the scroll bar, which covers the content.
        ui.set_max_width(ui.available_width() - 8.0);
        let bodies = &studio.scene().bodies;
        for (index, body) in bodies.iter().enumerate() {
            let is_open = bodies.len() <= FEW_BODIES || index == studio.view().body;
            let title = RichText::new(&body.name).color(palette(ui).text);
            let header = CollapsingHeader::new(title).id_salt(("body", &body.name));
            header.default_open(is_open).show_unindented(ui, |ui| {
                show_body(ui, studio, index, commands);
            });
        }
        let lanes = if studio.race().entrants().len() > 1 { "Lanes" } else { "Method" };
        section(ui, lanes, |ui| run::show_lanes(ui, studio, commands));
        section(ui, "Time", |ui| run::show_time(ui, studio, commands));
        focus::follow(ui);
    });
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    let header =
        CollapsingHeader::new(RichText::new(title).color(palette(ui).text)).default_open(true);
    header.show_unindented(ui, contents);
}

fn show_body(ui: &mut Ui, studio: &Studio, body: usize, commands: &mut Vec<Command>) {
    let mut acts = TakesEffect::AtOnce;
    for row in rows(studio, body) {
        if row.parameter.acts != acts {
            acts = row.parameter.acts;
            ui.label(RichText::new("from the next start").size(11.0).color(palette(ui).dim));
        }
        show_row(ui, studio, &row, commands);
    }
    engine::show(ui, studio, body, commands);
}

fn show_row(ui: &mut Ui, studio: &Studio, row: &Row, commands: &mut Vec<Command>) {
    let Row { body, index, parameter, values } = row;
    let kind = &studio.scene().bodies[*body].kind;
    let set = |value| {
        Command::Run(RunCommand::Act(Action::Set { body: *body, parameter: *index, value }))
    };
    let about = format!("{}\n{}, {}", parameter.described(), parameter.key, parameter.range);
    let Some(values) = *values else {
        line(ui, &parameter.quantity(), &about, |ui, _| {
            let points = (studio.race().values(*body).len() - index) / 2;
            let text = RichText::new(format!("{points} points")).color(palette(ui).dim);
            ui.label(text).on_hover_text("as the scene has them");
        });
        return;
    };
    let name = format!("{} of {}", parameter.quantity(), studio.scene().bodies[*body].name);
    let field = NumberField {
        id: ui.scope_id().with((body, index)),
        value: values.present,
        unit: &parameter.unit,
        name: &name,
        is_whole: matches!(
            SliderRange::of(parameter.range, values),
            Some(SliderRange { spacing: Spacing::Whole, .. })
        ),
    };
    let check = |value| {
        let values = match parameter.acts {
            TakesEffect::AtOnce => studio.race().values(*body),
            TakesEffect::AtStart => &studio.scene().bodies[*body].values,
        };
        check_entered(&parameter.quantity(), value, parameter.range)?;
        let checked = edited_values(kind, values, *index, value);
        checked.map(drop).map_err(|error| error.to_string())
    };
    line(ui, &parameter.quantity(), &about, |ui, [room, number]| {
        let number = number.max(field.width(ui));
        let buttons = RESTORE + sweep::BUTTON + 3.0 * ui.spacing().item_spacing.x;
        let slider = vec2((room - number - buttons).max(1.0), LINE);
        let reach = SliderRange::of(parameter.range, values);
        // A sweep would show nothing if its parameter acts only from the next start.
        let swept_reach = reach.filter(|_| parameter.acts == TakesEffect::AtOnce);
        // A sweep ends with its scene, because another scene has other parameters at the same indices.
        let of = field.id.with(studio.deck.openings());
        let swept = sweep::show(ui, of, swept_reach, values, &name);
        commands.extend(swept.filter(|value| check(*value).is_ok()).map(set));
        let (slid, value) = show_slider(ui, row, values, &name, slider);
        let (dragged, entered) = field.show(ui, vec2(number, LINE), check);
        if parameter.acts == TakesEffect::AtOnce {
            slid.iter().chain([&dragged]).for_each(|it| hold_during_drag(it, studio, commands));
        }
        commands.extend(value.filter(|value| check(*value).is_ok()).map(set));
        commands.extend(entered.map(set));
        let about = format!("back to {} {}", values.opened, parameter.unit);
        restore_button(ui, values.differ(), &about, &name, || commands.push(set(values.opened)));
    });
}

/// Lets time wait while a person drags a value of the run, so that the drag is one action.
fn hold_during_drag(response: &Response, studio: &Studio, commands: &mut Vec<Command>) {
    if response.is_pointer_button_down_on() && !studio.deck.is_tick_rate_held() {
        commands.push(Command::View(ViewCommand::HoldTickRate));
    }
}

/// Shows a slider around the scene's value, if its parameter has a range. Returns the slider's response, and the new
/// value if the user moved the slider.
fn show_slider(
    ui: &mut Ui,
    row: &Row,
    values: Values,
    name: &str,
    size: Vec2,
) -> (Option<Response>, Option<f64>) {
    let id = ui.scope_id().with((row.body, row.index, "reach"));
    let Some(fresh) = SliderRange::of(row.parameter.range, values) else { return (None, None) };
    // A dragged slider keeps its range, although a fresh range would move with the value.
    let held = ui.data(|data| data.get_temp::<SliderRange>(id));
    let SliderRange { low, high, spacing } = held.unwrap_or(fresh);
    let mut value = values.present;
    let slider = Slider::new(&mut value, low..=high).show_value(false);
    let slider = match spacing {
        Spacing::Linear => slider,
        Spacing::Logarithmic(least) => slider.logarithmic(true).smallest_positive(least),
        Spacing::Whole => slider.step_by(1.0),
    };
    ui.spacing_mut().slider_width = size.x;
    let response = ui.add_sized(size, slider);
    response.widget_info(|| egui::WidgetInfo::slider(true, values.present, name));
    if response.dragged() {
        ui.data_mut(|data| data.insert_temp(id, held.unwrap_or(fresh)));
    } else {
        ui.data_mut(|data| data.remove::<SliderRange>(id));
    }
    (Some(response), (value != values.present).then_some(value))
}

/// Shows a line with a name at its left. `rest` lays out the remainder of the line. Its arguments are the widths of the
/// remainder and of a number field.
fn line(ui: &mut Ui, name: &str, about: &str, rest: impl FnOnce(&mut Ui, [f32; 2])) {
    let width = ui.available_width();
    let font = egui::TextStyle::Body.resolve(ui.style());
    let whole =
        ui.painter().layout_no_wrap(name.to_owned(), font, palette(ui).text).size().x.ceil();
    let name_width = (NAME_PART * width).min(MAX_NAME).max(whole.min(MAX_NAME_PART * width));
    ui.horizontal(|ui| {
        let layout = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(vec2(name_width, LINE), layout, |ui| {
            ui.set_min_size(vec2(name_width, LINE));
            let label = Label::new(RichText::new(name).color(palette(ui).text)).truncate();
            ui.add(label).on_hover_text(about);
        });
        let room = width - name_width - ui.spacing().item_spacing.x;
        rest(ui, [room, (NUMBER_PART * width).min(MAX_NUMBER)]);
    });
}

/// Shows the restore button, or leaves its place empty if nothing was changed.
fn restore_button(ui: &mut Ui, is_changed: bool, about: &str, name: &str, then: impl FnOnce()) {
    if !is_changed {
        ui.allocate_exact_size(vec2(RESTORE, LINE), egui::Sense::hover());
        return;
    }
    let text = RichText::new("↺").color(palette(ui).accent);
    let button = ui.add_sized([RESTORE, LINE], Button::new(text).frame(false));
    let name = format!("restore {name}");
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    if button.on_hover_text(about).clicked() {
        then();
    }
}

fn named_button(ui: &mut Ui, button: Button<'_>, about: &str) -> Response {
    let response = ui.add(button).on_hover_text(about);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, about));
    response
}

/// Returns the commands that restore every edited value.
fn restore_commands(studio: &Studio) -> Vec<Command> {
    let changed = (0..studio.scene().bodies.len()).flat_map(|body| {
        let changed = move |row: Row| {
            let opened = row.values.filter(|values| values.differ())?.opened;
            Some(Command::Run(RunCommand::Act(Action::Set {
                body,
                parameter: row.index,
                value: opened,
            })))
        };
        rows(studio, body).into_iter().filter_map(changed)
    });
    let sets: Vec<Command> = changed.collect();
    // The commands are issued twice, because a value may be refused until another value is restored.
    let twice = sets.iter().chain(&sets).cloned();
    twice.chain(run::restore_run_commands(studio)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LaneId, SCENES, Scene};
    use crate::studio::StageCommand;
    use crate::tests::testing::TestWindow;

    /// Returns every visible text in a frame that is high enough for all of the inspector.
    fn texts(studio: &Studio) -> Vec<String> {
        let mut window = TestWindow::new([1280.0, 3000.0]);
        // A header knows its height only after the first frame.
        window.panels(studio, Vec::new());
        window.panels(studio, Vec::new()).1.words()
    }

    #[test]
    fn the_inspector_fits_windows_of_every_width() {
        let mut studio = Studio::new(Scene::built_in("bridge").unwrap());
        studio.apply(RunCommand::ToggleInspector);
        for width in (100..1300).step_by(40) {
            let mut window = TestWindow::new([width as f32, 900.0]);
            for _ in 0..2 {
                window.show(Vec::new(), |ui| {
                    ui.set_max_width(width as f32 / 4.0);
                    show(ui, &studio, &mut Vec::new());
                });
            }
        }
    }

    #[test]
    fn every_parameter_and_every_lane_of_every_scene_is_shown() {
        for scene in SCENES {
            let mut studio = Studio::new(Scene::built_in(scene.name).unwrap());
            studio.apply(StageCommand::ToggleRace);
            studio.apply(RunCommand::ToggleInspector);
            let texts = texts(&studio);
            let count = |wanted: &str| texts.iter().filter(|text| *text == wanted).count();
            let named = |name: &str| {
                let is_of = |text: &&String| {
                    let told = text.strip_prefix(name);
                    told.is_some_and(|told| told.is_empty() || told.starts_with([',', ' ']))
                };
                texts.iter().filter(is_of).count()
            };
            let bodies = &studio.scene().bodies;
            for parameter in bodies.iter().flat_map(|body| &body.kind.parameters) {
                let quantity = parameter.quantity();
                let of_all = bodies.iter().flat_map(|body| &body.kind.parameters);
                let alike = of_all.filter(|other| other.quantity() == quantity).count();
                assert!(count(&quantity) >= alike, "{}: {quantity}: {texts:?}", scene.name);
            }
            for entrant in studio.race().entrants() {
                let name = entrant.spec.method.name;
                // The list of lanes also has the name.
                assert!(named(name) >= 2, "{}: {name}", scene.name);
            }
            for text in ["tick rate", "length"] {
                assert!(count(text) >= 1, "{}: {text}", scene.name);
            }
            // A net has no parameters that act at the start.
            let mut parameters = bodies.iter().flat_map(|body| &body.kind.parameters);
            let has_start = parameters.any(|parameter| parameter.acts == TakesEffect::AtStart);
            assert_eq!(count("from the next start") >= 1, has_start, "{}", scene.name);
        }
    }

    #[test]
    fn restore_all_restores_the_opened_scene() {
        let mut studio = Studio::new(Scene::built_in("chain").unwrap());
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(restore_commands(&studio), []);
        let index = |key| studio.scene().bodies[0].kind.parameter(key).unwrap().0;
        let (masses, plucked) = (index("masses"), index("plucked_mass"));
        let most = studio.scene().bodies[0].values[masses];
        assert!(studio.scene().bodies[0].values[plucked] > 1.0);
        for (parameter, value) in [(plucked, 1.0), (masses, 2.0), (0, 3.0), (plucked, 2.0)] {
            studio.apply(RunCommand::Act(Action::Set { body: 0, parameter, value }));
        }
        studio.apply(RunCommand::Act(Action::Substeps { lane: LaneId(1), substeps: 7 }));
        studio.apply(StageCommand::TickHz(20.into()));
        studio.apply(RunCommand::Seconds(3.0));
        studio.tick();
        assert_ne!(studio.scene().bodies[0].values[masses], most);
        assert_eq!(studio.race().values(0)[masses], most, "until the next start");
        for command in restore_commands(&studio) {
            studio.apply(command);
        }
        assert_eq!(restore_commands(&studio), []);
        assert_eq!(studio.race().values(0), studio.deck.scene_as_opened().bodies[0].values);
        assert_eq!(studio.scene().bodies[0].values, studio.deck.scene_as_opened().bodies[0].values);
        assert_eq!(studio.scene().seconds, studio.deck.scene_as_opened().seconds);
        assert_eq!(studio.race().tick_hz(), studio.deck.scene_as_opened().tick_hz);
        assert_eq!(studio.entries()[0], studio.deck.scene_as_opened().lanes[0]);
    }

    #[test]
    fn a_swept_parameter_rises_and_returns_to_the_last_digit() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(RunCommand::ToggleInspector);
        let mut window = TestWindow::new([1280.0, 900.0]);
        window.context.enable_accesskit();
        window.panels(&studio, Vec::new());
        let all = window.panels(&studio, Vec::new()).1.all();
        let stiffness = all.iter().find(|(_, text)| text == "stiffness").expect("a row").0;
        let is_beside = |rect: &egui::Rect| (rect.center().y - stiffness.center().y).abs() < 6.0;
        let play =
            all.iter().find(|(rect, text)| text == "▶" && is_beside(rect)).expect("a button").0;
        let at = play.center();
        for is_down in [true, false] {
            let events =
                vec![egui::Event::PointerMoved(at), crate::tests::testing::button(at, is_down)];
            assert_eq!(window.panels(&studio, events).0, []);
        }
        let before = studio.race().values(0).to_vec();
        let (mut most, mut last) = (before[1], before[1]);
        for _ in 0..100 {
            window.time_s += 0.1;
            for command in window.panels(&studio, Vec::new()).0 {
                studio.apply(command);
            }
            last = studio.race().values(0)[1];
            most = most.max(last);
        }
        assert!((9.0..=10.01).contains(&(most / before[1])), "{most} of {}", before[1]);
        assert_eq!(last.to_bits(), before[1].to_bits());
    }
}
