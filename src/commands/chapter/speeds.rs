//! Table 7-1, its averages, and the distances run that go with it.

use std::fmt::Write;

use super::printed::{AVERAGES, TABLE_7_1, marked, percent, seven_digits};
use super::run::{Moment, by_method, exactly, method_of, scene};
use crate::sim::number::significant;

/// The time of the table's last row, in seconds.
const END_S: f64 = 8.5;

/// The methods whose distances are compared: the listings as printed, and the same methods with the
/// whole state carried through every stage.
const DISTANCES: [&str; 6] = [
    "explicit-euler",
    "semi-implicit-euler",
    "improved-euler-as-printed",
    "rk4-as-printed",
    "improved-euler",
    "rk4",
];

/// Table 7-1 and the averages below it.
pub(super) fn table_7_1() -> String {
    let scene = scene("ship");
    let hz = f64::from(scene.tick_hz);
    let truth = exactly(&scene, END_S, hz);
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

/// The error of the speed after `tick` ticks, in percent.
fn off(found: &[Moment], truth: &[Moment], tick: usize) -> f64 {
    100.0 * (found[tick].v - truth[tick].v) / truth[tick].v
}

/// The distances run, which the chapter does not print. Its listings carry only the speed through their stages, and so
/// lose their order in the distance.
pub(super) fn displacements() -> String {
    let scene = scene("ship");
    let hz = f64::from(scene.tick_hz);
    let last = |moments: Vec<Moment>| moments.last().expect("the start at least").q;
    let truth = last(exactly(&scene, END_S, hz));
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
