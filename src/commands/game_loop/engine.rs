//! What the loop of an engine does to a game, in three lines.

use super::measured::Measured;
use crate::commands::terminal::print_status;
use crate::loops::{FrameLimits, Hitch, TimeBase};
use crate::sim::number::round;

/// Hitches that are described, in milliseconds.
const HITCHES: [(f64, &str); 3] = [(100.0, "100 ms"), (1000.0, "1 s"), (10_000.0, "10 s")];
/// Largest lag behind real time that is not worth a word, in milliseconds.
const REAL_TIME_MS: f64 = 40.0;

/// Prints whether a loop runs at real time, its response to hitches, and what to set.
pub(super) fn print_answer(row: &Measured, limits: FrameLimits) {
    let Some(engine) = &row.card.engine else { return };
    let speed = row.report.speed_percent.unwrap_or(100.0);
    let pace = match speed {
        _ if (row.report.owed_ms + row.report.dropped_ms).abs() <= REAL_TIME_MS => {
            "runs at real time".to_owned()
        }
        _ if speed < 100.0 => format!("runs in slow motion, at {} % of real time", round(speed, 3)),
        _ => format!("runs too fast, at {} % of real time", round(speed, 4)),
    };
    print_status(&format!("{} {} on {}: {pace}", row.card.name, engine.version, row.trace));
    let base = TimeBase::new(row.tick_hz, row.refresh);
    let answers = HITCHES
        .map(|(ms, said)| format!("a hitch of {said}: {}", Hitch::of(&row.card, base, limits, ms)));
    print_status(&answers.join("; "));
    print_status(&format!("set: {} ({})", engine.advice, engine.caveat));
}
