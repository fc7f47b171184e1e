//! The picture of `regatta loop`: the displayed moment against the moment of display, and the cost of each policy.

use super::measured::Measured;
use crate::look::palette::Theme;
use crate::scene::Scene;
use crate::sim::number::round;
use crate::view::{Axis, AxisScale, Chart, Figure, FigureCurve, Legend, span};

/// Number of charts of a trace.
const CHARTS: usize = 3;
/// Maximum number of traces in a picture.
const MAX_TRACES: usize = 4;

/// Minimum animation error (ms) that is drawn. No display shows a smaller one.
const MIN_MS: f64 = 1e-3;
/// Radius of a dot, and the amount by which it grows for each dot that is drawn over it, in points.
const DOT: f32 = 4.0;
const RING: f32 = 3.0;
const EXPLAINED: &str = "Animation error is the change of the moment shown minus the change of the moment of display, \
                         from frame to frame";
/// Maximum latency (ms) in the chart. A loop that is further behind or ahead does not keep time.
const MAX_LATENCY_MS: f64 = 200.0;

/// Returns the number of wide charts whose room the picture takes.
pub(super) fn room(traces: usize) -> usize {
    2 * traces.min(MAX_TRACES)
}

/// Returns the picture of `rows`, which are grouped by trace. Each of the first traces has a row of charts.
pub(super) fn figure(scene: &Scene, rows: &[Measured]) -> Figure {
    let mut by_trace: Vec<&[Measured]> =
        rows.chunk_by(|one, other| one.trace == other.trace).collect();
    let left_out = by_trace.len().saturating_sub(MAX_TRACES);
    by_trace.truncate(MAX_TRACES);
    let what = format!("{:.3} Hz ticks: each loop's motion and cost", scene.tick_hz);
    let (title, note) = match by_trace[..] {
        [rows] => (format!("{}, {what}", rows[0].trace), note(rows)),
        _ => (what, note_on_several(&by_trace, left_out)),
    };
    let several = by_trace.len() > 1;
    let charts = by_trace.iter().flat_map(|rows| {
        let before = if several { format!("{}: ", rows[0].trace) } else { String::new() };
        [chart_of_moments(rows, &before), costs(rows, &before), game_time(rows, &before)]
    });
    Figure { title, note, columns: CHARTS, charts: charts.collect() }
}

fn curve(index: usize, row: &Measured, dots: f32, points: Vec<[f64; 2]>) -> FigureCurve {
    let (colour, dash) = Theme::Dark.loop_style(index);
    FigureCurve { name: row.card.id.clone(), colour, dash, dots, points }
}

/// Returns the chart of the displayed moment against the moment of display. The display holds each picture until the
/// next.
fn chart_of_moments(rows: &[Measured], before: &str) -> Chart {
    let [start, end] = span(rows.iter().flat_map(|row| &row.drawn), 0);
    let steps = |row: &Measured| -> Vec<[f64; 2]> {
        let pairs = row.drawn.windows(2);
        let held = pairs.flat_map(|pair| [pair[0], [pair[1][0], pair[0][1]]]);
        held.chain(row.drawn.last().copied()).collect()
    };
    let curves = rows.iter().enumerate().map(|(n, row)| curve(n, row, 0.0, steps(row)));
    let near = start - (end - start);
    let shown = rows.iter().flat_map(|row| &row.drawn).map(|point| point[1]);
    let least = shown.filter(|shown| *shown >= near).fold(start, f64::min);
    Chart {
        title: sentence(before, "moment shown against moment of display"),
        legend: Legend::Shared,
        axes: [
            Axis { name: "moment of display (ms)", view: [start, end], scale: AxisScale::Linear },
            Axis { name: "moment shown (ms)", view: [least, end], scale: AxisScale::Linear },
        ],
        curves: [FigureCurve::real_time(Theme::Dark, [start, end])]
            .into_iter()
            .chain(curves)
            .collect(),
    }
}

fn game_time(rows: &[Measured], before: &str) -> Chart {
    let points =
        |row: &Measured| row.game_time.as_ref().map_or(Vec::new(), |it| it.points().into());
    let curves = rows.iter().enumerate().map(|(n, row)| curve(n, row, 0.0, points(row)));
    let title = sentence(before, "game time over real time");
    Chart::of_game_time(title, Theme::Dark, curves.collect())
}

/// Returns the chart of the animation error against the latency. The best loop is at the lower left.
fn costs(rows: &[Measured], before: &str) -> Chart {
    let known: Vec<[f64; 2]> = rows.iter().filter_map(point).collect();
    let points = rows.iter().enumerate().map(|(n, row)| {
        let later = rows[n + 1..].iter().filter_map(point);
        let over = point(row).map_or(0, |here| later.filter(|there| is_near(here, *there)).count());
        let radius = DOT + RING * over as f32;
        curve(n, row, radius, point(row).into_iter().collect())
    });
    let latencies = known.iter().map(|point| point[0]).filter(|ms| ms.abs() <= MAX_LATENCY_MS);
    let (least, most) =
        latencies.fold((0.0, 10.0), |(least, most): (f64, f64), ms| (least.min(ms), most.max(ms)));
    let worst = known.iter().map(|point| point[1]).fold(MIN_MS, f64::max);
    Chart {
        title: sentence(before, "animation error against latency, lower left is better"),
        legend: Legend::Shared,
        axes: [
            Axis {
                name: "mean latency (ms)",
                view: [1.1 * least - 1.0, 1.1 * most],
                scale: AxisScale::Linear,
            },
            Axis {
                name: "animation error, RMS (ms)",
                view: [MIN_MS / 2.0, 10.0 * worst],
                scale: AxisScale::Log,
            },
        ],
        curves: points.collect(),
    }
}

/// Whether two points of the chart look like one.
fn is_near([x, y]: [f64; 2], [other_x, other_y]: [f64; 2]) -> bool {
    (x - other_x).abs() < 0.5 && (y / other_y - 1.0).abs() < 0.1
}

fn point(row: &Measured) -> Option<[f64; 2]> {
    let report = &row.report;
    Some([report.latency_mean_ms()?, report.animation_error_rms_ms?.max(MIN_MS)])
}

/// Returns a title with its prefix, or the capitalised title if there is no prefix.
fn sentence(before: &str, title: &str) -> String {
    match before {
        "" => title[..1].to_uppercase() + &title[1..],
        before => format!("{before}{title}"),
    }
}

/// Returns a note that names the loop with the least error on each trace.
fn note_on_several(by_trace: &[&[Measured]], left_out: usize) -> String {
    let error = |row: &Measured| row.report.animation_error_rms_ms.unwrap_or(f64::INFINITY);
    let least = by_trace.iter().filter_map(|rows| {
        let best = rows
            .iter()
            .filter(|row| beyond_chart(row).is_none())
            .min_by(|one, other| error(one).total_cmp(&error(other)))?;
        Some(format!("{}: {} {}", best.trace, best.card.id, round(error(best), 3)))
    });
    let least = least.collect::<Vec<_>>().join("; ");
    let left_out = match left_out {
        0 => String::new(),
        1 => " One more trace is in the table only.".into(),
        more => format!(" {more} more traces are in the table only."),
    };
    let outside = outside(by_trace.iter().copied().flatten());
    format!(
        "{EXPLAINED}. The least RMS in ms on each trace, of the loops in its chart: {least}.{outside}{left_out}"
    )
}

/// Explains why the charts do not show a loop, which is because of its speed or its mean latency.
fn beyond_chart(row: &Measured) -> Option<String> {
    if row.report.keeps_speed() == Some(false) {
        return Some("another speed at another frame rate".into());
    }
    let latency_ms = row.report.latency_mean_ms().filter(|ms| ms.abs() > MAX_LATENCY_MS)?;
    Some(format!("a latency of {} ms", round(latency_ms, 3)))
}

/// Lists the loops that are missing from the charts.
fn outside<'r>(rows: impl Iterator<Item = &'r Measured>) -> String {
    let late = rows.filter_map(|row| Some(format!("{}, {}", row.card.id, beyond_chart(row)?)));
    match late.collect::<Vec<_>>().join("; ").as_str() {
        "" => String::new(),
        listed => format!(" Not in the charts: {listed}."),
    }
}

/// Returns a note that ranks the loops by animation error.
fn note(rows: &[Measured]) -> String {
    let mut ranked: Vec<(&str, f64)> = rows
        .iter()
        .filter_map(|row| Some((&*row.card.id, row.report.animation_error_rms_ms?)))
        .collect();
    ranked.sort_by(|(_, one), (_, other)| one.total_cmp(other));
    let listed = ranked.iter().map(|(id, error)| format!("{id} {}", round(*error, 3)));
    let outside = outside(rows.iter());
    let listed = listed.collect::<Vec<_>>().join(", ");
    format!("{EXPLAINED}. RMS in ms, from the least: {listed}.{outside}")
}
