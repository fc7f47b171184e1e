//! Charts, which are curves over a pair of axes. They are laid out as [primitives](Primitive), which a panel can paint
//! and a file can keep.

use egui::{Align2, Color32, Pos2, Rect, Stroke, pos2, vec2};

use super::theme::PanelPalette;

pub(super) use area::{Bounds, PlotArea};
pub(super) use axis::AxisMark;
pub use axis::AxisScale;
pub(super) use curves::{Curve, Dots, LineStyle, ScreenCurve};
pub(super) use primitive::{Primitive, Text, paint};

mod area;
mod axis;
mod bands;
mod curves;
pub(super) mod figure;
pub(super) mod legend;
mod primitive;
pub(super) mod svg;

/// The radius of the ring around a switch, in screen points.
const RING: f32 = 4.0;
/// The radius of the dots of a curve without a line.
const SCATTERED: f32 = 1.0;
/// Font size of a number and of a name at an axis, in points.
pub(super) const NUMBER: f32 = 11.5;
pub(super) const NAME: f32 = 12.5;
/// Heights in points of the line above a plot, the numbers below it, and the name of its horizontal axis.
pub(super) const ABOVE: f32 = 19.0;
pub(super) const NUMBERS: f32 = 17.0;
pub(super) const NAMES: f32 = 16.0;
/// Gap between the numbers of the vertical axis and the plot, in points.
const BESIDE: f32 = 6.0;

/// Place where a lane leaves the plot: its last point inside and its first outside. Both points are equal if the lane
/// was never inside.
pub(super) struct Arrow {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) colour: Color32,
}

/// A point at which another method took over the lane, in the colour of that method.
pub(super) struct Switch {
    pub(super) at: [f64; 2],
    pub(super) colour: Color32,
}

/// The contents of a plot.
#[derive(Default)]
pub(super) struct Drawing {
    /// Curves from bottom to top. All their dots lie over them.
    pub(super) curves: Vec<Curve>,
    /// Exact curves. They lie over the other curves and their dots.
    pub(super) truth: Vec<Curve>,
    pub(super) arrows: Vec<Arrow>,
    pub(super) switches: Vec<Switch>,
    pub(super) switch_mark: SwitchMark,
}

/// Mark at a switch of the method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum SwitchMark {
    /// A line across the plot at the time of the switch.
    #[default]
    Line,
    /// A ring around the point of the switch.
    Ring,
}

/// Returns the approximate width of text in this font size, in points.
pub(super) fn text_width(words: &str, size: f32) -> f32 {
    0.6 * size * words.chars().count() as f32
}

/// Returns an empty plot: its edge, and a grid line at each mark, with the mark's number if there is one. No number
/// extends beyond `right`.
pub(super) fn axes(
    area: &PlotArea,
    marks: [Vec<AxisMark>; 2],
    palette: &PanelPalette,
    right: f32,
) -> Vec<Primitive> {
    plot(area, marks, &Drawing::default(), palette, right)
}

/// Returns a plot with [its axes](axes) and its contents.
pub(super) fn plot(
    area: &PlotArea,
    marks: [Vec<AxisMark>; 2],
    drawing: &Drawing,
    palette: &PanelPalette,
    right: f32,
) -> Vec<Primitive> {
    let (rect, grid) = (area.rect, Stroke::new(1.0, palette.grid));
    let number = |at: Pos2, anchor: Align2, text: String| {
        let is_named = !text.is_empty();
        let text = Text { right, ..Text::new(at, anchor, text, NUMBER, palette.dim) };
        is_named.then_some(Primitive::Text(text))
    };
    let [across, upwards] = marks;
    let mut all = Vec::new();
    let mut free_from = f32::NEG_INFINITY;
    for (place, text) in across {
        let x = area.at([place, area.bounds[1][0]]).x;
        all.push(Primitive::Line([pos2(x, rect.top()), pos2(x, rect.bottom())], grid));
        let half = text_width(&text, NUMBER) / 2.0;
        // A narrow plot lacks room for all numbers.
        if x - half >= free_from {
            all.extend(number(pos2(x, rect.bottom() + 3.0), Align2::CENTER_TOP, text));
            free_from = x + half;
        }
    }
    let mut last = f32::NEG_INFINITY;
    for (place, text) in upwards {
        let y = area.height(place);
        all.push(Primitive::Line([pos2(rect.left(), y), pos2(rect.right(), y)], grid));
        // Keeps the number out of the line above the plot.
        let at = pos2(rect.left() - BESIDE, y.max(rect.top() + 5.0));
        // A low plot lacks room for all numbers.
        if (at.y - last).abs() >= NUMBER {
            all.extend(number(at, Align2::RIGHT_CENTER, text));
            last = at.y;
        }
    }
    all.push(contents(area, drawing));
    all.push(Primitive::Edge(rect, Stroke::new(1.0, palette.line)));
    all
}

/// Returns the names of the axes. The horizontal axis has its name below its numbers. The vertical axis has its name
/// above the plot, beginning at `left`.
pub(super) fn names<S: Into<String>>(
    area: &PlotArea,
    left: f32,
    [along, up]: [S; 2],
    palette: &PanelPalette,
) -> [Text; 2] {
    let rect = area.rect;
    let below = pos2(rect.center().x, rect.bottom() + NUMBERS);
    let above = pos2(left, rect.top() - ABOVE / 2.0);
    [
        Text::new(below, Align2::CENTER_TOP, along, NAME, palette.dim),
        Text::new(above, Align2::LEFT_CENTER, up, NAME, palette.dim),
    ]
}

/// Returns the contents of a plot, clipped at its edges.
fn contents(area: &PlotArea, drawing: &Drawing) -> Primitive {
    let rect = area.rect;
    let switch = |Switch { at, colour }: &Switch| {
        let at = area.at(*at);
        match drawing.switch_mark {
            SwitchMark::Line => {
                let ends = [pos2(at.x, rect.top()), pos2(at.x, rect.bottom())];
                Primitive::Line(ends, Stroke::new(1.0, colour.gamma_multiply(0.6)))
            }
            SwitchMark::Ring => Primitive::Ring(at, RING, Stroke::new(1.0, *colour)),
        }
    };
    let on_screen = |curves: &[Curve]| {
        Primitive::Curves(curves.iter().map(|curve| curve.on_screen(area)).collect())
    };
    let curves = [on_screen(&drawing.curves), on_screen(&drawing.truth)];
    let mut arrows = curves::Arrows::new(rect);
    let arrow = |Arrow { from, to, colour }: &Arrow| {
        let corners = arrows.place([from, to].map(|at| area.at(*at)))?;
        Some(Primitive::Polygon(corners.into(), *colour))
    };
    let arrows: Vec<_> = drawing.arrows.iter().filter_map(arrow).collect();
    let all = drawing.switches.iter().map(switch).chain(curves).chain(arrows);
    Primitive::Clip(rect, all.collect())
}

/// Returns the rectangle of a plot within `room`. It leaves room for the lines above and below, `left` points for the
/// numbers of the vertical axis, and `right` points.
pub(super) fn inside(room: Rect, left: f32, right: f32) -> Rect {
    Rect::from_min_max(room.min + vec2(left, ABOVE), room.max - vec2(right, NUMBERS + NAMES))
}
