//! The panels of the loop lab, and the instrument *Loop*: what each loop shows when, or what this window's own loop does.

use egui::{Color32, RichText, Sense, Ui, Vec2, vec2};

use super::{ink, strong_font};
use crate::lab::loop_lab::LoopLane;
use crate::lab::{Command, Lab, LoopLab};
use crate::view::chart::legend::{self, Entry};
use crate::view::theme::{Ink, colour};

mod columns;
pub(super) mod controls;
mod counts;
mod errors;
mod export;
pub(super) mod hints;
mod live;
mod moments;
mod row;
pub(super) mod slider;
pub(super) mod table;

pub(super) use export::csv;

/// From this width on, in points, the title is whole.
const ROOM_FOR_TITLE: f32 = 340.0;
/// From this height on, in points, there are two small plots below, and the part of the height that they take.
const ROOM_FOR_TWO: f32 = 230.0;
const TWO: f32 = 0.4;
/// Between the two, in points.
const GAP: f32 = 10.0;

/// Shows what each loop of the loop lab shows, or what the window's own loop does.
pub(super) fn show(ui: &mut Ui, lab: &Lab, room: Vec2, commands: &mut Vec<Command>) {
    match lab.loop_lab() {
        Some(loops) => show_lab(ui, loops, room, commands),
        None => live::show(ui, lab, room),
    }
}

fn show_lab(ui: &mut Ui, loops: &LoopLab, room: Vec2, commands: &mut Vec<Command>) {
    let top = ui.cursor().top();
    let lanes = on_stage(loops, ink(ui));
    ui.horizontal(|ui| {
        let title = match room.x >= ROOM_FOR_TITLE {
            true => "Moment shown against moment of display",
            false => "Moments shown",
        };
        ui.label(RichText::new(title).font(strong_font(15.0)).color(ink(ui).text));
        if !controls::has_trace_menu_above(ui) {
            controls::trace_menu(ui, loops, commands);
        }
    });
    show_legend(ui, loops, &lanes);
    if let Some(waiting) = loops.waiting() {
        ui.label(RichText::new(waiting).color(ink(ui).dim));
        return;
    }
    let height = (top + room.y - ui.cursor().top()).max(60.0);
    let has_two = height >= ROOM_FOR_TWO;
    let upper = if has_two { height * (1.0 - TWO) } else { height };
    moments::show(ui, loops, &lanes, vec2(room.x, upper - ui.spacing().item_spacing.y));
    if has_two {
        let (below, _) = ui.allocate_exact_size(vec2(room.x, height - upper), Sense::hover());
        let [left, right] = halves(below);
        let series: Vec<_> = lanes.iter().map(counts::Series::of_lane).collect();
        counts::show(ui, left, &series);
        errors::show(ui, right, loops, &lanes);
    }
}

/// The left and the right part of a rectangle for two plots.
fn halves(room: egui::Rect) -> [egui::Rect; 2] {
    let (left, right) = room.split_left_right_at_fraction(0.46);
    [left.with_max_x(left.right() - GAP / 2.0), right.with_min_x(right.left() + GAP / 2.0)]
}

/// A lane on the stage, and how it is drawn.
struct ShownLane<'a> {
    place: usize,
    lane: &'a LoopLane,
    colour: Color32,
    dash: [f32; 2],
    is_selected: bool,
}

/// The lanes on the stage, from top to bottom.
fn on_stage<'a>(loops: &'a LoopLab, ink: &Ink) -> Vec<ShownLane<'a>> {
    let lane = |&place: &usize| {
        let (rgba, dash) = ink.theme.loop_style(place);
        let (lane, is_selected) = (&loops.lanes()[place], place == loops.selected());
        ShownLane { place, lane, colour: colour(rgba), dash, is_selected }
    };
    loops.on_stage().iter().map(lane).collect()
}

/// The lines of the plots.
fn show_legend(ui: &mut Ui, loops: &LoopLab, lanes: &[ShownLane<'_>]) {
    let entry = |lane: &ShownLane<'_>| {
        let name = format!("{} {}", lane.place + 1, lane.lane.card().name);
        let off = moments::off_the_plot(loops, lane.lane);
        let name = name + &off.map(|words| format!(" ({words})")).unwrap_or_default();
        Entry { name, colour: lane.colour, dash: lane.dash, is_front: lane.is_selected }
    };
    let (name, colour, dash) = ("ideal".into(), ink(ui).exact, [1.0, 0.0]);
    let ideal = Entry { name, colour, dash, is_front: false };
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = legend::ROW;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = legend::BETWEEN;
            for entry in lanes.iter().map(entry).chain([ideal]) {
                entry.show(ui, 0.0);
            }
        });
    });
}
