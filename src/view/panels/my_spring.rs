//! A custom spring: its numbers, each of which can be typed, and a button that asks for advice on it.

use egui::{Align2, Button, FontId, Id, Rect, RichText, Sense, Ui, vec2};

use super::dialog::{select, window};
use super::inspector::NumberField;
use crate::lab::source_code::Language;
use crate::lab::studio::{Command, MySpring, StageCommand, Studio, ViewCommand};
use crate::view::theme::{TYPE, palette};

const TITLE: &str = "My spring";
/// The widths of a name and of a number, and the height of a line, in points.
const NAME: f32 = 118.0;
const NUMBER: f32 = 150.0;
const LINE: f32 = 22.0;

/// A number of the spring: its name, its unit, its value, and the spring with another value.
type Number = (&'static str, &'static str, fn(MySpring) -> f64, fn(MySpring, f64) -> MySpring);

/// The three that make a spring.
const MADE_OF: [Number; 3] = [
    ("mass", "kg", |spring| spring.mass_kg, |spring, mass_kg| MySpring { mass_kg, ..spring }),
    (
        "stiffness",
        "N/m",
        |spring| spring.stiffness_n_per_m,
        |spring, stiffness_n_per_m| MySpring { stiffness_n_per_m, ..spring },
    ),
    (
        "damping",
        "N s/m",
        |spring| spring.damping_n_s_per_m,
        |spring, damping_n_s_per_m| MySpring { damping_n_s_per_m, ..spring },
    ),
];

/// The two that describe it as well, whatever its mass.
const SEEN_AS: [Number; 2] = [
    ("frequency", "Hz", MySpring::frequency_hz, |spring, frequency_hz| {
        spring.swinging(frequency_hz, spring.damping_ratio())
    }),
    ("damping ratio", "", MySpring::damping_ratio, |spring, ratio| {
        spring.swinging(spring.frequency_hz(), ratio)
    }),
];

/// How it starts, and what pulls at it.
const LET_GO: [Number; 3] = [
    ("stretch at start", "m", |spring| spring.x0_m, |spring, x0_m| MySpring { x0_m, ..spring }),
    (
        "velocity at start",
        "m/s",
        |spring| spring.v0_m_per_s,
        |spring, v0_m_per_s| MySpring { v0_m_per_s, ..spring },
    ),
    (
        "gravity",
        "m/s²",
        |spring| spring.gravity_m_per_s2,
        |spring, gravity_m_per_s2| MySpring { gravity_m_per_s2, ..spring },
    ),
];

pub(super) fn show(ui: &Ui, studio: &Studio, over: Rect, commands: &mut Vec<Command>) {
    let ctx = ui.ctx();
    window(TITLE, over).show(ctx, |ui| {
        ui.set_width(NAME + NUMBER + 8.0);
        ui.spacing_mut().item_spacing.y = 4.0;
        let (tick_hz, has_focus) = (studio.clock().tick_hz(), ui.memory(|m| m.focused().is_some()));
        let is_new = is_new(ui);
        for (i, number) in MADE_OF.iter().enumerate() {
            line(ui, studio, number, is_new && i == 0, commands);
        }
        ui.label(RichText::new("or by its swing").color(palette(ui).dim));
        for number in &SEEN_AS {
            line(ui, studio, number, false, commands);
        }
        ui.label(RichText::new("let go where, and how").color(palette(ui).dim));
        for number in &LET_GO {
            line(ui, studio, number, false, commands);
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

fn line(
    ui: &mut Ui,
    studio: &Studio,
    (name, unit, value, with): &Number,
    takes_focus: bool,
    commands: &mut Vec<Command>,
) {
    let spring = studio.viewer().my_spring();
    let id = Id::unique(("my spring", *name));
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(NAME, LINE), Sense::hover());
        let font = FontId::proportional(TYPE);
        ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, name, font, palette(ui).text);
        let field = NumberField { id, value: value(spring), unit, name, is_whole: false };
        let check = |entered| with(spring, entered).check();
        let (response, entered) = field.show(ui, vec2(NUMBER, LINE), check);
        if takes_focus {
            response.request_focus();
            select(ui.ctx(), response.id, 0);
        }
        commands.extend(
            entered
                .map(|entered| Command::View(ViewCommand::DescribeSpring(with(spring, entered)))),
        );
    });
    NumberField::show_fault(id, ui);
}
