//! What `regatta loop` says below its rows: which policy to take, and which motion depends on the frame rate.

use super::measured::Measured;
use crate::commands::terminal::print_status;
use crate::lab::pacing::{POLICIES, PacingReport, PolicyCard, advised_loop, latency_origin_ms};
use crate::sim::number::round;

/// Tells which of the policies measured on one trace to take.
pub(super) fn tell_of(rows: &[Measured], latency_ms: f64) {
    let Some(first) = rows.first() else { return };
    let trace =
        format!("{} ({} Hz display, {} Hz ticks)", first.trace, first.refresh, first.tick_hz);
    let measured: Vec<(&'static PolicyCard, &PacingReport)> =
        rows.iter().map(|row| (row.card, &row.report)).collect();
    let origin_ms = latency_origin_ms(first.has_one_clock, rows.iter().map(|row| &row.report));
    match advised_loop(&measured, origin_ms + latency_ms) {
        Some(advised) => {
            // The window advises among all.
            let among = if rows.len() < POLICIES.len() { "of these take" } else { "take" };
            print_status(&format!("{trace}: {among} {}", words(&rows[advised.index], origin_ms)));
            if let Some(why) = advised.why {
                print_status(&format!("  {why}"));
            }
        }
        None if rows.iter().all(|row| row.report.animation_error_rms_ms.is_none()) => {
            print_status(&format!(
                "{trace}: fewer than two frames were displayed, too few to measure"
            ));
        }
        None => print_status(&format!(
            "{trace}: no policy here keeps the game's speed at half the frame rate, stays stable, and has a mean latency \
             of {latency_ms} ms or less; try --all, or a larger --latency-ms"
        )),
    }
    if let Some(missing) = first.missing_display {
        print_status(&format!("  {missing}"));
    }
    if !first.has_one_clock {
        print_status(
            "  the log's two clocks have no common origin: latencies here are counted from the least, and in the rows \
             they are off by a constant",
        );
    }
    let depends = rows.iter().filter_map(|row| {
        let difference = row.report.other_motion()?;
        Some(format!("{} by {}", row.card.id, round(difference, 2)))
    });
    let depends: Vec<String> = depends.collect();
    if !depends.is_empty() {
        let listed = depends.join(", ");
        print_status(&format!(
            "  at half the frame rate the motion differs by up to (amplitudes): {listed}"
        ));
    }
}

/// A policy with what was measured and its constants. Latencies are counted from `origin_ms`.
fn words(row: &Measured, origin_ms: f64) -> String {
    // Traces are counted in whole nanoseconds: what is less than a microsecond is their rounding.
    let to_microseconds = |ms: f64| (1000.0 * ms).round() / 1000.0;
    let ms = |value: Option<f64>| {
        value.map_or("unknown".into(), |ms| format!("{} ms", round(to_microseconds(ms), 3)))
    };
    let error = ms(row.report.animation_error_rms_ms);
    let latency = ms(row.report.latency_mean_ms().map(|latency| latency - origin_ms));
    let constants = match row.card.constants {
        "" => String::new(),
        constants => format!("; {constants}"),
    };
    format!("{}: animation error {error} RMS, mean latency {latency}{constants}", row.card.id)
}
