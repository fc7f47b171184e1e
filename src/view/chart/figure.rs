//! Charts that fill a picture. A chart has a title, a legend, axes with units, curves, and a note below them.

use egui::{
    Frame, Label, Margin, Rect, RichText, TextStyle, TextWrapMode, Ui, UiBuilder, WidgetText, pos2,
    vec2,
};

use super::{
    Arrow, AxisScale, Curve, Dots, Drawing, LineStyle, PlotArea, Primitive, legend, paint, plot,
};
use crate::look::palette::{Rgba, Theme};
use crate::theme::{PanelPalette, colour, palette};

/// A picture of one or more charts.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Heading of the picture.
    pub title: String,
    /// Footnote with everything needed to reproduce the figure.
    pub note: String,
    /// Number of charts side by side. The last chart takes the rest of its row.
    pub columns: usize,
    /// The charts, row by row.
    pub charts: Vec<Chart>,
}

/// Curves over a pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title that distinguishes the chart from the figure's others. It is empty for a single chart.
    pub title: String,
    /// Place of the names of the curves.
    pub legend: Legend,
    /// Horizontal and vertical axis.
    pub axes: [Axis; 2],
    /// Curves from bottom to top.
    pub curves: Vec<FigureCurve>,
}

/// Place of the names of a chart's curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legend {
    /// The names are below the figure's title, once for all charts with this legend.
    Shared,
    /// The names are below the chart's own title.
    Own,
}

/// One axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity, with its unit.
    pub name: &'static str,
    /// Lowest and highest value in view.
    pub view: [f64; 2],
    /// Scale of the axis. On a logarithmic axis, all values in view must be above 0.
    pub scale: AxisScale,
}

/// A curve of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureCurve {
    /// Name in the legend.
    pub name: String,
    /// Colour of the line and its dots.
    pub colour: Rgba,
    /// Length of a dash and of the gap after it, in points. A line with a gap of 0 is solid.
    pub dash: [f32; 2],
    /// Radius of the dot on each point, in points. It is 0 if the points have no dots.
    pub dots: f32,
    /// Points of the curve, as values on the two axes.
    pub points: Vec<[f64; 2]>,
}

/// Returns the range of points along an axis, at least 1.
pub fn span<'a>(points: impl Iterator<Item = &'a [f64; 2]>, axis: usize) -> [f64; 2] {
    let along: Vec<f64> = points.map(|point| point[axis]).collect();
    let start = along.iter().copied().reduce(f64::min).unwrap_or(0.0);
    [start, along.into_iter().fold(start + 1.0, f64::max)]
}

impl FigureCurve {
    /// Returns the diagonal on which every picture shows the moment of its display.
    pub fn real_time(theme: Theme, span: [f64; 2]) -> Self {
        let (name, colour) = ("the moment of display".into(), theme.palette().text);
        Self { name, colour, dash: [1.0, 0.0], dots: 0.0, points: span.map(|end| [end; 2]).into() }
    }
}

impl Chart {
    /// Returns the chart of loops' [game time](crate::loops::GameTime) over real time, beside the diagonal. A game
    /// stands still between two frames.
    pub fn of_game_time(title: String, theme: Theme, mut curves: Vec<FigureCurve>) -> Self {
        let points = || curves.iter().flat_map(|curve| &curve.points);
        let real = span(points(), 0);
        let game = span(points().chain(&[[0.0, real[0]], [0.0, real[1]]]), 1);
        let axis = |name, view| Axis { name, view, scale: AxisScale::Linear };
        let axes = [axis("real time (ms)", real), axis("game time (ms)", game)];
        for curve in &mut curves {
            let held = curve.points.windows(2).map(|pair| [pair[1][0], pair[0][1]]);
            let last = curve.points.last().copied();
            let points = curve.points.iter().copied().zip(held).flat_map(|(at, held)| [at, held]);
            curve.points = points.chain(last).collect();
        }
        curves.insert(0, FigureCurve::real_time(theme, real));
        Self { title, legend: Legend::Shared, axes, curves }
    }
}

/// Room around the note, in points.
const NOTE: f32 = 19.6;

/// Room between the charts of a figure, in points.
const GAP: f32 = 22.0;

/// Minimum distance between marks, horizontally and vertically, in points. If fewer than three marks would fit, they
/// move closer.
const MARKS_APART: [f64; 2] = [44.0, 26.0];

/// The width of a curve, in points.
const CURVE: f32 = 1.6;

/// Distance from the left edge to the title, the axes and the note, in points.
const INDENT: f32 = 58.0;

/// Shows the figure in all the room of `ui`.
pub(crate) fn show(ui: &mut Ui, figure: &Figure) {
    let frame = Frame::new().fill(palette(ui).background).inner_margin(Margin {
        left: 12,
        right: 26,
        top: 18,
        bottom: 8,
    });
    egui::CentralPanel::default_margins().frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            ui.label(RichText::new(&figure.title).size(17.0).color(palette(ui).text));
        });
        ui.add_space(4.0);
        let mut named: Vec<&FigureCurve> = Vec::new();
        for chart in figure.charts.iter().filter(|chart| chart.legend == Legend::Shared) {
            for curve in &chart.curves {
                if !named.iter().any(|other| other.name == curve.name) {
                    named.push(curve);
                }
            }
        }
        show_legend(ui, &named);
        ui.add_space(8.0);
        let note = WidgetText::from(RichText::new(&figure.note).color(palette(ui).dim));
        let width = ui.available_width() - INDENT;
        let note = note.into_galley(ui, Some(TextWrapMode::Wrap), width, TextStyle::Body);
        let mut room = ui.available_rect_before_wrap();
        room.max.y = (room.max.y - NOTE - note.size().y).max(room.min.y + 10.0);
        for (n, (chart, place)) in figure.charts.iter().zip(places(figure, room)).enumerate() {
            ui.scope_builder(UiBuilder::new().id_salt(n).max_rect(place), |ui| {
                show_chart(ui, chart, place);
            });
        }
        ui.advance_cursor_after_rect(room);
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            ui.label(note);
        });
    });
}

/// Returns the rectangle of each chart.
fn places(figure: &Figure, room: Rect) -> impl Iterator<Item = Rect> {
    let (columns, charts) = (figure.columns.max(1), figure.charts.len());
    let rows = charts.div_ceil(columns);
    let cell = (room.size() + vec2(GAP, GAP)) / vec2(columns as f32, rows as f32);
    (0..charts).map(move |n| {
        let corner = room.min + cell * vec2((n % columns) as f32, (n / columns) as f32);
        let right = if n + 1 == charts { room.max.x } else { corner.x + cell.x - GAP };
        Rect::from_min_max(corner, pos2(right, corner.y + cell.y - GAP))
    })
}

fn show_chart(ui: &mut Ui, chart: &Chart, place: Rect) {
    if !chart.title.is_empty() {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            let title = RichText::new(&chart.title).size(14.0).color(palette(ui).text);
            ui.add(Label::new(title).wrap());
        });
    }
    if chart.legend == Legend::Own {
        show_legend(ui, &chart.curves.iter().collect::<Vec<_>>());
        ui.add_space(5.0);
    }
    let room = place.with_min_y(ui.cursor().top());
    paint(ui.painter(), &layout(chart, room, palette(ui)));
}

/// Lays out a chart without its title and legend.
pub(crate) fn layout(chart: &Chart, room: Rect, palette: &PanelPalette) -> Vec<Primitive> {
    let bounds = [0, 1].map(|axis| {
        let Axis { view, scale, .. } = &chart.axes[axis];
        view.map(|value| scale.place(value))
    });
    let area = PlotArea { rect: super::inside(room, INDENT, 0.0), bounds };
    let marks = [0, 1].map(|axis| area.marks(axis, chart.axes[axis].scale, MARKS_APART[axis]));
    let curves: Vec<Curve> = chart.curves.iter().map(|curve| laid_out(curve, chart)).collect();
    let [low, high] = bounds[1];
    let arrows = curves.iter().filter_map(|curve| {
        let newest = curve.points.last().filter(|point| !(low..=high).contains(&point[1]))?;
        Some(Arrow { from: *newest, to: *newest, colour: curve.style.colour })
    });
    let arrows = arrows.collect();
    let drawing = Drawing { curves, arrows, ..Drawing::default() };
    let mut all = plot(&area, marks, &drawing, palette, f32::INFINITY);
    let names = chart.axes.each_ref().map(|axis| axis.name);
    all.extend(super::names(&area, area.rect.left(), names, palette).map(Into::into));
    all
}

/// Converts a curve to places on the chart's axes, and drops points that are not finite there.
fn laid_out(curve: &FigureCurve, chart: &Chart) -> Curve {
    let [along, up] = [0, 1].map(|axis| chart.axes[axis].scale);
    let points = curve.points.iter().map(|&[x, y]| [along.place(x), up.place(y)]);
    let dots = if curve.dots > 0.0 { Dots::Each(curve.dots) } else { Dots::None };
    let style = LineStyle { colour: colour(curve.colour), width: CURVE, dash: curve.dash, dots };
    Curve::new(style, points.filter(|[x, y]| x.is_finite() && y.is_finite()).collect())
}

/// Shows the legend of these curves in one row, or in several columns if one row is too long.
fn show_legend(ui: &mut Ui, curves: &[&FigureCurve]) {
    let entry = |curve: &&FigureCurve| legend::Entry {
        name: curve.name.clone(),
        colour: colour(curve.colour),
        dash: curve.dash,
        is_front: false,
    };
    let entries: Vec<legend::Entry> = curves.iter().map(entry).collect();
    let widths: Vec<f32> = entries.iter().map(|entry| entry.width(ui) + legend::BETWEEN).collect();
    let room = ui.available_width() - INDENT;
    let (mut columns, mut width) = (entries.len().max(1), 0.0);
    if widths.iter().sum::<f32>() > room {
        let widest = widths.iter().copied().fold(0.0, f32::max);
        let fit = ((room / widest) as usize).max(1);
        (columns, width) = (columns.div_ceil(columns.div_ceil(fit)), widest - legend::BETWEEN);
    }
    ui.spacing_mut().item_spacing.x = legend::BETWEEN;
    ui.spacing_mut().interact_size.y = legend::ROW;
    for row in entries.chunks(columns) {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            legend::show_here(ui, row, width);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_fill_their_rows_and_the_last_one_fills_the_rest() {
        let chart = Chart {
            title: String::new(),
            legend: Legend::Own,
            axes: ["x", "y"].map(|name| Axis { name, view: [1.0, 2.0], scale: AxisScale::Log }),
            curves: Vec::new(),
        };
        let room = Rect::from_min_max(pos2(10.0, 20.0), pos2(310.0, 220.0));
        for (columns, charts, rows) in [(1, 1, 1), (2, 2, 1), (2, 3, 2), (3, 10, 4)] {
            let charts = vec![chart.clone(); charts];
            let figure = Figure { title: String::new(), note: String::new(), columns, charts };
            let places: Vec<Rect> = places(&figure, room).collect();
            let (first, last) = (places[0], places[places.len() - 1]);
            assert_eq!((first.min, last.max), (room.min, room.max));
            let height = (room.height() + GAP) / rows as f32 - GAP;
            assert!(places.iter().all(|place| (place.height() - height).abs() < 1e-3));
            for (n, place) in places.iter().enumerate() {
                let apart = |other: &Rect| !other.intersects(place.expand(GAP / 2.0 - 0.1));
                assert!(places[..n].iter().all(apart), "{places:?}");
            }
        }
    }
}
