//! A log of one coordinate, from text.

use crate::lab::scene::clip::{clip, clip_list};

/// A row of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogRow {
    /// The number of its tick.
    pub tick: u64,
    /// The coordinate, in metres.
    pub x: f64,
    /// The velocity in metres per second, if it was logged.
    pub v: Option<f64>,
}

/// A log of a body: rows at rising ticks, with velocities in all of them or in none.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    rows: Vec<LogRow>,
    /// The largest coordinate and velocity; a velocity that was not logged has the scale 1.
    scale: [f64; 2],
}

/// The names of a log's columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnNames {
    /// The number of the tick; it may be absent if there are times.
    pub tick: String,
    /// The time in seconds; it may be absent if there are ticks.
    pub t: String,
    /// The coordinate in metres.
    pub x: String,
    /// The velocity in metres per second; it may be absent.
    pub v: String,
}

impl Default for ColumnNames {
    fn default() -> Self {
        let [tick, t, x, v] = ["tick", "t", "x", "v"].map(str::to_owned);
        Self { tick, t, x, v }
    }
}

/// Why a log cannot be read, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {fault}")]
pub struct LogError {
    /// What the caller calls the log.
    pub name: String,
    /// The line of the fault, from 1.
    pub line: u64,
    /// What the caller may have said wrong of the log, if it is that.
    pub mistaken: Option<LogSetting>,
    fault: String,
}

/// What [`Log::parse`] is told of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogSetting {
    /// [`ColumnNames::tick`].
    TickColumn,
    /// [`ColumnNames::t`].
    TimeColumn,
    /// [`ColumnNames::tick`] or [`ColumnNames::t`].
    TickOrTimeColumn,
    /// [`ColumnNames::x`].
    CoordinateColumn,
    /// [`ColumnNames::v`].
    VelocityColumn,
    /// The tick rate.
    TickRate,
}

/// Numbers of single precision that were written with nine digits lose less than this part when they are read as such
/// again; those of double precision lose more in the mean.
const LOST_IN_SINGLE: f64 = 8e-9;
/// A time may be off its tick by this part of a tick.
const OFF_TICK: f64 = 0.05;

impl Log {
    /// The fewest rows with velocities: two numbers more than a start has.
    const MIN_ROWS: usize = 2;
    /// The fewest rows without velocities.
    const MIN_ROWS_WITHOUT_VELOCITY: usize = 4;
    /// Rows after this many ticks are not used.
    pub const MAX_TICKS: u64 = 3000;

    /// Reads a log from the text of a CSV file with a header; `name` is the file's, for messages.
    ///
    /// # Errors
    /// The first fault of the text.
    pub fn parse(
        name: &str,
        text: &str,
        columns: &ColumnNames,
        tick_hz: f64,
    ) -> Result<Log, LogError> {
        let error = |line: u64, fault: String| LogError {
            name: name.to_owned(),
            line,
            mistaken: None,
            fault,
        };
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let broken = |e: &csv::Error| {
            let line = e.position().map_or(1, csv::Position::line);
            error(line, format!("the row cannot be read: {e}; give each row the header's cells"))
        };
        let header = reader.headers().map_err(|e| broken(&e))?.clone();
        let column = |wanted: &str| header.iter().position(|known| known == wanted);
        let found = || {
            let names: Vec<String> = header.iter().map(|name| format!("\"{name}\"")).collect();
            let listed = clip_list(names.iter().map(String::as_str));
            match &names[..] {
                [] => "no columns".to_owned(),
                [one] if one.contains([';', '\t']) => {
                    format!("{listed}, without a comma between columns")
                }
                _ => listed,
            }
        };
        let absent = |what: &str, setting: LogSetting| LogError {
            mistaken: Some(setting),
            ..error(1, format!("no column {what}; here are {}", found()))
        };
        let Some(x) = column(&columns.x) else {
            return Err(absent(&format!("{:?}", columns.x), LogSetting::CoordinateColumn));
        };
        let (tick, t, v) = (column(&columns.tick), column(&columns.t), column(&columns.v));
        let usual = ColumnNames::default();
        for (wanted, usual, setting) in [
            (&columns.tick, &usual.tick, LogSetting::TickColumn),
            (&columns.t, &usual.t, LogSetting::TimeColumn),
            (&columns.v, &usual.v, LogSetting::VelocityColumn),
        ] {
            if wanted != usual && column(wanted).is_none() {
                return Err(absent(&format!("{wanted:?}"), setting));
            }
        }
        if tick.is_none() && t.is_none() {
            let both = format!("{:?} and none {:?}", columns.tick, columns.t);
            return Err(absent(&both, LogSetting::TickOrTimeColumn));
        }
        let (mut rows, mut first): (Vec<LogRow>, Option<f64>) = (Vec::new(), None);
        for record in reader.records() {
            let record = record.map_err(|e| broken(&e))?;
            let line = record.position().map_or(1, csv::Position::line);
            let number = |index: usize| -> Result<f64, LogError> {
                let cell = &record[index];
                let found = cell.parse::<f64>().ok().filter(|number| number.is_finite());
                found.ok_or_else(|| {
                    let [column, cell] = [&header[index], cell].map(clip);
                    error(line, format!("column \"{column}\": \"{cell}\" is no number; write one, or cut the log before it"))
                })
            };
            let at = match (tick, t) {
                (Some(tick), _) => number(tick)?,
                (None, Some(t)) => number(t)? * tick_hz,
                (None, None) => unreachable!("one of them is there"),
            };
            let since = at - *first.get_or_insert(at);
            let tick = since.round();
            if tick < 0.0 || (since - tick).abs() > OFF_TICK {
                let fault = format!(
                    "the row is {since:.3} ticks of {tick_hz} Hz after the first; rows are at whole ticks"
                );
                let mistaken = Some(LogSetting::TickRate);
                return Err(LogError { mistaken, ..error(line, fault) });
            }
            let tick = tick as u64;
            if rows.last().is_some_and(|before| before.tick >= tick) {
                let fault =
                    format!("tick {tick} does not follow the row before; put rows in order");
                return Err(error(line, fault));
            }
            if tick > Self::MAX_TICKS {
                break;
            }
            rows.push(LogRow { tick, x: number(x)?, v: v.map(number).transpose()? });
        }
        let least = if v.is_some() { Self::MIN_ROWS } else { Self::MIN_ROWS_WITHOUT_VELOCITY };
        if rows.len() < least {
            let fault =
                format!("a log of {} rows says too little; log at least {least}", rows.len());
            return Err(error(1, fault));
        }
        let is_still = rows.iter().all(|row| row.x == rows[0].x && row.v.unwrap_or(0.0) == 0.0);
        if is_still {
            return Err(error(2, "nothing moves; log a motion".to_owned()));
        }
        let largest = |numbers: &mut dyn Iterator<Item = f64>| {
            let largest = numbers.map(f64::abs).fold(0.0, f64::max);
            if largest > 0.0 { largest } else { 1.0 }
        };
        let x = largest(&mut rows.iter().map(|row| row.x));
        let v = largest(&mut rows.iter().filter_map(|row| row.v));
        Ok(Log { rows, scale: [x, v] })
    }

    /// The part up to this tick, and as many rows as a log has at least. Its scale is that of the whole.
    pub(super) fn head(&self, last_tick: u64) -> Log {
        let least = Self::MIN_ROWS_WITHOUT_VELOCITY.min(self.rows.len());
        let count = self.rows.partition_point(|row| row.tick <= last_tick).max(least);
        Log { rows: self.rows[..count].to_vec(), scale: self.scale }
    }

    /// The largest coordinate and velocity; a velocity that was not logged has the scale 1.
    pub(super) fn scale(&self) -> [f64; 2] {
        self.scale
    }

    /// Whether the coordinates have more digits than single precision has.
    pub(super) fn is_double(&self) -> bool {
        let moved = self.rows.iter().map(|row| row.x).filter(|x| *x != 0.0);
        let lost: Vec<f64> = moved.map(|x| ((f64::from(x as f32) - x) / x).abs()).collect();
        lost.iter().sum::<f64>() > LOST_IN_SINGLE * lost.len() as f64
    }

    /// Whether velocities were logged.
    pub fn has_velocities(&self) -> bool {
        self.rows[0].v.is_some()
    }

    /// How many coordinates and velocities it has.
    pub(super) fn numbers(&self) -> usize {
        self.rows.len() * if self.has_velocities() { 2 } else { 1 }
    }

    /// The rows, whose ticks count from the first.
    pub fn rows(&self) -> &[LogRow] {
        &self.rows
    }
}
