//! What a caller says about a table, in place of what a reader would find by itself.

use csv::ByteRecord;

use super::{Decimal, TableFault, Unit, number};

/// Settings of a table that its text does not show. A column is named, or numbered from 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableOptions {
    /// Separator of the cells; a space stands for any number of spaces and tabs.
    pub separator: Option<u8>,
    /// Whether the first line is already a row.
    pub no_header: bool,
    /// First and last row to take, from 1.
    pub rows: Option<[u64; 2]>,
    /// Time of the first and after the last row to take, in seconds after the first row.
    pub window_s: [Option<f64>; 2],
    /// Column and cell of the rows to take. A row needs all of them.
    pub filter: Vec<(String, String)>,
    /// Column of the moment that a frame shows.
    pub shown: Option<String>,
    /// Whether times of frames may be negative, as a clock that is set back gives them.
    pub signed: bool,
    /// Unit of the times.
    pub unit: Option<Unit>,
    /// Column of the durations of frames.
    pub frame: Option<String>,
    /// Column of a running clock.
    pub clock: Option<String>,
    /// Column of the tick numbers.
    pub tick: Option<String>,
    /// Column of the times.
    pub t: Option<String>,
    /// Column of the coordinate.
    pub x: Option<String>,
    /// Column of the velocity.
    pub v: Option<String>,
}

impl TableOptions {
    /// Returns the column of times that the caller names.
    pub fn time(&self) -> Option<&str> {
        self.t.as_deref().or(self.clock.as_deref())
    }

    /// Whether rows outside a window of time are left out.
    pub fn has_window(&self) -> bool {
        self.window_s != [None; 2]
    }
}

/// Returns the column with this name or, if there is none, with this number from 1.
pub fn column(header: &ByteRecord, wanted: &str) -> Option<usize> {
    let named = header.iter().position(|name| name.trim_ascii() == wanted.trim().as_bytes());
    let numbered =
        || wanted.trim().parse::<usize>().ok().filter(|n| (1..=header.len()).contains(n));
    named.or_else(|| numbered().map(|n| n - 1))
}

/// The rows to take, by the columns of one table.
pub(super) struct RowFilter {
    rows: [u64; 2],
    cells: Vec<(usize, String)>,
}

impl RowFilter {
    pub(super) fn of(header: &ByteRecord, options: &TableOptions) -> Result<Self, TableFault> {
        let of = |(name, cell): &(String, String)| {
            let here = || super::names_of(header);
            let at = column(header, name)
                .ok_or_else(|| TableFault::NoColumn { name: name.clone(), here: here() })?;
            Ok((at, cell.trim().to_owned()))
        };
        let cells = options.filter.iter().map(of).collect::<Result<_, _>>()?;
        Ok(Self { rows: options.rows.unwrap_or([1, u64::MAX]), cells })
    }

    /// Whether to take the row with this number.
    pub(super) fn takes(&self, number_of_row: u64, row: &ByteRecord, decimal: Decimal) -> bool {
        let is_wanted = |(at, wanted): &(usize, String)| {
            let cell = row.get(*at).unwrap_or_default().trim_ascii();
            let same = || Some(number(cell, decimal)? == number(wanted.as_bytes(), decimal)?);
            cell == wanted.as_bytes() || same() == Some(true)
        };
        (self.rows[0]..=self.rows[1]).contains(&number_of_row) && self.cells.iter().all(is_wanted)
    }

    /// Whether no row from this number on is taken.
    pub(super) fn ends_before(&self, number_of_row: u64) -> bool {
        number_of_row > self.rows[1]
    }
}

/// The rows of a table that were taken, and how the columns were read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    /// Number of the first and the last row that was taken, from 1.
    pub rows: [u64; 2],
    /// Number of rows in the table.
    pub of: u64,
    /// Unit of the times, and how it was found.
    pub unit: Option<(Unit, &'static str)>,
    /// Columns that were not read.
    pub left_out: Vec<String>,
    /// Remarks on what was not read as written.
    pub notes: Vec<String>,
}

impl Taken {
    /// Returns the rows in words.
    pub fn rows_in_words(&self) -> String {
        let Self { rows: [first, last], of, .. } = self;
        format!("rows {first} to {last} of {of}")
    }

    /// Returns the unit in words; empty if there are no times.
    pub fn unit_in_words(&self) -> String {
        self.unit.map(|(unit, how)| format!("in {}, {how}", unit.name())).unwrap_or_default()
    }

    /// Returns the columns that were left out, and the notes, each after a semicolon.
    pub fn rest_in_words(&self) -> String {
        let left_out = crate::scene::clip_list(self.left_out.iter().map(String::as_str));
        let left_out = (!self.left_out.is_empty()).then(|| format!("left out: {left_out}"));
        left_out.iter().chain(&self.notes).map(|part| format!("; {part}")).collect()
    }
}
