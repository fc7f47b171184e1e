//! `regatta identify`: which method, with how many substeps, made a log of a motion.

use std::fs;
use std::io;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::error::{Cause, Error};
use super::output::print;
use super::output::table::TableFormat;
use crate::lab::number::significant;
use crate::lab::{
    Candidate, Columns, Effective, Fitted, Identification, Log, LogError, LoggedBody, Word,
    identify,
};
use crate::sim::integrators::Method;

const ABOUT: &str = "\
LOG.csv has a header and a row for each tick, or for some of them: t in seconds, x in metres and,
if it was logged, v in metres per second. Where rows are skipped, a column tick counts them; else
the tick is read off t. The body is one of:

  a spring      --k, and --c and --mass if they are not 0 and 1, x from where it rests
  a body that coasts or is driven    --drag, the damping setting in 1/s, and --thrust in newtons
  neither given: a spring whose stiffness and damping are fitted too, which leaves more open

Every method with steps of one length is run beside the log under 1 to 16 substeps, from a start that
is fitted to the log, of which 3000 ticks are used. Methods as they are set by default are believed
before others, and counts of substeps that few set, such as 3, last. A residual is what is left over,
in units of the largest x and v, root mean square. The word is

  identified    one method explains the log to its noise, with those that do the same on this body
  cannot tell   methods that differ explain it equally well, or the log is too short to tell
  unknown       none explains it

JSON has word, best, substeps, held, residual, also (the same on this body), unusual (would explain
it too, but is rare), runner_up, runner_up_substeps, runner_up_residual,
effective_stiffness_n_per_m, effective_frequency_hz, effective_damping_ratio, energy_halves_s,
energy_doubles_s, exact_frequency_hz, exact_damping_ratio and recommended; held says that the game
applies the spring's force itself. What is not known is null.

Examples:
  regatta identify spring.csv --tick-hz 60 --k 40 --c 0.5 --mass 2
  regatta identify drift.csv --tick-hz 50 --drag 0.1 --thrust 20000 --mass 10000
  regatta identify log.csv --tick-hz 60 --k 40 --x-column pos.x --v-column vel.x --format json";

/// Where no method can be run on the body.
const NOTHING_RUNS: &str = "\
unknown: no method can follow this log; give the body with --k, or with --drag, and check --tick-hz\n";

/// Say which engine or method, with how many substeps, made a log of a motion
#[derive(Debug, Args)]
#[command(after_help = ABOUT)]
pub(super) struct IdentifyArgs {
    /// The log: a CSV file with the columns t, x and, if there are any, v and tick
    #[arg(value_name = "LOG.csv")]
    log: PathBuf,

    /// Ticks per second of the game that wrote it
    #[arg(long, value_name = "N", value_parser = rate)]
    tick_hz: f64,

    /// The stiffness of the spring in N/m [default: fitted]
    #[arg(long, value_name = "N/M", value_parser = number, allow_negative_numbers = true)]
    k: Option<f64>,

    /// The damping of the spring in N s/m [default: 0 with --k, else fitted]
    #[arg(long, value_name = "N S/M", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "k")]
    c: Option<f64>,

    /// The mass in kg
    #[arg(long, value_name = "KG", default_value = "1", value_parser = positive)]
    mass: f64,

    /// The damping setting of the body in 1/s
    #[arg(long, value_name = "1/S", value_parser = number, allow_negative_numbers = true)]
    drag: Option<f64>,

    /// A constant force in newtons
    #[arg(long, value_name = "N", value_parser = signed, allow_negative_numbers = true)]
    thrust: Option<f64>,

    /// The column of the tick's number
    #[arg(long, value_name = "NAME", default_value = "tick")]
    tick_column: String,

    /// The column of the time in seconds
    #[arg(long, value_name = "NAME", default_value = "t")]
    t_column: String,

    /// The column of the coordinate in metres
    #[arg(long, value_name = "NAME", default_value = "x")]
    x_column: String,

    /// The column of the velocity in metres per second
    #[arg(long, value_name = "NAME", default_value = "v")]
    v_column: String,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// Why nothing can be said of a log.
#[derive(Debug, thiserror::Error)]
enum IdentifyError {
    /// The file cannot be read.
    #[error("cannot read the log {}: {source}; give a CSV file that you may read", .path.display())]
    Unreadable {
        /// As it was given.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is no log.
    #[error("{0}")]
    Invalid(LogError),
}

impl Cause for IdentifyError {
    fn exit_code(&self) -> u8 {
        2
    }
}

fn parsed(written: &str, fits: fn(f64) -> bool, wanted: &str) -> Result<f64, String> {
    let number = written.parse::<f64>().ok().filter(|number| number.is_finite() && fits(*number));
    number.ok_or_else(|| format!("give {wanted}"))
}

fn rate(written: &str) -> Result<f64, String> {
    parsed(written, |hz| hz > 0.0 && hz <= 1e6, "a rate above 0 and up to 1000000 Hz, such as 60")
}

fn number(written: &str) -> Result<f64, String> {
    parsed(written, |x| x >= 0.0, "a number from 0 up")
}

fn positive(written: &str) -> Result<f64, String> {
    parsed(written, |x| x > 0.0, "a number above 0")
}

fn signed(written: &str) -> Result<f64, String> {
    parsed(written, |_| true, "a number")
}

pub(super) fn run(args: &IdentifyArgs) -> Result<(), Error> {
    let path = &args.log;
    let unreadable = |source| IdentifyError::Unreadable { path: path.clone(), source };
    let bytes = fs::read(path).map_err(unreadable)?;
    let text = String::from_utf8_lossy(&bytes);
    let columns = Columns {
        tick: args.tick_column.clone(),
        t: args.t_column.clone(),
        x: args.x_column.clone(),
        v: args.v_column.clone(),
    };
    let name = path.display().to_string();
    let log = Log::parse(&name, &text, &columns, args.tick_hz).map_err(IdentifyError::Invalid)?;
    let found = identify(&log, &body(args), args.tick_hz);
    let text = match (args.format, &found) {
        (TableFormat::Text, Some(found)) => words(found, &log, args.mass),
        (TableFormat::Text, None) => NOTHING_RUNS.to_owned(),
        (TableFormat::Json, found) => format!("{:#}\n", object(found.as_ref(), args.mass)),
    };
    print(&text)?;
    Ok(())
}

fn body(args: &IdentifyArgs) -> LoggedBody {
    let spring = match (args.k, args.drag, args.thrust) {
        (Some(k), ..) => Some([k / args.mass, args.c.unwrap_or(0.0) / args.mass]),
        (None, None, None) => None,
        (None, ..) => Some([0.0; 2]),
    };
    let (drag, thrust) = (args.drag.unwrap_or(0.0), args.thrust.unwrap_or(0.0));
    LoggedBody { spring, drag, push: thrust / args.mass }
}

/// What was found, as JSON; `None` if no method can be run.
fn object(found: Option<&Identification>, mass: f64) -> Value {
    let best = found.map(|found| found.best);
    let rival = found.and_then(|found| found.runner_up);
    let effective = found.and_then(|found| found.effective);
    let exact = found.and_then(|found| found.exact);
    let candidates = |all: fn(&Identification) -> &[Candidate]| -> Vec<Value> {
        let all = found.map(all).unwrap_or_default();
        all.iter().map(named).collect()
    };
    let halves = effective.and_then(|seen| seen.halves_s());
    let seen = |(method, effective): &(&Method, Effective)| {
        json!({
            "method": method.id,
            "frequency_hz": effective.frequency_hz(),
            "damping_ratio": effective.damping_ratio(),
        })
    };
    let recommended = found.map(|found| &found.recommended[..]).unwrap_or_default();
    json!({
        "word": found.map_or(Word::Unknown, |found| found.word).id(),
        "best": best.map(|best| best.candidate.method.id),
        "substeps": best.map(|best| best.candidate.substeps),
        "held": best.map(|best| best.candidate.is_held),
        "residual": best.map(|best| best.residual),
        "also": candidates(|found| &found.also),
        "unusual": candidates(|found| &found.unusual),
        "runner_up": rival.map(|other| other.candidate.method.id),
        "runner_up_substeps": rival.map(|other| other.candidate.substeps),
        "runner_up_residual": rival.map(|other| other.residual),
        "effective_stiffness_n_per_m":
            effective.and_then(|seen| seen.spring_stiffness()).map(|k| k * mass),
        "effective_frequency_hz": effective.and_then(|seen| seen.frequency_hz()),
        "effective_damping_ratio": effective.and_then(|seen| seen.damping_ratio()),
        "energy_halves_s": halves.filter(|seconds| *seconds > 0.0),
        "energy_doubles_s": halves.filter(|seconds| *seconds < 0.0).map(|seconds| -seconds),
        "exact_frequency_hz": exact.and_then(|exact| exact.frequency_hz()),
        "exact_damping_ratio": exact.and_then(|exact| exact.damping_ratio()),
        "recommended": recommended.iter().map(seen).collect::<Vec<_>>(),
    })
}

fn named(candidate: &Candidate) -> Value {
    json!({
        "method": candidate.method.id,
        "substeps": candidate.substeps,
        "held": candidate.is_held,
    })
}

/// Each method once, with its substeps.
fn names(candidates: &[Candidate]) -> String {
    let mut all: Vec<(String, String, Vec<u32>)> = Vec::new();
    for candidate in candidates {
        let (id, held) = (candidate.method.id, candidate.held());
        match all.iter_mut().find(|(known, of, _)| known == id && of == held) {
            Some((.., counts)) => counts.push(candidate.substeps),
            None => all.push((id.to_owned(), held.to_owned(), vec![candidate.substeps])),
        }
    }
    let named = all.iter_mut().map(|(id, held, counts)| {
        counts.sort_unstable();
        let counts: Vec<String> = counts
            .chunk_by(|a, b| a + 1 == *b)
            .map(|run| match run {
                [first, _, .., last] => format!("×{first} to ×{last}"),
                few => few.iter().map(|n| format!("×{n}")).collect::<Vec<_>>().join(" "),
            })
            .collect();
        format!("{id} {}{held}", counts.join(" "))
    });
    named.collect::<Vec<_>>().join("; ")
}

/// A motion in words.
fn seen(effective: &Effective) -> String {
    let ratio = effective.damping_ratio().map(|ratio| {
        let ratio = if ratio.abs() < 5e-7 { 0.0 } else { ratio };
        format!("damping ratio {}", significant(ratio, 3))
    });
    let swing = match effective.frequency_hz() {
        Some(hz) => Some(format!("{} Hz", significant(hz, 4))),
        None => ratio.is_some().then(|| "no swing".to_owned()),
    };
    let (thing, gain) = match ratio {
        Some(_) => ("the energy", "doubles"),
        None => ("the way to its last speed", "doubles"),
    };
    let lasting = effective.halves_s().filter(|seconds| seconds.abs() < 1e5);
    let lasting = lasting.map(|seconds| {
        let word = if seconds > 0.0 { "halves" } else { gain };
        format!("{thing} {word} in {} s", significant(seconds.abs(), 3))
    });
    let lasting = lasting.or_else(|| Some(format!("{thing} stays")));
    [swing, ratio, lasting].into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn words(found: &Identification, log: &Log, mass: f64) -> String {
    let Identification { word, best, runner_up, effective, exact, recommended, .. } = found;
    let residual = |fitted: &Fitted| format!("residual {:.1e}", fitted.residual);
    let rival = runner_up.as_ref();
    let mut lines = vec![match (word, rival) {
        (Word::Identified, _) => format!("made by {}, {}", best.candidate, residual(best)),
        (Word::CannotTell, Some(rival)) => format!(
            "cannot tell {} from {}: {} and {:.1e}; {}",
            best.candidate,
            rival.candidate,
            residual(best),
            rival.residual,
            match (log.has_velocities(), found.is_spring_fitted) {
                (_, true) => "give the spring with --k",
                (false, false) => "log v too, or for longer",
                (true, false) => "log for longer",
            }
        ),
        _ => format!("unknown: the nearest is {}, {}", best.candidate, residual(best)),
    }];
    let told = *word != Word::Unknown;
    if told && !found.also.is_empty() {
        lines.push(format!("the same on this body: {}", names(&found.also)));
    }
    if told && !found.unusual.is_empty() {
        lines.push(format!("would fit too, but few set them: {}", names(&found.unusual)));
    }
    if let (Word::Identified, Some(rival)) = (word, rival) {
        lines.push(format!("runner-up: {}, {}", rival.candidate, residual(rival)));
    }
    if let Some(effective) = effective {
        lines.push(format!("a player sees: {}", seen(effective)));
        if let Some(stiffness) = effective.spring_stiffness() {
            lines.push(format!("as stiff as {} N/m", significant(stiffness * mass, 4)));
        }
    }
    if let Some(exact) = exact {
        let fitted =
            if found.is_spring_fitted { "by the spring that fits" } else { "the equation says" };
        lines.push(format!("{fitted}: {}", seen(exact)));
    }
    for (method, effective) in recommended {
        lines.push(format!("under {}: {}", method.id, seen(effective)));
    }
    lines.push(String::new());
    lines.join("\n")
}
