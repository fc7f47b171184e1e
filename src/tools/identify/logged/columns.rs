//! Finds the columns of a log, the unit of its times and its rate.

use csv::ByteRecord;

use super::{Fault, LogSetting};
use crate::scene::{clip, clip_list};
use crate::table::{
    Course, Decimal, Heading, Moment, TableOptions, Taken, Unit, column, median, number,
};

/// The columns of a log by their index, from 0.
pub(super) struct Columns {
    pub(super) names: Vec<String>,
    pub(super) time: TimeColumn,
    pub(super) x: usize,
    pub(super) v: Option<usize>,
    pub(super) decimal: Decimal,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum TimeColumn {
    Ticks(usize),
    Time(usize),
    /// Durations of frames.
    Frames(usize),
    /// The rows are the ticks.
    Rows,
}

/// Other names for columns, without their unit. Case does not matter.
const OF_TICKS: [&str; 3] = ["tick", "frame", "step"];
const OF_TIMES: [&str; 8] =
    ["t", "time", "seconds", "elapsed", "timestamp", "ms", "clock", "time stamp"];
pub(super) const OF_X: [&str; 10] =
    ["x", "position", "pos", "pos x", "position x", "x m", "q", "angle", "theta", "displacement"];
const OF_V: [&str; 7] = ["v", "speed", "velocity", "vel", "vx", "v x", "vel x"];
/// If a log's second row seems at least this many ticks after the first, the log's times are in a smaller unit.
const TOO_FAR: f64 = 500.0;

impl Columns {
    /// Finds the columns by their names or, if the table has none, by how the first column goes.
    pub(super) fn find(
        header: &ByteRecord,
        is_headless: bool,
        (decimal, first): (Decimal, &Course),
        options: &TableOptions,
    ) -> Result<Self, Fault> {
        let name_of = |cell: &[u8]| String::from_utf8_lossy(cell).trim().to_owned();
        let names: Vec<String> = header.iter().map(name_of).collect();
        let one_of = |known: &[&str]| {
            let base = |name: &String| Heading::of(name).base;
            names.iter().position(|name| known.contains(&&*name.to_lowercase())).or_else(|| {
                known.iter().find_map(|known| names.iter().position(|name| base(name) == *known))
            })
        };
        let absent = |what: &str, setting: LogSetting| Fault {
            mistaken: Some(setting),
            what: format!("no column {what}; here are {}", listed(&names)),
        };
        let named = |wanted: &Option<String>, setting| {
            let of = |wanted: &String| {
                column(header, wanted).ok_or_else(|| absent(&format!("{wanted:?}"), setting))
            };
            wanted.as_ref().map(of).transpose()
        };
        let time = options.time().map(str::to_owned);
        let [tick, t, frames, x, v] = [
            named(&options.tick, LogSetting::TickColumn)?,
            named(&time, LogSetting::TimeColumn)?,
            named(&options.frame, LogSetting::TimeColumn)?,
            named(&options.x, LogSetting::CoordinateColumn)?,
            named(&options.v, LogSetting::VelocityColumn)?,
        ];
        let told = frames.map(TimeColumn::Frames).or(tick.map(TimeColumn::Ticks));
        let told = told.or(t.map(TimeColumn::Time));
        if is_headless {
            // Times rise; without them, the coordinate comes first.
            let has_times = told.is_none() && first.rises() && header.len() > 1;
            let time = if has_times { Some(TimeColumn::Time(0)) } else { told };
            let used: Vec<usize> = time.iter().filter_map(|time| time.column()).collect();
            let free = |taken: &[usize]| (0..header.len()).find(|at| !taken.contains(at));
            let x = x
                .or(free(&used))
                .ok_or_else(|| absent("of a coordinate", LogSetting::CoordinateColumn))?;
            let v = v.or(free(&[&used[..], &[x]].concat()).filter(|_| options.x.is_none()));
            let time = time.unwrap_or(TimeColumn::Rows);
            return Ok(Self { names, time, x, v, decimal });
        }
        let x = x.or_else(|| one_of(&OF_X).filter(|_| options.x.is_none()));
        let x = x.ok_or_else(|| absent("\"x\"", LogSetting::CoordinateColumn))?;
        let v = v.or_else(|| one_of(&OF_V).filter(|at| *at != x));
        let by_name = || {
            let tick = one_of(&OF_TICKS).map(TimeColumn::Ticks);
            tick.or_else(|| one_of(&OF_TIMES).map(TimeColumn::Time))
        };
        let time = told.or_else(by_name).unwrap_or(TimeColumn::Rows);
        Ok(Self { names, time, x, v, decimal })
    }

    /// Returns the names of the columns that were read, for people.
    pub(super) fn read_names(&self, taken: &Taken) -> String {
        let named = |at: usize| clip(&self.names[at]);
        let time = self.time.column().map(|at| match taken.unit {
            Some((unit, how)) => format!("{} (in {}, {how})", named(at), unit.name()),
            None => named(at),
        });
        let x = [Some(self.x), self.v].into_iter().flatten().map(named);
        time.into_iter().chain(x).collect::<Vec<_>>().join(", ")
    }

    /// Returns the columns that are not read.
    pub(super) fn left_out(&self) -> Vec<String> {
        let used = [self.time.column(), Some(self.x), self.v];
        let is_free =
            |(at, name): &(usize, &String)| !used.contains(&Some(*at)) && !name.is_empty();
        self.names.iter().enumerate().filter(is_free).map(|(_, name)| name.clone()).collect()
    }

    /// Returns the unit of the times and how it was found.
    pub(super) fn unit(
        &self,
        course: &Course,
        tick_hz: Option<f64>,
        options: &TableOptions,
    ) -> Result<Option<(Unit, &'static str)>, Fault> {
        let (TimeColumn::Time(at) | TimeColumn::Frames(at)) = self.time else { return Ok(None) };
        let heading = Heading::of(&self.names[at]);
        let fault = |what: String| Fault { mistaken: Some(LogSetting::Unit), what };
        let unit = match (options.unit, heading.unknown) {
            (Some(unit), _) => (unit, "as told"),
            (None, Some(unit)) => {
                let name = clip(&self.names[at]);
                return Err(fault(format!(
                    "column \"{name}\": {} is no unit of time that is known",
                    clip(&unit)
                )));
            }
            _ if course.is_of_calendar() => (Unit::Nanoseconds, "by its form"),
            _ if heading.unit.is_some() => {
                (heading.unit.unwrap_or(Unit::Seconds), "by its heading")
            }
            _ => {
                let is_frames = matches!(self.time, TimeColumn::Frames(_));
                let step =
                    median(if is_frames { &course.values } else { &course.steps }).unwrap_or(0.0);
                let near =
                    [Unit::Seconds, Unit::Milliseconds, Unit::Microseconds, Unit::Nanoseconds];
                let by_rate =
                    |hz: f64| near.into_iter().find(|unit| step * unit.ns() / 1e9 * hz < TOO_FAR);
                let unit = tick_hz.map_or_else(|| Unit::of_step(step), by_rate);
                (unit.unwrap_or(Unit::Seconds), "by size")
            }
        };
        Ok(Some(unit))
    }

    /// Returns the moment of a row, or the duration of its frame.
    pub(super) fn moment(&self, record: &ByteRecord) -> Result<Option<Moment>, Fault> {
        let Some(at) = self.time.column() else { return Ok(None) };
        let cell = &record[at];
        if let Some(moment) = Moment::read(cell, self.decimal) {
            return Ok(Some(moment));
        }
        self.number(record, at).map(|_| None)
    }

    pub(super) fn number(&self, record: &ByteRecord, column: usize) -> Result<f64, Fault> {
        let cell = &record[column];
        let found = number(cell, self.decimal).filter(|number| number.is_finite());
        found.ok_or_else(|| {
            let cell = String::from_utf8_lossy(cell);
            let [column, cell] = [self.names[column].as_str(), cell.trim()].map(clip);
            format!(
                "column \"{column}\": \"{cell}\" is no number; write one, or cut the log before it"
            )
            .into()
        })
    }

    /// Returns a column whose cells tell the bodies apart that a log has at each time.
    pub(super) fn of_bodies(&self, pair: &[ByteRecord; 2]) -> Option<usize> {
        let differs = |at: &usize| {
            let cells = [&pair[0][*at], &pair[1][*at]];
            let is_text = |cell: &[u8]| number(cell, self.decimal).is_none_or(|n| n.fract() == 0.0);
            cells[0] != cells[1]
                && cells.into_iter().all(is_text)
                && Some(*at) != self.time.column()
        };
        (0..self.names.len()).find(|at| differs(at) && *at != self.x && Some(*at) != self.v)
    }
}

impl TimeColumn {
    pub(super) fn column(self) -> Option<usize> {
        match self {
            Self::Ticks(at) | Self::Time(at) | Self::Frames(at) => Some(at),
            Self::Rows => None,
        }
    }
}

impl Columns {
    /// Returns the ticks per second of rows whose times go so.
    pub(super) fn rate(&self, course: &Course, per_second: f64) -> Option<f64> {
        let per_second = if course.is_of_calendar() { 1e9 } else { per_second };
        let is_frames = matches!(self.time, TimeColumn::Frames(_));
        let steps = if is_frames { &course.values } else { &course.steps };
        let middle = median(steps).filter(|step| *step > 0.0)?;
        // The mean of usual steps has less rounding than any one of them.
        let usual: Vec<f64> =
            steps.iter().copied().filter(|step| (step / middle - 1.0).abs() < 0.2).collect();
        let hz = per_second * usual.len() as f64 / usual.iter().sum::<f64>();
        let is_whole = (hz / hz.round() - 1.0).abs() < WHOLE;
        Some(if is_whole { hz.round() } else { hz }).filter(|hz| hz.is_finite() && *hz > 0.0)
    }
}

/// Largest relative distance of a rate from a whole number that counts as rounding of the times.
const WHOLE: f64 = 1e-3;

/// Returns the columns of the header, for a message.
fn listed(header: &[String]) -> String {
    let names: Vec<String> = header.iter().map(|name| format!("\"{name}\"")).collect();
    clip_list(names.iter().map(String::as_str))
}
