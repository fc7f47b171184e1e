//! Turns JSON into a table: an array of numbers, of arrays or of objects, an object of columns, or an object on each
//! line. Objects within objects become columns with both names, one level deep.
//!
//! Values stay text until they are cells, so that a document takes little more memory than its file.

use std::collections::HashMap;
use std::fmt;
use std::io::{self, BufRead, Read};

use serde::de::{Deserializer as _, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::MAX_ROW_BYTES;
use crate::scene::clip;

/// Maximum number of bytes of a document. Lines of JSON have no limit.
const MAX_BYTES: usize = 64 << 20;
/// Maximum number of columns.
const MAX_COLUMNS: usize = 10_000;
/// Maximum ratio of a table's bytes to the document's, which objects without most of the keys may exceed.
const MAX_GROWTH: usize = 2;

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
    let first = String::from_utf8_lossy(&text).into_owned();
    let is_object = first.trim_start().starts_with('{') && !first.contains("\"traceEvents\"");
    if is_object && members(&first).is_ok() && has_more(&mut input).map_err(said)? {
        let mut lines = Lines::of(first.len(), input);
        lines.put_row(&first)?;
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
    let text = String::from_utf8_lossy(&text);
    let values = || serde_json::Deserializer::from_str(&text).into_iter::<&RawValue>();
    let mut table = Lines::of(text.len(), io::empty());
    let is_one = values().nth(1).is_none();
    for value in values() {
        let value = value
            .map_err(|error| format!("this is no JSON: {error}; write it again, or write CSV"))?;
        if is_one { table.put_document(value.get(), true) } else { table.put_row(value.get()) }?;
    }
    if table.kind.is_none() {
        return Err(NO_TABLE.into());
    }
    Ok(Converted::Whole(table.ready, table.has_header))
}

const NO_TABLE: &str = "there is no table in this JSON; write an array of numbers or of objects, or an object of columns";

const OF_CHROMIUM: &str = "this is a trace of Chromium, which holds events and no row for each frame; list the times of its frames, one a line";

/// Visits each member of an object with its key, or each element of an array.
struct Each<F>(F);

impl<'a, F: FnMut(Option<String>, &'a str) -> Result<(), String>> Visitor<'a> for Each<F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object or an array")
    }

    fn visit_map<A: MapAccess<'a>>(mut self, mut map: A) -> Result<(), A::Error> {
        while let Some((key, value)) = map.next_entry::<String, &RawValue>()? {
            (self.0)(Some(key), value.get()).map_err(A::Error::custom)?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'a>>(mut self, mut seq: A) -> Result<(), A::Error> {
        while let Some(value) = seq.next_element::<&RawValue>()? {
            (self.0)(None, value.get()).map_err(A::Error::custom)?;
        }
        Ok(())
    }
}

/// Calls `f` for each member of an object with its key, or for each element of an array.
fn each<'a>(
    text: &'a str,
    f: impl FnMut(Option<String>, &'a str) -> Result<(), String>,
) -> Result<(), String> {
    let mut json = serde_json::Deserializer::from_str(text);
    json.deserialize_any(Each(f)).and_then(|()| json.end()).map_err(|error| error.to_string())
}

/// Returns the members of an object, or the elements of an array with their numbers from 0 as keys.
fn members(text: &str) -> Result<Vec<(String, &str)>, String> {
    let mut members = Vec::new();
    each(text, |key, value| {
        if members.len() == MAX_COLUMNS {
            return Err(format!("more than {MAX_COLUMNS} columns; write fewer"));
        }
        members.push((key.unwrap_or_else(|| members.len().to_string()), value));
        Ok(())
    })?;
    Ok(members)
}

/// Returns the number of elements of an array; 0 for any other value.
fn length(value: &str) -> usize {
    let mut count = 0;
    let is_array = value.starts_with('[');
    let counted = is_array.then(|| {
        each(value, |_, _| {
            count += 1;
            Ok(())
        })
    });
    counted.and_then(Result::ok).map_or(0, |()| count)
}

/// Skips blank lines, and returns whether there is more.
fn has_more(input: &mut impl BufRead) -> io::Result<bool> {
    loop {
        let bytes = input.fill_buf()?;
        let blank = bytes.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        match bytes.len() {
            0 => return Ok(false),
            all if blank < all => return Ok(true),
            all => input.consume(all),
        }
    }
}

/// Returns the cells of an object or of an array, where objects and arrays in it have both names.
fn flat(text: &str) -> Result<Vec<(String, &str)>, String> {
    let mut cells = Vec::new();
    for (name, value) in members(text)? {
        match value.starts_with(['[', '{']) && text.starts_with('{') {
            true => {
                let inner = members(value)?.into_iter();
                cells.extend(inner.map(|(own, value)| (format!("{name}.{own}"), value)));
            }
            false => cells.push((name, value)),
        }
    }
    Ok(cells)
}

/// The kind of the rows of a table.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Object,
    Array,
    Number,
}

/// Rows as CSV. Those of objects are below a line that names the columns.
pub(super) struct Lines<R> {
    input: R,
    kind: Option<Kind>,
    has_header: bool,
    names: Vec<String>,
    ready: Vec<u8>,
    /// Number of bytes that rows may still take.
    room: usize,
    taken: usize,
    line: u64,
}

impl<R> Lines<R> {
    /// Begins a table of text of `bytes`, which more lines of `input` may follow.
    fn of(bytes: usize, input: R) -> Self {
        let room = MAX_GROWTH * bytes + MAX_ROW_BYTES;
        let (names, ready) = (Vec::new(), Vec::new());
        Self { input, kind: None, has_header: false, names, ready, room, taken: 0, line: 1 }
    }

    /// Puts a row of cells of JSON.
    fn put<'a>(&mut self, cells: impl IntoIterator<Item = &'a str>) -> Result<(), String> {
        let before = self.ready.len();
        for (at, cell) in cells.into_iter().enumerate() {
            let unquoted = cell.starts_with('"').then(|| serde_json::from_str::<String>(cell));
            let text = match &unquoted {
                Some(Ok(text)) => text,
                _ if cell == "null" => "",
                _ => cell,
            };
            self.ready.extend_from_slice(if at == 0 { b"" } else { b"," });
            let needs_quotes = text.contains([',', '"', '\n', '\r', '#']) || text.is_empty();
            match needs_quotes {
                true => {
                    let quoted = format!("\"{}\"", text.replace('"', "\"\""));
                    self.ready.extend_from_slice(quoted.as_bytes());
                }
                false => self.ready.extend_from_slice(text.as_bytes()),
            }
        }
        self.ready.push(b'\n');
        let room = self.room.checked_sub(self.ready.len() - before);
        self.room = room.ok_or("most objects lack most of the keys; give each the same")?;
        Ok(())
    }

    fn put_names(&mut self) -> Result<(), String> {
        self.has_header = true;
        let names: Vec<String> = self
            .names
            .iter()
            .map(|name| serde_json::Value::from(name.as_str()).to_string())
            .collect();
        self.put(names.iter().map(String::as_str))
    }

    /// Puts a row: an object, an array, or a number.
    fn put_row(&mut self, text: &str) -> Result<(), String> {
        let text = text.trim();
        let kind = match text.as_bytes().first() {
            Some(b'{') => Kind::Object,
            Some(b'[') => Kind::Array,
            _ => Kind::Number,
        };
        let is_first = self.kind.is_none();
        if *self.kind.get_or_insert(kind) != kind {
            return Err(format!("{} is no row like the first; write rows of one kind", clip(text)));
        }
        if kind == Kind::Number {
            return self.put([text]);
        }
        let cells = flat(text).map_err(|fault| format!("this is no row of JSON: {fault}"))?;
        if kind == Kind::Array {
            self.has_header |= is_first && cells.iter().all(|(_, cell)| cell.starts_with('"'));
            return self.put(cells.into_iter().map(|(_, cell)| cell));
        }
        if cells.is_empty() {
            return Err(NO_TABLE.into());
        }
        if is_first {
            if ["ph", "ts", "pid"].iter().all(|of| cells.iter().any(|(name, _)| name == of)) {
                return Err(OF_CHROMIUM.into());
            }
            self.names = cells.iter().map(|(name, _)| name.clone()).collect();
            self.put_names()?;
        }
        let is_alike = cells.len() == self.names.len()
            && cells.iter().zip(&self.names).all(|((own, _), name)| own == name);
        if is_alike {
            return self.put(cells.into_iter().map(|(_, cell)| cell));
        }
        let mut cells: HashMap<String, &str> = cells.into_iter().collect();
        let row: Vec<&str> =
            self.names.iter().map(|name| cells.remove(name).unwrap_or("null")).collect();
        match cells.keys().next() {
            Some(name) => Err(format!(
                "the key \"{}\" is not in the first object; give each object the same keys",
                clip(name)
            )),
            None => self.put(row),
        }
    }

    /// Puts the table of a document. The object with its columns may be in another object, `or_nested`.
    fn put_document(&mut self, text: &str, or_nested: bool) -> Result<(), String> {
        if !text.starts_with('{') {
            let mut number = 0;
            return match text.starts_with('[') {
                true => each(text, |_, row| {
                    number += 1;
                    self.put_row(row).map_err(|fault| format!("row {number}: {fault}"))
                }),
                false => Err(NO_TABLE.into()),
            };
        }
        let members = members(text)?;
        if members.iter().any(|(key, _)| key == "traceEvents") {
            return Err(OF_CHROMIUM.into());
        }
        let lengths: Vec<usize> = members.iter().map(|(_, value)| length(value)).collect();
        let longest = lengths.iter().copied().max().unwrap_or(0);
        let of_longest = || members.iter().zip(&lengths).filter(|(_, length)| **length == longest);
        let first = of_longest().next().filter(|_| longest > 0);
        let Some(((_, first), _)) = first else {
            let nested = members.iter().filter(|(_, value)| or_nested && value.starts_with('{'));
            let mut tables = nested.map(|(_, value)| self.put_document(value, false));
            return tables.find(Result::is_ok).unwrap_or_else(|| self.put_row(text));
        };
        let is_of_rows = first[1..].trim_start().starts_with(['[', '{']);
        if is_of_rows {
            return self.put_document(first, false);
        }
        // Columns beside each other, one array each.
        let mut columns = Vec::new();
        for ((name, value), _) in of_longest() {
            let mut cells = Cells::default();
            each(value, |_, cell| {
                cells.text.push_str(cell);
                cells.ends.push(cells.text.len() as u32);
                Ok(())
            })?;
            self.names.push(name.clone());
            columns.push(cells);
        }
        self.kind = Some(Kind::Array);
        self.put_names()?;
        (0..longest).try_for_each(|row| self.put(columns.iter().map(|cells| cells.get(row))))
    }
}

/// The cells of a column, one after the other, and the end of each.
#[derive(Clone, Default)]
pub struct Cells {
    /// All cells of the column.
    pub text: String,
    /// End of each cell in the text, in bytes.
    pub ends: Vec<u32>,
}

impl Cells {
    /// Returns the cell in a row.
    pub fn get(&self, row: usize) -> &str {
        let start = row.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.text[start as usize..self.ends[row] as usize]
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
            let text = String::from_utf8_lossy(text.trim_ascii());
            self.room += MAX_GROWTH * text.len();
            if !text.is_empty() {
                let line = self.line;
                self.put_row(&text)
                    .map_err(|what| io::Error::other(format!("line {line}: {what}")))?;
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
