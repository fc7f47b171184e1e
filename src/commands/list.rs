//! `regatta list`: prints the program's own tables, for people and for programs.

use std::sync::Arc;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::error::Error;
use super::help::flowing;
use super::output::table::{self, Column, TableFormat};
use crate::loops::{ENGINES, POLICIES, PolicyCard, RefreshRate, TRACES, TraceCard};
use crate::run::{METRICS, Metric, Scale};
use crate::scene::{BuiltIn, SCENES, Scene, SceneKey, scene_tables};
use crate::sim::bodies::{BODIES, Body, Coordinate, Kind, Net, Parameter, stepped_kinds};
use crate::sim::integrators::{FreeSpin, METHODS, Method, SpinMap};
use crate::sim::law::{UNITS, functions, operators, values};
use crate::sim::{BodyClass, IMPACTS, Impact};
use crate::studio::{Binding, KEYS};
use crate::tools::source_code::Language;

const EXAMPLES: &str = "\
Examples:
  regatta list methods
  regatta list bodies                  the tables and keys of a scene file
  regatta list methods --format json   with everything on a method's card";

const WHAT: &str = "scenes|methods|impacts|bodies|metrics|policies|engine-loops|traces|keys";

/// List scenes, methods, bodies, metrics, policies, traces or keys
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
#[command(override_usage = "regatta list [OPTIONS] <WHAT>")]
pub(super) struct ListArgs {
    /// What to list
    #[arg(value_name = WHAT)]
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
    /// The rules for impacts of a ball, for `--impact` and for scene files
    Impacts,
    /// The bodies, and their keys in a scene file
    Bodies,
    /// The metrics that `trace --metrics` writes
    Metrics,
    /// The game loops, for `loop --policy`
    Policies,
    /// The loops of engines and libraries, for `loop --policy` and `loop --engine`
    EngineLoops,
    /// The frame traces, for `loop --trace`
    Traces,
    /// The keys of the window
    Keys,
}

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    WHAT.split('|')
}

/// Returns the keys of the window as text.
pub(super) fn keys() -> String {
    write(KEY, KEYS, TableFormat::Text)
}

pub(super) fn run(args: &ListArgs) -> Result<(), Error> {
    let listing = match args.what {
        Listing::Scenes => scenes(args.format),
        Listing::Methods => write(METHOD, METHODS, args.format),
        Listing::Impacts => write(IMPACT, IMPACTS, args.format),
        Listing::Bodies if args.format == TableFormat::Text => bodies_with_keys(),
        Listing::Bodies => write(BODY, &BODIES, args.format),
        Listing::Metrics => write(METRIC, METRICS, args.format),
        Listing::Policies => write(POLICY, &POLICIES, args.format),
        Listing::EngineLoops => write(ENGINE, &ENGINES, args.format),
        Listing::Traces => write(TRACE, TRACES, args.format),
        Listing::Keys => write(KEY, KEYS, args.format),
    };
    args.format.print(&listing)
}

fn write<T>(columns: &[Column<T>], items: &[T], format: TableFormat) -> String {
    match format {
        TableFormat::Text => table::text(columns, items, ""),
        TableFormat::Json => format!("{:#}\n", table::json(columns, items)),
    }
}

/// Returns the built-in scenes. As text, each group has a heading.
fn scenes(format: TableFormat) -> String {
    let read = |built_in: &'static BuiltIn| Some((built_in, Scene::built_in(built_in.name)?));
    let scenes: Vec<(&BuiltIn, Scene)> = SCENES.iter().filter_map(read).collect();
    let text = write(SCENE, &scenes, format);
    if format == TableFormat::Json {
        return text;
    }
    let (head, rows) = text.split_once('\n').expect("a line of headings");
    let mut grouped = format!("{head}\n");
    for rows in scenes
        .iter()
        .zip(rows.lines())
        .collect::<Vec<_>>()
        .chunk_by(|one, other| one.0.0.group == other.0.0.group)
    {
        grouped += &format!("\n{}\n", rows[0].0.0.group.title());
        grouped.extend(rows.iter().map(|(_, row)| format!("{row}\n")));
    }
    grouped
}

/// Returns the help on the expressions of laws.
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

/// Width of a row of functions, in characters. With the margin, the row fits into a line of a terminal.
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
    table::text(BODY, BODIES.iter(), "") + &keys + &tables + &expressions() + "\nnets\n" + &of_nets
}

/// Explains in two lines why engines do not step bodies of this class, and which engine methods do.
fn refused_by_engines(class: BodyClass) -> Option<String> {
    let why = class.engine_refusal()?;
    let steps = |method: &&Method| method.incompatibility(class).is_none();
    let engines = METHODS.iter().filter(|method| method.is_engine());
    let others: Vec<&str> = engines.filter(steps).map(|method| method.id).collect();
    let except = match &others[..] {
        [] => String::new(),
        others => format!(" except {}", others.join(", ")),
    };
    Some(format!("  No method of an engine{except}:\n    {why}.\n"))
}

const SCENE: &[Column<(&BuiltIn, Scene)>] = &[
    Column::shown("name", "NAME", |(_, scene)| json!(scene.name)),
    Column::new("group", |(built_in, _)| json!(built_in.group.title())),
    Column::shown("tick_hz", "HZ", |(_, scene)| json!(scene.tick_hz)),
    Column::shown("seconds", "SECONDS", |(_, scene)| json!(scene.seconds)),
    Column::shown("bodies", "BODIES", |(_, scene)| {
        scene.bodies.iter().map(|body| json!(body.kind.id)).collect()
    }),
    Column::new("methods", |(_, scene)| {
        scene.lanes.iter().map(|lane| json!(lane.method.id)).collect()
    }),
    Column::shown("title", "TITLE", |(_, scene)| json!(scene.title)),
    Column::new("about", |(_, scene)| json!(scene.about)),
];

fn free_spin(method: &Method) -> Option<FreeSpin> {
    method.engine.and_then(|engine| engine.free_spin)
}

const METHOD: &[Column<Method>] = &[
    Column::shown("id", "ID", |method| json!(method.id)),
    Column::new("name", |method| json!(method.name)),
    Column::shown("also", "ALSO", |method| match method.also {
        [] => Value::Null,
        also => json!(also.join(", ")),
    }),
    Column::shown("family", "FAMILY", |method| json!(method.family.id())),
    Column::shown("order", "ORDER", |method| json!(method.order)),
    Column::shown("order_with_drag", "WITH DRAG", |method| json!(method.order_with_drag)),
    Column::shown("evaluations", "EVALS", |m| json!(m.evaluations)),
    Column::new("exact_if_linear", |m| json!(m.exact_if_linear)),
    Column::shown("symplectic", "SYMPLECTIC", |m| json!(m.symplectic)),
    Column::shown("reversible", "REVERSIBLE", |m| json!(m.reversible)),
    Column::shown("stability_limit", "STABLE TO h ω", |method| json!(method.stability_limit)),
    Column::new("tolerance", |method| {
        method.tolerance.map_or(Value::Null, |tolerance| {
            json!({
                "absolute_q": tolerance.absolute_q,
                "absolute_v": tolerance.absolute_v,
                "relative": tolerance.relative,
            })
        })
    }),
    Column::new("restart", |method| json!(method.restart)),
    Column::new("keeps_time", |method| json!(method.keeps_time)),
    Column::new("as_printed", |method| json!(method.is_as_printed())),
    Column::shown("only", "ONLY FOR", |method| json!(stepped_kinds(method))),
    Column::new("only_because", |method| json!(method.only.map(|only| only.reason))),
    Column::new("default_substeps", |m| json!(m.default_substeps)),
    Column::new("engine_tick_hz", |method| json!(method.engine.map(|engine| engine.tick_hz))),
    Column::new("engine_version", |method| {
        json!(method.engine.map(|e| e.version).filter(|v| !v.is_empty()))
    }),
    Column::new("engine_logged", |method| json!(method.engine.and_then(|engine| engine.logged))),
    Column::new("engine_damping_ratio_at_1_hz", |method| {
        json!(method.engine.and_then(|engine| engine.damping_ratio))
    }),
    Column::new("engine_free_spin", |method| {
        json!(free_spin(method).map(|spin| spin.default.id()))
    }),
    Column::new("engine_free_spin_opt_in", |method| {
        json!(free_spin(method).and_then(|spin| spin.opt_in).map(SpinMap::id))
    }),
    Column::shown("about", "ABOUT", |method| json!(method.about)),
    Column::new("caveat", |method| json!(method.caveat)),
    Column::new("source", |method| json!(method.source)),
];

const IMPACT: &[Column<Impact>] = &[
    Column::shown("id", "ID", |impact| json!(impact.id)),
    Column::shown("kappa", "KAPPA", |impact| json!(impact.kappa)),
    Column::shown("about", "ABOUT", |impact| json!(impact.about)),
];

const BODY: &[Column<Arc<Kind>>] = &[
    Column::shown("id", "ID", |body| json!(body.id)),
    Column::shown("about", "EQUATION", |body| json!(body.about)),
    Column::new("coordinates", |body| {
        let coordinates = body.coordinates(&body.plain_values());
        table::json(COORDINATE, &coordinates.iter().collect::<Vec<_>>())
    }),
    Column::shown("truth", "TRUTH", |body| json!(body.truth.id())),
    Column::new("aimed_accuracy", |body| json!(body.truth.aimed_accuracy())),
    Column::new("engine_refusal", |body| json!(body.class.engine_refusal())),
    Column::shown("inputs", "INPUTS", |body| json!(body.inputs)),
    Column::new("parameters", |body| table::json(PARAMETER, &body.parameters)),
];

const COORDINATE: &[Column<Coordinate>] = &[
    Column::new("name", |coordinate| json!(&*coordinate.name)),
    Column::new("velocity", |coordinate| json!(&*coordinate.velocity)),
    Column::new("unit", |coordinate| json!(coordinate.unit)),
];

const PARAMETER: &[Column<Parameter>] = &[
    Column::shown("key", "KEY", |parameter| json!(parameter.key)),
    Column::new("unit", |parameter| json!(parameter.unit)),
    Column::shown("default", "DEFAULT", |p| json!(p.default)),
    Column::shown("range", "RANGE", |p| json!(p.range.to_string())),
    Column::new("acts", |parameter| json!(parameter.acts.id())),
    Column::shown("about", "ABOUT", |p| json!(p.described())),
];

const SCENE_KEY: &[Column<SceneKey>] = &[
    Column::shown("key", "KEY", |key| json!(key.key)),
    Column::new("required", |key| json!(key.is_required)),
    Column::new("value", |key| json!(key.value)),
    Column::shown("about", "ABOUT", |key| json!(key.about)),
];

const METRIC: &[Column<Metric>] = &[
    Column::shown("id", "ID", |metric| json!(metric.id)),
    Column::shown("name", "NAME", |metric| json!(metric.name)),
    Column::shown("unit", "UNIT", |metric| json!(metric.unit.to_string())),
    Column::shown("scale", "SCALE", |metric| match metric.scale {
        Scale::Log => json!("log"),
        Scale::Linear => json!("linear"),
    }),
    Column::shown("about", "ABOUT", |metric| json!(metric.about)),
];

const POLICY: &[Column<Arc<PolicyCard>>] = &[
    Column::shown("id", "ID", |policy| json!(policy.id)),
    Column::new("name", |policy| json!(policy.name)),
    Column::shown("formula", "RULE", |policy| json!(policy.formula)),
    Column::new("constants", |policy| json!(policy.constants)),
    Column::new("odd_frames", |policy| json!(policy.odd_frames)),
    Column::shown("drawing", "DRAWING", |p| json!(p.drawing_name())),
    Column::shown("has_fixed_tick", "FIXED", |p| json!(p.has_fixed_tick)),
    Column::new("usual", |policy| json!(policy.is_usual)),
    Column::new("users", |policy| json!(policy.users)),
    Column::new("source", |policy| json!(policy.source)),
    Column::new("languages", |_| json!(Language::ALL.map(Language::id))),
];

const ENGINE: &[Column<Arc<PolicyCard>>] = &[
    Column::shown("id", "ID", |card| json!(card.id)),
    Column::shown("name", "NAME", |card| json!(card.name)),
    Column::shown("version", "VERSION", |card| {
        json!(card.engine.as_ref().map(|engine| &engine.version))
    }),
    Column::shown("gives", "GIVES", |card| json!(card.formula)),
    Column::shown("known", "KNOWN", |card| json!(card.source)),
    Column::new("settings", |card| json!(card.constants)),
    Column::new("caveat", |card| json!(card.engine.as_ref().map(|engine| &engine.caveat))),
    Column::new("set", |card| json!(card.engine.as_ref().map(|engine| &engine.advice))),
];

const TRACE: &[Column<TraceCard>] = &[
    Column::shown("id", "ID", |trace| json!(trace.id)),
    Column::shown("display_hz", "DISPLAY", |trace| json!(trace.refresh.map(RefreshRate::hz))),
    Column::shown("about", "ABOUT", |trace| json!(trace.about)),
];

const KEY: &[Column<Binding>] = &[
    Column::shown("keys", "KEYS", |binding| json!(binding.shown)),
    Column::shown("does", "DOES", |binding| json!(binding.about)),
    Column::new("repeats", |binding| json!(binding.repeats)),
];
