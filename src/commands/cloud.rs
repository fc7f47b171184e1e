//! `regatta cloud`: a shape of many starts under some methods, and what becomes of its area, as a table and as a GIF.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::json;

use super::error::Error;
use super::experiment::{ExperimentArgs, Lineup, some_seconds};
use super::file_names::{ending, mislabelled};
use super::help::flowing;
use super::id::SHAPE;
use super::interrupt::watch_for_interrupt;
use super::jobs;
use super::movie::Gif;
use super::numbers::number_that;
use super::output::table::{Column, RowFormat, write_rows};
use super::output::{Destination, Output, STDOUT};
use super::terminal::print_status;
use crate::atomic_file::IfExists;
use crate::lab::analysis::Unit;
use crate::lab::cloud::{
    Cloud, CloudAxes, CloudBody, CloudBorder, CloudMeasure, CloudShape, CloudStart, Density,
    NoCloud, PlaneView, ShownTicks, USUAL_POINTS, hidden_in_words,
};
use crate::lab::palette::{Rgba, Theme};
use crate::lab::{LaneSpec, Scene, SceneBody};
use crate::sim::bodies::Coordinate;
use crate::sim::number::{round, significant};
use crate::view::Lettering;

const ABOUT: &str = "\
The starts fill the shape evenly about the scene's start, in the plane of the coordinate and the
velocity of its first body of one coordinate. The scene's script is left out. One row for each
method:
  points            the starts that have not blown up
  area_ratio        the area over that at the start; empty where no point is left, or the cloud is
                    too fine, folded or torn for its points to tell
  spread            the root mean square distance from the middle, over that at the start
  body_steps_per_s  measured here and now
  hash              of all states, to the bit: the same for any number of threads

A GIF has the methods side by side, over the exact cloud in outline; the rows then go to standard
output. `regatta capture --instrument cloud` draws stills and sections.

Examples:
  regatta cloud --scene spring --points 1000000 --out cloud.csv
  regatta cloud --scene liouville --out cat.gif";

/// Step a shape of many starts and show what becomes of its area
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct CloudArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Starts, 1 to 1000000000
    #[arg(long, value_name = "N", default_value_t = USUAL_POINTS as u64)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    points: u64,

    /// The shape of the starts: cat, disc or ring
    #[arg(long, value_name = "SHAPE", default_value = CloudShape::default().id())]
    #[arg(hide_possible_values = true)]
    #[arg(value_parser = SHAPE)]
    shape: CloudShape,

    /// The reach of the shape
    ///
    /// In the unit of the coordinate. The default is a quarter of the swing; the clouds of the window, which are seen
    /// small, reach twice as far.
    #[arg(long, alias = "size", value_name = "R", value_parser = reach)]
    reach: Option<f64>,

    /// Simulated seconds of the run
    ///
    /// To the nearest tick. The default is the scene's, 60 at most.
    #[arg(long, value_name = "s", value_parser = some_seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Threads, 1 to 256 [default: one for each core]
    ///
    /// Or RAYON_NUM_THREADS, where that is set.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,

    /// FILE.csv or - for the rows, or FILE.gif
    ///
    /// A GIF shows what becomes of the shape on the way.
    #[arg(long, value_name = "FILE", default_value = STDOUT)]
    out: PathBuf,

    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
}

/// A cloud that is smaller is lost in the rounding of its states.
const MIN_REACH: f64 = 1e-6;

fn reach(written: &str) -> Result<f64, String> {
    number_that(written, |it| (MIN_REACH..=1e9).contains(&it), "a number from 1e-6 to 1e9")
}

/// The error of a cloud that cannot be.
fn no_cloud(why: NoCloud) -> Error {
    Error::mistake(match why {
        NoCloud::TooMany { .. } => format!("{why} --points"),
        why => format!(
            "{why}; give a scene with a body of one coordinate, such as pendulum, spring or duffing"
        ),
    })
}

/// What is written.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Rows,
    Gif,
}

fn form(out: &Path) -> Result<Form, Error> {
    if out == Path::new(STDOUT) {
        return Ok(Form::Rows);
    }
    match ending(out).as_deref() {
        Some("csv") => Ok(Form::Rows),
        Some("gif") => Ok(Form::Gif),
        Some("png") => Err(Error::mistake(format!(
            "regatta cloud draws no still pictures; `regatta capture --instrument cloud` draws {}",
            out.display()
        ))),
        _ => Err(mislabelled(out, "give --out a name that ends in .gif or .csv")),
    }
}

/// Pixels of a method's picture, each way, and between two.
const SIDE_PX: usize = 512;
const GAP_PX: usize = 8;
/// The pixels of the two lines above the pictures, and of those below.
const HEAD_PX: usize = 2 * Lettering::LINE_PX + 6;
const FOOT_PX: usize = 2 * Lettering::LINE_PX + 6;

/// The most pictures of a GIF, and the hundredths of a second that each is shown.
const MAX_FRAMES: u64 = 100;
const SHOWN_CS: u32 = 8;

/// The longest default run, in seconds.
const USUAL_SECONDS: f64 = 60.0;

/// How far other clouds stretch the axes, in widths of what the exact one covers.
const BESIDE: f64 = 1.0;

/// The longest run that sets the axes, in seconds.
const MAX_SCOUTED_S: u64 = 30;

/// The time after which an interrupt is looked for, if a tick takes no longer.
const LOOKED_EVERY: Duration = Duration::from_millis(50);

/// A method's cloud while it is stepped.
struct MethodCloud {
    spec: LaneSpec,
    cloud: Cloud,
    stepping: Duration,
    /// The ticks that are stepped at once.
    part: u64,
    /// The areas on the way, where they are known.
    areas: Vec<f64>,
}

impl MethodCloud {
    /// What the area has become.
    fn words(&self, area_ratio: Option<f64>) -> String {
        self.cloud.in_words(area_ratio, self.areas.iter().copied())
    }

    /// Steps to a tick; returns whether it came there before an interrupt.
    fn go_to(&mut self, tick: u64, interrupted: &AtomicBool) -> bool {
        while self.cloud.tick() < tick && !interrupted.load(Ordering::Relaxed) {
            let part = self.part.min(tick - self.cloud.tick());
            let begun = Instant::now();
            self.cloud.advance(part);
            let took = begun.elapsed();
            self.stepping += took;
            self.part = if took < LOOKED_EVERY { part * 2 } else { part.div_ceil(2) };
        }
        self.cloud.tick() >= tick
    }
}

pub(super) fn run(args: &CloudArgs) -> Result<(), Error> {
    let form = form(&args.out)?;
    let scene = args.experiment.load(Lineup::Everyone)?.scene;
    let specs = match args.experiment.names_no_method() {
        true => scene.lanes.clone(),
        false => args.experiment.lanes_named(&scene),
    };
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let to = Destination { path: &args.out, option: "--out", if_exists };
    let mut output = match form {
        Form::Rows => to.open_for_text()?,
        Form::Gif => to.open()?,
    };
    let interrupted = watch_for_interrupt();
    let threads = args.threads.map_or(0, usize::from);
    let pool = jobs::pool(threads)?;
    let Made { rows, size_px, frames } =
        pool.install(|| make(args, &scene, &specs, form, &interrupted))?;
    let write_rows = |output| write_rows(output, RowFormat::Csv, COLUMNS, &rows);
    if form == Form::Rows {
        return write_rows(output);
    }
    let mut gif = Gif::begin(&mut output, size_px)?;
    frames.into_iter().try_for_each(|rgba| gif.push(rgba, SHOWN_CS))?;
    drop(gif);
    output.finish(&format!("a picture of {}x{}", size_px[0], size_px[1]))?;
    write_rows(Output::stdout())
}

/// The results of all methods.
struct Made {
    rows: Vec<Row>,
    size_px: [u32; 2],
    /// The pictures on the way, of which the last is of the end; none where none are asked for.
    frames: Vec<Vec<u8>>,
}

/// A row of the table.
struct Row {
    /// Its id, with what tells it from other rows of the same method.
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

fn make(
    args: &CloudArgs,
    scene: &Scene,
    specs: &[LaneSpec],
    form: Form,
    interrupted: &AtomicBool,
) -> Result<Made, Error> {
    let of_scene = scene_body(scene);
    let body = (of_scene.kind.build)(&of_scene.values, specs[0].solver());
    let of = CloudBody { name: &of_scene.name, kind: &of_scene.kind, body: &*body };
    let start = CloudStart::about(of, args.shape, args.reach);
    let start = start.map_err(no_cloud)?;
    let points = args.points as usize;
    Cloud::find_room(points, specs).map_err(no_cloud)?;
    let cloud = |spec: &LaneSpec| {
        let cloud = Cloud::new(of, spec, start, points, scene.tick_hz);
        cloud.map(|cloud| MethodCloud {
            spec: *spec,
            cloud,
            stepping: Duration::ZERO,
            part: 1,
            areas: Vec::new(),
        })
    };
    let mut runs = specs.iter().map(cloud).collect::<Result<Vec<_>, _>>().map_err(no_cloud)?;
    let seconds = args.seconds.unwrap_or(scene.seconds.min(USUAL_SECONDS));
    let ticks = ((seconds * f64::from(scene.tick_hz)).round() as u64).max(1);
    // The first part of a long run is as wide as the rest.
    let long = ticks.min(MAX_SCOUTED_S * u64::from(scene.tick_hz));
    let times = long.min(MAX_FRAMES);
    let shown = ShownTicks { ticks: long, times, beside: BESIDE, spread: f64::INFINITY };
    let view = match form {
        Form::Rows => None,
        Form::Gif => {
            let axes = CloudAxes::of_run(of, start, specs, scene.tick_hz, shown);
            Some(axes.map_err(no_cloud)?.whole)
        }
    };
    let paper = view.map(|view| Paper {
        lettering: Lettering::default(),
        view,
        size_px: [runs.len() * (SIDE_PX + GAP_PX) - GAP_PX, HEAD_PX + SIDE_PX + FOOT_PX],
        what: format!("{}, {} Hz, {points} points", scene.name, scene.tick_hz),
        axes: axes_in_words(
            &scene_body(scene).kind.coordinates(&scene_body(scene).values).at(0),
            view,
        ),
    });
    let mut frames = Vec::new();
    let mut border = CloudBorder::exact(of, start, scene.tick_hz).map_err(no_cloud)?;
    let every = ticks.div_ceil(MAX_FRAMES);
    let mut done = 0;
    while done < ticks {
        done = (done + every).min(ticks);
        for run in &mut runs {
            if !run.go_to(done, interrupted) {
                let tick = run.cloud.tick();
                return Err(Error::interrupted_after(format!("{tick} of {ticks} ticks")));
            }
            run.areas.extend(run.cloud.area_ratio());
        }
        let Some(paper) = &paper else { continue };
        border.go_to(done);
        let t = done as f64 / f64::from(scene.tick_hz);
        frames.push(paper.picture(&runs, t, &border.lines()));
    }
    let size_px = paper.map_or([0; 2], |paper| paper.size_px.map(|pixels| pixels as u32));
    let rows = runs.iter().map(|run| row(run, specs, points, ticks, form)).collect();
    Ok(Made { rows, size_px, frames })
}

/// The first body of one coordinate, else the first.
fn scene_body(scene: &Scene) -> &SceneBody {
    let of_one = |body: &&SceneBody| body.kind.coordinates(&body.values).len() == 1;
    scene.bodies.iter().find(of_one).unwrap_or(&scene.bodies[0])
}

/// What lies along the axes of a picture.
fn axes_in_words(coordinate: &Coordinate, view: PlaneView) -> String {
    let axis = |way: &str, name: &str, [low, high]: [f64; 2], unit: &str| {
        format!("{way} {name}, {} to {} {unit}", significant(low, 2), significant(high, 2))
    };
    let across = axis("across", &coordinate.name, view.q, coordinate.shown_unit());
    let up = axis("up", &coordinate.velocity, view.v, &Unit::Velocity.on(coordinate));
    format!("{}; {up}", across.trim_end())
}

/// What the pictures of all methods are drawn on.
struct Paper {
    lettering: Lettering,
    view: PlaneView,
    size_px: [usize; 2],
    what: String,
    axes: String,
}

impl Paper {
    /// The clouds side by side at this time in seconds, each below its method and what has become of it.
    fn picture(&self, runs: &[MethodCloud], t: f64, lines: &[Vec<[f64; 2]>]) -> Vec<u8> {
        let Self { lettering, view, size_px: [width, height], what, axes } = self;
        let (theme, width) = (Theme::default(), *width);
        let palette = theme.palette();
        let mut pixels: Vec<Rgba> = vec![palette.background; width * height];
        let specs: Vec<LaneSpec> = runs.iter().map(|run| run.spec).collect();
        for (column, run) in runs.iter().enumerate() {
            let MethodCloud { spec, cloud, .. } = run;
            let mut density = Density::new([SIDE_PX; 2], *view);
            density.add(cloud.q(), cloud.v());
            let (colour, _) = theme.style(spec.method);
            let picture = density.picture(theme, colour, lines);
            let left = column * (SIDE_PX + GAP_PX);
            for (y, row) in picture.chunks_exact(SIDE_PX).enumerate() {
                let at = (HEAD_PX + y) * width + left;
                pixels[at..at + SIDE_PX].copy_from_slice(row);
            }
            let area = cloud.area_ratio();
            let ratio = area.map(|ratio| format!("area ×{}: ", significant(ratio, 3)));
            let hidden = hidden_in_words(cloud.hidden(&density), cloud.q().len());
            let hidden = hidden.map(|words| format!("; {words}")).unwrap_or_default();
            let words = format!("{}{}{hidden}", ratio.unwrap_or_default(), run.words(area));
            let name = spec.distinct_name(spec.method.name, &specs);
            for (line, (words, style)) in
                [(name, (colour, true)), (words, (palette.text, false))].iter().enumerate()
            {
                let at = [left + 4, 2 + line * Lettering::LINE_PX];
                lettering.write(&mut pixels, width, at, words, *style);
            }
        }
        let what = format!("{what}, after {} s", round(t, 3));
        for (line, words) in [&what, axes].into_iter().enumerate() {
            let at = [4, HEAD_PX + SIDE_PX + 2 + line * Lettering::LINE_PX];
            lettering.write(&mut pixels, width, at, words, (palette.dim, false));
        }
        pixels.concat()
    }
}

/// A method's row; tells what has become of its area in words.
fn row(run: &MethodCloud, specs: &[LaneSpec], points: usize, ticks: u64, form: Form) -> Row {
    let MethodCloud { spec, cloud, stepping, .. } = run;
    let measure = cloud.measure();
    let method = spec.distinct_name(spec.method.id, specs);
    let lost = points - measure.points;
    let lost = match lost {
        0 => String::new(),
        lost => format!("; {lost} of {points} starts blew up and are left out"),
    };
    let how = cloud.measured_in_words();
    if form != Form::Rows || !lost.is_empty() {
        print_status(&format!("{method} {} ({how}){lost}", run.words(measure.area_ratio)));
    }
    let steps = points as f64 * ticks as f64 * f64::from(spec.substeps);
    Row { method, measure, body_steps_per_s: steps / stepping.as_secs_f64().max(1e-9) }
}
