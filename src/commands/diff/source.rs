//! Sources of the rows to compare: a table, or a run of a scene, a recording or a capture.

use std::cell::OnceCell;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use csv::ByteRecord;

use crate::commands::captured::read_run;
use crate::commands::error::Error;
use crate::commands::settings::CapturedRun;
use crate::commands::{scene_file, verify};
use crate::regular_file::{self, Unreadable};
use crate::run::diff::{NotComparable, Records, is_header};
use crate::run::trace::Made;
use crate::scene::clip_list;
use crate::table::{
    BUFFER_BYTES, Heading, MAX_ROW_BYTES, Reading, TableError, TableFault, TableOptions,
    TableReader, Taken, Unit, Utf8, column,
};

/// Maximum number of rows in a batch that is passed between threads.
const BATCH: usize = 1024;
/// Maximum number of bytes in a batch that is passed between threads. Long rows reach this limit first.
const BATCH_BYTES: usize = 1 << 20;
/// Maximum size of a row buffer that is used again, in bytes. A larger buffer is dropped to free its memory.
const LARGE_ROW_BYTES: usize = 1 << 14;
/// The rows of one run.
pub(super) enum Source {
    Table(Table),
    Dump(Dump),
    Made(Made),
}

/// A table, which a separate thread reads.
pub(super) struct Table {
    header: ByteRecord,
    batch: Vec<ByteRecord>,
    /// Number of rows in the batch, and number of rows already taken from it.
    filled: usize,
    taken: usize,
    batches: Receiver<Result<Batch, Error>>,
    used: SyncSender<Vec<ByteRecord>>,
    /// The rows that were taken, once all are read.
    ends: Receiver<Taken>,
    taken_rows: OnceCell<Taken>,
}

/// A dump of text, whose rows are its lines, each with the moment above it.
pub(super) struct Dump {
    input: Box<dyn BufRead + Send>,
    name: String,
    header: ByteRecord,
    moment: u64,
    line: u64,
    /// Number of the line in the file.
    at: u64,
}

/// Buffers of rows, and the number of buffers that are filled.
type Batch = (Vec<ByteRecord>, usize);

impl Source {
    /// Opens the table or the run at `path`.
    pub(super) fn open(path: &Path, options: &TableOptions) -> Result<Self, Error> {
        let is_scene = scene_file::is_link(path)
            || scene_file::is_built_in(path) && !path.exists()
            || path.extension().is_some_and(|ending| ending == "toml");
        if path.is_dir() {
            return Ok(Self::Made(of_capture(path)?));
        }
        if is_scene {
            return Ok(Self::Made(of_scene(path)?));
        }
        let is_standard = path.as_os_str() == "-";
        let name = if is_standard { "standard input".into() } else { path.display().to_string() };
        let input: Box<dyn Read + Send> = match is_standard {
            true => Box::new(io::stdin()),
            false => Box::new(regular_file::open(path).map_err(|error| {
                let path = path.display();
                let or_pipe = match error {
                    Unreadable::NotRegular => ", or give - for standard input",
                    _ => "",
                };
                Error::mistake(format!("cannot read {path}: {error}{or_pipe}"))
            })?),
        };
        let mut input: Box<dyn BufRead + Send> =
            Box::new(Utf8::new(BufReader::with_capacity(BUFFER_BYTES, input)));
        let mut start = Vec::new();
        let read = (&mut input).take(DUMP_BYTES).read_to_end(&mut start);
        read.map_err(|error| Error::mistake(format!("cannot read {name}: {error}")))?;
        let moment =
            if *options == TableOptions::default() { moment_of_dump(&start) } else { None };
        let input: Box<dyn BufRead + Send> = Box::new(io::Cursor::new(start).chain(input));
        match moment {
            Some(word) => Ok(Self::Dump(Dump::begin(name, input, &word))),
            None => Table::begin(name, input, options.clone()).map(Self::Table),
        }
    }

    /// Returns the name of a column that is named or numbered.
    pub(super) fn name_of(&self, wanted: &str) -> String {
        let at = column(self.header(), wanted);
        at.map_or(wanted.to_owned(), |at| {
            String::from_utf8_lossy(&self.header()[at]).trim().to_owned()
        })
    }

    /// Returns the name of a dump's moments.
    pub(super) fn moment_of_dump(&self) -> Option<&str> {
        match self {
            Self::Dump(dump) => std::str::from_utf8(&dump.header[0]).ok(),
            _ => None,
        }
    }

    /// Whether this is a dump of text.
    pub(super) fn is_dump(&self) -> bool {
        matches!(self, Self::Dump(_))
    }

    /// Returns the rows that were taken of a table, once all are read.
    pub(super) fn taken(&self) -> Option<Taken> {
        let Self::Table(table) = self else { return None };
        if table.taken_rows.get().is_none() {
            drop(table.taken_rows.set(table.ends.try_recv().ok()?));
        }
        table.taken_rows.get().cloned()
    }
}

impl Records for Source {
    type Error = Error;

    fn header(&self) -> &ByteRecord {
        match self {
            Self::Table(Table { header, .. }) | Self::Dump(Dump { header, .. }) => header,
            Self::Made(made) => made.header(),
        }
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        match self {
            Self::Table(table) => table.next(row),
            Self::Dump(dump) => dump.next(row),
            Self::Made(made) => Ok(made.next(row)?),
        }
    }
}

impl From<NotComparable> for Error {
    fn from(error: NotComparable) -> Self {
        Error::mistake(error)
    }
}

/// Returns the size of a row in memory, in bytes.
fn footprint(row: &ByteRecord) -> usize {
    row.as_slice().len() + row.len() * size_of::<usize>()
}

impl Table {
    fn begin(
        name: String,
        input: Box<dyn BufRead + Send>,
        options: TableOptions,
    ) -> Result<Self, Error> {
        let time = options.time().map(str::to_owned);
        let (unit, has_window) = (options.unit, options.has_window());
        let of = name.clone();
        let fault = move |TableError { line, fault }: TableError| {
            Error::mistake(match &fault {
                TableFault::Empty => format!("{of} is empty; give a table with a header"),
                TableFault::Input(_) => {
                    format!("{of}:{line}: {fault}; give a table that you may read")
                }
                TableFault::Json(_)
                | TableFault::NoColumn { .. }
                | TableFault::NoneTaken { .. } => {
                    format!("{of}:{line}: {fault}")
                }
                TableFault::Cells { .. } => format!(
                    "{of}:{line}: {fault}; give each row the header's cells, and notes a place above the header"
                ),
            })
        };
        let begun = TableReader::begin(input, Reading { options, ..Reading::default() }, is_header);
        let mut reader = begun.map_err(&fault)?;
        let mut header = reader.header().clone();
        let wanted = time.as_deref().unwrap_or("t");
        let at = column(&header, wanted);
        if let (None, true) = (at, time.is_some() || has_window) {
            let here = header.iter().map(|name| String::from_utf8_lossy(name).into_owned());
            let here: Vec<String> = here.collect();
            let here = clip_list(here.iter().map(String::as_str));
            return Err(Error::mistake(format!(
                "{name} has no column {wanted:?}; here are {here}; name the times with --t-column"
            )));
        }
        if let Some(at) = at {
            let heading = Heading::of(&String::from_utf8_lossy(&header[at]));
            reader.limit_by(at, unit.or(heading.unit).unwrap_or(Unit::Seconds));
            let is_time =
                |(own, name): (usize, &[u8])| if own == at { b"t".to_vec() } else { name.to_vec() };
            header = header.iter().enumerate().map(is_time).collect::<Vec<_>>().into();
        }
        let (end, ends) = sync_channel(1);
        let (send, batches) = sync_channel(2);
        let (used, reuse) = sync_channel::<Vec<ByteRecord>>(4);
        thread::spawn(move || {
            loop {
                let mut batch = reuse.try_recv().unwrap_or_default();
                batch.resize_with(BATCH, ByteRecord::new);
                let large = batch.iter_mut().filter(|row| footprint(row) > LARGE_ROW_BYTES);
                large.for_each(|row| *row = ByteRecord::new());
                let (mut filled, mut bytes) = (0, 0);
                let read = loop {
                    match reader.next_with_points(&mut batch[filled]) {
                        Ok(Some(_)) => {
                            bytes += footprint(&batch[filled]);
                            filled += 1;
                        }
                        other => break other,
                    }
                    if filled == BATCH || bytes >= BATCH_BYTES {
                        break Ok(Some(0));
                    }
                };
                let has_more = matches!(read, Ok(Some(_)));
                // The receiver is gone if there was an error in the other table.
                let is_heard = send.send(Ok((batch, filled))).is_ok();
                if let Err(error) = read {
                    drop(send.send(Err(fault(error))));
                }
                if !has_more || !is_heard {
                    let (rows, of) = reader.taken();
                    drop(end.send(Taken { rows, of, ..Taken::default() }));
                    return;
                }
            }
        });
        let taken_rows = OnceCell::new();
        Ok(Self { header, batch: Vec::new(), filled: 0, taken: 0, batches, used, ends, taken_rows })
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        if self.taken == self.filled {
            let Ok(next) = self.batches.recv() else { return Ok(false) };
            let (batch, filled) = next?;
            // The batch is dropped if the channel is full, and the reader then allocates another one.
            drop(self.used.try_send(std::mem::replace(&mut self.batch, batch)));
            (self.filled, self.taken) = (filled, 0);
            if filled == 0 {
                return self.next(row);
            }
        }
        std::mem::swap(row, &mut self.batch[self.taken]);
        self.taken += 1;
        Ok(true)
    }
}

/// Number of bytes by which a dump is recognised.
const DUMP_BYTES: u64 = 1 << 12;

/// Splits a line such as `Frame: 1000` into its word and its number.
fn moment_in(line: &str) -> Option<(&str, u64)> {
    let (word, number) = line.trim().split_once([':', '='])?;
    let number = number.trim().parse().ok()?;
    word.chars()
        .all(|sign| sign.is_alphabetic())
        .then_some((word, number))
        .filter(|_| !word.is_empty())
}

/// Returns the word of the moments in a dump that starts so.
fn moment_of_dump(start: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(start);
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let (word, _) = moment_in(lines.next()?)?;
    // A table may have such lines above its header.
    let is_of_time =
        ["frame", "tick", "step", "turn", "time", "update"].contains(&&*word.to_lowercase());
    let comes_again = lines.any(|line| moment_in(line).is_some_and(|(own, _)| own == word));
    (is_of_time || comes_again).then(|| word.to_owned())
}

impl Dump {
    fn begin(name: String, input: Box<dyn BufRead + Send>, word: &str) -> Self {
        let header = ByteRecord::from(vec![word.to_lowercase().as_str(), "line", "text"]);
        Self { input, name, header, moment: 0, line: 0, at: 0 }
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        let mut text = Vec::new();
        loop {
            text.clear();
            self.at += 1;
            let read = (&mut self.input).take(MAX_ROW_BYTES as u64).read_until(b'\n', &mut text);
            let read = read.map_err(|error| {
                Error::mistake(format!(
                    "{}:{}: {error}; give a file that you may read",
                    self.name, self.at
                ))
            })?;
            if read == 0 {
                return Ok(false);
            }
            let line = String::from_utf8_lossy(text.trim_ascii_end());
            self.line += 1;
            match moment_in(&line) {
                Some((word, number)) if word.to_lowercase().as_bytes() == &self.header[0] => {
                    (self.moment, self.line) = (number, 0);
                }
                _ if line.is_empty() => continue,
                _ => {}
            }
            let [moment, number] = [self.moment, self.line].map(|number| number.to_string());
            *row = ByteRecord::from(vec![moment.as_str(), &number, &line]);
            return Ok(true);
        }
    }
}

/// Returns the run of the scene or recording at `path`, up to its end or to its last check.
fn of_scene(path: &Path) -> Result<Made, Error> {
    let scene = scene_file::load(path)?.0;
    let last = verify::recording::end_of(path, &scene)?;
    Ok(Made::of_scene(scene, last))
}

/// Returns the run of the capture in `dir`, made again, up to its last state.
fn of_capture(dir: &Path) -> Result<Made, Error> {
    let (CapturedRun { experiment, checks, .. }, _) = read_run(dir)?;
    let last = checks.last().map_or(0, |check| check.tick);
    Ok(Made::of_session(experiment.studio().run().session().clone(), last))
}
