//! Reads a `[[law]]`: an equation of motion that the scene writes itself.

use std::ops::Range as Span;
use std::sync::Arc;

use super::fields::{TOP, optional, required};
use super::nearest::{self, nearest};
use super::table::{Field, Named, Table, Written};
use super::wanted::Wanted;
use crate::sim::bodies::{ClaimHorizon, Kind, Range, check_law, law_kind};
use crate::sim::law::{
    CoordinateText, LawText, Layout, MAX_CONSTANTS, MAX_COORDINATES, Part, Refusal, Remedy, UNITS,
};

/// The name of the table array.
pub(super) const LAW: &str = "law";

const CONSTANTS: Field = optional("constants");
const COORDINATES: Field = required("coordinates", "what moves");
const ENERGY: Field = optional("energy");
const PLANE: Field = optional("plane");
const DRAW: Field = optional("draw");
const UNIT: Field = optional("unit");
const START: Field = optional("start");
const START_VELOCITY: Field = optional("start_velocity");
const ACCELERATION: Field = required("acceleration", "its second derivative by time");
const EXACT: Field = optional("exact");
const AT: Field = optional("at");
const KICK: Field = optional("kick");

/// The most characters of the name of a unit or of a layout.
const MAX_WORD_CHARS: usize = 16;

/// A name and its bytes in the file.
type WrittenName = (String, Span<usize>);

/// A law as the file writes it.
struct WrittenLaw {
    constants: Vec<WrittenName>,
    coordinates: Vec<WrittenCoordinate>,
    energy: Option<Written>,
    plane: Option<[usize; 2]>,
    layout: Layout,
}

struct WrittenCoordinate {
    name: String,
    span: Span<usize>,
    unit: &'static str,
    acceleration: Option<Written>,
    exact: Option<Written>,
    at: Option<[WrittenName; 2]>,
    start: Option<f64>,
    start_velocity: Option<f64>,
    kick: Option<f64>,
}

/// The kind of a law and the values of its parameters; each is `None` where there is a fault. Its claims are held against
/// the motion at the ticks of `horizon`.
pub(super) fn read_law(
    row: &mut Table<'_>,
    horizon: ClaimHorizon,
) -> (Option<Arc<Kind>>, Option<Vec<f64>>) {
    let (constants, numbers) = read_constants(row);
    let coordinates = read_coordinates(row);
    let energy = row.expression(ENERGY);
    let plane = coordinates.as_ref().and_then(|coordinates| read_plane(row, coordinates));
    let layout = read_layout(row, coordinates.as_deref().unwrap_or_default());
    check_one_picture(row, coordinates.as_deref().unwrap_or_default());
    let Some(coordinates) = coordinates else { return (None, None) };
    let law = WrittenLaw { constants, coordinates, energy, plane, layout };
    let Some(text) = law.text() else { return (None, None) };
    let kind = match law_kind(text) {
        Ok(kind) => kind,
        Err(refusals) => {
            refusals.into_iter().for_each(|refusal| law.complain(row, refusal));
            return (None, None);
        }
    };
    let values = law.values(numbers);
    if let (Some(values), Some(equations)) = (&values, kind.law())
        && row.is_faultless()
        && let Err(refusal) = check_law(equations, values, horizon)
    {
        law.complain(row, refusal);
    }
    (Some(kind), values)
}

/// The names of the constants, and their values unless one has a fault.
fn read_constants(row: &mut Table<'_>) -> (Vec<WrittenName>, Option<Vec<f64>>) {
    let entries = row.entries(CONSTANTS, &Wanted::Constants).unwrap_or_default();
    check_count(row, "constants", &entries, MAX_CONSTANTS);
    let entries = &entries[..entries.len().min(MAX_CONSTANTS)];
    let numbers: Vec<_> = entries.iter().map(|entry| row.number_of(entry, Range::ANY)).collect();
    let names = entries.iter().map(|entry| (entry.key.to_owned(), entry.span.clone()));
    (names.collect(), numbers.into_iter().collect())
}

fn check_count(row: &mut Table<'_>, what: &str, entries: &[Named<'_>], most: usize) {
    if let Some(entry) = entries.get(most) {
        let what = format!("the law has {} {what}", entries.len());
        row.complain(entry.span.clone(), what, format!("keep at most {most}"));
    }
}

fn read_coordinates(row: &mut Table<'_>) -> Option<Vec<WrittenCoordinate>> {
    let place = "law.coordinates";
    let entries = row.entries(COORDINATES, &Wanted::Coordinates(place))?;
    check_count(row, "coordinates", &entries, MAX_COORDINATES);
    if entries.is_empty() {
        let remedy = Wanted::Coordinates(place).remedy();
        row.complain(row.span(COORDINATES.key), "the law has no coordinate", remedy);
        return None;
    }
    let mut coordinates = Vec::new();
    for (n, entry) in entries.iter().enumerate().take(MAX_COORDINATES) {
        let mut table = row.table_of(entry, place)?;
        let number = |table: &mut Table<'_>, field: Field, default: f64| match table.has(field.key)
        {
            true => table.number(field, Range::ANY),
            false => {
                table.knows(field.key);
                Some(default)
            }
        };
        coordinates.push(WrittenCoordinate {
            name: entry.key.into(),
            span: entry.span.clone(),
            unit: read_unit(&mut table),
            start: number(&mut table, START, 0.0),
            start_velocity: number(&mut table, START_VELOCITY, 0.0),
            acceleration: table.expression(ACCELERATION),
            exact: table.expression(EXACT),
            at: read_at(&mut table),
            kick: number(&mut table, KICK, f64::from(u8::from(n == 0))),
        });
        row.adopt(table, &TOP);
    }
    Some(coordinates)
}

fn read_at(table: &mut Table<'_>) -> Option<[WrittenName; 2]> {
    let written = table.names(AT, &Wanted::At)?;
    let pair = <[_; 2]>::try_from(written);
    if pair.is_err() {
        table.complain(table.span(AT.key), "`at` is not an x and a y", Wanted::At.remedy());
    }
    Some(pair.ok()?.map(|(span, text)| (text.to_owned(), span)))
}

fn read_unit(table: &mut Table<'_>) -> &'static str {
    let Some(written) = table.text(UNIT, MAX_WORD_CHARS) else { return UNITS[0] };
    if let Some(unit) = UNITS.iter().find(|unit| **unit == written) {
        return unit;
    }
    let what = format!("unknown unit {written:?}");
    let remedy = offer(&written, &UNITS);
    table.complain(table.span(UNIT.key), what, remedy);
    UNITS[0]
}

fn read_plane(row: &mut Table<'_>, coordinates: &[WrittenCoordinate]) -> Option<[usize; 2]> {
    let names = row.names(PLANE, &Wanted::Plane)?;
    let known: Vec<&str> = coordinates.iter().map(|coordinate| &*coordinate.name).collect();
    let mut places = Vec::new();
    for (span, name) in &names {
        match known.iter().position(|known| known == name) {
            Some(place) => places.push(place),
            None => {
                let what = format!("no coordinate is called {name:?}");
                row.complain(span.clone(), what, offer(name, &known));
                return None;
            }
        }
    }
    match places[..] {
        [x, y] if x != y => Some([x, y]),
        _ => {
            let what = "`plane` does not name two coordinates";
            row.complain(row.span(PLANE.key), what, Wanted::Plane.remedy());
            None
        }
    }
}

fn read_layout(row: &mut Table<'_>, coordinates: &[WrittenCoordinate]) -> Layout {
    let Some(written) = row.text_for(DRAW, MAX_WORD_CHARS, Wanted::Layout) else {
        return Layout::default();
    };
    let known = Layout::ALL.map(|(id, _)| id);
    let found = Layout::ALL.iter().find(|(id, _)| *id == written);
    let is_pair = matches!(coordinates, [body, wheel, ..] if body.unit == wheel.unit);
    let (what, remedy) = match found {
        None => (format!("unknown picture {written:?}"), offer(&written, &known)),
        Some(_) if row.has(PLANE.key) => {
            ("the law has a `plane` and a `draw`".into(), "leave one of them out".into())
        }
        Some((_, Layout::Carriage)) if !is_pair => (
            "a carriage needs two coordinates of one unit: its own height, and then its wheel's"
                .into(),
            "write another `draw`, or put these two first".into(),
        ),
        Some((_, layout)) => return *layout,
    };
    row.complain(row.span(DRAW.key), what, remedy);
    Layout::default()
}

/// Refuses a `plane` or a `draw` beside places of coordinates.
fn check_one_picture(row: &mut Table<'_>, coordinates: &[WrittenCoordinate]) {
    let has_places = coordinates.iter().any(|coordinate| coordinate.at.is_some());
    let other = [PLANE, DRAW].into_iter().find(|field| row.has(field.key));
    if let (true, Some(Field { key, .. })) = (has_places, other) {
        let what = format!("the law has a `{key}`, and a coordinate has an `at`");
        row.complain(row.span(key), what, "leave one of them out");
    }
}

fn offer(written: &str, known: &[&str]) -> String {
    nearest::offer(nearest(written, known.iter().map(|name| (*name, *name))), known, '`')
}

impl WrittenLaw {
    /// `None` if an acceleration is missing.
    fn text(&self) -> Option<LawText> {
        let text = |written: &Written| written.text.clone();
        let coordinate = |of: &WrittenCoordinate| {
            Some(CoordinateText {
                name: of.name.clone(),
                unit: of.unit,
                acceleration: text(of.acceleration.as_ref()?),
                exact: of.exact.as_ref().map(text),
                at: of.at.as_ref().map(|at| at.each_ref().map(|(text, _)| text.clone())),
            })
        };
        Some(LawText {
            constants: self.constants.iter().map(|(name, _)| name.clone()).collect(),
            coordinates: self.coordinates.iter().map(coordinate).collect::<Option<_>>()?,
            energy: self.energy.as_ref().map(text),
            plane: self.plane,
            layout: self.layout,
        })
    }

    fn values(&self, constants: Option<Vec<f64>>) -> Option<Vec<f64>> {
        let of = |read: fn(&WrittenCoordinate) -> Option<f64>| {
            self.coordinates.iter().map(read).collect::<Option<Vec<f64>>>()
        };
        let [starts, velocities, kicks] =
            [of(|it| it.start)?, of(|it| it.start_velocity)?, of(|it| it.kick)?];
        Some([constants?, starts, velocities, kicks].concat())
    }

    /// Reports what is wrong with a part of the law at its place in the file.
    fn complain(&self, row: &mut Table<'_>, refusal: Refusal) {
        let Refusal { part, span, what, remedy } = refusal;
        let within = |written: &Option<Written>| {
            written.as_ref().map_or(row.header.clone(), |written| written.within(&span))
        };
        let at = match part {
            Part::Constant(i) => self.constants[i].1.clone(),
            Part::Coordinate(i) => self.coordinates[i].span.clone(),
            Part::Acceleration(i) => within(&self.coordinates[i].acceleration),
            Part::Exact(i) => within(&self.coordinates[i].exact),
            Part::Place(i, axis) => {
                let at = &self.coordinates[i].at;
                at.as_ref().map_or(row.header.clone(), |at| at[axis].1.clone())
            }
            Part::Energy => within(&self.energy),
        };
        let remedy = match remedy {
            Remedy::Words(words) => words,
            Remedy::Name { written, known } => {
                offer(&written, &known.iter().map(String::as_str).collect::<Vec<_>>())
            }
        };
        row.complain(at, what, remedy);
    }
}
