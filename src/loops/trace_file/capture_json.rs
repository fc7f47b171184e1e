//! Converts JSON captures of CapFrameX to a table with PresentMon's columns. Each run becomes a separate process.
//!
//! A capture is read as a stream. Only columns that a log is read by are kept, and their cells as text, so that a
//! capture takes little more memory than its file.

use std::fmt::{self, Display, Write as _};

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::columns::known_names;
use super::{Fault, MAX_FRAMES};
use crate::scene::truncate;
use crate::table::Cells;

/// Name of the array that every capture has.
const FRAMES: &str = "MsBetweenPresents";

/// Maximum number of characters of a program's name, which is in every row of the table.
const MAX_NAME_CHARS: usize = 200;

/// A column of a run, with its number among the known names.
type Column = (usize, Cells);

/// The parts of a capture that are read.
struct Capture {
    program: String,
    /// The columns of each run; `None` if the capture has no list of runs.
    runs: Option<Vec<Vec<Column>>>,
    names: Vec<&'static str>,
    /// Number of cells of each known column, over all runs.
    counts: Vec<usize>,
    is_too_long: bool,
}

/// The place of a value in a capture.
#[derive(Clone, Copy)]
enum Place {
    Capture,
    Info,
    Program,
    Runs,
    Run,
    Data,
    Column(usize),
    Cell(usize),
}

/// Reads the value at a place. A value of another type than expected there is ignored.
struct Reader<'a> {
    place: Place,
    capture: &'a mut Capture,
}

impl Reader<'_> {
    fn at(&mut self, place: Place) -> Reader<'_> {
        Reader { place, capture: self.capture }
    }

    /// Adds a cell, if a column is read.
    fn push<E: Error>(self, cell: impl Display) -> Result<(), E> {
        let Place::Cell(name) = self.place else { return Ok(()) };
        let capture = self.capture;
        let run = capture.runs.as_mut().and_then(|runs| runs.last_mut());
        let Some((_, cells)) = run.and_then(|columns| columns.last_mut()) else { return Ok(()) };
        capture.counts[name] += 1;
        let _ = write!(cells.text, "{cell}");
        match u32::try_from(cells.text.len()) {
            Ok(end) if capture.counts[name] <= MAX_FRAMES => cells.ends.push(end),
            _ => {
                capture.is_too_long = true;
                return Err(E::custom("too many frames"));
            }
        }
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<(), A::Error> {
        if let (Place::Data, Some(runs)) = (self.place, &mut self.capture.runs) {
            runs.last_mut().into_iter().for_each(Vec::clear);
        }
        while let Some(key) = map.next_key::<String>()? {
            let place = match (self.place, &*key) {
                (Place::Capture, "Info") => Some(Place::Info),
                (Place::Info, "ProcessName") => Some(Place::Program),
                (Place::Capture, "Runs") => Some(Place::Runs),
                (Place::Run, "CaptureData") => Some(Place::Data),
                (Place::Data, key) => {
                    let mut names = self.capture.names.iter();
                    names.position(|name| key.eq_ignore_ascii_case(name)).map(Place::Column)
                }
                _ => None,
            };
            match place {
                Some(place) => map.next_value_seed(self.at(place))?,
                None => map.next_value::<IgnoredAny>().map(drop)?,
            }
        }
        self.push("an object")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut seq: A) -> Result<(), A::Error> {
        let runs = &mut self.capture.runs;
        match self.place {
            Place::Runs => *runs = Some(Vec::new()),
            Place::Column(name) => {
                let run = runs.as_mut().and_then(|runs| runs.last_mut());
                run.into_iter().for_each(|columns| {
                    columns.retain(|(known, _)| *known != name);
                    columns.push((name, Cells::default()));
                });
            }
            _ => {
                while seq.next_element::<IgnoredAny>()?.is_some() {}
                return self.push("a list");
            }
        }
        loop {
            let place = match (self.place, &mut self.capture.runs) {
                (Place::Column(name), _) => Place::Cell(name),
                _ => Place::Run,
            };
            // A run is added before its value is read, and taken out if there is none.
            if let (Place::Run, Some(runs)) = (place, &mut self.capture.runs) {
                runs.push(Vec::new());
            }
            if seq.next_element_seed(self.at(place))?.is_none() {
                if let (Place::Run, Some(runs)) = (place, &mut self.capture.runs) {
                    runs.pop();
                }
                return Ok(());
            }
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        if let Place::Program = self.place {
            self.capture.program = truncate(MAX_NAME_CHARS, text);
        }
        self.push(text)
    }

    fn visit_bool<E: Error>(self, flag: bool) -> Result<(), E> {
        self.push(u8::from(flag))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<(), E> {
        self.push(number)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<(), E> {
        self.push(number)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<(), E> {
        self.push(format_args!("{number:?}"))
    }

    /// Formats a missing cell as PresentMon does.
    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.push("NA")
    }
}

/// Converts a capture to a table. If this fails, the fault explains why.
pub(super) fn table(bytes: &[u8]) -> Result<String, Fault> {
    let names: Vec<&str> = known_names().collect();
    let counts = vec![0; names.len()];
    let (program, runs) = (String::new(), None);
    let mut capture = Capture { program, runs, names, counts, is_too_long: false };
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let read = json.deserialize_any(Reader { place: Place::Capture, capture: &mut capture });
    let read = read.and_then(|()| json.end());
    if capture.is_too_long {
        return Err(Fault::ManyFrames);
    }
    read.map_err(|error| Fault::Json(error.to_string()))?;
    let Capture { program, runs, names, .. } = capture;
    let json = |what: &str| Fault::Json(what.to_owned());
    let mut runs = runs.ok_or(json("there are no Runs in it"))?;
    let frames = names.iter().position(|name| *name == FRAMES);
    for run in &mut runs {
        let rows =
            run.iter().find(|(name, _)| Some(*name) == frames).map(|(_, cells)| cells.ends.len());
        let rows = rows.ok_or(json(&format!("a run has no CaptureData with {FRAMES}")))?;
        run.retain(|(_, cells)| cells.ends.len() == rows);
    }
    let first = runs.first().ok_or(json("there is no run in it"))?;
    // A column must occur in every run.
    let in_all = |name: &usize| runs.iter().all(|run| run.iter().any(|(known, _)| known == name));
    let columns: Vec<usize> = first.iter().map(|(name, _)| *name).filter(in_all).collect();
    let mut writer = csv::Writer::from_writer(Vec::with_capacity(bytes.len()));
    let failed = |error: csv::Error| Fault::Json(error.to_string());
    let head = ["Application", "ProcessID"].into_iter();
    writer.write_record(head.chain(columns.iter().map(|name| names[*name]))).map_err(failed)?;
    for (number, run) in (1..).zip(runs) {
        let of = |name: &usize| run.iter().find(|(known, _)| known == name).map(|(_, cells)| cells);
        let cells: Vec<&Cells> = columns.iter().filter_map(of).collect();
        let number = format!("{number}");
        for row in 0..cells.first().map_or(0, |cells| cells.ends.len()) {
            let row = cells.iter().map(|cells| cells.get(row));
            writer.write_record([&*program, &number].into_iter().chain(row)).map_err(failed)?;
        }
    }
    let table = writer.into_inner().map_err(|error| Fault::Json(error.to_string()))?;
    String::from_utf8(table).map_err(|error| Fault::Json(error.to_string()))
}
