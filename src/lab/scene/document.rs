//! The walk over a scene file, from its top to a [`Scene`].

use std::ops::Range as Span;

use toml::de::DeTable;

use super::cause::{Cause, Wanted};
use super::errors::{SceneError, position};
use super::script;
use super::syntax;
use super::table::{Field, Table};
use super::{
    LEAST_SECONDS, MOST_BODIES, MOST_LANES, MOST_NAME_CHARS, MOST_SECONDS, MOST_SUBSTEPS,
    MOST_TICK_HZ, Scene, SceneBody, TOLERANCES,
};
use crate::lab::lane_spec::LaneSpec;
use crate::sim::bodies::{BODIES, Kind, Parameter, Range};
use crate::sim::integrators::{METHODS, Method};

/// The most characters of a title: it stands in the window's title bar.
const MOST_TITLE_CHARS: usize = 80;

/// The most characters of what a scene is about: a few lines of a panel.
const MOST_ABOUT_CHARS: usize = 400;

/// The most characters of a hint: the line under the stage.
const MOST_HINT_CHARS: usize = 120;

const TITLE: Field = required("title", "the scene's name for people");
const ABOUT: Field = optional("about");
const HINT: Field = optional("hint");
const TICK_HZ: Field = required("tick_hz", "ticks a second");
const SECONDS: Field = required("seconds", "how long it runs");
const METHOD_LIST: Field = optional("methods");
const OPENING_METHOD: Field = optional("method");
pub(super) const TOP: [Field; 7] =
    [TITLE, ABOUT, HINT, TICK_HZ, SECONDS, METHOD_LIST, OPENING_METHOD];

const NAME: Field = optional("name");

const LANE_METHOD: Field = required("method", "the method that races");
pub(super) const SUBSTEPS: Field = optional("substeps");
pub(super) const TOLERANCE: Field = optional("tolerance");

const EQUAL_COST: Field = optional("equal_cost");

pub(super) const fn required(key: &'static str, about: &'static str) -> Field {
    Field { key, needed_as: Some(about) }
}

pub(super) const fn optional(key: &'static str) -> Field {
    Field { key, needed_as: None }
}

/// Reads the scene called `name`, or says everything that is wrong with its text, in no order.
pub(super) fn read(name: &str, text: &str) -> Result<Scene, Vec<SceneError>> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut errors = syntax::errors(text, errors);
    // A key given twice leaves the rest of the file clear; other syntax errors leave only guesses.
    if errors.iter().any(|error| !matches!(error.cause, Cause::DuplicateKey { .. })) {
        return Err(errors);
    }
    if document.get_ref().is_empty() {
        return Err(vec![SceneError { span: 0..0, cause: Cause::Empty }]);
    }

    let mut top = Table::top(text, document.get_ref());
    let title = top.text(TITLE, MOST_TITLE_CHARS);
    let about = top.text(ABOUT, MOST_ABOUT_CHARS).unwrap_or_default();
    let hint = top.text(HINT, MOST_HINT_CHARS);
    let tick_hz = top.whole(TICK_HZ, 1..=MOST_TICK_HZ);
    let seconds = top.number(SECONDS, Range::Between(LEAST_SECONDS, MOST_SECONDS));
    let lanes = read_lanes(text, &mut top);
    let opening_method = read_opening_method(&lanes, &mut top);
    let equal_cost = read_equal_cost(&mut top);
    let mut bodies = read_bodies(&mut top);
    check_names(text, &bodies, &mut top);
    name_the_nameless(&mut bodies);
    let cast = Cast { bodies: &bodies, lanes: lanes.len() };
    let script = script::read(&cast, &mut top);
    let checks = script::read_checks(&cast, &mut top);
    errors.extend(top.finish(&[]));
    let may_mean_a_body = |error: &SceneError| {
        matches!(
            error.cause,
            Cause::UnknownTable { .. } | Cause::WrongType { wanted: Wanted::Tables(_), .. }
        )
    };
    if bodies.is_empty() && !errors.iter().any(may_mean_a_body) {
        errors.push(SceneError { span: text.len()..text.len(), cause: Cause::NoBody });
    }

    match (title, tick_hz, seconds) {
        (Some(title), Some(tick_hz), Some(seconds)) if errors.is_empty() => {
            let (name, bodies) = (name.into(), finish_bodies(bodies));
            Ok(Scene {
                name,
                title,
                about,
                hint,
                tick_hz,
                seconds,
                lanes,
                opening_method,
                equal_cost,
                bodies,
                script,
                checks,
            })
        }
        _ => Err(errors),
    }
}

fn read_lanes(text: &str, top: &mut Table<'_>) -> Vec<LaneSpec> {
    let listed = top.methods(METHOD_LIST, MOST_LANES);
    let is_listed = listed.is_some();
    let listed = listed.into_iter().flatten();
    let mut lanes: Vec<_> = listed.map(|(span, method)| (span, LaneSpec::plain(method))).collect();

    let rows = top.rows("lane");
    if let (true, Some(row)) = (is_listed, rows.first()) {
        top.complain(row.header.clone(), Cause::TwoLaneLists);
    }
    if let Some(row) = rows.get(MOST_LANES) {
        let cause = Cause::TooManyLanes { found: rows.len(), most: MOST_LANES };
        top.complain(row.header.clone(), cause);
    }
    let is_given = is_listed || !rows.is_empty();
    for mut row in rows.into_iter().take(MOST_LANES) {
        let method = row.method(LANE_METHOD);
        let substeps = row.whole(SUBSTEPS, 1..=MOST_SUBSTEPS).unwrap_or(1);
        let tolerance = read_tolerance(&mut row, method);
        let span = row.span(LANE_METHOD.key);
        lanes.extend(method.map(|method| (span, LaneSpec { method, substeps, tolerance })));
        top.adopt(row, &TOP);
    }

    for (n, (span, lane)) in lanes.iter().enumerate() {
        if let Some((first, _)) = lanes[..n].iter().find(|(_, earlier)| earlier == lane) {
            let (line, _) = position(text, first.start);
            top.complain(span.clone(), Cause::DuplicateLane { lane: *lane, line });
        }
    }
    if is_given {
        lanes.into_iter().map(|(_, lane)| lane).collect()
    } else {
        METHODS.iter().map(LaneSpec::plain).collect()
    }
}

/// A tolerance, for `method` if it is known.
pub(super) fn read_tolerance(row: &mut Table<'_>, method: Option<&'static Method>) -> Option<f64> {
    let tolerance = row.number(TOLERANCE, Range::Between(TOLERANCES.0, TOLERANCES.1));
    if let (Some(method), true) = (method, row.has(TOLERANCE.key))
        && method.tolerance.is_none()
    {
        let cause = Cause::NoTolerance { key: TOLERANCE.key, method: method.id };
        row.complain(row.span(TOLERANCE.key), cause);
    }
    tolerance
}

/// The method to open with, which has to be a lane's: what a person sees first is then among what races.
fn read_opening_method(lanes: &[LaneSpec], top: &mut Table<'_>) -> Option<&'static Method> {
    let method = top.method(OPENING_METHOD)?;
    if !lanes.is_empty() && !lanes.iter().any(|lane| lane.method == method) {
        let mut known: Vec<&str> = Vec::new();
        for lane in lanes {
            if !known.contains(&lane.method.id) {
                known.push(lane.method.id);
            }
        }
        let cause = Cause::NotALane { key: OPENING_METHOD.key, method: method.id, known };
        top.complain(top.span(OPENING_METHOD.key), cause);
    }
    Some(method)
}

/// A body as the file describes it, faults included.
pub(super) struct Described {
    pub(super) kind: &'static Kind,
    pub(super) name: Option<String>,
    /// The bytes of the name, or of the table's header where it has none.
    name_at: Span<usize>,
    pub(super) values: Option<Vec<f64>>,
}

/// What a script is about.
pub(super) struct Cast<'d> {
    /// By now each has a name.
    pub(super) bodies: &'d [Described],
    pub(super) lanes: usize,
}

fn read_bodies(top: &mut Table<'_>) -> Vec<Described> {
    let of_kind = |kind: &'static Kind| top.rows(kind.id).into_iter().map(move |row| (kind, row));
    let mut rows: Vec<_> = BODIES.iter().flat_map(of_kind).collect();
    rows.sort_by_key(|(_, row)| row.header.start);
    if let Some((_, row)) = rows.get(MOST_BODIES) {
        let cause = Cause::TooManyBodies { found: rows.len(), most: MOST_BODIES };
        top.complain(row.header.clone(), cause);
    }
    let mut bodies = Vec::new();
    for (kind, mut row) in rows.into_iter().take(MOST_BODIES) {
        let name = row.text(NAME, MOST_NAME_CHARS);
        let name_at = row.span(NAME.key);
        let values = read_values(kind, &mut row);
        bodies.push(Described { kind, name, name_at, values });
        top.adopt(row, &TOP);
    }
    bodies
}

fn read_values(kind: &Kind, row: &mut Table<'_>) -> Option<Vec<f64>> {
    let read = |parameter: &Parameter| {
        let Parameter { key, about, default, range, .. } = *parameter;
        let field = if default.is_some() { optional(key) } else { required(key, about) };
        let given = match range {
            Range::Curve { .. } => row.curve(field, range).map(|points| points.concat()),
            Range::Count(most) => row.whole(field, 1..=most).map(|count| vec![f64::from(count)]),
            _ => row.number(field, range).map(|number| vec![number]),
        };
        given.or(default.map(|number| vec![number]))
    };
    // All are read before any is missed, so that every fault is found.
    let values: Vec<_> = kind.parameters.iter().map(read).collect();
    let values = values.into_iter().collect::<Option<Vec<_>>>()?.concat();
    if let Err(fault) = (kind.check)(&values) {
        row.complain(row.span(fault.key), Cause::Fault(fault));
    }
    Some(values)
}

fn check_names(text: &str, bodies: &[Described], top: &mut Table<'_>) {
    for (n, body) in bodies.iter().enumerate() {
        let Some(name) = &body.name else { continue };
        if let Some(first) = bodies[..n].iter().find(|earlier| earlier.name == body.name) {
            let (line, _) = position(text, first.name_at.start);
            let cause = Cause::DuplicateName { name: name.clone(), line };
            top.complain(body.name_at.clone(), cause);
        }
    }
}

/// Names the nameless after their kind, numbered where the kind has several bodies.
fn name_the_nameless(bodies: &mut [Described]) {
    let mut taken: Vec<String> = bodies.iter().filter_map(|body| body.name.clone()).collect();
    let kinds: Vec<_> = bodies.iter().map(|body| body.kind.id).collect();
    for Described { kind, name, .. } in bodies {
        let is_alone = kinds.iter().filter(|id| **id == kind.id).count() == 1;
        let name = name.get_or_insert_with(|| {
            let plain = is_alone.then(|| kind.id.to_owned());
            let numbered = (1..).map(|number| format!("{}-{number}", kind.id));
            let free = plain.into_iter().chain(numbered).find(|name| !taken.contains(name));
            free.expect("there is always a next number")
        });
        taken.push(name.clone());
    }
}

fn finish_bodies(bodies: Vec<Described>) -> Vec<SceneBody> {
    let finish = |Described { kind, name, values, .. }| {
        Some(SceneBody { name: name.expect("each has one by now"), kind, values: values? })
    };
    bodies.into_iter().filter_map(finish).collect()
}

/// What the scene's `[race]` says of the lanes' cost.
fn read_equal_cost(top: &mut Table<'_>) -> bool {
    let Some(mut race) = top.table("race") else { return false };
    let equal_cost = race.truth(EQUAL_COST).unwrap_or(false);
    top.adopt(race, &TOP);
    equal_cost
}
