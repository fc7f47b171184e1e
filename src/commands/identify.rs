//! `regatta identify`: finds the method and the number of substeps that produced a log of a motion.

use std::path::{Path, PathBuf};

use clap::Args;

use super::argument::{brief, number, number_that, positive};
use super::error::Error;
use super::help::flowing;
use super::output::table::TableFormat;
use super::table_args::TableArgs;
use super::terminal::print_status;
use super::tick_rate::{rate_of_a_log, rate_of_a_step};
use crate::regular_file;
use crate::table::{Heading, TableOptions};
use crate::tools::identify::{Log, LogError, LogSetting, LoggedBody, identify};

mod findings;

use findings::{object, report_text};

const ABOUT: &str = "\
LOG.csv is a table or JSON with a row for each tick, or for some of them: t, x in metres and v, if logged.
The unit of t is in its heading, or found by its size; without t and tick, the rows are ticks of --tick-hz.
If rows are skipped, a column tick counts them; without it, t does. Rows at uneven times, as of a video,
show the motion but not the method; rows that step alike whatever their times are ticks. If a log without v
fits several methods, identify assumes a start at rest where that decides. At most 3000 ticks are read;
--rows, or --start and --end choose which. Where y and z are there too, each is answered. A line on
standard error has the rows, the columns and those left out, the unit and the rate; in JSON it is read.
The body is one of:

  a spring      --k, and --c and --mass if they are not 0 and 1
  a body that coasts or is driven    --drag, the damping setting in 1/s, and --thrust in newtons
  neither given: a spring; its stiffness and damping are fitted too, which leaves more open

Identify finds where the spring rests, if not at 0, or takes it from --rest.

A residual is the root mean square of the difference from the log, in units of the largest x and v.
The word is

  identified    one method explains the log to its noise, with those that do the same on this body
  cannot tell   methods that differ explain it equally well, or the log is too short to tell
  unknown       none explains it; the answer is a damped swing, with its standard errors

If nothing is given of the body, a simpler motion comes first: a rest, a steady speed, a constant
acceleration, a chase, linear or quadratic drag. It is named where a swing lowers the Bayesian information
criterion by less than 10 and the rest looks like noise. If nothing explains the log, the answer says so.

In JSON, also lists methods that do the same on this body, unusual lists rare ones that fit too, and held
says that the game applies the spring's force itself.

Examples:
  regatta identify spring.csv --tick-hz 60 --k 40 --c 0.5 --mass 2
  regatta identify log.csv --tick-hz 60 --k 40 --x-column pos.x --format json";

/// The answer if no method can run on the body.
const NOTHING_RUNS: &str = "\
unknown: no method can follow this log; give the body with --k or --drag, check --tick-hz, and log
three ticks in a row\n";

/// Say which engine or method made a log of a motion
///
/// And with how many substeps.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct IdentifyArgs {
    /// The log: a CSV file with columns t, x, v and tick, or - for standard input
    ///
    /// It needs t and x.
    #[arg(value_name = "LOG.csv")]
    log: PathBuf,

    /// Ticks per second of the game that wrote it [default: by the times]
    #[arg(long, value_name = "N", value_parser = rate_of_a_log, allow_negative_numbers = true)]
    tick_hz: Option<f64>,

    /// The length of a tick, in place of --tick-hz
    #[arg(long, value_name = "s", value_parser = rate_of_a_step, conflicts_with = "tick_hz")]
    #[arg(allow_negative_numbers = true)]
    step: Option<f64>,

    /// The mass in kg
    #[arg(long, value_name = "kg", default_value = "1", value_parser = positive)]
    mass: f64,

    #[command(flatten)]
    read: LogArgs,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// The options that say what a log is of, and how it is read.
#[derive(Debug, Args)]
pub(super) struct LogArgs {
    /// The stiffness of the spring [default: fitted]
    #[arg(long, value_name = "N/m", value_parser = number, allow_negative_numbers = true)]
    k: Option<f64>,

    /// The damping of the spring [default: fitted]
    ///
    /// With --k it is 0 by default.
    #[arg(long, value_name = "N s/m", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "k")]
    c: Option<f64>,

    /// The damping setting of the body
    #[arg(long, value_name = "1/s", value_parser = number, allow_negative_numbers = true)]
    drag: Option<f64>,

    /// Where the spring rests, in metres [default: 0, or fitted]
    #[arg(long, value_name = "m", value_parser = signed, allow_negative_numbers = true)]
    rest: Option<f64>,

    /// The velocity of the first row, where v was not logged [default: fitted]
    #[arg(long, value_name = "m/s", value_parser = signed, allow_negative_numbers = true)]
    v0: Option<f64>,

    /// A constant force in newtons
    #[arg(long, value_name = "N", value_parser = signed, allow_negative_numbers = true)]
    thrust: Option<f64>,

    #[command(flatten)]
    table: TableArgs,
}

fn signed(written: &str) -> Result<f64, String> {
    number_that(written, |_| true, "a number")
}

/// Names the option that corrects a mistaken setting of the log.
fn remedy(error: &LogError) -> &'static str {
    match error.mistaken {
        None => "",
        Some(LogSetting::TickColumn) => "; name one of them with --tick-column",
        Some(LogSetting::TimeColumn) => "; name one of them with --t-column",
        Some(LogSetting::CoordinateColumn) => "; name the coordinate's with --x-column",
        Some(LogSetting::VelocityColumn) => "; name one of them with --v-column",
        Some(LogSetting::MissingTickRate) => {
            "; give it with --tick-hz, or name the times with --t-column"
        }
        Some(LogSetting::Unit) => "; give it with --unit ns, us, ms or s",
        Some(LogSetting::Filter) => "",
    }
}

impl LogArgs {
    /// Reads the log at `path`, which comes from a game with this tick rate in hertz. Without one the log's times give
    /// it, or else `usual_hz`. `others` are the table's options, if not these.
    pub(super) fn read(
        &self,
        path: &Path,
        (tick_hz, usual_hz): (Option<f64>, Option<f64>),
        others: Option<TableOptions>,
    ) -> Result<Log, Error> {
        let options = others.unwrap_or_else(|| self.table.options());
        let bytes = regular_file::read_table(path).map_err(|error| {
            Error::mistake(format!("cannot read the log {}: {error}", brief(path)))
        })?;
        let is_standard = path.as_os_str() == "-";
        let name = if is_standard { "standard input".into() } else { brief(path) };
        let mut parsed = Log::from_bytes(&name, &bytes, &options, tick_hz);
        let is_missing = |error: &LogError| error.mistaken == Some(LogSetting::MissingTickRate);
        if usual_hz.is_some() && parsed.as_ref().is_err_and(is_missing) {
            parsed = Log::from_bytes(&name, &bytes, &options, usual_hz);
        }
        let log = parsed.map_err(|error| Error::mistake(format!("{error}{}", remedy(&error))))?;
        print_status(&log.summary());
        Ok(log)
    }

    /// Returns the body that was logged. Its mass is `mass`, in kg.
    pub(super) fn body(&self, mass: f64) -> LoggedBody {
        let spring = match (self.k, self.drag, self.thrust) {
            (Some(k), ..) => Some([k / mass, self.c.unwrap_or(0.0) / mass]),
            (None, None, None) => None,
            (None, ..) => Some([0.0; 2]),
        };
        let (drag, thrust) = (self.drag.unwrap_or(0.0), self.thrust.unwrap_or(0.0));
        LoggedBody { spring, drag, push: thrust / mass, rest: self.rest, v0: self.v0 }
    }
}

pub(super) fn run(args: &IdentifyArgs) -> Result<(), Error> {
    let tick_hz = args.tick_hz.or(args.step);
    let log = args.read.read(&args.log, (tick_hz, None), None)?;
    let others: Vec<(&str, Log)> = other_coordinates(args, &log)
        .into_iter()
        .filter_map(|(name, options)| {
            let log = args.read.read(&args.log, (tick_hz, None), Some(options));
            log.map_err(|error| print_status(&format!("{name}: {error}"))).ok().map(|it| (name, it))
        })
        .collect();
    let found = |log: &Log| identify(log, &args.read.body(args.mass), log.tick_hz());
    if let TableFormat::Json = args.format {
        let of = |log| object(found(log).as_ref(), log, args.mass);
        let mut first = of(&log);
        others.iter().for_each(|(name, log)| first["others"][name] = of(log));
        return args.format.print(&format!("{first:#}\n"));
    }
    let of =
        |log| found(log).map_or(NOTHING_RUNS.into(), |found| report_text(&found, log, args.mass));
    let mut text = of(&log);
    others.iter().for_each(|(name, log)| text += &format!("\n{name}\n{}", of(log)));
    args.format.print(&text)
}

/// Returns the coordinates of the body beside x, with the options that read each. A log with the velocity of x alone
/// gives none, and so does standard input.
fn other_coordinates(args: &IdentifyArgs, log: &Log) -> Vec<(&'static str, TableOptions)> {
    let options = args.read.table.options();
    if options.x.is_some() || args.log.as_os_str() == "-" {
        return Vec::new();
    }
    let left_out = &log.taken().left_out;
    let find = |starts: [&str; 3], axis| {
        let known = starts.map(|start| format!("{start}{axis}"));
        left_out.iter().find(|name| known.contains(&Heading::of(name).base)).cloned()
    };
    let of = |axis| {
        let (x, v) = (find(["", "pos ", "position "], axis)?, find(["v", "v ", "vel "], axis));
        let is_read = v.is_some() || !log.has_velocities();
        is_read.then(|| (axis, TableOptions { x: Some(x), v, ..options.clone() }))
    };
    ["y", "z"].into_iter().filter_map(of).collect()
}
