//! Traces from the logs of frame-time tools: PresentMon, OCAT, CapFrameX, FrameView and MangoHud write a row for each
//! frame, and a person a list of frame times in milliseconds, one a line.
//!
//! A log can hold several streams of frames, from several programs and windows; each is a trace of its own. The first row
//! of a stream starts its clock. From then on a frame begins `MsBetweenPresents` after the one before, and is displayed
//! `MsBetweenDisplayChange` after the last one displayed. The two clocks have no common origin in these columns, so that a
//! frame's display may lie before its beginning: differences within each clock count, not their offset. Where a log has no
//! times of display, frames are taken as displayed when they begin, and the trace [says so](FrameTrace::missing_display).

mod columns;
mod milliseconds;
mod stream;

use std::collections::{HashMap, HashSet};

use csv::StringRecord;

use super::trace::FrameTrace;
use columns::Columns;
use milliseconds::Unreadable;
use stream::Stream;

/// The most rows before the header.
const MAX_PREAMBLE_ROWS: u32 = 8;

/// Why a log cannot be read, with its place and a remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {fault}")]
pub struct TraceFileError {
    /// What the caller calls the log.
    pub name: String,
    /// The line of the fault, from 1.
    pub line: u64,
    fault: Fault,
}

/// What can be wrong with a log of frames.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
enum Fault {
    #[error(
        "there is nothing here; capture some frames with PresentMon, OCAT, CapFrameX, FrameView or MangoHud"
    )]
    Empty,
    #[error("the text is in UTF-16, as PowerShell writes it; save it as UTF-8")]
    Utf16,
    #[error("there is a header and no frame of a program below it; capture some frames")]
    NoRows,
    #[error(
        "the columns MsBetweenPresents, alone or with MsBetweenDisplayChange, FrameTime and DisplayedTime, or MangoHud's fps and frametime, are needed, and here are {found}; write a row for each frame under a header, or frame times in milliseconds alone, one a line"
    )]
    Columns { found: String },
    #[error("the row has {cells} of the header's {header} cells; take it out if it was cut off")]
    FewCells { cells: usize, header: usize },
    #[error(
        "the row has {cells} cells and the header {header}; if its numbers have decimal commas, write points, or separate the cells with semicolons"
    )]
    ManyCells { cells: usize, header: usize },
    #[error("column {column}: {fault}")]
    Cell { column: String, fault: Unreadable },
    #[error("column {column}: the time of this frame is missing; take the row out")]
    NoTime { column: String },
    #[error(
        "column {column}: expected 0 or 1, found \"{cell}\"; write 1 for a frame that was not displayed"
    )]
    NotAFlag { column: String, cell: String },
    #[error("no time passes from here to the last of these {frames} frames; capture them again")]
    NoTimePasses { frames: usize },
    #[error("from here on the frames last more than a year in all; split the log")]
    TooLong,
}

/// Reads the streams of a log from the bytes of a file, like [`read`]; what is not UTF-8 is read as well as it can be.
///
/// # Errors
/// As [`read`], and if the bytes are UTF-16.
pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Vec<FrameTrace>, TraceFileError> {
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        return Err(TraceFileError { name: name.into(), line: 1, fault: Fault::Utf16 });
    }
    read(name, &String::from_utf8_lossy(bytes))
}

/// Reads the streams of a log in order of their first rows. A lone stream is called `name`, several are called `name`, a
/// colon and their program, with its process and a number where these are needed to tell them apart.
///
/// # Errors
/// If the text is not such a log; the message calls it `name`.
pub fn read(name: &str, text: &str) -> Result<Vec<FrameTrace>, TraceFileError> {
    let at = |line, fault| TraceFileError { name: name.into(), line, fault };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (before, table) = split_remarks(text);
    let is_list = is_list(table);
    let mut rows = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(if is_list { b';' } else { delimiter(table) })
        .from_reader(table.as_bytes());
    let mut row = StringRecord::new();
    let mut next = |row: &mut StringRecord| -> Option<u64> {
        let is_row = rows.read_record(row).expect("text in memory, and rows of any length");
        is_row.then(|| before + row.position().expect("just read").line())
    };

    let first_line = next(&mut row).ok_or_else(|| at(1, Fault::Empty))?;
    let found = if is_list { Ok(Columns::of_list()) } else { Columns::find(&row) };
    let (mut header_line, mut found) = (first_line, found);
    // MangoHud writes a few lines about the machine first.
    let mut preamble = StringRecord::new();
    for _ in 0..MAX_PREAMBLE_ROWS {
        if found.is_ok() {
            break;
        }
        let Some(line) = next(&mut preamble) else { break };
        if let Ok(columns) = Columns::find(&preamble) {
            (header_line, found) = (line, Ok(columns));
        }
    }
    let columns = found.map_err(|fault| at(first_line, fault))?;

    let (mut streams, mut numbers) = (Vec::<Stream>::new(), HashMap::<String, usize>::new());
    let mut key = String::new();
    // A list has no header.
    let mut first = is_list.then_some(first_line);
    while let Some(line) = first.take().or_else(|| next(&mut row)) {
        let cells = columns.read(&row).map_err(|fault| at(line, fault))?;
        key.clear();
        key.extend([cells.application, "\n", cells.process, "\n", cells.swap_chain]);
        let number = match numbers.get(&key) {
            Some(&number) => number,
            None => {
                numbers.insert(key.clone(), streams.len());
                streams.push(Stream::new(&cells, line));
                streams.len() - 1
            }
        };
        streams[number].push(&cells).map_err(|fault| at(line, fault))?;
    }
    streams.retain(|stream| !stream.is_empty());
    if streams.is_empty() {
        return Err(at(header_line, Fault::NoRows));
    }
    if let Some(still) = streams.iter().find(|stream| stream.stands_still()) {
        return Err(at(still.line(), Fault::NoTimePasses { frames: still.frames() }));
    }
    let names = names(name, &streams);
    let has_display = columns.has_display();
    let trace = |(name, stream): (String, Stream)| match stream.into_trace(name) {
        trace if has_display => trace,
        trace => trace.without_display(),
    };
    Ok(names.into_iter().zip(streams).map(trace).collect())
}

/// Whether the table begins with a line that is a number: the times of frames in milliseconds, and nothing else.
fn is_list(table: &str) -> bool {
    let first = table.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    matches!(milliseconds::nanoseconds(first), Ok(Some(_)))
}

/// The number of lines before the table, and the table: CapFrameX writes remarks that begin with `//` first.
fn split_remarks(text: &str) -> (u64, &str) {
    let (mut lines, mut rest) = (0, text);
    while rest.starts_with("//") {
        lines += 1;
        rest = rest.split_once('\n').map_or("", |(_, after)| after);
    }
    (lines, rest)
}

/// What separates the cells: where a comma is the decimal sign, tools write semicolons.
pub(crate) fn delimiter(table: &str) -> u8 {
    let header = table.lines().find(|line| !line.is_empty()).unwrap_or_default();
    let count = |separator: &u8| header.bytes().filter(|byte| byte == separator).count();
    // Of equal counts the last is taken: the comma.
    [b'\t', b';', b','].into_iter().max_by_key(count).expect("three")
}

/// A name for each stream, none twice.
fn names(name: &str, streams: &[Stream]) -> Vec<String> {
    if streams.len() == 1 {
        return vec![name.into()];
    }
    let mut programs = HashMap::<&str, usize>::new();
    for stream in streams {
        *programs.entry(stream.application()).or_default() += 1;
    }
    let mut taken = HashSet::new();
    let mut labels = HashMap::<String, usize>::new();
    let unique = |stream: &Stream| {
        let (program, process) = (stream.application(), stream.process());
        let known: Vec<&str> = [program, process].into_iter().filter(|s| !s.is_empty()).collect();
        let alone = programs[program] == 1 && !program.is_empty();
        let label = match known[..] {
            [] => "stream".to_owned(),
            _ if alone => program.to_owned(),
            _ => known.join("-"),
        };
        let count = labels.entry(label.clone()).or_default();
        loop {
            *count += 1;
            let numbered = match *count {
                1 => format!("{name}:{label}"),
                n => format!("{name}:{label}-{n}"),
            };
            if taken.insert(numbered.clone()) {
                return numbered;
            }
        }
    };
    streams.iter().map(unique).collect()
}
