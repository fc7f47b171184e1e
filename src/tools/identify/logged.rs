//! Reads a log of one coordinate from text, and describes the body that it records.

use csv::ByteRecord;

use crate::scene::{clip, clip_list};
use crate::sim::number::{counted, significant};
use crate::table::{Decimal, Reading, TableError, TableReader, Utf8, number};

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
    /// Names of the columns that were read; times in milliseconds are marked.
    columns: String,
    /// Largest coordinate and largest velocity in magnitude. The velocity's scale is 1 if the log has no velocities.
    scale: [f64; 2],
    is_uneven: bool,
}

/// Names of a log's columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnNames {
    /// Column of the tick number; optional if there are times.
    pub tick: String,
    /// Column of the time in seconds; optional if there are ticks.
    pub t: String,
    /// Column of the coordinate in metres.
    pub x: String,
    /// Column of the velocity in metres per second; optional.
    pub v: String,
}

impl Default for ColumnNames {
    fn default() -> Self {
        let [tick, t, x, v] = ["tick", "t", "x", "v"].map(str::to_owned);
        Self { tick, t, x, v }
    }
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
    fault: String,
}

/// A setting of [`Log::parse`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogSetting {
    /// The setting [`ColumnNames::tick`].
    TickColumn,
    /// The setting [`ColumnNames::t`].
    TimeColumn,
    /// The setting [`ColumnNames::tick`] or [`ColumnNames::t`].
    TickOrTimeColumn,
    /// The setting [`ColumnNames::x`].
    CoordinateColumn,
    /// The setting [`ColumnNames::v`].
    VelocityColumn,
    /// The tick rate.
    TickRate,
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

/// The columns of a log by their index, from 0.
struct Columns {
    names: Vec<String>,
    time: TimeColumn,
    x: usize,
    v: Option<usize>,
    decimal: Decimal,
}

enum TimeColumn {
    Ticks(usize),
    /// The column, and the number of its units in a second.
    Time(usize, f64),
}

/// Other names for columns of ticks, seconds and milliseconds. Case does not matter.
const OF_TICKS: [&str; 3] = ["tick", "frame", "step"];
const OF_SECONDS: [&str; 6] = ["t", "time", "t_s", "time_s", "seconds", "elapsed"];
const OF_MILLISECONDS: [&str; 5] = ["t_ms", "time_ms", "ms", "timestamp_ms", "elapsed_ms"];
const MS: f64 = 1e3;
/// If a log's second row seems at least this many ticks after the first, the log's times are in milliseconds.
const TOO_FAR: f64 = 500.0;

impl Columns {
    /// Finds the columns. `per_second` is the number of time units per second, unless the column's name gives the
    /// unit.
    fn find(
        header: Vec<String>,
        decimal: Decimal,
        names: &ColumnNames,
        per_second: f64,
    ) -> Result<Self, Fault> {
        let column = |wanted: &str| header.iter().position(|known| known == wanted);
        let one_of = |known: &[&str]| {
            header
                .iter()
                .position(|name| known.iter().any(|known| name.eq_ignore_ascii_case(known)))
        };
        let absent = |what: &str, setting: LogSetting| Fault {
            mistaken: Some(setting),
            what: format!("no column {what}; here are {}", listed(&header)),
        };
        let Some(x) = column(&names.x) else {
            return Err(absent(&format!("{:?}", names.x), LogSetting::CoordinateColumn));
        };
        let (tick, t, v) = (column(&names.tick), column(&names.t), column(&names.v));
        let usual = ColumnNames::default();
        for (wanted, usual, found, setting) in [
            (&names.tick, &usual.tick, tick, LogSetting::TickColumn),
            (&names.t, &usual.t, t, LogSetting::TimeColumn),
            (&names.v, &usual.v, v, LogSetting::VelocityColumn),
        ] {
            if wanted != usual && found.is_none() {
                return Err(absent(&format!("{wanted:?}"), setting));
            }
        }
        // If the caller names a time column, other names for ticks do not count.
        let tick = tick.or_else(|| one_of(&OF_TICKS).filter(|_| names.t == usual.t));
        let seconds = t.or_else(|| one_of(&OF_SECONDS));
        let milliseconds = one_of(&OF_MILLISECONDS);
        let t = seconds.map(|at| (at, per_second)).or(milliseconds.map(|at| (at, MS)));
        let time = tick.map(TimeColumn::Ticks);
        let time = time.or(t.map(|(at, per_second)| TimeColumn::Time(at, per_second)));
        let time = time.ok_or_else(|| {
            let both = format!("{:?} and none {:?}", names.tick, names.t);
            absent(&both, LogSetting::TickOrTimeColumn)
        })?;
        Ok(Self { names: header, time, x, v, decimal })
    }

    /// Returns the names of the columns that were read, for people.
    fn read_names(&self) -> String {
        let (time, unit) = match self.time {
            TimeColumn::Ticks(at) => (at, ""),
            TimeColumn::Time(at, MS) => (at, " (in ms)"),
            TimeColumn::Time(at, _) => (at, ""),
        };
        let named = |at: usize| clip(&self.names[at]);
        let x = [Some(self.x), self.v].into_iter().flatten().map(named);
        [format!("{}{unit}", named(time))].into_iter().chain(x).collect::<Vec<_>>().join(", ")
    }

    /// Whether the log's times count as seconds.
    fn is_in_seconds(&self) -> bool {
        matches!(self.time, TimeColumn::Time(_, 1.0))
    }

    /// Returns the number of ticks between the first row and this one. `first` is the first row's own count, set by the
    /// first call.
    fn ticks_since(
        &self,
        record: &ByteRecord,
        tick_hz: f64,
        first: &mut Option<f64>,
    ) -> Result<f64, Fault> {
        let at = match self.time {
            TimeColumn::Ticks(tick) => self.number(record, tick)?,
            TimeColumn::Time(t, per_second) => self.number(record, t)? / per_second * tick_hz,
        };
        Ok(at - *first.get_or_insert(at))
    }

    fn number(&self, record: &ByteRecord, column: usize) -> Result<f64, Fault> {
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
}

/// Whether a row lies on a whole tick, `since` ticks after the first.
fn is_at_a_tick(since: f64) -> bool {
    (since - since.round()).abs() <= OFF_TICK
}

/// Returns the fault of rows off their ticks that are evenly spaced at another rate. `since` is each row's distance
/// from the first, in ticks. `None` if the rows are uneven, or if all are on their ticks.
fn off_ticks(since: &[f64], tick_hz: f64) -> Option<Fault> {
    let off = since.iter().find(|since| !is_at_a_tick(**since))?;
    let steps = since.len() as f64 - 1.0;
    let step = since[since.len() - 1] / steps;
    let is_even =
        since.iter().zip(0..).all(|(since, row)| (since / step - f64::from(row)).abs() <= OFF_TICK);
    let rate = significant(tick_hz / step, 4);
    is_even.then(|| Fault {
        mistaken: Some(LogSetting::TickRate),
        what: format!(
            "the row is {off:.3} ticks of {tick_hz} Hz after the first; there are {rate} rows a second"
        ),
    })
}

/// Returns the columns of the header, for a message.
fn listed(header: &[String]) -> String {
    let names: Vec<String> = header.iter().map(|name| format!("\"{name}\"")).collect();
    clip_list(names.iter().map(String::as_str))
}

impl Log {
    /// Minimum number of rows if they have velocities, which have two numbers more than a start.
    const MIN_ROWS: usize = 2;
    /// Minimum number of rows if they have no velocities.
    const MIN_ROWS_WITHOUT_VELOCITY: usize = 4;
    /// Number of ticks after which rows are ignored; in an uneven log, number of rows.
    pub const MAX_TICKS: u64 = 3000;

    /// Reads a log from the text of a table with a header. `name` is the name of the file, for messages.
    ///
    /// # Errors
    /// Fails with the first fault of the text.
    pub fn parse(
        name: &str,
        text: &str,
        columns: &ColumnNames,
        tick_hz: f64,
    ) -> Result<Log, LogError> {
        Self::from_bytes(name, text.as_bytes(), columns, tick_hz)
    }

    /// Like [`Log::parse`], from the bytes of a file in UTF-8 or UTF-16.
    ///
    /// # Errors
    /// Fails as [`Log::parse`] does.
    pub fn from_bytes(
        name: &str,
        bytes: &[u8],
        columns: &ColumnNames,
        tick_hz: f64,
    ) -> Result<Log, LogError> {
        Self::read(name, bytes, columns, (tick_hz, 1.0))
    }

    fn read(
        name: &str,
        bytes: &[u8],
        names: &ColumnNames,
        (tick_hz, per_second): (f64, f64),
    ) -> Result<Log, LogError> {
        let at = |line: u64| {
            move |Fault { mistaken, what }: Fault| {
                let name = name.to_owned();
                LogError { name, line, mistaken, fault: what }
            }
        };
        let broken = |error: TableError| at(error.line)(error.fault.to_string().into());
        // A row of numbers may have that name in a cell too, as the coordinate of a trace.
        let is_header = |row: &ByteRecord| {
            row.iter().any(|cell| cell.trim_ascii() == names.x.as_bytes())
                && row.iter().all(|cell| number(cell, Decimal::PointOrComma).is_none())
        };
        let reading = Reading { remarks: true, ..Reading::default() };
        let begun = TableReader::begin(Utf8::new(bytes), reading, is_header);
        let mut table = begun.map_err(broken)?;
        let name_of = |cell: &[u8]| String::from_utf8_lossy(cell).trim().to_owned();
        let header = table.header().iter().map(name_of).collect();
        let found = Columns::find(header, table.decimal(), names, per_second);
        let columns = found.map_err(at(table.header_line()))?;
        let (mut rows, mut first): (Vec<LogRow>, Option<f64>) = (Vec::new(), None);
        let (mut ticks, mut off) = (Vec::<f64>::new(), None);
        let mut record = ByteRecord::new();
        while let Some(line) = table.next(&mut record).map_err(broken)? {
            let since = columns.ticks_since(&record, tick_hz, &mut first).map_err(at(line))?;
            if rows.len() == 1 && since >= TOO_FAR && columns.is_in_seconds() {
                return Self::read(name, bytes, names, (tick_hz, MS));
            }
            if !is_at_a_tick(since) {
                if matches!(columns.time, TimeColumn::Ticks(_)) {
                    let what =
                        format!("tick {since} after the first is no whole number; write one");
                    return Err(at(line)(what.into()));
                }
                off = off.or(Some(line));
            }
            // Two rows of an uneven log may round to the same tick.
            let follows = ticks.last().is_none_or(|before| match off {
                Some(_) => since > *before,
                None => since.round() > before.round(),
            });
            if !follows || since < 0.0 {
                let place = match off {
                    Some(_) => "the time".to_owned(),
                    None => format!("tick {}", since.round()),
                };
                let what = format!("{place} does not follow the row before; put rows in order");
                return Err(at(line)(what.into()));
            }
            let is_over = if off.is_some() { rows.len() as f64 } else { since.round() };
            if is_over > Self::MAX_TICKS as f64 {
                break;
            }
            let value = |column| columns.number(&record, column).map_err(at(line));
            let (x, v) = (value(columns.x)?, columns.v.map(value).transpose()?);
            rows.push(LogRow { tick: since.round() as u64, t_s: since / tick_hz, x, v });
            ticks.push(since);
        }
        let is_uneven = off.is_some();
        if let Some(line) = off {
            off_ticks(&ticks, tick_hz).map_or(Ok(()), |fault| Err(at(line)(fault)))?;
            (0..).zip(&mut rows).for_each(|(number, row)| row.tick = number);
        }
        let has_velocities = columns.v.is_some();
        let least = if has_velocities { Self::MIN_ROWS } else { Self::MIN_ROWS_WITHOUT_VELOCITY };
        if rows.len() < least {
            let what =
                format!("a log of {} rows says too little; log at least {least}", rows.len());
            return Err(at(1)(what.into()));
        }
        if rows.iter().all(|row| row.x == rows[0].x && row.v.unwrap_or(0.0) == 0.0) {
            return Err(at(2)("nothing moves; log a motion".to_owned().into()));
        }
        let largest = |numbers: &mut dyn Iterator<Item = f64>| {
            let largest = numbers.map(f64::abs).fold(0.0, f64::max);
            if largest > 0.0 { largest } else { 1.0 }
        };
        let x = largest(&mut rows.iter().map(|row| row.x));
        let v = largest(&mut rows.iter().filter_map(|row| row.v));
        Ok(Log { rows, columns: columns.read_names(), scale: [x, v], is_uneven })
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
        let rows = counted(self.rows.len(), "row");
        let even = if self.is_uneven { "uneven, about " } else { "" };
        let seconds = significant(last.t_s, 3);
        format!("read {rows} in {seconds} s: {even}{rate} a second, columns {}", self.columns)
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
    /// Whether the body has a spring, known or not.
    pub fn has_spring(&self) -> bool {
        self.spring != Some([0.0; 2])
    }
}
