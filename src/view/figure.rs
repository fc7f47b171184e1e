//! Charts that fill a picture: a title, a legend, axes with units, curves, and a note below.

use std::ops::RangeInclusive;

use egui::{
    FontId, Frame, Margin, Rangef, Rect, RichText, Sense, TextStyle, TextWrapMode, Ui, UiBuilder,
    WidgetText, pos2, vec2,
};
use egui_plot::{AxisHints, GridInput, GridMark, PlotBounds};

use super::curves::{Curve, Dots};
use super::plot::{Arrow, CURVE, Drawing, X_AXIS, draw, plot, swatch, tick_text};
use super::theme::{colour, ink};
use crate::lab::number::superscript;
use crate::lab::picture::Rgba;

/// A picture of one chart or several.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// What has to be known to make it again.
    pub note: String,
    /// How many charts stand side by side; the last takes what its row has left.
    pub columns: usize,
    /// Row by row.
    pub charts: Vec<Chart>,
}

/// Curves over a pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What tells it from the figure's other charts; empty for one alone.
    pub title: String,
    /// Where its curves are named.
    pub legend: Legend,
    /// Along, and up.
    pub axes: [Axis; 2],
    /// The first is drawn at the bottom.
    pub curves: Vec<FigureCurve>,
}

/// Where a chart's curves are named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legend {
    /// Below the figure's title, once for all charts that have them.
    Shared,
    /// Below the chart's own title.
    Own,
}

/// What a chart measures in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity, with its unit.
    pub name: &'static str,
    /// The least and the greatest value in view.
    pub view: [f64; 2],
    /// How values are laid out along it.
    pub marks: Marks,
}

/// How values are laid out along an axis, and where they are marked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marks {
    /// Evenly, with a mark at the multiples of this.
    Every(f64),
    /// By their logarithm, with marks at powers of ten. Everything in view is above 0.
    Decades,
}

/// A curve of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureCurve {
    /// Its name in the legend.
    pub name: String,
    /// Its colour.
    pub colour: Rgba,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub dash: [f32; 2],
    /// Radius in points of a dot on each point; 0 for none.
    pub dots: f32,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

/// Room around the note, in points.
const NOTE: f32 = 19.6;

/// Room between the charts of a figure, in points.
const GAP: f32 = 22.0;

/// How close the marks along an axis may come before their names vanish, and when they are fully there,
/// in points.
const LABELS: Rangef = Rangef { min: 30.0, max: 40.0 };

/// From an edge to where the axes of a chart begin, in points.
const INDENT: f32 = 58.0;

/// Shows the figure in all of `ui`.
pub(super) fn show(ui: &mut Ui, figure: &Figure) {
    let frame = Frame::new().fill(ink(ui).background).inner_margin(Margin {
        left: 12,
        right: 26,
        top: 18,
        bottom: 8,
    });
    egui::CentralPanel::default_margins().frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            ui.label(RichText::new(&figure.title).size(17.0).color(ink(ui).text));
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
        legend(ui, &named);
        ui.add_space(8.0);
        let note = WidgetText::from(RichText::new(&figure.note).color(ink(ui).dim));
        let width = ui.available_width() - INDENT;
        let note = note.into_galley(ui, Some(TextWrapMode::Wrap), width, TextStyle::Body);
        let mut room = ui.available_rect_before_wrap();
        room.max.y = (room.max.y - NOTE - note.size().y).max(room.min.y + 10.0);
        for (n, (chart, place)) in figure.charts.iter().zip(places(figure, room)).enumerate() {
            ui.scope_builder(UiBuilder::new().id_salt(n).max_rect(place), |ui| {
                show_chart(ui, chart)
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

/// Where each chart goes.
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

fn show_chart(ui: &mut Ui, chart: &Chart) {
    if !chart.title.is_empty() {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            ui.label(RichText::new(&chart.title).size(14.0).color(ink(ui).text));
        });
    }
    if chart.legend == Legend::Own {
        legend(ui, &chart.curves.iter().collect::<Vec<_>>());
        ui.add_space(5.0);
    }
    let curves: Vec<Curve> = chart.curves.iter().map(|curve| laid_out(curve, chart)).collect();
    let [x, y] = &chart.axes;
    let [[left, right], [low, high]] =
        [x, y].map(|axis| axis.view.map(|value| axis.marks.place(value)));
    let bounds = PlotBounds::from_min_max([left, low], [right, high]);
    let [along, up] = [x.marks, y.marks];
    let axes = plot("chart", ui.available_height())
        .custom_x_axes(vec![AxisHints::new_x().min_thickness(X_AXIS).label_spacing(LABELS)])
        .x_axis_label(x.name)
        .y_axis_label(y.name)
        .x_axis_formatter(move |mark, in_view| along.label(mark, in_view))
        .y_axis_formatter(move |mark, in_view| up.label(mark, in_view))
        .x_grid_spacer(move |input| along.lines(input))
        .y_grid_spacer(move |input| up.lines(input));
    let arrows = curves.iter().filter_map(|curve| {
        let newest = curve.points.last().filter(|point| !(low..=high).contains(&point[1]))?;
        Some(Arrow { from: *newest, to: *newest, colour: curve.colour })
    });
    let arrows = arrows.collect();
    draw(ui, axes, bounds, &Drawing { curves, arrows, ..Drawing::default() });
}

/// A curve as it lies in the chart; what is not finite there is left out.
fn laid_out(curve: &FigureCurve, chart: &Chart) -> Curve {
    let [along, up] = [0, 1].map(|axis| chart.axes[axis].marks);
    let points = curve.points.iter().map(|&[x, y]| [along.place(x), up.place(y)]);
    Curve {
        colour: colour(curve.colour),
        width: CURVE,
        dash: curve.dash,
        dots: if curve.dots > 0.0 { Dots::Each(curve.dots) } else { Dots::None },
        points: points.filter(|[x, y]| x.is_finite() && y.is_finite()).collect(),
        swept: Vec::new(),
    }
}

impl Marks {
    /// The most powers of ten that are named along an axis.
    const MAX_NAMED: f64 = 7.0;

    /// Where a value lies along the axis.
    fn place(self, value: f64) -> f64 {
        match self {
            Marks::Every(_) => value,
            Marks::Decades => libm::log10(value),
        }
    }

    /// Marks within the input's bounds, and faint lines between them.
    fn lines(self, input: GridInput) -> Vec<GridMark> {
        const FINER: i64 = 5;
        let (low, high) = input.bounds;
        match self {
            Marks::Every(step) => {
                let fine = step / FINER as f64;
                let mark = |i: i64| {
                    let step_size = if i % FINER == 0 { step } else { fine };
                    GridMark { value: i as f64 * fine, step_size }
                };
                ((low / fine).ceil() as i64..=(high / fine).floor() as i64).map(mark).collect()
            }
            Marks::Decades => {
                let named = Self::named_every(low, high);
                let decades = low.floor() as i64..=high.floor() as i64;
                let marks = decades.flat_map(|decade| {
                    let whole = if decade % named == 0 { named as f64 } else { 1.0 };
                    let first = GridMark { value: decade as f64, step_size: whole };
                    let between = (2..=9).map(move |digit| GridMark {
                        value: decade as f64 + libm::log10(f64::from(digit)),
                        step_size: 0.1,
                    });
                    std::iter::once(first).chain(between)
                });
                marks.filter(|mark| (low..=high).contains(&mark.value)).collect()
            }
        }
    }

    /// What stands at a mark, and nothing at a faint line.
    fn label(self, mark: GridMark, in_view: &RangeInclusive<f64>) -> String {
        match self {
            Marks::Every(step) if mark.step_size < step => String::new(),
            Marks::Every(_) => tick_text(mark.value),
            Marks::Decades => {
                let named = Self::named_every(*in_view.start(), *in_view.end());
                match mark.value.round() as i32 {
                    _ if mark.step_size < named as f64 => String::new(),
                    0 => "1".into(),
                    1 => "10".into(),
                    exponent => format!("10{}", superscript(exponent)),
                }
            }
        }
    }

    /// Of how many powers of ten between these one is named.
    fn named_every(low: f64, high: f64) -> i64 {
        ((high - low) / Self::MAX_NAMED).ceil().max(1.0) as i64
    }
}

/// Each curve's name after a piece of its line: in one row, or where that is too long in columns.
fn legend(ui: &mut Ui, curves: &[&FigureCurve]) {
    const SWATCH: f32 = 34.0;
    const BEFORE_NAME: f32 = 6.0;
    const AFTER_NAME: f32 = 14.0;
    let name = |curve: &&FigureCurve| {
        ui.painter().layout_no_wrap(curve.name.clone(), FontId::proportional(13.0), ink(ui).text)
    };
    let names: Vec<_> = curves.iter().map(name).collect();
    let mut widths: Vec<f32> =
        names.iter().map(|name| SWATCH + BEFORE_NAME + name.size().x + AFTER_NAME).collect();
    let spacing = ui.spacing().item_spacing.x;
    let room = ui.available_width() - INDENT;
    let mut columns = curves.len().max(1);
    if widths.iter().map(|width| width + spacing).sum::<f32>() > room {
        let widest = widths.iter().fold(0.0, |widest: f32, &width| widest.max(width));
        let fit = ((room / (widest + spacing)) as usize).max(1);
        columns = columns.div_ceil(columns.div_ceil(fit));
        widths.fill(widest);
    }
    let entries: Vec<_> = curves.iter().zip(names).zip(widths).collect();
    for row in entries.chunks(columns) {
        ui.horizontal(|ui| {
            ui.add_space(INDENT);
            for ((curve, name), width) in row {
                let (rect, _) = ui.allocate_exact_size(vec2(*width, 16.0), Sense::hover());
                let line = rect.left_center();
                swatch(ui.painter(), line, SWATCH, curve.dash, colour(curve.colour));
                let at = line + vec2(SWATCH + BEFORE_NAME, -name.size().y / 2.0);
                ui.painter().galley(at, name.clone(), ink(ui).text);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names along an axis over this range, with where they stand.
    fn named(marks: Marks, low: f64, high: f64) -> Vec<(f64, String)> {
        let lines = marks.lines(GridInput { bounds: (low, high), base_step_size: 0.1 });
        assert!(lines.iter().all(|line| (low..=high).contains(&line.value)), "{lines:?}");
        let label = |mark: GridMark| (mark.value, marks.label(mark, &(low..=high)));
        lines.into_iter().map(label).filter(|(_, name)| !name.is_empty()).collect()
    }

    fn names(marks: Marks, low: f64, high: f64) -> Vec<String> {
        named(marks, low, high).into_iter().map(|(_, name)| name).collect()
    }

    #[test]
    fn powers_of_ten_are_named_where_they_lie_and_every_few_where_they_crowd() {
        assert_eq!(names(Marks::Decades, -2.3, 2.1), ["10⁻²", "10⁻¹", "1", "10", "10²"]);
        assert_eq!(names(Marks::Decades, -13.9, 0.2), ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "1"]);
        for (place, name) in named(Marks::Decades, -2.3, 2.1) {
            let value: f64 = match &*name {
                "10⁻²" => 0.01,
                "10⁻¹" => 0.1,
                "10²" => 100.0,
                plain => plain.parse().unwrap(),
            };
            assert!((Marks::Decades.place(value) - place).abs() < 1e-12, "{name} at {place}");
        }
        let lines = Marks::Decades.lines(GridInput { bounds: (0.0, 1.0), base_step_size: 0.1 });
        assert_eq!(lines.len(), 10);
        assert!((lines[1].value - Marks::Decades.place(2.0)).abs() < 1e-12);
    }

    #[test]
    fn multiples_of_a_step_are_named_as_they_are() {
        assert_eq!(names(Marks::Every(0.5), -0.6, 1.1), ["−0.5", "0", "0.5", "1"]);
        assert_eq!(Marks::Every(0.5).place(3.0), 3.0);
    }

    #[test]
    fn charts_fill_their_rows_and_the_last_one_what_is_left() {
        let chart = Chart {
            title: String::new(),
            legend: Legend::Own,
            axes: ["x", "y"].map(|name| Axis { name, view: [1.0, 2.0], marks: Marks::Decades }),
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
