//! Shows the plots of an instrument: axes, curves and crosshair, and what a pointer does on them.

use std::collections::BTreeMap;

use egui::{Align2, FontId, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, pos2, vec2};
use egui_plot::PlotBounds;

use super::super::roster::Roster;
use super::super::{focus_ring, ink, ring, short};
use super::hover;
use super::layout::{Cell, MARKS_APART, NUMBER, NUMBERS, TITLE, WORDS, cells};
use super::sheet::Sheet;
use crate::lab::{Command, Lab};
use crate::view::plot::{on_screen, paint};
use crate::view::theme::strong_font;

/// The least room for the numbers of an upright axis, in points.
const LEFT: f32 = 40.0;
/// How far a wheel turns for the plot to grow by the factor e, in points; a notch is some 40.
const WHEEL: f32 = 200.0;
/// How far from a curve a click still picks it, in points.
const NEAR: f32 = 9.0;

/// What a person zooms and pans to: a range of each axis, by its name.
struct Views(BTreeMap<String, [f64; 2]>);

impl Views {
    fn bounds(&self, cell: &Cell<'_>) -> PlotBounds {
        cell.plot.in_view(&self.0)
    }

    fn fit(&mut self, cell: &Cell<'_>) {
        let names = cell.plot.axis_names();
        self.0.retain(|name, _| !names.contains(name));
    }

    /// Shows what lies in `part` of the frame, in parts of its width and its height from the lower left corner.
    fn show(&mut self, cell: &Cell<'_>, part: [[f64; 2]; 2]) {
        let bounds = self.bounds(cell);
        let (low, high) = (bounds.min(), bounds.max());
        for (axis, name) in cell.plot.axis_names().into_iter().enumerate() {
            let wide = high[axis] - low[axis];
            let range = part[axis].map(|part| low[axis] + part * wide);
            let far = range[0].abs().max(range[1].abs());
            // Not so near that the numbers have no digits left to differ in, nor beyond all numbers.
            if range[1] - range[0] > 1e-9 * far && far < 1e30 {
                self.0.insert(name, range);
            }
        }
    }

    /// Zooms about a point of the frame by this factor.
    fn zoom(&mut self, cell: &Cell<'_>, at: Pos2, factor: f32) {
        let part = (at - cell.frame.min) / cell.frame.size();
        let around = [part.x, 1.0 - part.y].map(f64::from);
        let shrink = 1.0 / f64::from(factor);
        self.show(cell, around.map(|at| [at - at * shrink, at + (1.0 - at) * shrink]));
    }

    fn pan(&mut self, cell: &Cell<'_>, by: Vec2) {
        let part = by / cell.frame.size();
        self.show(cell, [-part.x, part.y].map(|by| [f64::from(by), 1.0 + f64::from(by)]));
    }
}

/// Shows a sheet in all that is left of `ui`.
pub(super) fn show(ui: &mut Ui, lab: &Lab, sheet: &Sheet, commands: &mut Vec<Command>) {
    let room = ui.available_rect_before_wrap();
    ui.allocate_rect(room, Sense::hover());
    let body = lab.view().body;
    let mut views = Views(lab.view().plot_ranges.clone());
    // The heights of plots do not depend on the room beside them.
    let left = room_for_numbers(ui, &cells(sheet, room, LEFT, body), &views);
    let cells = cells(sheet, room, left, body);
    let (mut pointer, mut focused) = (None, None);
    for (place, cell) in cells.iter().enumerate().filter(|(_, cell)| cell.plot.nothing.is_none()) {
        let response =
            ui.interact(cell.frame, ui.scope_id().with(&cell.plot.id), Sense::click_and_drag());
        let name = format!("{} over {}", cell.plot.axes[1].name(), cell.plot.axes[0].name());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, &name));
        if let Some(at) = response.hover_pos().filter(|at| cell.frame.contains(*at)) {
            pointer = Some((place, at));
            turn_wheel(ui, &mut views, cell, at);
        }
        if response.double_clicked() {
            views.fit(cell);
        } else if response.clicked() {
            commands.extend(picked(&sheet.roster, cell, &views.bounds(cell), &response));
        } else if response.dragged() {
            views.pan(cell, response.drag_delta());
        }
        focused = focused.or(response.has_focus().then_some(response.rect));
        response.context_menu(|ui| menu(ui, cell, &mut views, commands));
    }
    for (place, cell) in cells.iter().enumerate() {
        show_plot(ui, lab, &sheet.roster, cell, &views.bounds(cell), commands);
        if cell.plot.nothing.is_none() {
            let at = pointer.filter(|(over, _)| *over == place || cell.plot.is_over_time());
            let bounds = |cell: &Cell<'_>| views.bounds(cell);
            let t =
                at.and_then(|(over, at)| hover::time_at(&cells[over], &bounds(&cells[over]), at));
            hover::show(ui, &sheet.roster, cell, &bounds(cell), t, place == 0);
        }
    }
    focused.into_iter().for_each(|rect| ring(ui, rect));
    if views.0 != lab.view().plot_ranges {
        commands.push(Command::PlotRanges(views.0));
    }
}

/// Whether a person has zoomed or panned.
pub(super) fn is_zoomed(lab: &Lab) -> bool {
    !lab.view().plot_ranges.is_empty()
}

/// The room that the numbers of all plots take, in points.
fn room_for_numbers(ui: &Ui, cells: &[Cell<'_>], views: &Views) -> f32 {
    let marks = cells.iter().flat_map(|cell| {
        let bounds = views.bounds(cell);
        marks_up(cell, &bounds)
    });
    let widths = marks.map(|(_, text)| {
        let font = FontId::proportional(NUMBER);
        ui.painter().layout_no_wrap(text, font, ink(ui).dim).size().x
    });
    widths.fold(LEFT, |room, width| room.max(width + 10.0))
}

/// The marks of the upright axis.
fn marks_up(cell: &Cell<'_>, bounds: &PlotBounds) -> Vec<(f64, String)> {
    let ([_, low], [_, high]) = (bounds.min(), bounds.max());
    let room = f64::from(cell.frame.height());
    cell.plot.axes[1].scale.marks((low, high), room, MARKS_APART[1])
}

fn turn_wheel(ui: &Ui, views: &mut Views, cell: &Cell<'_>, at: Pos2) {
    let (turned, pinched) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    let factor = (turned.y / WHEEL).exp() * pinched;
    if factor != 1.0 {
        views.zoom(cell, at, factor);
    }
    if turned.x != 0.0 {
        views.pan(cell, vec2(turned.x, 0.0));
    }
}

fn menu(ui: &mut Ui, cell: &Cell<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    if ui.button("Fit (double click)").clicked() {
        views.fit(cell);
        ui.close();
    }
    for (text, command) in [
        ("Enlarge (Enter)", Command::ToggleEnlarged),
        ("Copy the values (Ctrl C)", Command::CopyInstrument),
        ("Save as PNG, SVG and CSV (Ctrl E)", Command::ExportInstrument),
    ] {
        if ui.button(text).clicked() {
            commands.push(command);
            ui.close();
        }
    }
}

/// The command that selects the lane of the curve under a click.
fn picked(
    roster: &Roster,
    cell: &Cell<'_>,
    bounds: &PlotBounds,
    response: &Response,
) -> Option<Command> {
    let at = response.interact_pointer_pos()?;
    if !roster.is_race {
        return None;
    }
    let distance = |track: &super::super::tracks::Track| {
        let points: Vec<Pos2> =
            track.places().map(|(_, _, point)| on_screen(cell.frame, bounds, point)).collect();
        let pieces = points.windows(2).map(|ends| distance_to(at, [ends[0], ends[1]]));
        pieces.fold(f32::INFINITY, f32::min)
    };
    let near = cell.plot.tracks.iter().map(|track| (distance(track), track.entry));
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(away, _)| *away <= NEAR)?;
    Some(Command::Pick(nearest.1))
}

/// The distance of a point from a straight piece.
fn distance_to(at: Pos2, [from, to]: [Pos2; 2]) -> f32 {
    let along = to - from;
    let part = ((at - from).dot(along) / along.length_sq().max(1e-9)).clamp(0.0, 1.0);
    at.distance(from + part * along)
}

/// Draws a plot with its axes and its title.
fn show_plot(
    ui: &mut Ui,
    lab: &Lab,
    roster: &Roster,
    cell: &Cell<'_>,
    bounds: &PlotBounds,
    commands: &mut Vec<Command>,
) {
    let (frame, plot, ink) = (cell.frame, cell.plot, ink(ui));
    let painter = ui.painter().clone();
    painter.rect_filled(frame, 0.0, ink.plot);
    let edge = pos2(cell.left, frame.top() - TITLE / 2.0);
    let name = FontId::proportional(WORDS);
    let name = painter.text(edge, Align2::LEFT_CENTER, plot.axes[1].name(), name, ink.dim);
    let title = pos2(frame.left().max(name.right() + 12.0), edge.y);
    let is_chosen = lab.view().body == plot.body;
    let font = if is_chosen { strong_font(WORDS) } else { FontId::proportional(WORDS) };
    // Up to the values beside the plot.
    let (words, is_whole) = short(ui, &plot.title, font, frame.right() - title.x, ink.text);
    let at = Align2::LEFT_CENTER.anchor_size(title, words.size()).min;
    let response = ui.interact(
        Rect::from_min_size(at, words.size()),
        ui.scope_id().with((&plot.id, "title")),
        Sense::click(),
    );
    painter.galley(at, words, ink.text);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &plot.title));
    focus_ring(ui, &response);
    let about = "show this body large, and in the other instruments";
    let about = if is_whole { about.into() } else { format!("{}\n{about}", plot.title) };
    if response.on_hover_text(about).clicked() {
        commands.push(Command::Body(plot.body));
    }
    if let Some(why) = &plot.nothing {
        let words =
            painter.layout(why.clone(), FontId::proportional(WORDS), ink.dim, 0.9 * frame.width());
        let at = Align2::CENTER_CENTER.anchor_size(frame.center(), words.size()).min;
        painter.galley(at, words, ink.dim);
        return;
    }
    axes(ui, cell, bounds);
    let columns = frame.width() * painter.pixels_per_point();
    paint(&painter, frame, bounds, &plot.drawing(lab, roster, bounds, columns));
    let rim = Stroke::new(1.0, ink.line);
    painter.rect_stroke(frame, 0.0, rim, egui::StrokeKind::Outside);
}

/// Draws the grid with its numbers, and the names of the axes.
fn axes(ui: &Ui, cell: &Cell<'_>, bounds: &PlotBounds) {
    let (frame, plot, ink) = (cell.frame, cell.plot, ink(ui));
    let painter = ui.painter();
    let number = FontId::proportional(NUMBER);
    let grid = Stroke::new(1.0, ink.grid);
    let along = &plot.axes[0];
    let (low, high) = (bounds.min(), bounds.max());
    let room = f64::from(frame.width());
    for (place, text) in along.scale.marks((low[0], high[0]), room, MARKS_APART[0]) {
        let x = on_screen(frame, bounds, [place, low[1]]).x;
        painter.vline(x, frame.y_range(), grid);
        if cell.is_lowest {
            let text = painter.layout_no_wrap(text, number.clone(), ink.dim);
            // The number of a mark at the edge ends with the panel.
            let left = (x - text.size().x / 2.0).min(ui.max_rect().right() - text.size().x);
            painter.galley(pos2(left, frame.bottom() + 3.0), text, ink.dim);
        }
    }
    let mut last = f32::NEG_INFINITY;
    for (place, text) in marks_up(cell, bounds) {
        let y = on_screen(frame, bounds, [low[0], place]).y;
        painter.hline(frame.x_range(), y, grid);
        // Not in the title above.
        let at = pos2(frame.left() - 6.0, y.max(frame.top() + 5.0));
        // A low plot has no room for all of them.
        if (at.y - last).abs() >= NUMBER {
            painter.text(at, Align2::RIGHT_CENTER, text, number.clone(), ink.dim);
            last = at.y;
        }
    }
    let name = FontId::proportional(WORDS);
    if cell.is_lowest {
        let at = pos2(frame.center().x, frame.bottom() + NUMBERS);
        painter.text(at, Align2::CENTER_TOP, along.name(), name, ink.dim);
    }
}
