//! A reader of tables for the logs of any tool. It turns bytes into a header, rows of cells, and numbers.
//!
//! A [`TableReader`] skips the byte order mark, blank lines, remarks that begin with `#` or `//`, and up to
//! [`MAX_ABOVE`] other lines above the header, which the caller recognises. The separator of the cells in the header
//! (comma, semicolon or tab) is the separator of all rows. A [decoder](Utf8) turns UTF-16 into UTF-8 on the way.
//! Numbers may have a decimal comma unless commas separate the cells.

use std::io::{self, BufRead, Read};

use csv::ByteRecord;

mod encoding;
mod number;

pub use encoding::Utf8;
pub use number::{Decimal, number};

/// Maximum number of lines above a header, not counting remarks and blank lines.
pub const MAX_ABOVE: u64 = 16;
/// Maximum number of bytes in a row, in the header, or in a line above the header. No log has a longer line, but an
/// input without line ends has one, for example a device.
pub const MAX_ROW_BYTES: usize = 1 << 20;
/// Maximum number of bytes in the header and all lines above it.
const MAX_HEAD_BYTES: usize = 1 << 22;
/// Number of bytes that are read from an input at once.
pub(crate) const BUFFER_BYTES: usize = 1 << 20;

/// Options for reading a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// Whether a row may have fewer cells than the header. The caller then checks for the cells that it needs.
    pub short_rows: bool,
    /// Whether remarks may also appear between rows.
    pub remarks: bool,
    /// Whether a first line that is only a number is already a row. The table is then a list without a header.
    pub lists: bool,
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

/// A table, read row by row.
pub struct TableReader<R> {
    rows: csv::Reader<Bounded<io::Chain<io::Cursor<Vec<u8>>, R>>>,
    header: ByteRecord,
    /// First row of a list, which has no header.
    first: Option<ByteRecord>,
    /// Number of lines above the first line of `rows`.
    above: u64,
    header_line: u64,
    is_list: bool,
    separator: u8,
    reading: Reading,
}

impl<R: BufRead> TableReader<R> {
    /// Reads a table up to its header, which is the first line for which `is_header` is true. If there is no such line,
    /// the first line that is neither blank nor a remark becomes the header.
    ///
    /// # Errors
    /// If the input cannot be read, has too long a line, or has only blank lines and remarks.
    pub fn begin(
        mut input: R,
        reading: Reading,
        is_header: impl Fn(&ByteRecord) -> bool,
    ) -> Result<Self, TableError> {
        let too_long =
            |line| TableError { line, fault: TableFault::Input(io::Error::other(TooLong)) };
        let (mut head, mut starts) = (Vec::new(), Vec::<usize>::new());
        let (mut first, mut found) = (None, None);
        let mut candidates = 0;
        while candidates <= MAX_ABOVE && found.is_none() {
            let start = head.len();
            let read = (&mut input).take(MAX_ROW_BYTES as u64).read_until(b'\n', &mut head);
            let line = starts.len() as u64 + 1;
            read.map_err(|error| TableError { line, fault: TableFault::Input(error) })?;
            if head.len() - start == MAX_ROW_BYTES || head.len() > MAX_HEAD_BYTES {
                return Err(too_long(line));
            }
            if head.len() == start {
                break;
            }
            starts.push(start);
            let text = head[start..].trim_ascii();
            if text.is_empty() || is_remark(text) {
                continue;
            }
            let here = starts.len() - 1;
            let is_list = reading.lists && first.is_none() && is_number(text);
            found = (is_list || is_header(&cells(text))).then_some(here);
            first.get_or_insert(here);
            candidates += 1;
        }
        let at = found.or(first).ok_or(TableError { line: 1, fault: TableFault::Empty })?;
        let rest = head.split_off(starts[at]);
        let end = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
        let line = rest[..end].trim_ascii().to_vec();
        let is_list = reading.lists && is_number(&line);
        let separator = if is_list { b';' } else { separator(&line) };
        let mut rows = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(separator)
            .buffer_capacity(BUFFER_BYTES)
            .from_reader(Bounded { input: io::Cursor::new(rest).chain(input), in_row: 0 });
        let mut first = ByteRecord::new();
        let above = at as u64;
        rows.read_byte_record(&mut first).map_err(|error| TableError {
            line: above + 1,
            fault: TableFault::Input(error.into()),
        })?;
        let (header, first) =
            if is_list { (ByteRecord::from(vec![""]), Some(first)) } else { (first, None) };
        Ok(Self { rows, header, first, above, header_line: above + 1, is_list, separator, reading })
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

    /// Reads the next row and returns its line number, or `None` after the last row. Skips blank lines, and skips
    /// remarks if [`Reading::remarks`] is set.
    ///
    /// # Errors
    /// If the row cannot be read, or if it has too many or too few cells for the header.
    pub fn next(&mut self, row: &mut ByteRecord) -> Result<Option<u64>, TableError> {
        if let Some(first) = self.first.take() {
            *row = first;
            return Ok(Some(self.header_line));
        }
        loop {
            self.rows.get_mut().in_row = 0;
            let line = self.above + self.rows.position().line();
            let read = self.rows.read_byte_record(row);
            let is_there = read.map_err(|error| TableError {
                line: self.above + error.position().map_or(line, csv::Position::line),
                fault: TableFault::Input(error.into()),
            })?;
            if !is_there {
                return Ok(None);
            }
            let line = self.above + row.position().map_or(line, csv::Position::line);
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

fn cells(line: &[u8]) -> ByteRecord {
    let mut row = ByteRecord::new();
    let mut builder = csv::ReaderBuilder::new();
    let mut reader = builder.has_headers(false).delimiter(separator(line)).from_reader(line);
    drop(reader.read_byte_record(&mut row));
    row
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
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if self.in_row >= MAX_ROW_BYTES {
            return Err(io::Error::other(TooLong));
        }
        let read = self.input.read(bytes)?;
        self.in_row += read;
        Ok(read)
    }
}

/// A row of more than [`MAX_ROW_BYTES`].
#[derive(Debug, thiserror::Error)]
#[error(
    "a row of more than {MAX_ROW_BYTES} bytes, which no log has; end each row, and close each quotation mark"
)]
struct TooLong;

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the header, its line, and the rows with their lines.
    fn read(text: &str, reading: Reading, known: &str) -> (Vec<String>, u64, Vec<(u64, String)>) {
        let of = |record: &ByteRecord| -> Vec<String> {
            record.iter().map(|cell| String::from_utf8_lossy(cell).into_owned()).collect()
        };
        let is_header = |row: &ByteRecord| row.iter().any(|cell| cell == known.as_bytes());
        let mut table = TableReader::begin(text.as_bytes(), reading, is_header).unwrap();
        let (header, line) = (of(table.header()), table.header_line());
        let (mut rows, mut row) = (Vec::new(), ByteRecord::new());
        while let Some(line) = table.next(&mut row).unwrap() {
            rows.push((line, of(&row).join("|")));
        }
        (header, line, rows)
    }

    #[test]
    fn a_header_is_found_below_remarks_and_headings_with_any_separator() {
        for separator in [",", ";", "\t"] {
            let text = "# made by x\n\n// and y\nMachine:A\nos,cpu\nt,x\n0,1.5\n# later\n1,2\n"
                .replace(',', separator);
            let remarks = Reading { remarks: true, ..Reading::default() };
            let (header, line, rows) = read(&text, remarks, "x");
            assert_eq!((header.join("|").as_str(), line), ("t|x", 6), "{separator:?}");
            assert_eq!(rows, [(7, "0|1.5".to_owned()), (9, "1|2".to_owned())]);
        }
    }

    #[test]
    fn quotes_short_rows_and_lists_are_read_on_request() {
        let short = Reading { short_rows: true, ..Reading::default() };
        let (.., rows) = read("x,name\n1,\"a, b\"\n2\n", short, "x");
        assert_eq!(rows, [(2, "1|a, b".to_owned()), (3, "2".to_owned())]);
        let lists = Reading { lists: true, ..Reading::default() };
        let (header, line, rows) = read("# times\n16,7\n16.6\n", lists, "x");
        assert_eq!((header, line), (vec![String::new()], 2));
        assert_eq!(rows, [(2, "16,7".to_owned()), (3, "16.6".to_owned())]);
        let begun = TableReader::begin("a,b\n1\n".as_bytes(), Reading::default(), |_| true);
        let error = begun.unwrap().next(&mut ByteRecord::new()).unwrap_err();
        assert!(error.line == 2 && error.to_string().contains("1 of the header's 2"), "{error}");
    }

    #[test]
    fn an_empty_file_is_a_fault_and_an_unknown_header_is_the_first_line() {
        for text in ["", "\n\n", "# only a remark\n"] {
            let begun = TableReader::begin(text.as_bytes(), Reading::default(), |_| true);
            assert!(matches!(begun.map(|_| ()).unwrap_err().fault, TableFault::Empty), "{text:?}");
        }
        let (header, line, rows) = read("a,b\n1,2\n", Reading::default(), "x");
        assert_eq!((header.join("|").as_str(), line, rows.len()), ("a|b", 1, 1));
    }
}
