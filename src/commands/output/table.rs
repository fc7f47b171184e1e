//! One description of a list's columns, written as aligned text, as CSV or as JSON.

use clap::ValueEnum;
use serde_json::{Map, Value};

/// How data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    /// Aligned columns, for people
    Text,
    /// An array of objects, for programs
    Json,
}

/// How a tidy table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RowFormat {
    /// Comma-separated values under a header
    Csv,
    /// An array of objects with the same names
    Json,
}

/// One property of the things listed.
pub(crate) struct Column<T> {
    /// Its name in JSON.
    pub(crate) key: &'static str,
    /// Its heading in text; `None` where the text leaves it out, because it is long.
    pub(crate) heading: Option<&'static str>,
    /// The property. `Null` where it has no meaning.
    pub(crate) value: fn(&T) -> Value,
}

/// An array with one object for each of `items`.
pub(crate) fn json<T>(columns: &[Column<T>], items: &[T]) -> Value {
    items.iter().map(|item| object(columns, item)).collect()
}

fn object<T>(columns: &[Column<T>], item: &T) -> Value {
    let fields = columns.iter().map(|column| (column.key.to_owned(), (column.value)(item)));
    Value::Object(fields.collect::<Map<_, _>>())
}

/// A tidy table with a line for each of `items`: CSV below a header, or JSON objects.
pub(crate) fn rows<T>(format: RowFormat, columns: &[Column<T>], items: &[T]) -> String {
    match format {
        RowFormat::Csv => {
            let line = |cells: Vec<String>| cells.join(",") + "\n";
            let head = columns.iter().map(|column| column.key.to_owned()).collect();
            let cells = |item| columns.iter().map(|column| bare(&(column.value)(item))).collect();
            std::iter::once(head).chain(items.iter().map(cells)).map(line).collect()
        }
        RowFormat::Json => {
            let objects = items.iter().map(|item| object(columns, item).to_string());
            format!("[\n{}\n]\n", objects.collect::<Vec<_>>().join(",\n"))
        }
    }
}

/// A cell of CSV: text quoted only if it must be, numbers as in JSON, so that they read back the same, and
/// nothing for `Null`.
fn bare(value: &Value) -> String {
    match in_a_cell(value) {
        Value::Null => String::new(),
        Value::String(text) => csv_cell(text),
        value => value.to_string(),
    }
}

/// What stands in a cell for a value: for an object, such as a verdict, its word.
fn in_a_cell(value: &Value) -> &Value {
    value.get("word").unwrap_or(value)
}

/// Text as a cell of CSV, quoted if it must be.
pub(crate) fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

/// A line of headings and a line for each of `items`, aligned; `indent` stands before each.
pub(crate) fn text<T>(columns: &[Column<T>], items: &[T], indent: &str) -> String {
    let shown: Vec<_> =
        columns.iter().filter_map(|column| Some((column.heading?, column.value))).collect();
    let headings = shown.iter().map(|(heading, _)| (*heading).to_owned()).collect();
    let cells = |item| shown.iter().map(|(_, value)| plain(&value(item))).collect();
    let rows: Vec<Vec<String>> = std::iter::once(headings).chain(items.iter().map(cells)).collect();
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

/// A number to four digits, more for large whole ones, as a person would write it.
fn short(value: f64) -> String {
    let rounded = format!("{value:.3}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &[Column<(&str, Option<f64>)>] = &[
        Column { key: "name", heading: Some("NAME"), value: |row| row.0.into() },
        Column { key: "limit", heading: Some("h ω"), value: |row| row.1.into() },
        Column { key: "half", heading: None, value: |row| row.1.map(|limit| limit / 2.0).into() },
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
    fn rows_hold_the_same_in_csv_and_json() {
        let csv = "name,limit,half\nα,2.0,1.0\nbeta,,\nc,0.12345,0.061725\n";
        assert_eq!(rows(RowFormat::Csv, COLUMNS, ROWS), csv);
        let json = rows(RowFormat::Json, COLUMNS, ROWS);
        assert_eq!(json.lines().count(), ROWS.len() + 2);
        let parsed: Value = serde_json::from_str(&json).unwrap();
        assert_eq!(parsed, super::json(COLUMNS, ROWS));
    }

    #[test]
    fn cells_with_commas_quotes_or_newlines_are_quoted() {
        assert_eq!(csv_cell("free spring"), "free spring");
        assert_eq!(csv_cell("a, b"), "\"a, b\"");
        assert_eq!(csv_cell("the \"Pride\""), "\"the \"\"Pride\"\"\"");
    }
}
