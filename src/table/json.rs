//! Turns JSON into a table: an array of numbers, of arrays or of objects, an object of columns, or an object on each
//! line. Objects within objects become columns with both names, one level deep.

use std::collections::HashMap;
use std::io::{self, BufRead, Read};

use serde_json::{Map, Value};

use super::MAX_ROW_BYTES;

/// Maximum number of bytes of a document. Lines of JSON have no limit.
const MAX_BYTES: usize = 64 << 20;

/// Whether text that begins so is JSON.
pub(super) fn is_json(start: &[u8]) -> bool {
    let text = start.trim_ascii_start();
    let next = text.get(1..).unwrap_or_default().trim_ascii_start().first();
    match text.first() {
        Some(b'{') => next.is_none_or(|sign| b"\"}".contains(sign)),
        Some(b'[') => next.is_none_or(|sign| b"]{[\"-".contains(sign) || sign.is_ascii_digit()),
        _ => false,
    }
}

/// A table that was JSON.
pub(super) enum Converted<R> {
    /// The whole table as CSV, and whether it has a header.
    Whole(Vec<u8>, bool),
    /// An object on each line.
    Lines(Lines<R>),
}

/// Reads JSON from `input`.
pub(super) fn convert<R: BufRead>(mut input: R) -> Result<Converted<R>, String> {
    let mut text = Vec::new();
    let said = |error: io::Error| error.to_string();
    while text.trim_ascii().is_empty() && text.len() < MAX_ROW_BYTES {
        let rest = MAX_BYTES as u64 + 1;
        if (&mut input).take(rest).read_until(b'\n', &mut text).map_err(said)? == 0 {
            break;
        }
    }
    if let Ok(Value::Object(first)) = serde_json::from_slice(&text)
        && table_in(&first).is_none()
        && !first.contains_key("traceEvents")
    {
        let names = flat(&first).into_iter().map(|(name, _)| name).collect();
        let mut lines = Lines { input, names, ready: Vec::new(), taken: 0, line: 1 };
        let names: Vec<String> = lines.names.clone();
        lines.put(names.iter().map(|name| Value::from(name.as_str())));
        lines.put_object(&first)?;
        return Ok(Converted::Lines(lines));
    }
    (&mut input)
        .take((MAX_BYTES + 1).saturating_sub(text.len()) as u64)
        .read_to_end(&mut text)
        .map_err(said)?;
    if text.len() > MAX_BYTES {
        return Err(format!(
            "it holds more than {MAX_BYTES} bytes of JSON; write CSV, or an object on each line"
        ));
    }
    let mut values = Vec::new();
    for value in serde_json::Deserializer::from_slice(&text).into_iter::<Value>() {
        values.push(
            value.map_err(|error| {
                format!("this is no JSON: {error}; write it again, or write CSV")
            })?,
        );
    }
    let value = if values.len() == 1 { values.remove(0) } else { Value::Array(values) };
    let mut rows =
        Lines { input: io::empty(), names: Vec::new(), ready: Vec::new(), taken: 0, line: 0 };
    let has_header = rows.put_document(&value)?;
    Ok(Converted::Whole(rows.ready, has_header))
}

const NO_TABLE: &str = "there is no table in this JSON; write an array of numbers or of objects, or an object of columns";

const OF_CHROMIUM: &str = "this is a trace of Chromium, which holds events and no row for each frame; list the times of its frames, one a line";

/// The array or the object of columns in a document that is its table.
fn table_in(object: &Map<String, Value>) -> Option<&Value> {
    let is_table = |value: &Value| value.as_array().is_some_and(|rows| !rows.is_empty());
    let length = |value: &&Value| value.as_array().map_or(0, Vec::len);
    let direct = object.values().filter(|value| is_table(value)).max_by_key(length);
    direct.or_else(|| object.values().filter_map(Value::as_object).find_map(table_in))
}

/// Returns the cells of an object, where objects in it have both names.
fn flat(object: &Map<String, Value>) -> Vec<(String, Value)> {
    let mut cells = Vec::new();
    for (name, value) in object {
        match value {
            Value::Object(inner) => {
                cells.extend(
                    inner.iter().map(|(own, value)| (format!("{name}.{own}"), value.clone())),
                );
            }
            Value::Array(inner) => {
                let numbered = inner.iter().enumerate();
                cells.extend(numbered.map(|(at, value)| (format!("{name}.{at}"), value.clone())));
            }
            value => cells.push((name.clone(), value.clone())),
        }
    }
    cells
}

/// Objects on lines as rows of CSV. The first line names the columns.
pub(super) struct Lines<R> {
    input: R,
    names: Vec<String>,
    ready: Vec<u8>,
    taken: usize,
    line: u64,
}

impl<R> Lines<R> {
    fn put(&mut self, cells: impl Iterator<Item = Value>) {
        for (at, cell) in cells.enumerate() {
            let text = match cell {
                Value::Null => String::new(),
                Value::String(text) => text,
                other => other.to_string(),
            };
            self.ready.extend_from_slice(if at == 0 { b"" } else { b"," });
            let needs_quotes = text.contains([',', '"', '\n', '\r', '#']) || text.is_empty();
            match needs_quotes {
                true => self
                    .ready
                    .extend_from_slice(format!("\"{}\"", text.replace('"', "\"\"")).as_bytes()),
                false => self.ready.extend_from_slice(text.as_bytes()),
            }
        }
        self.ready.push(b'\n');
    }

    fn put_object(&mut self, object: &Map<String, Value>) -> Result<(), String> {
        let cells = flat(object);
        let is_alike = cells.len() == self.names.len()
            && cells.iter().zip(&self.names).all(|((own, _), name)| own == name);
        if is_alike {
            self.put(cells.into_iter().map(|(_, cell)| cell));
            return Ok(());
        }
        let mut cells: HashMap<String, Value> = cells.into_iter().collect();
        let row: Vec<Value> =
            self.names.iter().map(|name| cells.remove(name).unwrap_or_default()).collect();
        if let Some(name) = cells.keys().next() {
            let name = crate::scene::clip(name);
            return Err(format!(
                "the key \"{name}\" is not in the first object; give each object the same keys"
            ));
        }
        self.put(row.into_iter());
        Ok(())
    }

    /// Puts the table of a document, and returns whether it has a header.
    fn put_document(&mut self, value: &Value) -> Result<bool, String> {
        match value {
            Value::Object(object) if object.contains_key("traceEvents") => Err(OF_CHROMIUM.into()),
            Value::Object(object) => {
                let table = table_in(object).ok_or(NO_TABLE)?;
                let is_of_scalars = |value: &Value| !value.is_array() && !value.is_object();
                let rows = table.as_array().ok_or(NO_TABLE)?;
                if !rows.iter().all(is_of_scalars) {
                    return self.put_document(table);
                }
                // Columns beside each other, one array each.
                let all = |object: &Map<String, Value>| -> Vec<(String, Vec<Value>)> {
                    let columns = object
                        .iter()
                        .filter_map(|(name, value)| Some((name.clone(), value.as_array()?)));
                    let columns = columns.filter(|(_, cells)| cells.len() == rows.len());
                    columns.map(|(name, cells)| (name, cells.clone())).collect()
                };
                let mut columns = all(object);
                if columns.is_empty() {
                    columns = object
                        .values()
                        .filter_map(Value::as_object)
                        .map(all)
                        .find(|it| !it.is_empty())
                        .ok_or(NO_TABLE)?;
                }
                self.put(columns.iter().map(|(name, _)| Value::from(name.as_str())));
                for row in 0..rows.len() {
                    self.put(columns.iter().map(|(_, cells)| cells[row].clone()));
                }
                Ok(true)
            }
            Value::Array(rows) => match rows.first() {
                Some(Value::Object(first))
                    if ["ph", "ts", "pid"].iter().all(|it| first.contains_key(*it)) =>
                {
                    Err(OF_CHROMIUM.into())
                }
                Some(Value::Object(first)) => {
                    self.names = flat(first).into_iter().map(|(name, _)| name).collect();
                    let names = self.names.clone();
                    self.put(names.into_iter().map(Value::from));
                    for (number, row) in (1..).zip(rows) {
                        let object =
                            row.as_object().ok_or(format!("object {number} is no object"))?;
                        self.put_object(object)
                            .map_err(|fault| format!("object {number}: {fault}"))?;
                    }
                    Ok(true)
                }
                Some(Value::Array(first)) => {
                    let has_header = first.iter().all(Value::is_string);
                    for (number, row) in (1..).zip(rows) {
                        let cells = row.as_array().ok_or(format!("row {number} is no array"))?;
                        self.put(cells.iter().cloned());
                    }
                    Ok(has_header)
                }
                Some(_) => {
                    rows.iter().for_each(|cell| self.put([cell.clone()].into_iter()));
                    Ok(false)
                }
                None => Err(NO_TABLE.into()),
            },
            _ => Err(NO_TABLE.into()),
        }
    }
}

impl<R: BufRead> BufRead for Lines<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.taken == self.ready.len() {
            (self.taken, self.line) = (0, self.line + 1);
            self.ready.clear();
            let mut text = Vec::new();
            let read = (&mut self.input).take(MAX_ROW_BYTES as u64).read_until(b'\n', &mut text)?;
            if read == 0 {
                break;
            }
            let line = self.line;
            let fault = |what: String| io::Error::other(format!("line {line}: {what}"));
            match text.trim_ascii() {
                [] => {}
                text => {
                    let object: Map<String, Value> = serde_json::from_slice(text)
                        .map_err(|error| fault(format!("this is no object of JSON: {error}")))?;
                    self.put_object(&object).map_err(fault)?;
                }
            }
        }
        Ok(&self.ready[self.taken..])
    }

    fn consume(&mut self, count: usize) {
        self.taken += count;
    }
}

impl<R: BufRead> Read for Lines<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let ready = self.fill_buf()?;
        let count = ready.len().min(bytes.len());
        bytes[..count].copy_from_slice(&ready[..count]);
        self.consume(count);
        Ok(count)
    }
}
