//! Reads a scene's script and the hashes that its race has to reproduce: `[[command]]` and `[[check]]`.

use super::clip::clip;
use super::described::BodyDraft;
use super::fault::{FaultKind, SceneFault};
use super::fields::{
    JOINT_HZ, SUBSTEPS, TOLERANCE, TOP, adaptive_methods, optional, read_lane_spec, read_tolerance,
    required,
};
use super::fitting::check_method;
use super::nearest::{listed, nearest, offer};
use super::table::{Field, Table};
use super::{Check, LAST_TICK, MAX_NAME_CHARS, MAX_SUBSTEPS, MAX_TICK_HZ, Scripted};
use crate::lab::action::Action;
use crate::lab::lane_id::LaneId;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::edit::edited_values;
use crate::sim::bodies::{Acts, BODIES, LARGEST, Parameter, Range};
use crate::sim::integrators::Method;

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

/// The bodies and lanes that a script can refer to.
pub(super) struct SceneContext<'d> {
    /// Each with a name.
    pub(super) bodies: &'d [BodyDraft],
    pub(super) lanes: &'d [LaneSpec],
}

/// A key of `[[command]]`, which stands for an action.
struct CommandKey {
    field: Field,
    /// The input that some body must take for the action to have an effect.
    input: Option<&'static str>,
    read: fn(&SceneContext<'_>, &mut Table<'_>, Field) -> Option<Action>,
}

const fn command_key(
    key: &'static str,
    read: fn(&SceneContext<'_>, &mut Table<'_>, Field) -> Option<Action>,
) -> CommandKey {
    CommandKey { field: optional(key), input: None, read }
}

const fn input(
    key: &'static str,
    read: fn(&SceneContext<'_>, &mut Table<'_>, Field) -> Option<Action>,
) -> CommandKey {
    CommandKey { input: Some(key), ..command_key(key, read) }
}

/// The keys that change a lane; `lane` says which.
const OF_A_LANE: [&str; 3] = [METHOD.key, SUBSTEPS.key, TOLERANCE.key];

static COMMAND_KEYS: [CommandKey; 10] = [
    command_key(METHOD.key, |context, row, _| read_method(context, row)),
    input("throttle", |_, row, field| row.number(field, Range::Within(1.0)).map(Action::Throttle)),
    input("rudder", |_, row, field| row.number(field, Range::Within(1.0)).map(Action::Rudder)),
    input("kick", |_, row, field| row.number(field, Range::Within(LARGEST)).map(Action::Kick)),
    command_key("tick_hz", |_, row, field| row.whole(field, 1..=MAX_TICK_HZ).map(Action::TickHz)),
    command_key(SUBSTEPS.key, |context, row, field| {
        let substeps = row.whole(field, 1..=MAX_SUBSTEPS);
        let lane = read_lane(context, row)?;
        Some(Action::Substeps { lane, substeps: substeps? })
    }),
    command_key(TOLERANCE.key, |context, row, _| {
        let tolerance = read_tolerance(row, None);
        let lane = read_lane(context, row)?;
        Some(Action::Tolerance { lane, tolerance: tolerance? })
    }),
    command_key("set", |context, row, _| {
        let mut set = row.table("set")?;
        let action = read_set(context, &mut set);
        row.adopt(set, &TOP);
        action
    }),
    command_key("place", |context, row, _| {
        let mut place = row.table("place")?;
        let action = read_place(context, &mut place);
        row.adopt(place, &TOP);
        action
    }),
    command_key(SOLO.key, |context, row, field| {
        read_number(row, field, context.lanes.len()).map(|lane| Action::Solo { lane })
    }),
];

/// The scripted commands by tick, and within a tick in the order of the file.
pub(super) fn read(context: &SceneContext<'_>, top: &mut Table<'_>) -> Vec<Scripted> {
    let mut script = Vec::new();
    for mut row in top.rows("command") {
        let tick = row.whole(TICK, 0..=LAST_TICK);
        let action = read_action(context, &mut row);
        let span = row.span(TOLERANCE.key);
        let scripted = tick.zip(action).map(|(tick, action)| (Scripted { tick, action }, span));
        script.extend(scripted);
        top.adopt(row, &TOP);
    }
    script.sort_by_key(|(scripted, _)| scripted.tick);
    // If a lane or a command could not be read, the methods in force are unknown.
    if top.is_faultless() {
        check_tolerances(context.lanes, &script, top);
    }
    script.into_iter().map(|(scripted, _)| scripted).collect()
}

/// Complains of every tolerance for a lane whose method takes none at that tick, whether the lane races or is flown
/// solo. The span of a command is that of its `tolerance`.
fn check_tolerances(
    lanes: &[LaneSpec],
    script: &[(Scripted, std::ops::Range<usize>)],
    top: &mut Table<'_>,
) {
    let mut in_race: Vec<&Method> = lanes.iter().map(|spec| spec.method).collect();
    let mut in_solo = in_race.clone();
    // A method given without a lane changes nothing while several race.
    let mut race_is_over = false;
    for (Scripted { tick, action }, span) in script {
        match *action {
            Action::Method(method) => {
                in_solo.fill(method);
                if race_is_over {
                    in_race.fill(method);
                }
            }
            Action::Lane { lane, spec } => {
                (in_race[lane.index()], in_solo[lane.index()]) = (spec.method, spec.method);
            }
            Action::Solo { .. } => race_is_over = true,
            Action::Tolerance { lane, .. } => {
                let methods = [in_race[lane.index()], in_solo[lane.index()]];
                if methods.iter().all(|method| method.tolerance.is_none()) {
                    let method = methods[0].id;
                    let what = format!(
                        "`tolerance` does not apply to lane {lane}: at tick {tick} its method is {method:?}"
                    );
                    let those = adaptive_methods();
                    let remedy =
                        format!("remove it, or give it with an adaptive `method`: {those}");
                    top.complain(span.clone(), what, remedy);
                }
            }
            _ => {}
        }
    }
}

fn read_action(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<Action> {
    row.knows(LANE.key);
    // Substeps and a tolerance may go with a method.
    let goes_with = |key: &str| row.has(METHOD.key) && OF_A_LANE[1..].contains(&key);
    let given = COMMAND_KEYS.iter().filter(|it| row.has(it.field.key) && !goes_with(it.field.key));
    let found: Vec<_> = given.map(|command_key| command_key.field.key).collect();
    let mut action = None;
    for CommandKey { field, input, read } in &COMMAND_KEYS {
        row.knows(field.key);
        if !found.contains(&field.key) {
            continue;
        }
        // All are read, even if only one is allowed, so that all faults are found.
        action = read(context, row, *field).or(action);
        if let Some(input) = *input
            && !context.bodies.is_empty()
            && !context
                .bodies
                .iter()
                .any(|body| body.kind.as_ref().is_none_or(|kind| kind.inputs.contains(&input)))
        {
            let takers = BODIES.iter().filter(|kind| kind.inputs.contains(&input));
            let takers = listed(&takers.map(|kind| kind.id).collect::<Vec<_>>(), '[', " or ");
            let remedy = format!("remove the command, or add a table {takers}");
            row.complain(
                row.span(field.key),
                format!("no body of this scene takes `{input}`"),
                remedy,
            );
        }
    }
    if row.has(LANE.key) && !found.is_empty() && !found.iter().any(|key| OF_A_LANE.contains(key)) {
        let remedy = format!("remove it, or give one of {}", listed(&OF_A_LANE, '`', ", "));
        row.complain(row.span(LANE.key), "`lane` does not apply to this command", remedy);
    }
    let header = row.header.clone();
    match found.len() {
        0 => {
            let known: Vec<_> = COMMAND_KEYS.iter().map(|command| command.field.key).collect();
            let remedy = format!("write one of {}", listed(&known, '`', ", "));
            let fault = SceneFault::new("the command does nothing", remedy);
            row.complain_of(header, fault.of(FaultKind::Missing(known)));
        }
        1 => {}
        many => {
            let what = format!("the command does {many} things: {}", listed(&found, '`', " and "));
            row.complain(header, what, "write a `[[command]]` with the same `tick` for each");
        }
    }
    action
}

/// The lane of this number, of so many.
fn read_number(row: &mut Table<'_>, field: Field, lanes: usize) -> Option<LaneId> {
    row.whole(field, 1..=lanes as u32).map(|number| LaneId(number as usize))
}

/// The lane that a command is for. If the scene has one lane, it may be left out.
fn read_lane(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<LaneId> {
    if !row.has(LANE.key) {
        if context.lanes.len() != 1 {
            let remedy = format!("write `lane = …`: its number, from 1 to {}", context.lanes.len());
            row.complain(row.header.clone(), "the command does not say of which lane", remedy);
            return None;
        }
        return Some(LaneId(1));
    }
    read_number(row, LANE, context.lanes.len())
}

fn read_method(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<Action> {
    let method = row.method(METHOD);
    if let Some(method) = method {
        check_method(METHOD.key, method, row.span(METHOD.key), context.bodies, row);
    }
    let spec = read_lane_spec(row, method);
    if [LANE, SUBSTEPS, TOLERANCE, JOINT_HZ].iter().any(|field| row.has(field.key)) {
        let lane = read_lane(context, row)?;
        return Some(Action::Lane { lane, spec: spec? });
    }
    method.map(Action::Method)
}

/// The body that a table names, with its index in the scene.
fn read_body<'d>(
    context: &SceneContext<'d>,
    table: &mut Table<'_>,
) -> Option<(usize, &'d BodyDraft)> {
    let name = table.text(BODY, MAX_NAME_CHARS)?;
    let is_called = |body: &BodyDraft| body.name.as_ref() == Some(&name);
    let Some(place) = context.bodies.iter().position(is_called) else {
        let known = context.bodies.iter().filter_map(|body| body.name.as_deref());
        let remedy = format!("write one of {}", listed(&known.collect::<Vec<_>>(), '"', ", "));
        let what = format!("no body of this scene is called {:?}", clip(&name));
        table.complain(table.span(BODY.key), what, remedy);
        return None;
    };
    Some((place, &context.bodies[place]))
}

fn read_set(context: &SceneContext<'_>, set: &mut Table<'_>) -> Option<Action> {
    let body = read_body(context, set);
    let key = set.text(KEY, MAX_NAME_CHARS);
    set.knows(VALUE.key);
    let (place, BodyDraft { kind, values, .. }) = body?;
    let (key, kind) = (key?, kind.as_ref()?);
    let Some((parameter, Parameter { key: known, range, acts, .. })) = kind.parameter(&key) else {
        let known: Vec<&str> = kind.parameters.iter().map(|parameter| &*parameter.key).collect();
        let nearest = nearest(&key, known.iter().map(|name| (*name, *name)));
        let what = format!("{:?} is no parameter of this body", clip(&key));
        set.complain(set.span(KEY.key), what, offer(nearest, &known, '"'));
        return None;
    };
    if *acts == Acts::AtStart {
        let at_once = kind.parameters.iter().filter(|parameter| parameter.acts == Acts::AtOnce);
        let settable: Vec<&str> = at_once.map(|parameter| &*parameter.key).collect();
        let remedy = format!(
            "write it in the body's table, move the body by `place`, or set one of {}",
            listed(&settable, '"', ", ")
        );
        let what = format!("`{known}` acts at the start only, and a command comes later");
        set.complain(set.span(KEY.key), what, remedy);
        return None;
    }
    let value = match *range {
        Range::Count(most) => f64::from(set.whole(VALUE, 1..=most)?),
        _ => set.number(VALUE, *range)?,
    };
    // A fault with what the body has otherwise; where that was set before, it may be none.
    if let Some(values) = values
        && let Err(error) = edited_values(kind, values, parameter, value)
        && let Some(fault) = error.fault()
    {
        set.complain_of(set.span(VALUE.key), fault.into());
    }
    Some(Action::Set { body: place, parameter, value })
}

fn read_place(context: &SceneContext<'_>, place: &mut Table<'_>) -> Option<Action> {
    let body = read_body(context, place);
    [Q, V].iter().for_each(|field| place.knows(field.key));
    let (at, BodyDraft { kind, values, .. }) = body?;
    let count = kind.as_ref()?.coordinates(values.as_ref()?).len();
    let (q, v) = (place.coordinates(Q, count), place.coordinates(V, count));
    Some(Action::Place { body: at, q: q?.into(), v: v?.into() })
}

/// The states that lanes are known to reach.
pub(super) fn read_checks(context: &SceneContext<'_>, top: &mut Table<'_>) -> Vec<Check> {
    let mut checks: Vec<Check> = Vec::new();
    for mut row in top.rows("check") {
        let tick = row.whole(CHECKED_TICK, 0..=LAST_TICK);
        let lane = read_number(&mut row, CHECKED_LANE, context.lanes.len().max(1));
        let hash = row.hash(HASH);
        if let (Some(tick), Some(lane), Some(hash)) = (tick, lane, hash) {
            checks.push(Check { tick, lane, hash });
        }
        top.adopt(row, &TOP);
    }
    checks
}
