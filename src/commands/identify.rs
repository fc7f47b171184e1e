//! `regatta identify`: finds the method and the number of substeps that produced a log of a motion.

use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;

use super::argument::{brief, number, number_that, positive};
use super::error::Error;
use super::help::flowing;
use super::output::table::TableFormat;
use super::table_args::TableArgs;
use super::terminal::print_status;
use super::tick_rate::{rate_of_a_log, rate_of_a_step};
use crate::regular_file;
use crate::table::{Heading, TableOptions};
use crate::tools::identify::{
    Identification, Log, LogError, LogSetting, LoggedBody, identify_reading,
};

mod findings;
mod spin;

use findings::{object, report_text, spin_text};

const ABOUT: &str = "\
LOG.csv is a table or JSON with a row for each tick, or for some of them: t, x in metres and v, if logged.
The unit of t is in its heading, or found by its size; without t and tick, the rows are ticks of --tick-hz.
If rows are skipped, a column tick counts them; without it, t does. Rows at uneven times, as of a video,
show the motion but not the method; rows that step alike whatever their times are ticks. If a log without v
fits several methods, identify assumes a start at rest where that decides. At most 3000 ticks are read;
--rows, or --start and --end choose which. Where y and z are there too, or a row for each of several
bodies, each is answered; --where takes one body. A line on standard error has the rows, the columns and
those left out, the unit and the rate; in JSON it is read.
The body is one of:

  a spring      --k, and --c and --mass if they are not 0 and 1
  a body that coasts or is driven    --drag, the damping setting in 1/s, and --thrust in newtons
  a spin in space    columns wx, wy, wz (rad/s) in the body's frame, and --moments about its axes
  neither given: a spring; its stiffness and damping are fitted too, which leaves more open

Identify finds where the spring rests, if not at 0, or takes it from --rest.

Beside the methods of the list it tries steps that people write by hand, such as x += v dt + a dt²/2, or damping
by a factor after the move, and shows their lines.

A residual is the root mean square of the difference from the log, in units of the largest x and v.
The word is

  identified    one method explains the log to its noise, with those that do the same on this body
  cannot tell   methods that differ explain it equally well, or the log is too short to tell
  unknown       none explains it; the answer is a damped swing, with its standard errors

If nothing is given of the body, a simpler motion comes first: a rest, a steady speed, a constant
acceleration, a chase, linear or quadratic drag. It is named where a swing lowers the Bayesian information
criterion by less than 10 and the rest looks like noise. If nothing explains the log, a swing whose rest moves
is tried, and then the answer says so.

In JSON, best and also are the whole list of names: methods that do the same on this body, where it cannot tell
those that explain the log as well in another way, and rare ones that fit too, which unusual lists alone. held
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
    #[arg(long = "step", value_name = "s", value_parser = rate_of_a_step, conflicts_with = "tick_hz")]
    #[arg(allow_negative_numbers = true)]
    step_hz: Option<f64>,

    /// The mass in kg
    #[arg(long, value_name = "kg", default_value = "1", value_parser = positive)]
    mass: f64,

    /// The moments of inertia of a body that spins in space, or their ratios
    ///
    /// About the axes of the columns wx, wy and wz.
    #[arg(long, value_name = "I1,I2,I3", value_parser = spin::moments)]
    moments: Option<DVec3>,

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
    ///
    /// In 1/s, or the number d below 1 of Bullet, cannon-es and p2-es, whose drag is -ln(1 - d).
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

/// The bytes of a log's file, with its name in messages.
pub(super) struct LogFile {
    name: String,
    bytes: Vec<u8>,
}

impl LogFile {
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        let bytes = regular_file::read_table(path).map_err(|error| {
            Error::mistake(format!("cannot read the log {}: {error}", brief(path)))
        })?;
        let is_standard = path.as_os_str() == "-";
        let name = if is_standard { "standard input".into() } else { brief(path) };
        Ok(Self { name, bytes })
    }

    /// Reads a log of a game with this tick rate in hertz. Without one the log's times give it.
    fn log(&self, options: &TableOptions, tick_hz: Option<f64>) -> Result<Log, LogError> {
        Log::from_bytes(&self.name, &self.bytes, options, tick_hz)
    }
}

fn refused(error: LogError) -> Error {
    Error::mistake(format!("{error}{}", remedy(&error)))
}

impl LogArgs {
    /// Reads the log at `path`, which comes from a game with this tick rate in hertz. Without one the log's times give
    /// it, or else `usual_hz`.
    pub(super) fn read(
        &self,
        path: &Path,
        (tick_hz, usual_hz): (Option<f64>, f64),
    ) -> Result<Log, Error> {
        let (file, options) = (LogFile::read(path)?, self.table.options());
        let read = file.log(&options, tick_hz);
        let is_missing = |error: &LogError| error.mistaken == Some(LogSetting::MissingTickRate);
        let log = match read {
            Err(error) if is_missing(&error) => file.log(&options, Some(usual_hz)),
            read => read,
        };
        let log = log.map_err(refused)?;
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

    /// Identifies the log of a body, and prints how its numbers were read if that was not as they stand.
    pub(super) fn identify(&self, log: &Log, mass: f64) -> Option<Identification> {
        let (found, words) = identify_reading(log, &self.body(mass), mass);
        if let Some(words) = words {
            print_status(&words);
        }
        found
    }
}

pub(super) fn run(args: &IdentifyArgs) -> Result<(), Error> {
    let file = LogFile::read(&args.log)?;
    if let Some(moments) = args.moments {
        return args.format.print(&spin::answer(args, &file, moments)?);
    }
    let logs = logs(args, &file)?;
    let found = |log: &Log| args.read.identify(log, args.mass);
    if let TableFormat::Json = args.format {
        let mut objects =
            logs.iter().map(|(name, log)| (name, object(found(log).as_ref(), log, args.mass)));
        let Some((name, mut first)) = objects.next() else { return Ok(()) };
        if !name.is_empty() {
            first["of"] = name.as_str().into();
        }
        objects.for_each(|(name, object)| first["others"][name] = object);
        return args.format.print(&format!("{first:#}\n"));
    }
    let text = logs.iter().map(|(name, log)| {
        let told = found(log);
        let told = told.map_or(NOTHING_RUNS.into(), |found| report_text(&found, log, args.mass));
        if name.is_empty() { told } else { format!("{name}\n{told}") }
    });
    args.format.print(&text.collect::<Vec<_>>().join("\n"))
}

/// Returns the log of each body and each coordinate, with a name where there are several. Where one cannot be read, the
/// reason is printed.
fn logs(args: &IdentifyArgs, file: &LogFile) -> Result<Vec<(String, Log)>, Error> {
    let (tick_hz, options) = (args.tick_hz.or(args.step_hz), args.read.table.options());
    let bodies: Vec<_> = match file.log(&options, tick_hz) {
        Ok(log) => vec![(String::new(), log, options)],
        Err(error) => {
            let of = |(column, cell): &(String, String)| {
                let mut options = options.clone();
                options.filter.push((column.clone(), cell.clone()));
                let log = file.log(&options, tick_hz).ok()?;
                Some((format!("{column}={cell}"), log, options))
            };
            let bodies: Vec<_> = error.bodies.iter().filter_map(of).collect();
            if bodies.is_empty() {
                let asked = spin::without_moments(args, file, &error);
                return Err(asked.unwrap_or_else(|| refused(error)));
            }
            print_status(&error.to_string());
            bodies
        }
    };
    let mut logs = Vec::new();
    for (name, log, options) in bodies {
        let others = other_coordinates(&options, &log);
        logs.push((name.clone(), log));
        for (axis, options) in others {
            let name = format!("{name} {axis}").trim_start().to_owned();
            match file.log(&options, tick_hz) {
                Ok(log) => logs.push((name, log)),
                Err(error) => print_status(&format!("{name}: {error}")),
            }
        }
    }
    for (name, log) in &logs {
        let of = if name.is_empty() { String::new() } else { format!("{name}: ") };
        print_status(&format!("{of}{}", log.summary()));
    }
    Ok(logs)
}

/// Returns the coordinates of the body beside x, with the options that read each. A log with the velocity of x alone
/// gives none.
fn other_coordinates(options: &TableOptions, log: &Log) -> Vec<(&'static str, TableOptions)> {
    if options.x.is_some() {
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
