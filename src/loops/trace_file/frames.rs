//! The frames of a log, by the program, process and window that each is of.

use std::collections::HashMap;

use csv::ByteRecord;

use super::columns::Cells;
use super::durations::Unreadable;
use super::layout::Layout;
use super::stream::Stream;
use super::{Fault, MAX_FRAMES, text_of};
use crate::sim::number::significant;
use crate::table::{Moment, TableError, TableOptions, TableReader, Unit, Utf8, median};

/// Maximum number of programs, processes and windows in a log. A system runs some hundred.
pub(super) const MAX_STREAMS: usize = 1000;

/// Hints at the unit of a log's times.
#[derive(Default)]
pub(super) struct Checks {
    /// Whether the log names its unit.
    names_unit: bool,
    /// Whether rows have the log's own time instead of frame times.
    is_own_time: bool,
    /// Frame times as if in milliseconds, and, if the log has frames per second, the products of both.
    pub(super) frames_ms: Vec<f64>,
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
    pub(super) fn unit(&self) -> Option<Unit> {
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
    pub(super) fn is_rate_wrong(&self) -> bool {
        let off = median(&self.products).map(|product| product / 1e3);
        off.is_some_and(|off| !(1.0 / MAX_RATE_OFF..MAX_RATE_OFF).contains(&off))
    }
}

/// Largest ratio between the averaged frames per second and those of the frame times, in the median row.
const MAX_RATE_OFF: f64 = 1.25;

/// The frames of a log.
#[derive(Default)]
pub(super) struct Frames {
    pub(super) streams: Vec<Stream>,
    pub(super) checks: Checks,
    /// First and last row that is taken, if there is one, and number of all rows.
    pub(super) taken: Option<[u64; 2]>,
    pub(super) of: u64,
    /// Number of rows with the time of the row before.
    pub(super) repeated: u64,
    /// Index of the stream of each program, process and window, and the latest of these keys.
    numbers: HashMap<String, usize>,
    key: String,
    /// The first moment of each stream, and the time from there to the last row in nanoseconds.
    clocks: Vec<(Option<Moment>, i64)>,
}

impl Frames {
    /// Reads the rows of a log. An error has its line.
    pub(super) fn read(
        table: &mut TableReader<Utf8<&[u8]>>,
        layout: &Layout,
        options: &TableOptions,
    ) -> Result<Self, (u64, Fault)> {
        let names_unit = layout.columns.unit.is_some() || layout.by_size;
        let is_own_time = layout.columns.is_since_start();
        let checks = Checks { names_unit, is_own_time, ..Checks::default() };
        let (mut all, mut rows, mut record) =
            (Self { checks, ..Self::default() }, 0, ByteRecord::new());
        loop {
            let next = table.next(&mut record);
            let row = text_of(&record);
            if layout.columns.end_before(&row) {
                break;
            }
            let broken = |TableError { line, fault }| (line, Fault::from(fault));
            let Some(line) = next.map_err(broken)? else { break };
            rows += 1;
            let is_taken = match layout.columns.read(&row, layout.in_unit, options.signed) {
                _ if rows > MAX_FRAMES => Err(Fault::ManyFrames),
                Err(Fault::Cell { fault: Unreadable::TooLong(_), .. })
                    if all.clocks.is_empty() && layout.columns.is_of_mangohud() =>
                {
                    Ok(false)
                }
                cells => cells.and_then(|cells| all.add(cells, line, layout, options)),
            };
            if is_taken.map_err(|fault| (line, fault))? {
                let row = table.taken().0[1];
                all.taken = Some([all.taken.map_or(row, |[first, _]| first), row]);
            }
        }
        all.of = table.count_rest();
        Ok(all)
    }

    /// Adds a row to its stream. Returns whether it is taken.
    fn add(
        &mut self,
        mut cells: Cells<'_>,
        line: u64,
        layout: &Layout,
        options: &TableOptions,
    ) -> Result<bool, Fault> {
        let number = self.number(&cells, line)?;
        let (first, elapsed_ns) = &mut self.clocks[number];
        if let Some(moment) = cells.moment {
            let is_first = first.is_none();
            let ns = if moment.is_of_calendar { 1.0 } else { layout.in_unit.ns() };
            let since_ns = (moment.since(*first.get_or_insert(moment)) * ns).round() as i64;
            let step_ns = since_ns.saturating_sub(*elapsed_ns);
            if step_ns < 0 && options.shown.is_none() {
                return Err(Fault::TimeRunsBack);
            }
            if step_ns == 0 && !is_first && layout.columns.is_list() {
                self.repeated += 1;
                return Ok(false);
            }
            cells.began_ns = Ok(step_ns);
            if !layout.columns.has_display() {
                cells.displayed_ns = Some(step_ns);
            }
        }
        let stream = &mut self.streams[number];
        let is_new = first.is_none() && *elapsed_ns == 0 && stream.is_empty();
        let step_ns = cells.began_ns.as_ref().copied().unwrap_or_default();
        *elapsed_ns = elapsed_ns.saturating_add(if is_new { 0 } else { step_ns });
        let elapsed_s = *elapsed_ns as f64 / 1e9;
        let [start, end] = options.window_s;
        if start.is_some_and(|start| elapsed_s < start) || end.is_some_and(|end| elapsed_s >= end) {
            return Ok(false);
        }
        self.checks.add(&cells);
        stream.push(&cells)?;
        Ok(true)
    }

    /// Returns the index of the stream that a row is of.
    fn number(&mut self, cells: &Cells<'_>, line: u64) -> Result<usize, Fault> {
        self.key.clear();
        self.key.extend([cells.application, "\n", cells.process, "\n", cells.swap_chain]);
        if let Some(&number) = self.numbers.get(&self.key) {
            return Ok(number);
        }
        let number = self.streams.len();
        if number == MAX_STREAMS {
            return Err(Fault::ManyStreams);
        }
        self.numbers.insert(self.key.clone(), number);
        self.streams.push(Stream::new(cells, line));
        self.clocks.push((None, 0));
        Ok(number)
    }

    /// Leaves out streams without a frame, and refuses rows that are no frames. An error has its line, or none if it is
    /// of the whole log.
    pub(super) fn judge(
        &mut self,
        layout: &Layout,
        options: &TableOptions,
    ) -> Result<(), (Option<u64>, Fault)> {
        let Self { streams, checks, of, .. } = self;
        if self.taken.is_none() && *of > 0 && options.has_window() {
            return Err((None, Fault::NoneTaken { of: *of }));
        }
        streams.retain(|stream| !stream.is_empty());
        let Some(longest) = streams.iter().max_by_key(|stream| stream.frames()) else {
            return Err((None, Fault::NoRows));
        };
        if let Some(still) = streams.iter().find(|it| it.stands_still() && !options.signed) {
            let fault = Fault::NoTimePasses { frames: still.frames() };
            return Err((Some(still.line()), fault));
        }
        let columns = &layout.columns;
        checks.time_ratio = longest.time_ratio().filter(|_| columns.is_sure_of_time());
        let is_unit_known = layout.unit.is_some()
            || columns.is_since_start()
            || checks.unit() == Some(Unit::Milliseconds);
        let is_sampled = columns.fps.is_some() && is_unit_known;
        match checks.sampled_ms().filter(|_| is_sampled) {
            Some(ms) => Err((None, Fault::Sampled { every_ms: significant(ms, 3) })),
            None => Ok(()),
        }
    }
}
