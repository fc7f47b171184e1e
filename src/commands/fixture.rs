//! `regatta fixture`: prints the states of a scene's truth in the form of a test for an engine.

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::error::Error;
use super::experiment_args::{ExperimentArgs, TickArgs};
use super::help::flowing;
use super::output::{print, print_json};
use super::terminal::print_status;
use super::trace::{LOST, TruthAccuracy};
use crate::run::race::Mode;
use crate::scene::Scene;
use crate::studio::Studio;

const ABOUT: &str = "\
The table has ticks with coordinates and velocities, in metres or radians and per second, to the last
digit. In pytest, gtest and rust it comes with a function `expect(step)`, which compares your engine's step
with it, and a test that fails until you fill that step in. The states of a body without a closed form are
those of the reference; its error on this run is the least tolerance. The top of the file has the scene's
script and every parameter.

Examples:
  regatta fixture --scene spring --as pytest > test_spring.py
  regatta fixture --k 900 --mass 12 --as gtest --float > spring_test.cc
  regatta fixture --scene pendulum --every 10 --as json";

/// Write exact states as a test for your own engine
///
/// To standard output.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct FixtureArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    #[command(flatten)]
    ticks: TickArgs,

    /// What to write: pytest, gtest, rust or json
    #[arg(long = "as", alias = "format", value_name = "FORMAT", hide_possible_values = true)]
    format: Format,

    /// Use single precision, as Unity and Godot do
    #[arg(long)]
    float: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Pytest,
    Gtest,
    Rust,
    Json,
}

/// The syntax of a test in one language.
struct Language {
    /// Text of the file. It has a placeholder of the form `@NAME@` for each text that is inserted.
    template: &'static str,
    comment: &'static str,
    /// Names of the types for double and single precision, each with the suffix of its literals.
    reals: [(&'static str, &'static str); 2],
    /// Text before and after the states of a body. `@` is replaced by the body's quoted name, and `%` by its largest
    /// coordinate and velocity.
    body: [&'static str; 2],
    /// Text before and after a state, and text before and after a list.
    state: [&'static str; 2],
    list: [&'static str; 2],
}

impl Format {
    fn language(self) -> Option<Language> {
        Some(match self {
            Self::Pytest => Language {
                template: include_str!("../../assets/fixtures/pytest.py"),
                comment: "#",
                reals: [("float", ""); 2],
                body: ["    @: ([%], [\n", "    ]),\n"],
                state: ["        (", "),\n"],
                list: ["[", "]"],
            },
            Self::Gtest => Language {
                template: include_str!("../../assets/fixtures/gtest.cc"),
                comment: "//",
                reals: [("double", ""), ("float", "f")],
                body: ["    {@, %, {\n", "    }},\n"],
                state: ["        {", "},\n"],
                list: ["{", "}"],
            },
            Self::Rust => Language {
                template: include_str!("../../assets/fixtures/rust.rs"),
                comment: "//",
                reals: [("f64", ""), ("f32", "")],
                body: ["    (@, [%], &[\n", "    ]),\n"],
                state: ["        (", "),\n"],
                list: ["&[", "]"],
            },
            Self::Json => return None,
        })
    }
}

/// Relative rounding error of a state in double and in single precision. It leaves room for the order in which an
/// engine adds.
const ROUNDING: [f64; 2] = [1e-12, 1e-6];

/// States of a body's truth at the ticks that are written.
#[derive(Default)]
struct States {
    rows: Vec<(u64, Vec<f64>, Vec<f64>)>,
    reached: TruthAccuracy,
    /// The tick from which the truth is not known.
    lost_at: Option<u64>,
}

pub(super) fn run(args: &FixtureArgs) -> Result<(), Error> {
    let experiment = args.experiment.load(Mode::Solo)?;
    let seconds = args.ticks.seconds.unwrap_or(experiment.scene.seconds);
    let mut studio = experiment.studio();
    let scene = Scene { seconds, ..studio.scene().clone() };
    let last = studio.race().nearest_tick(seconds);
    let mut states: Vec<States> = scene.bodies.iter().map(|_| States::default()).collect();
    note(&mut states, &studio, args);
    while studio.race().tick() < last {
        studio.tick();
        note(&mut states, &studio, args);
    }
    let mut least = ROUNDING[usize::from(args.float)];
    let truths = studio.race().truth().bodies();
    for ((states, body), truth) in states.iter().zip(&scene.bodies).zip(truths) {
        let (name, error) = (&body.name, states.reached.relative());
        match truth.halted() {
            Some(halt) if halt.tick == 0 => {
                return Err(Error::failed(format!("no states of {name}: it {}", halt.failure)));
            }
            Some(halt) => print_status(&format!(
                "the states of {name} end at tick {}: it {}",
                halt.tick, halt.failure
            )),
            None if let Some(tick) = states.lost_at => print_status(&format!(
                "the states of {name} end at tick {tick}: no more is known of them than {LOST:e} of the largest"
            )),
            None if error.is_finite() => {}
            None => {
                return Err(Error::failed(format!(
                    "the error of the reference of {name} is not known"
                )));
            }
        }
        least = least.max(error);
    }
    if states.iter().all(|states| states.rows.len() < 2) {
        return Err(Error::mistake(
            "no state after the start is written; lower --every, or give more --seconds",
        ));
    }
    match args.format.language() {
        Some(language) => print(test_source(&language, args, &scene, &states, &studio, least)),
        None => print_json(format!("{}\n", in_json(args, &scene, &states, &studio, least))),
    }
}

/// Records the present state of every body that has not halted.
fn note(states: &mut [States], studio: &Studio, args: &FixtureArgs) {
    let tick = studio.race().tick();
    for (states, body) in states.iter_mut().zip(studio.race().truth().bodies()) {
        if body.halted().is_some() || states.lost_at.is_some() {
            continue;
        }
        let before = states.reached;
        states.reached.note(body);
        if states.reached.is_lost() {
            (states.reached, states.lost_at) = (before, Some(tick));
            continue;
        }
        if tick.is_multiple_of(args.ticks.every) {
            states.rows.push((tick, body.stepper.q().to_vec(), body.stepper.v().to_vec()));
        }
    }
}

/// Formats a number with all its digits.
fn digits(value: f64, is_float: bool) -> String {
    if is_float { format!("{:?}", value as f32) } else { format!("{value:?}") }
}

/// Returns the lines at the top of the file, which state where its numbers come from.
fn about(scene: &Scene, studio: &Studio) -> Vec<String> {
    let mut text =
        format!("{}: exact states for a test of an engine, by regatta fixture.\n", scene.title);
    for (body, truth) in scene.bodies.iter().zip(studio.race().truth().bodies()) {
        let coordinates = truth.coordinates();
        let names = coordinates.iter().map(|one| format!("{} in {}", one.name, one.unit));
        let names: Vec<String> = names.collect();
        let (name, about, kind) = (&body.name, &body.kind.about, truth.truth().id());
        text += &format!("{name} ({kind}): {about}; q is {}\n", names.join(", "));
    }
    let unchecked = Scene { checks: Vec::new(), ..scene.clone() };
    text += &format!("\n{}", unchecked.to_toml());
    text.lines().map(str::to_owned).collect()
}

/// Quotes a name in a syntax that all the languages share.
fn quoted(name: &str) -> String {
    let escaped = name.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{}\"", escaped.replace(char::is_control, " "))
}

fn test_source(
    language: &Language,
    args: &FixtureArgs,
    scene: &Scene,
    states: &[States],
    studio: &Studio,
    least: f64,
) -> String {
    let (real, suffix) = language.reals[usize::from(args.float)];
    let list = |values: &[f64]| {
        let values = values.iter().map(|value| digits(*value, args.float) + suffix);
        language.list[0].to_owned() + &values.collect::<Vec<_>>().join(", ") + language.list[1]
    };
    let mut table = String::new();
    for (body, states) in scene.bodies.iter().zip(states) {
        let [q, v] = states.reached.largest;
        let begun = language.body[0].replace('%', &format!("{q:?}, {v:?}"));
        table += &begun.replace('@', &quoted(&body.name));
        for (tick, q, v) in &states.rows {
            let [before, after] = language.state;
            table += &format!("{before}{tick}, {}, {}{after}", list(q), list(v));
        }
        table += language.body[1];
    }
    let comment = |line: String| format!("{} {line}", language.comment).trim_end().to_owned();
    let about: Vec<String> = about(scene, studio).into_iter().map(comment).collect();
    language
        .template
        .replace("@ABOUT@", &about.join("\n"))
        .replace("@HZ@", &json!(scene.tick_hz).to_string())
        .replace("@HZ_REAL@", &format!("{:?}", scene.tick_hz.hz()))
        .replace("@LEAST@", &format!("{least:e}"))
        .replace("@REAL@", real)
        .replace("@STATES@", &table)
}

fn in_json(
    args: &FixtureArgs,
    scene: &Scene,
    states: &[States],
    studio: &Studio,
    least: f64,
) -> Value {
    let list = |values: &[f64]| -> Vec<Value> {
        let shortest = |value: &f64| digits(*value, args.float).parse::<f64>().expect("a number");
        values.iter().map(|value| json!(shortest(value))).collect()
    };
    let truths = studio.race().truth().bodies();
    let bodies = scene.bodies.iter().zip(states).zip(truths).map(|((body, states), truth)| {
        let names: Vec<String> =
            truth.coordinates().iter().map(|one| one.name.to_string()).collect();
        let rows = states.rows.iter().map(|(tick, q, v)| json!([tick, list(q), list(v)]));
        json!({
            "name": body.name,
            "equation": body.kind.about,
            "truth": truth.truth().id(),
            "coordinates": names,
            "largest": states.reached.largest,
            "states": rows.collect::<Vec<_>>(),
        })
    });
    json!({
        "scene": scene.to_toml(),
        "tick_hz": scene.tick_hz,
        "least_tolerance": least,
        "bodies": bodies.collect::<Vec<_>>(),
    })
}
