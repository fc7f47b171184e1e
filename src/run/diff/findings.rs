//! What is found of two runs: values that differ, and what they have in common.

use std::fmt;

use super::{LEVELS, layout};
use crate::sim::number::{counted, significant};

/// Two values that differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The tick; the row's place from 0 in a table without ticks.
    pub tick: u64,
    /// What the tick is called: the name of its column, or `tick` for the place of a row; `None` where rows have no order.
    pub tick_name: Option<String>,
    /// The columns by which the row is told apart at its tick, such as `lane`, `body` and `coordinate`, each with its cell.
    pub key: Vec<(String, String)>,
    /// The column of the values.
    pub column: String,
    /// The values as they are written; `None` where the column is not there.
    pub values: [Option<String>; 2],
    /// How many doubles lie from one to the other; `None` where one is no number, or not a number.
    pub ulps: Option<u64>,
    /// Their difference as a part of the larger; `None` where that has no meaning.
    pub relative: Option<f64>,
}

/// The largest distance that is given in ulps, and not as a number.
const FEW_ULPS: u64 = 1000;

impl Difference {
    /// The row's cell in a column of its key.
    pub fn cell(&self, column: &str) -> Option<&str> {
        self.key.iter().find(|(name, _)| name == column).map(|(_, cell)| &**cell)
    }

    /// Where it is: the tick, the lane as it is to be named, the body and the coordinate, or the cells of another key.
    pub fn place(&self, lane_name: impl Fn(&str) -> String) -> String {
        let tick = self.tick_name.as_ref().map(|name| format!("{name} {}", self.tick));
        let cells = self.key.iter().map(|(name, cell)| match name.as_str() {
            "lane" => lane_name(cell),
            name if layout::NAMES.contains(&name) => cell.clone(),
            name => format!("{name} {cell}"),
        });
        tick.into_iter().chain(cells).collect::<Vec<_>>().join(", ")
    }

    /// How large it is, in a few words.
    pub fn size(&self) -> String {
        let column = &self.column;
        let [a, b] = self.values.each_ref().map(|value| value.as_deref()?.parse::<f64>().ok());
        let (Some(a), Some(b)) = (a, b) else {
            return format!("{column} is not a number on both sides");
        };
        let size = match self.ulps.filter(|ulps| *ulps <= FEW_ULPS) {
            Some(ulps) => counted(ulps, "ulp"),
            None => significant((a - b).abs(), 2),
        };
        let part = self.relative.map(|part| format!(", {} % of it", significant(100.0 * part, 2)));
        format!("size: {size} in {column}{}", part.unwrap_or_default())
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
    /// The column.
    pub column: String,
    /// The first tick at which it differs by more than the [`Tolerance`](super::Tolerance).
    pub first_tick: u64,
    /// In how many rows it does.
    pub rows: u64,
}

/// What two runs have in common, and where they part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// How many rows both have.
    pub rows: u64,
    /// The farthest that any coordinate went from its first value, on either side; the value `q`, or where there is none, all.
    pub moved: f64,
    /// The first values that differ by more than the [`Tolerance`](super::Tolerance), by their tick and then by their place.
    pub first: Option<Difference>,
    /// For each of [`LEVELS`], the tick at which a value first differs by it, as a part of the largest that this column of
    /// this coordinate had until then.
    pub reaches: [Option<u64>; LEVELS.len()],
    /// The columns of both that differ, in the order of the first table.
    pub columns: Vec<ColumnDifference>,
    /// The columns of both that do not.
    pub equal: Vec<String>,
    /// The rate of its growth in 1/s, if it grows exponentially through three decades and more.
    pub per_second: Option<f64>,
    /// Whether rows belong together by their place alone.
    pub is_by_place: bool,
    /// Whether there is a motion: a column of numbers moves, or one of text changes, or rows have no order to move in.
    pub changes: bool,
    /// How many rows each side lacks.
    pub missing: [u64; 2],
    /// The tick of the first row that a side lacks.
    pub first_missing: [Option<u64>; 2],
    /// The columns that only this side has.
    pub alone: [Vec<String>; 2],
    /// The column that differs most, and by how much, as in `reaches`.
    pub worst: Option<(String, f64)>,
    /// Pairs of zeros of two signs, which count as equal.
    pub zeros_of_two_signs: u64,
    /// Pairs of NaN, which count as equal.
    pub nans: u64,
    /// Whether a row counts as missing because its like, if there is one, stands too far away.
    pub is_cut_off: bool,
    /// Rows that stand at another place on the other side.
    pub displaced: u64,
}

impl Comparison {
    /// Whether there is something to compare: two common rows, and a motion.
    pub fn is_comparable(&self) -> bool {
        self.rows >= 2 && self.changes && !self.is_cut_off
    }

    /// Whether both have the same rows with equal values.
    pub fn is_same(&self) -> bool {
        let is_whole = self.missing == [0; 2] && self.alone.iter().all(Vec::is_empty);
        self.is_comparable() && self.first.is_none() && is_whole
    }
}
