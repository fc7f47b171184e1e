//! The picture of `regatta loop`: the moment shown against the moment of display, and what each policy costs.

use super::measured::Measured;
use crate::lab::Scene;
use crate::lab::number::round;
use crate::lab::palette::Theme;
use crate::view::{Axis, Chart, Figure, FigureCurve, Legend, Marks};

/// The charts of the picture.
pub(super) const CHARTS: usize = 2;

/// An animation error that is drawn at the bottom: no display shows it.
const LEAST_MS: f64 = 1e-3;
/// A loop that is further behind or ahead, because it does not keep time, is outside of the chart.
const LARGEST_LATENCY_MS: f64 = 200.0;

/// The picture of the rows of the first trace.
pub(super) fn figure(scene: &Scene, rows: &[Measured]) -> Figure {
    let trace = rows.first().map_or("", |row| &row.trace);
    let rows: Vec<&Measured> = rows.iter().filter(|row| row.trace == trace).collect();
    let title =
        format!("{trace}, {} Hz ticks: what each loop shows, and what it costs", scene.tick_hz);
    Figure { title, note: note(&rows), columns: CHARTS, charts: vec![shown(&rows), costs(&rows)] }
}

fn curve(place: usize, row: &Measured, dots: f32, points: Vec<[f64; 2]>) -> FigureCurve {
    let (colour, dash) = Theme::Dark.loop_style(place);
    FigureCurve { name: row.card.id.into(), colour, dash, dots, points }
}

/// The moment shown against the moment of display, as the display holds each picture until the next.
fn shown(rows: &[&Measured]) -> Chart {
    let ends = rows.iter().filter_map(|row| row.first.last()).map(|last| last[0]);
    let end = ends.fold(1.0, f64::max);
    let steps = |row: &Measured| -> Vec<[f64; 2]> {
        let pairs = row.first.windows(2);
        let held = pairs.flat_map(|pair| [pair[0], [pair[1][0], pair[0][1]]]);
        held.chain(row.first.last().copied()).collect()
    };
    let ideal = FigureCurve {
        name: "the moment of display".into(),
        colour: Theme::Dark.palette().text,
        dash: [1.0, 0.0],
        dots: 0.0,
        points: vec![[0.0, 0.0], [end, end]],
    };
    let curves = rows.iter().enumerate().map(|(n, row)| curve(n, row, 0.0, steps(row)));
    let least = rows.iter().flat_map(|row| &row.first).map(|point| point[1]).fold(0.0, f64::min);
    let mark = 10.0_f64.powf((end / 4.0).log10().floor());
    let mark =
        [5.0, 2.0, 1.0].map(|times| times * mark).into_iter().find(|mark| *mark <= end / 4.0);
    let mark = mark.unwrap_or(end);
    Chart {
        title: "Moment shown against moment of display".into(),
        legend: Legend::Shared,
        axes: [
            Axis { name: "moment of display (ms)", view: [0.0, end], marks: Marks::Every(mark) },
            Axis { name: "moment shown (ms)", view: [least, end], marks: Marks::Every(mark) },
        ],
        curves: [ideal].into_iter().chain(curves).collect(),
    }
}

/// The animation error against the latency: the best loop is at the lower left.
fn costs(rows: &[&Measured]) -> Chart {
    let points = rows.iter().enumerate().map(|(n, row)| {
        let point = point(row);
        curve(n, row, 5.0, point.into_iter().collect())
    });
    let known: Vec<[f64; 2]> = rows.iter().filter_map(|row| point(row)).collect();
    let latencies = known.iter().map(|point| point[0]).filter(|ms| ms.abs() <= LARGEST_LATENCY_MS);
    let (least, most) =
        latencies.fold((0.0, 10.0), |(least, most): (f64, f64), ms| (least.min(ms), most.max(ms)));
    let worst = known.iter().map(|point| point[1]).fold(LEAST_MS, f64::max);
    Chart {
        title: "Animation error against latency: lower left is better".into(),
        legend: Legend::Shared,
        axes: [
            Axis {
                name: "mean latency (ms)",
                view: [1.1 * least - 1.0, 1.1 * most],
                marks: Marks::Every(if most - least > 50.0 { 50.0 } else { 10.0 }),
            },
            Axis {
                name: "animation error, RMS (ms)",
                view: [LEAST_MS / 2.0, 10.0 * worst],
                marks: Marks::Decades,
            },
        ],
        curves: points.collect(),
    }
}

fn point(row: &Measured) -> Option<[f64; 2]> {
    let report = &row.report;
    Some([report.latency_mean_ms?, report.animation_error_rms_ms?.max(LEAST_MS)])
}

/// The ranking.
fn note(rows: &[&Measured]) -> String {
    let mut ranked: Vec<(&str, f64)> = rows
        .iter()
        .filter_map(|row| Some((row.card.id, row.report.animation_error_rms_ms?)))
        .collect();
    ranked.sort_by(|(_, one), (_, other)| one.total_cmp(other));
    let listed = ranked.iter().map(|(id, error)| format!("{id} {}", round(*error, 3)));
    let outside = rows.iter().filter_map(|row| {
        let latency = row.report.latency_mean_ms.filter(|ms| ms.abs() > LARGEST_LATENCY_MS)?;
        Some(format!("{} {} ms", row.card.id, round(latency, 3)))
    });
    let outside = outside.collect::<Vec<_>>().join(", ");
    let outside = match outside.as_str() {
        "" => String::new(),
        listed => format!(" Later than the chart shows: {listed}."),
    };
    format!(
        "Animation error is the change of the moment shown minus the change of the moment of display, from frame to \
         frame. RMS in ms, from the least: {}.{outside}",
        listed.collect::<Vec<_>>().join(", ")
    )
}
