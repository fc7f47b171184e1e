//! A table whose columns are described once, and which is written as aligned text, as CSV or as JSON.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, Write};
use std::mem;

use clap::ValueEnum;
use serde_json::{Map, Value};

use super::{Output, print, print_json};
use crate::commands::error::Error;
use crate::commands::visible::{visible, visible_json};
use crate::run::csv_row;
use crate::sim::number::counted;

/// How data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    /// Aligned columns, for people
    Text,
    /// An array of objects, for programs
    Json,
}

impl TableFormat {
    /// Prints text in this format to standard output.
    pub(crate) fn print(self, text: &str) -> Result<(), Error> {
        match self {
            Self::Text => print(text),
            Self::Json => print_json(text),
        }
    }
}

/// How a tidy table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RowFormat {
    /// Comma-separated values under a header
    Csv,
    /// An array of objects with the same names
    Json,
}

/// A column of a table, which is one property of the listed items.
pub(crate) struct Column<T> {
    /// Name of the column in JSON.
    pub(crate) key: &'static str,
    /// Heading of the column in text. `None` for a long property, which is left out of the text.
    heading: Option<&'static str>,
    /// Returns the property of an item, or `Null` if it has no meaning.
    value: fn(&T) -> Value,
}

impl<T> Column<T> {
    /// Creates a column that is left out of the text.
    pub(crate) const fn new(key: &'static str, value: fn(&T) -> Value) -> Self {
        Self { key, heading: None, value }
    }

    /// Creates a column that has a heading in the text.
    pub(crate) const fn shown(
        key: &'static str,
        heading: &'static str,
        value: fn(&T) -> Value,
    ) -> Self {
        Self { key, heading: Some(heading), value }
    }
}

/// Returns a JSON array that has one object for each of `items`.
pub(crate) fn json<T>(columns: &[Column<T>], items: &[T]) -> Value {
    let object = |item: &T| -> Value {
        let fields = columns.iter().map(|column| (column.key.to_owned(), (column.value)(item)));
        Value::Object(fields.collect::<Map<_, _>>())
    };
    items.iter().map(object).collect()
}

/// Writes a tidy table row by row. As CSV it has a header, and as JSON it is an array with one object per line.
pub(crate) struct RowWriter<W> {
    out: W,
    format: RowFormat,
    keys: Vec<String>,
    is_first: bool,
}

impl<W: Write> RowWriter<W> {
    /// Begins a table with these columns.
    pub(crate) fn begin<K: Into<String>>(
        mut out: W,
        format: RowFormat,
        keys: impl IntoIterator<Item = K>,
    ) -> io::Result<Self> {
        let keys: Vec<String> = keys.into_iter().map(Into::into).collect();
        match format {
            RowFormat::Csv => writeln!(out, "{}", keys.join(","))?,
            RowFormat::Json => write!(out, "[")?,
        }
        Ok(Self { out, format, keys, is_first: true })
    }

    /// Writes a row with one cell per column.
    pub(crate) fn row(&mut self, cells: &[Value]) -> io::Result<()> {
        let Self { out, format, keys, is_first } = self;
        if *format == RowFormat::Csv {
            let cells = cells.iter().map(|cell| match in_a_cell(cell) {
                Value::Null => "".into(),
                Value::String(text) => visible(text),
                // Numbers are written as in JSON, so that they read back the same.
                cell => Cow::Owned(cell.to_string()),
            });
            let cells: Vec<Cow<'_, str>> = cells.collect();
            let cells = cells.iter().map(|cell| -> &dyn Display { cell });
            return out.write_all(csv_row(&cells.collect::<Vec<_>>()).as_bytes());
        }
        out.write_all(if mem::take(is_first) { b"\n{" } else { b",\n{" })?;
        for (column, (key, cell)) in keys.iter().zip(cells).enumerate() {
            write!(out, "{}\"{key}\":", if column == 0 { "" } else { "," })?;
            out.write_all(visible_json(&cell.to_string()).as_bytes())?;
        }
        out.write_all(b"}")
    }

    /// Ends the table and returns its output.
    pub(crate) fn end(mut self) -> io::Result<W> {
        if self.format == RowFormat::Json {
            self.out.write_all(b"\n]\n")?;
        }
        Ok(self.out)
    }
}

/// Writes a whole table to `out`. If it is a file, reports the number of rows on standard error.
pub(crate) fn write_rows<T>(
    out: Output,
    format: RowFormat,
    columns: &[Column<T>],
    items: &[T],
) -> Result<(), Error> {
    let out = append_rows(out, format, columns, items)?;
    out.finish(&counted(items.len(), "row"))
}

fn append_rows<W: Write, T>(
    out: W,
    format: RowFormat,
    columns: &[Column<T>],
    items: &[T],
) -> io::Result<W> {
    let mut writer = RowWriter::begin(out, format, columns.iter().map(|column| column.key))?;
    for item in items {
        let cells: Vec<Value> = columns.iter().map(|column| (column.value)(item)).collect();
        writer.row(&cells)?;
    }
    writer.end()
}

/// Returns the value that a cell shows. If the value is an object, such as a verdict, the cell shows its word.
fn in_a_cell(value: &Value) -> &Value {
    value.get("word").unwrap_or(value)
}

/// Returns a line of headings and a line for each of `items`. The columns are aligned, and each line begins with
/// `indent`.
pub(crate) fn text<'i, T: 'i>(
    columns: &[Column<T>],
    items: impl IntoIterator<Item = &'i T>,
    indent: &str,
) -> String {
    let shown: Vec<_> =
        columns.iter().filter_map(|column| Some((column.heading?, column.value))).collect();
    let headings = shown.iter().map(|(heading, _)| (*heading).to_owned()).collect();
    let cells = |item| shown.iter().map(|(_, value)| plain(&value(item))).collect();
    let rows: Vec<Vec<String>> =
        std::iter::once(headings).chain(items.into_iter().map(cells)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<_> = (0..shown.len()).filter_map(width).collect();
    let line = |row: Vec<String>| {
        let padded = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        format!("{indent}{}", padded.collect::<Vec<_>>().join("  ")).trim_end().to_owned() + "\n"
    };
    rows.into_iter().map(line).collect()
}

fn plain(value: &Value) -> String {
    match in_a_cell(value) {
        Value::Null => "-".into(),
        Value::Bool(true) => "yes".into(),
        Value::Bool(false) => "no".into(),
        Value::Number(number) if number.is_f64() => short(number.as_f64().unwrap_or(f64::NAN)),
        Value::String(text) => text.clone(),
        Value::Array(values) => values.iter().map(plain).collect::<Vec<_>>().join(" "),
        Value::Number(_) | Value::Object(_) => value.to_string(),
    }
}

/// Formats a number with at most three decimals, as a person would write it.
fn short(value: f64) -> String {
    let rounded = format!("{value:.3}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &[Column<(&str, Option<f64>)>] = &[
        Column::shown("name", "NAME", |row| row.0.into()),
        Column::shown("limit", "h ω", |row| row.1.into()),
        Column::new("half", |row| row.1.map(|limit| limit / 2.0).into()),
    ];
    const ROWS: &[(&str, Option<f64>)] = &[("α", Some(2.0)), ("beta", None), ("c", Some(0.12345))];

    #[test]
    fn text_is_aligned_by_characters_and_has_no_trailing_blanks() {
        assert_eq!(text(COLUMNS, ROWS, " "), " NAME  h ω\n α     2\n beta  -\n c     0.123\n");
    }

    #[test]
    fn json_has_every_column_to_the_last_digit() {
        let expected = r#"[{"name":"α","limit":2.0,"half":1.0},{"name":"beta","limit":null,"half":null},{"name":"c","limit":0.12345,"half":0.061725}]"#;
        assert_eq!(json(COLUMNS, ROWS).to_string(), expected);
    }

    #[test]
    fn csv_and_json_have_the_same_rows() {
        let rows = |format| String::from_utf8(append_rows(vec![], format, COLUMNS, ROWS).unwrap());
        let csv = "name,limit,half\nα,2.0,1.0\nbeta,,\nc,0.12345,0.061725\n";
        assert_eq!(rows(RowFormat::Csv).unwrap(), csv);
        let json = rows(RowFormat::Json).unwrap();
        assert_eq!(json.lines().count(), ROWS.len() + 2);
        let parsed: Value = serde_json::from_str(&json).unwrap();
        assert_eq!(parsed, super::json(COLUMNS, ROWS));
    }
}
