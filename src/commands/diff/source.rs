//! Sources of the rows to compare: a table, a run, or the states in a manifest.

use std::io::{self, BufReader, Read};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use csv::ByteRecord;

use crate::commands::captured::{CapturedRun, read_run};
use crate::commands::error::Error;
use crate::commands::manifest::Mark;
use crate::commands::{scene_file, verify};
use crate::regular_file::{self, Unreadable};
use crate::run::diff::{NotComparable, Records, is_header};
use crate::run::trace::{Made, row};
use crate::table::{BUFFER_BYTES, Reading, TableError, TableFault, TableReader, Utf8};

/// Maximum number of rows in a batch that is passed between threads.
const BATCH: usize = 1024;
/// Maximum number of bytes in a batch that is passed between threads. Long rows reach this limit first.
const BATCH_BYTES: usize = 1 << 20;
/// Maximum size of a row buffer that is used again, in bytes. A larger buffer is dropped to free its memory.
const LARGE_ROW_BYTES: usize = 1 << 14;
/// The rows of one run.
pub(super) enum Source {
    Table(Table),
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
}

/// Buffers of rows, and the number of buffers that are filled.
type Batch = (Vec<ByteRecord>, usize);

impl Source {
    /// Opens the table or the run at `path`.
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
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
        Table::begin(name, input).map(Self::Table)
    }
}

impl Records for Source {
    type Error = Error;

    fn header(&self) -> &ByteRecord {
        match self {
            Self::Table(Table { header, .. }) => header,
            Self::Made(made) => made.header(),
        }
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        match self {
            Self::Table(table) => table.next(row),
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
    fn begin(name: String, input: Box<dyn Read + Send>) -> Result<Self, Error> {
        let input = Utf8::new(BufReader::with_capacity(BUFFER_BYTES, input));
        let of = name.clone();
        let fault = move |TableError { line, fault }: TableError| {
            Error::mistake(match &fault {
                TableFault::Empty => format!("{of} is empty; give a table with a header"),
                TableFault::Input(_) => {
                    format!("{of}:{line}: {fault}; give a table that you may read")
                }
                TableFault::Cells { .. } => format!(
                    "{of}:{line}: {fault}; give each row the header's cells, and notes a place above the header"
                ),
            })
        };
        let begun = TableReader::begin(input, Reading::default(), is_header);
        let mut reader = begun.map_err(&fault)?;
        let header = reader.header().clone();
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
                    return;
                }
            }
        });
        Ok(Self { header, batch: Vec::new(), filled: 0, taken: 0, batches, used })
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

/// Returns the run of the scene or recording at `path`, up to its end or to its last check.
fn of_scene(path: &Path) -> Result<Made, Error> {
    let scene = scene_file::load(path)?.0;
    let last = verify::recording::end_of(path, &scene)?;
    Ok(Made::of_scene(scene, last))
}

/// Returns the run whose states are in the manifest of the capture in `dir`.
fn of_capture(dir: &Path) -> Result<Made, Error> {
    let CapturedRun { manifest, experiment, .. } = read_run(dir)?;
    let studio = experiment.studio();
    let tick_s = manifest.settings.tick_hz.step_s();
    let mut marks = manifest.marks.into_iter();
    Ok(Made::new(move || {
        let Mark { tick, lanes } = marks.next()?;
        let (t, tick) = (format!("{:?}", tick as f64 * tick_s), tick.to_string());
        let mut rows = Vec::new();
        for ((number, mark), entrant) in (1..).zip(lanes).zip(studio.race().entrants()) {
            let at = [&tick, &t, &format!("{number}"), entrant.spec.method.id];
            let bodies = entrant.lane.bodies().iter().zip(&studio.scene().bodies);
            for ((body, named), (q, v)) in bodies.zip(mark.q.iter().zip(&mark.v)) {
                for (coordinate, values) in body.coordinates().iter().zip(q.iter().zip(v)) {
                    rows.push(row(at, &named.name, &coordinate.name, [*values.0, *values.1]));
                }
            }
        }
        Some(rows)
    }))
}
