//! The keys at the top of a scene file, and the reader that turns the file into a [`Scene`].

use std::ops::Range as Span;

use toml::de::DeTable;

use super::described::{
    BodyDraft, check_method, check_names, complete_bodies, every_lane, name_the_nameless,
    read_bodies,
};
use super::errors::{SceneError, position};
use super::fault::{FaultKind, SceneFault};
use super::keys::{
    IMPACT, Key, METHOD, STEP_S, TICK_HZ, list, number, quoted, read_lane_spec, replace_if_read,
    step_s, tick_hz,
};
use super::nearest::listed;
use super::own::{OWN, read_own};
use super::script::{self, SceneContext};
use super::table::Table;
use super::wanted::{Field, Wanted};
use super::{
    CloudShape, LaneSpec, MAX_LANES, MAX_SECONDS, MIN_SECONDS, Scene, USUAL_SECONDS, claim_horizon,
    syntax,
};
use crate::sim::bodies::{BODIES, Range};
use crate::sim::integrators::Method;
use crate::sim::{Impact, TickRate};

/// Name of the table array of lanes.
pub(super) const LANE: &str = "lane";

/// Maximum number of characters in a title, which appears in the window's title bar.
const MAX_TITLE_CHARS: usize = 80;

/// Maximum number of characters in `about`, which fills a few lines of a panel.
const MAX_ABOUT_CHARS: usize = 400;

/// Maximum number of characters in a hint, which is the line under the stage.
const MAX_HINT_CHARS: usize = 120;

pub(super) const METHOD_LIST: Field = Field::optional(
    "methods",
    "the methods that race; by default all that step the bodies, except engines",
    Wanted::Methods,
);
const OPENING_METHOD: Field =
    Field::optional(OWN, "the method shown first; by default the first lane's", Wanted::Method);
const OPENING_BESIDE_OWN: Field = Field::optional(
    "opening_method",
    "the same, in a file with a `[[method]]` of its own",
    Wanted::Method,
);
pub(super) const RACE_TABLE: Field =
    Field::optional("race", "how the lanes race", Wanted::Table("race"));

/// A partly read scene, and the lanes listed by `methods`.
pub(super) struct Draft {
    scene: Scene,
    listed: Option<Vec<(Span<usize>, &'static Method)>>,
    impact: &'static Impact,
}

/// The keys above the first table.
pub(super) static TOP: [Key<Draft, Scene>; 11] = [
    Key {
        field: Field::required(
            "title",
            "the scene's name for people",
            Wanted::Text(MAX_TITLE_CHARS),
        ),
        read: |draft, top, field| replace_if_read(&mut draft.scene.title, top.text(field)),
        write: |scene| Some(quoted(&scene.title)),
    },
    Key {
        field: Field::optional("about", "what it shows", Wanted::Text(MAX_ABOUT_CHARS)),
        read: |draft, top, field| replace_if_read(&mut draft.scene.about, top.text(field)),
        write: |scene| (!scene.about.is_empty()).then(|| quoted(&scene.about)),
    },
    Key {
        field: Field::optional(
            "hint",
            "a suggestion, under the stage",
            Wanted::Text(MAX_HINT_CHARS),
        ),
        read: |draft, top, field| draft.scene.hint = top.text(field),
        write: |scene| scene.hint.as_deref().map(quoted),
    },
    Key {
        field: TICK_HZ,
        read: |draft, top, field| {
            if top.has(field.key) || !top.has(STEP_S.key) {
                replace_if_read(&mut draft.scene.tick_hz, top.tick_rate(field));
            }
        },
        write: |scene| tick_hz(scene.tick_hz),
    },
    Key {
        field: STEP_S,
        read: |draft, top, field| {
            replace_if_read(&mut draft.scene.tick_hz, top.tick_rate(field));
            if top.has(field.key) && top.has(TICK_HZ.key) {
                let what = format!("`{}` and `{}` both give the tick rate", TICK_HZ.key, field.key);
                top.report_fault(top.span(field.key), what, "keep one of them");
            }
        },
        write: |scene| step_s(scene.tick_hz),
    },
    Key {
        field: Field::optional(
            "seconds",
            "its length; by default 20",
            Wanted::Number(Range::Between(MIN_SECONDS, MAX_SECONDS)),
        ),
        read: |draft, top, field| replace_if_read(&mut draft.scene.seconds, top.number(field)),
        write: |scene| Some(number(scene.seconds)),
    },
    Key {
        field: METHOD_LIST,
        read: |draft, top, field| draft.listed = top.methods(field),
        write: |scene| {
            let ids = scene.lanes.iter().map(|spec| quoted(spec.method.id));
            scene.has_plain_lanes().then(|| list(ids))
        },
    },
    Key {
        field: IMPACT,
        read: |draft, top, field| replace_if_read(&mut draft.impact, top.impact(field)),
        // Each lane writes its own.
        write: |_| None,
    },
    Key {
        field: Field::optional(
            "clouds",
            "opens it with clouds of many starts, of this shape, in place of the bodies",
            Wanted::Clouds,
        ),
        read: |draft, top, field| {
            let all = CloudShape::ALL.map(|shape| (shape.id(), shape));
            let ids = all.iter().map(|(id, _)| (*id, *id));
            draft.scene.clouds = top.named(field, |id| format!("unknown clouds {id:?}"), &all, ids);
        },
        write: |scene| scene.clouds.map(|shape| quoted(shape.id())),
    },
    Key {
        field: OPENING_METHOD,
        read: |draft, top, field| {
            if !top.has_tables(field.key) {
                draft.scene.opening_method = top.method(field);
            }
        },
        write: |scene| opening_method(scene, true),
    },
    Key {
        field: OPENING_BESIDE_OWN,
        read: |draft, top, field| {
            let method = top.method(field);
            if top.has(field.key) && draft.scene.opening_method.is_some() {
                let what = format!("`{OWN}` and `{}` both name a method", field.key);
                top.report_fault(top.span(field.key), what, "keep one of them");
            }
            draft.scene.opening_method = method.or(draft.scene.opening_method);
        },
        write: |scene| opening_method(scene, false),
    },
];

/// Returns the scene's opening method, if this key is the one that writes it.
fn opening_method(scene: &Scene, is_plain: bool) -> Option<String> {
    let method = scene.opening_method.filter(|_| scene.own_methods.is_empty() == is_plain)?;
    Some(quoted(method.id))
}

/// The keys of `[race]`.
pub(super) static RACE: [Key<Scene, Scene>; 3] = [
    Key {
        field: Field::optional(
            "equal_cost",
            "gives each lane the substeps that bring its cost nearest to the highest",
            Wanted::Boolean,
        ),
        read: |scene, race, field| replace_if_read(&mut scene.equal_cost, race.boolean(field)),
        write: |scene| scene.equal_cost.then(|| "true".into()),
    },
    Key {
        field: Field::optional("open", "opens the scene as a race", Wanted::Boolean),
        read: |scene, race, field| replace_if_read(&mut scene.opens_as_race, race.boolean(field)),
        write: |scene| scene.opens_as_race.then(|| "true".into()),
    },
    Key {
        field: Field::optional(
            "bands",
            "shows each lane of a race of one body in a band of its own, beside its code",
            Wanted::Boolean,
        ),
        read: |scene, race, field| replace_if_read(&mut scene.opens_in_bands, race.boolean(field)),
        write: |scene| scene.opens_in_bands.then(|| "true".into()),
    },
];

/// Returns the key above the first table with this name.
fn at_top(key: &str) -> Option<&'static str> {
    TOP.iter().map(|it| it.field.key).find(|it| *it == key)
}

/// Reads the scene called `name`.
///
/// # Errors
/// Fails with all faults of the text, in no particular order.
pub(super) fn read(name: &str, text: &str) -> Result<Scene, Vec<SceneError>> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut errors = syntax::errors(text, errors);
    // After a duplicate key, the rest of the file can be read. After other syntax errors it cannot.
    if errors.iter().any(|error| !matches!(error.fault.kind, FaultKind::Duplicate { .. })) {
        return Err(errors);
    }
    if document.get_ref().is_empty() {
        let remedy = "write `title`, `tick_hz`, `seconds` and a table such as `[[ship]]`";
        let fault = SceneFault::new("the file holds no scene", remedy);
        return Err(vec![SceneError { span: 0..0, fault }]);
    }

    let mut top = Table::top(text, at_top, document.get_ref());
    read_own(text, &mut top);
    let scene = Scene {
        name: name.into(),
        source: Some(text.into()),
        title: String::new(),
        about: String::new(),
        hint: None,
        // This rate is a placeholder. A scene without a rate is refused, even if the claims of its laws hold.
        tick_hz: TickRate::whole(1),
        seconds: USUAL_SECONDS,
        lanes: Vec::new(),
        opening_method: None,
        equal_cost: false,
        opens_as_race: false,
        opens_in_bands: false,
        clouds: None,
        bodies: Vec::new(),
        script: Vec::new(),
        checks: Vec::new(),
        own_methods: top.own().to_vec(),
    };
    let mut draft = Draft { scene, listed: None, impact: Default::default() };
    Key::read_all(&TOP, &mut draft, &mut top);
    let Draft { mut scene, listed: by_name, impact } = draft;
    let mut bodies = read_bodies(&mut top, claim_horizon(scene.seconds, scene.tick_hz));
    check_names(text, &bodies, &mut top);
    name_the_nameless(&mut bodies);
    scene.lanes = read_lanes(text, &bodies, by_name, impact, &mut top);
    check_opening_method(&scene, &mut top);
    top.read_below(&RACE_TABLE, |race| Key::read_all(&RACE, &mut scene, race));
    let context = SceneContext { bodies: &bodies, lanes: &scene.lanes, tick_hz: scene.tick_hz };
    scene.script = script::read(&context, &mut top);
    scene.checks = script::read_checks(&context, &mut top);
    errors.extend(top.finish());
    let may_mean_a_body = |error: &SceneError| error.fault.kind == FaultKind::NoTable;
    if bodies.is_empty() && !errors.iter().any(may_mean_a_body) {
        let kinds: Vec<_> = BODIES.iter().map(|kind| kind.id).collect();
        let remedy = format!("add a table {}", listed(&kinds, '[', " or "));
        let fault = SceneFault::new("the scene has no body", remedy);
        errors.push(SceneError { span: text.len()..text.len(), fault });
    }

    if !errors.is_empty() {
        return Err(errors);
    }
    scene.bodies = complete_bodies(bodies);
    Ok(scene)
}

fn read_lanes(
    text: &str,
    bodies: &[BodyDraft],
    listed: Option<Vec<(Span<usize>, &'static Method)>>,
    impact: &'static Impact,
    top: &mut Table<'_>,
) -> Vec<LaneSpec> {
    check_impact(top, bodies);
    let is_listed = listed.is_some();
    let listed = listed.into_iter().flatten();
    let plain = |method| LaneSpec::plain(method).with_impact(impact);
    let mut lanes: Vec<_> = listed.map(|(span, method)| (span, plain(method))).collect();

    let rows = top.rows(LANE);
    if let (true, Some(row)) = (is_listed, rows.first()) {
        let what = "lanes are given twice, as `methods` and as `[[lane]]`";
        top.report_fault(row.header.clone(), what, "keep one of them");
    }
    if let Some(row) = rows.get(MAX_LANES) {
        let what = format!("the scene has {} lanes", rows.len());
        top.report_fault(row.header.clone(), what, format!("keep at most {MAX_LANES}"));
    }
    let is_given = is_listed || !rows.is_empty();
    for mut row in rows.into_iter().take(MAX_LANES) {
        let span = row.span(METHOD.key);
        check_impact(&mut row, bodies);
        lanes.extend(read_lane_spec(&mut row, impact).map(|spec| (span, spec)));
        top.add_faults_of(row);
    }

    let key = if is_listed { METHOD_LIST.key } else { METHOD.key };
    let of_all = top.has(IMPACT.key).then(|| top.span(IMPACT.key));
    let mut wanted: Vec<_> = match is_given {
        true => lanes
            .iter()
            .map(|(span, lane)| {
                let of_all = of_all.clone().filter(|_| lane.impact == impact);
                (of_all.unwrap_or_else(|| span.clone()), lane.impact)
            })
            .collect(),
        false => vec![(top.span(IMPACT.key), impact)],
    };
    wanted.dedup();
    for (span, impact) in wanted {
        let mut kinds = bodies.iter().filter_map(|body| body.kind.as_ref());
        if let Some(refusal) = kinds.find_map(|kind| kind.impact_refusal(impact)) {
            top.report_fault(span, refusal, "write another `impact`, or the `energy`");
        }
    }
    for (n, (span, lane)) in lanes.iter().enumerate() {
        check_method(key, lane.method, span.clone(), bodies, top);
        if let Some((first, _)) = lanes[..n].iter().find(|(_, earlier)| earlier == lane) {
            let (line, _) = position(text, first.start);
            let what = format!("a lane {} is on line {line} already", described(lane));
            let is_adaptive = lane.method.tolerance.is_some();
            let or = if is_adaptive { " or another `tolerance`" } else { "" };
            let remedy = format!("remove one, or give it other `substeps`{or} in a `[[lane]]`");
            top.report_fault(span.clone(), what, remedy);
        }
    }
    let lanes: Vec<_> = match is_given {
        true => lanes.into_iter().map(|(_, lane)| lane).collect(),
        false => {
            every_lane(bodies, top.own()).into_iter().map(|lane| lane.with_impact(impact)).collect()
        }
    };
    let mut refusals = lanes.iter().map(|lane| impact.refusal(lane.method));
    if top.has(IMPACT.key)
        && let Some(Some(refusal)) = refusals.next()
        && refusals.all(|refusal| refusal.is_some())
    {
        let remedy = format!("remove `{}`", IMPACT.key);
        top.report_fault(top.span(IMPACT.key), refusal, remedy);
    }
    lanes
}

/// Reports a rule for impacts in a scene where nothing has walls.
fn check_impact(table: &mut Table<'_>, bodies: &[BodyDraft]) {
    let has_walls = |body: &BodyDraft| body.kind.as_ref().is_none_or(|kind| kind.has_walls);
    if table.has(IMPACT.key) && !bodies.is_empty() && !bodies.iter().any(has_walls) {
        let what = format!("`{}` does not apply: no body of this scene meets a wall", IMPACT.key);
        table.report_fault(table.span(IMPACT.key), what, "remove it, or add a table [[ball]]");
    }
}

/// Describes a lane in the words of a message.
fn described(lane: &LaneSpec) -> String {
    let LaneSpec { method, substeps, tolerance, joint, .. } = lane;
    let within = tolerance.map(|tolerance| format!(" and `tolerance = {tolerance:e}`"));
    let told = joint.map(|joint| format!(" and `joint_hz = {}`", joint.frequency_hz));
    let bounces = lane.own_impact().map(|impact| format!(" and `impact = {impact:?}`"));
    let beside = [within, told, bounces].into_iter().flatten().collect::<String>();
    format!("{:?} with `substeps = {substeps}`{beside}", method.id)
}

/// Reports an opening method that no lane has, because that method would not race.
fn check_opening_method(Scene { lanes, opening_method, .. }: &Scene, top: &mut Table<'_>) {
    if let Some(method) = opening_method
        && !lanes.is_empty()
        && !lanes.iter().any(|lane| lane.method == *method)
    {
        let mut known: Vec<&str> = Vec::new();
        for lane in lanes {
            if !known.contains(&lane.method.id) {
                known.push(lane.method.id);
            }
        }
        let is_beside = top.has(OPENING_BESIDE_OWN.key);
        let key = if is_beside { OPENING_BESIDE_OWN.key } else { OPENING_METHOD.key };
        let id = method.id;
        let remedy = format!("write one of {}, or give it a lane", listed(&known, '"', ", "));
        let what = format!("`{key}` is {id:?}, which no lane of this scene has");
        top.report_fault(top.span(key), what, remedy);
    }
}
