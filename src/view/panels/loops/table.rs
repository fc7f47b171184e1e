//! The table of loops: key, line, name and verdict, then numbers. A click selects a loop, and a click on its eye
//! takes the loop off the stage or brings it on.

use egui::Ui;

use super::row::Row;
use crate::loops::PACING_METRICS;
use crate::loops::loop_lab::LoopLab;
use crate::panels::lanes::{ROW, height_of};
use crate::panels::table::{Column, SortKey, Table, TableRow, show_words};
use crate::run::Unit;
use crate::stage::number::round;
use crate::studio::Command;
use crate::theme::TYPE;

/// Maximum number of rows in sight, because the stage and the instrument need the room. The list scrolls to further
/// rows.
const MAX_ROWS: usize = 6;

pub(in crate::panels) fn height(loops: &LoopLab) -> f32 {
    height_of(loops.lanes().len().min(MAX_ROWS))
}

pub(in crate::panels) fn show(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    table(loops).show(ui, groups(loops), commands, |_, _, _| {});
}

fn table(loops: &LoopLab) -> Table<Row<'_>> {
    let (columns, min_rest) = (columns(loops), |_| MIN_VERDICT);
    Table { id: "loops", columns, min_rest, row_height: ROW, head_type: TYPE }
}

fn groups(loops: &LoopLab) -> Vec<Vec<Row<'_>>> {
    loops.listed().into_iter().map(|index| vec![Row { loops, index }]).collect()
}

/// The minimum width of the verdict, in points.
const MIN_VERDICT: f32 = 264.0;

/// A column of numbers: its name, width in points, priority, metric's id, and the format of its values.
type MetricColumn = (&'static str, f32, u8, &'static str, fn(f64, Unit) -> String);

const METRICS: [MetricColumn; 8] = [
    ("repeated", 66.0, 2, "repeated_percent", metric_text),
    ("double", 56.0, 4, "double_percent", metric_text),
    ("error RMS", 76.0, 1, "animation_error_rms_ms", metric_text),
    ("largest", 70.0, 5, "animation_error_max_ms", metric_text),
    ("latency", 70.0, 3, "latency_mean_ms", latency),
    ("dropped", 70.0, 7, "dropped_ms", metric_text),
    ("position", 72.0, 8, "position_error_rms", metric_text),
    ("at ½ rate", 72.0, 6, "state_difference", metric_text),
];

/// Returns every column, from left to right.
fn columns<'a>(loops: &LoopLab) -> Vec<Column<Row<'a>>> {
    let index = |row: &Row<'a>| Some(row.index);
    let key = Column::key("the key that selects this loop and brings it on the stage", index);
    let on_stage = Column::shown(
        "on the stage",
        22.0,
        "the loops on the stage; click an eye to bring one on or take it off",
        |ui, row: &Row<'a>, rect, commands| row.eye(ui, rect, commands),
        |row| SortKey::Number(if row.is_on_stage() { 0.0 } else { 1.0 }),
    );
    let about = "the line of this loop in the plots and on the stage";
    let line = Column::line(about, index);
    let name = Column::shown(
        "Loop",
        136.0,
        "the rule of the loop, from the simplest on",
        |ui, row: &Row<'a>, rect, _| {
            show_words(ui, rect, row.name(), row.is_selected(), row.text(ui));
        },
        |row| SortKey::Number(row.index as f64),
    );
    let about = "the effect of this loop on motion at this tick rate on this display; sorts from best to worst";
    let display = loops.chosen_trace().name();
    let verdict = Column::verdict(about, Row::verdict_text);
    let head = format!("Verdict at {:.3} Hz, trace {display}", loops.scene().tick_hz);
    let marks = [key, on_stage.headed(""), line, name, verdict.headed(head)];
    marks.into_iter().chain(METRICS.into_iter().filter_map(metric)).collect()
}

/// Returns the column of a metric.
fn metric<'a>((name, width, priority, id, shown): MetricColumn) -> Option<Column<Row<'a>>> {
    let metric = PACING_METRICS.iter().find(|metric| metric.id == id)?;
    let value = |row: &Row<'a>| row.lane().report().and_then(metric.measure);
    let text = move |row: &Row<'a>| Some(shown(value(row)?, metric.unit));
    let is_of_amplitude = metric.unit == Unit::Amplitudes;
    let unit = if is_of_amplitude { ", in percent of the amplitude" } else { "" };
    let about = format!("{}: {}{unit}", metric.name, metric.about);
    let size = move |row: &Row<'a>| value(row).map(f64::abs);
    Some(Column::number(name, (width, priority), &about, text, size))
}

/// Milliseconds from this number on appear as seconds.
const MANY_MS: f64 = 10_000.0;
/// A share of the amplitude from this percentage on belongs to a motion that has blown up.
const LOST_PERCENT: f64 = 1e5;
/// Minimum mean latency that is shown. A smaller latency appears as 0, because the frames begin early and late by more
/// than that.
const MIN_LATENCY_MS: f64 = 0.1;
/// Minimum value that is shown. A smaller value appears as <0.001.
const MIN_SHOWN: f64 = 1e-3;
/// A value below this has three decimals instead of three digits.
const SMALL: f64 = 0.1;

/// Formats a mean latency in milliseconds.
fn latency(ms: f64, unit: Unit) -> String {
    match ms {
        ms if ms.abs() < MIN_LATENCY_MS => "0 ms".into(),
        // The lead has no fixed size, because it grows as long as the run continues.
        ahead if ahead < 0.0 => "ahead".into(),
        behind => metric_text(behind, unit),
    }
}

/// Formats the value of a metric.
pub(super) fn metric_text(value: f64, unit: Unit) -> String {
    let (value, unit) = match unit {
        Unit::Amplitudes => (100.0 * value, Unit::Percent),
        Unit::Milliseconds if value.abs() >= MANY_MS => (value / 1000.0, Unit::Seconds),
        unit => (value, unit),
    };
    let number = match value.abs() {
        lost if unit == Unit::Percent && lost >= LOST_PERCENT => return "lost".into(),
        0.0 => "0".into(),
        small if small < MIN_SHOWN => "<0.001".into(),
        small if small < SMALL => round(libm::round(value * 1000.0) / 1000.0, 3),
        _ => round(value, 3),
    };
    format!("{number} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::LoopCommand;
    use crate::scene::Scene;
    use crate::studio::{Studio, run_loops};

    #[test]
    fn rows_are_sorted_by_their_verdicts_and_back() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(Command::Loop(LoopCommand::ToggleLab));
        run_loops(&mut studio);
        let loops = studio.loop_lab().unwrap();
        let ranks = |order| -> Vec<Option<f64>> {
            let rows = table(loops).sorted(groups(loops), order).into_iter().flatten();
            rows.map(|row| row.verdict_text().rank).collect()
        };
        let [best_first, worst_first] =
            [false, true].map(|is_reversed| ranks(Some(("Verdict", is_reversed))));
        assert!(best_first.is_sorted() && worst_first.iter().rev().is_sorted());
        assert_eq!(best_first.len(), loops.lanes().len());
        assert_ne!(ranks(None), best_first);
    }

    const MS: Unit = Unit::Milliseconds;

    #[test]
    fn every_number_is_a_metric_of_the_table() {
        for column in METRICS {
            assert!(metric(column).is_some_and(|made| made.about.len() > 20), "{}", column.0);
        }
    }

    #[test]
    fn values_have_three_digits_and_zero_differs_from_almost_zero() {
        let texts = [(8.2247, MS), (0.0, MS), (1e-7, MS), (0.1234, Unit::Amplitudes)];
        let texts = texts.map(|(value, unit)| metric_text(value, unit));
        assert_eq!(texts, ["8.22 ms", "0 ms", "<0.001 ms", "12.3 %"]);
        let texts = [-290_000.0, -0.008_81, 3e-7, 0.3, 16.66, 14_000.0].map(|ms| latency(ms, MS));
        assert_eq!(texts, ["ahead", "0 ms", "0 ms", "0.3 ms", "16.7 ms", "14 s"]);
    }
}
