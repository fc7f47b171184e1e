//! Reads a scene file from its top level down into a [`Scene`].

use toml::de::DeTable;

use super::described::{BodyDraft, check_names, finish_bodies, name_the_nameless, read_bodies};
use super::errors::{SceneError, position};
use super::fault::{FaultKind, SceneFault};
use super::fields::{
    ABOUT, HINT, METHOD_LIST, OPENING_METHOD, SECONDS, TICK_HZ, TITLE, TOP, optional,
    read_lane_spec, required,
};
use super::fitting::{check_method, every_lane};
use super::nearest::listed;
use super::script::{self, SceneContext};
use super::syntax;
use super::table::{Field, Table};
use super::{
    MAX_LANES, MAX_SECONDS, MAX_TICK_HZ, MIN_SECONDS, Scene, USUAL_SECONDS, claim_horizon,
};
use crate::lab::lane_spec::LaneSpec;
use crate::sim::bodies::{BODIES, Range};
use crate::sim::integrators::Method;

/// The most characters of a title, which is shown in the window's title bar.
const MAX_TITLE_CHARS: usize = 80;

/// The most characters of `about`: a few lines of a panel.
const MAX_ABOUT_CHARS: usize = 400;

/// The most characters of a hint, which is the line under the stage.
const MAX_HINT_CHARS: usize = 120;

const LANE_METHOD: Field = required("method", "the method that races");
const EQUAL_COST: Field = optional("equal_cost");
const OPENS_AS_RACE: Field = optional("open");

/// Reads the scene called `name`.
///
/// # Errors
/// Everything that is wrong with its text, in no particular order.
pub(super) fn read(name: &str, text: &str) -> Result<Scene, Vec<SceneError>> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut errors = syntax::errors(text, errors);
    // After a duplicate key the rest of the file can be read; after other syntax errors it cannot.
    if errors.iter().any(|error| !matches!(error.fault.kind, FaultKind::Duplicate { .. })) {
        return Err(errors);
    }
    if document.get_ref().is_empty() {
        let remedy = "write `title`, `tick_hz`, `seconds` and a table such as `[[ship]]`";
        let fault = SceneFault::new("the file holds no scene", remedy);
        return Err(vec![SceneError { span: 0..0, fault }]);
    }

    let mut top = Table::top(text, document.get_ref());
    let title = top.text(TITLE, MAX_TITLE_CHARS);
    let about = top.text(ABOUT, MAX_ABOUT_CHARS).unwrap_or_default();
    let hint = top.text(HINT, MAX_HINT_CHARS);
    let tick_hz = top.whole(TICK_HZ, 1..=MAX_TICK_HZ);
    let seconds = top.number(SECONDS, Range::Between(MIN_SECONDS, MAX_SECONDS));
    let seconds = seconds.unwrap_or(USUAL_SECONDS);
    // A scene without a tick rate is refused, whatever its laws claim.
    let horizon = claim_horizon(seconds, tick_hz.unwrap_or(1));
    let mut bodies = read_bodies(&mut top, horizon);
    check_names(text, &bodies, &mut top);
    name_the_nameless(&mut bodies);
    let lanes = read_lanes(text, &bodies, &mut top);
    let opening_method = read_opening_method(&lanes, &mut top);
    let (equal_cost, opens_as_race) = read_race(&mut top);
    let context = SceneContext { bodies: &bodies, lanes: &lanes };
    let script = script::read(&context, &mut top);
    let checks = script::read_checks(&context, &mut top);
    errors.extend(top.finish(&[]));
    let may_mean_a_body = |error: &SceneError| error.fault.kind == FaultKind::NoTable;
    if bodies.is_empty() && !errors.iter().any(may_mean_a_body) {
        let kinds: Vec<_> = BODIES.iter().map(|kind| kind.id).collect();
        let remedy = format!("add a table {}", listed(&kinds, '[', " or "));
        let fault = SceneFault::new("the scene has no body", remedy);
        errors.push(SceneError { span: text.len()..text.len(), fault });
    }

    match (title, tick_hz) {
        (Some(title), Some(tick_hz)) if errors.is_empty() => {
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
                opens_as_race,
                bodies,
                script,
                checks,
            })
        }
        _ => Err(errors),
    }
}

fn read_lanes(text: &str, bodies: &[BodyDraft], top: &mut Table<'_>) -> Vec<LaneSpec> {
    let listed = top.methods(METHOD_LIST, MAX_LANES);
    let is_listed = listed.is_some();
    let listed = listed.into_iter().flatten();
    let mut lanes: Vec<_> = listed.map(|(span, method)| (span, LaneSpec::plain(method))).collect();

    let rows = top.rows("lane");
    if let (true, Some(row)) = (is_listed, rows.first()) {
        let what = "lanes are given twice, as `methods` and as `[[lane]]`";
        top.complain(row.header.clone(), what, "keep one of them");
    }
    if let Some(row) = rows.get(MAX_LANES) {
        let what = format!("the scene has {} lanes", rows.len());
        top.complain(row.header.clone(), what, format!("keep at most {MAX_LANES}"));
    }
    let is_given = is_listed || !rows.is_empty();
    for mut row in rows.into_iter().take(MAX_LANES) {
        let method = row.method(LANE_METHOD);
        let spec = read_lane_spec(&mut row, method);
        let span = row.span(LANE_METHOD.key);
        lanes.extend(spec.map(|spec| (span, spec)));
        top.adopt(row, &TOP);
    }

    let key = if is_listed { METHOD_LIST.key } else { LANE_METHOD.key };
    for (n, (span, lane)) in lanes.iter().enumerate() {
        check_method(key, lane.method, span.clone(), bodies, top);
        if let Some((first, _)) = lanes[..n].iter().find(|(_, earlier)| earlier == lane) {
            let (line, _) = position(text, first.start);
            let what = format!("a lane {} is on line {line} already", described(lane));
            let is_adaptive = lane.method.tolerance.is_some();
            let or = if is_adaptive { " or another `tolerance`" } else { "" };
            let remedy = format!("remove one, or give it other `substeps`{or} in a `[[lane]]`");
            top.complain(span.clone(), what, remedy);
        }
    }
    if is_given { lanes.into_iter().map(|(_, lane)| lane).collect() } else { every_lane(bodies) }
}

/// A lane as a message names it.
fn described(lane: &LaneSpec) -> String {
    let LaneSpec { method, substeps, tolerance, joint } = lane;
    let within = tolerance.map(|tolerance| format!(" and `tolerance = {tolerance:e}`"));
    let told = joint.map(|[hz, _]| format!(" and `joint_hz = {hz}`"));
    let beside = [within, told].into_iter().flatten().collect::<String>();
    format!("{:?} with `substeps = {substeps}`{beside}", method.id)
}

/// The opening method, which must be that of a lane, so that it races too.
fn read_opening_method(lanes: &[LaneSpec], top: &mut Table<'_>) -> Option<&'static Method> {
    let method = top.method(OPENING_METHOD)?;
    if !lanes.is_empty() && !lanes.iter().any(|lane| lane.method == method) {
        let mut known: Vec<&str> = Vec::new();
        for lane in lanes {
            if !known.contains(&lane.method.id) {
                known.push(lane.method.id);
            }
        }
        let (key, id) = (OPENING_METHOD.key, method.id);
        let remedy = format!("write one of {}, or give it a lane", listed(&known, '"', ", "));
        let what = format!("`{key}` is {id:?}, which no lane of this scene has");
        top.complain(top.span(key), what, remedy);
    }
    Some(method)
}

/// The scene's `[race]`: whether its lanes have equal cost, and whether the program opens it as a race.
fn read_race(top: &mut Table<'_>) -> (bool, bool) {
    let Some(mut race) = top.table("race") else { return (false, false) };
    let [equal_cost, opens_as_race] =
        [EQUAL_COST, OPENS_AS_RACE].map(|field| race.boolean(field).unwrap_or(false));
    top.adopt(race, &TOP);
    (equal_cost, opens_as_race)
}
