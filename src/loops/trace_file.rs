//! Traces from the logs of frame-time tools: PresentMon, OCAT, CapFrameX, FrameView, MangoHud, Unreal and FRAPS, which
//! write a row per frame. A plain list of frame times in milliseconds with one time per line works too.
//!
//! A log can contain several streams of frames, from several programs and windows; each becomes a separate trace. The
//! first row of a stream starts its clock. From then on a frame begins `MsBetweenPresents` after the one before, and
//! is displayed `MsBetweenDisplayChange` after the last one displayed.
//!
//! These columns have two clocks without a common origin, so that a frame's display may lie before its beginning.
//! Differences within each clock count, but not their offset. If a log has no display times, frames count as displayed
//! when they begin, and the trace [reports it](FrameTrace::missing_display).

mod android;
mod capture_json;
mod columns;
mod durations;
mod names;
mod stream;

use std::collections::HashMap;
use std::io::Read as _;

use csv::{ByteRecord, StringRecord};

use super::trace::{ClockConflict, FrameTrace};
use columns::{Cells, Columns};
use durations::Unreadable;
use names::names;
use stream::Stream;

use crate::sim::number::significant;
use crate::table::{
    Course, Decimal, Moment, Reading, TableError, TableFault, TableOptions, TableReader, Taken,
    Unit, Utf8, median,
};

/// Maximum number of rows of a log: two hours of frames at 144 Hz.
const MAX_FRAMES: usize = 1 << 20;

/// Maximum number of programs, processes and windows in a log. A system runs some hundred.
const MAX_STREAMS: usize = 1000;

/// The reason why a log cannot be read, with its place and a remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {fault}")]
pub struct TraceFileError {
    /// Name of the log, as given by the caller.
    pub name: String,
    /// Line number of the fault, from 1.
    pub line: u64,
    fault: Fault,
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
enum Fault {
    #[error(
        "there is nothing here; capture some frames with PresentMon, OCAT, CapFrameX, FrameView, MangoHud, Unreal or FRAPS"
    )]
    Empty,
    #[error("{0}")]
    Unreadable(String),
    #[error(
        "no column \"{name}\"; here are {found}; name one with --frame-column, --clock-column or --shown"
    )]
    NoColumn { name: String, found: String },
    #[error(
        "column {column}: {unit} is no unit of time that is known; give --unit ns, us, ms or s"
    )]
    UnknownUnit { column: String, unit: String },
    #[error(
        "the times of {column} are {step} apart, which is no usual frame in any unit; give --unit ns, us, ms or s"
    )]
    NoUnit { column: String, step: String },
    #[error("frames are not counted in ticks; give --unit ns, us, ms or s")]
    InTicks,
    #[error("a row is the mean of {least} to {most} frames (Count); log every frame")]
    Mean { least: u64, most: u64 },
    #[error("none of the {of} rows is taken; widen --rows, --where, --start or --end")]
    NoneTaken { of: u64 },
    #[error(
        "a log of MSI Afterburner has a sample a second and no times of frames; let RTSS record frame times, or use PresentMon or CapFrameX"
    )]
    Afterburner,
    #[error("this is no capture of CapFrameX: {0}; capture again, or export it as CSV")]
    Json(String),
    #[error("frame {number}: {fault}")]
    Frame { number: u64, fault: Box<Fault> },
    #[error("there is a header and no frame of a program below it; capture some frames")]
    NoRows,
    #[error(
        "the columns MsBetweenPresents, alone or with MsBetweenDisplayChange, FrameTime and DisplayedTime, MangoHud's fps and frametime, Unreal's FrameTime, or FRAPS's Time (ms) are needed, and here are {found}; name the column of frame times with --frame-column or that of a running clock with --clock-column, or write frame times in milliseconds alone, one a line"
    )]
    Columns { found: String },
    #[error(
        "the row has {cells} of the header's first {header} cells; take it out if it was cut off"
    )]
    FewCells { cells: usize, header: usize },
    #[error("column {column}: {fault}")]
    Cell { column: String, fault: Unreadable },
    #[error("column {column}: the time of this frame is missing; take the row out")]
    NoTime { column: String },
    #[error(
        "column {column}: expected 0 or 1, found \"{cell}\"; write 1 for a frame that was not displayed"
    )]
    NotAFlag { column: String, cell: String },
    #[error(
        "the rows are samples every {every_ms} ms (log_interval), not frames, as elapsed shows; set log_interval=0 \
         and log again"
    )]
    Sampled { every_ms: String },
    #[error("the frame begins before the one above it; put rows in order")]
    TimeRunsBack,
    #[error("no time passes from here to the last of these {frames} frames; capture them again")]
    NoTimePasses { frames: usize },
    #[error("from here on the frames last more than a year in all; split the log")]
    TooLong,
    #[error("the log has more than {MAX_FRAMES} frames; split it")]
    ManyFrames,
    #[error("the log has more than {MAX_STREAMS} programs and windows; take some out")]
    ManyStreams,
}

/// Reads the streams of a log from a text, like [`from_bytes`].
///
/// # Errors
/// Fails as [`from_bytes`] does.
pub fn read(name: &str, text: &str) -> Result<Vec<FrameTrace>, TraceFileError> {
    from_bytes(name, text.as_bytes())
}

/// Reads the streams of a log from the bytes of a file, in order of their first rows. A single stream has the name
/// `name`. If there are several, each has the name `name`, a colon and its program; process and number are added if
/// names would otherwise collide.
///
/// # Errors
/// If the bytes are not a log of a known kind; the message calls the log `name`.
pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Vec<FrameTrace>, TraceFileError> {
    from_table(name, bytes, &TableOptions::default())
}

/// Reads the streams of a log like [`from_bytes`], with what the caller says about its table.
///
/// # Errors
/// Fails as [`from_bytes`] does, and if a column of the options is missing.
pub fn from_table(
    name: &str,
    bytes: &[u8],
    options: &TableOptions,
) -> Result<Vec<FrameTrace>, TraceFileError> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if start.trim_ascii_start().starts_with(b"{") && is_capture(start) {
        return of_json(name, start, options);
    }
    match android::table(start) {
        Some(table) => of_table(name, table.as_bytes(), options),
        None => of_table(name, bytes, options),
    }
}

/// Whether JSON is a capture of CapFrameX, which has runs.
fn is_capture(bytes: &[u8]) -> bool {
    let has = |key: &[u8]| bytes.windows(key.len()).any(|window| window == key);
    has(b"\"Runs\"") && !has(b"\"traceEvents\"")
}

/// Reads the runs of a JSON capture. Errors name the frame, since the line numbers of JSON are meaningless.
fn of_json(
    name: &str,
    bytes: &[u8],
    options: &TableOptions,
) -> Result<Vec<FrameTrace>, TraceFileError> {
    let at = |fault| TraceFileError { name: name.into(), line: 1, fault };
    let table = capture_json::table(bytes).map_err(at)?;
    let traces = of_table(name, table.as_bytes(), options).map_err(|error| match error.line {
        1 => at(error.fault),
        line => at(Fault::Frame { number: line - 1, fault: Box::new(error.fault) }),
    })?;
    Ok(traces.into_iter().map(|trace| trace.written_by("CapFrameX".into())).collect())
}

fn of_table(
    name: &str,
    bytes: &[u8],
    options: &TableOptions,
) -> Result<Vec<FrameTrace>, TraceFileError> {
    let (traces, checks) = read_in(name, bytes, None, options)?;
    match checks.unit() {
        Some(unit) if unit != Unit::Milliseconds && options.unit.is_none() => {
            read_in(name, bytes, Some(unit), options).map(|it| it.0)
        }
        _ => Ok(traces),
    }
}

/// How the numbers of a table's columns go.
struct Survey {
    courses: Vec<Course>,
    /// Whether a column has a value in some row.
    has_value: Vec<bool>,
    is_headless: bool,
    rows: u64,
}

/// Number of rows whose numbers tell what a column is, and number of columns that are surveyed.
const SURVEYED: u64 = 1000;
const SURVEYED_COLUMNS: usize = 1000;

impl Survey {
    fn of(table: &mut TableReader<Utf8<&[u8]>>) -> Self {
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
    fn is_missing(&self, column: usize) -> bool {
        self.rows > 0 && !self.has_value[column]
    }
}

/// Hints at the unit of a log's times.
#[derive(Default)]
struct Checks {
    /// Whether the log names its unit.
    names_unit: bool,
    /// Whether rows have the log's own time instead of frame times.
    is_own_time: bool,
    /// Frame times as if in milliseconds, and, if the log has frames per second, the products of both.
    frames_ms: Vec<f64>,
    products: Vec<f64>,
    /// Ratio of the log's own time to the sum of its frame times, in the longest stream.
    time_ratio: Option<f64>,
}

impl Checks {
    fn add(&mut self, cells: &Cells<'_>) {
        let Ok(began_ns) = cells.began_ns else { return };
        let ms = began_ns as f64 / 1e6;
        self.frames_ms.push(ms);
        self.products.extend(cells.fps.map(|fps| fps * ms));
    }

    /// Returns the unit of the times; `None` if nothing indicates another unit than milliseconds.
    fn unit(&self) -> Option<Unit> {
        let near = |unit: Unit, wanted: f64, found: f64| {
            (wanted / 2.0..wanted * 2.0).contains(&found).then_some(unit)
        };
        if self.is_own_time {
            return None;
        }
        if let Some(product) = median(&self.products) {
            let of = |(unit, wanted)| near(unit, wanted, product);
            let units = [
                (Unit::Milliseconds, 1e3),
                (Unit::Microseconds, 1e6),
                (Unit::Seconds, 1.0),
                (Unit::Nanoseconds, 1e9),
            ];
            return units.into_iter().find_map(of);
        }
        if let Some(ratio) = self.time_ratio {
            let units =
                [(Unit::Milliseconds, 1.0), (Unit::Microseconds, 1e-3), (Unit::Seconds, 1e3)];
            return units.into_iter().find_map(|(unit, wanted)| near(unit, wanted, ratio));
        }
        let median_ms = median(&self.frames_ms).filter(|_| !self.names_unit)?;
        match median_ms {
            // The limits correspond to 5000 frames per second and to one frame in two seconds.
            ..0.2 if median_ms > 0.0 => Some(Unit::Seconds),
            2000.0.. => Some(Unit::Microseconds),
            _ => None,
        }
    }

    /// Returns the time between two samples in milliseconds, if rows are not frames.
    fn sampled_ms(&self) -> Option<f64> {
        if self.is_own_time {
            let product = median(&self.products)?;
            return median(&self.frames_ms).filter(|_| product > 2e3);
        }
        let rows = self.frames_ms.len() as f64 - 1.0;
        let frames_ms: f64 = self.frames_ms.iter().skip(1).sum();
        let every_ms = self.time_ratio? * frames_ms / rows;
        (rows > 0.0 && self.time_ratio? > 2.0).then_some(every_ms)
    }

    /// Whether frames per second contradict frame times in most rows.
    fn is_rate_wrong(&self) -> bool {
        let off = median(&self.products).map(|product| product / 1e3);
        off.is_some_and(|off| !(1.0 / MAX_RATE_OFF..MAX_RATE_OFF).contains(&off))
    }
}

/// Largest ratio between the averaged frames per second and those of the frame times, in the median row.
const MAX_RATE_OFF: f64 = 1.25;

/// Reads the streams of a log with times in this unit or, if none is given, in the unit of the log's format.
fn read_in(
    name: &str,
    bytes: &[u8],
    unit: Option<Unit>,
    options: &TableOptions,
) -> Result<(Vec<FrameTrace>, Checks), TraceFileError> {
    let at = |line, fault| TraceFileError { name: name.into(), line, fault };
    let broken = |TableError { line, fault }: TableError| match fault {
        TableFault::Empty => at(line, Fault::Empty),
        fault => at(line, Fault::Unreadable(fault.to_string())),
    };
    let is_header = |row: &ByteRecord| Columns::may_be_of(&text_of(row), options);
    // OCAT describes the machine in the first row only.
    let begin = || {
        let options = options.clone();
        let reading =
            Reading { short_rows: true, remarks: true, lists: true, headless: true, options };
        TableReader::begin(Utf8::new(bytes), reading, is_header).map_err(broken)
    };
    let mut table = begin()?;
    let survey = Survey::of(&mut begin()?);
    let header_line = table.header_line();
    let header = text_of(table.header());
    let found = match options.unit {
        Some(Unit::Ticks) => Err(Fault::InTicks),
        _ if is_of_afterburner(bytes) => Err(Fault::Afterburner),
        _ => Columns::choose(&header, &survey, options)
            .and_then(|columns| columns.showing(&header, options)),
    };
    let columns = found.map_err(|fault| at(header_line, fault))?;
    let course = survey.courses.get(columns.began_at()).cloned().unwrap_or_default();
    if let Some(count) =
        header.iter().position(|it| it.trim() == "Count").filter(|_| columns.is_list())
    {
        let counts =
            || survey.courses.get(count).into_iter().flat_map(|it| it.values.iter().copied());
        let (least, most) = (counts().fold(f64::INFINITY, f64::min), counts().fold(0.0, f64::max));
        if most > 1.0 {
            return Err(at(header_line, Fault::Mean { least: least as u64, most: most as u64 }));
        }
    }
    // Sizes decide on a clock, and on nanoseconds, which would be too long in any other unit.
    let is_of_size = options.unit.is_none() && columns.is_list() && columns.unit.is_none();
    let (unit, by_size) = match unit {
        _ if is_of_size && columns.is_since_start() => {
            let fault = || {
                let step = median(&course.steps).map_or("0".into(), |step| significant(step, 3));
                at(
                    header_line,
                    Fault::NoUnit { column: header[columns.began_at()].to_owned(), step },
                )
            };
            (Some(course.unit().ok_or_else(fault)?), true)
        }
        None if is_of_size && median(&course.values).is_some_and(|median| median >= MIN_NS) => {
            (Some(Unit::Nanoseconds), true)
        }
        unit => (unit.or(options.unit), unit.is_some()),
    };
    let mut record = ByteRecord::new();
    let in_unit = unit.or(columns.unit).unwrap_or(Unit::Milliseconds);
    let (names_unit, is_own_time) = (columns.unit.is_some(), columns.is_since_start());
    let mut checks = Checks { names_unit: names_unit || by_size, is_own_time, ..Checks::default() };

    let (mut streams, mut numbers) = (Vec::<Stream>::new(), HashMap::<String, usize>::new());
    let mut key = String::new();
    // The first moment of each stream, and the time from there to the last row in nanoseconds.
    let mut clocks = Vec::<(Option<Moment>, i64)>::new();
    let (mut rows, mut repeated, mut taken_rows, mut last_row) = (0, 0_u64, None, 0);
    loop {
        let next = table.next(&mut record);
        let row = text_of(&record);
        if columns.end_before(&row) {
            break;
        }
        let Some(line) = next.map_err(broken)? else { break };
        rows += 1;
        if rows > MAX_FRAMES {
            return Err(at(line, Fault::ManyFrames));
        }
        let is_first = clocks.is_empty();
        let mut cells = match columns.read(&row, in_unit, options.signed) {
            Err(Fault::Cell { fault: Unreadable::TooLong(_), .. })
                if is_first && columns.is_of_mangohud() =>
            {
                continue;
            }
            cells => cells.map_err(|fault| at(line, fault))?,
        };
        key.clear();
        key.extend([cells.application, "\n", cells.process, "\n", cells.swap_chain]);
        let number = match numbers.get(&key) {
            Some(&number) => number,
            None if streams.len() == MAX_STREAMS => return Err(at(line, Fault::ManyStreams)),
            None => {
                numbers.insert(key.clone(), streams.len());
                streams.push(Stream::new(&cells, line));
                clocks.push((None, 0));
                streams.len() - 1
            }
        };
        let (first, elapsed_ns) = &mut clocks[number];
        if let Some(moment) = cells.moment {
            let is_first = first.is_none();
            let ns = if moment.is_of_calendar { 1.0 } else { in_unit.ns() };
            let since_ns = (moment.since(*first.get_or_insert(moment)) * ns).round() as i64;
            let step_ns = since_ns.saturating_sub(*elapsed_ns);
            if step_ns < 0 && options.shown.is_none() {
                return Err(at(line, Fault::TimeRunsBack));
            }
            if step_ns == 0 && !is_first && columns.is_list() {
                repeated += 1;
                continue;
            }
            cells.began_ns = Ok(step_ns);
            if !columns.has_display() {
                cells.displayed_ns = Some(step_ns);
            }
        }
        let is_new = first.is_none() && *elapsed_ns == 0 && streams[number].is_empty();
        let step_ns = cells.began_ns.as_ref().copied().unwrap_or_default();
        *elapsed_ns = elapsed_ns.saturating_add(if is_new { 0 } else { step_ns });
        let elapsed_s = *elapsed_ns as f64 / 1e9;
        let [start, end] = options.window_s;
        if start.is_some_and(|start| elapsed_s < start) || end.is_some_and(|end| elapsed_s >= end) {
            continue;
        }
        last_row = table.taken().0[1];
        taken_rows.get_or_insert(last_row);
        checks.add(&cells);
        streams[number].push(&cells).map_err(|fault| at(line, fault))?;
    }
    let of = table.count_rest();
    if taken_rows.is_none() && of > 0 && options.has_window() {
        return Err(at(header_line, Fault::NoneTaken { of }));
    }
    streams.retain(|stream| !stream.is_empty());
    if streams.is_empty() {
        return Err(at(header_line, Fault::NoRows));
    }
    if let Some(still) = streams.iter().find(|it| it.stands_still() && !options.signed) {
        return Err(at(still.line(), Fault::NoTimePasses { frames: still.frames() }));
    }
    let longest = streams.iter().max_by_key(|stream| stream.frames());
    checks.time_ratio = longest.and_then(Stream::time_ratio).filter(|_| columns.is_sure_of_time());
    let is_unit_known = unit.is_some() || is_own_time || checks.unit() == Some(Unit::Milliseconds);
    let sampled_ms = checks.sampled_ms().filter(|_| columns.fps.is_some() && is_unit_known);
    if let Some(sampled_ms) = sampled_ms {
        return Err(at(header_line, Fault::Sampled { every_ms: significant(sampled_ms, 3) }));
    }
    let names = names(name, &streams);
    let usual = [Unit::Milliseconds, Unit::Nanoseconds];
    let found = unit.or(columns.unit.filter(|unit| !usual.contains(unit)));
    let in_words = found.map(|unit| format!(", in {}", unit.name())).unwrap_or_default();
    let is_of_capframex = is_of_capframex(bytes) && columns.has_display();
    let format = if is_of_capframex { "CapFrameX" } else { columns.format };
    let format = format!("{format}{in_words}");
    let how = match () {
        () if options.unit.is_some() => "as told",
        () if course.is_of_calendar() && columns.is_since_start() => "by its form",
        () if by_size => "by size",
        () if columns.is_list() && names_unit => "by its heading",
        () if columns.is_list() => "by size",
        () => "by the format",
    };
    let used = columns.used();
    let left_out = header
        .iter()
        .enumerate()
        .filter(|(at, name)| !used.contains(at) && !name.trim().is_empty());
    let mut taken = Taken {
        rows: [taken_rows.unwrap_or(0), last_row],
        of,
        unit: Some((in_unit, how)),
        left_out: left_out.map(|(_, name)| name.trim().to_owned()).collect(),
        notes: Vec::new(),
    };
    if columns.is_list() && columns.is_since_start() {
        taken.notes.push("the times are those of a running clock".into());
    }
    if repeated > 0 {
        taken
            .notes
            .push(format!("{repeated} rows have the time of the row before, and are left out"));
    }
    if columns.counts_first() && checks.frames_ms.iter().all(|ms| ms.fract() == 0.0) {
        taken.notes.push("the times are whole milliseconds, and less is rounding".into());
    }
    let median_ms = median(&checks.frames_ms).unwrap_or(0.0);
    if median_ms > MAX_USUAL_MS {
        taken.notes.push(format!(
            "a frame lasts {}: check --unit",
            Unit::Milliseconds.seconds_in_words(median_ms)
        ));
    }
    let known = Some(ClockConflict::Rate).filter(|_| checks.is_rate_wrong());
    let trace = |(name, stream): (String, Stream)| {
        let counted = columns.counts_first().then(|| stream.counted());
        let trace = stream.into_trace(name, columns.is_sure_of_time(), known);
        let trace = trace.written_by(format.clone()).with_taken(taken.clone());
        let trace = trace.with_lead(counted);
        match (columns.has_display(), columns.has_one_clock()) {
            _ if trace.missing_display().is_some() => trace,
            (false, _) => trace.without_display(),
            (true, true) => trace.by_one_clock(),
            (true, false) => trace,
        }
    };
    Ok((names.into_iter().zip(streams).map(trace).collect(), checks))
}

/// Smallest median of a list that is in nanoseconds, and the longest median in milliseconds that needs no word.
const MIN_NS: f64 = 1e6;
const MAX_USUAL_MS: f64 = 1e5;

/// Returns a row as text, with bytes that are not UTF-8 replaced.
fn text_of(row: &ByteRecord) -> StringRecord {
    StringRecord::from_byte_record_lossy(row.clone())
}

/// Whether a log starts with the remarks of CapFrameX on the game and the machine.
fn is_of_capframex(bytes: &[u8]) -> bool {
    let head = head(bytes);
    head.starts_with("//") && head.contains("//GameName")
}

/// Returns the first bytes of a log as text, whatever its encoding.
fn head(bytes: &[u8]) -> String {
    let mut head = Vec::new();
    // A slice gives all its bytes without an error.
    let _ = Utf8::new(bytes).take(400).read_to_end(&mut head);
    String::from_utf8_lossy(&head).into_owned()
}

/// Whether a log is one of MSI Afterburner, whose rows begin with their kind, which is 00 for the head.
fn is_of_afterburner(bytes: &[u8]) -> bool {
    let head = head(bytes);
    head.trim_start().starts_with("00,") && head.contains("Hardware monitoring")
}
