//! Where two runs first differ, and how the difference grows.
//!
//! A run is a table: columns that say which row it is (`tick`, or else `t`, or else its place, with `lane`, `body` and
//! `coordinate` where they are there), `t` and `method`, which are told but not compared, and columns of values. Rows of one
//! name are compared wherever they stand, up to [`MAX_WAITING`] rows apart, so that memory does not grow with the rows. It
//! grows with their names, up to a bound.

use std::collections::{HashMap, VecDeque};
use std::fmt;
use std::io::BufRead;

use csv::ByteRecord;

use crate::sim::number::{counted, significant};
use crate::table::{Reading, TableError, TableReader};

mod clock;
mod growth;
mod layout;
mod number;

use clock::{Course, Moves};
use growth::Growth;
use layout::Layout;
pub use layout::NotComparable;
pub use number::{distance_ulps, is_same_number};
use number::{hide_a_difference, parsed, relative};

/// The relative differences whose first ticks are told.
pub const LEVELS: [f64; 5] = [1e-12, 1e-9, 1e-6, 1e-3, 1.0];
/// The most rows of a side that wait for the row of their name on the other. A row that waits longer counts as missing there.
pub const MAX_WAITING: usize = 1 << 16;
/// The most bytes of the cells of such rows, which long rows reach first.
const MAX_WAITING_BYTES: usize = 64 << 20;
/// The most bytes of what is kept for the names of rows: 256 MiB, of a million names with few columns.
const MAX_NAME_BYTES: usize = 256 << 20;
/// What a name takes beside its cells and values: its entry in a table and the heads of its lists.
const NAME_BYTES: usize = 192;

/// The rows of a run, one after the other.
pub trait Records {
    /// Why the next row cannot be had.
    type Error;

    /// The names of the columns.
    fn header(&self) -> &ByteRecord;

    /// Reads the next row, with the cells of the header; `false` after the last.
    ///
    /// # Errors
    /// Whatever keeps it from being read.
    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, Self::Error>;
}

/// The table in this text.
///
/// # Errors
/// What keeps its header from being read.
pub fn table(text: &str) -> Result<TableReader<&[u8]>, TableError> {
    TableReader::begin(text.as_bytes(), Reading::default(), |_| true)
}

impl<R: BufRead> Records for TableReader<R> {
    type Error = TableError;

    fn header(&self) -> &ByteRecord {
        self.header()
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, TableError> {
        Ok(self.next(row)?.is_some())
    }
}

/// What counts as equal: two numbers within either bound. By default they must be the same number, as two NaN and zeros of
/// two signs are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// The most doubles from one to the other.
    pub ulps: u64,
    /// The largest difference as a part of the larger of both.
    pub relative: f64,
}

/// Two values that differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The tick; the row's place from 0 in a table without ticks.
    pub tick: u64,
    /// The cells `lane`, `body` and `coordinate` of the row, where there are such columns.
    pub row: [Option<String>; 3],
    /// The column of the values.
    pub column: String,
    /// The values as they are written; `None` where the column is not there.
    pub values: [Option<String>; 2],
    /// How many doubles lie from one to the other; `None` where one is no number, or not a number.
    pub ulps: Option<u64>,
    /// Their difference as a part of the larger; `None` where that has no meaning.
    pub relative: Option<f64>,
}

/// The largest distance that is given in ulps, and not as a number.
const FEW_ULPS: u64 = 1000;

impl Difference {
    /// Where it is: the tick, the lane as it is to be named, the body and the coordinate.
    pub fn place(&self, lane_name: impl Fn(&str) -> String) -> String {
        let [lane, body, coordinate] = self.row.clone();
        let lane = lane.map(|lane| lane_name(&lane));
        let tick = Some(format!("tick {}", self.tick));
        let parts = [tick, lane, body, coordinate].into_iter().flatten();
        parts.collect::<Vec<_>>().join(", ")
    }

    /// How large it is, in a few words.
    pub fn size(&self) -> String {
        let column = &self.column;
        let [a, b] = self.values.each_ref().map(|value| value.as_deref()?.parse::<f64>().ok());
        let (Some(a), Some(b)) = (a, b) else {
            return format!("{column} is not a number on both sides");
        };
        let size = match self.ulps.filter(|ulps| *ulps <= FEW_ULPS) {
            Some(ulps) => counted(ulps, "ulp"),
            None => significant((a - b).abs(), 2),
        };
        let part = self.relative.map(|part| format!(", {} % of it", significant(100.0 * part, 2)));
        format!("size: {size} in {column}{}", part.unwrap_or_default())
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.values.each_ref().map(|value| value.as_deref().unwrap_or("absent"));
        let place = self.place(|lane| format!("lane {lane}"));
        write!(f, "at {place}: {} is {a} in a and {b} in b", self.column)?;
        if let Some(ulps) = self.ulps {
            write!(f, ", {} apart", counted(ulps, "ulp"))?;
        }
        self.relative.map_or(Ok(()), |part| write!(f, ", {part:.1e} relative"))
    }
}

/// What two runs have in common, and where they part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// How many rows both have.
    pub rows: u64,
    /// The farthest that any coordinate went from its first value, on either side; the value `q`, or where there is none, all.
    pub moved: f64,
    /// The first values that differ by more than the [`Tolerance`], by their tick and then by their place.
    pub first: Option<Difference>,
    /// For each of [`LEVELS`], the tick at which a value first differs by it, as a part of the largest that this column of
    /// this coordinate had until then.
    pub reaches: [Option<u64>; LEVELS.len()],
    /// The rate of its growth in 1/s, if it grows exponentially through three decades and more.
    pub per_second: Option<f64>,
    /// How many rows each side lacks.
    pub missing: [u64; 2],
    /// The tick of the first row that a side lacks.
    pub first_missing: [Option<u64>; 2],
    /// The columns that only this side has.
    pub alone: [Vec<String>; 2],
    /// The column that differs most, and by how much, as in `reaches`.
    pub worst: Option<(String, f64)>,
    /// Pairs of zeros of two signs, which count as equal.
    pub zeros_of_two_signs: u64,
    /// Pairs of NaN, which count as equal.
    pub nans: u64,
    /// Whether a row counts as missing because its like, if there is one, stands too far away.
    pub is_cut_off: bool,
    /// Rows that stand at another place on the other side.
    pub displaced: u64,
}

impl Comparison {
    /// Whether there is something to compare: two common rows, and a motion.
    pub fn is_comparable(&self) -> bool {
        self.rows >= 2 && self.moved > 0.0 && !self.is_cut_off
    }

    /// Whether both have the same rows with equal values.
    pub fn is_same(&self) -> bool {
        let is_whole = self.missing == [0; 2] && self.alone.iter().all(Vec::is_empty);
        self.is_comparable() && self.first.is_none() && is_whole
    }
}

/// The rows of one name: a coordinate of a body of a lane.
struct Stream {
    /// Its cells of the key columns, with a zero after each.
    key: Vec<u8>,
    /// Of each value column: the first value that is finite, or NaN, and the largest size so far.
    values: Vec<[f64; 2]>,
    /// Of each value column that may be a clock's: how it goes.
    courses: Vec<Course>,
}

/// A row, where it belongs.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Place {
    /// The tick or the time, as bits that are in order.
    order: u64,
    stream: usize,
}

/// A row that waits for the other side's.
struct Waiting {
    row: ByteRecord,
    /// How many rows its side had before it.
    number: u64,
}

/// A side of the comparison.
#[derive(Default)]
struct Side {
    /// The stream that the next row is of, if streams come in turn.
    next: usize,
    number: u64,
    /// The order of the last row.
    order: u64,
    waiting: HashMap<Place, Waiting>,
    /// The bytes of the rows that wait.
    waiting_bytes: usize,
    /// The rows that wait, and some that did, as they came.
    queue: VecDeque<(Place, u64)>,
}

impl Side {
    /// Lets a row wait. Returns the one of the same name that it replaces.
    fn insert(&mut self, place: Place, row: Waiting) -> Option<Waiting> {
        self.waiting_bytes += row.row.as_slice().len();
        self.queue.push_back((place, row.number));
        let twice = self.waiting.insert(place, row);
        self.waiting_bytes -= twice.as_ref().map_or(0, |twice| twice.row.as_slice().len());
        if self.queue.len() > 2 * MAX_WAITING {
            let Side { queue, waiting, .. } = self;
            queue.retain(|(at, n)| waiting.get(at).is_some_and(|row| row.number == *n));
        }
        twice
    }

    /// Takes out the row of this name.
    fn remove(&mut self, place: &Place) -> Option<Waiting> {
        let row = self.waiting.remove(place)?;
        self.waiting_bytes -= row.row.as_slice().len();
        Some(row)
    }

    fn is_full(&self) -> bool {
        self.waiting.len() > MAX_WAITING || self.waiting_bytes > MAX_WAITING_BYTES
    }

    /// Takes out the row that has waited longest.
    fn oldest(&mut self) -> Option<(Place, Waiting)> {
        while let Some((place, number)) = self.queue.pop_front() {
            if self.waiting.get(&place).is_some_and(|row| row.number == number) {
                return Some((place, self.remove(&place)?));
            }
        }
        None
    }
}

/// Compares two runs.
///
/// # Errors
/// The first row that cannot be read, or the reason why these are not two tables of a kind.
pub fn diff<A, B, E>(a: &mut A, b: &mut B, tolerance: Tolerance) -> Result<Comparison, E>
where
    A: Records,
    B: Records,
    E: From<A::Error> + From<B::Error> + From<NotComparable>,
{
    let layout = Layout::of([a.header(), b.header()])?;
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
                work.pair(one, number, [&rows[0], &rows[1]]);
                places = [None; 2];
            }
            // The one behind goes on alone, so that both are side by side again after a row that one lacks.
            [one, other] => {
                let order =
                    |it: Option<(Place, u64)>| it.map_or(u64::MAX, |(place, _)| place.order);
                let goes = [order(one) <= order(other), order(other) <= order(one)];
                for side in (0..2).filter(|side| goes[*side]) {
                    if let Some((place, number)) = places[side].take() {
                        work.wait(side, place, number, &mut rows[side]);
                    }
                }
            }
        }
    }
    Ok(work.close())
}

/// A comparison on its way.
struct Work {
    layout: Layout,
    tolerance: Tolerance,
    streams: Vec<Stream>,
    by_key: HashMap<Vec<u8>, usize>,
    key: Vec<u8>,
    sides: [Side; 2],
    found: Comparison,
    /// Whether rows go back: then the like of one that has waited too long may be still to come.
    is_out_of_order: bool,
    /// Where the first difference is.
    first: Option<(u64, u64)>,
    /// The largest relative difference of each value column.
    worst: Vec<f64>,
    /// How far each value column went from its first value.
    moved: Vec<f64>,
    /// The place of each value column in the courses of a stream, as long as it may be a clock's.
    courses: Vec<Option<usize>>,
    /// How many columns have a course, and the bytes of the names.
    course_count: usize,
    name_bytes: usize,
    growth: Growth,
}

impl Work {
    fn new(layout: Layout, tolerance: Tolerance) -> Self {
        let worst = vec![0.0; layout.values.len()];
        let mut course_count = 0;
        let course = |moves: Moves| {
            let is_watched = matches!(moves, Moves::Back | Moves::Unevenly);
            course_count += usize::from(is_watched);
            is_watched.then(|| course_count - 1)
        };
        let courses = layout.values.iter().map(|column| column.moves).map(course).collect();
        let found = Comparison { alone: layout.alone.clone(), ..Comparison::default() };
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
            moved: worst.clone(),
            worst,
            courses,
            course_count,
            name_bytes: 0,
            growth: Growth::default(),
        }
    }

    /// Where a row of a side belongs, and its number there.
    fn place(&mut self, side: usize, row: &ByteRecord) -> Result<(Place, u64), NotComparable> {
        self.key.clear();
        for columns in &self.layout.keys {
            self.key.extend_from_slice(&row[columns[side]]);
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
                    let values = columns * size_of::<[f64; 2]>();
                    let courses = self.course_count * size_of::<Course>();
                    self.name_bytes += NAME_BYTES + 2 * self.key.len() + values + courses;
                    if self.name_bytes > MAX_NAME_BYTES && stream > 0 {
                        return Err(NotComparable::TooManyNames { names: stream, columns });
                    }
                    self.by_key.insert(self.key.clone(), stream);
                    self.streams.push(Stream {
                        key: self.key.clone(),
                        values: vec![[f64::NAN, 0.0]; columns],
                        courses: vec![Course::default(); self.course_count],
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

    /// Compares a row with one that waits on the other side, or lets it wait.
    fn wait(&mut self, side: usize, place: Place, number: u64, row: &mut ByteRecord) {
        if let Some(other) = self.sides[1 - side].remove(&place) {
            self.found.displaced += 1;
            match side {
                0 => self.pair(place, number, [row, &other.row]),
                _ => self.pair(place, other.number, [&other.row, row]),
            }
            return;
        }
        let row = std::mem::take(row);
        let own = &mut self.sides[side];
        if let Some(twice) = own.insert(place, Waiting { row, number }) {
            self.lack(1 - side, place, twice.number);
        }
        while self.sides[side].is_full() {
            self.found.is_cut_off = true;
            let Some((place, lost)) = self.sides[side].oldest() else { break };
            self.lack(1 - side, place, lost.number);
        }
    }

    /// Counts a row that a side lacks.
    fn lack(&mut self, side: usize, place: Place, number: u64) {
        self.found.missing[side] += 1;
        let tick = self.layout.tick(place.order, number);
        let first = &mut self.found.first_missing[side];
        *first = Some(first.map_or(tick, |first| first.min(tick)));
    }

    /// Compares two rows of one place; `number` is that of the first side's.
    fn pair(&mut self, place: Place, number: u64, rows: [&ByteRecord; 2]) {
        self.found.rows += 1;
        let tick = self.layout.tick(place.order, number);
        if let Some((side, column)) = self.layout.first_alone {
            let mut values = [None, None];
            values[side] = Some(&rows[side][column]);
            self.differs(place, number, (rows[0], None), values, (None, None));
        }
        for column in 0..self.layout.values.len() {
            let [a, b] = self.layout.values[column].at;
            let cells = [&rows[0][a], &rows[1][b]];
            let is_text_same = cells[0] == cells[1];
            let first = parsed(cells[0]);
            let second = if is_text_same { first } else { parsed(cells[1]) };
            let numbers = [first, second];
            let scale = self.note(place, number, column, cells, numbers);
            if is_text_same {
                self.found.nans += u64::from(first.is_some_and(f64::is_nan));
                continue;
            }
            let values = cells.map(Some);
            let [Some(a), Some(b)] = numbers else {
                self.differs(place, number, (rows[0], Some(column)), values, (None, None));
                continue;
            };
            if is_same_number(a, b) {
                if hide_a_difference(cells, a) {
                    self.differs(place, number, (rows[0], Some(column)), values, (None, None));
                }
                self.found.zeros_of_two_signs +=
                    u64::from(a == 0.0 && a.is_sign_negative() != b.is_sign_negative());
                self.found.nans += u64::from(a.is_nan());
                continue;
            }
            let of_scale = if (a - b).is_finite() { (a - b).abs() / scale } else { f64::INFINITY };
            self.worst[column] = self.worst[column].max(of_scale);
            for (level, reached) in LEVELS.iter().zip(&mut self.found.reaches) {
                if of_scale >= *level && reached.is_none_or(|reached| tick < reached) {
                    *reached = Some(tick);
                }
            }
            self.growth.note(tick, self.layout.time(rows[0]), of_scale);
            let ulps = distance_ulps(a, b);
            let of_larger = relative(a, b);
            let is_equal = ulps.is_some_and(|ulps| ulps <= self.tolerance.ulps)
                || of_larger.is_some_and(|part| part <= self.tolerance.relative);
            if !is_equal {
                self.differs(place, number, (rows[0], Some(column)), values, (ulps, of_larger));
            }
        }
    }

    /// Adds the values of a column of a stream, and returns the largest size so far.
    fn note(
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
            if way > self.moved[column] && way.is_finite() {
                self.moved[column] = way;
            }
        }
        if let Some(course) = self.courses[column] {
            let moves = self.layout.values[column].moves;
            let at = self.layout.place(place.order, number);
            if !stream.courses[course].add(moves, at, values, cells) {
                self.courses[column] = None;
            }
        }
        stream.values[column][1]
    }

    /// Takes in the values of a column that differ by more than the tolerance; `None` is the first column that only one side
    /// has; `far` is how far, in doubles and as a part.
    fn differs(
        &mut self,
        place: Place,
        number: u64,
        (row, column): (&ByteRecord, Option<usize>),
        values: [Option<&[u8]>; 2],
        far: (Option<u64>, Option<f64>),
    ) {
        let at = (place.order, number);
        if self.first.is_some_and(|first| first <= at) {
            return;
        }
        self.first = Some(at);
        let alone = || self.found.alone.concat()[0].clone();
        let text = |cell: &[u8]| String::from_utf8_lossy(cell).trim().to_owned();
        self.found.first = Some(Difference {
            tick: self.layout.tick(place.order, number),
            row: self.layout.named.map(|key| key.map(|key| text(&row[key]))),
            column: column.map_or_else(alone, |column| self.layout.values[column].name.clone()),
            values: values.map(|value| value.map(text)),
            ulps: far.0,
            relative: far.1,
        });
    }

    fn close(mut self) -> Comparison {
        for side in 0..2 {
            let left: Vec<_> = self.sides[side].waiting.drain().collect();
            left.into_iter().for_each(|(place, row)| self.lack(1 - side, place, row.number));
        }
        let most = self.worst.iter().enumerate().filter(|(_, part)| **part > 0.0);
        let most = most.max_by(|(_, one), (_, other)| one.total_cmp(other));
        self.found.worst =
            most.map(|(column, part)| (self.layout.values[column].name.clone(), *part));
        let moved = (0..self.moved.len()).filter(|column| self.is_motion(*column));
        self.found.moved = moved.map(|column| self.moved[column]).fold(0.0, f64::max);
        self.found.per_second = self.growth.per_second();
        self.found.is_cut_off &= self.is_out_of_order;
        self.found
    }

    /// Whether the changes of a value column are a motion, and not a clock's.
    fn is_motion(&self, column: usize) -> bool {
        let moves = self.layout.values[column].moves;
        let goes_as_a_clock = self.courses[column].is_some_and(|course| {
            self.streams.iter().all(|stream| stream.courses[course].is_of_a_clock(moves))
        });
        moves != Moves::Never && !goes_as_a_clock
    }
}
