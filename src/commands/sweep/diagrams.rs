//! The picture of a sweep, which has a work-precision diagram for each scene (Hairer, Nørsett & Wanner, *Solving
//! Ordinary Differential Equations I*, II.10). On request it adds the round-off of f32 and f64 on the chapter's ship.

use std::collections::BTreeMap;

use super::grid::{Row, Swept};
use super::round_off::{ErrorCurve, Width};
use crate::commands::drawing::columns;
use crate::look::palette::Theme;
use crate::sim::integrators::Method;
use crate::sim::number::round;
use crate::view::{Axis, AxisScale, Chart, Figure, FigureCurve, Legend};

/// Maximum error in the charts, in amplitudes. If the error is larger, the method has failed.
const LOST: f64 = 10.0;

/// Returns the picture of these rows, with the round-off curves if there are any.
pub(super) fn figure(swept: &Swept, rows: &[Row], rounded: Vec<ErrorCurve>) -> Figure {
    let work = swept.scenes.iter().map(|(name, scene)| {
        let curves = swept.methods.iter().map(|method| {
            let rows = rows.iter().filter(|row| row.scene == *name && row.method == *method);
            work_curve(method, rows)
        });
        work_precision(&scene.title, curves.collect())
    });
    let note = note(&rounded);
    let (title, rounded) = match rounded.is_empty() {
        true => ("Work and precision: what accuracy costs", None),
        false => (
            "Work and precision: what accuracy costs, and where rounding ends it",
            Some(v_curves(rounded)),
        ),
    };
    let charts: Vec<Chart> = work.chain(rounded).collect();
    Figure { title: title.into(), note, columns: columns(charts.len()), charts }
}

/// Returns the curve of a method's error against its evaluations, with a point for each tick rate. The largest error
/// counts if there are several bodies, as in advice.
fn work_curve<'a>(method: &Method, rows: impl Iterator<Item = &'a Row>) -> FigureCurve {
    let mut by_rate = BTreeMap::new();
    for row in rows {
        let [work, error] = by_rate.entry(row.tick_hz).or_insert([0.0, 0.0_f64]);
        *work += row.evaluations_per_s();
        *error = error.max(row.verdict.error().unwrap_or(f64::INFINITY));
    }
    let (colour, dash) = Theme::Dark.style(method);
    let points = by_rate.into_values().filter(|point| point[1].is_finite()).collect();
    FigureCurve { name: method.name.into(), colour, dash, dots: 2.2, points }
}

fn work_precision(title: &str, curves: Vec<FigureCurve>) -> Chart {
    let [work, error] = [0, 1].map(|axis| view(&curves, axis));
    Chart {
        title: title.into(),
        legend: Legend::Shared,
        axes: [
            Axis { name: "evaluations per simulated second", view: work, scale: AxisScale::Log },
            Axis {
                name: "error (amplitudes)",
                view: [error[0].min(LOST / 100.0), error[1].min(LOST)],
                scale: AxisScale::Log,
            },
        ],
        curves,
    }
}

/// Returns the chart of the error of the ship's speed against the step, in numbers of both widths.
fn v_curves(rounded: Vec<ErrorCurve>) -> Chart {
    let curve = |curve: ErrorCurve| {
        let (colour, _) = Theme::Dark.style(curve.method);
        let (dash, dots) = match curve.width {
            Width::Single => ([6.0, 4.0], 2.6),
            Width::Double => ([1.0, 0.0], 0.0),
        };
        let points = curve.errors.iter().map(|error| [error.h_s, error.error_m_per_s]).collect();
        let name = format!("{}, {}", curve.method.name, curve.width.text());
        FigureCurve { name, colour, dash, dots, points }
    };
    let curves: Vec<FigureCurve> = rounded.into_iter().map(curve).collect();
    let [step, error] = [0, 1].map(|axis| view(&curves, axis));
    Chart {
        title: "The chapter's ship in f32 and f64: truncation to the right, round-off to the left"
            .into(),
        legend: Legend::Own,
        axes: [
            Axis { name: "step h (s)", view: step, scale: AxisScale::Log },
            Axis { name: "error of the speed (m/s)", view: error, scale: AxisScale::Log },
        ],
        curves,
    }
}

/// Returns the range of the positive values, with a margin. It covers at least one power of ten, so that the axis has a
/// mark.
fn view(curves: &[FigureCurve], axis: usize) -> [f64; 2] {
    const ROOM: f64 = 1.6;
    let points = curves.iter().flat_map(|curve| &curve.points);
    let values = points.map(|point| point[axis]).filter(|&value| value > 0.0);
    let range = values.fold(None, |range: Option<[f64; 2]>, value| {
        let [least, greatest] = range.unwrap_or([value; 2]);
        Some([least.min(value), greatest.max(value)])
    });
    let [least, greatest] = range.unwrap_or([1.0; 2]);
    let more = (10.0 / (greatest / least)).max(1.0).sqrt();
    [least / (ROOM * more), greatest * ROOM * more]
}

fn note(rounded: &[ErrorCurve]) -> String {
    let best = rounded.iter().filter(|curve| curve.width == Width::Single).map(|curve| {
        let best = curve.best();
        format!(
            "{} s under {}, {} m/s",
            round(best.h_s, 2),
            curve.method.name,
            round(best.error_m_per_s, 2)
        )
    });
    let rounded = match best.collect::<Vec<_>>().join(", nor than ") {
        none if none.is_empty() => none,
        best => format!(
            " On the ship: the largest error of the speed at 2, 4, 6 and 8 s. In f32 no step is better than {best}: finer \
             ones only add roundings."
        ),
    };
    format!(
        "Error: the largest of a coordinate or a velocity of the worst body, as a fraction of its amplitude. A point \
         for each tick rate; none if a method is lost.{rounded}"
    )
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use super::super::grid::Grid;
    use super::super::round_off::error_curves;
    use super::*;
    use crate::scene::Scene;
    use crate::sim::integrators::method;

    fn swept(scene: &str, id: &str, rates: &[u32]) -> (Swept, Vec<Row>) {
        let scenes = vec![(scene.to_owned(), Scene::built_in(scene).unwrap())];
        let methods = vec![method(id).unwrap()];
        let swept = Swept {
            scenes,
            methods,
            rates: rates.iter().map(|&hz| hz.into()).collect(),
            seconds: None,
            varied: None,
        };
        let rows = Grid::new(&swept).run(Some(1), &AtomicBool::new(false)).unwrap();
        (swept, rows)
    }

    #[test]
    fn the_worst_body_sets_the_error_and_every_body_the_cost() {
        let (swept, rows) = swept("harbour", "rk4", &[30, 60]);
        let figure = figure(&swept, &rows, Vec::new());
        assert_eq!(figure.charts.len(), 1);
        let [[work, error], [work_twice, _]] = figure.charts[0].curves[0].points[..] else {
            panic!("{figure:?}")
        };
        assert_eq!((work, work_twice), (2.0 * 4.0 * 30.0, 2.0 * 4.0 * 60.0));
        let bodies = rows.iter().filter(|row| row.tick_hz == 30);
        let errors: Vec<f64> = bodies.map(|row| row.verdict.error().unwrap()).collect();
        assert_eq!(errors.len(), 2);
        assert!(errors.contains(&error) && errors.iter().all(|other| *other <= error));
    }

    #[test]
    fn a_lost_method_has_no_point_and_every_axis_a_mark() {
        let (swept, rows) = swept("stiff", "semi-implicit-euler", &[49, 60]);
        let rounded = error_curves(&[method("rk4").unwrap()]);
        assert_eq!(rounded.len(), 2);
        let figure = figure(&swept, &rows, rounded);
        let [work, rounded] = &figure.charts[..] else { panic!("{figure:?}") };
        assert_eq!(work.curves[0].points.len(), 1);
        for axis in work.axes.iter().chain(&rounded.axes) {
            let [low, high] = axis.view;
            assert!(low > 0.0 && low.is_finite() && high >= 10.0 * low, "{axis:?}");
        }
    }

    #[test]
    fn charts_form_a_nearly_square_grid() {
        for (charts, wide) in [(1, 1), (2, 2), (4, 2), (6, 2), (7, 3), (10, 3), (12, 3), (13, 4)] {
            assert_eq!(columns(charts), wide, "{charts} charts");
        }
    }
}
