//! The panels of the loop lab, and the instrument *Loop*. The instrument charts the moment that each loop shows, or the
//! timing of this window's own loop, and is available as a picture and as text.

use std::iter;

use egui::{Rect, RichText, Sense, Ui, Vec2, vec2};

use super::breakpoints;
use crate::chart::figure::{self, Chart, FigureCurve};
use crate::chart::legend::{self, Entry};
use crate::chart::{self, Primitive};
use crate::loops::loop_lab::{LoopCommand, LoopLab};
use crate::panels::table::TableRow;
use crate::run::csv_row;
use crate::studio::{Command, Studio, mark_of};
use crate::theme::{PanelPalette, palette, strong_font};

pub(super) mod controls;
mod counts;
mod errors;
pub(super) mod hints;
mod live;
mod moments;
mod row;
pub(super) mod slider;
pub(super) mod table;

use row::Row;

/// Title of the charts of the loop lab.
const TITLE: &str = "Moment shown against moment of display";
const GAME_TIME: &str = "Game time over real time";
/// Remark on a trace that shows no response to a hitch.
const NO_HITCH: &str = "No frame is long here: hitch-100ms and alt-tab-5s have one.";
/// Share of the height for the two small plots together.
const TWO: f32 = 0.4;
/// Gap between the two small plots, and gap above them, in points.
const GAP: f32 = 10.0;
const ABOVE_TWO: f32 = 3.0;

/// Shows the charts of the loop lab, or of the window's own loop.
pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2, commands: &mut Vec<Command>) {
    match studio.loop_lab() {
        Some(loops) => show_lab(ui, loops, room, commands),
        None => live::show(ui, studio, room),
    }
}

fn show_lab(ui: &mut Ui, loops: &LoopLab, room: Vec2, commands: &mut Vec<Command>) {
    let top = ui.cursor().top();
    let lanes = on_stage(loops);
    let has_menus =
        room.x >= breakpoints::TITLE_OF_LOOP_LAB || room.y >= breakpoints::TWO_PLOTS_BELOW;
    let header = |ui: &mut Ui| {
        if has_menus {
            for (name, is_it) in [("Moments shown", false), ("Game time", true)] {
                if ui.selectable_label(loops.shows_game_time == is_it, name).clicked() {
                    commands.push(Command::Loop(LoopCommand::ShowGameTime(is_it)));
                }
            }
        } else {
            let title = if loops.shows_game_time { "Game time" } else { "Moments shown" };
            ui.label(RichText::new(title).font(strong_font(15.0)).color(palette(ui).text));
        }
        if !controls::has_trace_menu_above(ui) {
            controls::trace_menu(ui, loops, commands);
        }
        if has_menus {
            controls::engine_menu(ui, loops, commands);
        }
    };
    if has_menus {
        ui.horizontal_wrapped(header)
    } else {
        ui.horizontal(header)
    };
    legend::show(ui, &legend_entries(&lanes, palette(ui)));
    if let Some(waiting) = loops.waiting() {
        ui.label(RichText::new(waiting).color(palette(ui).dim));
        return;
    }
    let has_hitch = lanes.iter().any(|row| row.lane().game_time().has_long());
    if loops.shows_game_time && !has_hitch {
        ui.label(RichText::new(NO_HITCH).color(palette(ui).dim));
    }
    let height = (top + room.y - ui.cursor().top()).max(60.0);
    let (room, response) = ui.allocate_exact_size(vec2(room.x, height), Sense::hover());
    if loops.shows_game_time {
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, GAME_TIME));
        return chart::paint(ui.painter(), &game_time(&lanes, room, palette(ui)));
    }
    let (upper, below) = parts(room);
    moments::show(ui, upper, loops, &lanes);
    if let Some([left, right]) = below {
        counts::show(ui, left, &series(&lanes, palette(ui)));
        errors::show(ui, right, &lanes);
    }
}

/// Lays out the charts for a file, in a room that includes their title and legend. Returns `None` before the first
/// frame.
pub(super) fn layout(
    studio: &Studio,
    room: Rect,
    palette: &PanelPalette,
) -> Option<(&'static str, Vec<Entry>, Vec<Primitive>)> {
    let Some(loops) = studio.loop_lab() else {
        return Some((live::TITLE, Vec::new(), live::layout(studio, room, palette)?));
    };
    let lanes = on_stage(loops);
    if loops.shows_game_time {
        let entries = legend_entries(&lanes, palette);
        return Some((GAME_TIME, entries, game_time(&lanes, room, palette)));
    }
    let (upper, below) = parts(room);
    let moments = moments::area(upper, loops, &lanes);
    let mut all =
        moments.map_or_else(Vec::new, |area| moments::layout(upper, &area, loops, &lanes, palette));
    if let Some([left, right]) = below {
        all.extend(counts::layout(left, &series(&lanes, palette), palette));
        all.extend(errors::layout(right, &lanes, palette));
    }
    Some((TITLE, legend_entries(&lanes, palette), all))
}

/// Lays out the chart of the loops' game time in a room.
fn game_time(lanes: &[Row<'_>], room: Rect, palette: &PanelPalette) -> Vec<Primitive> {
    let curve = |row: Row<'_>| {
        let (colour, dash) = palette.theme.loop_style(row.index);
        let points = row.lane().game_time().points().into();
        FigureCurve { name: String::new(), colour, dash, dots: 0.0, points }
    };
    // The selected lane lies in front.
    let mut sorted = lanes.to_vec();
    sorted.sort_by_key(TableRow::is_selected);
    let curves = sorted.into_iter().map(curve).collect();
    figure::layout(&Chart::of_game_time(String::new(), palette.theme, curves), room, palette)
}

/// Returns the rectangle of the moments, and those of two small plots below if `room` is high enough.
fn parts(room: Rect) -> (Rect, Option<[Rect; 2]>) {
    if room.height() < breakpoints::TWO_PLOTS_BELOW {
        return (room.with_max_y(room.bottom() - ABOVE_TWO), None);
    }
    let (upper, below) = room.split_top_bottom_at_fraction(1.0 - TWO);
    let (left, right) = below.split_left_right_at_fraction(0.46);
    let halves =
        [left.with_max_x(left.right() - GAP / 2.0), right.with_min_x(right.left() + GAP / 2.0)];
    (upper.with_max_y(upper.bottom() - ABOVE_TWO), Some(halves))
}

fn series(lanes: &[Row<'_>], palette: &PanelPalette) -> Vec<counts::Series> {
    lanes.iter().map(|row| counts::Series::of_row(row, palette)).collect()
}

/// Returns the loops on the stage, from top to bottom.
fn on_stage(loops: &LoopLab) -> Vec<Row<'_>> {
    loops.on_stage().iter().map(|&index| Row { loops, index }).collect()
}

/// Returns the legend of the charts.
fn legend_entries(lanes: &[Row<'_>], palette: &PanelPalette) -> Vec<Entry> {
    let entry = |row: &Row<'_>| {
        let name = format!("{} {}", mark_of(row.index), row.name());
        let off = moments::off_the_plot(row.loops, row.lane());
        let name = name + &off.map(|words| format!(" ({words})")).unwrap_or_default();
        let (colour, dash) = row.style(palette);
        Entry { name, colour, dash, is_front: row.is_selected() }
    };
    let (name, colour, dash) = ("ideal".into(), palette.exact, [1.0, 0.0]);
    let ideal = Entry { name, colour, dash, is_front: false };
    lanes.iter().map(entry).chain([ideal]).collect()
}

/// Returns all frames of the loops on the stage, or the last frames of the window's own loop, as comma-separated text.
pub(super) fn csv(studio: &Studio) -> Vec<String> {
    match studio.loop_lab() {
        Some(loops) => of_lab(loops),
        None => of_window(studio),
    }
}

fn of_lab(loops: &LoopLab) -> Vec<String> {
    let frames = on_stage(loops).into_iter().map(|row| row.lane()).flat_map(|lane| {
        lane.frames().iter().enumerate().map(move |(number, frame)| {
            let displayed_ms = frame.displayed_ns as f64 / 1e6;
            csv_row(&[
                &lane.card().id,
                &number,
                &displayed_ms,
                &frame.shown_ms,
                &frame.ticks,
                &frame.animation_error_ms,
            ])
        })
    });
    let head = "loop,frame,displayed_ms,shown_ms,ticks,animation_error_ms\n".to_owned();
    iter::once(head).chain(frames).collect()
}

fn of_window(studio: &Studio) -> Vec<String> {
    let frames = studio.viewer.live.frames().enumerate().map(|(number, frame)| {
        let time_ms = frame.duration_ns as f64 / 1e6;
        csv_row(&[&number, &time_ms, &frame.ticks, &frame.dropped, &frame.animation_error_ms])
    });
    let head = "frame,frame_time_ms,ticks,dropped,animation_error_ms\n".to_owned();
    iter::once(head).chain(frames).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{open_loop_lab_on, run_loops};
    use crate::tests::testing::TestWindow;

    #[test]
    fn game_time_and_the_menu_of_engines_are_whole_on_every_window() {
        for size in [[1280.0, 720.0], [800.0, 600.0]] {
            let mut studio = Studio::new(Scene::built_in("spring").unwrap());
            open_loop_lab_on(&mut studio, "alt-tab-5s");
            run_loops(&mut studio);
            let mut window = TestWindow::new(size);
            let words = |window: &mut TestWindow, studio: &Studio| {
                (0..3).for_each(|_| drop(window.panels(studio, Vec::new())));
                window.panels(studio, Vec::new()).1.whole()
            };
            let shown = words(&mut window, &studio);
            let tab = shown.iter().find(|(_, words)| words == "Game time").expect("a tab").0;
            let asked = window.click(&studio, tab.center());
            assert_eq!(asked, [Command::Loop(LoopCommand::ShowGameTime(true))]);
            studio.apply(LoopCommand::ShowGameTime(true));
            let shown: Vec<String> =
                words(&mut window, &studio).into_iter().map(|(_, words)| words).collect();
            for part in ["real time (ms)", "game time (ms)", "your engine"] {
                assert!(shown.iter().any(|words| words == part), "{part} at {size:?}: {shown:?}");
            }
        }
    }
}
