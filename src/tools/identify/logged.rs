//! Reads a log of one coordinate from text, and describes the body that it records.

mod columns;
mod printed;
mod steps;
mod units;

use std::io::BufRead;

use csv::ByteRecord;

use columns::{Columns, OF_X, TimeColumn};
use steps::count_steps;
use units::note_on_units;

use crate::scene::clip;
use crate::sim::number::significant;
use crate::table::{
    Course, Decimal, Heading, Moment, Reading, TableError, TableOptions, TableReader, Taken, Unit,
    Utf8, median, number,
};

/// A row of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogRow {
    /// Number of the tick; in an uneven log, number of the row.
    pub tick: u64,
    /// Time after the first row, in seconds.
    pub t_s: f64,
    /// Coordinate, in metres.
    pub x: f64,
    /// Velocity in metres per second, if logged.
    pub v: Option<f64>,
}

/// A log of a body. Ticks rise from row to row, and either all rows have velocities or none has.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    rows: Vec<LogRow>,
    /// Names of the columns that were read.
    columns: String,
    taken: Taken,
    /// Ticks per second, given or found.
    tick_hz: f64,
    /// All rows at even ticks whatever their times, if these are uneven, and the row that is late.
    stepped: Option<(Vec<LogRow>, Option<String>)>,
    /// Largest coordinate and largest velocity in magnitude. The velocity's scale is 1 if the log has no velocities.
    scale: [f64; 2],
    is_uneven: bool,
}

/// The fault that makes a log unreadable, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {fault}")]
pub struct LogError {
    /// Name of the log, as given by the caller.
    pub name: String,
    /// Line number of the fault, from 1.
    pub line: u64,
    /// The caller's setting that may be wrong, if the fault suggests one.
    pub mistaken: Option<LogSetting>,
    /// A column and its cell for each body, at most 16, if the log has several rows at each time. As a
    /// [filter](TableOptions::filter), each reads one body.
    pub bodies: Vec<(String, String)>,
    fault: String,
}

/// A setting of [`Log::parse`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogSetting {
    /// The setting [`TableOptions::tick`].
    TickColumn,
    /// The setting [`TableOptions::t`], or another one of times.
    TimeColumn,
    /// The setting [`TableOptions::x`].
    CoordinateColumn,
    /// The setting [`TableOptions::v`].
    VelocityColumn,
    /// The tick rate, which a log without times needs.
    MissingTickRate,
    /// The setting [`TableOptions::unit`].
    Unit,
    /// The setting [`TableOptions::filter`].
    Filter,
}

/// Largest mean share that numbers of single precision lose when they are written with nine digits and read as single
/// precision again. Numbers of double precision lose more.
const LOST_IN_SINGLE: f64 = 8e-9;
/// Largest distance of a row from its tick, in ticks.
const OFF_TICK: f64 = 0.05;

/// A fault whose place is not known yet.
struct Fault {
    mistaken: Option<LogSetting>,
    what: String,
}

impl From<String> for Fault {
    fn from(what: String) -> Self {
        Fault { mistaken: None, what }
    }
}

/// Whether a row lies on a whole tick, `since` ticks after the first.
fn is_at_a_tick(since: f64) -> bool {
    (since - since.round()).abs() <= OFF_TICK
}

/// Returns the rate of rows off their ticks that are evenly spaced at another rate. `since` is each row's distance from
/// the first, in ticks. `None` if the rows are uneven, or if all are on their ticks.
fn other_rate(since: &[f64], tick_hz: f64) -> Option<f64> {
    since.iter().find(|since| !is_at_a_tick(**since))?;
    let steps = since.len() as f64 - 1.0;
    let step = since[since.len() - 1] / steps;
    let is_even =
        since.iter().zip(0..).all(|(since, row)| (since / step - f64::from(row)).abs() <= OFF_TICK);
    is_even.then_some(tick_hz / step)
}

/// Number of rows whose times tell their unit and their rate.
const SURVEYED: u64 = 1000;
/// Largest residual of a linear step, as a share of the largest coordinate, of rows that step alike.
const STEPS_ALIKE: f64 = 1e-6;
/// Smallest share of repeated times with which each step has two rows.
const ALL_TWICE: f64 = 0.45;
/// Largest number of bodies of one log that `identify` answers one by one.
const MAX_BODIES: usize = 16;
/// Largest distance of the usual step from a tick, in ticks, of rows that are ticks whatever their times.
const OFF_RATE: f64 = 0.02;
/// Largest share of rows that count as late.
const MOST_LATE: f64 = 0.1;
/// Returns the largest coordinate and velocity in magnitude, or 1 where all are 0.
fn scale_of(rows: &[LogRow]) -> [f64; 2] {
    let largest = |numbers: &mut dyn Iterator<Item = f64>| {
        let largest = numbers.map(f64::abs).fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    };
    let x = largest(&mut rows.iter().map(|row| row.x));
    [x, largest(&mut rows.iter().filter_map(|row| row.v))]
}

/// The rows of a log while they are read.
#[derive(Default)]
struct Rows {
    tick_hz: f64,
    /// Number of units of time in a second.
    per_second: f64,
    rows: Vec<LogRow>,
    /// All rows, with those whose time is that of the row before.
    all: Vec<LogRow>,
    /// Distance of each row from the first, in ticks.
    since: Vec<f64>,
    /// Line of the first row off its tick.
    off: Option<u64>,
    first: Option<Moment>,
    /// Sum of the frames up to now.
    frames: f64,
    /// Number and time of the rows whose time is that of the row before.
    repeated: Vec<(u64, f64)>,
    last: ByteRecord,
    /// The first two rows at one time.
    pair: Option<[ByteRecord; 2]>,
}

impl Rows {
    /// Adds a row with its line and its number, and returns whether the log is long enough.
    fn add(
        &mut self,
        columns: &Columns,
        record: &ByteRecord,
        (line, number): (u64, u64),
    ) -> Result<bool, Fault> {
        let since = match (columns.time, columns.moment(record)?) {
            (TimeColumn::Rows, _) | (_, None) => self.all.len() as f64,
            (TimeColumn::Ticks(_), Some(moment)) => moment.since(*self.first.get_or_insert(moment)),
            (TimeColumn::Frames(_), Some(duration)) => {
                self.frames += if self.all.is_empty() { 0.0 } else { duration.value() };
                self.frames / self.per_second * self.tick_hz
            }
            (TimeColumn::Time(_), Some(moment)) => {
                let per_second = if moment.is_of_calendar { 1e9 } else { self.per_second };
                moment.since(*self.first.get_or_insert(moment)) / per_second * self.tick_hz
            }
        };
        let is_of_ticks = matches!(columns.time, TimeColumn::Ticks(_));
        if !is_at_a_tick(since) {
            if is_of_ticks {
                return Err(
                    format!("tick {since} after the first is no whole number; write one").into()
                );
            }
            self.off = self.off.or(Some(line));
        }
        let t_s = since / self.tick_hz;
        let is_same = !is_of_ticks && self.since.last().is_some_and(|before| *before == since);
        // Two rows of an uneven log may round to the same tick.
        let follows = self.since.last().is_none_or(|before| match self.off {
            Some(_) => since > *before,
            None => since.round() > before.round(),
        });
        if !is_same && (!follows || since < 0.0) {
            let place = match self.off {
                Some(_) => "the time".to_owned(),
                None => format!("tick {}", since.round()),
            };
            // The rows of several bodies may follow each other.
            let what = format!("{place} does not follow the row before; put rows in order");
            return Err(Fault { mistaken: Some(LogSetting::Filter), what });
        }
        let is_over = if self.off.is_some() { self.rows.len() as f64 } else { since.round() };
        if is_over > Log::MAX_TICKS as f64 {
            return Ok(true);
        }
        let value = |column| columns.number(record, column);
        let (x, v) = (value(columns.x)?, columns.v.map(value).transpose()?);
        let row = LogRow { tick: since.round() as u64, t_s, x, v };
        self.all.push(row);
        if is_same {
            self.repeated.push((number, t_s));
            let last = &self.last;
            self.pair.get_or_insert_with(|| [last.clone(), record.clone()]);
            return Ok(false);
        }
        self.last.clone_from(record);
        self.rows.push(row);
        self.since.push(since);
        Ok(false)
    }

    /// Returns the log of these rows, or its fault with a line. `twice` says that nearly each time has two rows.
    fn into_log(
        self,
        columns: &Columns,
        mut taken: Taken,
        twice: bool,
    ) -> Result<Log, (u64, Fault)> {
        let Rows { tick_hz, mut rows, all, since: ticks, off, repeated, .. } = self;
        taken.notes.extend(note_of_repeated(&repeated, twice));
        let is_uneven = off.is_some();
        if is_uneven {
            taken.notes.extend(other_rate(&ticks, tick_hz).map(|rate| {
                let rate = significant(rate, 4);
                format!("there are {rate} rows a second: give the rate with --tick-hz to find the method")
            }));
            (0..).zip(&mut rows).for_each(|(number, row)| row.tick = number);
        }
        let has_velocities = columns.v.is_some();
        let least = if has_velocities { Log::MIN_ROWS } else { Log::MIN_ROWS_WITHOUT_VELOCITY };
        if rows.len() < least {
            let what =
                format!("a log of {} rows says too little; log at least {least}", rows.len());
            return Err((1, what.into()));
        }
        if rows.iter().all(|row| row.x == rows[0].x && row.v.unwrap_or(0.0) == 0.0) {
            return Err((2, "nothing moves; log a motion".to_owned().into()));
        }
        if !is_uneven {
            taken.notes.extend(count_steps(&mut rows, tick_hz));
        }
        taken.notes.extend(note_on_units(&mut rows, tick_hz));
        // A frame that came late skips ticks of the clock, but none of the motion.
        let gaps = rows.windows(2).filter(|pair| pair[1].tick > pair[0].tick + 1).count();
        let is_late =
            taken.unit.is_some() && gaps > 0 && gaps as f64 <= MOST_LATE * rows.len() as f64;
        let has_other_times = is_uneven || is_late || !twice && !repeated.is_empty();
        let steps: Vec<f64> = ticks.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let is_of_rate = median(&steps).is_some_and(|step| (step - 1.0).abs() <= OFF_RATE);
        let is_stepped = has_other_times && is_of_rate && all.len() >= least;
        let stepped = is_stepped.then(|| as_even(&all, &repeated, tick_hz, taken.rows[0]));
        let scale = scale_of(&rows);
        let names = columns.read_names(&taken);
        Ok(Log { rows, columns: names, taken, tick_hz, stepped, scale, is_uneven })
    }
}

impl Log {
    /// Minimum number of rows if they have velocities, which have two numbers more than a start.
    const MIN_ROWS: usize = 2;
    /// Minimum number of rows if they have no velocities.
    const MIN_ROWS_WITHOUT_VELOCITY: usize = 4;
    /// Number of ticks after which rows are ignored; in an uneven log, number of rows.
    pub const MAX_TICKS: u64 = 3000;

    /// Reads a log from the text of a table. `name` is the name of the file, for messages.
    ///
    /// # Errors
    /// Fails with the first fault of the text.
    pub fn parse(
        name: &str,
        text: &str,
        options: &TableOptions,
        tick_hz: f64,
    ) -> Result<Log, LogError> {
        Self::from_bytes(name, text.as_bytes(), options, Some(tick_hz))
    }

    /// Like [`Log::parse`], from the bytes of a file in UTF-8 or UTF-16. Without a tick rate, the log's times give it.
    ///
    /// # Errors
    /// Fails as [`Log::parse`] does, and if there is neither a tick rate nor a column of times.
    pub fn from_bytes(
        name: &str,
        bytes: &[u8],
        options: &TableOptions,
        tick_hz: Option<f64>,
    ) -> Result<Log, LogError> {
        let at = |line: u64| {
            move |Fault { mistaken, what }: Fault| {
                let name = name.to_owned();
                LogError { name, line, mistaken, bodies: Vec::new(), fault: what }
            }
        };
        let broken = |error: TableError| at(error.line)(error.fault.to_string().into());
        // A row of numbers may have that name in a cell too, as the coordinate of a trace.
        let is_header = |row: &ByteRecord| {
            let is_x = |cell: &[u8]| {
                let name = String::from_utf8_lossy(cell);
                match &options.x {
                    Some(x) => name.trim() == x.trim(),
                    None => OF_X.contains(&&*Heading::of(&name).base),
                }
            };
            row.iter().any(is_x)
                && row.iter().all(|cell| number(cell, Decimal::PointOrComma).is_none())
        };
        let begin = || {
            let options = options.clone();
            let reading = Reading { remarks: true, headless: true, options, ..Reading::default() };
            TableReader::begin(Utf8::new(bytes), reading, is_header).map_err(broken)
        };
        let mut table = begin()?;
        let header_line = table.header_line();
        let is_headless = table.is_headless();
        let first = if is_headless { survey(0, &mut begin()?) } else { Course::default() };
        let found = Columns::find(table.header(), is_headless, (table.decimal(), &first), options);
        let mut columns = found.map_err(at(header_line))?;
        let course = match columns.time.column() {
            Some(time) => survey(time, &mut begin()?),
            None => Course::default(),
        };
        let unit = columns.unit(&course, tick_hz, options).map_err(at(header_line))?;
        if let (TimeColumn::Time(time), Some((Unit::Ticks, _))) = (columns.time, unit) {
            columns.time = TimeColumn::Ticks(time);
        }
        let unit = unit.filter(|(unit, _)| *unit != Unit::Ticks);
        let per_second = unit.map_or(1.0, |(unit, _)| 1e9 / unit.ns());
        let found_hz = || {
            let missing = Fault {
                mistaken: Some(LogSetting::MissingTickRate),
                what: "there is no column of times, so that the rows are ticks of a rate".into(),
            };
            let rate = unit.and_then(|_| columns.rate(&course, per_second));
            rate.ok_or_else(|| at(header_line)(missing))
        };
        let tick_hz = tick_hz.map_or_else(found_hz, Ok)?;
        if let (Some(time), Some((unit, _))) = (columns.time.column(), unit) {
            table.limit_by(time, unit);
        }
        // The error that names the bodies of a log, if a column tells them apart.
        let several_bodies = |found: &str, pair: &[ByteRecord; 2]| {
            let bodies = bodies_in(begin().ok()?, columns.of_bodies(pair)?)?;
            let (name, cell) = bodies.first()?;
            let what = format!("{found}; --where {}={} takes one", clip(name), clip(cell));
            let fault = Fault { mistaken: Some(LogSetting::Filter), what };
            Some(LogError { bodies, ..at(header_line)(fault) })
        };
        let mut read = Rows { tick_hz, per_second, ..Rows::default() };
        let (mut record, mut last) = (ByteRecord::new(), 0);
        while let Some(line) = table.next(&mut record).map_err(broken)? {
            let row = table.taken().0[1];
            match read.add(&columns, &record, (line, row)) {
                Ok(true) => break,
                Ok(false) => last = row,
                Err(fault) => {
                    let is_of_order = fault.mistaken == Some(LogSetting::Filter);
                    let pair = [read.last.clone(), record.clone()];
                    let bodies =
                        is_of_order.then(|| several_bodies("rows of several bodies", &pair));
                    return Err(bodies.flatten().unwrap_or_else(|| at(line)(fault)));
                }
            }
        }
        let of = table.count_rest();
        let twice = read.repeated.len() as f64 > ALL_TWICE * read.all.len() as f64;
        if let (true, Some(pair)) = (twice, &read.pair)
            && let Some(error) = several_bodies("two rows at each time", pair)
        {
            return Err(error);
        }
        let mut taken = Taken { rows: [table.taken().0[0], last], of, unit, ..Taken::default() };
        taken.left_out = columns.left_out();
        if last < of && options.rows.is_none() && !options.has_window() && options.filter.is_empty()
        {
            taken.notes.push(format!(
                "{} ticks are read; --rows, or --start and --end choose others",
                Self::MAX_TICKS
            ));
        }
        read.into_log(&columns, taken, twice).map_err(|(line, fault)| at(line)(fault))
    }

    /// Returns the log with its rows as ticks, whatever their times, and what is wrong with the times. `None` if the
    /// times are even, or if the rows do not follow from each other like those of a linear motion.
    pub(super) fn as_ticks(&self) -> Option<(Log, Option<String>)> {
        let (rows, late) = self.stepped.clone()?;
        let x: Vec<f64> = rows.iter().map(|row| row.x).collect();
        let last = x.len().checked_sub(2)?;
        let columns = [x[1..=last].to_vec(), x[..last].to_vec(), vec![1.0; last]];
        let found = crate::sim::least_squares(&columns, &x[2..])?;
        let scale = scale_of(&rows);
        let off = (0..last).map(|i| {
            let next: f64 = columns.iter().zip(&found).map(|(column, part)| column[i] * part).sum();
            (x[i + 2] - next).abs()
        });
        let is_linear = last > 3 && off.fold(0.0, f64::max) <= STEPS_ALIKE * scale[0];
        is_linear
            .then(|| (Log { rows, scale, is_uneven: false, stepped: None, ..self.clone() }, late))
    }

    /// Returns the same log, moved so that the body's rest is at 0.
    pub(super) fn resting_at_zero(&self, rest: f64) -> Log {
        let rows = self.rows.iter().map(|row| LogRow { x: row.x - rest, ..*row });
        Log { rows: rows.collect(), ..self.clone() }
    }

    /// Summarizes the log for people by its rows, rate and columns.
    pub fn summary(&self) -> String {
        let last = self.rows[self.rows.len() - 1];
        let rate = significant((self.rows.len() - 1) as f64 / last.t_s, 4);
        let rows = self.taken.rows_in_words();
        let even = if self.is_uneven { "uneven, about " } else { "" };
        let seconds = significant(last.t_s, 3);
        let (columns, rest) = (&self.columns, self.taken.rest_in_words());
        format!("read {rows} in {seconds} s: {even}{rate} a second, columns {columns}{rest}")
    }

    /// Returns the rows that were taken, and how they were read.
    pub fn taken(&self) -> &Taken {
        &self.taken
    }

    /// Returns the ticks per second, given or found.
    pub fn tick_hz(&self) -> f64 {
        self.tick_hz
    }

    /// Whether the log's rows are at uneven times, so that no method can run beside the log.
    pub fn is_uneven(&self) -> bool {
        self.is_uneven
    }

    /// Returns the rows up to this tick, and at least the minimum of a log. The scale stays that of the whole log.
    pub(super) fn head(&self, last_tick: u64) -> Log {
        let least = Self::MIN_ROWS_WITHOUT_VELOCITY.min(self.rows.len());
        let count = self.rows.partition_point(|row| row.tick <= last_tick).max(least);
        Log { rows: self.rows[..count].to_vec(), ..self.clone() }
    }

    /// Returns the largest coordinate and the largest velocity in magnitude. The velocity's scale is 1 if the log has
    /// no velocities.
    pub(super) fn scale(&self) -> [f64; 2] {
        self.scale
    }

    /// Whether the coordinates have more digits than single precision.
    pub(super) fn is_double(&self) -> bool {
        let moved = self.rows.iter().map(|row| row.x).filter(|x| *x != 0.0);
        let lost: Vec<f64> = moved.map(|x| ((f64::from(x as f32) - x) / x).abs()).collect();
        lost.iter().sum::<f64>() > LOST_IN_SINGLE * lost.len() as f64
    }

    /// Whether the log has velocities.
    pub fn has_velocities(&self) -> bool {
        self.rows[0].v.is_some()
    }

    /// Returns the number of logged coordinates and velocities.
    pub(super) fn numbers(&self) -> usize {
        self.rows.len() * if self.has_velocities() { 2 } else { 1 }
    }

    /// Returns the rows. Ticks and times count from the first row.
    pub fn rows(&self) -> &[LogRow] {
        &self.rows
    }
}

/// Returns the cells of the column that names the bodies, each with the column's name; `None` if there are too many.
fn bodies_in<R: BufRead>(mut table: TableReader<R>, of: usize) -> Option<Vec<(String, String)>> {
    let name = String::from_utf8_lossy(&table.header()[of]).trim().to_owned();
    let (mut bodies, mut record) = (Vec::<(String, String)>::new(), ByteRecord::new());
    while let Ok(Some(_)) = table.next(&mut record) {
        let cell = String::from_utf8_lossy(record.get(of).unwrap_or_default());
        let body = (name.clone(), cell.trim().to_owned());
        if !bodies.contains(&body) {
            bodies.push(body);
        }
        if bodies.len() > MAX_BODIES {
            return None;
        }
    }
    Some(bodies)
}

/// Returns the note on rows with the time of the row before, which are given with their times (s). `twice` says
/// that nearly each time has two rows.
fn note_of_repeated(repeated: &[(u64, f64)], twice: bool) -> Option<String> {
    Some(match (repeated, twice) {
        ([], _) => return None,
        (_, true) => "two rows at each time; the first of each is taken".into(),
        ([(row, t_s)], _) => format!(
            "rows {} and {row} are both at {} s; the first is taken",
            row - 1,
            significant(*t_s, 4)
        ),
        (several, _) => {
            format!("{} rows have the time of the row before, and are left out", several.len())
        }
    })
}

/// Returns the course of the times in a column.
fn survey<R: BufRead>(time: usize, table: &mut TableReader<R>) -> Course {
    let (mut course, mut row) = (Course::default(), ByteRecord::new());
    while course.count < SURVEYED
        && let Ok(Some(_)) = table.next(&mut row)
    {
        let cell = row.get(time).unwrap_or_default();
        Moment::read(cell, Decimal::PointOrComma).into_iter().for_each(|it| course.add(it));
    }
    course
}

/// Returns all rows at even ticks whatever their times, and the first row that is late or has the time of another.
fn as_even(
    all: &[LogRow],
    repeated: &[(u64, f64)],
    tick_hz: f64,
    first_row: u64,
) -> (Vec<LogRow>, Option<String>) {
    let late =
        all.windows(2).zip(1..).find(|(pair, _)| (pair[1].t_s - pair[0].t_s) * tick_hz > 1.5);
    let late = late.map(|(pair, row)| {
        let ms = significant(1e3 * (pair[1].t_s - pair[0].t_s - 1.0 / tick_hz), 3);
        format!("row {} is {ms} ms late", first_row + row)
    });
    let same = repeated.first().filter(|_| late.is_none());
    let same = same.map(|(row, t_s)| {
        format!("rows {} and {row} are both at {} s", row - 1, significant(*t_s, 4))
    });
    let even =
        (0..).zip(all).map(|(tick, row)| LogRow { tick, t_s: tick as f64 / tick_hz, ..*row });
    (even.collect(), late.or(same))
}

/// A body on a line with a spring, drag and a constant push, any of which may be 0. By default, the body has only an
/// unknown spring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoggedBody {
    /// The spring's k/m in 1/s² and c/m in 1/s; `None` if they are to be fitted.
    pub spring: Option<[f64; 2]>,
    /// The body's damping setting, in 1/s.
    pub drag: f64,
    /// Constant force per unit of mass, in m/s².
    pub push: f64,
    /// The spring's rest, in metres. `None` means 0 or, if nothing fits with 0, a fitted rest.
    pub rest: Option<f64>,
    /// Velocity of the first row in m/s, if the log has no velocities; `None` if it is to be fitted.
    pub v0: Option<f64>,
}

impl LoggedBody {
    /// Whether nothing is known about the body, so that it may have no spring at all.
    pub(super) fn is_unknown(&self) -> bool {
        *self == Self { v0: self.v0, ..Self::default() }
    }

    /// Whether the body has a spring, known or not.
    pub fn has_spring(&self) -> bool {
        self.spring != Some([0.0; 2])
    }
}
