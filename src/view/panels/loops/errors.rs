//! The animation error of the last frames.

use egui::{Align2, Rect, Ui, vec2};

use super::counts::{BELOW, LEFT, NAME, TITLE};
use super::row::Row;
use crate::chart::{self, AxisScale, PlotArea, Primitive, Text};
use crate::panels::table::TableRow;
use crate::stage::number::round;
use crate::theme::{PanelPalette, palette};

/// Number of frames that the chart shows.
const FRAMES: usize = 24;
/// Minimum range of the axis on both sides, in milliseconds. Errors far smaller are invisible.
const MIN_MS: f64 = 1.0;
/// Share of a frame's width that its bars fill, and minimum height of a bar in points.
const BARS: f32 = 0.84;
const MIN_HEIGHT: f32 = 1.0;

/// Rounds up to the next of 1, 2, 5, 10 and so on.
pub(super) fn round_up(value: f64) -> f64 {
    let decade = libm::pow(10.0, libm::floor(libm::log10(value)));
    let steps = [1.0, 2.0, 5.0].map(|digit| digit * decade);
    steps.into_iter().find(|step| *step >= value * (1.0 - 1e-9)).unwrap_or(10.0 * decade)
}

/// Returns the errors of the last frames of a lane in milliseconds, from the present frame backwards.
fn errors_ms(row: &Row<'_>) -> impl Iterator<Item = f64> {
    let lane = row.lane();
    let until = lane.frame_at(row.loops.now_ns()).map_or(0, |index| index + 1);
    let frames = lane.frames()[..until].iter().rev().take(FRAMES);
    frames.map(|frame| frame.animation_error_ms)
}

/// Returns the largest magnitude of the errors of the last frames, in milliseconds.
fn largest_ms(lanes: &[Row<'_>]) -> f64 {
    lanes.iter().flat_map(errors_ms).fold(0.0, |most, error| most.max(error.abs()))
}

/// Shows the error of each of the last frames, with a bar for each lane.
pub(super) fn show(ui: &Ui, room: Rect, lanes: &[Row<'_>]) {
    let bars = ui.interact(room, ui.scope_id().with("animation error"), egui::Sense::hover());
    let largest = round(largest_ms(lanes), 3);
    let told = format!("Animation error of the last {FRAMES} frames: {largest} ms at most");
    bars.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &told));
    chart::paint(&ui.painter_at(room), &layout(room, lanes, palette(ui)));
}

/// Lays out the chart of the errors.
pub(super) fn layout(room: Rect, lanes: &[Row<'_>], palette: &PanelPalette) -> Vec<Primitive> {
    let [title, name] = match room.width() > 165.0 {
        true => ["Animation error by frame", "ms, by frame from now"],
        false => ["Animation error", "ms, by frame"],
    };
    let title = Text::new(room.left_top(), Align2::LEFT_TOP, title, 13.0, palette.text);
    let mut all = vec![title.strong().into()];
    let rect = Rect::from_min_max(room.min + vec2(LEFT, TITLE), room.max - vec2(6.0, BELOW + NAME));
    if !rect.is_positive() || rect.height() < 20.0 {
        return all;
    }
    let reach = round_up((1.1 * largest_ms(lanes)).max(MIN_MS));
    let area = PlotArea { rect, bounds: [[-(FRAMES as f64), 0.0], [-reach, reach]] };
    all.push(Primitive::Area(rect, palette.plot));
    let along = [0.0, 8.0, 16.0].map(|back| (-back - 0.5, round(-back, 3))).into();
    let up = area.marks(1, AxisScale::Linear, 24.0);
    all.extend(chart::axes(&area, [along, up], palette, room.right()));
    let frame = rect.width() / FRAMES as f32;
    let width = frame * BARS / lanes.len().max(1) as f32;
    let zero = area.height(0.0);
    for (i, row) in lanes.iter().enumerate() {
        for (back, error) in errors_ms(row).enumerate() {
            let right = rect.right() - frame * back as f32;
            let left = right - frame * (1.0 + BARS) / 2.0 + width * i as f32;
            let end = area.height(error);
            let bar = Rect::from_x_y_ranges(
                left..=left + width.max(1.0),
                end.min(zero - MIN_HEIGHT)..=end.max(zero + MIN_HEIGHT),
            );
            all.push(Primitive::Area(bar, row.style(palette).0));
        }
    }
    let [name, _] = chart::names(&area, room.left(), [name, ""], palette);
    all.push(name.into());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_reaches_to_the_next_round_number() {
        let rounded = [1.0, 1.1, 2.0, 4.9, 5.1, 16.7, 300.0].map(round_up);
        assert_eq!(rounded, [1.0, 2.0, 2.0, 5.0, 10.0, 20.0, 500.0]);
    }
}
