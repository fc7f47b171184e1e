//! A custom spring: its numbers, each of which can be typed, and a button that asks for advice on it.

use egui::{Align2, Button, ComboBox, FontId, Id, Rect, RichText, Sense, Ui, vec2};

use super::inspector::NumberField;
use super::parts::dialog;
use super::text_field::select;
use crate::studio::{Command, MySpring, StageCommand, Studio, ViewCommand};
use crate::tools::port::{DIALECTS, Dialect, DialectPort, Key, Wish};
use crate::tools::source_code::Language;
use crate::view::theme::{TYPE, palette};

const TITLE: &str = "My spring";
/// The frames per second at which a library is told its numbers, on which these do not depend.
const USUAL_FRAME_HZ: f64 = 60.0;
/// The widths of a name and of a number, and the height of a line, in points.
const NAME: f32 = 118.0;
const NUMBER: f32 = 150.0;
const LINE: f32 = 22.0;

/// A number of the spring: its name, its unit, its value, and the spring with another value.
struct Number {
    name: &'static str,
    unit: &'static str,
    value: f64,
    with: Box<dyn Fn(f64) -> Result<MySpring, String>>,
}

impl Number {
    fn new(
        name: &'static str,
        unit: &'static str,
        value: f64,
        with: impl Fn(f64) -> MySpring + 'static,
    ) -> Self {
        Self { name, unit, value, with: Box::new(move |value| Ok(with(value))) }
    }
}

/// The three that make a spring.
fn made_of(spring: MySpring) -> [Number; 3] {
    let MySpring { mass_kg, stiffness_n_per_m, damping_n_s_per_m, .. } = spring;
    [
        Number::new("mass", "kg", mass_kg, move |mass_kg| MySpring { mass_kg, ..spring }),
        Number::new("stiffness", "N/m", stiffness_n_per_m, move |stiffness_n_per_m| MySpring {
            stiffness_n_per_m,
            ..spring
        }),
        Number::new("damping", "N s/m", damping_n_s_per_m, move |damping_n_s_per_m| MySpring {
            damping_n_s_per_m,
            ..spring
        }),
    ]
}

/// The two that describe it as well, whatever its mass.
fn seen_as(spring: MySpring) -> [Number; 2] {
    let [hz, ratio] = [spring.frequency_hz(), spring.damping_ratio()];
    [
        Number::new("frequency", "Hz", hz, move |hz| spring.swinging(hz, ratio)),
        Number::new("damping ratio", "", ratio, move |ratio| spring.swinging(hz, ratio)),
    ]
}

/// What a library takes of it. One that knows no mass keeps that of the spring.
fn told_to(dialect: &'static Dialect, values: &[f64], spring: MySpring) -> Vec<Number> {
    let number = |(index, key): (usize, &'static Key)| {
        let (value, values) = (values[index], values.to_vec());
        let with = move |value| {
            let mut told = values.clone();
            told[index] = value;
            // The line of code turns a switch on where the motion wants it.
            let switches =
                dialect.keys.iter().zip(&mut told).filter(|(key, _)| key.switch.is_some());
            switches.for_each(|(_, told)| *told = 1.0);
            let wish = dialect.read(&told)?;
            let mass_kg = if dialect.has_mass() { wish.mass_kg } else { spring.mass_kg };
            Ok(spring.told(&Wish { mass_kg, ..wish }))
        };
        Number { name: key.name, unit: "", value, with: Box::new(with) }
    };
    dialect.keys.iter().enumerate().filter(|(_, key)| key.switch.is_none()).map(number).collect()
}

/// How it starts, and what pulls at it.
fn let_go(spring: MySpring) -> [Number; 3] {
    let MySpring { x0_m, v0_m_per_s, gravity_m_per_s2, .. } = spring;
    [
        Number::new("stretch at start", "m", x0_m, move |x0_m| MySpring { x0_m, ..spring }),
        Number::new("velocity at start", "m/s", v0_m_per_s, move |v0_m_per_s| MySpring {
            v0_m_per_s,
            ..spring
        }),
        Number::new("gravity", "m/s²", gravity_m_per_s2, move |gravity_m_per_s2| MySpring {
            gravity_m_per_s2,
            ..spring
        }),
    ]
}

pub(super) fn show(ui: &Ui, studio: &Studio, over: Rect, commands: &mut Vec<Command>) {
    let ctx = ui.ctx();
    dialog(TITLE, over).show(ctx, |ui| {
        ui.set_width(NAME + NUMBER + 8.0);
        ui.spacing_mut().item_spacing.y = 4.0;
        let (tick_hz, has_focus) = (studio.clock().tick_hz(), ui.memory(|m| m.focused().is_some()));
        let is_new = is_new(ui);
        let spring = studio.viewer.my_spring();
        for (i, number) in made_of(spring).into_iter().enumerate() {
            line(ui, "", number, is_new && i == 0, commands);
        }
        ui.label(RichText::new("or by its swing").color(palette(ui).dim));
        for number in seen_as(spring) {
            line(ui, "", number, false, commands);
        }
        if let Some((dialect, port)) = speaks(ui, spring)
            && dialect.is_read()
        {
            for number in told_to(dialect, &port.values, spring) {
                line(ui, dialect.id, number, false, commands);
            }
        }
        ui.label(RichText::new("let go where, and how").color(palette(ui).dim));
        for number in let_go(spring) {
            line(ui, "", number, false, commands);
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let words = format!("Advise at {tick_hz} Hz");
            let advise = ui.add(Button::new(RichText::new(words).size(TYPE).strong()));
            // A number that was clicked has it just now.
            if !is_new && !has_focus && ui.memory(|m| m.focused().is_none()) {
                // After a number was typed, Enter goes on.
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
        let told = format!(
            "Runs it under the recommended method, with its code to copy in {} or {last}.",
            others.join(", ")
        );
        ui.label(RichText::new(told).size(11.5).color(palette(ui).dim));
    });
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

/// The library whose numbers are shown too, which a menu chooses, and what it is told; with a button that copies its line
/// of code.
fn speaks(ui: &mut Ui, spring: MySpring) -> Option<(&'static Dialect, DialectPort)> {
    let id = Id::unique("my spring speaks");
    let chosen = ui.data(|data| data.get_temp::<Option<usize>>(id)).flatten();
    let name = |index: Option<usize>| index.map_or("as a UI spring of…", |i| DIALECTS[i].name);
    let dialect = chosen.map(|index| &DIALECTS[index]);
    let told = dialect.map(|dialect| (dialect, dialect.port(&spring.wish(), USUAL_FRAME_HZ)));
    ui.horizontal(|ui| {
        let menu =
            ComboBox::from_id_salt(id).selected_text(name(chosen)).width(NAME + NUMBER - 56.0);
        let menu = menu.truncate().show_ui(ui, |ui| {
            for index in [None].into_iter().chain((0..DIALECTS.len()).map(Some)) {
                if ui.selectable_label(index == chosen, name(index)).clicked() {
                    ui.data_mut(|data| data.insert_temp(id, index));
                }
            }
        });
        let about = format!("the library whose numbers are taken: {}", name(chosen));
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

fn line(ui: &mut Ui, among: &str, number: Number, takes_focus: bool, commands: &mut Vec<Command>) {
    let Number { name, unit, value, with } = number;
    let id = Id::unique(("my spring", among, name));
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(NAME, LINE), Sense::hover());
        let font = FontId::proportional(TYPE);
        ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, name, font, palette(ui).text);
        let field = NumberField { id, value, unit, name, is_whole: false };
        let check = |entered| with(entered)?.check();
        let (response, entered) = field.show(ui, vec2(NUMBER, LINE), check);
        if takes_focus {
            response.request_focus();
            select(ui.ctx(), response.id, 0);
        }
        let spring = entered.and_then(|entered| with(entered).ok());
        commands.extend(spring.map(|spring| Command::View(ViewCommand::DescribeSpring(spring))));
    });
    NumberField::show_fault(id, ui);
}
