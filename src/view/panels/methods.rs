//! The methods that digits switch to: each with its digit, its name, and its verdict's sign.

use egui::{FontId, Rect, Response, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

use super::parts::short;
use super::verdict::VerdictText;
use super::{keycap, lanes};
use crate::studio::{Command, StageCommand, Studio};
use crate::view::theme::{TYPE, palette, strong_font};

pub(super) const HEIGHT: f32 = 40.0;

/// The methods that have a digit.
const DIGITS: usize = 10;
/// The height of a method, the room between two, also where it is scarce, and the room beside its parts, in points.
const BUTTON: f32 = 30.0;
const BETWEEN: f32 = 10.0;
const CLOSE: f32 = 4.0;
const PADDING: f32 = 7.0;
/// The room that the sign of its verdict takes, in points.
const SIGN: f32 = 12.0;

/// Shows the scene's methods, or else those with a digit: with their names where all have room, else the chosen one's alone,
/// or none where that would leave a method out. Returns the index of the method that the pointer or the keyboard's focus is
/// on.
pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) -> Option<usize> {
    let count = studio.deck.offered().min(DIGITS);
    let room = ui.available_width();
    let chosen = studio.active();
    let width_of = |entry: usize, is_named: bool| width(ui, studio, entry, is_named) + BETWEEN;
    let all: f32 = (0..count).map(|entry| width_of(entry, true)).sum();
    let are_named = all <= room;
    let with_one_name: f32 = (0..count).map(|entry| width_of(entry, entry == chosen)).sum();
    let is_chosen_named = with_one_name - BETWEEN <= room;
    let mut pointed = None;
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = if is_chosen_named { BETWEEN } else { CLOSE };
        for entry in 0..count {
            let is_named = are_named || is_chosen_named && entry == chosen;
            if width(ui, studio, entry, is_named) > ui.available_width() {
                break;
            }
            let response = method(ui, studio, entry, is_named, commands);
            response.context_menu(|ui| lanes::menu(ui, studio, entry, commands));
            if response.hovered() || response.has_focus() {
                pointed = Some(entry);
            }
        }
    });
    pointed
}

fn digit(entry: usize) -> String {
    ((entry + 1) % DIGITS).to_string()
}

fn width(ui: &Ui, studio: &Studio, entry: usize, is_named: bool) -> f32 {
    let name =
        ui.painter().layout_no_wrap(studio.lane_name(entry), strong_font(TYPE), palette(ui).text);
    let named = if is_named { name.size().x + PADDING } else { 0.0 };
    3.0 * PADDING + keycap::width(ui.painter(), &digit(entry)) + named + SIGN
}

/// Shows a method. A click on it does what its digit does.
fn method(
    ui: &mut Ui,
    studio: &Studio,
    entry: usize,
    is_named: bool,
    commands: &mut Vec<Command>,
) -> Response {
    let size = vec2(width(ui, studio, entry, is_named), BUTTON);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let (name, is_chosen) = (studio.lane_name(entry), entry == studio.active());
    let verdict = lanes::verdict_on(studio, entry);
    let spoken = format!("{} {name}, {}", digit(entry), verdict.whole());
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::RadioButton, true, is_chosen, &spoken)
    });
    let (colour, _) = palette(ui).style(studio.entries(), &studio.entries()[entry]);
    paint(ui, rect, (&digit(entry), colour), is_named.then_some(&*name), is_chosen, &verdict);
    if response.hovered() || response.has_focus() {
        let stroke = Stroke::new(1.0, palette(ui).accent);
        ui.painter().rect_stroke(rect, 7.0, stroke, StrokeKind::Inside);
    }
    let response = response.on_hover_ui(|ui| lanes::tooltip(ui, studio, entry));
    if response.clicked() {
        commands.push(Command::Stage(StageCommand::Pick(entry)));
    }
    response
}

fn paint(
    ui: &Ui,
    rect: Rect,
    (digit, colour): (&str, egui::Color32),
    name: Option<&str>,
    is_chosen: bool,
    verdict: &VerdictText,
) {
    let stroke =
        if is_chosen { Stroke::new(1.6, colour) } else { Stroke::new(1.0, palette(ui).line) };
    let fill = if is_chosen { palette(ui).raised } else { palette(ui).panel };
    ui.painter().rect(rect, 7.0, fill, stroke, StrokeKind::Inside);
    let (mut x, middle) = (rect.left() + PADDING, rect.center().y);
    x += keycap::paint(ui, x, middle, digit, colour) + PADDING;
    if let Some(name) = name {
        let (font, colour) = match is_chosen {
            true => (strong_font(TYPE), palette(ui).text),
            false => (FontId::proportional(TYPE), palette(ui).dim),
        };
        let (text, _) = short(ui, name, font, f32::INFINITY, colour);
        ui.painter().galley(pos2(x, middle - text.size().y / 2.0), text, colour);
    }
    verdict.paint_sign(ui, pos2(rect.right() - PADDING - SIGN / 2.0, middle));
}
