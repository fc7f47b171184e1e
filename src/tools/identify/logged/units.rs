//! Finds a velocity that is in another unit than the coordinate, as in pixels a tick beside pixels.

use super::LogRow;
use crate::sim::number::round;

/// Least correlation of ways and velocities that tells their ratio, and fewest pairs of rows.
const CLEAR: f64 = 0.99;
const MIN_PAIRS: usize = 8;
/// Smallest factor between two units; a coarse step makes a smaller one.
const APART: f64 = 3.0;
/// Largest relative distance of a factor from the tick rate of a velocity that is per tick.
const PER_TICK: f64 = 0.02;

/// Returns a note on a log whose x changes much faster or slower than v says.
pub(super) fn note_on_units(rows: &[LogRow], tick_hz: f64) -> Option<String> {
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
    if likeness < CLEAR || (1.0 / APART..APART).contains(&factor) {
        return None;
    }
    let times = round(factor, 3);
    let unit = match (factor / tick_hz - 1.0).abs() < PER_TICK {
        true => format!("v is per tick; give it per second, {times} times as large"),
        false => "give both in one unit".to_owned(),
    };
    Some(format!("x changes {times} times as fast as v says: {unit}"))
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
                (1.0 / 60.0, "60 times as fast as v says: v is per tick; give it per second"),
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
