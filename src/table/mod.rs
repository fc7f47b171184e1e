//! A reader of tables for the logs of any tool. It turns bytes into a header, rows of cells, and numbers.
//!
//! A [`TableReader`] skips the byte order mark, blank lines, remarks that begin with `#` or `//`, and up to
//! [`MAX_ABOVE`] other lines above the header, which the caller recognises. The separator of the cells in the header
//! (comma, semicolon, tab or spaces) is the separator of all rows. A [decoder](Utf8) turns UTF-16 into UTF-8.
//! Numbers may have a decimal comma unless commas separate the cells. Rows of numbers without a header have their
//! heading in the remark above them, or numbers as names. JSON becomes rows. [`TableOptions`] take precedence.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_scene as scene;
use regatta_sim as sim;

use std::io::{self, BufRead, Read};

use csv::ByteRecord;

mod encoding;
mod json;
mod moment;
mod number;
mod options;
mod unit;

pub use encoding::Utf8;
pub use json::Cells;
pub use moment::{Course, Moment, median};
pub use number::{Decimal, number};
use options::RowFilter;
pub use options::{TableOptions, Taken, column};
pub use unit::words;
pub use unit::{Heading, Unit};

/// Maximum number of lines above a header, not counting remarks and blank lines.
pub const MAX_ABOVE: u64 = 16;
/// Maximum number of bytes in a row, in the header, or in a line above the header. No log has a longer line, but an
/// input without line ends has one, for example a device.
pub const MAX_ROW_BYTES: usize = 1 << 20;
/// Maximum number of bytes in the header and all lines above it.
const MAX_HEAD_BYTES: usize = 1 << 22;
/// Number of bytes that are read from an input at once.
pub const BUFFER_BYTES: usize = 1 << 20;

/// Options for reading a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Whether a row may have fewer cells than the header. The caller then checks for the cells that it needs.
    pub short_rows: bool,
    /// Whether remarks may also appear between rows.
    pub remarks: bool,
    /// Whether a first line that is only a number is already a row. The table is then a list without a header.
    pub lists: bool,
    /// Whether a first line of several numbers is already a row. The columns then have numbers as names.
    pub headless: bool,
    /// What the caller says about the table.
    pub options: TableOptions,
}

/// The reason why a table cannot be read, and the line that it is about.
#[derive(Debug, thiserror::Error)]
#[error("{fault}")]
pub struct TableError {
    /// Line number, from 1.
    pub line: u64,
    /// The fault on that line.
    pub fault: TableFault,
}

/// A fault in a table.
#[derive(Debug, thiserror::Error)]
pub enum TableFault {
    /// There are only blank lines and remarks, or no lines at all.
    #[error("there is nothing here")]
    Empty,
    /// The input cannot be read.
    #[error("{0}")]
    Input(io::Error),
    /// The input is JSON without a table.
    #[error("{0}")]
    Json(String),
    /// A column that the caller names is missing.
    #[error("no column {name:?}; here are {here}")]
    NoColumn {
        /// Name or number of the column.
        name: String,
        /// Columns of the table.
        here: String,
    },
    /// There are rows, and the caller's options leave out all of them.
    #[error("none of the {of} rows is taken; widen --rows, --where, --start or --end")]
    NoneTaken {
        /// Number of rows in the table.
        of: u64,
    },
    /// A row has more or fewer cells than the header.
    #[error("{}", cells_in_words(*cells, *header))]
    Cells {
        /// Number of cells in the row.
        cells: usize,
        /// Number of cells in the header.
        header: usize,
    },
}

fn cells_in_words(cells: usize, header: usize) -> String {
    match cells < header {
        true => format!(
            "the row has {cells} of the header's {header} cells; take it out if it was cut off"
        ),
        false => format!(
            "the row has {cells} cells and the header {header}; if its numbers have decimal commas, write points, or separate \
             the cells with semicolons"
        ),
    }
}

/// Returns the names in a header, for a message.
fn names_of(header: &ByteRecord) -> String {
    let names = header.iter().map(|name| String::from_utf8_lossy(name).trim().to_owned());
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    scene::clip_list(names.iter().map(String::as_str))
}

/// The text of a table: that of the input, or of the JSON in it.
enum Text<R> {
    Plain(io::Chain<io::Cursor<Vec<u8>>, R>),
    Whole(io::Cursor<Vec<u8>>),
    Lines(json::Lines<io::Chain<io::Cursor<Vec<u8>>, R>>),
}

/// Number of bytes by which JSON is recognised.
const START_BYTES: u64 = 64;

impl<R: BufRead> Text<R> {
    /// Recognises JSON, and returns whether the table has a header if that is known.
    fn of(mut input: R) -> Result<(Self, Option<bool>), TableFault> {
        let mut start = Vec::new();
        (&mut input).take(START_BYTES).read_to_end(&mut start).map_err(TableFault::Input)?;
        if json::is_json(&start) {
            let input = io::Cursor::new(start).chain(input);
            return Ok(match json::convert(input).map_err(TableFault::Json)? {
                json::Converted::Whole(text, has_header) => {
                    (Self::Whole(io::Cursor::new(text)), Some(has_header))
                }
                json::Converted::Lines(lines) => (Self::Lines(lines), Some(true)),
            });
        }
        Ok((Self::Plain(io::Cursor::new(start).chain(input)), None))
    }

    fn input(&mut self) -> &mut dyn BufRead {
        match self {
            Self::Plain(input) => input,
            Self::Whole(input) => input,
            Self::Lines(input) => input,
        }
    }

    /// Number of lines of the text that are not lines of the input.
    fn own_lines(&self) -> u64 {
        match self {
            Self::Lines(_) => 1,
            _ => 0,
        }
    }
}

impl<R: BufRead> Read for Text<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.input().read(bytes)
    }
}

/// The text from the header on, whose first lines are read already.
type Rest<R> = io::Chain<io::Cursor<Vec<u8>>, Text<R>>;

/// A table, read row by row.
pub struct TableReader<R> {
    rows: csv::Reader<Bounded<Rest<R>>>,
    header: ByteRecord,
    /// First row of a table without a header.
    first: Option<ByteRecord>,
    /// Number of lines above the first line of `rows`.
    above: u64,
    own_lines: u64,
    header_line: u64,
    is_list: bool,
    is_headless: bool,
    separator: u8,
    reading: Reading,
    filter: RowFilter,
    /// Column of the times that limit the rows, the number of its units in a second, and the first time.
    clock: Option<(usize, f64)>,
    began: Option<Moment>,
    there: u64,
    taken: Option<[u64; 2]>,
}

/// The lines of a table up to the one that begins it.
struct Head {
    /// The first line of the table, with its end.
    rest: Vec<u8>,
    /// Number of lines above it.
    above: u64,
    is_found: bool,
    /// The last remark above the first line.
    remark: Option<Vec<u8>>,
}

impl Head {
    /// Reads up to the first line that `is_header`, which knows whether it is the first with cells, or `most` lines.
    fn read<R: BufRead>(
        input: &mut Text<R>,
        most: u64,
        has_header: Option<bool>,
        is_header: impl Fn(&[u8], bool) -> bool,
    ) -> Result<Self, TableError> {
        let (mut head, mut starts) = (Vec::new(), Vec::<usize>::new());
        let (mut first, mut found, mut remark) = (None, None, None);
        let mut candidates = 0;
        while candidates <= most && found.is_none() {
            let start = head.len();
            let read = input.input().take(MAX_ROW_BYTES as u64).read_until(b'\n', &mut head);
            let line = starts.len() as u64 + 1;
            read.map_err(|error| TableError { line, fault: TableFault::Input(error) })?;
            if head.len() - start == MAX_ROW_BYTES || head.len() > MAX_HEAD_BYTES {
                return Err(TableError {
                    line,
                    fault: TableFault::Input(io::Error::other(TooLong)),
                });
            }
            if head.len() == start {
                break;
            }
            starts.push(start);
            let text = head[start..].trim_ascii();
            if text.is_empty() {
                continue;
            }
            if is_remark(text) && has_header.is_none() {
                if first.is_none() {
                    remark = Some(text.to_vec());
                }
                continue;
            }
            let here = starts.len() - 1;
            found = is_header(text, first.is_none()).then_some(here);
            first.get_or_insert(here);
            candidates += 1;
        }
        let at = found.or(first).ok_or(TableError { line: 1, fault: TableFault::Empty })?;
        let rest = head.split_off(starts[at]);
        Ok(Self { rest, above: at as u64, is_found: found.is_some(), remark })
    }
}

impl<R: BufRead> TableReader<R> {
    /// Reads a table up to its header, which is the first line for which `is_header` is true. If there is no such line,
    /// the first line that is neither blank nor a remark becomes the header, unless it is a row of numbers.
    ///
    /// # Errors
    /// If the input cannot be read, has too long a line, or has only blank lines and remarks, or if a column of the
    /// options is missing.
    pub fn begin(
        input: R,
        reading: Reading,
        is_header: impl Fn(&ByteRecord) -> bool,
    ) -> Result<Self, TableError> {
        let at_start = |fault| TableError { line: 1, fault };
        let (mut input, has_header) = Text::of(input).map_err(at_start)?;
        let own_lines = input.own_lines();
        let told = reading.options.separator.filter(|_| has_header.is_none());
        let is_headless = reading.options.no_header || has_header == Some(false);
        let most = if is_headless || has_header.is_some() { 0 } else { MAX_ABOVE };
        let Head { mut rest, above, is_found, remark } =
            Head::read(&mut input, most, has_header, |text, is_first| {
                reading.lists && is_first && is_number(text) || is_header(&cells(text, told))
            })?;
        let end = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
        let line = rest[..end].trim_ascii().to_vec();
        let is_list = reading.lists && is_number(&line) && !line.contains(&b',') | told.is_none();
        let is_spaced = |line: &[u8]| !line.contains(&b',') && of_spaces(line).len() > 1;
        if !is_list && !is_spaced(&line) && rest.len() <= end + 1 && !is_found {
            // A heading of words above cells that spaces separate.
            let read = input.input().take(MAX_ROW_BYTES as u64).read_until(b'\n', &mut rest);
            read.map_err(|error| TableError { line: 1, fault: TableFault::Input(error) })?;
        }
        let second = rest.get(end + 1..).unwrap_or_default();
        let second = second.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii();
        let are_words = of_spaces(&line).len();
        let is_of_spaces = told.is_none()
            && ![b',', b';', b'\t'].iter().any(|sign| line.contains(sign))
            && (are_numbers(&of_spaces(&line)) && are_words > 1
                || are_words > 1
                    && are_words == of_spaces(second).len()
                    && are_numbers(&of_spaces(second)));
        let separator = match told {
            Some(separator) => separator,
            None if is_list => b';',
            None if is_of_spaces => b' ',
            None => separator(&line),
        };
        let of_line = cells(&line, Some(separator));
        let is_row = |row: &ByteRecord| are_numbers(&row.iter().collect::<Vec<_>>());
        let has_no_header = is_headless
            || is_list
            || reading.headless && !is_found && has_header.is_none() && is_row(&of_line);
        let heading = remark.filter(|_| has_no_header && !is_headless).and_then(|remark| {
            let start = remark.iter().position(|byte| !b"#/ ".contains(byte))?;
            let of = |separator| cells(&remark[start..], Some(separator));
            let fits = |row: &ByteRecord| {
                row.len() == of_line.len() && !is_row(row) && (row.len() > 1 || is_header(row))
            };
            [separator, b',', b' ', b'\t', b';'].into_iter().map(of).find(fits)
        });
        let mut rows = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(separator)
            .buffer_capacity(BUFFER_BYTES)
            .from_reader(Bounded {
                input: io::Cursor::new(rest).chain(input),
                in_row: 0,
                gap: (separator == b' ').then_some(true),
            });
        let mut first = ByteRecord::new();
        let at_header = |fault| TableError { line: above + 1, fault };
        let read = rows.read_byte_record(&mut first);
        read.map_err(|error| at_header(TableFault::Input(error.into())))?;
        if separator == b' ' && first.get(first.len().wrapping_sub(1)) == Some(b"") {
            first.truncate(first.len() - 1);
        }
        let is_list = is_list && heading.is_none();
        let is_headless = has_no_header && heading.is_none() && !is_list;
        let (header, first) = match heading {
            Some(heading) => (heading, Some(first)),
            None if is_list => (ByteRecord::from(vec![""]), Some(first)),
            None if has_no_header => {
                let numbers: Vec<String> = (1..=first.len()).map(|n| n.to_string()).collect();
                (ByteRecord::from(numbers), Some(first))
            }
            None => (first, None),
        };
        let filter = RowFilter::of(&header, &reading.options).map_err(at_header)?;
        Ok(Self {
            rows,
            header,
            first,
            above,
            own_lines,
            header_line: above + 1,
            is_list,
            is_headless,
            separator,
            reading,
            filter,
            clock: None,
            began: None,
            there: 0,
            taken: None,
        })
    }

    /// Takes only rows whose time in this column lies in the window of the options. `unit` is that of the times.
    pub fn limit_by(&mut self, column: usize, unit: Unit) {
        self.clock = self.reading.options.has_window().then_some((column, unit.ns()));
    }

    /// Whether the columns have numbers as names, because there is no header.
    pub fn is_headless(&self) -> bool {
        self.is_headless
    }

    /// Returns the numbers of the first and the last row that were taken, and the number of rows up to now.
    pub fn taken(&self) -> ([u64; 2], u64) {
        (self.taken.unwrap_or([0, 0]), self.there)
    }

    /// Counts the rows that remain, without taking them, and returns the number of all rows.
    pub fn count_rest(&mut self) -> u64 {
        let mut row = ByteRecord::new();
        loop {
            self.rows.get_mut().in_row = 0;
            match self.rows.read_byte_record(&mut row) {
                Ok(true) => self.there += 1,
                _ => return self.there,
            }
        }
    }

    /// Returns the names of the columns. A list has one column with an empty name.
    pub fn header(&self) -> &ByteRecord {
        &self.header
    }

    /// Whether the table is a list, which has no header.
    pub fn is_list(&self) -> bool {
        self.is_list
    }

    /// Returns the line number of the header, or that of the first row if the table is a list.
    pub fn header_line(&self) -> u64 {
        self.header_line
    }

    /// Returns the decimal signs that the table's numbers may have.
    pub fn decimal(&self) -> Decimal {
        if self.separator == b',' { Decimal::Point } else { Decimal::PointOrComma }
    }

    /// Reads the next row that the options take and returns its line number, or `None` after the last row. Skips blank
    /// lines, and skips remarks if [`Reading::remarks`] is set.
    ///
    /// # Errors
    /// If the row cannot be read, if it has too many or too few cells for the header, or if the options take no row.
    pub fn next(&mut self, row: &mut ByteRecord) -> Result<Option<u64>, TableError> {
        loop {
            let line = self.next_of_all(row)?;
            let Some(found) = line else {
                let of = self.there;
                if of > 0 && self.taken.is_none() {
                    let fault = TableFault::NoneTaken { of };
                    return Err(TableError { line: self.header_line, fault });
                }
                return Ok(None);
            };
            self.there += 1;
            if !self.filter.takes(self.there, row, self.decimal()) || !self.is_in_window(row) {
                if self.filter.ends_before(self.there) && self.taken.is_some() {
                    self.count_rest();
                    return Ok(None);
                }
                continue;
            }
            let first = self.taken.map_or(self.there, |[first, _]| first);
            self.taken = Some([first, self.there]);
            return Ok(Some(found));
        }
    }

    fn is_in_window(&mut self, row: &ByteRecord) -> bool {
        let Some((column, ns)) = self.clock else { return true };
        let cell = row.get(column).unwrap_or_default();
        let Some(moment) = Moment::read(cell, self.decimal()) else { return true };
        let ns = if moment.is_of_calendar { 1.0 } else { ns };
        let since_s = moment.since(*self.began.get_or_insert(moment)) * ns / 1e9;
        let [start, end] = self.reading.options.window_s;
        since_s >= start.unwrap_or(f64::NEG_INFINITY) && since_s < end.unwrap_or(f64::INFINITY)
    }

    fn next_of_all(&mut self, row: &mut ByteRecord) -> Result<Option<u64>, TableError> {
        if let Some(first) = self.first.take() {
            *row = first;
            return Ok(Some(self.header_line));
        }
        loop {
            self.rows.get_mut().in_row = 0;
            let above = self.above;
            let line = above + self.rows.position().line() - self.own_lines;
            let read = self.rows.read_byte_record(row);
            let is_there = read.map_err(|error| TableError {
                line: error.position().map_or(line, |at| above + at.line() - self.own_lines),
                fault: TableFault::Input(error.into()),
            })?;
            if !is_there {
                return Ok(None);
            }
            if self.separator == b' ' && row.len() > 1 && row.get(row.len() - 1) == Some(b"") {
                row.truncate(row.len() - 1);
            }
            let line = row.position().map_or(line, |at| above + at.line() - self.own_lines);
            let (cells, header) = (row.len(), self.header.len());
            let first = row.get(0).unwrap_or_default().trim_ascii_start();
            // A line of several cells may be a row about an object whose name begins with `#`.
            let is_said = cells == 1 || first.starts_with(b"# ") || first.starts_with(b"//");
            if self.reading.remarks && cells != header && is_remark(first) && is_said {
                continue;
            }
            if cells > header || cells < header && !self.reading.short_rows {
                return Err(TableError { line, fault: TableFault::Cells { cells, header } });
            }
            return Ok(Some(line));
        }
    }

    /// Reads the next row like [`next`](Self::next), and turns decimal commas into points.
    ///
    /// # Errors
    /// Same as for [`next`](Self::next).
    pub fn next_with_points(&mut self, row: &mut ByteRecord) -> Result<Option<u64>, TableError> {
        let line = self.next(row)?;
        let decimal = self.decimal();
        let has_comma = |cell: &[u8]| cell.contains(&b',') && number(cell, decimal).is_some();
        if decimal == Decimal::PointOrComma && row.iter().any(has_comma) {
            let with_point = |cell: &[u8]| match has_comma(cell) {
                true => String::from_utf8_lossy(cell).replace(',', ".").into_bytes(),
                false => cell.to_vec(),
            };
            *row = row.iter().map(with_point).collect::<Vec<_>>().into();
        }
        Ok(line)
    }
}

fn is_remark(line: &[u8]) -> bool {
    line.starts_with(b"#") || line.starts_with(b"//")
}

/// Whether a line is only a number.
fn is_number(line: &[u8]) -> bool {
    number(line, Decimal::PointOrComma).is_some()
}

fn cells(line: &[u8], told: Option<u8>) -> ByteRecord {
    let separator = told.unwrap_or_else(|| separator(line));
    if separator == b' ' {
        return ByteRecord::from(of_spaces(line));
    }
    let mut row = ByteRecord::new();
    let mut builder = csv::ReaderBuilder::new();
    let mut reader = builder.has_headers(false).delimiter(separator).from_reader(line);
    drop(reader.read_byte_record(&mut row));
    row
}

/// Returns the cells of a line that spaces and tabs separate.
fn of_spaces(line: &[u8]) -> Vec<&[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty()).collect()
}

/// Whether all cells are numbers, apart from one after the last separator.
fn are_numbers(cells: &[&[u8]]) -> bool {
    let cells = cells.strip_suffix(&[b"" as &[u8]]).unwrap_or(cells);
    let is_moment = |cell: &&[u8]| Moment::read(cell, Decimal::PointOrComma).is_some();
    !cells.is_empty() && cells.iter().all(is_moment)
}

/// Returns the separator of a header's cells, which is the most frequent of the three. The comma wins a tie. A header
/// of a single cell gets the semicolon, which no number contains.
fn separator(header: &[u8]) -> u8 {
    let count = |separator: &u8| header.iter().filter(|byte| *byte == separator).count();
    let most = [b'\t', b';', b','].into_iter().max_by_key(count).expect("three");
    if count(&most) == 0 { b';' } else { most }
}

/// A reader that fails if a row does not end.
struct Bounded<R> {
    input: R,
    /// Bytes read since the row began.
    in_row: usize,
    /// If spaces separate the cells, whether the last byte was one. Runs of spaces and tabs become one space.
    gap: Option<bool>,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if self.in_row >= MAX_ROW_BYTES {
            return Err(io::Error::other(TooLong));
        }
        loop {
            let read = self.input.read(bytes)?;
            self.in_row += read;
            let Some(gap) = self.gap.as_mut().filter(|_| read > 0) else { return Ok(read) };
            let mut kept = 0;
            for at in 0..read {
                let byte = if bytes[at] == b'\t' { b' ' } else { bytes[at] };
                if byte != b' ' || !*gap {
                    bytes[kept] = byte;
                    kept += 1;
                }
                *gap = b" \n".contains(&byte);
            }
            if kept > 0 {
                return Ok(kept);
            }
        }
    }
}

/// A row of more than [`MAX_ROW_BYTES`].
#[derive(Debug, thiserror::Error)]
#[error(
    "a row of more than {MAX_ROW_BYTES} bytes, which no log has; end each row, and close each quotation mark"
)]
struct TooLong;

#[cfg(test)]
mod tests;
