//! A spring's numbers in the names and units of an engine. They can be read and set.

use egui::{CollapsingHeader, ComboBox, RichText, Ui, vec2};

use super::{LINE, line};
use crate::panels::number_field::NumberField;
use crate::scene::check_entered;
use crate::stage::Range;
use crate::stage::number::significant;
use crate::studio::{Command, RunCommand, Studio};
use crate::theme::palette;
use crate::tools::port::Setup;

/// Shows the numbers of a spring as the selected engine has them. Shows nothing for any other body.
pub(super) fn show(ui: &mut Ui, studio: &Studio, body: usize, commands: &mut Vec<Command>) {
    let Some(spring) = studio.deck.spring_joint(body) else { return };
    let header = CollapsingHeader::new(RichText::new("as in engine…").color(palette(ui).dim));
    header.id_salt(("engine", body)).show_unindented(ui, |ui| {
        let setups = studio.deck.joint_setups();
        let id = ui.scope_id().with("mode");
        let selected = studio.selected().spec.method;
        let of_lane = setups.iter().position(|setup| setup.method == selected).unwrap_or(0);
        let chosen = ui.data(|data| data.get_temp::<usize>(id)).unwrap_or(of_lane);
        let name = |setup: &Setup| format!("{}, {}", setup.method.name, setup.mode.id);
        let menu = ComboBox::from_id_salt("engine").selected_text(name(&setups[chosen]));
        let menu = menu.width(ui.available_width() - 8.0).show_ui(ui, |ui| {
            for (index, setup) in setups.iter().enumerate() {
                if ui.selectable_label(index == chosen, name(setup)).clicked() {
                    ui.data_mut(|data| data.insert_temp(id, index));
                }
            }
        });
        let about = format!("the engine whose settings are shown: {}", name(&setups[chosen]));
        menu.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &about));
        let setup = setups[chosen];
        let values = setup.mode.values(spring.joint, spring.mass_kg);
        for (index, (setting, value)) in setup.mode.settings().into_iter().zip(values).enumerate() {
            let unit = setting.quantity.unit();
            let field = NumberField {
                id: ui.scope_id().with((chosen, index)),
                value,
                unit,
                name: &format!("{} of {}", setting.name, setup.method.name),
                is_whole: false,
            };
            let range = if index == 0 { Range::POSITIVE } else { Range::NON_NEGATIVE };
            let check = |value| check_entered(setting.name, value, range);
            line(ui, setting.name, "in the engine's own name and unit", |ui, [room, _]| {
                let (_, entered) = field.show(ui, vec2(room, LINE), check);
                let set = |value| {
                    spring.set(setup, index, value).map(|it| Command::Run(RunCommand::Act(it)))
                };
                commands.extend(entered.map(set).into_iter().flatten());
            });
        }
        let lane = studio.entries().iter().find(|spec| spec.method == setup.method);
        let substeps = lane.map_or(setup.substeps, |spec| spec.substeps);
        let seen = Setup { substeps, ..setup }.visible_motion(spring.joint);
        let seen = seen.map_or("a player sees no swing".to_owned(), |seen| {
            let [hz, ratio] = [seen.undamped_hz(), seen.damping_ratio().unwrap_or(0.0)];
            let [hz, ratio] = [hz, ratio].map(|number| significant(number, 3));
            format!("×{substeps}: a player sees {hz} Hz, damping ratio {ratio}")
        });
        ui.label(RichText::new(seen).size(11.0).color(palette(ui).dim));
    });
}
