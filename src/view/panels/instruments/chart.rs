//! Shows the plots of an instrument with their axes, curves and crosshair, and handles the pointer on the plots.

use std::collections::BTreeMap;

use egui::{Align2, FontId, Pos2, Rect, Response, Sense, Ui, Vec2, pos2, vec2};

use super::super::parts::short;
use super::super::series_styles::SeriesStyles;
use super::hover;
use super::layout::{Cell, cells};
use super::plot_set::PlotSet;
use crate::chart::{self, ABOVE, NAME, NUMBER, PlotArea, Primitive, Text};
use crate::studio::{Command, DriverRequest, RunCommand, StageCommand, Studio, ViewCommand};
use crate::theme::{PanelPalette, palette, strong_font};
use crate::touch::wheel_or_pinch;

/// Minimum width for the numbers of a vertical axis, in points.
const LEFT: f32 = 40.0;
/// Maximum distance between a click and the curve that it selects, in points.
const NEAR: f32 = 9.0;

/// The user's zoom and pan: a range for each axis, under the name of the axis.
struct Views(BTreeMap<String, [f64; 2]>);

impl Views {
    fn area(&self, cell: &Cell<'_>) -> PlotArea {
        cell.area(&self.0)
    }

    fn reset_ranges(&mut self, cell: &Cell<'_>) {
        let names = cell.plot.axis_names();
        self.0.retain(|name, _| !names.contains(name));
    }

    /// Zooms to `part` of the plot's frame. The part is given in fractions of the frame's width and height from its
    /// lower left corner.
    fn show(&mut self, cell: &Cell<'_>, part: [[f64; 2]; 2]) {
        let bounds = self.area(cell).bounds;
        for (axis, name) in cell.plot.axis_names().into_iter().enumerate() {
            let [low, high] = bounds[axis];
            let range = part[axis].map(|part| low + part * (high - low));
            let far = range[0].abs().max(range[1].abs());
            // Zooming stops before the numbers have no digits left that differ, or become too large.
            if range[1] - range[0] > 1e-9 * far && far < 1e30 {
                self.0.insert(name, range);
            }
        }
    }

    /// Zooms about a point of the plot's frame by this factor.
    fn zoom(&mut self, cell: &Cell<'_>, at: Pos2, factor: f64) {
        let part = (at - cell.frame.min) / cell.frame.size();
        let around = [part.x, 1.0 - part.y].map(f64::from);
        let shrink = 1.0 / factor;
        self.show(cell, around.map(|at| [at - at * shrink, at + (1.0 - at) * shrink]));
    }

    fn pan(&mut self, cell: &Cell<'_>, by: Vec2) {
        let part = by / cell.frame.size();
        self.show(cell, [-part.x, part.y].map(|by| [f64::from(by), 1.0 + f64::from(by)]));
    }
}

/// The tick before the last click, which moved the run to another tick.
#[derive(Clone, Copy)]
struct TickBeforeClick(u64);

/// Shows a set of plots in the rest of `ui`.
pub(super) fn show(ui: &mut Ui, studio: &Studio, set: &PlotSet, commands: &mut Vec<Command>) {
    let room = ui.available_rect_before_wrap();
    ui.allocate_rect(room, Sense::hover());
    let body = studio.view().body;
    let mut views = Views(studio.view().plot_ranges.clone());
    // The heights of the plots do not depend on the width of the numbers beside them.
    let left = room_for_numbers(ui, &cells(set, room, LEFT, body), &views);
    let cells = cells(set, room, left, body);
    let mut pointer = None;
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
            views.reset_ranges(cell);
            // The first click of a double click was not meant to seek.
            let left =
                ui.data(|data| data.get_temp::<Option<TickBeforeClick>>(response.id)).flatten();
            commands.extend(left.map(|TickBeforeClick(tick)| Command::Run(RunCommand::Seek(tick))));
        } else if response.clicked() {
            let area = views.area(cell);
            let picked = pick_command(&set.styles, cell, &area, &response);
            let went = seek_command(studio, cell, &area, &response).filter(|_| picked.is_none());
            let left = went.is_some().then(|| TickBeforeClick(studio.race().tick()));
            ui.data_mut(|data| data.insert_temp(response.id, left));
            commands.extend(picked.or(went));
        } else if response.dragged() {
            views.pan(cell, response.drag_delta());
        }
        response.context_menu(|ui| menu(ui, cell, &mut views, commands));
    }
    for (place, cell) in cells.iter().enumerate() {
        let area = views.area(cell);
        show_plot(ui, studio, &set.styles, (cell, &area), commands);
        if cell.plot.nothing.is_none() {
            let at = pointer.filter(|(over, _)| *over == place || cell.plot.is_over_time());
            let t = at.and_then(|(over, at)| {
                hover::time_at(cells[over].plot, &views.area(&cells[over]), at)
            });
            hover::show(ui, studio, &set.styles, (cell, &area), t, place == 0);
        }
    }
    if views.0 != studio.view().plot_ranges {
        commands.push(Command::View(ViewCommand::PlotRanges(views.0)));
    }
}

/// Whether the user has zoomed or panned the plots.
pub(super) fn is_zoomed(studio: &Studio) -> bool {
    !studio.view().plot_ranges.is_empty()
}

/// Returns the width of the numbers of all vertical axes, in points.
fn room_for_numbers(ui: &Ui, cells: &[Cell<'_>], views: &Views) -> f32 {
    let marks = cells.iter().flat_map(|cell| cell.marks(&views.area(cell), 1));
    let widths = marks.map(|(_, text)| {
        let font = FontId::proportional(NUMBER);
        ui.painter().layout_no_wrap(text, font, palette(ui).dim).size().x
    });
    widths.fold(LEFT, |room, width| room.max(width + 10.0))
}

fn turn_wheel(ui: &Ui, views: &mut Views, cell: &Cell<'_>, at: Pos2) {
    let (times, right) = wheel_or_pinch(ui);
    if times != 1.0 {
        views.zoom(cell, at, times);
    }
    if right != 0.0 {
        views.pan(cell, vec2(right, 0.0));
    }
}

fn menu(ui: &mut Ui, cell: &Cell<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    if ui.button("Fit (double click)").clicked() {
        views.reset_ranges(cell);
        ui.close();
    }
    for (text, command) in [
        ("Enlarge (Enter)", Command::View(ViewCommand::ToggleEnlarged)),
        ("Copy the values (Ctrl C)", Command::Ask(DriverRequest::CopyInstrument)),
        ("Save as PNG, SVG and CSV (Ctrl E)", Command::Ask(DriverRequest::ExportInstrument)),
    ] {
        if ui.button(text).clicked() {
            commands.push(command);
            ui.close();
        }
    }
}

/// Returns the command that seeks to the time under a click.
fn seek_command(
    studio: &Studio,
    cell: &Cell<'_>,
    area: &PlotArea,
    response: &Response,
) -> Option<Command> {
    let is_of_run = studio.loop_lab().is_none() && cell.plot.is_over_time();
    let at = response.interact_pointer_pos().filter(|_| is_of_run)?;
    let t = area.point(at)[0].max(0.0);
    Some(Command::Run(RunCommand::Seek(studio.run().times().nearest_tick(t))))
}

/// Returns the command that selects the lane of the curve under a click.
fn pick_command(
    styles: &SeriesStyles,
    cell: &Cell<'_>,
    area: &PlotArea,
    response: &Response,
) -> Option<Command> {
    let at = response.interact_pointer_pos()?;
    if !styles.is_race {
        return None;
    }
    let distance = |track: &super::super::tracks::Track| {
        let points: Vec<Pos2> = track.places().map(|(_, _, point)| area.at(point)).collect();
        let pieces = points.windows(2).map(|ends| distance_to(at, [ends[0], ends[1]]));
        pieces.fold(f32::INFINITY, f32::min)
    };
    let near = cell.plot.tracks.iter().map(|track| (distance(track), track.entry));
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(away, _)| *away <= NEAR)?;
    Some(Command::Stage(StageCommand::Pick(nearest.1)))
}

/// Returns the distance of a point from a line segment.
fn distance_to(at: Pos2, [from, to]: [Pos2; 2]) -> f32 {
    let along = to - from;
    let part = ((at - from).dot(along) / along.length_sq().max(1e-9)).clamp(0.0, 1.0);
    at.distance(from + part * along)
}

/// Shows a plot with its axes and its title.
fn show_plot(
    ui: &mut Ui,
    studio: &Studio,
    styles: &SeriesStyles,
    (cell, area): (&Cell<'_>, &PlotArea),
    commands: &mut Vec<Command>,
) {
    let (plot, palette) = (cell.plot, palette(ui));
    let painter = ui.painter().clone();
    let columns = area.rect.width() * painter.pixels_per_point();
    let right = ui.max_rect().right();
    let name = FontId::proportional(NAME);
    let name = painter.layout_no_wrap(plot.axes[1].name(), name, palette.dim).size().x;
    let edge = pos2(cell.left, area.rect.top() - ABOVE / 2.0);
    let title = pos2(area.rect.left().max(edge.x + name + 12.0), edge.y);
    let is_chosen = studio.view().body == plot.body;
    let font = if is_chosen { strong_font(NAME) } else { FontId::proportional(NAME) };
    // The title may extend to the values beside the plot.
    let (words, is_whole) = short(ui, &plot.title, font, area.rect.right() - title.x, palette.text);
    let at = Align2::LEFT_CENTER.anchor_size(title, words.size()).min;
    let response = ui.interact(
        Rect::from_min_size(at, words.size()),
        ui.scope_id().with((&plot.id, "title")),
        Sense::click(),
    );
    painter.galley(at, words, palette.text);
    chart::paint(&painter, &layout(studio, styles, (cell, area), palette, (columns, right)));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &plot.title));
    let about = "show this body large, and in the other instruments";
    let about = if is_whole { about.into() } else { format!("{}\n{about}", plot.title) };
    if response.on_hover_text(about).clicked() {
        commands.push(Command::Stage(StageCommand::Body(plot.body)));
    }
}

/// Lays out a plot on this number of pixel columns, with its axes but without its title. No number of the horizontal
/// axis extends beyond `right`.
pub(super) fn layout(
    studio: &Studio,
    styles: &SeriesStyles,
    (cell, area): (&Cell<'_>, &PlotArea),
    palette: &PanelPalette,
    (columns, right): (f32, f32),
) -> Vec<Primitive> {
    let (plot, frame) = (cell.plot, area.rect);
    let [along, up] =
        chart::names(area, cell.left, plot.axes.each_ref().map(|axis| axis.name()), palette);
    let mut all = vec![Primitive::Area(frame, palette.plot), up.into()];
    if let Some(why) = &plot.nothing {
        let why = Text::new(frame.center(), Align2::CENTER_CENTER, why.as_str(), NAME, palette.dim);
        all.push(Text { wrap: 0.9 * frame.width(), ..why }.into());
        return all;
    }
    let [mut across, upwards] = [0, 1].map(|axis| cell.marks(area, axis));
    if cell.is_lowest {
        all.push(along.into());
    } else {
        across.iter_mut().for_each(|(_, text)| text.clear());
    }
    let drawing = plot.drawing(studio, styles, &area.bounds, columns);
    all.extend(chart::plot(area, [across, upwards], &drawing, palette, right));
    all
}
