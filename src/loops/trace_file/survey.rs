//! How the numbers of a table's columns go, by which a column is chosen.

use csv::ByteRecord;

use super::durations;
use crate::table::{Course, Decimal, Moment, TableReader, Utf8};

/// How the numbers of a table's columns go.
pub(super) struct Survey {
    pub(super) courses: Vec<Course>,
    /// Whether a column has a value in some row.
    has_value: Vec<bool>,
    pub(super) is_headless: bool,
    rows: u64,
}

/// Number of rows whose numbers tell what a column is, and number of columns that are surveyed.
const SURVEYED: u64 = 1000;
const SURVEYED_COLUMNS: usize = 1000;

impl Survey {
    pub(super) fn of(table: &mut TableReader<Utf8<&[u8]>>) -> Self {
        let columns = table.header().len();
        let mut survey = Self {
            courses: vec![Course::default(); columns.min(SURVEYED_COLUMNS)],
            has_value: vec![false; columns],
            is_headless: table.is_list() || table.is_headless(),
            rows: 0,
        };
        let mut row = ByteRecord::new();
        while let Ok(Some(_)) = table.next(&mut row) {
            survey.rows += 1;
            for (at, cell) in row.iter().take(columns).enumerate() {
                survey.has_value[at] |= !durations::is_missing(&String::from_utf8_lossy(cell));
                let moment =
                    Moment::read(cell, Decimal::PointOrComma).filter(|_| survey.rows <= SURVEYED);
                if let (Some(moment), Some(course)) = (moment, survey.courses.get_mut(at)) {
                    course.add(moment);
                }
            }
        }
        survey
    }

    /// Whether no row has a value in this column.
    pub(super) fn is_missing(&self, column: usize) -> bool {
        self.rows > 0 && !self.has_value[column]
    }
}
