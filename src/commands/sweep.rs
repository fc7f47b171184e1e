//! `regatta sweep`: runs every method at every tick rate on every scene, for a tidy table and diagrams.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::drawing::Plot;
use super::error::Error;
use super::experiment::{PathOrName, scene_names, some_seconds};
use super::file_names::{check_picture_name, row_format};
use super::help::flowing;
use super::id::IMPACT;
use super::interrupt::watch_for_interrupt;
use super::output::table::{Column, RowFormat, write_rows};
use super::output::{Destination, STDOUT};
use super::own_file::METHOD_OR_FILE;
use super::scene_file;
use super::spring::SpringArgs;
use super::tick_rate::TickRatesArgs;
use crate::atomic_file::IfExists;
use crate::measure::Finding;
use crate::scene::{SCENES, Scene, SceneBody};
use crate::sim::Impact;
use crate::sim::bodies::incompatibility;
use crate::sim::integrators::{METHODS, Method};

mod diagrams;
mod grid;
mod round_off;
mod varied;

use grid::{Grid, Row, Swept};
use varied::{Varied, varied};

/// Number of the last columns, which only bodies that turn in space have.
const OF_SPINS: usize = 1;

const ABOUT: &str = "\
One row for each scene, body, method and tick rate, in that order whatever the number of threads:
  error                 the largest error of a coordinate or a velocity, as a fraction of its
                        amplitude; empty if the method did not finish or there is no truth
  energy_drift_percent  the largest drift, in percent of the energy that the exact motion exchanges;
                        empty if the body conserves no energy
  evaluations_per_s     evaluations of the acceleration per simulated second
  ns_per_s              nanoseconds per simulated second, measured here and now
  verdict               accurate, looks-right, bounded, dies-away, grows, blows-up, gives-up,
                        no-truth or not-judged, as `regatta advise` judges
  halted                the reason, if it blew up or gave up
  half_life_ms, overshoot_percent  of a follower
  attitude_error        the largest angle from the true attitude in radians; with scenes of bodies
                        that turn in space
  parameter, value      the parameter that --vary sets, and its value

Octaves are a quarter, half, 1, 2, 4 and 8 times the scene's own rate, rounded down.

Examples:
  regatta sweep --scene spring --method rk4 --tick-hz 30,60,120
  regatta sweep --scene my.toml --seconds 5 --out sweep.json --plot sweep.png";

/// Run every method at every tick rate on every scene, a row each
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct SweepArgs {
    /// A scene, or several [default: all built-in ones]
    ///
    /// `regatta list scenes` has the names. Anything else is read as a file. Give the option again for each.
    #[arg(id = "scene", long = "scene", value_name = "NAME|FILE", value_parser = PathOrName(scene_names))]
    #[arg(hide_possible_values = true, conflicts_with = "spring")]
    scenes: Vec<PathBuf>,

    #[command(flatten)]
    spring: SpringArgs,

    /// A method, or several [default: all]
    ///
    /// `regatta list methods` has them. Give the option again for each. A file that ends in .step is a method of your
    /// own.
    #[arg(long = "method", value_name = "ID|FILE", value_parser = METHOD_OR_FILE)]
    #[arg(hide_possible_values = true)]
    methods: Vec<&'static Method>,

    /// The rule for impacts of every ball (`regatta list impacts`) [default: the scene's]
    #[arg(long, value_name = "ID", value_parser = IMPACT, hide_possible_values = true)]
    impact: Option<&'static Impact>,

    #[command(flatten)]
    tick_rates: TickRatesArgs,

    /// Values of a parameter: a row for each
    ///
    /// In every body that has it (`regatta list bodies`), or as a constant of a law.
    #[arg(long, value_name = "KEY=V,V,...", value_parser = varied)]
    vary: Option<Varied>,

    /// Simulated seconds of each run
    ///
    /// To the nearest tick, one at least. The default is the scene's, 60 at most.
    #[arg(long, value_name = "s", value_parser = some_seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// How to write it: csv or json
    ///
    /// By default from the ending of --out, else csv.
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    format: Option<RowFormat>,

    /// Threads, 1 to 256 [default: one for each core]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,

    /// The file of the rows, or - for standard output
    #[arg(long, value_name = "FILE", default_value = STDOUT)]
    out: PathBuf,

    /// Draw work-precision diagrams as PNG into FILE
    ///
    /// One for each scene; - is standard output.
    #[arg(long, value_name = "FILE", conflicts_with = "vary")]
    plot: Option<PathBuf>,

    /// Also draw the round-off of f32 and f64
    ///
    /// On the chapter's ship, for --scene ship --method rk4: the step below which rounding makes the error grow again.
    #[arg(long, requires = "plot")]
    round_off: bool,

    /// Replace the files that are there
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &SweepArgs) -> Result<(), Error> {
    let swept = args.load()?;
    if args.round_off && !round_off::is_swept(&swept) {
        return Err(Error::mistake(
            "--round-off needs the chapter's ship under Runge-Kutta; give --scene ship --method rk4, or leave it out",
        ));
    }
    let format = row_format(&args.out, args.format)?;
    if let Some(plot) = args.plot.as_deref() {
        check_picture_name(plot, &args.out)?;
    }
    let interrupted = watch_for_interrupt();
    // The outputs are opened before the first run, so that a refusal does not come minutes later.
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let inputs: Vec<_> = args.scenes.iter().filter_map(|path| scene_file::input(path)).collect();
    let to = |path, option| Destination { path, option, if_exists, inputs: &inputs };
    let out = to(&args.out, "--out").open_for_text()?;
    let plot = args.plot.as_deref().map(|path| to(path, "--plot"));
    let plot = plot
        .map(|to| Plot::open(to, swept.scenes.len() + usize::from(args.round_off)))
        .transpose()?;
    let rows = Grid::new(&swept).run(args.threads.map(usize::from), &interrupted)?;
    let spins = rows.iter().any(|row| matches!(row.verdict.finding, Finding::Spun(_)));
    let columns = if spins { COLUMNS } else { &COLUMNS[..COLUMNS.len() - OF_SPINS] };
    let written = write_rows(out, format, columns, &rows);
    // The picture is drawn even if the rows could not be written, because their reader may have closed the pipe after
    // the first few.
    if let Some(plot) = plot {
        let rounded = args.round_off.then(|| round_off::error_curves(&swept.methods));
        plot.draw(&diagrams::figure(&swept, &rows, rounded.unwrap_or_default()))?;
    }
    written
}

impl SweepArgs {
    /// Returns the requested scenes, methods and rates, without repetitions.
    fn load(&self) -> Result<Swept, Error> {
        let built_in = || SCENES.iter().map(|scene| PathBuf::from(scene.name)).collect();
        let spring = self.spring.load()?.map(|(scene, _)| (scene.name.clone(), scene));
        let paths = match self.scenes.is_empty() {
            true if spring.is_some() => Vec::new(),
            true => built_in(),
            false => self.scenes.clone(),
        };
        let mut scenes: Vec<(String, Scene)> = spring.into_iter().collect();
        for path in paths {
            let name = scene_file::name_in_messages(&path);
            if scenes.iter().all(|(other, _)| *other != name) {
                scenes.push((name, scene_file::load(&path)?.0));
            }
        }
        if let Some(impact) = self.impact {
            if let Some(refusal) = self.methods.iter().find_map(|method| impact.refusal(method)) {
                return Err(Error::mistake(format!(
                    "--impact: {refusal}; give another, or leave the option out"
                )));
            }
            let lanes = scenes.iter_mut().flat_map(|(_, scene)| &mut scene.lanes);
            lanes.for_each(|lane| *lane = lane.with_impact(impact));
        }
        let asked = |method: &&Method| match &self.methods[..] {
            [] => method.is_for_games() || method.rule_fps().is_some(),
            named => named.contains(method),
        };
        let rates = self.tick_rates.tick_rates();
        let of_scenes = scenes.iter().flat_map(|(_, scene)| scene.own_methods.iter());
        let own = self.methods.iter().filter(|method| method.own_text().is_some());
        let mut methods: Vec<&'static Method> = Vec::new();
        for method in METHODS.iter().chain(of_scenes.chain(own).copied()).filter(asked) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        for method in &self.methods {
            // A method runs on the bodies that it can step. If it can step none of them, it is refused, because it
            // would leave no row.
            let alone =
                |body: &SceneBody| incompatibility(method, &body.kind, &body.values).is_none();
            if !scenes.iter().any(|(_, scene)| scene.bodies.iter().any(alone)) {
                scene_file::check_method(&scenes[0].1, method)?;
            }
        }
        if let Some(varied) = &self.vary {
            varied.check(&scenes)?;
        }
        Ok(Swept { scenes, methods, rates, seconds: self.seconds, varied: self.vary.clone() })
    }
}

const COLUMNS: &[Column<Row>] = &[
    Column::new("scene", |row| json!(row.scene)),
    Column::new("body", |row| json!(row.body)),
    Column::new("method", |row| json!(row.method.id)),
    Column::new("tick_hz", |row| json!(row.tick_hz)),
    Column::new("seconds", |row| json!(row.seconds())),
    Column::new("error", |row| json!(row.verdict.error())),
    Column::new("energy_drift_percent", |row| json!(row.verdict.energy_drift_percent())),
    Column::new("evaluations_per_s", |row| json!(row.evaluations_per_s())),
    Column::new("ns_per_s", |row| json!(row.ns_per_s.map(f64::round))),
    Column::new("verdict", |row| json!(row.verdict)),
    Column::new("halted", |row| {
        json!(row.verdict.failure().map(|failure| failure.cause.to_string()))
    }),
    Column::new("half_life_ms", |row| {
        json!(row.verdict.chase.and_then(|it| it.half_life_s).map(|s| 1e3 * s))
    }),
    Column::new("overshoot_percent", |row| {
        json!(row.verdict.chase.map(|chase| chase.overshoot_percent))
    }),
    Column::new("parameter", |row| json!(row.varied.as_ref().map(|(key, _)| key))),
    Column::new("value", |row| json!(row.varied.as_ref().map(|(_, value)| value))),
    Column::new("attitude_error", |row| {
        let Finding::Spun(found) = &row.verdict.finding else { return json!(null) };
        json!(found.attitude.0)
    }),
];
