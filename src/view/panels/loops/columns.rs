//! The columns of the table of loops, and which of them fit a width.

use crate::lab::number::round;
use crate::lab::pacing::{PACING_METRICS, PacingMetric};
use crate::lab::{LoopLab, Severity};

/// What a cell shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    Key,
    Swatch,
    OnStage,
    Name,
    Verdict,
    /// The metric of this id, at the right.
    Metric(&'static str),
    /// How far the display is behind the moment shown, in the mean, at the right.
    Latency,
}

/// One column.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) head: &'static str,
    /// Its width in points; the verdict takes the rest.
    width: f32,
    /// The order in which columns are taken in while there is room, from 0; those with 0 are always there.
    turn: u8,
    pub(super) cell: Cell,
}

/// The room between two columns, and the least width of the verdict, in points.
const GAP: f32 = 8.0;
const MIN_VERDICT: f32 = 264.0;

const fn fixed(head: &'static str, width: f32, cell: Cell) -> Column {
    Column { head, width, turn: 0, cell }
}

const fn number(head: &'static str, width: f32, turn: u8, cell: Cell) -> Column {
    Column { head, width, turn, cell }
}

const fn metric(head: &'static str, width: f32, turn: u8, id: &'static str) -> Column {
    number(head, width, turn, Cell::Metric(id))
}

/// Every column, from left to right.
pub(super) static COLUMNS: &[Column] = &[
    fixed("Key", 26.0, Cell::Key),
    fixed("", 22.0, Cell::OnStage),
    fixed("", 36.0, Cell::Swatch),
    fixed("Loop", 136.0, Cell::Name),
    fixed("Verdict", 0.0, Cell::Verdict),
    metric("repeated", 66.0, 2, "repeated_percent"),
    metric("double", 56.0, 4, "double_percent"),
    metric("error RMS", 76.0, 1, "animation_error_rms_ms"),
    metric("largest", 70.0, 5, "animation_error_max_ms"),
    number("latency", 70.0, 3, Cell::Latency),
    metric("dropped", 70.0, 7, "dropped_ms"),
    metric("position", 72.0, 8, "position_error_rms"),
    metric("at ½ rate", 72.0, 6, "state_difference"),
];

impl Cell {
    /// The metric, if it shows one.
    pub(super) fn metric(self) -> Option<&'static PacingMetric> {
        let id = match self {
            Cell::Metric(id) => id,
            Cell::Latency => "latency_mean_ms",
            _ => return None,
        };
        PACING_METRICS.iter().find(|metric| metric.id == id)
    }

    /// The tooltip of its head.
    pub(super) fn about(self) -> String {
        let words = match self {
            Cell::Key => "the key that selects this loop and brings it on the stage",
            Cell::OnStage => "the loops on the stage; click an eye to bring one on or take it off",
            Cell::Swatch => "the line of this loop in the plots and on the stage",
            Cell::Name => "the rule of the loop, from the simplest on",
            Cell::Verdict => {
                "what this loop does to motion at this tick rate on this display; sorted from best to worst"
            }
            Cell::Metric(_) | Cell::Latency => {
                let metric = self.metric();
                let unit = match metric.map(|metric| metric.unit) {
                    Some(AMPLITUDES) => ", in percent of the amplitude",
                    _ => "",
                };
                let [name, about] = metric.map_or([""; 2], |metric| [metric.name, metric.about]);
                return format!("{name}: {about}{unit}");
            }
        };
        words.into()
    }

    /// The metric of the loop at this place in words.
    pub(super) fn written(self, loops: &LoopLab, place: usize) -> Option<String> {
        let metric = self.metric()?;
        let value = loops.lanes()[place].report().and_then(metric.measure)?;
        Some(match self {
            Cell::Latency => latency(value),
            _ => shown(value, metric.unit),
        })
    }

    /// What the loop at this place is sorted by; `None` comes last.
    pub(super) fn rank(self, loops: &LoopLab, place: usize) -> Option<f64> {
        let lane = &loops.lanes()[place];
        match self {
            Cell::Metric(_) | Cell::Latency => {
                (self.metric()?.measure)(lane.report()?).map(f64::abs)
            }
            Cell::Verdict => Some(match lane.verdict(loops.scene().tick_hz).severity {
                Severity::Fine => 0.0,
                Severity::Doubtful => 1.0,
                Severity::Bad => 2.0,
                Severity::Unknown => return None,
            }),
            Cell::OnStage => Some(if loops.on_stage().contains(&place) { 0.0 } else { 1.0 }),
            Cell::Key | Cell::Swatch | Cell::Name => Some(place as f64),
        }
    }
}

/// The unit that is shown in percent.
const AMPLITUDES: &str = "amplitudes";
/// From here on milliseconds are told in seconds.
const MANY_MS: f64 = 10_000.0;
/// From here on a share of the amplitude is that of a motion that has blown up.
const LOST_PERCENT: f64 = 1e5;
/// Frames begin early and late by more than this: a lesser mean latency is none.
const MIN_LATENCY_MS: f64 = 0.1;
/// Less is not told from nothing by three decimals.
const MIN_SHOWN: f64 = 1e-3;
/// From here on three digits have no more than two decimals.
const SMALL: f64 = 0.1;

/// A mean latency in milliseconds as the table has it.
fn latency(ms: f64) -> String {
    match ms {
        ms if ms.abs() < MIN_LATENCY_MS => "0 ms".into(),
        // It grows as long as the run goes on.
        ahead if ahead < 0.0 => "ahead".into(),
        behind => shown(behind, "ms"),
    }
}

/// A value of a metric as the table has it.
pub(super) fn shown(value: f64, unit: &str) -> String {
    let (value, unit) = if unit == AMPLITUDES { (100.0 * value, "%") } else { (value, unit) };
    let (value, unit) = match unit {
        "ms" if value.abs() >= MANY_MS => (value / 1000.0, "s"),
        _ => (value, unit),
    };
    let number = match value.abs() {
        lost if unit == "%" && lost >= LOST_PERCENT => return "lost".into(),
        0.0 => "0".into(),
        small if small < MIN_SHOWN => "<0.001".into(),
        small if small < SMALL => round(libm::round(value * 1000.0) / 1000.0, 3),
        _ => round(value, 3),
    };
    format!("{number} {unit}")
}

/// The columns that fit this width, each with its left edge and its own width.
pub(super) fn fitting(width: f32) -> Vec<(&'static Column, f32, f32)> {
    let room_for_verdict = |most: u8| {
        let columns = COLUMNS.iter().filter(|column| column.turn <= most);
        width - columns.map(|column| column.width + GAP).sum::<f32>() + GAP
    };
    let last = COLUMNS.iter().map(|column| column.turn).max().unwrap_or_default();
    let fits = |most: &u8| room_for_verdict(*most) >= MIN_VERDICT;
    let most = (1..=last).rev().find(fits).unwrap_or(0);
    let verdict = room_for_verdict(most).max(0.0);
    let mut left = 0.0;
    let columns = COLUMNS.iter().filter(|column| column.turn <= most);
    let placed = columns.map(|column| {
        let own = if column.cell == Cell::Verdict { verdict } else { column.width };
        let here = left;
        left += own + GAP;
        (column, here, own)
    });
    placed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_a_metric_of_the_table() {
        for column in COLUMNS {
            let is_number = column.turn > 0;
            assert_eq!(column.cell.metric().is_some(), is_number, "{}", column.head);
            assert!(column.cell.about().len() > 20, "{}", column.head);
        }
    }

    #[test]
    fn columns_fill_the_width_and_the_verdict_is_never_squeezed_out_by_a_number() {
        let mut before = 0;
        for width in (300..1400).map(|width| width as f32) {
            let columns = fitting(width);
            assert!(columns.len() >= before, "{width}");
            before = columns.len();
            let verdict = columns.iter().find(|(column, ..)| column.cell == Cell::Verdict).unwrap();
            let has_numbers = columns.iter().any(|(column, ..)| column.turn > 0);
            assert!(verdict.2 >= MIN_VERDICT || !has_numbers, "{width}");
            let (_, left, own) = columns[columns.len() - 1];
            assert!(!has_numbers || (left + own - width).abs() < 0.01, "{width}");
        }
        assert_eq!(before, COLUMNS.len());
    }

    #[test]
    fn values_have_three_digits_or_decimals_and_nothing_is_told_from_almost_nothing() {
        let texts = [(8.2247, "ms"), (0.0, "ms"), (1e-7, "ms"), (0.1234, AMPLITUDES)];
        let texts = texts.map(|(value, unit)| shown(value, unit));
        assert_eq!(texts, ["8.22 ms", "0 ms", "<0.001 ms", "12.3 %"]);
        let texts = [-290_000.0, -0.008_81, 3e-7, 0.3, 16.66, 14_000.0].map(latency);
        assert_eq!(texts, ["ahead", "0 ms", "0 ms", "0.3 ms", "16.7 ms", "14 s"]);
    }
}
