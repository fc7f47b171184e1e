//! The findings about two runs, which are the values that differ, and the rows and columns that the runs share.

use std::fmt;

use super::{LEVELS, layout};
use crate::sim::number::counted;

/// Two values that differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Tick of the row; without ticks, its position from 0.
    pub tick: u64,
    /// Name of the tick column, or `tick` if rows go by position; `None` if rows have no order.
    pub tick_name: Option<String>,
    /// The other key columns, such as `lane`, `body` and `coordinate`, each with the row's cell.
    pub key: Vec<(String, String)>,
    /// Column of the values.
    pub column: String,
    /// The two values as written; `None` if the column is missing.
    pub values: [Option<String>; 2],
    /// Distance of the two values in doubles; `None` if one of them is not a number.
    pub ulps: Option<u64>,
    /// Difference of the two values relative to the larger one; `None` if undefined.
    pub relative: Option<f64>,
}

impl Difference {
    /// Returns the row's cell in a key column.
    pub fn cell(&self, column: &str) -> Option<&str> {
        self.key.iter().find(|(name, _)| name == column).map(|(_, cell)| &**cell)
    }

    /// Describes the row by its tick, and then by lane, body and coordinate, or by the cells of another key.
    /// `lane_name` names the lane.
    pub fn place(&self, lane_name: impl Fn(&str) -> String) -> String {
        let tick = self.tick_name.as_ref().map(|name| format!("{name} {}", self.tick));
        let cells = self.key.iter().map(|(name, cell)| match name.as_str() {
            "lane" => lane_name(cell),
            name if layout::NAMES.contains(&name) => cell.clone(),
            name => format!("{name} {cell}"),
        });
        tick.into_iter().chain(cells).collect::<Vec<_>>().join(", ")
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.values.each_ref().map(|value| value.as_deref().unwrap_or("absent"));
        let place = self.place(|lane| format!("lane {lane}"));
        write!(f, "at {place}: {} is {a} in a and {b} in b", self.column)?;
        if let Some(ulps) = self.ulps {
            write!(f, ", {} apart", counted(ulps, "ulp"))?;
        }
        self.relative.map_or(Ok(()), |part| write!(f, ", {part:.1e} relative"))
    }
}

/// A column whose values differ somewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnDifference {
    /// Name of the column.
    pub column: String,
    /// First tick at which the values differ by more than the [`Tolerance`](super::Tolerance).
    pub first_tick: u64,
    /// Number of rows in which the values differ.
    pub rows: u64,
}

/// The result of comparing two runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Number of rows that both runs have.
    pub rows: u64,
    /// Largest distance of a coordinate from its first value, on either side. If there is no column `q`, every column
    /// counts.
    pub moved: f64,
    /// First difference beyond the [`Tolerance`](super::Tolerance), by tick and then by position.
    pub first: Option<Difference>,
    /// For each of [`LEVELS`], the first tick at which a value differs by this level. Differences are relative to the
    /// largest value so far in the same column and key.
    pub reaches: [Option<u64>; LEVELS.len()],
    /// Common columns that differ, in the order of the first table.
    pub columns: Vec<ColumnDifference>,
    /// Common columns that are equal.
    pub equal: Vec<String>,
    /// Growth rate in 1/s, if the difference grows exponentially by a factor of a thousand or more.
    pub per_second: Option<f64>,
    /// Whether rows pair up by position alone.
    pub is_by_place: bool,
    /// Whether anything moves. This is so if a number or a text changes, or if rows have no order in which to move.
    pub changes: bool,
    /// Number of rows that each side lacks.
    pub missing: [u64; 2],
    /// Tick of the first row that each side lacks.
    pub first_missing: [Option<u64>; 2],
    /// Columns that only one side has, for each side.
    pub alone: [Vec<String>; 2],
    /// The column that differs most, and its difference, which is relative as in `reaches`.
    pub worst: Option<(String, f64)>,
    /// Number of pairs of 0 and −0, which count as equal.
    pub zeros_of_two_signs: u64,
    /// Number of pairs of NaN, which count as equal.
    pub nans: u64,
    /// Whether a row may count as missing only because its counterpart is too far away.
    pub is_cut_off: bool,
    /// Number of rows that have another position on the other side.
    pub displaced: u64,
}

impl Comparison {
    /// Whether the comparison has substance, namely two common rows and a motion.
    pub fn is_comparable(&self) -> bool {
        self.rows >= 2 && self.changes && !self.is_cut_off
    }

    /// Whether both runs have the same rows with equal values.
    pub fn is_same(&self) -> bool {
        let is_whole = self.missing == [0; 2] && self.alone.iter().all(Vec::is_empty);
        self.is_comparable() && self.first.is_none() && is_whole
    }
}
