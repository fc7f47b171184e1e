//! The columns of a log, and the unit of its times.

use csv::StringRecord;

use super::columns::Columns;
use super::survey::Survey;
use super::{Fault, is_of_afterburner};
use crate::sim::number::significant;
use crate::table::{Course, TableOptions, Unit, median};

/// Smallest median of a list that is in nanoseconds.
const MIN_NS: f64 = 1e6;

/// The columns of a log, and the unit of its times.
pub(super) struct Layout {
    pub(super) header: StringRecord,
    pub(super) columns: Columns,
    /// How the times of frames go.
    pub(super) course: Course,
    /// The unit, if it is known apart from the format's.
    pub(super) unit: Option<Unit>,
    pub(super) in_unit: Unit,
    /// Whether the unit is known by the size of the times.
    pub(super) by_size: bool,
}

impl Layout {
    /// Finds the columns of a log with this header. Times are in `unit` or, if none is given, in the unit of the log's
    /// format.
    pub(super) fn of(
        (bytes, header, survey): (&[u8], StringRecord, &Survey),
        unit: Option<Unit>,
        options: &TableOptions,
    ) -> Result<Self, Fault> {
        let columns = match options.unit {
            Some(Unit::Ticks) => return Err(Fault::InTicks),
            _ if is_of_afterburner(bytes) => return Err(Fault::Afterburner),
            _ => Columns::choose(&header, survey, options)?.showing(&header, options)?,
        };
        let course = survey.courses.get(columns.began_at()).cloned().unwrap_or_default();
        let count = header.iter().position(|it| it.trim() == "Count");
        if let Some(counted) = count.filter(|_| columns.is_list()) {
            let values = survey.courses.get(counted).map_or(&[][..], |it| &it.values);
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(0.0, f64::max);
            if most > 1.0 {
                return Err(Fault::Mean { least: least as u64, most: most as u64 });
            }
        }
        // Sizes decide on a clock, and on nanoseconds, which would be too long in any other unit.
        let is_of_size = options.unit.is_none() && columns.is_list() && columns.unit.is_none();
        let is_in_ns = || median(&course.values).is_some_and(|median| median >= MIN_NS);
        let (unit, by_size) = match unit {
            _ if is_of_size && columns.is_since_start() => {
                let no_unit = || Fault::NoUnit {
                    column: header[columns.began_at()].to_owned(),
                    step: median(&course.steps).map_or("0".into(), |step| significant(step, 3)),
                };
                (Some(course.unit().ok_or_else(no_unit)?), true)
            }
            None if is_of_size && is_in_ns() => (Some(Unit::Nanoseconds), true),
            unit => (unit.or(options.unit), unit.is_some()),
        };
        let in_unit = unit.or(columns.unit).unwrap_or(Unit::Milliseconds);
        Ok(Self { header, columns, course, unit, in_unit, by_size })
    }

    /// Returns how the unit is known, in words.
    pub(super) fn unit_is_known(&self, options: &TableOptions) -> &'static str {
        let Self { columns, course, .. } = self;
        match () {
            () if options.unit.is_some() => "as told",
            () if course.is_of_calendar() && columns.is_since_start() => "by its form",
            () if self.by_size => "by size",
            () if columns.is_list() && columns.unit.is_some() => "by its heading",
            () if columns.is_list() => "by size",
            () => "by the format",
        }
    }

    /// Returns the names of the columns that are not used.
    pub(super) fn left_out(&self) -> Vec<String> {
        let used = self.columns.used();
        let others = self.header.iter().enumerate().filter(|(at, _)| !used.contains(at));
        others.map(|(_, name)| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
    }
}
