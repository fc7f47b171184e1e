//! `regatta list`: the program's own tables, for people and for programs.

use std::sync::Arc;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::error::Error;
use super::output::print;
use super::output::table::{self, Column, TableFormat};
use crate::lab::pacing::{POLICIES, PolicyCard, RefreshRate, TRACES, TraceCard};
use crate::lab::{Binding, KEYS, METRICS, Metric, SCENES, Scale, Scene, SceneKey, scene_tables};
use crate::sim::BodyClass;
use crate::sim::bodies::{BODIES, Body, Coordinate, Kind, Net, Parameter, stepped_kinds};
use crate::sim::integrators::{FreeSpin, METHODS, Method, SpinMap};
use crate::sim::law::{UNITS, functions, operators, values};

const EXAMPLES: &str = "\
Examples:
  regatta list methods
  regatta list bodies                  the tables and keys of a scene file
  regatta list methods --format json   with everything on a method's card";

/// List the scenes, methods, bodies, metrics, policies, traces or keys
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ListArgs {
    /// What to list
    #[arg(value_name = "scenes|methods|bodies|metrics|policies|traces|keys")]
    what: Listing,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Listing {
    /// The built-in scenes, for `--scene`
    Scenes,
    /// The integrators, for `--method` and for scene files
    Methods,
    /// The bodies, and the keys by which a scene file describes them
    Bodies,
    /// What `trace --metrics` writes
    Metrics,
    /// The game loops, for `loop --policy`
    Policies,
    /// The frame traces, for `loop --trace`
    Traces,
    /// The keys of the window
    Keys,
}

pub(super) fn run(args: &ListArgs) -> Result<(), Error> {
    let listing = match args.what {
        Listing::Scenes => {
            let scenes: Vec<_> =
                SCENES.iter().filter_map(|scene| Scene::built_in(scene.name)).collect();
            write(SCENE, &scenes, args.format)
        }
        Listing::Methods => write(METHOD, METHODS, args.format),
        Listing::Bodies if args.format == TableFormat::Text => bodies_with_keys(),
        Listing::Bodies => write(BODY, &BODIES, args.format),
        Listing::Metrics => write(METRIC, METRICS, args.format),
        Listing::Policies => write(POLICY, POLICIES, args.format),
        Listing::Traces => write(TRACE, TRACES, args.format),
        Listing::Keys => write(KEY, KEYS, args.format),
    };
    Ok(print(&listing)?)
}

fn write<T>(columns: &[Column<T>], items: &[T], format: TableFormat) -> String {
    match format {
        TableFormat::Text => table::text(columns, items, ""),
        TableFormat::Json => format!("{:#}\n", table::json(columns, items)),
    }
}

/// What expressions of laws are made of.
fn expressions() -> String {
    let values: Vec<&str> = values().collect();
    let (first, others) = UNITS.split_first().expect("there are units");
    let (values, others) = (values.join(", "), others.join(", "));
    let operators = operators().collect::<Vec<_>>().join(" ");
    let mut rows: Vec<String> = Vec::new();
    for function in functions() {
        match rows.last_mut() {
            Some(row) if row.len() + function.len() <= FUNCTIONS_WIDTH => {
                *row = format!("{row}  {function}");
            }
            _ => rows.push(function),
        }
    }
    let functions = rows.join("\n             ");
    format!(
        "
expressions
  Of coordinates, velocities (of x: vx), constants, {values}
  Units: {first}, or {others}
  Operators: {operators}
  Functions: {functions}
"
    )
}

/// Characters of a row of functions: with the margin it fits a line of a terminal.
const FUNCTIONS_WIDTH: usize = 80;

fn bodies_with_keys() -> String {
    let keys = BODIES.iter().map(|body| {
        let keys = table::text(PARAMETER, &body.parameters, "  ");
        let refused = refused_by_engines(body.class);
        format!("\n[[{}]]\n{keys}{}", body.id, refused.unwrap_or_default())
    });
    let tables = scene_tables().into_iter();
    let tables =
        tables.map(|(name, keys)| format!("\n{name}\n{}", table::text(SCENE_KEY, &keys, "  ")));
    let (keys, tables) = (keys.collect::<String>(), tables.collect::<String>());
    let of_nets = refused_by_engines(Net::CLASS).unwrap_or_default();
    table::text(BODY, &BODIES, "") + &keys + &tables + &expressions() + "\nnets\n" + &of_nets
}

/// Two lines that say why engines do not step bodies of this class, and which methods of the family do.
fn refused_by_engines(class: BodyClass) -> Option<String> {
    let why = class.engine_refusal()?;
    let steps = |method: &&Method| method.only.is_some_and(|only| only.refusal(class).is_none());
    let engines = METHODS.iter().filter(|method| method.is_engine());
    let others: Vec<&str> = engines.filter(steps).map(|method| method.id).collect();
    let except = match &others[..] {
        [] => String::new(),
        others => format!(" except {}", others.join(", ")),
    };
    Some(format!("  No method of an engine{except}:\n    {why}.\n"))
}

const SCENE: &[Column<Scene>] = &[
    Column { key: "name", heading: Some("NAME"), value: |scene| json!(scene.name) },
    Column { key: "tick_hz", heading: Some("HZ"), value: |scene| json!(scene.tick_hz) },
    Column { key: "seconds", heading: Some("SECONDS"), value: |scene| json!(scene.seconds) },
    Column {
        key: "bodies",
        heading: Some("BODIES"),
        value: |scene| scene.bodies.iter().map(|body| json!(body.kind.id)).collect(),
    },
    Column {
        key: "methods",
        heading: None,
        value: |scene| scene.lanes.iter().map(|lane| json!(lane.method.id)).collect(),
    },
    Column { key: "title", heading: Some("TITLE"), value: |scene| json!(scene.title) },
    Column { key: "about", heading: None, value: |scene| json!(scene.about) },
];

fn free_spin(method: &Method) -> Option<FreeSpin> {
    method.engine.and_then(|engine| engine.free_spin)
}

const METHOD: &[Column<Method>] = &[
    Column { key: "id", heading: Some("ID"), value: |method| json!(method.id) },
    Column { key: "name", heading: None, value: |method| json!(method.name) },
    Column {
        key: "also",
        heading: Some("ALSO"),
        value: |method| match method.also {
            [] => Value::Null,
            also => json!(also.join(", ")),
        },
    },
    Column { key: "family", heading: Some("FAMILY"), value: |method| json!(method.family.id()) },
    Column { key: "order", heading: Some("ORDER"), value: |method| json!(method.order) },
    Column {
        key: "order_with_drag",
        heading: Some("WITH DRAG"),
        value: |method| json!(method.order_with_drag),
    },
    Column { key: "evaluations", heading: Some("EVALS"), value: |m| json!(m.evaluations) },
    Column { key: "exact_if_linear", heading: None, value: |m| json!(m.exact_if_linear) },
    Column { key: "symplectic", heading: Some("SYMPLECTIC"), value: |m| json!(m.symplectic) },
    Column { key: "reversible", heading: Some("REVERSIBLE"), value: |m| json!(m.reversible) },
    Column {
        key: "stability_limit",
        heading: Some("STABLE TO h ω"),
        value: |method| json!(method.stability_limit),
    },
    Column {
        key: "tolerance",
        heading: None,
        value: |method| {
            method.tolerance.map_or(Value::Null, |tolerance| {
                json!({
                    "absolute_q": tolerance.absolute_q,
                    "absolute_v": tolerance.absolute_v,
                    "relative": tolerance.relative,
                })
            })
        },
    },
    Column { key: "restart", heading: None, value: |method| json!(method.restart) },
    Column { key: "keeps_time", heading: None, value: |method| json!(method.keeps_time) },
    Column { key: "as_printed", heading: Some("AS PRINTED"), value: |m| json!(m.is_as_printed()) },
    Column { key: "only", heading: Some("ONLY FOR"), value: |method| json!(stepped_kinds(method)) },
    Column {
        key: "only_because",
        heading: None,
        value: |method| json!(method.only.map(|only| only.reason)),
    },
    Column { key: "default_substeps", heading: None, value: |m| json!(m.default_substeps) },
    Column {
        key: "engine_tick_hz",
        heading: None,
        value: |method| json!(method.engine.map(|engine| engine.tick_hz)),
    },
    Column {
        key: "engine_version",
        heading: None,
        value: |method| json!(method.engine.map(|e| e.version).filter(|v| !v.is_empty())),
    },
    Column {
        key: "engine_logged",
        heading: None,
        value: |method| json!(method.engine.and_then(|engine| engine.logged)),
    },
    Column {
        key: "engine_damping_ratio_at_1_hz",
        heading: None,
        value: |method| json!(method.engine.and_then(|engine| engine.damping_ratio)),
    },
    Column {
        key: "engine_free_spin",
        heading: None,
        value: |method| json!(free_spin(method).map(|spin| spin.default.id())),
    },
    Column {
        key: "engine_free_spin_opt_in",
        heading: None,
        value: |method| json!(free_spin(method).and_then(|spin| spin.opt_in).map(SpinMap::id)),
    },
    Column { key: "about", heading: Some("ABOUT"), value: |method| json!(method.about) },
    Column { key: "source", heading: None, value: |method| json!(method.source) },
];

const BODY: &[Column<Arc<Kind>>] = &[
    Column { key: "id", heading: Some("ID"), value: |body| json!(body.id) },
    Column { key: "about", heading: Some("EQUATION"), value: |body| json!(body.about) },
    Column {
        key: "coordinates",
        heading: None,
        value: |body| {
            let coordinates = body.coordinates(&body.plain_values());
            table::json(COORDINATE, &coordinates.iter().collect::<Vec<_>>())
        },
    },
    Column { key: "truth", heading: Some("TRUTH"), value: |body| json!(body.truth.id()) },
    Column {
        key: "aimed_accuracy",
        heading: None,
        value: |body| json!(body.truth.aimed_accuracy()),
    },
    Column {
        key: "engine_refusal",
        heading: None,
        value: |body| json!(body.class.engine_refusal()),
    },
    Column { key: "inputs", heading: Some("INPUTS"), value: |body| json!(body.inputs) },
    Column {
        key: "parameters",
        heading: None,
        value: |body| table::json(PARAMETER, &body.parameters),
    },
];

const COORDINATE: &[Column<Coordinate>] = &[
    Column { key: "name", heading: None, value: |coordinate| json!(&*coordinate.name) },
    Column { key: "velocity", heading: None, value: |coordinate| json!(&*coordinate.velocity) },
    Column { key: "unit", heading: None, value: |coordinate| json!(coordinate.unit) },
];

const PARAMETER: &[Column<Parameter>] = &[
    Column { key: "key", heading: Some("KEY"), value: |parameter| json!(parameter.key) },
    Column { key: "unit", heading: None, value: |parameter| json!(parameter.unit) },
    Column { key: "default", heading: Some("DEFAULT"), value: |p| json!(p.default) },
    Column { key: "range", heading: Some("RANGE"), value: |p| json!(p.range.to_string()) },
    Column { key: "acts", heading: None, value: |parameter| json!(parameter.acts.id()) },
    Column { key: "about", heading: Some("ABOUT"), value: |p| json!(p.described()) },
];

const SCENE_KEY: &[Column<SceneKey>] = &[
    Column { key: "key", heading: Some("KEY"), value: |key| json!(key.key) },
    Column { key: "required", heading: None, value: |key| json!(key.is_required) },
    Column { key: "value", heading: None, value: |key| json!(key.value) },
    Column { key: "about", heading: Some("ABOUT"), value: |key| json!(key.about) },
];

const METRIC: &[Column<Metric>] = &[
    Column { key: "id", heading: Some("ID"), value: |metric| json!(metric.id) },
    Column { key: "name", heading: Some("NAME"), value: |metric| json!(metric.name) },
    Column { key: "unit", heading: Some("UNIT"), value: |metric| json!(metric.unit.to_string()) },
    Column {
        key: "scale",
        heading: Some("SCALE"),
        value: |metric| match metric.scale {
            Scale::Log => json!("log"),
            Scale::Linear => json!("linear"),
        },
    },
    Column { key: "about", heading: Some("ABOUT"), value: |metric| json!(metric.about) },
];

const POLICY: &[Column<PolicyCard>] = &[
    Column { key: "id", heading: Some("ID"), value: |policy| json!(policy.id) },
    Column { key: "name", heading: None, value: |policy| json!(policy.name) },
    Column { key: "formula", heading: Some("RULE"), value: |policy| json!(policy.formula) },
    Column { key: "constants", heading: None, value: |policy| json!(policy.constants) },
    Column { key: "odd_frames", heading: None, value: |policy| json!(policy.odd_frames) },
    Column { key: "drawing", heading: Some("DRAWING"), value: |p| json!(p.drawing.name()) },
    Column { key: "has_fixed_tick", heading: Some("FIXED"), value: |p| json!(p.has_fixed_tick) },
    Column { key: "users", heading: None, value: |policy| json!(policy.users) },
    Column { key: "source", heading: None, value: |policy| json!(policy.source) },
    Column {
        key: "languages",
        heading: None,
        value: |policy| policy.snippets.iter().map(|snippet| snippet.language).collect(),
    },
];

const TRACE: &[Column<TraceCard>] = &[
    Column { key: "id", heading: Some("ID"), value: |trace| json!(trace.id) },
    Column {
        key: "display_hz",
        heading: Some("DISPLAY"),
        value: |trace| json!(trace.refresh.map(RefreshRate::hz)),
    },
    Column { key: "about", heading: Some("ABOUT"), value: |trace| json!(trace.about) },
];

const KEY: &[Column<Binding>] = &[
    Column { key: "keys", heading: Some("KEYS"), value: |binding| json!(binding.shown) },
    Column { key: "does", heading: Some("DOES"), value: |binding| json!(binding.about) },
    Column { key: "repeats", heading: None, value: |binding| json!(binding.repeats) },
];
