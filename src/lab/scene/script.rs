//! What is done in a scene, and what it is known to come to: `[[command]]` and `[[check]]`.

use super::cause::Cause;
use super::described::Described;
use super::fields::{SUBSTEPS, TOLERANCE, TOP, optional, read_tolerance, required};
use super::nearest::nearest;
use super::table::{Field, Table};
use super::{Check, LAST_TICK, MOST_NAME_CHARS, MOST_SUBSTEPS, MOST_TICK_HZ, Scripted};
use crate::lab::action::Action;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::edit::edited_values;
use crate::sim::bodies::{LARGEST, Parameter, Range};

const TICK: Field = required("tick", "the tick before which it is done");
const LANE: Field = optional("lane");
const METHOD: Field = optional("method");
const SOLO: Field = optional("solo");

const BODY: Field = required("body", "the body's name");
const KEY: Field = required("key", "the parameter's key");
const VALUE: Field = required("value", "what it is set to");
const Q: Field = required("q", "the coordinates");
const V: Field = required("v", "the velocities");

const CHECKED_LANE: Field = required("lane", "the lane's number");
const CHECKED_TICK: Field = required("tick", "the tick at which it is known");
const HASH: Field = required("hash", "the lane's state then");

/// What a script is about.
pub(super) struct Cast<'d> {
    /// By now each has a name.
    pub(super) bodies: &'d [Described],
    pub(super) lanes: usize,
}

/// Something that a `[[command]]` may do, by its key.
struct Doable {
    field: Field,
    /// The input that some body must take for the action to have an effect.
    input: Option<&'static str>,
    read: fn(&Cast<'_>, &mut Table<'_>, Field) -> Option<Action>,
}

const fn doable(
    key: &'static str,
    read: fn(&Cast<'_>, &mut Table<'_>, Field) -> Option<Action>,
) -> Doable {
    Doable { field: optional(key), input: None, read }
}

const fn input(
    key: &'static str,
    read: fn(&Cast<'_>, &mut Table<'_>, Field) -> Option<Action>,
) -> Doable {
    Doable { input: Some(key), ..doable(key, read) }
}

/// What changes a lane; `lane` says which.
const OF_A_LANE: [&str; 3] = [METHOD.key, SUBSTEPS.key, TOLERANCE.key];

static DOABLE: [Doable; 10] = [
    doable(METHOD.key, |cast, row, _| read_method(cast, row)),
    input("throttle", |_, row, field| row.number(field, Range::Within(1.0)).map(Action::Throttle)),
    input("rudder", |_, row, field| row.number(field, Range::Within(1.0)).map(Action::Rudder)),
    input("kick", |_, row, field| row.number(field, Range::Within(LARGEST)).map(Action::Kick)),
    doable("tick_hz", |_, row, field| row.whole(field, 1..=MOST_TICK_HZ).map(Action::TickHz)),
    doable(SUBSTEPS.key, |cast, row, field| {
        let substeps = row.whole(field, 1..=MOST_SUBSTEPS);
        let lane = read_lane(cast, row)?;
        Some(Action::Substeps { lane, substeps: substeps? })
    }),
    doable(TOLERANCE.key, |cast, row, _| {
        let tolerance = read_tolerance(row, None);
        let lane = read_lane(cast, row)?;
        Some(Action::Tolerance { lane, tolerance: tolerance? })
    }),
    doable("set", |cast, row, _| {
        let mut set = row.table("set")?;
        let action = read_set(cast, &mut set);
        row.adopt(set, &TOP);
        action
    }),
    doable("place", |cast, row, _| {
        let mut place = row.table("place")?;
        let action = read_place(cast, &mut place);
        row.adopt(place, &TOP);
        action
    }),
    doable(SOLO.key, |cast, row, field| {
        row.whole(field, 1..=cast.lanes as u32).map(|lane| Action::Solo { lane: lane as usize })
    }),
];

/// What is done, by tick, and within a tick in the order of the file.
pub(super) fn read(cast: &Cast<'_>, top: &mut Table<'_>) -> Vec<Scripted> {
    let mut script = Vec::new();
    for mut row in top.rows("command") {
        let tick = row.whole(TICK, 0..=LAST_TICK);
        let action = read_action(cast, &mut row);
        script.extend(tick.zip(action).map(|(tick, action)| Scripted { tick, action }));
        top.adopt(row, &TOP);
    }
    script.sort_by_key(|scripted| scripted.tick);
    script
}

fn read_action(cast: &Cast<'_>, row: &mut Table<'_>) -> Option<Action> {
    row.knows(LANE.key);
    // Substeps and a tolerance may go with a method.
    let goes_with = |key: &str| row.has(METHOD.key) && OF_A_LANE[1..].contains(&key);
    let given = DOABLE.iter().filter(|it| row.has(it.field.key) && !goes_with(it.field.key));
    let found: Vec<_> = given.map(|doable| doable.field.key).collect();
    let mut action = None;
    for Doable { field, input, read } in &DOABLE {
        row.knows(field.key);
        if !found.contains(&field.key) {
            continue;
        }
        // Each is read, also where one too many is found: so all faults are.
        action = read(cast, row, *field).or(action);
        if let Some(input) = *input
            && !cast.bodies.is_empty()
            && !cast.bodies.iter().any(|body| body.kind.inputs.contains(&input))
        {
            row.complain(row.span(field.key), Cause::NoTaker { input });
        }
    }
    if row.has(LANE.key) && !found.is_empty() && !found.iter().any(|key| OF_A_LANE.contains(key)) {
        row.complain(row.span(LANE.key), Cause::LaneAlone { known: OF_A_LANE });
    }
    let header = row.header.clone();
    match found.len() {
        0 => {
            let known = DOABLE.iter().map(|doable| doable.field.key).collect();
            row.complain(header, Cause::NoAction { known });
        }
        1 => {}
        _ => row.complain(header, Cause::ManyActions { found }),
    }
    action
}

/// The lane's number. Where there is one lane, it need not be given.
fn read_lane(cast: &Cast<'_>, row: &mut Table<'_>) -> Option<usize> {
    if !row.has(LANE.key) {
        if cast.lanes != 1 {
            row.complain(row.header.clone(), Cause::NoLane { lanes: cast.lanes });
            return None;
        }
        return Some(1);
    }
    row.whole(LANE, 1..=cast.lanes as u32).map(|lane| lane as usize)
}

fn read_method(cast: &Cast<'_>, row: &mut Table<'_>) -> Option<Action> {
    let method = row.method(METHOD);
    let substeps = row.whole(SUBSTEPS, 1..=MOST_SUBSTEPS);
    let tolerance = read_tolerance(row, method);
    if [LANE, SUBSTEPS, TOLERANCE].iter().any(|field| row.has(field.key)) {
        let lane = read_lane(cast, row)?;
        let spec = LaneSpec { method: method?, substeps: substeps.unwrap_or(1), tolerance };
        return Some(Action::Lane { lane, spec });
    }
    method.map(Action::Method)
}

/// The body that a table names, by its place.
fn read_body<'d>(cast: &Cast<'d>, table: &mut Table<'_>) -> Option<(usize, &'d Described)> {
    let name = table.text(BODY, MOST_NAME_CHARS)?;
    let is_called = |body: &Described| body.name.as_ref() == Some(&name);
    let Some(place) = cast.bodies.iter().position(is_called) else {
        let known = cast.bodies.iter().filter_map(|body| body.name.clone()).collect();
        table.complain(table.span(BODY.key), Cause::UnknownBody { name, known });
        return None;
    };
    Some((place, &cast.bodies[place]))
}

fn read_set(cast: &Cast<'_>, set: &mut Table<'_>) -> Option<Action> {
    let body = read_body(cast, set);
    let key = set.text(KEY, MOST_NAME_CHARS);
    set.knows(VALUE.key);
    let (place, Described { kind, values, .. }) = body?;
    let key = key?;
    let Some((parameter, &Parameter { range, .. })) = kind.parameter(&key) else {
        let known: Vec<_> = kind.parameters.iter().map(|parameter| parameter.key).collect();
        let nearest = nearest(&key, known.iter().map(|name| (*name, *name)));
        set.complain(set.span(KEY.key), Cause::UnknownParameter { key, nearest, known });
        return None;
    };
    let value = match range {
        Range::Count(most) => f64::from(set.whole(VALUE, 1..=most)?),
        _ => set.number(VALUE, range)?,
    };
    // A fault with what the body has otherwise; where that was set before, it may be none.
    if let Some(values) = values
        && let Err(error) = edited_values(kind, values, parameter, value)
        && let Some(fault) = error.fault()
    {
        set.complain(set.span(VALUE.key), Cause::Fault(fault));
    }
    Some(Action::Set { body: place, parameter, value })
}

fn read_place(cast: &Cast<'_>, place: &mut Table<'_>) -> Option<Action> {
    let body = read_body(cast, place);
    [Q, V].iter().for_each(|field| place.knows(field.key));
    let (at, Described { kind, values, .. }) = body?;
    let count = (kind.coordinates)(values.as_ref()?).len();
    let (q, v) = (place.numbers(Q, count), place.numbers(V, count));
    Some(Action::Place { body: at, q: q?.into(), v: v?.into() })
}

/// What the lanes are known to come to.
pub(super) fn read_checks(cast: &Cast<'_>, top: &mut Table<'_>) -> Vec<Check> {
    let mut checks: Vec<Check> = Vec::new();
    for mut row in top.rows("check") {
        let tick = row.whole(CHECKED_TICK, 0..=LAST_TICK);
        let lane = row.whole(CHECKED_LANE, 1..=cast.lanes.max(1) as u32);
        let hash = row.hash(HASH);
        if let (Some(tick), Some(lane), Some(hash)) = (tick, lane, hash) {
            checks.push(Check { tick, lane: lane as usize, hash });
        }
        top.adopt(row, &TOP);
    }
    checks
}
