//! `regatta advise`: which method to take for a scene at its tick rate, and why.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use clap::Args;
use rayon::ThreadPoolBuilder;
use serde_json::{Map, Value, json};

use super::experiment::{ExperimentArgs, Lineup};
use super::jobs;
use super::recording::{progress, watch_for_interrupt};
use super::stopwatch::{self, Timing};
use super::table::{self, Column};
use super::{Error, TableFormat, tell};
use crate::lab::number::{round, significant};
use crate::lab::{
    Advised, Adviser, CRITERIA, LaneSpec, MOST_ADVISED_SUBSTEPS, Meets, Met, Scene, Verdict,
    recommended,
};
use crate::sim::integrators::METHODS;

const ABOUT: &str = "\
Each method is judged on the scene from its start, with its script's inputs, against the exact solution, at
the scene's tick rate or at --tick-hz. It is asked for the fewest substeps in a tick, 1 to 64, that meet

  bounded      nothing grows that should not, over the scene and in the long run: no mode of a linear body
               doubles within a year; any other body is followed for 20 times the scene's length
  looks-right  over the scene the amplitude is within 5 % of the truth's and the frequency within 1 %; a
               body that does not swing stays within 5 % of its range
  accurate     over the scene no coordinate or velocity is off by more than 1 % of its amplitude

The scene's length is cut to a minute. Costs are those of all bodies for a simulated second: evaluations
of the acceleration, and time measured here and now, the best of several runs. HOLDS FROM is the slowest
whole tick rate, down from the one asked about, at which the criterion still holds with as many substeps;
STIFFER BY is how many times the parameter it names may grow, at most 10000. The recommended method is the
cheapest; evaluations decide between costs within a fifth of each other.

Examples:
  regatta advise --scene harbour
  regatta advise --scene my.toml --tick-hz 50 --format json
  regatta advise --scene spring --method rk4 --method semi-implicit-euler --rates";

/// Say which method to take for a scene at its tick rate, with how many substeps
#[derive(Debug, Args)]
#[command(after_help = ABOUT)]
pub(super) struct AdviseArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Also search, for each method in one step a tick, the slowest tick rates from 1 to 10000 Hz that
    /// meet the criteria
    #[arg(long)]
    rates: bool,

    /// How to write it: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// Why there is no whole answer.
#[derive(Debug, thiserror::Error)]
pub enum AdviseError {
    /// Somebody pressed Ctrl-C.
    #[error("interrupted: {judged} of {wanted} methods were judged")]
    Interrupted {
        /// Methods in the answer.
        judged: usize,
        /// Methods asked about.
        wanted: usize,
    },
}

/// A method judged, and its measured costs.
struct Row {
    advised: Advised,
    /// For each criterion that is met.
    timings: [Option<Timing>; CRITERIA.len()],
    /// For each criterion the slowest rate, where rates were asked for.
    rates: Option<[Option<u32>; CRITERIA.len()]>,
}

/// How long each measurement goes on: for six dozen of them not long to wait.
const EFFORT: Duration = Duration::from_millis(5);

/// Costs that differ by less than this factor are equal.
const BLUR: f64 = 1.2;

pub(super) fn run(args: &AdviseArgs) -> Result<(), Error> {
    let experiment = args.experiment.load(Lineup::Everyone)?;
    let scene = &experiment.scene;
    let specs: Vec<LaneSpec> = if args.experiment.names_no_method() {
        METHODS.iter().map(LaneSpec::plain).collect()
    } else {
        args.experiment.lanes_named(scene)
    };
    let wanted = specs.len();
    let interrupted = watch_for_interrupt();
    let adviser = Arc::new(Adviser::new(scene, 1.0, scene.tick_hz));
    let mut rows = judge_all(&adviser, specs, args.rates, &interrupted);
    for row in &mut rows {
        row.time(scene);
    }
    let text = match args.format {
        TableFormat::Text => text(scene, &adviser, &rows, wanted),
        TableFormat::Json => format!("{:#}\n", object(scene, &adviser, &rows, wanted)),
    };
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    warn_of_load(&rows);
    match rows.len() {
        judged if judged < wanted => Err(AdviseError::Interrupted { judged, wanted }.into()),
        _ => Ok(()),
    }
}

/// The methods judged, in the order given; after an interrupt those judged by then.
fn judge_all(
    adviser: &Arc<Adviser>,
    specs: Vec<LaneSpec>,
    rates: bool,
    interrupted: &AtomicBool,
) -> Vec<Row> {
    let pool = ThreadPoolBuilder::new().build().expect("the system starts a thread for each core");
    let (methods, adviser) = (specs.len(), Arc::clone(adviser));
    let judge = move |method: usize| Row::judged(&adviser, specs[method], rates);
    let progress = progress(methods as u32, "methods judged");
    let rows = jobs::results(&pool, methods, &progress, interrupted, judge);
    rows.into_iter().flatten().collect()
}

impl Row {
    fn judged(adviser: &Adviser, spec: LaneSpec, rates: bool) -> Self {
        let met = CRITERIA.map(|criterion| adviser.meets(spec, criterion));
        let plain = LaneSpec { substeps: 1, ..spec };
        Self {
            advised: Advised { spec, verdict: adviser.verdict(spec), met },
            timings: [None; CRITERIA.len()],
            rates: rates.then(|| CRITERIA.map(|criterion| adviser.slowest(plain, criterion))),
        }
    }

    /// Measures what each criterion costs. Nothing else should run meanwhile.
    fn time(&mut self, scene: &Scene) {
        let ticks = (scene.seconds.min(10.0) * f64::from(scene.tick_hz)).round() as u64;
        for (i, met) in self.advised.met.iter().enumerate() {
            let Some(met) = met.met() else { continue };
            let known = (0..i).find(|&j| {
                self.advised.met[j].met().is_some_and(|other| other.substeps == met.substeps)
            });
            self.timings[i] = match known {
                Some(j) => self.timings[j],
                None => {
                    let spec = LaneSpec { substeps: met.substeps, ..self.advised.spec };
                    stopwatch::time(scene, spec, scene.tick_hz, ticks, EFFORT)
                }
            };
        }
    }

    fn ns_per_s(&self, criterion: usize) -> Option<f64> {
        Some(self.timings[criterion]?.ns_per_s)
    }
}

/// Says so if something else kept the machine busy while costs were measured.
fn warn_of_load(rows: &[Row]) {
    let timings = rows.iter().flat_map(|row| row.timings.iter().flatten());
    let mut spreads: Vec<f64> = timings.map(|timing| timing.spread).collect();
    spreads.sort_by(f64::total_cmp);
    if let Some(&middle) = spreads.get(spreads.len() / 2)
        && middle > BLUR - 1.0
    {
        tell(&format!(
            "warning: the machine is busy: costs in ns vary by {} % from run to run",
            significant(100.0 * middle, 2)
        ));
    }
}

/// The row to take for each criterion.
fn best(rows: &[Row], criterion: usize) -> Option<(&Row, &Met)> {
    let advised: Vec<Advised> = rows.iter().map(|row| row.advised.clone()).collect();
    let cost = |advised: &Advised, _: &Met| {
        let row = rows.iter().find(|row| row.advised.spec == advised.spec);
        row.and_then(|row| row.ns_per_s(criterion)).unwrap_or(f64::INFINITY)
    };
    let row = &rows[recommended(&advised, criterion, BLUR, cost)?];
    Some((row, row.advised.met[criterion].met()?))
}

fn text(scene: &Scene, adviser: &Adviser, rows: &[Row], wanted: usize) -> String {
    let mut text = table::text(VERDICTS, rows, "");
    for (i, criterion) in CRITERIA.iter().enumerate() {
        let met: Vec<MetRow> = rows.iter().filter_map(|row| MetRow::of(row, i)).collect();
        text += &format!("\n{}: {}\n", criterion.id(), criterion.about());
        if !met.is_empty() {
            text += &table::text(METS, &met, "  ");
        }
        for (meets, why) in [
            (Meets::No, format!("not with up to {MOST_ADVISED_SUBSTEPS} substeps")),
            (Meets::Unknown, "not known: no truth, or too much work".to_owned()),
        ] {
            let those = rows.iter().filter(|row| row.advised.met[i] == meets);
            let ids: Vec<&str> = those.map(|row| row.advised.spec.method.id).collect();
            if !ids.is_empty() {
                text += &format!("  {why}: {}\n", ids.join(", "));
            }
        }
    }
    if rows.iter().any(|row| row.rates.is_some()) {
        text += "\nslowest tick rates in one step a tick, in Hz\n";
        text += &table::text(RATES, rows, "  ");
    }
    text.push('\n');
    if rows.len() < wanted {
        text += &format!("interrupted: of the {} methods judged, of {wanted},\n", rows.len());
    }
    for (i, criterion) in CRITERIA.iter().enumerate() {
        text += &format!("at {} Hz: {}: ", adviser.tick_hz(), criterion.id());
        text += &match best(rows, i) {
            Some((row, met)) => line(row, met),
            None if rows.iter().all(|row| row.advised.met[i] == Meets::No) => format!(
                "none of these with up to {MOST_ADVISED_SUBSTEPS} substeps; raise the tick rate, soften the \
                 stiffest of {}, or damp it",
                match &scene.bodies[..] {
                    [body] => body.name.clone(),
                    bodies => format!("the {} bodies", bodies.len()),
                }
            ),
            None => {
                "not known of any of these that might: there is no truth, or it takes too much work"
                    .into()
            }
        };
        text.push('\n');
    }
    text
}

/// What to take, for a design note.
fn line(row: &Row, met: &Met) -> String {
    let more = if met.stiffness_factor >= 10_000.0 { "more than " } else { "" };
    format!(
        "{} ×{} ({} evaluations/s; holds down to {} Hz, or {more}{} × {})",
        row.advised.spec.method.id,
        met.substeps,
        met.evaluations_per_s.round(),
        met.slowest_hz,
        round(met.stiffness_factor, 3),
        met.limited_by,
    )
}

fn object(scene: &Scene, adviser: &Adviser, rows: &[Row], wanted: usize) -> Value {
    let recommended = CRITERIA.iter().enumerate().map(|(i, criterion)| {
        let take = best(rows, i).map(|(row, met)| {
            json!({
                "method": row.advised.spec.method.id,
                "substeps": met.substeps,
                "tick_hz": adviser.tick_hz(),
            })
        });
        (criterion.id().to_owned(), json!(take))
    });
    json!({
        "scene": scene.name,
        "tick_hz": adviser.tick_hz(),
        "horizon_s": adviser.judge().horizon_s(),
        "bodies": scene.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "complete": rows.len() == wanted,
        "methods": rows.iter().map(|row| method(scene, row)).collect::<Vec<_>>(),
        "recommended": recommended.collect::<Map<_, _>>(),
    })
}

fn method(scene: &Scene, row: &Row) -> Value {
    let Verdict { word, body, error, doubles_in_s, halves_in_s, frequency_error, .. } =
        &row.advised.verdict;
    let criteria = CRITERIA.iter().enumerate().map(|(i, criterion)| {
        let met = row.advised.met[i].met().map(|met| {
            json!({
                "substeps": met.substeps,
                "evaluations_per_s": met.evaluations_per_s,
                "ns_per_s": row.ns_per_s(i).map(f64::round),
                "slowest_hz": met.slowest_hz,
                "stiffness_factor": met.stiffness_factor,
                "limited_by": met.limited_by,
            })
        });
        (criterion.id().to_owned(), json!(met))
    });
    let mut object = json!({
        "method": row.advised.spec.method.id,
        "verdict": {
            "word": word.id(),
            "body": scene.bodies[*body].name,
            "error": Some(*error).filter(|error| error.is_finite()),
            "doubles_in_s": doubles_in_s,
            "halves_in_s": halves_in_s,
            "frequency_error": frequency_error,
            "text": row.advised.verdict.to_string(),
        },
        "criteria": criteria.collect::<Map<_, _>>(),
    });
    if let Some(rates) = &row.rates {
        let rates = CRITERIA.iter().zip(rates).map(|(c, hz)| (c.id().to_owned(), json!(hz)));
        object["rates"] = Value::Object(rates.collect());
    }
    object
}

const VERDICTS: &[Column<Row>] = &[
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
];

const RATES: &[Column<Row>] = &[
    Column {
        key: "method",
        heading: Some("METHOD"),
        value: |row| json!(row.advised.spec.method.id),
    },
    Column { key: "bounded", heading: Some("BOUNDED"), value: |row| rate(row, 0) },
    Column { key: "looks-right", heading: Some("LOOKS-RIGHT"), value: |row| rate(row, 1) },
    Column { key: "accurate", heading: Some("ACCURATE"), value: |row| rate(row, 2) },
];

fn rate(row: &Row, criterion: usize) -> Value {
    json!(row.rates.and_then(|rates| rates[criterion]))
}

/// A method that meets a criterion.
struct MetRow {
    id: &'static str,
    met: Met,
    ns_per_s: Option<f64>,
}

impl MetRow {
    fn of(row: &Row, criterion: usize) -> Option<Self> {
        let met = row.advised.met[criterion].met()?.clone();
        Some(Self { id: row.advised.spec.method.id, met, ns_per_s: row.ns_per_s(criterion) })
    }
}

const METS: &[Column<MetRow>] = &[
    Column { key: "method", heading: Some("METHOD"), value: |row| json!(row.id) },
    Column {
        key: "substeps",
        heading: Some("SUBSTEPS"),
        value: |row| json!(format!("×{}", row.met.substeps)),
    },
    Column {
        key: "evaluations_per_s",
        heading: Some("EVALS/S"),
        value: |row| json!(row.met.evaluations_per_s.round() as u64),
    },
    Column {
        key: "ns_per_s",
        heading: Some("NS/S"),
        value: |row| json!(row.ns_per_s.map(|ns| ns.round() as u64)),
    },
    Column {
        key: "slowest_hz",
        heading: Some("HOLDS FROM"),
        value: |row| json!(format!("{} Hz", row.met.slowest_hz)),
    },
    Column {
        key: "stiffness_factor",
        heading: Some("STIFFER BY"),
        value: |row| {
            json!(format!("{} × {}", round(row.met.stiffness_factor, 3), row.met.limited_by))
        },
    },
];
