//! Curves in a plot: what the window's instruments and the chapter's figures have in common.

use egui::{Color32, Painter, Pos2, Rect, Stroke, Ui, pos2, vec2};
use egui_plot::{AxisHints, Plot, PlotBounds};

use super::curves::{self, Curve, Dots, SCATTERED, dots};
use crate::lab::number::round;

/// The radius of the ring round a switch, in points of the screen.
const RING: f32 = 4.0;

/// A lane leaving the plot: its last point inside and its first outside. Equal if it was never inside.
pub(super) struct Arrow {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) colour: Color32,
}

/// A point at which another method took over, in that method's colour.
pub(super) struct Switch {
    pub(super) at: [f64; 2],
    pub(super) colour: Color32,
}

/// Everything in a plot.
#[derive(Default)]
pub(super) struct Drawing {
    /// The first at the bottom, and over all of them their dots.
    pub(super) curves: Vec<Curve>,
    /// Over the others and their dots.
    pub(super) truth: Vec<Curve>,
    pub(super) arrows: Vec<Arrow>,
    pub(super) switches: Vec<Switch>,
    pub(super) switch_mark: SwitchMark,
}

/// What marks a switch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum SwitchMark {
    /// A line across the plot, at its time.
    #[default]
    Line,
    /// A ring at its point.
    Ring,
}

/// The furthest that a point outside is drawn, in widths or heights of the plot.
const FAR_OUTSIDE: f64 = 10.0;

/// The usual width of a curve, in points.
pub(super) const CURVE: f32 = 1.6;

/// The height of a time axis in points, at least that of its text: a plot that had to learn it would be
/// laid out again in its second frame, and the first would not match.
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

/// Draws everything in the plot, cut off at the bounds.
pub(super) fn draw(ui: &mut Ui, plot: Plot<'_>, bounds: PlotBounds, drawing: &Drawing) {
    let shown = plot.show(ui, |plot| plot.set_plot_bounds(bounds));
    paint(ui.painter(), *shown.transform.frame(), &bounds, drawing);
}

/// Where a point of a plot with these bounds lies in its frame on the screen. A point far outside is drawn nearer, but
/// far enough out for a line to leave at its own slope, and near enough for the f32 of the painter.
pub(super) fn on_screen(frame: Rect, bounds: &PlotBounds, at: [f64; 2]) -> Pos2 {
    Projection::new(frame, bounds).at(at)
}

/// How points of a plot lie on the screen.
struct Projection {
    frame: Rect,
    least: [f64; 2],
    /// Parts of the frame to a unit of the axes.
    parts: [f64; 2],
}

impl Projection {
    fn new(frame: Rect, bounds: &PlotBounds) -> Self {
        let (least, most) = (bounds.min(), bounds.max());
        Self { frame, least, parts: [0, 1].map(|axis| 1.0 / (most[axis] - least[axis])) }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Pos2 {
        pos2(self.frame.left() + self.part(0, x) * self.frame.width(), self.height(y))
    }

    fn height(&self, y: f64) -> f32 {
        self.frame.bottom() - self.part(1, y) * self.frame.height()
    }

    fn part(&self, axis: usize, value: f64) -> f32 {
        let part = (value - self.least[axis]) * self.parts[axis];
        part.clamp(-FAR_OUTSIDE, 1.0 + FAR_OUTSIDE) as f32
    }
}

/// Draws everything in a plot into `frame`, cut off at its edges.
pub(super) fn paint(painter: &Painter, frame: Rect, bounds: &PlotBounds, drawing: &Drawing) {
    let seen = frame.intersect(painter.clip_rect());
    if !seen.is_positive() {
        return;
    }
    let painter = painter.with_clip_rect(seen);
    let projection = Projection::new(frame, bounds);
    let on_screen = |at: &[f64; 2]| projection.at(*at);
    for Switch { at, colour } in &drawing.switches {
        let at = on_screen(at);
        match drawing.switch_mark {
            SwitchMark::Line => {
                painter.vline(at.x, frame.y_range(), Stroke::new(1.0, colour.gamma_multiply(0.6)));
            }
            SwitchMark::Ring => {
                painter.circle_stroke(at, RING, Stroke::new(1.0, *colour));
            }
        }
    }
    let paint_curves = |curves: &[Curve]| {
        let mut with_dots = Vec::new();
        for curve in curves {
            let points: Vec<Pos2> = curve.points.iter().map(on_screen).collect();
            let height = |y: f64| projection.height(y);
            let swept: Vec<[f32; 2]> = curve.swept.iter().map(|ends| ends.map(height)).collect();
            let is_line = curves::paint(&painter, &points, &swept, curve);
            let dots = if is_line { curve.dots } else { Dots::Each(SCATTERED) };
            with_dots.push((curve.colour, dots, points));
        }
        for (colour, kind, points) in with_dots {
            for (at, radius) in dots(&points, kind).filter(|(at, _)| frame.contains(*at)) {
                painter.circle_filled(at, radius, colour);
            }
        }
    };
    paint_curves(&drawing.curves);
    paint_curves(&drawing.truth);
    let mut arrows = curves::Arrows::new(&painter);
    for Arrow { from, to, colour } in &drawing.arrows {
        arrows.paint([on_screen(from), on_screen(to)], *colour);
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
