//! The inspector's settings of lanes and times, namely methods, substeps, tolerances, the tick rate, and the length of
//! the scene.

use egui::{ComboBox, RichText, Ui, vec2};

use super::{LINE, RESTORE, hold_during_drag, line, restore_button};
use crate::panels::number_field::NumberField;
use crate::panels::rate_scale;
use crate::run::race::{Entrant, Mode};
use crate::scene::{
    Action, LaneSpec, MAX_SECONDS, MAX_SUBSTEPS, MIN_SECONDS, TOLERANCES, check_entered,
};
use crate::stage::Range;
use crate::studio::{Command, RunCommand, StageCommand, Studio};
use crate::theme::palette;

/// Widths of the fields of a lane, in points.
const SUBSTEPS: f32 = 44.0;
const TOLERANCE: f32 = 64.0;
const LANE: f32 = 16.0;

pub(super) fn show_lanes(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    for entrant in studio.race().entrants() {
        ui.horizontal(|ui| show_lane(ui, studio, entrant, commands));
    }
}

fn show_lane(ui: &mut Ui, studio: &Studio, entrant: &Entrant, commands: &mut Vec<Command>) {
    let lane = entrant.id;
    let spec = entrant.spec;
    let ids = ["substeps", "tolerance"].map(|field| ui.scope_id().with((lane, field)));
    let number = number(studio, entrant);
    let digits =
        RichText::new(number.to_string()).color(palette(ui).style(studio.entries(), &spec).0);
    ui.add_sized([LANE, LINE], egui::Label::new(digits.strong()));
    let gap = ui.spacing().item_spacing.x;
    // Names have the room of tolerances where no lane has one: with its rule for impacts a name is long.
    let has_tolerances =
        studio.race().entrants().iter().any(|it| it.spec.method.tolerance.is_some());
    let tolerance_and_gap = if has_tolerances { TOLERANCE + gap } else { 0.0 };
    let width = ui.available_width() - SUBSTEPS - tolerance_and_gap - RESTORE - 3.0 * gap;
    show_methods(ui, studio, entrant, width.max(60.0), commands);
    let substeps = NumberField {
        id: ids[0],
        value: f64::from(spec.substeps),
        unit: "×",
        name: &format!("substeps of lane {number}"),
        is_whole: true,
    };
    let (response, entered) = substeps.show(ui, vec2(SUBSTEPS, LINE), |it| {
        check_entered("substeps", it, Range::Count(MAX_SUBSTEPS))
    });
    hold_during_drag(&response, studio, commands);
    response.on_hover_text("equal steps in a tick");
    let act = |action| Command::Run(RunCommand::Act(action));
    commands.extend(entered.map(|value| act(Action::Substeps { lane, substeps: value as u32 })));
    match spec.method.tolerance {
        Some(card) => {
            let tolerance = NumberField {
                id: ids[1],
                value: spec.tolerance.unwrap_or(card.absolute_v),
                unit: "",
                name: &format!("tolerance of lane {number}"),
                is_whole: false,
            };
            let (response, entered) = tolerance.show(ui, vec2(TOLERANCE, LINE), |value| {
                check_entered("tolerance", value, Range::Between(TOLERANCES.0, TOLERANCES.1))
            });
            hold_during_drag(&response, studio, commands);
            response.on_hover_text("tolerance: the largest error of a substep");
            commands.extend(entered.map(|tolerance| act(Action::Tolerance { lane, tolerance })));
        }
        None if has_tolerances => {
            ui.allocate_exact_size(vec2(TOLERANCE, LINE), egui::Sense::hover());
        }
        None => {}
    }
    let opened = opened(studio, entrant);
    let about = format!("back to {}", opened.method.name);
    restore_button(ui, spec != opened, &about, &format!("lane {number}"), || {
        commands.push(act(Action::Lane { lane, spec: opened }));
    });
}

/// Returns the number of a lane. In solo mode this is the digit of the present method.
fn number(studio: &Studio, entrant: &Entrant) -> usize {
    match studio.mode() {
        Mode::Solo => studio.entry(entrant) + 1,
        Mode::Race => entrant.id.0,
    }
}

fn show_methods(
    ui: &mut Ui,
    studio: &Studio,
    entrant: &Entrant,
    width: f32,
    commands: &mut Vec<Command>,
) {
    let present = entrant.spec;
    let menu = ComboBox::from_id_salt(("method", entrant.id)).width(width).truncate();
    let name = |spec: &LaneSpec| spec.distinct_name(spec.method.name, studio.entries());
    let menu = menu.selected_text(RichText::new(name(&present)).color(palette(ui).text));
    menu.show_ui(ui, |ui| {
        for (entry, spec) in studio.entries().iter().enumerate() {
            let is_present = entry == studio.entry(entrant);
            let label = ui.selectable_label(is_present, name(spec));
            if label.on_hover_text(spec.method.about).clicked() && !is_present {
                commands.push(match studio.mode() {
                    Mode::Solo => Command::Stage(StageCommand::Pick(entry)),
                    Mode::Race => Command::Run(RunCommand::Act(Action::Lane {
                        lane: entrant.id,
                        spec: *spec,
                    })),
                });
            }
        }
    });
}

/// Returns the settings of a lane in the scene as opened. In solo mode these are the settings that the scene has for
/// the present method.
fn opened(studio: &Studio, entrant: &Entrant) -> LaneSpec {
    let present = entrant.spec;
    let list = studio.deck.scene_as_opened().method_list();
    let lane = list
        .get(entrant.id.index())
        .filter(|_| studio.mode() == Mode::Race)
        .filter(|_| entrant.id.index() < studio.deck.scene_as_opened().lanes.len());
    let listed = || list.iter().find(|spec| spec.method == present.method);
    *lane.or_else(listed).unwrap_or(&present)
}

pub(super) fn show_time(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let opened = studio.deck.scene_as_opened();
    let tick_hz = studio.race().tick_hz();
    let about = "ticks per second; a change restarts every method from its present state";
    line(ui, "tick rate", about, |ui, [room, number]| {
        ui.add_space(room - number - RESTORE - ui.spacing().item_spacing.x);
        let size = vec2(number, LINE);
        rate_scale::number(ui, studio, size, commands);
        let about = format!("back to {:.3} Hz", opened.tick_hz);
        restore_button(ui, tick_hz != opened.tick_hz, &about, "tick rate", || {
            commands.push(Command::Stage(StageCommand::TickHz(opened.tick_hz)));
        });
    });
    let seconds = studio.scene().seconds;
    let length = NumberField {
        id: ui.scope_id().with("length"),
        value: seconds,
        unit: "s",
        name: "length of the scene",
        is_whole: false,
    };
    line(
        ui,
        "length",
        "how long the scene is: plots and verdicts cover it",
        |ui, [room, number]| {
            ui.add_space(room - number - RESTORE - ui.spacing().item_spacing.x);
            let size = vec2(number, LINE);
            let check = |it| check_entered("length", it, Range::Between(MIN_SECONDS, MAX_SECONDS));
            let (_, entered) = length.show(ui, size, check);
            commands.extend(entered.map(|it| Command::Run(RunCommand::Seconds(it))));
            let about = format!("back to {} s", opened.seconds);
            restore_button(ui, seconds != opened.seconds, &about, "length", || {
                commands.push(Command::Run(RunCommand::Seconds(opened.seconds)));
            });
        },
    );
}

/// Returns the commands that restore the scene's lanes, tick rate and length. There are none if nothing differs.
pub(super) fn restore_run_commands(studio: &Studio) -> impl Iterator<Item = Command> {
    let lanes = studio.race().entrants().iter().filter_map(|entrant| {
        let (lane, spec) = (entrant.id, opened(studio, entrant));
        let is_changed = entrant.spec != spec;
        is_changed.then_some(Command::Run(RunCommand::Act(Action::Lane { lane, spec })))
    });
    let opened = studio.deck.scene_as_opened();
    let rate = (studio.race().tick_hz() != opened.tick_hz)
        .then_some(Command::Stage(StageCommand::TickHz(opened.tick_hz)));
    let length = (studio.scene().seconds != opened.seconds)
        .then_some(Command::Run(RunCommand::Seconds(opened.seconds)));
    lanes.chain(rate).chain(length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn in_solo_the_number_of_the_method_follows_a_switch() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::Pick(2));
        assert_eq!(number(&studio, studio.selected()), 3);
        studio.apply(StageCommand::Method(studio.entries()[7].method));
        assert_eq!(number(&studio, studio.selected()), 8);
        studio.apply(StageCommand::ToggleRace);
        let is_of_lane = |entrant: &Entrant| number(&studio, entrant) == entrant.id.0;
        assert!(studio.race().entrants().iter().all(is_of_lane));
    }
}
