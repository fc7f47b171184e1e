//! `regatta diff`: finds where two runs first differ, and how the difference grows.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};

use super::argument::number_that;
use super::error::Error;
use super::help::flowing;
use super::output::table::TableFormat;
use super::scene_file::name_in_messages;
use super::table_args::{TableArgs, taken_object};
use super::terminal::print_status;
use super::visible::visible_in_a_line;
use crate::run::diff::{Chosen, Comparison, Difference, LEVELS, MAX_WAITING, Tolerance, diff};
use crate::scene::clip_list;
use crate::sim::number::counted;
use crate::table::Taken;

mod source;

use source::Source;

const ABOUT: &str = "\
A run is a table, a scene, a recording or the directory of a capture (diff runs these again, a capture to
its last state), or - for a table on standard input. A table comes from `regatta trace`, or has a column
for each number; commas, semicolons, tabs or spaces separate its cells. It may be JSON too, such as
an object on each line. A dump, whose first line is as Frame: 1000, is compared line by line, by frames.

Diff matches rows by the columns tick, lane, body and coordinate, as far as the tables have them; without
tick by t, and without t by the number of the row. Those of `regatta trace --impacts` match by n, lane and
body. --key names other columns, such as frame,object; one called frame or step then counts ticks. Diff
compares all columns but these, t and method; --columns and --ignore choose others. A column holds text
if one of its cells is no number, as hashes are. A row on one side alone counts under the side that lacks
it. Lines that begin with # are notes above the header, and rows below it. A file must be a regular one,
and a row has at most 1 MiB.

Numbers must be equal to the bit, unless --ulps or --relative allows more. NaN equals NaN, and -0 equals 0.
A difference reaches 1e-12 at the first tick where it is that fraction of the largest value so far in this
column of this coordinate. The column that differs most has the largest such fraction. If the difference
grows exponentially through three decades, diff prints its rate, by the times of a column t.

In JSON, columns are those that differ, with their first tick and their rows, and equal the others.

Exit code 0: the same. 1: different. 2: cannot be compared, for example because nothing moves. A column of
numbers that is called like a clock and never goes back does not count as motion; one of text that changes
does. Nor does one of several that grows by the same amount in each row, unless it is called like a
coordinate, such as x or position.

Examples:
  regatta diff before.csv after.csv
  regatta trace --method rk4 | regatta diff before.csv -
  regatta diff a.csv b.csv --key frame,object --ignore wall_ms
  regatta diff clip log-of-yesterday.csv --format json";

/// Say where two runs first differ
///
/// And how the difference grows.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct DiffArgs {
    /// A run: a CSV file, a scene or recording, the directory of a capture, or -
    #[arg(value_name = "A")]
    a: PathBuf,

    /// The other
    #[arg(value_name = "B")]
    b: PathBuf,

    /// Numbers at most N doubles apart are equal
    #[arg(long, value_name = "N", default_value_t = 0)]
    ulps: u64,

    /// Numbers that differ by at most this fraction of the larger are equal
    #[arg(long, value_name = "R", default_value = "0", value_parser = part)]
    #[arg(allow_negative_numbers = true)]
    relative: f64,

    /// The columns that match rows [default: tick,lane,body,coordinate]
    #[arg(long, value_name = "COLUMN,…", value_delimiter = ',')]
    key: Vec<String>,

    /// Compare these columns only
    #[arg(long, value_name = "COLUMN,…", value_delimiter = ',')]
    columns: Vec<String>,

    /// Do not compare these columns
    #[arg(long, value_name = "COLUMN,…", value_delimiter = ',', conflicts_with = "columns")]
    ignore: Vec<String>,

    #[command(flatten)]
    table: TableArgs,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

fn part(written: &str) -> Result<f64, String> {
    number_that(written, |part| part >= 0.0, "a part of 0 or more, such as 1e-9")
}

pub(super) fn run(args: &DiffArgs) -> Result<(), Error> {
    let paths = [&args.a, &args.b];
    if paths.iter().all(|path| path.as_os_str() == "-") {
        return Err(Error::mistake("both are standard input; give a file for one"));
    }
    let options = args.table.options();
    let mut a = Source::open(&args.a, &options)?;
    let mut b = Source::open(&args.b, &options)?;
    let tolerance = Tolerance { ulps: args.ulps, relative: args.relative };
    let named = |wanted: &Option<String>| wanted.as_deref().map(|wanted| a.name_of(wanted));
    let wanted = [&options.x, &options.v].into_iter().filter_map(named);
    let mut chosen = Chosen {
        key: args.key.clone(),
        tick: named(&options.tick),
        columns: args.columns.iter().cloned().chain(wanted).collect(),
        ignored: args.ignore.iter().cloned().chain(named(&options.frame)).collect(),
    };
    if let (Some(moment), true, true) = (a.moment_of_dump(), b.is_dump(), chosen.key.is_empty()) {
        (chosen.tick, chosen.key) = (Some(moment.to_owned()), vec!["line".into()]);
    }
    let found = diff(&mut a, &mut b, tolerance, &chosen).map_err(|error: Error| {
        error.and(format!("a is {}, b is {}", name_in_messages(&args.a), name_in_messages(&args.b)))
    })?;
    for (name, source) in [("a", &a), ("b", &b)] {
        if let Some(taken) = source.taken().filter(|taken| taken.rows != [1, taken.of]) {
            print_status(&format!("{name}: read {}", taken.rows_in_words()));
        }
    }
    let text = match args.format {
        TableFormat::Text => report_text(&found, &args.a, &args.b),
        TableFormat::Json => object(&found, [&a, &b].map(|source| source.taken())),
    };
    args.format.print(&text).map_err(Error::into_mistake)?;
    let names = format!("{} and {}", name_in_messages(&args.a), name_in_messages(&args.b));
    match (found.is_comparable(), found.is_same()) {
        (false, _) if found.is_cut_off => Err(Error::mistake(format!(
            "rows of one name stand more than {MAX_WAITING} rows apart, or 64 MiB, in {names}; sort both alike"
        ))),
        (false, _) if found.rows < 2 => Err(Error::mistake(format!(
            "nothing to compare: {names} have {} in common; give two logs of one run",
            counted(found.rows, "row")
        ))),
        (false, _) => Err(Error::mistake(format!(
            "nothing to compare: nothing moves in the {} rows of {names}; log a motion",
            found.rows
        ))),
        (true, false) => Err(Error::failed(format!("{names} differ"))),
        (true, true) => Ok(()),
    }
}

fn report_text(found: &Comparison, a: &Path, b: &Path) -> String {
    let mut lines =
        vec![format!("a: {}", name_in_messages(a)), format!("b: {}", name_in_messages(b))];
    match &found.first {
        _ if !found.is_comparable() => lines.push("nothing to compare".into()),
        None if found.is_same() => lines.push("the same".into()),
        None => lines.push("equal wherever both have a value".into()),
        Some(first) => {
            lines.push(format!("first {first}"));
            if found.columns.len() + found.equal.len() > 1 && !found.columns.is_empty() {
                lines.push(by_column(found, first.tick_name.as_deref()));
            }
            let reached = LEVELS.iter().zip(found.reaches);
            let moment = first.tick_name.as_deref().unwrap_or("row");
            let reached = reached
                .filter_map(|(level, tick)| Some(format!("{level:e} at {moment} {}", tick?)));
            let reached: Vec<String> = reached.collect();
            if !reached.is_empty() {
                lines.push(format!("the difference reaches {}", reached.join(", ")));
            }
            if let Some(rate) = found.per_second {
                lines.push(format!("it grows by e^({rate:.3} t), t in seconds"));
            }
        }
    }
    if let Some((column, part)) = &found.worst {
        let how = match part.is_finite() {
            true => format!("by {part:.1e} of its largest value"),
            false => "since one of two values is not finite".into(),
        };
        lines.push(format!("{column} differs most, {how}"));
    }
    let rows = counted(found.rows, "row");
    lines.push(format!("{rows} compared; the farthest motion is {}", found.moved));
    for (side, name) in ["a", "b"].into_iter().enumerate() {
        let tick = found.first_missing[side].map(|tick| format!(", the first at tick {tick}"));
        if let (missing @ 1.., Some(tick)) = (found.missing[side], tick) {
            lines.push(format!("{name} lacks {}{tick}", counted(missing, "row")));
        }
        if !found.alone[side].is_empty() {
            lines.push(format!("only {name} has the columns {}", found.alone[side].join(", ")));
        }
    }
    if found.is_by_place && !found.is_same() {
        lines.push("rows are matched by their number; --key matches them by columns".into());
    }
    for (count, what) in [
        (found.displaced, "rows in another order"),
        (found.zeros_of_two_signs, "zeros of two signs, taken as equal"),
        (found.nans, "NaN on both sides, taken as equal"),
    ] {
        if count > 0 {
            lines.push(format!("{what}: {count}"));
        }
    }
    // The text of a cell or of a file name may contain line breaks.
    lines.iter().map(|line| visible_in_a_line(line) + "\n").collect()
}

/// Lists the columns that differ, each with the first tick of a difference, and the columns that are equal.
fn by_column(found: &Comparison, tick_name: Option<&str>) -> String {
    let from = |tick: u64| tick_name.map_or(String::new(), |name| format!(" from {name} {tick}"));
    let differ = found
        .columns
        .iter()
        .map(|it| format!("{}{} in {}", it.column, from(it.first_tick), counted(it.rows, "row")));
    let differ: Vec<String> = differ.collect();
    let differ = clip_list(differ.iter().map(String::as_str));
    match found.equal.len() {
        0 => format!("by column: {differ}"),
        _ => {
            let equal = clip_list(found.equal.iter().map(String::as_str));
            format!("by column: {differ}; equal in {equal}")
        }
    }
}

/// Returns the comparison as JSON. Its numbers are spelled as in the tables.
fn object(found: &Comparison, taken: [Option<Taken>; 2]) -> String {
    const WRITTEN: [&str; 2] = ["\u{1}a", "\u{1}b"];
    let finite = |part: f64| part.is_finite().then_some(part);
    let first = found.first.as_ref().map(|first| {
        let Difference { tick, column, values, ulps, relative, .. } = first;
        let [lane, body, coordinate] = ["lane", "body", "coordinate"].map(|name| first.cell(name));
        let lane = lane.map(|lane| lane.parse::<u64>().map_or(json!(lane), Value::from));
        let key: serde_json::Map<String, Value> =
            first.key.iter().map(|(name, cell)| (name.clone(), json!(cell))).collect();
        let [a, b] = [0, 1].map(|side| values[side].as_ref().map(|_| WRITTEN[side]));
        json!({
            "tick": tick, "lane": lane, "body": body, "coordinate": coordinate, "key": key, "column": column,
            "a": a, "b": b, "ulps": ulps, "relative": relative,
        })
    });
    let reaches = LEVELS.iter().zip(found.reaches);
    let reaches = reaches.map(|(level, tick)| json!({ "relative": level, "tick": tick }));
    let worst = found.worst.as_ref();
    let object = json!({
        "same": found.is_same(),
        "comparable": found.is_comparable(),
        "rows": found.rows,
        "moved": found.moved,
        "first": first,
        "columns": found.columns.iter().map(|it| {
            json!({ "column": it.column, "first_tick": it.first_tick, "rows": it.rows })
        }).collect::<Vec<_>>(),
        "equal": found.equal,
        "reaches": reaches.collect::<Vec<_>>(),
        "per_second": found.per_second,
        "missing": { "a": found.missing[0], "b": found.missing[1] },
        "read": {
            "a": taken[0].as_ref().map(taken_object),
            "b": taken[1].as_ref().map(taken_object),
        },
        "worst": worst.map(|(column, part)| json!({ "column": column, "relative": finite(*part) })),
    });
    let mut text = format!("{object:#}\n");
    for (side, mark) in WRITTEN.into_iter().enumerate() {
        let written = found.first.as_ref().and_then(|first| first.values[side].as_ref());
        let Some(written) = written else { continue };
        let is_number = serde_json::from_str::<serde_json::Number>(written).is_ok();
        let value = if is_number { written.clone() } else { Value::from(&**written).to_string() };
        text = text.replacen(&Value::from(mark).to_string(), &value, 1);
    }
    text
}
