//! The advice below the rows of `regatta loop`: which policy to take, and which motion depends on the frame rate.

use super::measured::Measured;
use crate::commands::terminal::print_status;
use crate::loops::log::ShownLog;
use crate::loops::{FrameLimits, FrameTrace, MeasuredLoops, NoLoop, POLICIES};
use crate::sim::TickRate;
use crate::sim::number::{counted, round, significant};

/// Prints which of the policies to take that were measured on one trace.
pub(super) fn print_advice(rows: &[Measured], latency_ms: f64, limits: FrameLimits) {
    let Some(first) = rows.first() else { return };
    let trace =
        format!("{} ({} Hz display, {:.3} Hz ticks)", first.trace, first.refresh, first.tick_hz);
    let measured = rows.iter().map(|row| (&*row.card, &row.report));
    let loops = MeasuredLoops::new(measured, first.tick_hz, first.refresh, first.has_one_clock);
    // The message does not speak of a subset if all policies were measured, just as in the window.
    let are_all = rows.len() == POLICIES.len();
    match loops.advised(latency_ms) {
        Ok(advised) => {
            let among = if are_all { "take" } else { "of these take" };
            let latency_ms = loops.latency_ms(advised.index);
            print_status(&format!(
                "{trace}: {among} {}",
                advice_text(&rows[advised.index], latency_ms, limits)
            ));
            if let Some(why) = advised.why {
                print_status(&format!("  {why}"));
            }
        }
        Err(none) => {
            let mut clauses = loops.reasons(none, latency_ms, |card| &card.id);
            let remedy = match none {
                NoLoop::TooFewFrames => None,
                NoLoop::MotionLost => Some("give more --tick-hz or another --method".into()),
                NoLoop::Unfit { late: Some(index), .. } => {
                    let least = loops.latency_ms(index).map(f64::ceil).unwrap_or_default();
                    Some(format!("--latency-ms {least} takes {}", rows[index].card.id))
                }
                _ => (!are_all).then(|| "try --all".into()),
            };
            clauses.extend(remedy);
            let among = if are_all { "none" } else { "none of these" };
            print_status(&format!("{trace}: take {among}: {}", clauses.join("; ")));
        }
    }
    if let Some(missing) = first.missing_display {
        print_status(&format!("  {missing}"));
    }
    if !first.has_one_clock {
        print_status(
            "  the log's two clocks have no common origin: latencies count from the least here, and are off by a \
             constant in the rows",
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

/// Prints how much the body judders in the picture of a camera, if there is one.
pub(super) fn print_camera(rows: &[Measured]) {
    let seen = rows.iter().filter_map(|row| {
        let error_ms = row.camera.as_ref()?.seen_error_rms_ms()?;
        Some(format!("{} {}", row.card.id, round((1000.0 * error_ms).round() / 1000.0, 3)))
    });
    let listed = seen.collect::<Vec<_>>().join(", ");
    if !listed.is_empty() {
        print_status(&format!("  in the camera's picture the body judders by (ms, RMS): {listed}"));
    }
}

/// Prints how the moments of a log were taken, and the loop that comes nearest to them.
pub(super) fn print_log(log: &ShownLog, trace: &FrameTrace, tick_hz: TickRate) {
    let nearest = log.nearest(trace, tick_hz).map(|nearest| {
        let at = nearest.tick_hz.map_or(String::new(), |hz| format!(" at {hz} ticks a second"));
        format!("as {}{at}, {} ms RMS", nearest.card.id, significant(nearest.rms_ms, 3))
    });
    let nearest = nearest.unwrap_or("as no loop that is known".into());
    print_status(&format!("{} log: {nearest}; {}", trace.name(), log.taken));
}

/// Describes a policy by its measurements, and by its constants or the limits that replace them.
fn advice_text(row: &Measured, latency_ms: Option<f64>, limits: FrameLimits) -> String {
    // Traces count whole nanoseconds, so that a difference below a microsecond is only rounding.
    let to_microseconds = |ms: f64| (1000.0 * ms).round() / 1000.0;
    let ms = |value: Option<f64>| {
        value.map_or("unknown".into(), |ms| format!("{} ms", round(to_microseconds(ms), 3)))
    };
    let error = ms(row.report.animation_error_rms_ms);
    let latency = ms(latency_ms);
    let ticks = limits.max_ticks.filter(|_| row.card.has_max_ticks);
    let set = [
        ticks.map(|n| format!("at most {}", counted(n, "tick"))),
        limits.max_frame_ms.map(|ms| format!("at most {ms} ms")),
    ];
    let set: Vec<String> = set.into_iter().flatten().collect();
    let constants = match (set.is_empty(), &*row.card.constants) {
        (true, "") => String::new(),
        (true, constants) => format!("; {constants}"),
        (false, _) => format!("; {} a frame, as set; the rest is dropped", set.join(" and ")),
    };
    format!("{}: animation error {error} RMS, mean latency {latency}{constants}", row.card.id)
}
