//! Figures 7-2 to 7-8 as curves, and their data as tables.

use std::io;

use super::{Moment, by_method, exactly, method_of, scene};
use crate::commands::output::table::{RowFormat, RowWriter};
use crate::look::palette::Theme;
use crate::scene::Scene;
use crate::view::{Axis, AxisScale, Chart, Figure, FigureCurve, Legend};

pub(super) struct Diagram {
    /// Number of the figure in the book.
    pub(super) number: &'static str,
    pub(super) figure: Figure,
}

/// Returns all figures in their order.
pub(super) fn all() -> Vec<Diagram> {
    let (ship, spring) = (scene("ship"), scene("spring"));
    let euler = |seconds| vec![exact(&ship, seconds), speed(&ship, "explicit-euler", seconds)];
    let all = |seconds| {
        let mut curves = vec![exact(&ship, seconds)];
        let ids = ["explicit-euler", "improved-euler", "rk4"];
        curves.extend(ids.map(|id| speed(&ship, id, seconds)));
        curves
    };
    let of_ship = |title: &str, view, curves| {
        figure(title, ship_note(&ship), ["time (s)", "speed (m/s)"], view, curves)
    };
    let of_spring = |title: &str, view, curves| {
        figure(title, spring_note(&spring), ["time (s)", "displacement (m)"], view, curves)
    };
    let swings = |seconds, ids: &[&str]| {
        let mut curves = vec![swing_exactly(&spring, seconds)];
        curves.extend(ids.iter().map(|id| swing(&spring, id, seconds)));
        curves
    };
    let zoom = [[6.46, 8.54], [9.4, 11.8]];
    let diagram = |number, figure| Diagram { number, figure };
    vec![
        diagram(
            "7-2",
            of_ship("Figure 7-2: speed by Euler's method", [[0.0, 10.2], [0.0, 14.4]], euler(10.0)),
        ),
        diagram("7-3", of_ship("Figure 7-3: the same, from 6.5 to 8.5 s", zoom, euler(8.5))),
        diagram(
            "7-4",
            of_ship("Figure 7-4: in time it converges", [[0.0, 61.0], [0.0, 22.0]], euler(60.0)),
        ),
        diagram(
            "7-5",
            of_spring(
                "Figure 7-5: a spring grows without end under explicit Euler",
                [[0.0, 6.1], [-8.4, 8.4]],
                swings(6.0, &["explicit-euler"]),
            ),
        ),
        diagram("7-6", of_ship("Figure 7-6: three methods", [[0.0, 10.2], [0.0, 14.4]], all(10.0))),
        diagram(
            "7-7",
            of_ship("Figure 7-7: only Euler's can be told from the exact curve", zoom, all(8.5)),
        ),
        diagram(
            "7-8",
            of_spring(
                "Figure 7-8: the same spring under improved Euler and Runge-Kutta",
                [[0.0, 6.1], [-1.6, 1.6]],
                swings(6.0, &["improved-euler", "rk4"]),
            ),
        ),
    ]
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

fn exact(ship: &Scene, seconds: f64) -> FigureCurve {
    truth(exactly(ship, seconds, SMOOTH_HZ).iter().map(|m| [m.t, m.v]).collect())
}

fn swing_exactly(spring: &Scene, seconds: f64) -> FigureCurve {
    truth(exactly(spring, seconds, SMOOTH_HZ).iter().map(|m| [m.t, m.q]).collect())
}

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

/// Returns the curve of the speed under this method. A run of at most 20 s has a dot at every step.
fn speed(ship: &Scene, id: &str, seconds: f64) -> FigureCurve {
    let dots = if seconds > 20.0 { 0.0 } else { 2.6 };
    stepped(id, dots, &by_method(ship, id, seconds), |m| [m.t, m.v])
}

fn swing(spring: &Scene, id: &str, seconds: f64) -> FigureCurve {
    stepped(id, 0.0, &by_method(spring, id, seconds), |m| [m.t, m.q])
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
