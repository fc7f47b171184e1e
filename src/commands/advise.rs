//! `regatta advise`: which method and tick rate to take for a scene, and why.

use std::io::{self, Write};
use std::time::Duration;

use clap::Args;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::experiment::{ExperimentArgs, Lineup};
use super::table::{self, Column};
use super::{Error, TableFormat, stopwatch};
use crate::lab::number::significant;
use crate::lab::{
    Advised, Adviser, Good, Judge, LaneSpec, Scene, Stability, TOLERANCE, cheapest, duration,
};
use crate::sim::integrators::METHODS;

const ABOUT: &str = "\
Each method is judged on the scene from its start, without its script, against the exact solution.

VERDICT is at the scene's tick rate, or at --tick-hz. STABLE FROM is the slowest whole rate at which no
deviation grows, ACCURATE FROM the slowest at which no coordinate or velocity errs by more than 1 % of
its amplitude over the scene, or over its first minute. Rates of 1 to 10000 Hz are searched: from below
up a ladder of two an octave until three rungs in a row hold, then by halving the gap below. Costs are
at the slowest rate that is both, for all bodies: evaluations of the acceleration, and nanoseconds as
measured here and now. Of several bodies the worst one rules.

Examples:
  regatta advise --scene harbour
  regatta advise --scene my.toml --tick-hz 50 --format json
  regatta advise --scene spring --method rk4 --method semi-implicit-euler";

/// Say which method and tick rate to take for a scene
#[derive(Debug, Args)]
#[command(after_help = ABOUT)]
pub(super) struct AdviseArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// How to write it: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// A method judged, and its measured cost.
struct Row {
    advised: Advised,
    ns_per_s: Option<f64>,
}

pub(super) fn run(args: &AdviseArgs) -> Result<(), Error> {
    let experiment = args.experiment.load(Lineup::Everyone)?;
    let scene = &experiment.scene;
    let specs: Vec<LaneSpec> = if args.experiment.names_no_method() {
        METHODS.iter().map(LaneSpec::plain).collect()
    } else {
        args.experiment.lanes_named(scene)
    };
    let advised: Vec<Advised> =
        specs.par_iter().flat_map_iter(|&spec| judge(scene, spec)).collect();
    let horizon_s = Judge::new(scene, 1.0).horizon_s();
    let rows: Vec<Row> = advised.iter().map(|advised| row(scene, advised, horizon_s)).collect();
    let best = cheapest(&advised, |advised, _| {
        let row = rows.iter().find(|row| row.advised.spec == advised.spec);
        row.and_then(|row| row.ns_per_s).unwrap_or(f64::INFINITY)
    });
    let best = best.map(|i| &rows[i]);
    let advice = advice(scene, best, horizon_s);
    let text = match args.format {
        TableFormat::Text => format!("{}\n{advice}\n", table::text(COLUMNS, &rows, "")),
        TableFormat::Json => {
            let object = json!({
                "scene": scene.name,
                "tick_hz": scene.tick_hz,
                "horizon_s": horizon_s,
                "tolerance": TOLERANCE,
                "methods": table::json(COLUMNS, &rows),
                "take": best.map(|row| row.advised.spec.method.id),
                "advice": advice,
            });
            format!("{object:#}\n")
        }
    };
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    Ok(())
}

/// What is to be said of one method. Methods are judged beside each other, and timed one by one later.
fn judge(scene: &Scene, spec: LaneSpec) -> Vec<Advised> {
    let mut adviser = Adviser::new(scene, 1.0, scene.tick_hz, vec![spec]);
    while adviser.advance() {}
    adviser.advised().to_vec()
}

/// One line for a design note.
fn advice(scene: &Scene, best: Option<&Row>, horizon_s: f64) -> String {
    let whom = match &scene.bodies[..] {
        [_] => "this body".to_owned(),
        bodies => format!("these {} bodies", bodies.len()),
    };
    let bounds =
        format!("within {} % of the amplitude over {}", 100.0 * TOLERANCE, duration(horizon_s));
    let Some((row, good)) = best.and_then(|row| Some((row, row.advised.good.as_ref()?))) else {
        return format!(
            "for {whom} take none of these methods at up to 10000 Hz: none is stable and {bounds}; \
             soften the stiffest part, or damp it"
        );
    };
    format!(
        "for {whom} take {} at {} Hz: the cheapest method measured that is stable and {bounds} \
         ({}; {} ns and {} evaluations a simulated second)",
        row.advised.spec.method.name,
        good.tick_hz,
        good.verdict,
        row.ns_per_s.map_or("-".into(), |ns| significant(ns, 2)),
        significant(good.evaluations_per_s, 3),
    )
}

fn row(scene: &Scene, advised: &Advised, horizon_s: f64) -> Row {
    let ns = |good: &Good| {
        let ticks = (horizon_s * f64::from(good.tick_hz)).round() as u64;
        stopwatch::ns_per_s(scene, advised.spec, good.tick_hz, ticks, EFFORT)
    };
    Row { advised: advised.clone(), ns_per_s: advised.good.as_ref().and_then(ns) }
}

/// How long each measurement goes on: for two dozen methods not long to wait.
const EFFORT: Duration = Duration::from_millis(10);

fn stability<T: Into<Value>>(row: &Row, part: impl Fn(&Stability) -> T) -> Value {
    row.advised.verdict.stability.as_ref().map_or(Value::Null, |stability| part(stability).into())
}

fn hz(rate: Option<u32>) -> Value {
    rate.map_or(Value::Null, |hz| hz.into())
}

const COLUMNS: &[Column<Row>] = &[
    Column {
        key: "method",
        heading: Some("METHOD"),
        value: |row| json!(row.advised.spec.method.id),
    },
    Column {
        key: "verdict",
        heading: Some("VERDICT"),
        value: |row| json!(row.advised.verdict.to_string()),
    },
    Column { key: "word", heading: None, value: |row| json!(row.advised.verdict.word.text()) },
    Column {
        key: "stable_from_hz",
        heading: Some("STABLE FROM"),
        value: |row| hz(row.advised.stable_hz),
    },
    Column {
        key: "accurate_from_hz",
        heading: Some("ACCURATE FROM"),
        value: |row| hz(row.advised.accurate_hz),
    },
    Column {
        key: "good_hz",
        heading: None,
        value: |row| hz(row.advised.good.as_ref().map(|good| good.tick_hz)),
    },
    Column {
        key: "evaluations_per_s",
        heading: Some("EVALS/S"),
        value: |row| json!(row.advised.good.as_ref().map(|good| good.evaluations_per_s)),
    },
    Column {
        key: "ns_per_s",
        heading: Some("NS/S"),
        value: |row| json!(row.ns_per_s.map(f64::round)),
    },
    Column {
        key: "error",
        heading: None,
        value: |row| json!(Some(row.advised.verdict.outcome.error).filter(|x| x.is_finite())),
    },
    Column {
        key: "spectral_radius",
        heading: None,
        value: |row| stability(row, |stability| stability.spectral_radius),
    },
    Column {
        key: "growth_per_s",
        heading: None,
        value: |row| stability(row, |stability| stability.growth_per_s),
    },
    Column {
        key: "loss_per_s",
        heading: None,
        value: |row| stability(row, |stability| stability.loss_per_s),
    },
    Column {
        key: "frequency_error",
        heading: None,
        value: |row| stability(row, |stability| stability.frequency_error),
    },
    Column {
        key: "doubling_s",
        heading: None,
        value: |row| stability(row, |stability| stability.doubling_s()),
    },
    Column {
        key: "halving_s",
        heading: None,
        value: |row| stability(row, |stability| stability.halving_s()),
    },
];
