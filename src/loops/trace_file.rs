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
mod frames;
mod layout;
mod names;
mod stream;
mod survey;

use std::io::Read as _;

use csv::{ByteRecord, StringRecord};

use super::trace::{ClockConflict, FrameTrace};
use columns::Columns;
use durations::Unreadable;
use frames::{Checks, Frames};
use layout::Layout;
use names::names;
use stream::Stream;
use survey::Survey;

use crate::table::{
    Reading, TableError, TableFault, TableOptions, TableReader, Taken, Unit, Utf8, median,
};

/// Maximum number of rows of a log: two hours of frames at 144 Hz.
const MAX_FRAMES: usize = 1 << 20;

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
    #[error("the log has more than {} programs and windows; take some out", frames::MAX_STREAMS)]
    ManyStreams,
}

impl From<TableFault> for Fault {
    fn from(fault: TableFault) -> Self {
        match fault {
            TableFault::Empty => Self::Empty,
            fault => Self::Unreadable(fault.to_string()),
        }
    }
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

/// Reads the streams of a log with times in this unit or, if none is given, in the unit of the log's format.
fn read_in(
    name: &str,
    bytes: &[u8],
    unit: Option<Unit>,
    options: &TableOptions,
) -> Result<(Vec<FrameTrace>, Checks), TraceFileError> {
    let at = |line, fault| TraceFileError { name: name.into(), line, fault };
    let is_header = |row: &ByteRecord| Columns::may_be_of(&text_of(row), options);
    // OCAT describes the machine in the first row only.
    let begin = || {
        let options = options.clone();
        let reading =
            Reading { short_rows: true, remarks: true, lists: true, headless: true, options };
        TableReader::begin(Utf8::new(bytes), reading, is_header)
            .map_err(|TableError { line, fault }| at(line, fault.into()))
    };
    let mut table = begin()?;
    let (header_line, header) = (table.header_line(), text_of(table.header()));
    let layout = Layout::of((bytes, header, &Survey::of(&mut begin()?)), unit, options)
        .map_err(|fault| at(header_line, fault))?;
    let mut frames =
        Frames::read(&mut table, &layout, options).map_err(|(line, fault)| at(line, fault))?;
    frames
        .judge(&layout, options)
        .map_err(|(line, fault)| at(line.unwrap_or(header_line), fault))?;
    let taken = taken(&layout, &frames, options);
    let Frames { streams, checks, .. } = frames;
    let Layout { columns, unit, .. } = layout;
    let usual = [Unit::Milliseconds, Unit::Nanoseconds];
    let found = unit.or(columns.unit.filter(|unit| !usual.contains(unit)));
    let in_words = found.map(|unit| format!(", in {}", unit.name())).unwrap_or_default();
    let is_of_capframex = is_of_capframex(bytes) && columns.has_display();
    let format = if is_of_capframex { "CapFrameX" } else { columns.format };
    let format = format!("{format}{in_words}");
    let known = Some(ClockConflict::Rate).filter(|_| checks.is_rate_wrong());
    let names = names(name, &streams);
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

/// Longest median of frame times in milliseconds that needs no word.
const MAX_USUAL_MS: f64 = 1e5;

/// Returns the part of a log that is taken, with the remarks on it.
fn taken(layout: &Layout, frames: &Frames, options: &TableOptions) -> Taken {
    let (columns, frames_ms) = (&layout.columns, &frames.checks.frames_ms);
    let mut notes = Vec::new();
    if columns.is_list() && columns.is_since_start() {
        notes.push("the times are those of a running clock".into());
    }
    if frames.repeated > 0 {
        notes.push(format!(
            "{} rows have the time of the row before, and are left out",
            frames.repeated
        ));
    }
    if columns.counts_first() && frames_ms.iter().all(|ms| ms.fract() == 0.0) {
        notes.push("the times are whole milliseconds, and less is rounding".into());
    }
    let median_ms = median(frames_ms).unwrap_or(0.0);
    if median_ms > MAX_USUAL_MS {
        let lasts = Unit::Milliseconds.seconds_in_words(median_ms);
        notes.push(format!("a frame lasts {lasts}: check --unit"));
    }
    Taken {
        rows: frames.taken.unwrap_or_default(),
        of: frames.of,
        unit: Some((layout.in_unit, layout.unit_is_known(options))),
        left_out: layout.left_out(),
        notes,
    }
}

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
