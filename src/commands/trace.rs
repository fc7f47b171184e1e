//! `regatta trace`: writes the numbers of every lane, tick by tick, as a tidy table on standard output.

use std::io;

use clap::Args;
use serde_json::Value;

use super::error::Error;
use super::experiment_args::{ExperimentArgs, TickArgs};
use super::help::flowing;
use super::output::Output;
use super::output::table::{RowFormat, RowWriter};
use super::terminal::print_status;
use crate::run::race::{Lane, LaneBody, Mode};
use crate::run::trace::{COLUMNS, each_row, method_id};
use crate::scene::SceneBody;
use crate::sim::bodies::Truth;
use crate::sim::integrators::StepFailure;
use crate::studio::Studio;

use impacts::Impacts;

mod impacts;

const EXAMPLES: &str = "\
One row for each tick, lane, body and coordinate:
  tick,t,lane,method,body,coordinate,q,v

Lane 0 is the truth: `exact`, or `reference` for a body without a closed form, and for a law with
`exact` after its first input, edit or placing. A line states the reference's accuracy. q is in metres or
radians, v in the same unit per second, t in seconds. With --metrics a row for each metric follows,
its id as coordinate, its value as q, and v empty.

Examples:
  regatta trace --scene ship --method explicit-euler --seconds 8.5
  regatta trace --scene my.toml --method rk4 > run.csv
  regatta trace --scene ball --impacts     n,lane,method,impact,t,speed_before,speed_after,apex_after,body";

/// Write the exact motion and every method's, tick by tick
///
/// To standard output.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct TraceArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    #[command(flatten)]
    ticks: TickArgs,

    /// Write each metric too (`regatta list metrics`)
    #[arg(long)]
    metrics: bool,

    /// Write a row for each impact of a ball in place of the ticks
    ///
    /// With the true ones as lane 0, without those whose flight is shorter than a tick.
    #[arg(long = "impacts", conflicts_with_all = ["every", "metrics"])]
    has_impacts: bool,

    /// How to write it: csv or json
    #[arg(long, value_name = "FORMAT", default_value = "csv", hide_possible_values = true)]
    format: RowFormat,
}

pub(super) fn run(args: &TraceArgs) -> Result<(), Error> {
    let mode = if args.experiment.names_no_method() { Mode::Race } else { Mode::Solo };
    let experiment = args.experiment.load(mode)?;
    let seconds = args.ticks.seconds.unwrap_or(experiment.scene.seconds);
    let mut studio = experiment.studio();
    let mut halts = Halts::default();

    let at_start: Vec<Truth> = studio.race().truth().bodies().iter().map(LaneBody::truth).collect();
    let mut trace = TraceOrImpacts::begin(args, &studio)?;
    trace.tick(&studio, false)?;
    let last = studio.race().nearest_tick(seconds);
    let mut reached = vec![TruthAccuracy::default(); experiment.scene.bodies.len()];
    while studio.race().tick() < last {
        studio.tick();
        for (it, truth) in reached.iter_mut().zip(studio.race().truth().bodies()) {
            it.note(truth);
            if it.lost_at_s.is_none() && it.is_lost() {
                it.lost_at_s = Some(studio.race().t());
            }
        }
        trace.tick(&studio, studio.race().tick() == last)?;
        halts.note(&studio);
    }
    trace.end()?.close()?;
    let truth = studio.race().truth();
    print_accuracy(&experiment.scene.bodies, &at_start, &reached, truth);
    for (SceneBody { name, kind, .. }, truth) in experiment.scene.bodies.iter().zip(truth.bodies())
    {
        let [begun, first] = [0, 1].map(|impact| truth.stepper.true_bounce(impact));
        // Of a body that was kicked, or whose truth has failed, the first impact is not known.
        let is_known = begun.is_none_or(|[begun_s, _]| begun_s == 0.0)
            && truth.stepper.truth_error().is_some_and(|error| error[0].is_finite());
        let is_met = first.is_some_and(|[at_s, _]| at_s <= studio.race().t());
        if kind.has_walls && is_known && !is_met {
            let events = kind.law().map_or(&[][..], |law| &law.text().events);
            let names: Vec<_> = events.iter().map(|event| format!("`{}`", event.name)).collect();
            let what = match &*names {
                [] => "it meets no wall".to_owned(),
                [name] => format!("{name} never fires"),
                names => format!("{} never fire", names.join(", ")),
            };
            print_status(&format!("lane 0, {name}: {what} in {seconds} s"));
        }
    }
    halts.lines.iter().for_each(|line| print_status(line));
    halts.refusal.map_or(Ok(()), |refusal| Err(Error::failed(refusal)))
}

/// The table that is being written: of ticks, or of impacts.
enum TraceOrImpacts<'a> {
    Ticks(Box<Trace<'a>>),
    Impacts(Box<Impacts>),
}

impl<'a> TraceOrImpacts<'a> {
    fn begin(args: &'a TraceArgs, studio: &Studio) -> io::Result<Self> {
        Ok(match args.has_impacts {
            true => Self::Impacts(Impacts::begin(args.format, studio)?.into()),
            false => Self::Ticks(Trace::begin(args)?.into()),
        })
    }

    fn tick(&mut self, studio: &Studio, is_end: bool) -> io::Result<()> {
        match self {
            Self::Ticks(trace) => trace.tick(studio),
            Self::Impacts(impacts) => impacts.tick(studio, is_end),
        }
    }

    fn end(self) -> io::Result<Output> {
        match self {
            Self::Ticks(trace) => trace.rows.end(),
            Self::Impacts(impacts) => impacts.end(),
        }
    }
}

/// The table of ticks that is being written.
struct Trace<'a> {
    rows: RowWriter<Output>,
    args: &'a TraceArgs,
    /// The cells of the present row. Most of them are the same in the next row.
    cells: [Value; COLUMNS.len()],
}

impl<'a> Trace<'a> {
    fn begin(args: &'a TraceArgs) -> io::Result<Self> {
        let rows = RowWriter::begin(Output::stdout(), args.format, COLUMNS)?;
        Ok(Self { rows, args, cells: Default::default() })
    }

    /// Writes the present state of the truth and of every lane, but not of bodies that have halted.
    fn tick(&mut self, studio: &Studio) -> io::Result<()> {
        let race = studio.race();
        if !race.tick().is_multiple_of(self.args.ticks.every) {
            return Ok(());
        }
        let Self { rows, args, cells } = self;
        (cells[0], cells[1]) = (race.tick().into(), race.t().into());
        each_row(race, studio.scene(), args.metrics, &mut |row| {
            cells[2] = row.lane.into();
            (cells[3], cells[4]) = (row.method.into(), row.body.into());
            (cells[5], cells[6], cells[7]) = (row.coordinate.into(), row.q.into(), row.v.into());
            rows.row(cells)
        })
    }
}

/// Error of a truth, in parts of its largest value, beyond which it is none.
pub(super) const LOST: f64 = 1e-3;

/// The accuracy of a body's truth during a run: the largest coordinate and velocity, and their errors.
#[derive(Clone, Copy, Default)]
pub(super) struct TruthAccuracy {
    pub(super) largest: [f64; 2],
    error: [f64; 2],
    /// The time in seconds from which it is not known.
    lost_at_s: Option<f64>,
}

impl TruthAccuracy {
    pub(super) fn note(&mut self, truth: &LaneBody) {
        let most = |so_far: f64, values: &[f64]| {
            values.iter().fold(so_far, |so_far, x| so_far.max(x.abs()))
        };
        self.largest[0] = most(self.largest[0], truth.stepper.q());
        self.largest[1] = most(self.largest[1], truth.stepper.v());
        let error = truth.stepper.truth_error().unwrap_or([f64::INFINITY; 2]);
        self.error = [0, 1].map(|i: usize| self.error[i].max(error[i]));
    }

    /// Whether the truth was not known at a moment, though its error was.
    pub(super) fn is_lost(&self) -> bool {
        self.relative().is_finite() && self.relative() > LOST
    }

    /// Returns the larger of the two relative errors. An error of 0 stays 0, even for a body that does not move.
    pub(super) fn relative(&self) -> f64 {
        let part =
            |i: usize| if self.error[i] == 0.0 { 0.0 } else { self.error[i] / self.largest[i] };
        part(0).max(part(1))
    }
}

/// Reports the accuracy of each body whose truth is a reference solution at the end. `at_start` has the kinds of the
/// truths at the start.
fn print_accuracy(
    bodies: &[SceneBody],
    at_start: &[Truth],
    reached: &[TruthAccuracy],
    truth: &Lane,
) {
    for (((SceneBody { name, .. }, at_start), reached), truth) in
        bodies.iter().zip(at_start).zip(reached).zip(truth.bodies())
    {
        // A truth that has halted has a message of its own, and no accuracy to report.
        let aim = truth.truth().aimed_accuracy().filter(|_| !truth.stepper.is_beyond_reference());
        let Some(accuracy) = aim else { continue };
        let why = match at_start {
            Truth::Exact => "is exact only up to its first input, edit or placing",
            Truth::Reference => "has no closed form",
        };
        let id = truth.truth().id();
        let came = match reached.relative() {
            error if let Some(at_s) = reached.lost_at_s => {
                format!("reached {error:.1e} on this run: from {at_s:.3} s on it is no truth")
            }
            error if error.is_finite() => format!("reached {error:.1e} on this run"),
            _ => "reached an unknown accuracy".into(),
        };
        print_status(&format!(
            "lane 0, {name}: {why}; its {id} aims at {accuracy:e}, relative, and {came}"
        ));
    }
}

/// Messages about bodies that halted. They are printed after the table, because they could break it up.
#[derive(Default)]
struct Halts {
    lines: Vec<String>,
    /// Why a method stepped a body not once.
    refusal: Option<String>,
}

impl Halts {
    fn note(&mut self, studio: &Studio) {
        let race = studio.race();
        for (entrant, halt) in race.just_halted() {
            let before = |id| race.entrants().iter().take_while(move |other| other.id != id);
            let number = entrant.map_or(0, |entrant| 1 + before(entrant.id).count());
            let lane = entrant.map_or(race.truth(), |entrant| &entrant.lane);
            let body = &studio.scene().bodies[halt.body].name;
            if matches!(halt.failure, StepFailure::Refused { .. }) {
                self.refusal =
                    Some(format!("lane {number} did not step {body}: it {}", halt.failure));
            }
            let no_truth = if number == 0 { ", and so do its comparisons" } else { "" };
            self.lines.push(format!(
                "lane {number}, {}, halted at tick {} (t = {:.3} s): {body} {}; its rows end there{no_truth}",
                method_id(lane.solver(), &lane.bodies()[halt.body]),
                halt.tick,
                race.t() - race.last_step_s(),
                halt.failure,
            ));
        }
    }
}
