//! `regatta loop`: measures how game loops distort motion over the frames of a display.

use std::collections::HashSet;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use clap::Args;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::argument::number_that;
use super::drawing::Plot;
use super::error::Error;
use super::experiment::{PathOrName, scene_names, some_seconds, trace_names};
use super::file_names::{check_picture_name, row_format};
use super::help::flowing;
use super::id::ENGINE;
use super::interrupt::watch_for_interrupt;
use super::output::table::{RowFormat, RowWriter};
use super::output::{Destination, Input, Output, STDOUT, same_file_path};
use super::own_file::{LOOP_OR_FILE, METHOD_OR_FILE};
use super::table_args::{TableArgs, taken_object};
use super::tick_rate::TickRateArgs;
use super::trace_source::traces;
use super::{jobs, rule, scene_file};
use crate::atomic_file::IfExists;
use crate::loops::log::ShownLog;
use crate::loops::{
    CAMERA_METRICS, Camera, ENGINES, Excess, FrameLimits, FrameTrace, GameTime, LongFrame,
    MIN_RUN_S, PACING_METRICS, POLICIES, PacingMetric, PolicyCard, RefreshRate, USUAL_LATENCY_MS,
    trace_card,
};
use crate::run::Unit;
use crate::scene::{LaneSpec, Scene, SceneErrors};
use crate::sim::integrators::Method;
use crate::sim::number::counted;
use crate::table::TableOptions;

mod advice;
mod diagram;
mod engine;
mod measured;

use measured::{Measured, Stretch, measure};

const ABOUT: &str = "\
One row for each trace and policy, in the order asked for; times are in ms:
  frames              frames made, displayed or not
  animation_error_…   change of the moment shown minus change of the moment of display, from frame
                      to frame: judder (PresentMon's term)
  repeated_percent    displayed frames that show the same moment again
  double_percent      displayed frames that show two ticks or more at once, half a tick or more ahead
  old_refreshes_…     refreshes of the display that show the picture before again
  latency_…           moment of display minus moment shown; of a file up to a constant; empty where
                      the speed depends on the frame rate: the game runs away from the display
  dropped_ms          real time given up
  owed_max_ms         the most real time neither simulated nor given up
  position_error_rms  distance from the exact solution at the moment of display, in amplitudes (half
                      the range), of the worst body
  ticks, evaluations  steps made, and evaluations of the bodies' accelerations
  speed_percent       simulated time over real time
  owed_ms             real time neither simulated nor given up at the end; below 0 the game is ahead
  fast_forward_…      frames that simulate half a tick more than they last, to catch up on time owed
  backward_frames     frames that show an earlier moment than the frame before
  seen_error_…        with --follow: change of the distance from the camera to a body that moves evenly,
                      minus the change if every picture showed the moment of its display
  camera_error_rms_ms the same of the camera, and so of all that stands still in its picture
  camera_lag_ms       mean time by which the camera is behind the body

In --frame-rows q is the first coordinate of the scene's first body, step_ms the time of the frame's
steps, alpha the place of the picture between two ticks, and camera that of --follow. Each line of a
list is a frame. Below the rows, loop recommends one: the loop with the least animation error that has a fixed tick and is smooth within --latency-ms; or it
says why there is none. `regatta help loops` says more.

Examples:
  regatta loop > loops.csv
  regatta loop --trace steady-144 --policy fixed --policy fixed-linear
  regatta loop --trace capture.csv --tick-hz 50
  regatta loop --engine phaser --trace capture.csv
  regatta loop --policy mine.loop --policy bevy --set hz=60
  regatta loop --fps 200 --display-hz 144 --max-ticks 2
  regatta loop --trace steady-144 --follow 'x += (target - x)*8*dt'";

/// Measure what game loops do to motion on a display
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct LoopArgs {
    /// A policy, or several [default: the usual ones]
    ///
    /// `regatta list policies` has them, and `regatta list engine-loops` those of engines. A file that ends in .loop
    /// is a loop of your own. Give the option again for each, to compare them.
    #[arg(long = "policy", value_name = "ID|FILE", value_parser = LOOP_OR_FILE, hide_possible_values = true)]
    policies: Vec<Arc<PolicyCard>>,

    /// Compare all policies
    #[arg(long, conflicts_with = "policies")]
    all: bool,

    /// The loop of your engine, with what it does to your game in three lines
    ///
    /// `regatta list engine-loops` has them.
    #[arg(long, value_name = "ID", value_parser = ENGINE, hide_possible_values = true)]
    #[arg(conflicts_with_all = ["policies", "all", "engines"])]
    engine: Option<Arc<PolicyCard>>,

    /// Compare the loops of all engines
    #[arg(long, conflicts_with = "policies")]
    engines: bool,

    /// A constant of the loop's lines, such as max_ticks=4
    ///
    /// `regatta list engine-loops --format json` has those of engines. Give the option again for each.
    #[arg(hide_short_help = true, long = "set", value_name = "NAME=N", value_parser = setting)]
    settings: Vec<(String, f64)>,

    /// What a tick costs, for loops that count it [default: nothing]
    #[arg(hide_short_help = true, long, value_name = "ms")]
    #[arg(value_parser = clap::value_parser!(u32).range(..=60_000))]
    cost_ms: Option<u32>,

    /// A trace, or several [default: all built-in ones]
    ///
    /// `regatta list traces` has the names. Anything else is read as a file: CSV of PresentMon, OCAT, CapFrameX,
    /// FrameView, MangoHud, Unreal or FRAPS, or what Android prints of frames. Any other table or JSON needs a column
    /// of frame times or of a clock, and a list has one a line. Give the option again for each.
    #[arg(long = "trace", value_name = "ID|FILE", value_parser = PathOrName(trace_names))]
    #[arg(hide_possible_values = true)]
    traces: Vec<PathBuf>,

    #[command(flatten)]
    table: TableArgs,

    /// The column of the log with the moment that a frame shows, which is a row of its own
    ///
    /// A time of any unit, or a position that moves evenly. Below the rows, the loop that comes nearest is named. A
    /// clock of the frames may then run back.
    #[arg(long, value_name = "NAME|N", requires = "traces")]
    shown: Option<String>,

    /// The lines of a camera that follows a body as the pictures show it, or a file of them
    ///
    /// They run once a frame and move the camera x, such as 'x += (target - x)*8*dt'. The target moves evenly by
    /// --speed, or by 1 a second, and each loop draws it raw or between two ticks.
    #[arg(long, value_name = "RULE|FILE", allow_hyphen_values = true)]
    follow: Option<String>,

    /// The speed of the column of --shown, or of the body of --follow, in units a second [default: fitted, or 1]
    #[arg(hide_short_help = true, long, value_name = "N", value_parser = speed, allow_negative_numbers = true)]
    speed: Option<f64>,

    #[command(flatten)]
    tick_rate: TickRateArgs,

    /// The refresh rate [default: the trace's]
    ///
    /// In Hz, 1 to 1000. Without --trace, an even display of this rate.
    #[arg(long, value_name = "N")]
    display_hz: Option<RefreshRate>,

    /// Frames per second of a game with even frames [default: the display's]
    ///
    /// In Hz, 1 to 1000. Without --display-hz the display shows each frame when it begins, like one with a variable
    /// rate.
    #[arg(long, value_name = "N", conflicts_with = "traces")]
    fps: Option<RefreshRate>,

    /// The most ticks in a frame [default: each loop's own]
    ///
    /// Like Unity's maximumDeltaTime or Godot's max steps: the rest of a longer frame is dropped.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=10_000))]
    max_ticks: Option<u32>,

    /// Whether later frames make the ticks beyond the most of a frame: drop or keep
    #[arg(hide_short_help = true, long, value_name = "drop|keep", default_value = "drop", value_parser = excess)]
    excess: Excess,

    /// What a long frame counts as, before any other limit
    ///
    /// clamp:100 counts at most 100 ms; replace:200=1 counts a frame above 200 ms as 1 ms; last:66.7 counts one above
    /// 66.7 ms as the last one that was not. Ticks then have no other limit than --max-ticks.
    #[arg(hide_short_help = true, long, value_name = "RULE", value_parser = long_frame, conflicts_with = "max_frame_ms")]
    long_frame: Option<LongFrame>,

    /// The longest frame that is simulated [default: each loop's own]
    #[arg(long, value_name = "ms")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=60_000))]
    max_frame_ms: Option<u32>,

    /// A scene or the file of one
    ///
    /// `regatta list scenes` has the names. Anything else is read as a file.
    #[arg(long, value_name = "NAME|FILE", default_value = "spring", value_parser = PathOrName(scene_names))]
    #[arg(hide_possible_values = true)]
    scene: PathBuf,

    /// The method of the bodies
    ///
    /// `regatta list methods` has them. A file that ends in .step is a method of your own.
    #[arg(long, value_name = "ID|FILE", default_value = "rk4", value_parser = METHOD_OR_FILE)]
    #[arg(hide_possible_values = true)]
    method: &'static Method,

    /// Seconds of real time of each run
    ///
    /// A trace from a file may end before. The default is the scene's, at least 10, and a whole file.
    #[arg(long, value_name = "s", value_parser = some_seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// The most mean latency that the advised loop may have
    ///
    /// On a trace from a file, above the least.
    #[arg(long, value_name = "ms", default_value_t = USUAL_LATENCY_MS, value_parser = latency)]
    #[arg(allow_negative_numbers = true)]
    latency_ms: f64,

    /// How to write the rows: csv or json
    ///
    /// By default from the ending of --out, else csv.
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    format: Option<RowFormat>,

    /// The file of the rows, or - for standard output
    #[arg(long, value_name = "FILE", default_value = STDOUT)]
    out: PathBuf,

    /// Write a line of CSV for each frame into FILE
    ///
    /// - is standard output.
    #[arg(long, value_name = "FILE")]
    frame_rows: Option<PathBuf>,

    /// Draw the motion of each loop as PNG into FILE
    ///
    /// The moment shown against the moment of display, and the cost of each loop, on up to four traces.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,

    /// Replace the files that are there
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &LoopArgs) -> Result<(), Error> {
    let (scene, _) = scene_file::load(&args.scene)?;
    scene_file::check_method(&scene, args.method)?;
    let scene = Scene { tick_hz: args.tick_rate.tick_rate().unwrap_or(scene.tick_hz), ..scene };
    let camera = args.camera()?;
    let policies = args.policies()?;
    let limits = args.limits(&policies)?;
    // Ideal loops refuse a clock that is set back.
    let signed = policies.iter().all(|card| card.is_from_outside());
    let shown = args.shown.clone();
    let options = TableOptions { signed, shown, ..args.table.options() };
    let traces = traces(&args.traces, &options, args.display_hz, args.fps)?;
    let format = row_format(&args.out, args.format)?;
    if let Some(plot) = args.plot.as_deref() {
        check_picture_name(plot, &args.out)?;
    }
    let places = [Some(&*args.out), args.frame_rows.as_deref(), args.plot.as_deref()];
    let places: Vec<PathBuf> = places.into_iter().flatten().map(same_file_path).collect();
    if (1..places.len()).any(|n| places[..n].contains(&places[n])) {
        return Err(Error::mistake(
            "two outputs would go to the same place; give each of --out, --frame-rows and --plot its own",
        ));
    }
    let inputs = args.inputs();
    let interrupted = watch_for_interrupt();
    let stop = || interrupted.load(Ordering::Relaxed);
    // The outputs are opened before the first run, so that a refusal does not come late.
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let to = |path, option| Destination { path, option, if_exists, inputs: &inputs };
    let out = to(&args.out, "--out").open_for_text()?;
    let frames = args.frame_rows.as_deref().map(|path| to(path, "--frame-rows").open_for_text());
    let mut frames = match frames.transpose()? {
        Some(out) => {
            let columns = FRAME_COLUMNS.into_iter().chain(camera.as_ref().map(|_| "camera"));
            Some(RowWriter::begin(out, RowFormat::Csv, columns)?)
        }
        None => None,
    };
    let plot = args
        .plot
        .as_deref()
        .map(|path| Plot::open(to(path, "--plot"), diagram::room(traces.len())));
    let plot = plot.transpose()?;

    let pool = jobs::pool(0)?;
    let mut rows = Vec::new();
    for trace in &traces {
        let from = rows.len();
        let until_ns = args.until_ns(&scene, trace);
        let game_time = args.plot.as_deref().map(|_| GameTime::around_longest(trace, until_ns));
        let stretch = Stretch { until_ns, game_time, camera: camera.clone() };
        let log = args.shown.as_ref().and_then(|_| ShownLog::of(trace, args.speed));
        let cards: Vec<_> = log.iter().map(|log| &log.card).chain(&policies).cloned().collect();
        let run = |card, frames: Option<&mut _>| {
            let (spec, stretch) = (LaneSpec::plain(args.method), stretch.clone());
            measure(&scene, spec, (card, limits), trace, stretch, &stop, frames)
        };
        // The rows of frames are written one loop after the other.
        let measured: io::Result<Vec<Measured>> = match &mut frames {
            None => pool.install(|| cards.into_par_iter().map(|card| run(card, None)).collect()),
            Some(frames) => cards.into_iter().map(|card| run(card, Some(frames))).collect(),
        };
        rows.extend(measured?);
        if stop() {
            return Err(Error::nothing_written());
        }
        if let Some(log) = &log {
            advice::print_log(log, trace, scene.tick_hz);
        }
        let from = from + usize::from(log.is_some());
        match (&args.engine, &rows[from..]) {
            (Some(_), [row]) => engine::print_answer(row, limits),
            (_, rows) => advice::print_advice(rows, args.latency_ms, limits),
        }
        advice::print_camera(&rows[from - usize::from(log.is_some())..]);
    }
    write_measured(out, format, &rows, &traces)?;
    if let Some(frames) = frames {
        frames.end()?.finish("the frames")?;
    }
    if let Some(plot) = plot {
        plot.draw(&diagram::figure(&scene, &rows))?;
    }
    Ok(())
}

impl LoopArgs {
    /// Returns the limits on the simulated part of a frame, or an error if `--max-ticks` is given for a policy that
    /// ignores it.
    fn limits(&self, policies: &[Arc<PolicyCard>]) -> Result<FrameLimits, Error> {
        let asked = policies.iter().filter(|_| !self.policies.is_empty() || self.engine.is_some());
        let lines = policies.iter().find(|card| card.is_from_outside());
        let (is_cut, is_kept) = (self.max_frame_ms.is_some(), self.excess == Excess::Keep);
        let cut = [
            ("--max-ticks", self.max_ticks.is_some()),
            ("--max-frame-ms", is_cut),
            ("--long-frame", self.long_frame.is_some()),
            ("--excess", is_kept),
        ];
        if let (Some(card), Some((option, _))) = (lines, cut.iter().find(|(_, is_set)| *is_set)) {
            let known = match &*card.constants {
                "" => "write it into the lines".to_owned(),
                constants => {
                    format!("its lines have --set {}", constants.replace(", ", ", --set "))
                }
            };
            return Err(Error::mistake(format!(
                "{option} is for ideal loops, and {} has its own limits; {known}",
                card.id
            )));
        }
        let free = asked.into_iter().find(|card| self.max_ticks.is_some() && !card.has_max_ticks);
        if let Some(card) = free {
            let limited = POLICIES.iter().filter(|card| card.has_max_ticks).map(|card| &*card.id);
            return Err(Error::mistake(format!(
                "--max-ticks does nothing under {}, which does not limit ticks; leave it out, or take {}",
                card.id,
                limited.collect::<Vec<_>>().join(", ")
            )));
        }
        let Self { max_ticks, max_frame_ms, excess, long_frame, cost_ms, .. } = *self;
        Ok(FrameLimits { max_ticks, max_frame_ms, excess, long_frame, cost_ms })
    }

    /// Returns the camera of `--follow` before its first frame.
    fn camera(&self) -> Result<Option<Camera>, Error> {
        let Some(written) = &self.follow else {
            return match (&self.shown, self.speed) {
                (None, Some(_)) => Err(Error::mistake(
                    "--speed is that of a column or of a body; give --shown or --follow too",
                )),
                _ => Ok(None),
            };
        };
        let (name, lines) = rule::read(written)?;
        let camera = Camera::read(&lines, self.speed.unwrap_or(1.0));
        let camera = camera.map_err(|fault| SceneErrors::of_step(&name, &lines, fault))?;
        Ok(Some(camera))
    }

    /// Returns the files that the command reads.
    fn inputs(&self) -> Vec<Input<'_>> {
        let files = self.traces.iter().filter(|path| path.to_str().and_then(trace_card).is_none());
        let traces = files.map(|path| (&**path, "read as a trace"));
        traces.chain(scene_file::input(&self.scene)).collect()
    }

    /// Returns the requested policies without duplicates, with their settings.
    fn policies(&self) -> Result<Vec<Arc<PolicyCard>>, Error> {
        let mut policies: Vec<Arc<PolicyCard>> = match (&*self.policies, &self.engine) {
            ([], Some(engine)) => vec![engine.clone()],
            ([], None) => {
                let is_ideal = self.all || !self.engines;
                let ideal = POLICIES.iter().filter(|card| is_ideal && (self.all || card.is_usual));
                ideal.chain(ENGINES.iter().filter(|_| self.engines)).cloned().collect()
            }
            (policies, _) => policies.to_vec(),
        };
        let mut seen = HashSet::new();
        policies.retain(|card| seen.insert(card.id.clone()));
        let tick_hz = self.tick_rate.tick_rate().map(|hz| ("hz".to_owned(), f64::from(hz)));
        let has = |card: &PolicyCard, name: &str| {
            let mut constants = card.constants.split(", ");
            constants.any(|constant| constant.split('=').next() == Some(name))
        };
        if let Some((name, _)) =
            self.settings.iter().find(|(name, _)| !policies.iter().any(|card| has(card, name)))
        {
            let known: Vec<&str> = policies
                .iter()
                .map(|card| &*card.constants)
                .filter(|_| policies.iter().all(|card| card.is_from_outside()))
                .collect();
            return Err(Error::mistake(match &*known.join(", ") {
                "" => format!(
                    "no line declares {name:?}; write `const {name} = …` into the lines of a loop"
                ),
                known => format!("no line declares {name:?}; set one of {known}"),
            }));
        }
        let set = |card: Arc<PolicyCard>| {
            let settings =
                tick_hz.iter().chain(&self.settings).filter(|(name, _)| has(&card, name));
            let settings: Vec<_> = settings.cloned().collect();
            card.with_settings(&settings).unwrap_or(card)
        };
        Ok(policies.into_iter().map(set).collect())
    }

    /// Returns the time at which a run of `trace` ends, in nanoseconds.
    fn until_ns(&self, scene: &Scene, trace: &FrameTrace) -> i64 {
        match self.seconds {
            None if trace.ends() => i64::MAX,
            seconds => (seconds.unwrap_or(scene.seconds.max(MIN_RUN_S)) * 1e9).round() as i64,
        }
    }
}

/// Returns the metrics that follow from a single run. The state difference needs a second run.
fn metrics() -> impl Iterator<Item = &'static PacingMetric> {
    PACING_METRICS.iter().filter(|metric| metric.id != "state_difference")
}

fn write_measured(
    out: Output,
    format: RowFormat,
    rows: &[Measured],
    traces: &[FrameTrace],
) -> Result<(), Error> {
    // What was read of a log is an object, which a cell of CSV has no room for.
    let read = |name: &str| {
        let trace = traces.iter().find(|trace| trace.name() == name);
        json!(trace.and_then(FrameTrace::taken).map(taken_object))
    };
    let has_read = format == RowFormat::Json && traces.iter().any(|it| it.taken().is_some());
    let keys = ["policy", "trace", "tick_hz"].into_iter().chain(metrics().map(|metric| metric.id));
    // All rows have the camera, or none has.
    let camera_metrics =
        if rows.iter().any(|row| row.camera.is_some()) { &CAMERA_METRICS[..] } else { &[] };
    let keys =
        keys.chain(camera_metrics.iter().map(|(id, _)| *id)).chain(has_read.then_some("read"));
    let mut writer = RowWriter::begin(out, format, keys)?;
    for Measured { card, trace, tick_hz, report, camera, .. } in rows {
        let value = |metric: &PacingMetric| match ((metric.measure)(report), metric.unit) {
            (Some(count), Unit::One) => json!(count as u64),
            (value, _) => json!(value),
        };
        let of = [json!(card.id), json!(trace), json!(tick_hz)];
        let seen = camera.iter().flat_map(|camera| {
            camera_metrics.iter().map(move |(_, measure)| json!(measure(camera)))
        });
        let read = has_read.then(|| read(trace));
        let cells = of.into_iter().chain(metrics().map(value)).chain(seen).chain(read);
        writer.row(&cells.collect::<Vec<Value>>())?;
    }
    writer.end()?.finish(&counted(rows.len(), "row"))
}

/// The columns of `--frame-rows`.
const FRAME_COLUMNS: [&str; 12] = [
    "trace",
    "policy",
    "frame",
    "began_ms",
    "displayed_ms",
    "shown_ms",
    "ticks",
    "dropped_ms",
    "q",
    "step_ms",
    "owed_ms",
    "alpha",
];

fn excess(written: &str) -> Result<Excess, String> {
    match written {
        "drop" => Ok(Excess::Drop),
        "keep" => Ok(Excess::Keep),
        _ => Err("write drop or keep".into()),
    }
}

/// Reads a constant of a loop and its number, such as `max_ticks=4`.
fn setting(written: &str) -> Result<(String, f64), String> {
    let (name, value) =
        written.split_once('=').ok_or("write a constant and its number, such as max_ticks=4")?;
    Ok((name.trim().to_owned(), number_that(value, f64::is_finite, "a finite number")?))
}

/// Reads the treatment of long frames.
fn long_frame(written: &str) -> Result<LongFrame, String> {
    let ns = |written: &str| {
        let ms = number_that(written, |ms| (0.001..=60_000.0).contains(&ms), "0.001 to 60000 ms")?;
        Ok::<i64, String>((1e6 * ms).round() as i64)
    };
    match written.split_once(':') {
        Some(("clamp", most)) => Ok(LongFrame::Clamp(ns(most)?)),
        Some(("last", over)) => Ok(LongFrame::Last(ns(over)?)),
        Some(("replace", rest)) if let Some((over, by)) = rest.split_once('=') => {
            Ok(LongFrame::Replace { over: ns(over)?, by: ns(by)? })
        }
        _ => Err("write clamp:100, replace:200=1 or last:66.7, with times in ms".into()),
    }
}

fn speed(written: &str) -> Result<f64, String> {
    number_that(written, |speed| speed != 0.0 && speed.is_finite(), "a speed other than 0")
}

fn latency(written: &str) -> Result<f64, String> {
    number_that(written, |ms| (0.0..=10_000.0).contains(&ms), "0 to 10000 ms")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_counts_have_no_unit() {
        let counts = metrics().filter(|metric| metric.unit == Unit::One).map(|metric| metric.id);
        assert!(counts.eq([
            "frames",
            "ticks",
            "evaluations",
            "fast_forward_frames",
            "backward_frames"
        ]));
    }
}
