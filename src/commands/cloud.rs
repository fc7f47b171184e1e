//! `regatta cloud`: steps a shape of many starts under some methods, and tabulates how the area of the shape changes.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::json;

use super::argument::{brief, number_that};
use super::error::Error;
use super::experiment::some_seconds;
use super::experiment_args::ExperimentArgs;
use super::file_names::{ending, row_format};
use super::help::flowing;
use super::id::SHAPE;
use super::interrupt::watch_for_interrupt;
use super::jobs;
use super::output::table::{Column, RowFormat, write_rows};
use super::output::{Destination, STDOUT};
use super::terminal::print_status;
use crate::atomic_file::IfExists;
use crate::measure::cloud::{
    Cloud, CloudBody, CloudMeasure, CloudShape, CloudStart, NoCloud, USUAL_POINTS,
};
use crate::run::race::Mode;
use crate::scene::{LaneSpec, Scene, SceneBody};

const ABOUT: &str = "\
The starts fill the shape evenly about the scene's start, in the plane of the coordinate and the
velocity of its first body of one coordinate. Those of a body that turns in space fill it on the
sphere of the directions of its L. The cloud ignores the scene's script. One row for each method:
  points            the starts that have not blown up
  area_ratio        the area divided by the area at the start; empty if no point is left, or if the
                    cloud is too fine, folded or torn to measure
  spread            the root mean square distance from the middle, divided by that at the start
  body_steps_per_s  measured here and now
  hash              of all states, to the bit: the same for any number of threads

`regatta capture --instrument cloud` draws it.

Examples:
  regatta cloud --scene liouville
  regatta cloud --scene spring --points 1000000 --out cloud.csv";

/// Step a cloud of starting points and measure its area
#[derive(Clone, Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct CloudArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Starts, 1 to 1000000000 [default: 100000]
    ///
    /// For a body that turns in space the default is 10000.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    points: Option<u64>,

    /// The shape of the starts: cat, disc or ring
    #[arg(long, value_name = "SHAPE", default_value = CloudShape::default().id())]
    #[arg(hide_possible_values = true)]
    #[arg(value_parser = SHAPE)]
    shape: CloudShape,

    /// The reach of the shape
    ///
    /// In the unit of the coordinate. The default is a quarter of the swing; clouds in the window are small, and reach
    /// twice as far. For a body that turns in space it is an angle, by default 0.05 rad.
    #[arg(long, value_name = "R", value_parser = reach)]
    reach: Option<f64>,

    /// Simulated seconds of the run
    ///
    /// To the nearest tick. The default is the scene's, 60 at most.
    #[arg(long, value_name = "s", value_parser = some_seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Threads, 1 to 256 [default: one for each core]
    ///
    /// Or RAYON_NUM_THREADS, if set.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,

    /// How to write it: csv or json
    ///
    /// By default from the ending of --out, else csv.
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    format: Option<RowFormat>,

    /// The file of the rows, or - for standard output
    #[arg(long, value_name = "FILE", default_value = STDOUT)]
    out: PathBuf,

    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
}

/// Cost of stepping a body that turns in space, roughly, in steps of a body of one coordinate.
const SPINS_COST: usize = 10;

/// Minimum reach of a cloud. A smaller cloud is lost in the rounding of its states.
const MIN_REACH: f64 = 1e-6;

fn reach(written: &str) -> Result<f64, String> {
    number_that(written, |it| (MIN_REACH..=1e9).contains(&it), "a number from 1e-6 to 1e9")
}

/// Returns the error for a cloud that cannot be built.
fn no_cloud(why: NoCloud) -> Error {
    Error::mistake(match why {
        NoCloud::TooMany { .. } => format!("{why} --points"),
        NoCloud::OverThePole { .. } => why.to_string(),
        why => format!(
            "{why}; give a scene with a body of one coordinate, such as pendulum, spring or duffing, or with one that turns \
             in space, such as coin"
        ),
    })
}

/// Returns the format of the rows, which follows from the name of their file unless it is `asked` for.
fn format(out: &Path, asked: Option<RowFormat>) -> Result<RowFormat, Error> {
    match ending(out).as_deref() {
        Some("png" | "gif") => Err(Error::mistake(format!(
            "regatta cloud writes rows; `regatta capture --instrument cloud` draws {}",
            brief(out)
        ))),
        _ => row_format(out, asked),
    }
}

/// Maximum number of times that the area is measured in a run.
const MAX_MEASUREMENTS: u64 = 100;

/// Maximum length of a run whose length is not given, in seconds.
const USUAL_SECONDS: f64 = 60.0;

/// The cloud of a method, as it is stepped.
struct MethodCloud {
    spec: LaneSpec,
    cloud: Cloud,
    stepping: Duration,
    /// Area ratios that were measured on the way, without the unknown ones.
    areas: Vec<f64>,
}

impl MethodCloud {
    /// Describes how the area has changed.
    fn measured_text(&self, area_ratio: Option<f64>) -> String {
        self.cloud.in_words(area_ratio, self.areas.iter().copied())
    }

    /// Steps the cloud to `tick`, and measures the area there.
    fn step_to(&mut self, tick: u64) {
        let begun = Instant::now();
        self.cloud.go_to(tick);
        self.stepping += begun.elapsed();
        self.areas.extend(self.cloud.area_ratio());
    }
}

impl CloudArgs {
    fn ticks(&self, scene: &Scene) -> u64 {
        let seconds = self.seconds.unwrap_or(scene.seconds.min(USUAL_SECONDS));
        ((seconds * f64::from(scene.tick_hz)).round() as u64).max(1)
    }
}

pub(super) fn run(args: &CloudArgs) -> Result<(), Error> {
    let format = format(&args.out, args.format)?;
    let scene = args.experiment.load(Mode::Race)?.scene;
    let specs = match args.experiment.names_no_method() {
        true => scene.lanes.clone(),
        false => args.experiment.lanes_named(&scene),
    };
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let inputs = Vec::from_iter(args.experiment.input());
    let to = Destination { path: &args.out, option: "--out", if_exists, inputs: &inputs };
    let output = to.open_for_text()?;
    let interrupted = watch_for_interrupt();
    let threads = args.threads.map_or(0, usize::from);
    let pool = jobs::pool(threads)?;
    let (ticks, reached) = (args.ticks(&scene), Arc::new(AtomicU64::new(0)));
    // An interrupt does not wait for this thread. A tick of many points takes seconds, and so does the measurement of
    // the area.
    let (args, noted) = (args.clone(), Arc::clone(&reached));
    let rows = move || pool.install(|| rows(&args, &scene, &specs, &noted));
    let Some(rows) = jobs::result(&interrupted, rows) else {
        let tick = reached.load(Ordering::Relaxed);
        return Err(Error::interrupted_after(format!("{tick} of {ticks} ticks")));
    };
    write_rows(output, format, COLUMNS, &rows?)
}

struct Row {
    /// Id of the method, with its settings if other rows have the same method.
    method: String,
    measure: CloudMeasure,
    body_steps_per_s: f64,
}

const COLUMNS: &[Column<Row>] = &[
    Column::new("method", |row| json!(row.method)),
    Column::new("points", |row| json!(row.measure.points)),
    Column::new("area_ratio", |row| json!(row.measure.area_ratio)),
    Column::new("spread", |row| json!(row.measure.spread)),
    Column::new("body_steps_per_s", |row| json!(row.body_steps_per_s.round())),
    Column::new("hash", |row| json!(format!("{:016x}", row.measure.hash))),
];

/// Computes the rows of all methods. `reached` is updated to the last tick that all methods have reached.
fn rows(
    args: &CloudArgs,
    scene: &Scene,
    specs: &[LaneSpec],
    reached: &AtomicU64,
) -> Result<Vec<Row>, Error> {
    let of_scene = scene_body(scene);
    let body = (of_scene.kind.build)(&of_scene.values, specs[0].solver());
    let of = CloudBody { name: &of_scene.name, kind: &of_scene.kind, body: &*body };
    let start = CloudStart::about(of, args.shape, args.reach);
    let start = start.map_err(no_cloud)?;
    let usual = if start.is_on_sphere { USUAL_POINTS / SPINS_COST } else { USUAL_POINTS };
    let points = args.points.map_or(usual, |points| points as usize);
    Cloud::find_room(points, specs).map_err(no_cloud)?;
    let cloud = |spec: &LaneSpec| {
        let cloud = Cloud::new(of, spec, start, points, scene.tick_hz);
        cloud.map(|cloud| MethodCloud {
            spec: *spec,
            cloud,
            stepping: Duration::ZERO,
            areas: Vec::new(),
        })
    };
    let mut runs = specs.iter().map(cloud).collect::<Result<Vec<_>, _>>().map_err(no_cloud)?;
    let ticks = args.ticks(scene);
    let every = ticks.div_ceil(MAX_MEASUREMENTS);
    let mut done = 0;
    while done < ticks {
        done = (done + every).min(ticks);
        runs.iter_mut().for_each(|run| run.step_to(done));
        reached.store(done, Ordering::Relaxed);
    }
    let is_read = args.out == Path::new(STDOUT);
    Ok(runs.iter().map(|run| row(run, specs, points, ticks, is_read)).collect())
}

/// Returns the first body that has one coordinate, or else the first body.
fn scene_body(scene: &Scene) -> &SceneBody {
    let of_one = |body: &&SceneBody| body.kind.coordinates(&body.values).len() == 1;
    scene.bodies.iter().find(of_one).unwrap_or(&scene.bodies[0])
}

/// Builds the row of a method. If the rows go to a file, or if starts were lost, prints a summary.
fn row(run: &MethodCloud, specs: &[LaneSpec], points: usize, ticks: u64, is_read: bool) -> Row {
    let MethodCloud { spec, cloud, stepping, .. } = run;
    let measure = cloud.measure();
    let method = spec.distinct_name(spec.method.id, specs);
    let lost = points - measure.points;
    let lost = match lost {
        0 => String::new(),
        lost => format!("; {lost} of {points} starts blew up and are left out"),
    };
    let how = cloud.measured_in_words();
    if !is_read || !lost.is_empty() {
        print_status(&format!("{method} {} ({how}){lost}", run.measured_text(measure.area_ratio)));
    }
    let steps = points as f64 * ticks as f64 * f64::from(spec.substeps);
    Row { method, measure, body_steps_per_s: steps / stepping.as_secs_f64().max(1e-9) }
}
