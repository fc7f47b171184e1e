//! The options that say how a table is read, the same for every command that reads one.

use clap::Args;
use serde_json::{Value, json};

use super::argument::number_that;
use crate::table::{TableOptions, Taken, Unit};

/// How a table is read, in place of what the reader finds by itself. A column is a name, or a number from 1.
#[derive(Debug, Args)]
#[command(next_help_heading = "How the table is read")]
pub(super) struct TableArgs {
    /// The column of the times of frames, by name or number
    #[arg(hide_short_help = true, long, value_name = "NAME|N")]
    frame_column: Option<String>,

    /// The column of a running clock, in place of times
    #[arg(hide_short_help = true, long, value_name = "NAME|N", conflicts_with = "frame_column")]
    clock_column: Option<String>,

    /// The unit of the times: ns, us, ms, s or ticks [default: found]
    #[arg(hide_short_help = true, long, value_name = "UNIT", value_parser = unit)]
    unit: Option<Unit>,

    /// The column of the tick's number [default: tick]
    #[arg(hide_short_help = true, long, value_name = "NAME|N")]
    tick_column: Option<String>,

    /// The column of the time [default: t]
    #[arg(hide_short_help = true, long, value_name = "NAME|N", conflicts_with_all = ["clock_column", "frame_column"])]
    t_column: Option<String>,

    /// The column of the coordinate in metres [default: x]
    #[arg(hide_short_help = true, long, value_name = "NAME|N")]
    x_column: Option<String>,

    /// The column of the velocity in metres per second [default: v]
    #[arg(hide_short_help = true, long, value_name = "NAME|N")]
    v_column: Option<String>,

    /// The first line is already a row
    #[arg(hide_short_help = true, long)]
    no_header: bool,

    /// Take the rows from this time on, counted from the first row
    #[arg(hide_short_help = true, long, value_name = "s", value_parser = seconds)]
    start: Option<f64>,

    /// Take the rows before this time, counted from the first row
    #[arg(hide_short_help = true, long, value_name = "s", value_parser = seconds)]
    end: Option<f64>,

    /// Take these rows, such as 3001..8447
    #[arg(hide_short_help = true, long, value_name = "A..B", value_parser = rows)]
    rows: Option<[u64; 2]>,

    /// Take the rows whose cell in COLUMN is VALUE
    ///
    /// Give it again for rows that must have both.
    #[arg(hide_short_help = true, long = "where", value_name = "COLUMN=VALUE", value_parser = filter)]
    filter: Vec<(String, String)>,

    /// The separator of the cells: a character, tab or space [default: found]
    #[arg(hide_short_help = true, long, value_name = "SIGN", value_parser = separator)]
    separator: Option<u8>,
}

impl TableArgs {
    /// Returns the options of the reader.
    pub(super) fn options(&self) -> TableOptions {
        TableOptions {
            separator: self.separator,
            no_header: self.no_header,
            rows: self.rows,
            window_s: [self.start, self.end],
            filter: self.filter.clone(),
            signed: false,
            shown: None,
            unit: self.unit,
            frame: self.frame_column.clone(),
            clock: self.clock_column.clone(),
            tick: self.tick_column.clone(),
            t: self.t_column.clone(),
            x: self.x_column.clone(),
            v: self.v_column.clone(),
        }
    }
}

fn unit(written: &str) -> Result<Unit, String> {
    let unit = if written == "ticks" { Some(Unit::Ticks) } else { Unit::of_word(written) };
    unit.ok_or_else(|| "give ns, us, ms, s or ticks".into())
}

fn seconds(written: &str) -> Result<f64, String> {
    let number = written.strip_suffix('s').unwrap_or(written);
    number_that(number, |s| s >= 0.0, "seconds after the first row, such as 40s")
}

fn rows(written: &str) -> Result<[u64; 2], String> {
    let wrong = || "give the first and the last row, from 1, such as 3001..8447".to_owned();
    let (first, last) = written.split_once("..").ok_or_else(wrong)?;
    let row = |text: &str, absent: u64| match text.trim() {
        "" => Ok(absent),
        text => text.parse::<u64>().map_err(|_| wrong()),
    };
    let (first, last) = (row(first, 1)?, row(last.trim_start_matches('='), u64::MAX)?);
    if first >= 1 && first <= last { Ok([first, last]) } else { Err(wrong()) }
}

fn filter(written: &str) -> Result<(String, String), String> {
    let (column, cell) = written.split_once('=').ok_or("write COLUMN=VALUE, such as body=a")?;
    Ok((column.to_owned(), cell.to_owned()))
}

fn separator(written: &str) -> Result<u8, String> {
    match written.as_bytes() {
        _ if written == "tab" || written == "\\t" => Ok(b'\t'),
        _ if written == "space" => Ok(b' '),
        [sign] if sign.is_ascii_punctuation() && *sign != b'"' || b" \t".contains(sign) => {
            Ok(*sign)
        }
        _ => Err("give one sign, such as , or ; or |, or tab or space".into()),
    }
}

/// Returns what was read of a table as JSON.
pub(super) fn taken_object(taken: &Taken) -> Value {
    json!({
        "rows": taken.rows,
        "of": taken.of,
        "unit": taken.unit.map(|(unit, _)| unit.name()),
        "unit_found": taken.unit.map(|(_, how)| how),
        "left_out": taken.left_out,
        "notes": taken.notes,
    })
}
