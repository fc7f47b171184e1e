//! Curves in a plot: what the window's instruments and the chapter's figures have in common.

use egui::{Color32, Painter, Pos2, Stroke, Ui, pos2, vec2};
use egui_plot::{AxisHints, Plot, PlotBounds, PlotPoint};

use super::curves;
use crate::lab::number::round;
use crate::lab::picture::Rgba;

/// A curve to be drawn.
pub(super) struct Curve {
    pub(super) colour: Color32,
    /// In points.
    pub(super) width: f32,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub(super) dash: [f32; 2],
    /// Radius in points of a dot on each point; 0 for none.
    pub(super) dots: f32,
    pub(super) points: Vec<[f64; 2]>,
}

pub(super) fn colour([r, g, b, a]: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

/// The usual width of a curve, in points.
pub(super) const CURVE: f32 = 1.6;

/// The height of a time axis in points, at least that of its text: a plot that had to learn it would be
/// laid out anew in its second frame, and the first would not match.
pub(super) const X_AXIS: f32 = 16.0;

/// An empty plot, to be looked at and not to be moved.
pub(super) fn plot<'a>(id: &'static str, height: f32) -> Plot<'a> {
    Plot::new(id)
        .height(height)
        .show_background(false)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(vec2(0.0, 0.0))
        .y_axis_min_width(52.0)
        .custom_x_axes(vec![AxisHints::new_x().min_thickness(X_AXIS)])
        .x_axis_formatter(|mark, _| format!("{} s", tick_text(mark.value)))
        .y_axis_formatter(|mark, _| tick_text(mark.value))
        .grid_color(Color32::from_rgb(64, 86, 116))
        .label_formatter(|_| None)
}

/// Draws the curves, each cut off at the bounds, with an arrow where its newest point is above or below
/// them; and over all curves their dots.
pub(super) fn draw(ui: &mut Ui, plot: Plot<'_>, bounds: PlotBounds, curves: &[Curve]) {
    let shown = plot.show(ui, |plot| plot.set_plot_bounds(bounds));
    let painter = ui.painter().with_clip_rect(*shown.transform.frame());
    let ([left, low], [right, high]) = (bounds.min(), bounds.max());
    // Far enough out for a line to leave at its own slope, near enough for the f32 of the painter.
    let (wide, tall) = (10.0 * (right - left), 10.0 * (high - low));
    let on_screen = |[x, y]: &[f64; 2]| {
        let (x, y) = (x.clamp(left - wide, right + wide), y.clamp(low - tall, high + tall));
        shown.transform.position_from_point(&PlotPoint::new(x, y))
    };
    for curve in curves {
        curves::paint(&painter, curve.points.iter().map(on_screen), curve);
        if let Some(newest) = curve.points.last() {
            curves::paint_arrow(&painter, on_screen(newest), curve.colour);
        }
    }
    for curve in curves.iter().filter(|curve| curve.dots > 0.0) {
        let within = |[x, y]: &&[f64; 2]| (left..=right).contains(x) && (low..=high).contains(y);
        for dot in curve.points.iter().filter(within) {
            painter.circle_filled(on_screen(dot), curve.dots, curve.colour);
        }
    }
}

/// A piece of a curve's line, from `from` to the right, as the plots draw it.
pub(super) fn swatch(
    painter: &Painter,
    from: Pos2,
    length: f32,
    [drawn, gap]: [f32; 2],
    colour: Color32,
) {
    let (mut x, to) = (from.x, from.x + length);
    while x < to {
        let end = if gap > 0.0 { (x + drawn).min(to) } else { to };
        painter.line_segment([pos2(x, from.y), pos2(end, from.y)], Stroke::new(3.0, colour));
        x = end + gap.max(1.0);
    }
}

/// A number on an axis; what the axis computes for its zero may miss it by a rounding.
pub(super) fn tick_text(value: f64) -> String {
    round((value * 1e9).round() / 1e9, 4)
}
