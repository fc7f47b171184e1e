//! Table 7-1 with its averages, and the distances that belong to it, next to the printed numbers.

use std::fmt::Write;

use super::{Moment, by_method, exactly, method_of, scene};
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

/// Returns Table 7-1 and the averages below it.
pub(super) fn table_7_1() -> String {
    let scene = scene("ship");
    let hz = f64::from(scene.tick_hz);
    let truth = exactly(&scene, END_S, scene.tick_hz);
    let euler = by_method(&scene, "explicit-euler", END_S);
    let mut text = format!(
        "Table 7-1: speed of the ship by Euler's method, dt = {} s (✓ as printed)\n\n\
         {:>6}  {:<12}  {:<12}  {}\n",
        1.0 / hz,
        "t (s)",
        "exact (m/s)",
        "Euler (m/s)",
        "error",
    );
    for (t, [exact, by_euler, error]) in TABLE_7_1 {
        let tick = (t * hz).round() as usize;
        let found = [
            marked(&seven_digits(truth[tick].v), exact),
            marked(&seven_digits(euler[tick].v), by_euler),
            marked(&percent(off(&euler, &truth, tick)), error),
        ];
        let _ = writeln!(text, "{t:>6.1}  {:<12}  {:<12}  {}", found[0], found[1], found[2]);
    }
    text += "\nMean error of the speed over these rows (global and relative; the chapter calls it average \
             truncation error)\n\n";
    for (id, printed) in AVERAGES {
        let speeds = by_method(&scene, id, END_S);
        let errors = TABLE_7_1.map(|(t, _)| off(&speeds, &truth, (t * hz).round() as usize).abs());
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let _ = writeln!(text, "  {:<16}  {}", method_of(id).name, marked(&percent(mean), printed));
    }
    text
}

/// Returns the relative error of the speed after `tick` ticks, in percent.
fn off(found: &[Moment], truth: &[Moment], tick: usize) -> f64 {
    100.0 * (found[tick].v - truth[tick].v) / truth[tick].v
}

/// Returns the table of the distances run, which the chapter does not print. The chapter's listings carry only the
/// speed through their stages, so that the distance loses their order.
pub(super) fn displacements() -> String {
    let scene = scene("ship");
    let hz = f64::from(scene.tick_hz);
    let last = |moments: Vec<Moment>| moments.last().expect("the start at least").q;
    let truth = last(exactly(&scene, END_S, scene.tick_hz));
    let mut text = format!(
        "Distance run after {END_S} s, dt = {} s: exactly {truth:.7} m\n\n  {:<28}  {:>10}  {:>10}  {:>12}\n",
        1.0 / hz,
        "method",
        "s (m)",
        "error (m)",
        "error",
    );
    for id in DISTANCES {
        let found = last(by_method(&scene, id, END_S));
        let error = found - truth;
        let _ = writeln!(
            text,
            "  {:<28}  {found:>10.6}  {:>10}  {:>12}",
            method_of(id).name,
            significant(error, 4),
            format!("{} %", significant(100.0 * error / truth, 3)),
        );
    }
    text + "\n  Semi-implicit Euler is what the chapter's listing of Euler's method does.\n"
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

/// Returns the number with a check mark if the chapter prints the same number, or else followed by the printed one.
fn marked(found: &str, printed: &str) -> String {
    if found == printed { format!("{found} ✓") } else { format!("{found} (printed: {printed})") }
}

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
        assert_eq!(marked("9.5", "9.5"), "9.5 ✓");
        assert_eq!(marked("9.5", "9.6"), "9.5 (printed: 9.6)");
    }
}
