//! Reads a `[[law]]`: an equation of motion written in the scene.

use std::ops::Range as Span;
use std::sync::Arc;

use super::SceneBody;
use super::clip;
use super::keys::{Key, list, number, quoted};
use super::nearest::{self, nearest};
use super::table::{Named, Table, TextBlock};
use super::wanted::{Field, Wanted};
use crate::sim::bodies::{ClaimHorizon, Kind, Range, check_law, law_kind};
use crate::sim::law::{
    CoordinateText, EventText, LawFault, LawText, Layout, MAX_CONSTANTS, MAX_COORDINATES,
    MAX_EVENTS, Part, SecondOrder, UNITS, second_order,
};

/// The name of the table array.
pub(super) const LAW: &str = "law";

const CONSTANTS: Field =
    Field::optional("constants", "named numbers for its expressions", Wanted::Constants);
const COORDINATES: Field =
    Field::required("coordinates", "what moves", Wanted::Coordinates("law.coordinates"));
const EVENTS: Field =
    Field::optional("events", "walls at which velocities turn", Wanted::Events("law.events"));
/// The key of a rule that needs an energy.
const ENERGY: Field =
    Field::optional("energy", "in joules, if the law conserves it", Wanted::Expression);
const FALLING: Field = Field::optional(
    "falling",
    "whether `when` falls through 0; if false it rises",
    Wanted::Boolean,
);
const PLANE: Field =
    Field::optional("plane", "the coordinates that are drawn as a point", Wanted::Plane);
const DRAW: Field = Field::optional("draw", "how the coordinates lie in space", Wanted::Layout);
const UNIT: Field = Field::optional("unit", "its unit; metres if left out", Wanted::Text(16));
/// The derivative of a coordinate of first order. Such a law is refused with its second-order form.
const RATE: Field = Field::optional("rate", "its first derivative by time", Wanted::Expression);
const AT: Field =
    Field::optional("at", "its place in metres, by coordinates and constants", Wanted::At);

/// The keys of `[[law]]` besides its name.
pub(super) static LAW_KEYS: [Key<WrittenLaw, SceneBody>; 6] = [
    Key {
        field: CONSTANTS,
        read: |law, row, field| (law.constants, law.numbers) = read_constants(row, field),
        write: |body| {
            let names = &body.kind.law()?.text().constants;
            let row = |(name, value): (&String, &f64)| format!("{name} = {}", number(*value));
            let rows: Vec<_> = names.iter().zip(&body.values).map(row).collect();
            (!rows.is_empty()).then(|| format!("{{ {} }}", rows.join(", ")))
        },
    },
    Key {
        field: COORDINATES,
        read: |law, row, field| law.coordinates = read_coordinates(row, field),
        // Coordinates have tables of their own.
        write: |_| None,
    },
    Key {
        field: EVENTS,
        read: |law, row, field| law.events = read_events(row, field, law.coordinates.as_deref()),
        // Events have tables of their own.
        write: |_| None,
    },
    Key {
        field: ENERGY,
        read: |law, row, field| law.energy = row.expression(field),
        write: |body| body.kind.law()?.text().energy.as_deref().map(quoted),
    },
    Key {
        field: PLANE,
        read: |law, row, field| law.plane = read_plane(row, field, law.coordinates.as_deref()),
        write: |body| {
            let LawText { plane, coordinates, .. } = body.kind.law()?.text();
            Some(list(plane.as_ref()?.iter().map(|&index| quoted(&coordinates[index].name))))
        },
    },
    Key {
        field: DRAW,
        read: |law, row, field| {
            let coordinates = law.coordinates.as_deref().unwrap_or_default();
            law.layout = read_layout(row, field, coordinates);
        },
        write: |body| {
            let layout = body.kind.law()?.text().layout;
            (layout != Layout::default()).then(|| quoted(layout.id()))
        },
    },
];

/// A coordinate with its start, its velocity at the start, and its kick.
pub(super) struct CoordinateValues {
    text: CoordinateText,
    start: f64,
    start_velocity: f64,
    kick: f64,
}

/// The keys of a coordinate.
pub(super) static COORDINATE_KEYS: [Key<WrittenCoordinate, CoordinateValues>; 7] = [
    Key {
        field: UNIT,
        read: |coordinate, table, field| coordinate.unit = read_unit(table, field),
        write: |coordinate| Some(quoted(coordinate.text.unit)),
    },
    Key {
        field: Field::optional("start", "where it starts; 0 if left out", Wanted::ANY),
        read: |coordinate, table, field| read_number_into(&mut coordinate.start, table, field),
        write: |coordinate| Some(number(coordinate.start)),
    },
    Key {
        field: Field::optional(
            "start_velocity",
            "its velocity at the start; 0 if left out",
            Wanted::ANY,
        ),
        read: |coordinate, table, field| {
            read_number_into(&mut coordinate.start_velocity, table, field)
        },
        write: |coordinate| Some(number(coordinate.start_velocity)),
    },
    Key {
        field: Field::required("acceleration", "its second derivative by time", Wanted::Expression),
        read: |coordinate, table, field| {
            coordinate.is_rate = table.has(RATE.key) && !table.has(field.key);
            let field = if coordinate.is_rate { &RATE } else { field };
            coordinate.acceleration = table.expression(field);
        },
        write: |coordinate| Some(quoted(&coordinate.text.acceleration)),
    },
    Key {
        field: Field::optional(
            "exact",
            "its motion by `t`, constants and starts, if known",
            Wanted::Expression,
        ),
        read: |coordinate, table, field| coordinate.exact = table.expression(field),
        write: |coordinate| coordinate.text.exact.as_deref().map(quoted),
    },
    Key {
        field: AT,
        read: |coordinate, table, field| coordinate.at = read_at(table, field),
        write: |coordinate| {
            Some(list(coordinate.text.at.as_ref()?.iter().map(|text| quoted(text))))
        },
    },
    Key {
        field: Field::optional(
            "kick",
            "how much a kick changes its velocity; 1 for the first coordinate, 0 for others",
            Wanted::ANY,
        ),
        read: |coordinate, table, field| read_number_into(&mut coordinate.kick, table, field),
        write: |coordinate| Some(number(coordinate.kick)),
    },
];

/// The keys of an event.
pub(super) static EVENT_KEYS: [Key<WrittenEvent, (EventText, LawText)>; 3] = [
    Key {
        field: Field::required("when", "a coordinate minus a wall's place", Wanted::Expression),
        read: |event, table, field| event.when = table.expression(field),
        write: |(event, _)| Some(quoted(&event.when)),
    },
    Key {
        field: FALLING,
        read: |event, table, field| event.falls = table.boolean(field).unwrap_or(true),
        write: |(event, _)| (!event.falls).then(|| "false".into()),
    },
    Key {
        field: Field::required("then", "new velocities by the old ones", Wanted::Velocities),
        read: |event, table, field| event.then = table.expressions(field),
        write: |(event, law)| {
            let name = |of: usize| &law.coordinates[of].name;
            let rows =
                event.then.iter().map(|(of, new)| format!("v{} = {}", name(*of), quoted(new)));
            Some(format!("{{ {} }}", rows.collect::<Vec<_>>().join(", ")))
        },
    },
];

/// Replaces a number if its key is present. If the value has a fault, the number becomes `None`.
fn read_number_into(number: &mut Option<f64>, table: &mut Table<'_>, field: &Field) {
    let read = table.number(field);
    if table.has(field.key) {
        *number = read;
    }
}

/// A name with its bytes in the file.
type WrittenName = (String, Span<usize>);

/// A law as written in the file.
#[derive(Default)]
pub(super) struct WrittenLaw {
    constants: Vec<WrittenName>,
    /// Values of the constants; `None` if one of them has a fault.
    numbers: Option<Vec<f64>>,
    coordinates: Option<Vec<WrittenCoordinate>>,
    /// The events, each with the coordinates whose velocities it changes; `None` after a fault.
    events: Option<Vec<(WrittenEvent, Vec<usize>)>>,
    energy: Option<TextBlock>,
    plane: Option<[usize; 2]>,
    layout: Layout,
}

pub(super) struct WrittenCoordinate {
    name: String,
    span: Span<usize>,
    unit: &'static str,
    acceleration: Option<TextBlock>,
    /// Whether the acceleration is written as a rate.
    is_rate: bool,
    exact: Option<TextBlock>,
    at: Option<[WrittenName; 2]>,
    start: Option<f64>,
    start_velocity: Option<f64>,
    kick: Option<f64>,
}

/// An event as written in the file.
pub(super) struct WrittenEvent {
    name: String,
    span: Span<usize>,
    when: Option<TextBlock>,
    falls: bool,
    /// New velocities, each with the name and its bytes.
    then: Option<Vec<(WrittenName, TextBlock)>>,
}

/// Reads the kind of a law and the values of its parameters; each is `None` if it has a fault. Checks the law's
/// claims against its motion at the ticks of `horizon`.
pub(super) fn read_law(
    row: &mut Table<'_>,
    horizon: ClaimHorizon,
) -> (Option<Arc<Kind>>, Option<Vec<f64>>) {
    let mut law = WrittenLaw::default();
    Key::read_all(&LAW_KEYS, &mut law, row);
    check_one_picture(row, law.coordinates());
    let Some(text) = law.text() else { return (None, None) };
    if law.coordinates().iter().any(|coordinate| coordinate.is_rate) {
        law.report_rates(row, &text);
        return (None, None);
    }
    if let (true, Some(exact)) = (
        row.has(EVENTS.key),
        law.coordinates().iter().find_map(|coordinate| coordinate.exact.as_ref()),
    ) {
        let at = exact.span_in_file(&(0..exact.text.len()));
        let what = "the law has events, and its `exact` would pass through their walls";
        row.report_fault(at, what, "remove `exact`: the truth finds the impacts");
        return (None, None);
    }
    let kind = match law_kind(text) {
        Ok(kind) => kind,
        Err(refusals) => {
            refusals.into_iter().for_each(|refusal| law.report_fault(row, refusal));
            return (None, None);
        }
    };
    let values = law.values();
    if let (Some(values), Some(equations)) = (&values, kind.law())
        && row.is_faultless()
        && let Err(refusal) = check_law(equations, values, horizon)
    {
        law.report_fault(row, refusal);
    }
    (Some(kind), values)
}

/// Reads the names of the constants and their values. The values are `None` if one of them has a fault.
fn read_constants(row: &mut Table<'_>, field: &Field) -> (Vec<WrittenName>, Option<Vec<f64>>) {
    let entries = row.entries(field).unwrap_or_default();
    check_count(row, "constants", &entries, MAX_CONSTANTS);
    let entries = &entries[..entries.len().min(MAX_CONSTANTS)];
    let numbers: Vec<_> = entries.iter().map(|entry| row.number_of(entry, Range::ANY)).collect();
    let names = entries.iter().map(|entry| (entry.key.to_owned(), entry.span.clone()));
    (names.collect(), numbers.into_iter().collect())
}

fn check_count(row: &mut Table<'_>, what: &str, entries: &[Named<'_>], most: usize) {
    if let Some(entry) = entries.get(most) {
        let what = format!("the law has {} {what}", entries.len());
        row.report_fault(entry.span.clone(), what, format!("keep at most {most}"));
    }
}

fn read_coordinates(row: &mut Table<'_>, field: &Field) -> Option<Vec<WrittenCoordinate>> {
    let entries = row.entries(field)?;
    check_count(row, "coordinates", &entries, MAX_COORDINATES);
    if entries.is_empty() {
        row.report_fault(row.span(field.key), "the law has no coordinate", field.wanted.remedy());
        return None;
    }
    let mut coordinates = Vec::new();
    for (n, entry) in entries.iter().enumerate().take(MAX_COORDINATES) {
        let mut table = row.table_of(entry, &field.wanted)?;
        let mut coordinate = WrittenCoordinate {
            name: entry.key.into(),
            span: entry.span.clone(),
            unit: UNITS[0],
            acceleration: None,
            is_rate: false,
            exact: None,
            at: None,
            start: Some(0.0),
            start_velocity: Some(0.0),
            kick: Some(f64::from(u8::from(n == 0))),
        };
        Key::read_all(&COORDINATE_KEYS, &mut coordinate, &mut table);
        coordinates.push(coordinate);
        row.add_faults_of(table);
    }
    Some(coordinates)
}

/// Reads the events; `None` if one has a fault.
fn read_events(
    row: &mut Table<'_>,
    field: &Field,
    coordinates: Option<&[WrittenCoordinate]>,
) -> Option<Vec<(WrittenEvent, Vec<usize>)>> {
    let entries = row.entries(field).unwrap_or_default();
    check_count(row, "events", &entries, MAX_EVENTS);
    let mut events = Vec::new();
    for entry in entries.iter().take(MAX_EVENTS) {
        let mut table = row.table_of(entry, &field.wanted)?;
        let (name, span) = (entry.key.into(), entry.span.clone());
        let mut event = WrittenEvent { name, span, when: None, falls: true, then: None };
        Key::read_all(&EVENT_KEYS, &mut event, &mut table);
        let known: Vec<_> =
            coordinates.unwrap_or_default().iter().map(|of| format!("v{}", of.name)).collect();
        let of = event.then.iter().flatten().map(|((name, span), _)| {
            let index = known.iter().position(|velocity| velocity == name);
            if index.is_none() {
                let known: Vec<&str> = known.iter().map(|it| &**it).collect();
                let what = format!("no velocity is called `{}`", clip(name));
                table.report_fault(span.clone(), what, offer(name, &known));
            }
            index
        });
        let of: Option<Vec<usize>> = of.collect::<Vec<_>>().into_iter().collect();
        row.add_faults_of(table);
        events.push((event, of?));
    }
    Some(events)
}

fn read_at(table: &mut Table<'_>, field: &Field) -> Option<[WrittenName; 2]> {
    let written = table.names(field)?;
    let pair = <[_; 2]>::try_from(written);
    if pair.is_err() {
        let remedy = field.wanted.remedy();
        table.report_fault(table.span(field.key), "`at` is not an x and a y", remedy);
    }
    Some(pair.ok()?.map(|(span, text)| (text.to_owned(), span)))
}

fn read_unit(table: &mut Table<'_>, field: &Field) -> &'static str {
    let Some(written) = table.text(field) else { return UNITS[0] };
    if let Some(unit) = UNITS.iter().find(|unit| **unit == written) {
        return unit;
    }
    let what = format!("unknown unit {written:?}");
    let remedy = offer(&written, &UNITS);
    table.report_fault(table.span(field.key), what, remedy);
    UNITS[0]
}

fn read_plane(
    row: &mut Table<'_>,
    field: &Field,
    coordinates: Option<&[WrittenCoordinate]>,
) -> Option<[usize; 2]> {
    let Some(coordinates) = coordinates else {
        row.allow_key(field.key);
        return None;
    };
    let names = row.names(field)?;
    let known: Vec<&str> = coordinates.iter().map(|coordinate| &*coordinate.name).collect();
    let mut indices = Vec::new();
    for (span, name) in &names {
        match known.iter().position(|known| known == name) {
            Some(index) => indices.push(index),
            None => {
                let what = format!("no coordinate is called {name:?}");
                row.report_fault(span.clone(), what, offer(name, &known));
                return None;
            }
        }
    }
    match indices[..] {
        [x, y] if x != y => Some([x, y]),
        _ => {
            let what = "`plane` does not name two coordinates";
            row.report_fault(row.span(field.key), what, field.wanted.remedy());
            None
        }
    }
}

fn read_layout(row: &mut Table<'_>, field: &Field, coordinates: &[WrittenCoordinate]) -> Layout {
    let Some(written) = row.text(field) else { return Layout::default() };
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
    row.report_fault(row.span(field.key), what, remedy);
    Layout::default()
}

/// Refuses a `plane` or a `draw` in a law whose coordinates have an `at`.
fn check_one_picture(row: &mut Table<'_>, coordinates: &[WrittenCoordinate]) {
    let has_places = coordinates.iter().any(|coordinate| coordinate.at.is_some());
    let other = [PLANE, DRAW].into_iter().find(|field| row.has(field.key));
    if let (true, Some(Field { key, .. })) = (has_places, other) {
        let what = format!("the law has a `{key}`, and a coordinate has an `at`");
        row.report_fault(row.span(key), what, "leave one of them out");
    }
}

fn offer(written: &str, known: &[&str]) -> String {
    nearest::offer(nearest(written, known.iter().map(|name| (*name, *name))), known, '`')
}

/// Returns the tables of a law's coordinates and events.
pub(super) fn coordinate_tables(SceneBody { values, .. }: &SceneBody, law: &LawText) -> String {
    let (n, rest) = (law.coordinates.len(), &values[law.constants.len()..]);
    let table = |(i, text): (usize, &CoordinateText)| {
        let text = text.clone();
        let [start, start_velocity, kick] = [rest[i], rest[n + i], rest[2 * n + i]];
        let head = format!("\n[{LAW}.{}.{}]\n", COORDINATES.key, text.name);
        head + &Key::lines(
            &COORDINATE_KEYS,
            &CoordinateValues { text, start, start_velocity, kick },
        )
    };
    let events = law.events.iter().map(|event| {
        let head = format!("\n[{LAW}.{}.{}]\n", EVENTS.key, event.name);
        head + &Key::lines(&EVENT_KEYS, &(event.clone(), law.clone()))
    });
    law.coordinates.iter().enumerate().map(table).chain(events).collect()
}

impl WrittenLaw {
    fn coordinates(&self) -> &[WrittenCoordinate] {
        self.coordinates.as_deref().unwrap_or_default()
    }

    fn events(&self) -> &[(WrittenEvent, Vec<usize>)] {
        self.events.as_deref().unwrap_or_default()
    }

    /// Returns the text of the law; `None` if it has no coordinate or lacks an acceleration.
    fn text(&self) -> Option<LawText> {
        let text = |written: &TextBlock| written.text.clone();
        let coordinate = |of: &WrittenCoordinate| {
            Some(CoordinateText {
                name: of.name.clone(),
                unit: of.unit,
                acceleration: text(of.acceleration.as_ref()?),
                exact: of.exact.as_ref().map(text),
                at: of.at.as_ref().map(|at| at.each_ref().map(|(text, _)| text.clone())),
            })
        };
        let event = |(of, changed): &(WrittenEvent, Vec<usize>)| {
            let new = of.then.as_ref()?.iter().map(|(_, new)| text(new));
            Some(EventText {
                name: of.name.clone(),
                when: text(of.when.as_ref()?),
                falls: of.falls,
                then: changed.iter().copied().zip(new).collect(),
            })
        };
        Some(LawText {
            constants: self.constants.iter().map(|(name, _)| name.clone()).collect(),
            coordinates: self
                .coordinates
                .as_ref()?
                .iter()
                .map(coordinate)
                .collect::<Option<_>>()?,
            events: self.events.as_ref()?.iter().map(event).collect::<Option<_>>()?,
            energy: self.energy.as_ref().map(text),
            plane: self.plane,
            layout: self.layout,
        })
    }

    fn values(&self) -> Option<Vec<f64>> {
        let of = |read: fn(&WrittenCoordinate) -> Option<f64>| {
            self.coordinates().iter().map(read).collect::<Option<Vec<f64>>>()
        };
        let [starts, velocities, kicks] =
            [of(|it| it.start)?, of(|it| it.start_velocity)?, of(|it| it.kick)?];
        Some([self.numbers.clone()?, starts, velocities, kicks].concat())
    }

    /// Reports each rate with its second-order form.
    fn report_rates(&self, row: &mut Table<'_>, text: &LawText) {
        let forms = self.values().and_then(|values| second_order(text, &values));
        let forms = forms.filter(|_| self.coordinates().iter().all(|of| of.is_rate));
        for (i, coordinate) in self.coordinates().iter().enumerate().filter(|(_, of)| of.is_rate) {
            let what = format!(
                "`{}` has a rate, and methods here step a position with a velocity, by its acceleration",
                coordinate.name
            );
            let remedy = match forms.as_ref().map(|forms| &forms[i]) {
                Some(SecondOrder { acceleration: Some(acceleration), start_velocity }) => format!(
                    "write its second-order form: `acceleration = {}` and `start_velocity = {}`",
                    quoted(acceleration),
                    number(*start_velocity)
                ),
                _ => "write its second-order form: as `acceleration` the derivative of its rate by time, \
                      and as `start_velocity` its rate at the start"
                    .into(),
            };
            let span =
                coordinate.acceleration.as_ref().map_or(coordinate.span.clone(), |written| {
                    written.span_in_file(&(0..written.text.len()))
                });
            row.report_fault(span, what, remedy);
        }
    }

    /// Reports a fault of the law at its place in the file.
    fn report_fault(&self, row: &mut Table<'_>, refusal: LawFault) {
        let LawFault { part, span, what, remedy } = refusal;
        let within = |written: &Option<TextBlock>| {
            written.as_ref().map_or(row.header.clone(), |written| written.span_in_file(&span))
        };
        let at = match part {
            Part::Constant(i) => self.constants[i].1.clone(),
            Part::Coordinate(i) => self.coordinates()[i].span.clone(),
            Part::Acceleration(i) => within(&self.coordinates()[i].acceleration),
            Part::Exact(i) => within(&self.coordinates()[i].exact),
            Part::Place(i, axis) => {
                let at = &self.coordinates()[i].at;
                at.as_ref().map_or(row.header.clone(), |at| at[axis].1.clone())
            }
            Part::Energy => within(&self.energy),
            Part::Event(i) => self.events()[i].0.span.clone(),
            Part::When(i) => within(&self.events()[i].0.when),
            Part::Then(i, n) => {
                let then = self.events()[i].0.then.as_ref().and_then(|then| then.get(n));
                then.map_or(row.header.clone(), |(_, new)| new.span_in_file(&span))
            }
        };
        row.report_fault(at, what, nearest::words(remedy));
    }
}
