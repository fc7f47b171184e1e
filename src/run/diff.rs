//! Finds where two runs first differ, and how the difference grows.
//!
//! A run is a table. Key columns identify a row. They are `tick` or, if there is none, `t` or, if there is none either,
//! the row's position. In addition, `lane`, `body` and `coordinate` are key columns. A caller may name [other key
//! columns](Chosen). By default, `t` and `method` are not compared, and all other columns hold values.
//!
//! A column is numeric until one of its cells is not a number; then all of it is text. Rows with equal keys form a pair
//! if at most [`MAX_WAITING`] rows lie between them, so memory does not grow with the number of rows. It grows with the
//! number of distinct keys, up to a limit.

use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::io::BufRead;

use csv::ByteRecord;

use crate::table::{Decimal, Reading, TableError, TableReader, number};

mod clock;
mod findings;
mod growth;
mod layout;
mod number;
mod side;

use clock::{ClockCheck, Moves};
pub use findings::{ColumnDifference, Comparison, Difference};
use growth::Growth;
pub use layout::{Chosen, NotComparable};
use layout::{ColumnLayout, ValueColumn};
pub use number::{distance_ulps, is_same_number};
use number::{hide_a_difference, is_text, parsed, relative};
use side::{Place, Side, Waiting};

/// Relative differences for which a comparison reports the first tick.
pub const LEVELS: [f64; 5] = [1e-12, 1e-9, 1e-6, 1e-3, 1.0];
/// Maximum number of rows of one side that may wait for their counterparts. A row that waits longer counts as missing
/// on the other side.
pub const MAX_WAITING: usize = 1 << 16;
/// Maximum number of bytes of the waiting rows. Long rows reach this limit first.
const MAX_WAITING_BYTES: usize = 64 << 20;
/// Maximum number of bytes for distinct keys: 256 MiB, enough for a million keys with few columns.
const MAX_NAME_BYTES: usize = 256 << 20;
/// Number of bytes of a key besides its cells and values, for its table entry and the heads of its lists.
const NAME_BYTES: usize = 192;

/// A run as a sequence of rows.
pub trait Records {
    /// The reason why a row cannot be read.
    type Error;

    /// Returns the names of the columns.
    fn header(&self) -> &ByteRecord;

    /// Reads the next row, with one cell for each column of the header; returns `false` after the last row.
    ///
    /// # Errors
    /// If the row cannot be read.
    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Self::Error>;
}

/// Whether a row can be a header, which has several names, none of them a number.
pub fn is_header(row: &ByteRecord) -> bool {
    let is_name = |cell: &[u8]| {
        !cell.trim_ascii().is_empty() && number(cell, Decimal::PointOrComma).is_none()
    };
    row.len() > 1 && row.iter().all(is_name)
}

/// Reads `text` as a table.
///
/// # Errors
/// If the header of the table cannot be read.
pub fn table(text: &str) -> Result<TableReader<&[u8]>, TableError> {
    TableReader::begin(text.as_bytes(), Reading::default(), is_header)
}

impl<R: BufRead> Records for TableReader<R> {
    type Error = TableError;

    fn header(&self) -> &ByteRecord {
        self.header()
    }

    /// Reads a row, with numbers written with decimal points.
    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, TableError> {
        Ok(self.next_with_points(row)?.is_some())
    }
}

/// Limits within which two numbers count as equal; it is enough if one of the limits holds. By default only identical
/// numbers are equal, where NaN equals NaN and 0 equals −0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// Largest distance of two numbers, counted in doubles.
    pub ulps: u64,
    /// Largest difference relative to the larger number.
    pub relative: f64,
}

/// The rows with one key, such as a coordinate of a body in a lane.
struct Stream {
    /// Cells of the key columns, each followed by a zero byte.
    key: Vec<u8>,
    /// First finite value (or NaN) and largest magnitude so far, for each value column.
    values: Vec<[f64; 2]>,
    /// Course of each value column that may be a clock.
    courses: Vec<ClockCheck>,
    /// Hash of the first cell, for each text column.
    texts: Vec<Option<u64>>,
}

/// Findings about one value column.
#[derive(Clone, Debug, Default)]
struct ColumnState {
    /// Largest relative difference.
    worst: f64,
    /// Largest distance of a value from the first value of its stream.
    moved: f64,
    /// First tick at which the difference reaches each of [`LEVELS`].
    reaches: [Option<u64>; LEVELS.len()],
    /// Index of the column's course among those of a stream, while the column may still be a clock.
    course: Option<usize>,
    /// Whether any cell of the column was not a number.
    is_text: bool,
    /// Whether the text changes between rows with the same key.
    changes: bool,
    /// Order and number of the first row that differs.
    first: Option<(u64, u64)>,
    rows: u64,
    /// The first difference in spelling between numbers that count as equal. It counts once the column turns out to
    /// be text.
    hidden: Option<((u64, u64), Difference)>,
    hidden_rows: u64,
}

/// Compares two runs.
///
/// # Errors
/// If a row cannot be read, or if the tables do not fit together.
pub fn diff<A, B, E>(
    a: &mut A,
    b: &mut B,
    tolerance: Tolerance,
    chosen: &Chosen,
) -> Result<Comparison, E>
where
    A: Records,
    B: Records,
    E: From<A::Error> + From<B::Error> + From<NotComparable>,
{
    let layout = ColumnLayout::of([a.header(), b.header()], chosen)?;
    let mut work = Work::new(layout, tolerance);
    let mut rows = [ByteRecord::new(), ByteRecord::new()];
    let mut places: [Option<(Place, u64)>; 2] = [None; 2];
    loop {
        for side in 0..2 {
            if places[side].is_some() {
                continue;
            }
            let row = &mut rows[side];
            let is_there = if side == 0 { a.next(row)? } else { b.next(row)? };
            if is_there {
                places[side] = Some(work.place(side, row)?);
            }
        }
        match places {
            [None, None] => break,
            [Some((one, number)), Some((other, _))] if one == other => {
                work.compare_rows(one, number, [&rows[0], &rows[1]]);
                places = [None; 2];
            }
            // Only the side that is behind advances. Then both sides line up again after a row that one side lacks.
            [one, other] => {
                let order =
                    |it: Option<(Place, u64)>| it.map_or(u64::MAX, |(place, _)| place.order);
                let goes = [order(one) <= order(other), order(other) <= order(one)];
                for side in (0..2).filter(|side| goes[*side]) {
                    if let Some((place, number)) = places[side].take() {
                        work.pair_or_queue(side, place, number, &mut rows[side]);
                    }
                }
            }
        }
    }
    Ok(work.close())
}

/// A comparison in progress.
struct Work {
    layout: ColumnLayout,
    tolerance: Tolerance,
    streams: Vec<Stream>,
    by_key: HashMap<Vec<u8>, usize>,
    key: Vec<u8>,
    sides: [Side; 2],
    found: Comparison,
    /// Whether rows are out of order. If they are, the counterpart of a row that waited too long may still follow.
    is_out_of_order: bool,
    /// Order and number of the first row that differs.
    first: Option<(u64, u64)>,
    columns: Vec<ColumnState>,
    /// Number of columns that started as possible clocks.
    course_count: usize,
    name_bytes: usize,
    growth: Growth,
}

impl Work {
    fn new(layout: ColumnLayout, tolerance: Tolerance) -> Self {
        let mut course_count = 0;
        let state = |column: &ValueColumn| {
            let is_watched = matches!(column.moves, Moves::Back | Moves::Unevenly);
            course_count += usize::from(is_watched);
            let course = is_watched.then(|| course_count - 1);
            ColumnState { course, ..ColumnState::default() }
        };
        let columns = layout.values.iter().map(state).collect();
        let (alone, is_by_place) = (layout.alone.clone(), layout.is_by_place());
        let found = Comparison { alone, is_by_place, ..Comparison::default() };
        Self {
            layout,
            tolerance,
            streams: Vec::new(),
            by_key: HashMap::new(),
            key: Vec::new(),
            sides: Default::default(),
            found,
            is_out_of_order: false,
            first: None,
            columns,
            course_count,
            name_bytes: 0,
            growth: Growth::default(),
        }
    }

    /// Returns the place of a row, and the row's number on its side.
    fn place(&mut self, side: usize, row: &ByteRecord) -> Result<(Place, u64), NotComparable> {
        self.key.clear();
        for key in &self.layout.keys {
            self.key.extend_from_slice(&row[key.at[side]]);
            self.key.push(0);
        }
        let own = &mut self.sides[side];
        let number = own.number;
        own.number += 1;
        let guess = own.next;
        let stream = match self.streams.get(guess) {
            Some(stream) if stream.key == self.key => guess,
            _ => match self.by_key.get(&self.key) {
                Some(stream) => *stream,
                None => {
                    let (stream, columns) = (self.streams.len(), self.layout.values.len());
                    let values = columns * size_of::<([f64; 2], Option<u64>)>();
                    let courses = self.course_count * size_of::<ClockCheck>();
                    self.name_bytes += NAME_BYTES + 2 * self.key.len() + values + courses;
                    if self.name_bytes > MAX_NAME_BYTES && stream > 0 {
                        return Err(NotComparable::TooManyNames { names: stream, columns });
                    }
                    self.by_key.insert(self.key.clone(), stream);
                    self.streams.push(Stream {
                        key: self.key.clone(),
                        values: vec![[f64::NAN, 0.0]; columns],
                        courses: vec![ClockCheck::default(); self.course_count],
                        texts: vec![None; columns],
                    });
                    stream
                }
            },
        };
        own.next = if stream + 1 < self.streams.len() { stream + 1 } else { 0 };
        let order = self.layout.order(side, row, number)?;
        let own = &mut self.sides[side];
        self.is_out_of_order |= order < own.order;
        own.order = order;
        Ok((Place { order, stream }, number))
    }

    /// Pairs a row with its counterpart on the other side or, if there is none yet, queues the row.
    fn pair_or_queue(&mut self, side: usize, place: Place, number: u64, row: &mut ByteRecord) {
        if let Some(other) = self.sides[1 - side].remove(&place) {
            self.found.displaced += 1;
            match side {
                0 => self.compare_rows(place, number, [row, &other.row]),
                _ => self.compare_rows(place, other.number, [&other.row, row]),
            }
            return;
        }
        let row = std::mem::take(row);
        let own = &mut self.sides[side];
        if let Some(twice) = own.insert(place, Waiting { row, number }) {
            self.count_missing(1 - side, place, twice.number);
        }
        while self.sides[side].is_full() {
            self.found.is_cut_off = true;
            let Some((place, lost)) = self.sides[side].oldest() else { break };
            self.count_missing(1 - side, place, lost.number);
        }
    }

    /// Counts a row that `side` lacks.
    fn count_missing(&mut self, side: usize, place: Place, number: u64) {
        self.found.missing[side] += 1;
        let tick = self.layout.tick(place.order, number);
        let first = &mut self.found.first_missing[side];
        *first = Some(first.map_or(tick, |first| first.min(tick)));
    }

    /// Compares two rows at one place. `number` counts rows on the first side.
    fn compare_rows(&mut self, place: Place, number: u64, rows: [&ByteRecord; 2]) {
        self.found.rows += 1;
        let tick = self.layout.tick(place.order, number);
        if let Some((side, column)) = self.layout.first_alone {
            let at = (place.order, number);
            if self.first.is_none_or(|first| at < first) {
                let mut cells = [None, None];
                cells[side] = Some(&rows[side][column]);
                let name = self.found.alone[side][0].clone();
                let found = self.difference(at, rows[0], (name, cells), (None, None));
                (self.first, self.found.first) = (Some(at), Some(found));
            }
        }
        for column in 0..self.layout.values.len() {
            let [a, b] = self.layout.values[column].at;
            let cells = [&rows[0][a], &rows[1][b]].map(<[u8]>::trim_ascii);
            let is_written_alike = cells[0] == cells[1];
            if !self.columns[column].is_text && cells.into_iter().any(is_text) {
                self.turn_into_text(column);
            }
            if self.columns[column].is_text {
                self.note_text(place, column, cells);
                if !is_written_alike {
                    self.record_difference(place, number, (rows[0], column), cells, (None, None));
                }
                continue;
            }
            let first = parsed(cells[0]);
            let second = if is_written_alike { first } else { parsed(cells[1]) };
            let numbers = [first, second];
            let scale = self.note_values(place, number, column, cells, numbers);
            if is_written_alike {
                self.found.nans += u64::from(first.is_some_and(f64::is_nan));
                continue;
            }
            let [Some(a), Some(b)] = numbers else {
                self.record_difference(place, number, (rows[0], column), cells, (None, None));
                continue;
            };
            if is_same_number(a, b) {
                if hide_a_difference(cells, a) {
                    self.record_difference(place, number, (rows[0], column), cells, (None, None));
                } else {
                    self.keep_spelling_difference(place, number, (rows[0], column), cells);
                }
                self.found.zeros_of_two_signs +=
                    u64::from(a == 0.0 && a.is_sign_negative() != b.is_sign_negative());
                self.found.nans += u64::from(a.is_nan());
                continue;
            }
            let of_scale = if (a - b).is_finite() { (a - b).abs() / scale } else { f64::INFINITY };
            let state = &mut self.columns[column];
            state.worst = state.worst.max(of_scale);
            for (level, reached) in LEVELS.iter().zip(&mut state.reaches) {
                if of_scale >= *level && reached.is_none_or(|reached| tick < reached) {
                    *reached = Some(tick);
                }
            }
            self.growth.note_difference(tick, self.layout.time(rows[0]), of_scale);
            let ulps = distance_ulps(a, b);
            let of_larger = relative(a, b);
            let is_equal = ulps.is_some_and(|ulps| ulps <= self.tolerance.ulps)
                || of_larger.is_some_and(|part| part <= self.tolerance.relative);
            match is_equal {
                true => self.keep_spelling_difference(place, number, (rows[0], column), cells),
                false => self.record_difference(
                    place,
                    number,
                    (rows[0], column),
                    cells,
                    (ulps, of_larger),
                ),
            }
        }
    }

    /// Treats a column as text from the column's first row on. Equal numbers in different spelling now differ.
    fn turn_into_text(&mut self, column: usize) {
        let state = &mut self.columns[column];
        state.is_text = true;
        (state.worst, state.moved, state.reaches) = (0.0, 0.0, Default::default());
        state.rows += std::mem::take(&mut state.hidden_rows);
        let Some((at, difference)) = state.hidden.take() else { return };
        state.first = Some(state.first.map_or(at, |first| first.min(at)));
        if self.first.is_none_or(|first| at < first) {
            (self.first, self.found.first) = (Some(at), Some(difference));
        }
    }

    /// Records whether the text of a column changes between rows with the same key.
    fn note_text(&mut self, place: Place, column: usize, cells: [&[u8]; 2]) {
        let moves = self.layout.values[column].moves;
        // A date or a time of day is a clock, but text of any other kind is none.
        let is_of_clock = |cell: &[u8]| {
            cell.iter().all(|sign| sign.is_ascii_digit() || b":.,-/+ TZ".contains(sign))
        };
        if moves == Moves::Never || moves == Moves::Back && cells.into_iter().all(is_of_clock) {
            return;
        }
        for cell in cells {
            let mut hasher = DefaultHasher::new();
            cell.hash(&mut hasher);
            let (text, first) = (hasher.finish(), &mut self.streams[place.stream].texts[column]);
            self.columns[column].changes |= *first.get_or_insert(text) != text;
        }
    }

    /// Adds a column's values to the column's stream, and returns their largest magnitude so far.
    fn note_values(
        &mut self,
        place: Place,
        number: u64,
        column: usize,
        cells: [&[u8]; 2],
        numbers: [Option<f64>; 2],
    ) -> f64 {
        let [Some(a), b] = numbers else { return 1.0 };
        let values = [a, b.unwrap_or(a)];
        let stream = &mut self.streams[place.stream];
        let [from, largest] = &mut stream.values[column];
        for value in values.into_iter().filter(|value| value.is_finite()) {
            // A logger may write NaN into its first row.
            if from.is_nan() {
                *from = value;
            }
            *largest = largest.max(value.abs());
            let way = (value - *from).abs();
            let moved = &mut self.columns[column].moved;
            if way > *moved && way.is_finite() {
                *moved = way;
            }
        }
        if let Some(course) = self.columns[column].course {
            let moves = self.layout.values[column].moves;
            let at = self.layout.place(place.order, number);
            if !stream.courses[course].add(moves, at, values, cells) {
                self.columns[column].course = None;
            }
        }
        stream.values[column][1]
    }

    /// Records cells that differ by more than the tolerance. `far` is their distance in doubles and relative to the
    /// larger value.
    fn record_difference(
        &mut self,
        place: Place,
        number: u64,
        (row, column): (&ByteRecord, usize),
        cells: [&[u8]; 2],
        far: (Option<u64>, Option<f64>),
    ) {
        let at = (place.order, number);
        let state = &mut self.columns[column];
        state.rows += 1;
        state.first = Some(state.first.map_or(at, |first| first.min(at)));
        if self.first.is_none_or(|first| at < first) {
            let name = self.layout.values[column].name.clone();
            let found = self.difference(at, row, (name, cells.map(Some)), far);
            (self.first, self.found.first) = (Some(at), Some(found));
        }
    }

    /// Keeps cells that differ only in spelling, in case their column turns out to be text.
    fn keep_spelling_difference(
        &mut self,
        place: Place,
        number: u64,
        row: (&ByteRecord, usize),
        cells: [&[u8]; 2],
    ) {
        let at = (place.order, number);
        let (row, column) = row;
        let state = &mut self.columns[column];
        state.hidden_rows += 1;
        if state.hidden.as_ref().is_none_or(|(first, _)| at < *first) {
            let name = self.layout.values[column].name.clone();
            let found = self.difference(at, row, (name, cells.map(Some)), (None, None));
            self.columns[column].hidden = Some((at, found));
        }
    }

    /// Returns the difference between two cells. A cell is `None` if its side lacks the column.
    fn difference(
        &self,
        (order, number): (u64, u64),
        row: &ByteRecord,
        (column, cells): (String, [Option<&[u8]>; 2]),
        (ulps, relative): (Option<u64>, Option<f64>),
    ) -> Difference {
        let text = |cell: &[u8]| String::from_utf8_lossy(cell).trim().to_owned();
        let keys = self.layout.keys.iter();
        Difference {
            tick: self.layout.tick(order, number),
            tick_name: self.layout.tick_name().map(str::to_owned),
            key: keys.map(|key| (key.name.clone(), text(&row[key.at[0]]))).collect(),
            column,
            values: cells.map(|cell| cell.map(text)),
            ulps,
            relative,
        }
    }

    fn close(mut self) -> Comparison {
        for side in 0..2 {
            let left: Vec<_> = self.sides[side].waiting.drain().collect();
            left.into_iter()
                .for_each(|(place, row)| self.count_missing(1 - side, place, row.number));
        }
        let columns = || self.columns.iter().zip(&self.layout.values);
        let most = columns().filter(|(state, _)| state.worst > 0.0);
        let most = most.max_by(|(one, _), (other, _)| one.worst.total_cmp(&other.worst));
        self.found.worst = most.map(|(state, column)| (column.name.clone(), state.worst));
        for (level, reached) in self.found.reaches.iter_mut().enumerate() {
            *reached = columns().filter_map(|(state, _)| state.reaches[level]).min();
        }
        for (state, column) in columns() {
            let name = column.name.clone();
            match state.first {
                Some((order, number)) => self.found.columns.push(ColumnDifference {
                    column: name,
                    first_tick: self.layout.tick(order, number),
                    rows: state.rows,
                }),
                None => self.found.equal.push(name),
            }
        }
        let moving = (0..self.columns.len()).filter(|column| self.is_motion(*column));
        self.found.moved = moving.map(|column| self.columns[column].moved).fold(0.0, f64::max);
        let is_text_changing = self.columns.iter().any(|state| state.changes);
        self.found.changes = self.found.moved > 0.0 || is_text_changing || !self.layout.has_order();
        self.found.per_second = self.growth.per_second();
        self.found.is_cut_off &= self.is_out_of_order;
        self.found
    }

    /// Whether a value column moves like a coordinate, and not like a clock.
    fn is_motion(&self, column: usize) -> bool {
        let moves = self.layout.values[column].moves;
        let goes_as_a_clock = self.columns[column].course.is_some_and(|course| {
            self.streams.iter().all(|stream| stream.courses[course].is_of_a_clock(moves))
        });
        moves != Moves::Never && !goes_as_a_clock
    }
}
