//! Table 7-1 with its averages, and the distances that belong to it, next to the printed numbers.

use std::fmt::Write;

use serde::Serialize;

use super::{BesidePrinted, Moment, by_method, exactly, method_of, scene};
use crate::sim::number::significant;

/// Time of the table's last row, in seconds.
const END_S: f64 = 8.5;

/// The methods whose distances are compared. They are the listings as printed, and the same methods with the whole
/// state carried through every stage.
const DISTANCES: [&str; 6] = [
    "explicit-euler",
    "semi-implicit-euler",
    "improved-euler-as-printed",
    "rk4-as-printed",
    "improved-euler",
    "rk4",
];

/// Table 7-1 and the averages below it.
pub(super) struct Table {
    pub(super) rows: Vec<TableRow>,
    pub(super) means: Vec<MeanError>,
    /// Length of a tick in seconds.
    step_s: f64,
}

/// A row of Table 7-1.
#[derive(Serialize)]
pub(super) struct TableRow {
    t_s: f64,
    exact_m_per_s: BesidePrinted,
    euler_m_per_s: BesidePrinted,
    error_percent: BesidePrinted,
}

/// Mean error of the speed by a method over the rows of the table.
#[derive(Serialize)]
pub(super) struct MeanError {
    method: &'static str,
    error_percent: BesidePrinted,
}

/// Computes Table 7-1.
pub(super) fn table_7_1() -> Table {
    let scene = scene("ship");
    let hz = f64::from(scene.tick_hz);
    let truth = exactly(&scene, END_S, scene.tick_hz);
    let euler = by_method(&scene, "explicit-euler", END_S);
    let speed = |value, printed| BesidePrinted { value, shown: seven_digits(value), printed };
    let error = |value, printed| BesidePrinted { value, shown: percent(value), printed };
    let row = |(t_s, [exact, by_euler, off_by]): (f64, [&'static str; 3])| {
        let tick = (t_s * hz).round() as usize;
        TableRow {
            t_s,
            exact_m_per_s: speed(truth[tick].v, exact),
            euler_m_per_s: speed(euler[tick].v, by_euler),
            error_percent: error(off(&euler, &truth, tick), off_by),
        }
    };
    let mean = |(method, printed): (&'static str, &'static str)| {
        let speeds = by_method(&scene, method, END_S);
        let errors = TABLE_7_1.map(|(t, _)| off(&speeds, &truth, (t * hz).round() as usize).abs());
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        MeanError { method, error_percent: error(mean, printed) }
    };
    let (rows, means) = (TABLE_7_1.map(row).into(), AVERAGES.map(mean).into());
    Table { rows, means, step_s: 1.0 / hz }
}

impl Table {
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "Table 7-1: speed of the ship by Euler's method, dt = {} s (✓ as printed)\n\n\
             {:>6}  {:<12}  {:<12}  {}\n",
            self.step_s, "t (s)", "exact (m/s)", "Euler (m/s)", "error",
        );
        for row in &self.rows {
            let found = [&row.exact_m_per_s, &row.euler_m_per_s, &row.error_percent];
            let [exact, euler, error] = found.map(BesidePrinted::marked);
            let _ = writeln!(text, "{:>6.1}  {exact:<12}  {euler:<12}  {error}", row.t_s);
        }
        text += "\nMean error of the speed over these rows (global and relative; the chapter calls it average \
                 truncation error)\n\n";
        for mean in &self.means {
            let name = method_of(mean.method).name;
            let _ = writeln!(text, "  {name:<16}  {}", mean.error_percent.marked());
        }
        text
    }
}

/// Returns the relative error of the speed after `tick` ticks, in percent.
fn off(found: &[Moment], truth: &[Moment], tick: usize) -> f64 {
    100.0 * (found[tick].v - truth[tick].v) / truth[tick].v
}

/// The distances run, which the chapter does not print. The chapter's listings carry only the speed through their
/// stages, so that the distance loses their order.
pub(super) struct Distances {
    pub(super) rows: Vec<Distance>,
    exact_m: f64,
    /// Length of a tick in seconds.
    step_s: f64,
}

/// The distance run by a method.
#[derive(Serialize)]
pub(super) struct Distance {
    method: &'static str,
    distance_m: f64,
    error_m: f64,
    error_percent: f64,
}

/// Computes the distances run until the end of Table 7-1.
pub(super) fn displacements() -> Distances {
    let scene = scene("ship");
    let last = |moments: Vec<Moment>| moments.last().expect("the start at least").q;
    let exact_m = last(exactly(&scene, END_S, scene.tick_hz));
    let row = |method| {
        let distance_m = last(by_method(&scene, method, END_S));
        let error_m = distance_m - exact_m;
        Distance { method, distance_m, error_m, error_percent: 100.0 * error_m / exact_m }
    };
    let step_s = 1.0 / f64::from(scene.tick_hz);
    Distances { rows: DISTANCES.map(row).into(), exact_m, step_s }
}

impl Distances {
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "Distance run after {END_S} s, dt = {} s: exactly {:.7} m\n\n  {:<28}  {:>10}  {:>10}  {:>12}\n",
            self.step_s, self.exact_m, "method", "s (m)", "error (m)", "error",
        );
        for row in &self.rows {
            let _ = writeln!(
                text,
                "  {:<28}  {:>10.6}  {:>10}  {:>12}",
                method_of(row.method).name,
                row.distance_m,
                significant(row.error_m, 4),
                format!("{} %", significant(row.error_percent, 3)),
            );
        }
        text + "\n  Semi-implicit Euler is what the chapter's listing of Euler's method does.\n"
    }
}

/// A row of Table 7-1: the time (s), the exact speed (m/s), the speed by Euler's method (m/s), and the error.
const TABLE_7_1: [(f64, [&str; 3]); 5] = [
    (6.5, ["9.559084", "9.733158", "1.82%"]),
    (7.0, ["10.06829", "10.2465", "1.77%"]),
    (7.5, ["10.55267", "10.73418", "1.72%"]),
    (8.0, ["11.01342", "11.19747", "1.67%"]),
    (8.5, ["11.4517", "11.63759", "1.62%"]),
];

/// Average errors of three methods over the rows of the table.
const AVERAGES: [(&str, &str); 3] =
    [("explicit-euler", "1.72%"), ("improved-euler", "0.03%"), ("rk4", "3.6e-6%")];

/// Formats a number like C's `%.7g`, for magnitudes from 1e-4 up to 1e7.
fn seven_digits(x: f64) -> String {
    let digits_before = libm::floor(libm::log10(x.abs())) as i32;
    // Rounding may carry into a further digit.
    let carried = format!("{x:.6e}").rsplit('e').next().and_then(|e| e.parse().ok());
    let decimals = usize::try_from(6 - carried.unwrap_or(digits_before)).unwrap_or(0);
    let fixed = format!("{x:.decimals$}");
    match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => fixed,
    }
}

/// Formats a number like C's `%.2f%%`. If that would print 0, the number has two digits and a power of ten.
fn percent(x: f64) -> String {
    if x.abs() < 0.005 { format!("{x:.1e}%") } else { format!("{x:.2}%") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_as_c_prints_them() {
        for (x, shown) in [
            (10.246500418, "10.2465"),
            (9.7331583, "9.733158"),
            (11.45170136, "11.4517"),
            (9.99999999, "10"),
            (0.000123456789, "0.0001234568"),
            (1234567.8, "1234568"),
        ] {
            assert_eq!(seven_digits(x), shown);
        }
        assert_eq!(percent(1.7210), "1.72%");
        assert_eq!(percent(3.648e-6), "3.6e-6%");
    }

    #[test]
    fn a_differing_number_shows_the_printed_one_too() {
        let marked = |printed| BesidePrinted { value: 9.5, shown: "9.5".into(), printed }.marked();
        assert_eq!(marked("9.5"), "9.5 ✓");
        assert_eq!(marked("9.6"), "9.5 (printed: 9.6)");
    }
}
