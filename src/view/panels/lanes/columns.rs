//! The columns of the table: what each shows, what it is sorted by, and which of them fit a width.

use super::row::Row;
use crate::lab::number::significant;
use crate::lab::{Lab, Mode};

/// What a column is sorted by. Rows without a value come last.
#[derive(Debug, PartialEq, PartialOrd)]
pub(super) enum Rank {
    Number(f64),
    Words(String),
    Nothing,
}

/// What a cell shows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cell {
    Key,
    Swatch,
    Method,
    Body,
    Verdict,
    /// A number, at the right.
    Number(fn(&Row<'_>) -> Option<String>),
}

/// One column.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) head: &'static str,
    /// Its tooltip.
    pub(super) about: &'static str,
    /// Its width in points; the verdict takes the rest.
    pub(super) width: f32,
    /// The order in which columns are taken in while there is room, from 0; those with 0 are always there.
    turn: u8,
    is_wanted: fn(&Lab) -> bool,
    pub(super) cell: Cell,
    pub(super) rank: fn(&Row<'_>) -> Rank,
}

/// The room between two columns, and the least width of the verdict, in points.
pub(super) const GAP: f32 = 8.0;
const MIN_VERDICT: f32 = 320.0;
/// The least width that the verdict keeps beside columns of what the stage or an instrument shows too, in points.
const ROOMY_VERDICT: f32 = 700.0;
/// The first turn of such columns.
const TURN_OF_EXTRAS: u8 = 5;

fn always(_: &Lab) -> bool {
    true
}

fn has_bodies(lab: &Lab) -> bool {
    lab.mode() == Mode::Solo && lab.scene().bodies.len() > 1
}

fn follows(lab: &Lab) -> bool {
    lab.race().truth().bodies().iter().any(|body| body.chase().is_some())
}

/// Whether a body may have an energy.
fn has_energies(lab: &Lab) -> bool {
    lab.race().truth().bodies().iter().any(|body| body.chase().is_none())
}

pub(super) static COLUMNS: &[Column] = &[
    Column {
        head: "Key",
        about: "the key that switches to this method, or selects its lane in a race",
        width: 26.0,
        turn: 0,
        is_wanted: always,
        cell: Cell::Key,
        rank: |row| Rank::Number(row.entry as f64),
    },
    Column {
        head: "",
        about: "the line of this method in the plots and on the stage",
        width: 36.0,
        turn: 0,
        is_wanted: always,
        cell: Cell::Swatch,
        rank: |row| Rank::Number(row.entry as f64),
    },
    Column {
        head: "Method",
        about: "the integrator of this lane; × is its substeps, a small number its tolerance",
        width: 158.0,
        turn: 0,
        is_wanted: always,
        cell: Cell::Method,
        rank: |row| Rank::Words(row.spec.method.name.into()),
    },
    Column {
        head: "Body",
        about: "the body of this row; of a method that does not run, the body that its verdict is about",
        width: 106.0,
        turn: 1,
        is_wanted: has_bodies,
        cell: Cell::Body,
        rank: |row| Rank::Words(row.body_name().unwrap_or_default().into()),
    },
    Column {
        head: "Verdict",
        about: "what this method does to the scene at this tick rate: its worst body, judged in a run of its own; a click sorts from best to worst",
        width: 0.0,
        turn: 0,
        is_wanted: always,
        cell: Cell::Verdict,
        rank: |row| number(row.said().rank()),
    },
    Column {
        head: "position",
        about: "first coordinate of the body in this lane",
        width: 88.0,
        turn: 5,
        is_wanted: always,
        cell: Cell::Number(|row| row.in_unit(row.position()?)),
        rank: |row| number(row.position()),
    },
    Column {
        head: "exact",
        about: "the same coordinate of the exact solution",
        width: 88.0,
        turn: 7,
        is_wanted: |lab| lab.mode() == Mode::Solo,
        cell: Cell::Number(|row| row.in_unit(row.exact()?)),
        rank: |row| number(row.exact()),
    },
    Column {
        head: "error",
        about: "largest difference from the exact solution in a coordinate",
        width: 88.0,
        turn: 2,
        is_wanted: always,
        cell: Cell::Number(|row| match row.measure("position_error") {
            Some(error) => row.in_unit(error),
            None => row.no_truth(),
        }),
        rank: |row| number(row.measure("position_error")),
    },
    Column {
        head: "half-life",
        about: "time in which the body covered half of the way to its target; of a method that does not run, the verdict's",
        width: 88.0,
        turn: 1,
        is_wanted: follows,
        cell: Cell::Number(|row| Some(format!("{} ms", significant(row.half_life_ms()?, 3)))),
        rank: |row| number(row.half_life_ms()),
    },
    Column {
        head: "overshoot",
        about: "how far the body went beyond its target, in percent of the way",
        width: 88.0,
        turn: 1,
        is_wanted: follows,
        cell: Cell::Number(|row| Some(format!("{} %", significant(row.overshoot_percent()?, 3)))),
        rank: |row| number(row.overshoot_percent()),
    },
    Column {
        head: "energy",
        about: "energy gained or lost, in percent of the energy that the exact swing exchanges",
        width: 98.0,
        turn: 3,
        is_wanted: has_energies,
        cell: Cell::Number(|row| {
            let Some(drift) = row.measure("energy_drift") else {
                return row.no_truth().filter(|_| row.conserves_energy());
            };
            let sign = if drift > 0.0 { "+" } else { "" };
            Some(format!("{sign}{} %", significant(drift, 3)))
        }),
        rank: |row| number(row.measure("energy_drift")),
    },
    Column {
        head: "evaluations",
        about: "evaluations of this body's acceleration since the start",
        width: 84.0,
        turn: 6,
        is_wanted: always,
        cell: Cell::Number(|row| row.evaluations().map(|count| format!("{count}"))),
        rank: |row| number(row.evaluations().map(|count| count as f64)),
    },
    Column {
        head: "cost",
        about: "evaluations per tick; explicit Euler with one substep costs 1 ×",
        width: 48.0,
        turn: 4,
        is_wanted: always,
        cell: Cell::Number(|row| Some(format!("{} ×", crate::lab::number::round(row.cost()?, 3)))),
        rank: |row| number(row.cost()),
    },
];

fn number(value: Option<f64>) -> Rank {
    value.filter(|value| !value.is_nan()).map_or(Rank::Nothing, Rank::Number)
}

/// The columns that fit this width, each with its left edge and its own width.
pub(super) fn fitting(lab: &Lab, width: f32) -> Vec<(&'static Column, f32, f32)> {
    let wanted = |column: &&Column| (column.is_wanted)(lab);
    let mut taken: Vec<u8> = vec![0];
    let room_for_verdict = |taken: &[u8]| {
        let columns = COLUMNS.iter().filter(wanted).filter(|column| taken.contains(&column.turn));
        width - columns.map(|column| column.width + GAP).sum::<f32>()
    };
    for turn in 1..=7 {
        let more = [&taken[..], &[turn]].concat();
        let least = if turn < TURN_OF_EXTRAS { MIN_VERDICT } else { ROOMY_VERDICT };
        if room_for_verdict(&more) >= least {
            taken = more;
        }
    }
    let verdict = room_for_verdict(&taken).max(0.0);
    let mut left = 0.0;
    let columns = COLUMNS.iter().filter(wanted).filter(|column| taken.contains(&column.turn));
    let placed = columns.map(|column| {
        let own = if matches!(column.cell, Cell::Verdict) { verdict } else { column.width };
        let here = left;
        left += own + GAP;
        (column, here, own)
    });
    placed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Command, Scene};

    #[test]
    fn what_the_stage_shows_too_has_a_column_only_where_there_is_room_for_it() {
        let mut lab = Lab::new(Scene::built_in("harbour").unwrap());
        lab.apply(Command::ToggleRace);
        let heads = |width: f32| -> Vec<&str> {
            fitting(&lab, width).iter().map(|(column, ..)| column.head).collect()
        };
        let narrow = ["Key", "", "Method", "Verdict", "error", "energy", "cost"];
        assert_eq!(heads(1264.0), narrow);
        let wide = ["position", "error", "energy", "evaluations", "cost"];
        assert_eq!(heads(1904.0)[4..], wide);
    }
}
