//! The axes of the instruments' plots: their marks, numbers and names.

use egui::{FontId, RichText, Vec2};
use egui_plot::{AxisHints, Plot};

use super::QUIET;
use crate::view::plot::{X_AXIS, plot};
use crate::view::ticks::{self, NEVER_FADED};

/// Room for the numbers of a vertical axis, in points: a plot that had to learn it would be laid out anew
/// in its second frame, and the first would not match.
const Y_AXIS: f32 = 58.0;
/// Room for the name of a horizontal axis, in points.
const AXIS_NAME: f32 = 17.0;
/// The least distance between marks along and up, in points, as long as three fit.
pub(super) const MARKS_APART: [f64; 2] = [64.0, 28.0];
/// The height of a number, in points.
const NUMBER: f32 = 11.0;

/// What is written along an axis.
pub(super) struct AxisText<'a> {
    /// Empty where the plot's title says it.
    pub(super) name: String,
    /// After each number.
    pub(super) unit: &'a str,
}

/// Axes with these units and no names.
pub(super) fn units(units: [&str; 2]) -> [AxisText<'_>; 2] {
    units.map(|unit| AxisText { name: String::new(), unit })
}

/// An empty plot with marked axes.
pub(super) fn axes<'a>(id: &'static str, room: Vec2, [along, up]: [AxisText<'a>; 2]) -> Plot<'a> {
    let hints = |hints: AxisHints<'a>, name: String| {
        let name = RichText::new(name).color(QUIET);
        let hints = hints.label_spacing(NEVER_FADED).label(name);
        hints.tick_label_font(FontId::proportional(NUMBER))
    };
    let below = if along.name.is_empty() { X_AXIS } else { X_AXIS + AXIS_NAME };
    plot(id, room.y)
        .width(room.x)
        .custom_x_axes(vec![hints(AxisHints::new_x(), along.name).min_thickness(below)])
        .custom_y_axes(vec![hints(AxisHints::new_y(), up.name).min_thickness(Y_AXIS)])
        .x_grid_spacer(|input| ticks::linear(input, MARKS_APART[0]))
        .y_grid_spacer(|mut input| {
            // No number so low that it stands on the first one of the other axis.
            let (low, high) = input.bounds;
            input.bounds.0 = low + 0.04 * (high - low);
            ticks::linear(input, MARKS_APART[1])
        })
        .x_axis_formatter(move |mark, view| ticks::linear_label(mark, view, along.unit))
        .y_axis_formatter(move |mark, view| ticks::linear_label(mark, view, up.unit))
}
