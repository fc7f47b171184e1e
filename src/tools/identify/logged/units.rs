//! Finds a velocity that is in another unit than the coordinate, as in pixels a tick beside pixels.

use super::LogRow;
use crate::sim::least_squares;
use crate::sim::number::round;

/// Least correlation of ways and velocities that tells their ratio, and fewest pairs of rows.
const CLEAR: f64 = 0.99;
const MIN_PAIRS: usize = 8;
/// Smallest factor between two units; a coarse step makes a smaller one.
const APART: f64 = 3.0;
/// Largest relative distance of a factor from the tick rate of a velocity that is per tick.
const PER_TICK: f64 = 0.02;

/// Largest part of the ways that velocities per tick leave unexplained, and largest distance of their factor from the
/// tick rate.
const EXPLAINED: f64 = 1e-3;

/// Takes velocities that are surely per tick as velocities per second. Returns a note on them, or on a log whose x
/// changes much faster or slower than v says.
pub(super) fn note_on_units(rows: &mut [LogRow], tick_hz: f64) -> Option<String> {
    if is_per_tick(rows, tick_hz) {
        for row in rows {
            row.v = row.v.map(|v| v * tick_hz);
        }
        return Some(format!(
            "v is per tick: taken {} times as large, per second",
            round(tick_hz, 4)
        ));
    }
    let factor = times_of_v(rows)?;
    let times = round(factor, 3);
    let unit = match (factor / tick_hz - 1.0).abs() < PER_TICK {
        true => format!("v is per tick; give it per second, {times} times as large"),
        false => "give both in one unit".to_owned(),
    };
    Some(format!("x changes {times} times as fast as v says: {unit}"))
}

/// Returns how many times as fast as v says x changes, if that is clear and another unit.
pub(super) fn times_of_v(rows: &[LogRow]) -> Option<f64> {
    let pairs: Option<Vec<_>> = rows
        .windows(2)
        .map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            let v = [from.v?, to.v?, f64::midpoint(from.v?, to.v?)];
            Some(((to.x - from.x) / (to.t_s - from.t_s), v))
        })
        .collect();
    let pairs = pairs.filter(|pairs| pairs.len() >= MIN_PAIRS)?;
    let ways: f64 = pairs.iter().map(|(way, _)| way * way).sum();
    // A method moves by the velocity of either row, or by their mean.
    let by = |which: usize| {
        let both: f64 = pairs.iter().map(|(way, v)| way * v[which]).sum();
        let of_v: f64 = pairs.iter().map(|(_, v)| v[which] * v[which]).sum();
        (both / (ways * of_v).sqrt(), both / of_v)
    };
    let (likeness, factor) = [by(0), by(1), by(2)]
        .into_iter()
        .filter(|(likeness, factor)| likeness.is_finite() && factor.is_finite())
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (likeness >= CLEAR && !(1.0 / APART..APART).contains(&factor)).then_some(factor)
}

/// Whether each way is that of one tick at the velocities of its two rows, in parts that make one.
fn is_per_tick(rows: &[LogRow], tick_hz: f64) -> bool {
    let ticks = |pair: &[LogRow]| (pair[1].tick - pair[0].tick) as f64;
    let ways: Vec<f64> =
        rows.windows(2).map(|pair| (pair[1].x - pair[0].x) / ticks(pair)).collect();
    let velocities: Option<Vec<f64>> = rows.iter().map(|row| row.v).collect();
    let Some(v) = velocities.filter(|_| ways.len() >= MIN_PAIRS && tick_hz > APART) else {
        return false;
    };
    let columns = [v[..ways.len()].to_vec(), v[1..].to_vec()];
    least_squares(&columns, &ways).is_some_and(|parts| {
        let left = |row: usize| ways[row] - parts[0] * columns[0][row] - parts[1] * columns[1][row];
        let squares = |of: &dyn Fn(usize) -> f64| -> f64 {
            (0..ways.len()).map(of).map(|part| part * part).sum()
        };
        let is_explained = squares(&left) <= EXPLAINED * EXPLAINED * squares(&|row| ways[row]);
        is_explained && (parts[0] + parts[1] - 1.0).abs() <= EXPLAINED
    })
}

#[cfg(test)]
mod tests {
    use crate::identify::Log;
    use crate::table::TableOptions;

    #[test]
    fn a_velocity_in_another_unit_than_x_is_noted() {
        // Springs of 1 and 15 Hz under semi-implicit Euler, and one in free fall.
        for (k, push) in [(39.5, 0.0), (8883.0, 0.0), (0.0, -9.81)] {
            for (unit, said) in [
                (1.0, ""),
                (1.0 / 60.0, "v is per tick: taken 60 times as large, per second"),
                (100.0, "0.01 times as fast as v says: give both in one unit"),
            ] {
                let [h, mut x, mut v] = [1.0 / 60.0, 1.0_f64, 0.0_f64];
                let mut text = String::from("tick,x,v\n");
                for tick in 0..60 {
                    text += &format!("{tick},{x:e},{:e}\n", unit * v);
                    v += h * (push - k * x);
                    x += h * v;
                }
                let log = Log::parse("log", &text, &TableOptions::default(), 60.0).unwrap();
                let notes = log.taken().notes.join("; ");
                assert!(
                    notes.contains(said) && notes.is_empty() == said.is_empty(),
                    "{k}: {notes}"
                );
            }
        }
    }
}
