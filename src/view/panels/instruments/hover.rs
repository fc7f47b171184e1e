//! The crosshair of a plot, and the values of all curves beside the plot: those at the pointer, or else the present
//! ones.

use egui::{Align2, FontId, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};

use super::super::series_styles::SeriesStyles;
use super::layout::Cell;
use super::plot_set::{PlotModel, Readout};
use crate::chart::{NAME, PlotArea};
use crate::studio::Studio;
use crate::theme::{palette, strong_font};

/// The width of the crosshair and the radius of the dots on the curves, in points.
const CROSSHAIR: f32 = 1.4;
const DOT: f32 = 3.6;
/// Minimum gap between the number of a lane and the lane's value, in points.
const BETWEEN: f32 = 5.0;
/// Height of a line of the values beside the plot, in points.
const LINE: f32 = 15.5;

/// Returns the moment (s) under a pointer. If the horizontal axis is not time, the moment is that of the nearest point
/// of a curve.
pub(super) fn time_at(plot: &PlotModel, area: &PlotArea, at: Pos2) -> Option<f64> {
    if plot.is_over_time() {
        return Some(area.point(at)[0]);
    }
    let exact = plot.exact.iter();
    let exact = exact.flat_map(|line| line.times.iter().copied().zip(line.curve.points.clone()));
    let lanes = plot.tracks.iter().flat_map(|track| track.places());
    let lanes = lanes.map(|(t, _, point)| (t, point));
    let away = |point: [f64; 2]| area.at(point).distance_sq(at);
    let near = lanes.chain(exact).map(|(t, point)| (away(point), t));
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, t)| t)
}

/// Shows the values at time `t` (s) and a crosshair there, or the present values if there is no `t`. `has_tag` adds the
/// time above the plot.
pub(super) fn show(
    ui: &Ui,
    studio: &Studio,
    styles: &SeriesStyles,
    (cell, area): (&Cell<'_>, &PlotArea),
    t: Option<f64>,
    has_tag: bool,
) {
    let (frame, now) = (area.rect, styles.now_s);
    let [from, to] = area.bounds[0];
    let is_over_time = cell.plot.is_over_time();
    let present = if cell.plot.is_of_ticks { studio.race().t() } else { now };
    let readouts = cell.plot.readouts(studio, styles, t.unwrap_or(present));
    let painter = ui.painter();
    if is_over_time && (from..to).contains(&now) {
        let x = area.at([now, 0.0]).x;
        let ends = [pos2(x, frame.top()), pos2(x, frame.bottom())];
        let dim = Stroke::new(1.0, palette(ui).dim);
        painter.extend(Shape::dashed_line(&ends, dim, 2.0, 3.0));
    }
    if let Some(t) = t {
        let inside = painter.with_clip_rect(frame.expand(DOT));
        let line = Stroke::new(CROSSHAIR, palette(ui).accent);
        if is_over_time {
            inside.vline(area.at([t, 0.0]).x, frame.y_range(), line);
        }
        for readout in &readouts {
            let at = area.at(readout.at);
            if frame.contains(at) {
                inside.circle_filled(at, DOT, readout.colour);
                inside.circle_stroke(at, DOT, Stroke::new(1.0, palette(ui).plot));
            }
        }
        if has_tag {
            let x = match is_over_time {
                true => area.at([t, 0.0]).x,
                false => frame.center().x,
            };
            time_tag(
                ui,
                frame,
                x,
                &format!("t = {} s", decimals(t, if is_over_time { to - from } else { 10.0 })),
            );
        }
    }
    if cell.right > frame.right() {
        values(ui, cell, readouts);
    }
}

/// Formats a time with as many decimals as the zoom resolves.
fn decimals(t: f64, wide: f64) -> String {
    let decimals = (2.5 - libm::log10(wide)).ceil().clamp(2.0, 9.0) as usize;
    format!("{t:.decimals$}")
}

/// Shows the time at `x`, above the plot.
fn time_tag(ui: &Ui, frame: Rect, x: f32, text: &str) {
    let (painter, palette) = (ui.painter(), palette(ui));
    let words = painter.layout_no_wrap(text.to_owned(), strong_font(NAME), palette.on_accent);
    let size = words.size() + vec2(14.0, 5.0);
    let least = frame.left() + size.x / 2.0;
    let middle = x.clamp(least, (frame.right() - size.x / 2.0).max(least));
    let tag = Rect::from_center_size(pos2(middle, frame.top() - size.y / 2.0 - 1.0), size);
    painter.rect_filled(tag, 4.0, palette.accent);
    painter.galley(tag.min + vec2(7.0, 2.5), words, palette.on_accent);
}

/// Writes the values beside the plot in a fixed order. The exact solution comes first, then the lanes by number.
fn values(ui: &Ui, cell: &Cell<'_>, mut readouts: Vec<Readout>) {
    let frame = cell.frame;
    let lines = |readout: &Readout| -> Vec<[String; 2]> {
        let axes = cell.plot.axes.iter().zip(readout.at);
        let shown = axes.skip(usize::from(cell.plot.is_over_time()));
        shown.map(|(axis, place)| [axis.with_unit(place), axis.number(place)]).collect()
    };
    let most = ((frame.height() + 10.0) / LINE).floor().max(1.0) as usize;
    // Only the values of the front curves are shown if there is no room for all of them.
    let each = if cell.plot.is_over_time() { 1 } else { 2 };
    if readouts.len() * each > most {
        readouts.retain(|readout| readout.is_front);
    }
    readouts.sort_by_key(|readout| readout.entry);
    for (place, readout) in (0..).zip(&readouts) {
        let y = frame.top() + LINE * ((place * each) as f32 + 0.5);
        let font = match readout.is_front {
            true => strong_font(NAME),
            false => FontId::proportional(NAME),
        };
        let name = pos2(frame.right() + 8.0, y);
        let write = |at: Pos2, align: Align2, text: &str| {
            ui.painter().text(at, align, text, font.clone(), readout.colour)
        };
        let named = write(name, Align2::LEFT_CENTER, &readout.name);
        let width = |text: &String| {
            ui.painter().layout_no_wrap(text.clone(), font.clone(), readout.colour).size().x
        };
        for (line, texts) in (0..).zip(lines(readout)) {
            let at = pos2(cell.right, y + LINE * line as f32);
            // The unit may be left out, because the axis also shows it.
            let beside = if line == 0 { named.right() + BETWEEN } else { frame.right() };
            let has_room = beside + width(&texts[0]) <= cell.right;
            write(at, Align2::RIGHT_CENTER, &texts[usize::from(!has_room)]);
        }
    }
}
