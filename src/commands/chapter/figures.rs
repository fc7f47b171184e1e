//! Figures 7-2 to 7-8 as curves, and their data as tables.

use std::io;

use super::{Moment, by_method, exactly, method_of, scene};
use crate::commands::output::table::{RowFormat, RowWriter};
use crate::look::palette::Theme;
use crate::run::past::Quantity;
use crate::scene::Scene;
use crate::studio::{BOOK_FIGURES, BookFigure};
use crate::view::{Axis, AxisScale, Chart, Figure, FigureCurve, Legend};

pub(super) struct Diagram {
    /// Number of the figure in the book.
    pub(super) number: &'static str,
    pub(super) figure: Figure,
}

/// Returns all figures in their order.
pub(super) fn all() -> Vec<Diagram> {
    BOOK_FIGURES.iter().map(diagram).collect()
}

fn diagram(of: &BookFigure) -> Diagram {
    let scene = scene(of.scene);
    let (note, name, of_moment): (_, _, fn(&Moment) -> f64) = match of.quantity {
        Quantity::Velocity => (ship_note(&scene), "speed (m/s)", |m| m.v),
        Quantity::Position => (spring_note(&scene), "displacement (m)", |m| m.q),
    };
    let point = |m: &Moment| [m.t, of_moment(m)];
    let exact = exactly(&scene, of.seconds, SMOOTH_HZ).iter().map(point).collect();
    // A short run of the ship has a dot at every step.
    let has_dots = of.quantity == Quantity::Velocity && of.seconds <= 20.0;
    let dots = if has_dots { 2.6 } else { 0.0 };
    let stepped =
        of.methods.iter().map(|id| stepped(id, dots, &by_method(&scene, id, of.seconds), point));
    let curves = std::iter::once(truth(exact)).chain(stepped).collect();
    let title = format!("Figure {}: {}", of.number, of.title);
    let figure = figure(&title, note, ["time (s)", name], of.view, curves);
    Diagram { number: of.number, figure }
}

fn figure(
    title: &str,
    note: String,
    names: [&'static str; 2],
    view: [[f64; 2]; 2],
    curves: Vec<FigureCurve>,
) -> Figure {
    let axis = |n: usize| Axis { name: names[n], view: view[n], scale: AxisScale::Linear };
    let axes = [axis(0), axis(1)];
    let chart = Chart { title: String::new(), legend: Legend::Shared, axes, curves };
    Figure { title: title.into(), note, columns: 1, charts: vec![chart] }
}

/// The first columns in the header of every table.
pub(super) const CSV_BEGINS: &str = "curve,time_s,";

/// Returns the points of all curves as one tidy table. Its columns are `curve` and the axes.
pub(super) fn csv(figure: &Figure) -> io::Result<Vec<u8>> {
    let chart = &figure.charts[0];
    let name = |axis: &Axis| axis.name.replace(['(', ')'], "").replace('/', " per ");
    let [x, y] = [0, 1].map(|n| name(&chart.axes[n]).replace(' ', "_"));
    let mut rows = RowWriter::begin(Vec::new(), RowFormat::Csv, ["curve".to_owned(), x, y])?;
    for curve in &chart.curves {
        for &[x, y] in &curve.points {
            rows.row(&[curve.name.as_str().into(), x.into(), y.into()])?;
        }
    }
    rows.end()
}

/// Points per second of an exact curve. They are more than the eye resolves.
const SMOOTH_HZ: u32 = 100;

fn truth(points: Vec<[f64; 2]>) -> FigureCurve {
    let dash = [1.0, 0.0];
    FigureCurve {
        name: "exact".into(),
        colour: Theme::Dark.palette().exact,
        dash,
        dots: 0.0,
        points,
    }
}

fn stepped(
    id: &str,
    dots: f32,
    moments: &[Moment],
    point: impl Fn(&Moment) -> [f64; 2],
) -> FigureCurve {
    let method = method_of(id);
    let (colour, dash) = Theme::Dark.style(method);
    let points = moments.iter().map(point).collect();
    FigureCurve { name: method.name.into(), colour, dash, dots, points }
}

fn ship_note(scene: &Scene) -> String {
    format!(
        "The chapter's ship from rest: {}. Step {} s.",
        parameters(scene),
        scene.tick_hz.step_s(),
    )
}

fn spring_note(scene: &Scene) -> String {
    format!(
        "The chapter prints no parameters for its spring; these are ours: {}. Step 1/{} s.",
        parameters(scene),
        scene.tick_hz,
    )
}

/// Describes the parameters of the first body, as its scene gives them.
fn parameters(scene: &Scene) -> String {
    let body = &scene.bodies[0];
    let shown = body.kind.parameters.iter().zip(&body.values).filter_map(|(parameter, value)| {
        let (symbol, unit) = (parameter.symbol?, &parameter.unit);
        Some(format!("{symbol} = {} {unit}", crate::sim::number::round(*value, 5)))
    });
    shown.collect::<Vec<_>>().join(", ")
}
