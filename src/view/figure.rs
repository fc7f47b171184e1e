//! A diagram that fills a picture: title, legend, axes with units, curves, and a note below.

use std::ops::RangeInclusive;

use egui::{Align2, FontId, Frame, Margin, RichText, Sense, Ui, vec2};
use egui_plot::{GridInput, GridMark, PlotBounds};

use super::panels::{BACKDROP, QUIET, TEXT};
use super::plot::{CURVE, Curve, colour, draw, plot, swatch, tick_text};
use crate::lab::picture::Rgba;

/// A diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// What has to be known to make it again.
    pub note: String,
    /// What the axes measure, with units.
    pub axes: [&'static str; 2],
    /// The least and the greatest value in view, along each axis.
    pub view: [[f64; 2]; 2],
    /// The distance of marks along each axis.
    pub steps: [f64; 2],
    /// The first is drawn at the bottom.
    pub curves: Vec<FigureCurve>,
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

/// Room for the note, in points.
const NOTE: f32 = 34.0;

/// Shows the figure in all of `ui`.
pub(super) fn show(ui: &mut Ui, figure: &Figure) {
    let frame = Frame::new().fill(BACKDROP).inner_margin(Margin {
        left: 12,
        right: 26,
        top: 18,
        bottom: 8,
    });
    egui::CentralPanel::default_margins().frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.add_space(58.0);
            ui.label(RichText::new(&figure.title).size(17.0).color(TEXT));
        });
        ui.add_space(4.0);
        legend(ui, &figure.curves);
        ui.add_space(8.0);
        let curves: Vec<Curve> = figure.curves.iter().map(curve).collect();
        let [x, y] = figure.view;
        let bounds = PlotBounds::from_min_max([x[0], y[0]], [x[1], y[1]]);
        let height = (ui.available_height() - NOTE).max(10.0);
        let axes = plot("figure", height)
            .x_axis_label(figure.axes[0])
            .y_axis_label(figure.axes[1])
            .x_axis_formatter(label(figure.steps[0]))
            .y_axis_formatter(label(figure.steps[1]))
            .x_grid_spacer(marks(figure.steps[0]))
            .y_grid_spacer(marks(figure.steps[1]));
        draw(ui, axes, bounds, &curves);
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            ui.add_space(58.0);
            ui.label(RichText::new(&figure.note).color(QUIET));
        });
    });
}

/// Marks at the multiples of `step`, and faint lines five times as close.
fn marks(step: f64) -> impl Fn(GridInput) -> Vec<GridMark> {
    const FINER: i64 = 5;
    move |input| {
        let fine = step / FINER as f64;
        let (low, high) = input.bounds;
        let mark = |i: i64| {
            let step_size = if i % FINER == 0 { step } else { fine };
            GridMark { value: i as f64 * fine, step_size }
        };
        ((low / fine).ceil() as i64..=(high / fine).floor() as i64).map(mark).collect()
    }
}

/// What stands at the multiples of `step`, and nothing at the faint lines between.
fn label(step: f64) -> impl Fn(GridMark, &RangeInclusive<f64>) -> String {
    move |mark, _| if mark.step_size < step { String::new() } else { tick_text(mark.value) }
}

fn curve(curve: &FigureCurve) -> Curve {
    let points = curve.points.iter().filter(|[x, y]| x.is_finite() && y.is_finite());
    Curve {
        colour: colour(curve.colour),
        width: CURVE,
        dash: curve.dash,
        dots: curve.dots,
        points: points.copied().collect(),
    }
}

/// Each curve's name after a piece of its line.
fn legend(ui: &mut Ui, curves: &[FigureCurve]) {
    ui.horizontal_wrapped(|ui| {
        ui.add_space(58.0);
        for curve in curves {
            let (rect, _) = ui.allocate_exact_size(vec2(34.0, 16.0), Sense::hover());
            swatch(ui.painter(), rect.left_center(), 34.0, curve.dash, colour(curve.colour));
            let font = FontId::proportional(13.0);
            let name = ui.painter().layout_no_wrap(curve.name.clone(), font, TEXT);
            let (rect, _) = ui.allocate_exact_size(name.size() + vec2(14.0, 0.0), Sense::hover());
            let at = Align2::LEFT_CENTER.anchor_size(rect.left_center(), name.size()).min;
            ui.painter().galley(at, name, TEXT);
        }
    });
}
