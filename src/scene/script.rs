//! Reads a scene's script and the hashes that the scene's race must reproduce: `[[command]]` and `[[check]]`.

use std::ops::Range as Span;

use super::described::{BodyDraft, check_method};
use super::fault::{FaultKind, SceneFault};
use super::keys::{
    JOINT_HZ, Key, METHOD, SPEC, STEP_S, SUBSTEPS, TICK_HZ, TOLERANCE, adaptive_methods, number,
    numbers, quoted, read_lane_spec, read_tolerance, replace_if_read, step_s, tick_hz,
};
use super::nearest::listed;
use super::table::Table;
use super::wanted::{Field, Wanted};
use super::{
    Action, Check, LAST_TICK, LaneId, LaneSpec, MAX_LANES, MAX_NAME_CHARS, MAX_SECONDS, Scene,
    Scripted,
};
use crate::sim::TickRate;
use crate::sim::bodies::{BODIES, MAX_VALUE, Range};
use crate::sim::integrators::Method;

pub(super) use of_a_body::OF_A_BODY;
use of_a_body::{
    BODY, KEY, MAX_PULL_TICKS, Q, V, VALUE, on_each_tick, pull, read_place, read_push, read_set,
};

mod of_a_body;

/// The name of the table array of a script.
pub(super) const COMMAND: &str = "command";

/// The name of the table array of checks.
pub(super) const CHECKS: &str = "check";

const LANE_NUMBER: Wanted = Wanted::Whole(1..=MAX_LANES as u64);
const NAME: Wanted = Wanted::Text(MAX_NAME_CHARS);

pub(super) const AT_S: Field = Field::required(
    "at_s",
    "its time in seconds: it acts before the nearest tick, at any tick rate",
    Wanted::Number(Range::Between(0.0, MAX_SECONDS)),
);
pub(super) const TICK: Field = Field::optional(
    "tick",
    "in a recording, in place of `at_s`: the tick before which it acts",
    Wanted::Whole(0..=LAST_TICK),
);
pub(super) const LANE: Field =
    Field::optional("lane", "the lane whose method, substeps or tolerance it sets", LANE_NUMBER);

/// The keys of `[[check]]`. The reader needs the number of lanes.
pub(super) static CHECK: [Key<(Check, usize), Check>; 3] = [
    Key {
        field: Field::required("tick", "the tick of the check", Wanted::Whole(0..=LAST_TICK)),
        read: |(check, _), row, field| replace_if_read(&mut check.tick, row.whole(field)),
        write: |check| Some(check.tick.to_string()),
    },
    Key {
        field: Field::required("lane", "the lane's number", LANE_NUMBER),
        read: |(check, lanes), row, field| {
            replace_if_read(&mut check.lane, read_number(row, field, *lanes))
        },
        write: |check| Some(check.lane.to_string()),
    },
    Key {
        field: Field::required("hash", "the lane's state then", Wanted::Hash),
        read: |(check, _), row, field| replace_if_read(&mut check.hash, row.hash(field)),
        write: |check| Some(format!("\"{:016x}\"", check.hash)),
    },
];

/// The bodies and lanes that a script can name, and the tick rate at the script's start.
pub(super) struct SceneContext<'d> {
    /// The bodies, each of which has a name.
    pub(super) bodies: &'d [BodyDraft],
    pub(super) lanes: &'d [LaneSpec],
    pub(super) tick_hz: TickRate,
}

type Read = fn(&SceneContext<'_>, &mut Table<'_>, &Field) -> Option<Action>;
type Write = fn(&Scene, &Action) -> Option<String>;

/// A key of `[[command]]` with the action that it stands for.
pub(super) struct CommandKey {
    pub(super) field: Field,
    /// Whether the action is an input, which has an effect only if some body takes an input of this name.
    is_input: bool,
    read: Read,
    /// Writes the value, if the action belongs to this key.
    write: Write,
}

const fn command_key(field: Field, read: Read, write: Write) -> CommandKey {
    CommandKey { field, is_input: false, read, write }
}

const fn input(
    key: &'static str,
    about: &'static str,
    range: Range,
    read: Read,
    write: Write,
) -> CommandKey {
    let field = Field::optional(key, about, Wanted::Number(range));
    CommandKey { is_input: true, ..command_key(field, read, write) }
}

/// The keys that change a lane, which `lane` selects.
const OF_A_LANE: [&str; 3] = [METHOD.key, SUBSTEPS.key, TOLERANCE.key];

pub(super) static COMMAND_KEYS: [CommandKey; 12] = [
    command_key(
        Field::optional("method", "the method, for a lane with what else it has", Wanted::Method),
        |context, row, _| read_method(context, row),
        |_, action| if let Action::Method(it) = action { Some(quoted(it.id)) } else { None },
    ),
    input(
        "throttle",
        "the throttle of every body that has one",
        Range::Within(1.0),
        |_, row, field| row.number(field).map(Action::Throttle),
        |_, action| if let Action::Throttle(part) = action { Some(number(*part)) } else { None },
    ),
    input(
        "rudder",
        "the rudder of every body that has one; positive is left",
        Range::Within(1.0),
        |_, row, field| row.number(field).map(Action::Rudder),
        |_, action| if let Action::Rudder(part) = action { Some(number(*part)) } else { None },
    ),
    input(
        "kick",
        "an impulse for every body: this many times its own kick",
        Range::Within(MAX_VALUE),
        |_, row, field| row.number(field).map(Action::Kick),
        |_, action| if let Action::Kick(times) = action { Some(number(*times)) } else { None },
    ),
    command_key(
        Field::optional(TICK_HZ.key, "ticks per second", Wanted::TickRate),
        |_, row, field| row.tick_rate(field).map(Action::TickHz),
        |_, action| action.tick_hz().and_then(tick_hz),
    ),
    command_key(
        STEP_S,
        |_, row, field| row.tick_rate(field).map(Action::TickHz),
        |_, action| action.tick_hz().and_then(step_s),
    ),
    command_key(
        SUBSTEPS,
        |context, row, field| {
            let substeps = row.whole(field);
            let lane = read_lane(context, row)?;
            Some(Action::Substeps { lane, substeps: substeps? })
        },
        |_, action| match action {
            Action::Substeps { substeps, .. } => Some(substeps.to_string()),
            _ => None,
        },
    ),
    command_key(
        TOLERANCE,
        |context, row, _| {
            let tolerance = read_tolerance(row, None);
            let lane = read_lane(context, row)?;
            Some(Action::Tolerance { lane, tolerance: tolerance? })
        },
        |_, action| match action {
            Action::Tolerance { tolerance, .. } => Some(number(*tolerance)),
            _ => None,
        },
    ),
    command_key(
        Field::optional("set", "sets a parameter of a body", Wanted::Table("set")),
        |context, row, field| row.read_below(field, |set| read_set(context, set))?,
        |scene, action| {
            let Action::Set { body, parameter, value } = action else { return None };
            let body = &scene.bodies[*body];
            let parameter = &body.kind.parameters[*parameter];
            let value = parameter_value(parameter.range, *value);
            let (name, key) = (quoted(&body.name), quoted(&parameter.key));
            Some(inline(&[(BODY, name), (KEY, key), (VALUE, value)]))
        },
    ),
    command_key(
        Field::optional("place", "puts a body into a state", Wanted::Table("place")),
        |context, row, field| row.read_below(field, |place| read_place(context, place))?,
        |scene, action| {
            let Action::Place { body, q, v } = action else { return None };
            let name = quoted(&scene.bodies[*body].name);
            Some(inline(&[(BODY, name), (Q, numbers(q)), (V, numbers(v))]))
        },
    ),
    command_key(
        Field::optional("push", "changes a body's velocities", Wanted::Table("push")),
        |context, row, field| row.read_below(field, |push| read_push(context, push))?,
        |scene, action| {
            let Action::Push { body, by } = action else { return None };
            Some(pull(scene, *body, by, 1))
        },
    ),
    command_key(
        Field::optional("solo", "the only lane that stays", LANE_NUMBER),
        |context, row, field| {
            read_number(row, field, context.lanes.len()).map(|lane| Action::Solo { lane })
        },
        |_, action| if let Action::Solo { lane } = action { Some(lane.to_string()) } else { None },
    ),
];

/// Returns an inline table.
fn inline(entries: &[(Field, String)]) -> String {
    let entries = entries.iter().map(|(field, value)| format!("{} = {value}", field.key));
    format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
}

/// Returns a parameter's value as TOML, if the parameter is not a curve.
pub(super) fn parameter_value(range: Range, value: f64) -> String {
    match range {
        Range::Count(_) => format!("{}", value as u64),
        _ => number(value),
    }
}

/// Returns the tables of the commands of `scene`, in ticks for a recording and in seconds otherwise. In a recording, a
/// pull is one command.
pub(super) fn command_tables(scene: &Scene) -> Vec<String> {
    let is_recording = !scene.checks.is_empty();
    let rows: Vec<_> = scene.script.iter().zip(scene.script_on_ticks()).collect();
    let mut tables = Vec::new();
    let mut rest = &rows[..];
    while let [(row, (tick, _)), ..] = rest {
        let when = match is_recording {
            true => format!("{} = {tick}", TICK.key),
            false => format!("{} = {}", AT_S.key, number(row.at_s)),
        };
        let mut by = Vec::new();
        let pulls = rest.iter().zip(*tick..).take(MAX_PULL_TICKS).map_while(|(next, wanted)| {
            let (Action::Push { body: first, .. }, Action::Push { body, by: more }) =
                (&row.action, &next.0.action)
            else {
                return None;
            };
            (is_recording && body == first && next.1.0 == wanted)
                .then(|| by.extend_from_slice(more))
        });
        match (pulls.count(), &row.action) {
            (ticks @ 2.., Action::Push { body, .. }) => {
                let value = pull(scene, *body, &by, ticks);
                tables.push(format!("\n[[{COMMAND}]]\n{when}\npush = {value}\n"));
                rest = &rest[ticks..];
            }
            _ => {
                tables.push(command_table(scene, &when, &row.action));
                rest = &rest[1..];
            }
        }
    }
    tables
}

fn command_table(scene: &Scene, when: &str, action: &Action) -> String {
    let mut text = format!("\n[[{COMMAND}]]\n{when}\n");
    if let Action::Lane { lane, .. }
    | Action::Substeps { lane, .. }
    | Action::Tolerance { lane, .. } = action
    {
        text += &format!("{} = {lane}\n", LANE.key);
    }
    if let Action::Lane { spec, .. } = action {
        return text + &Key::lines(&SPEC, spec);
    }
    for CommandKey { field, write, .. } in &COMMAND_KEYS {
        let value = write(scene, action);
        text.extend(value.map(|value| format!("{} = {value}\n", field.key)));
    }
    text
}

/// The time of a command, in the unit of its table.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum When {
    Second(f64),
    Tick(u64),
}

impl When {
    /// Returns the time this many ticks later.
    fn after(self, ticks: u64, tick_hz: TickRate) -> Self {
        match self {
            When::Second(at_s) if ticks > 0 => When::Second(at_s + ticks as f64 / tick_hz.hz()),
            When::Second(at_s) => When::Second(at_s),
            When::Tick(tick) => When::Tick((tick + ticks).min(LAST_TICK)),
        }
    }
}

/// A command as read from the file.
struct Command {
    when: When,
    action: Action,
    /// Bytes of the time.
    when_span: Span<usize>,
    tolerance_span: Span<usize>,
}

/// Reads the script, sorted by time; commands with the same time keep the order of the file.
pub(super) fn read(context: &SceneContext<'_>, top: &mut Table<'_>) -> Vec<Scripted> {
    let mut commands: Vec<Command> = Vec::new();
    let rows = top.rows(COMMAND);
    let is_mixed = [AT_S.key, TICK.key].iter().all(|key| rows.iter().any(|row| row.has(key)));
    for mut row in rows {
        let when = read_when(&mut row, is_mixed);
        let action = read_action(context, &mut row);
        let [tick, at_s, tolerance_span] =
            [TICK.key, AT_S.key, TOLERANCE.key].map(|key| row.span(key));
        let when_span = if row.has(TICK.key) { tick } else { at_s };
        let Some((when, action)) = when.zip(action) else {
            top.add_faults_of(row);
            continue;
        };
        commands.extend((0..).zip(on_each_tick(context, action)).map(|(after, action)| Command {
            when: when.after(after, context.tick_hz),
            action,
            when_span: when_span.clone(),
            tolerance_span: tolerance_span.clone(),
        }));
        top.add_faults_of(row);
    }
    let order = |a: &When, b: &When| a.partial_cmp(b).expect("numbers of scenes are finite");
    commands.sort_by(|a, b| order(&a.when, &b.when));
    let told_in_ticks = |command: &Command| match command.when {
        When::Tick(tick) => Some((tick, command.action.clone())),
        When::Second(_) => None,
    };
    let told_in_seconds = |command: &Command| match command.when {
        When::Second(at_s) => Some(Scripted { at_s, action: command.action.clone() }),
        When::Tick(_) => None,
    };
    let in_ticks = commands.iter().filter_map(told_in_ticks);
    let mut script = Scripted::of_ticks(context.tick_hz, in_ticks);
    if !top.has(CHECKS) {
        script.iter().zip(&commands).for_each(|(row, command)| refuse_tick(row, command, top));
    }
    script.extend(commands.iter().filter_map(told_in_seconds));
    // If a lane or a command could not be read, the methods in force are unknown.
    if top.is_faultless() {
        let spans = commands.into_iter().map(|command| command.tolerance_span);
        check_tolerances(context.lanes, script.iter().zip(spans), top);
    }
    script
}

/// Reads the time of a command. Reports a tick if `is_mixed` is true, which means that other commands have seconds.
fn read_when(row: &mut Table<'_>, is_mixed: bool) -> Option<When> {
    [AT_S, TICK].iter().for_each(|field| row.allow_key(field.key));
    if is_mixed && row.has(TICK.key) {
        let (tick, at_s) = (TICK.key, AT_S.key);
        let what = format!("`{tick}` gives the time, and other commands have `{at_s}`");
        row.report_fault(row.span(tick), what, format!("write `{at_s} = …` in its place: seconds"));
        return None;
    }
    match row.has(TICK.key) {
        true => row.whole(&TICK).map(When::Tick),
        false => row.number(&AT_S).map(When::Second),
    }
}

/// Reports a tick in a scene that is no recording, with the time in seconds as its remedy.
fn refuse_tick(Scripted { at_s, .. }: &Scripted, command: &Command, top: &mut Table<'_>) {
    let (tick, seconds) = (TICK.key, number(at_s.min(MAX_SECONDS)));
    let what = format!("`{tick}` is for recordings: at another tick rate the motion would change");
    let remedy = format!("write `{} = {seconds}` in its place", AT_S.key);
    top.report_fault(command.when_span.clone(), what, remedy);
}

/// Reports every tolerance for a lane whose method takes none at that time, both in the race and in solo. Each
/// command comes with the span of its `tolerance`.
fn check_tolerances<'s>(
    lanes: &[LaneSpec],
    script: impl Iterator<Item = (&'s Scripted, Span<usize>)>,
    top: &mut Table<'_>,
) {
    let mut in_race: Vec<&Method> = lanes.iter().map(|spec| spec.method).collect();
    let mut in_solo = in_race.clone();
    // A method without a lane changes nothing while several lanes race.
    let mut race_is_over = false;
    for (Scripted { at_s, action }, span) in script {
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
                        "`tolerance` does not apply to lane {lane}: at {at_s} s its method is {method:?}"
                    );
                    let those = adaptive_methods();
                    let remedy =
                        format!("remove it, or give it with an adaptive `method`: {those}");
                    top.report_fault(span, what, remedy);
                }
            }
            _ => {}
        }
    }
}

fn read_action(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<Action> {
    row.allow_key(LANE.key);
    // Substeps and a tolerance may accompany a method.
    let goes_with = |key: &str| row.has(METHOD.key) && OF_A_LANE[1..].contains(&key);
    let given = COMMAND_KEYS.iter().filter(|it| row.has(it.field.key) && !goes_with(it.field.key));
    let found: Vec<_> = given.map(|command_key| command_key.field.key).collect();
    let mut action = None;
    for CommandKey { field, is_input, read, .. } in &COMMAND_KEYS {
        row.allow_key(field.key);
        if !found.contains(&field.key) {
            continue;
        }
        // All keys are read, even if only one is allowed, so that all faults are found.
        action = read(context, row, field).or(action);
        let input = field.key;
        let takes =
            |body: &BodyDraft| body.kind.as_ref().is_none_or(|kind| kind.inputs.contains(&input));
        if *is_input && !context.bodies.is_empty() && !context.bodies.iter().any(takes) {
            let takers = BODIES.iter().filter(|kind| kind.inputs.contains(&input));
            let takers = listed(&takers.map(|kind| kind.id).collect::<Vec<_>>(), '[', " or ");
            let remedy = format!("remove the command, or add a table {takers}");
            row.report_fault(
                row.span(field.key),
                format!("no body of this scene takes `{input}`"),
                remedy,
            );
        }
    }
    if row.has(LANE.key) && !found.is_empty() && !found.iter().any(|key| OF_A_LANE.contains(key)) {
        let remedy = format!("remove it, or give one of {}", listed(&OF_A_LANE, '`', ", "));
        row.report_fault(row.span(LANE.key), "`lane` does not apply to this command", remedy);
    }
    let header = row.header.clone();
    match found.len() {
        0 => {
            let known: Vec<_> = COMMAND_KEYS.iter().map(|command| command.field.key).collect();
            let remedy = format!("write one of {}", listed(&known, '`', ", "));
            let fault = SceneFault::new("the command does nothing", remedy);
            row.add_fault(header, fault.of(FaultKind::Missing(known)));
        }
        1 => {}
        many => {
            let what = format!("the command does {many} things: {}", listed(&found, '`', " and "));
            row.report_fault(header, what, "write a `[[command]]` with the same `at_s` for each");
        }
    }
    action
}

/// Reads the number of one of `lanes` lanes.
fn read_number(row: &mut Table<'_>, field: &Field, lanes: usize) -> Option<LaneId> {
    let field = Field { wanted: Wanted::Whole(1..=lanes as u64), ..field.clone() };
    row.whole::<u32>(&field).map(|number| LaneId(number as usize))
}

/// Reads the lane of a command. A scene with one lane may leave it out.
fn read_lane(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<LaneId> {
    if !row.has(LANE.key) {
        if context.lanes.len() != 1 {
            let remedy = format!("write `lane = …`: its number, from 1 to {}", context.lanes.len());
            row.report_fault(row.header.clone(), "the command names no lane", remedy);
            return None;
        }
        return Some(LaneId(1));
    }
    read_number(row, &LANE, context.lanes.len())
}

fn read_method(context: &SceneContext<'_>, row: &mut Table<'_>) -> Option<Action> {
    let spec = read_lane_spec(row, Default::default());
    if let Some(LaneSpec { method, .. }) = spec {
        check_method(METHOD.key, method, row.span(METHOD.key), context.bodies, row);
    }
    if [LANE, SUBSTEPS, TOLERANCE, JOINT_HZ].iter().any(|field| row.has(field.key)) {
        let lane = read_lane(context, row)?;
        return Some(Action::Lane { lane, spec: spec? });
    }
    spec.map(|spec| Action::Method(spec.method))
}

/// Reads the states that lanes must reach.
pub(super) fn read_checks(context: &SceneContext<'_>, top: &mut Table<'_>) -> Vec<Check> {
    let mut checks: Vec<Check> = Vec::new();
    for mut row in top.rows(CHECKS) {
        let check = Check { tick: 0, lane: LaneId(1), hash: 0 };
        let mut draft = (check, context.lanes.len().max(1));
        Key::read_all(&CHECK, &mut draft, &mut row);
        checks.push(draft.0);
        top.add_faults_of(row);
    }
    checks
}
