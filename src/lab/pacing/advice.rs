//! Which loop to take.

use super::metrics::PacingReport;
use super::policy::PolicyCard;

/// Animation errors that differ by less are alike, in milliseconds: no display shows the difference.
const ALIKE_MS: f64 = 1e-3;
/// The largest [difference](PacingReport::time_difference_ms) of a game whose speed does not depend on the frame rate: a few ticks.
const AS_FAST_MS: f64 = 100.0;

/// A motion that is further off than this, in amplitudes, has blown up: what is shown late is off by two at most.
const BLOWN_UP: f64 = 4.0;

/// The loop with the least animation error among loops whose speed does not depend on the frame rate, whose motion stays
/// bounded, and whose mean latency is at most `latency_ms`. Ties go to the fixed tick, then to the smaller position error.
/// Returns its index in `measured`.
pub fn advised_loop(
    measured: &[(&'static PolicyCard, PacingReport)],
    latency_ms: f64,
) -> Option<usize> {
    let fits = |report: &PacingReport| {
        report.latency_mean_ms.is_some_and(|latency| latency <= latency_ms + ALIKE_MS)
            && report.time_difference_ms.is_some_and(|difference| difference.abs() <= AS_FAST_MS)
            && report.position_error_rms.is_none_or(|distance| distance <= BLOWN_UP)
    };
    let rank = |card: &PolicyCard, report: &PacingReport| {
        let error = (report.animation_error_rms_ms? / ALIKE_MS).round();
        let distance = report.position_error_rms.unwrap_or(f64::INFINITY);
        Some((error, !card.has_fixed_tick, distance))
    };
    let fitting = measured.iter().enumerate().filter(|(_, (_, report))| fits(report));
    let ranked = fitting.filter_map(|(index, (card, report))| Some((rank(card, report)?, index)));
    let best = ranked.min_by(|((e, v, d), _), ((error, is_variable, distance), _)| {
        e.total_cmp(error).then(v.cmp(is_variable)).then(d.total_cmp(distance))
    });
    best.map(|(_, index)| index)
}
