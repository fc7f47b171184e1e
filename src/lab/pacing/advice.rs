//! Which loop to take.

use super::metrics::PacingReport;
use super::policy::PolicyCard;
use crate::lab::race::Interpolation;

/// Animation errors that differ by less are alike, in milliseconds: no display shows the difference.
const ALIKE_MS: f64 = 1e-3;
/// Position errors that differ by less are alike, in amplitudes.
const AS_NEAR: f64 = 0.01;
/// A motion that is further off than this, in amplitudes, has blown up: what is shown late is off by two at most.
const BLOWN_UP: f64 = 4.0;

/// The largest mean latency of a loop that is advised unless another is asked for, in milliseconds.
pub const USUAL_LATENCY_MS: f64 = 20.0;

/// Why a loop that draws between two ticks is advised where one that draws beyond the last is as smooth.
const NOT_AHEAD: &str = "extrapolation or a render tick would be as smooth and no tick late, but overshoots at each kick";

/// The loop to take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdvisedLoop {
    /// Its index among those measured.
    pub index: usize,
    /// Why not another that is as smooth, if that needs a word.
    pub why: Option<&'static str>,
}

/// From where latencies count, in milliseconds: from the least of these reports where frames begin and are displayed by
/// two clocks without a common origin, so that only differences have a meaning.
pub fn latency_origin_ms<'a>(
    has_one_clock: bool,
    reports: impl IntoIterator<Item = &'a PacingReport>,
) -> f64 {
    if has_one_clock {
        return 0.0;
    }
    let latencies = reports.into_iter().filter_map(PacingReport::latency_mean_ms);
    latencies.reduce(f64::min).unwrap_or(0.0)
}

/// The loop with the least animation error among loops whose speed does not depend on the frame rate, whose motion stays
/// bounded, and whose mean latency is at most `latency_ms`. Ties go to the fixed tick, then to those that draw no moment
/// beyond their last tick, then to the smaller position error, then to the first.
pub fn advised_loop(
    measured: &[(&'static PolicyCard, &PacingReport)],
    latency_ms: f64,
) -> Option<AdvisedLoop> {
    let fits = |report: &PacingReport| {
        report.latency_mean_ms().is_some_and(|latency| latency <= latency_ms + ALIKE_MS)
            && report.keeps_speed() == Some(true)
            && report.position_error_rms.is_none_or(|distance| distance <= BLOWN_UP)
    };
    let rank = |card: &PolicyCard, report: &PacingReport| {
        let error = (report.animation_error_rms_ms? / ALIKE_MS).round();
        let distance = (report.position_error_rms.unwrap_or(f64::INFINITY) / AS_NEAR).round();
        Some((error, !card.has_fixed_tick, card.draws_ahead(), distance))
    };
    let fitting = measured.iter().enumerate().filter(|(_, (_, report))| fits(report));
    let ranked = fitting.filter_map(|(index, (card, report))| Some((rank(card, report)?, index)));
    let ranked: Vec<_> = ranked.collect();
    let ((error, ..), index) = *ranked.iter().min_by(|((e, v, x, d), _), (other, _)| {
        let (error, is_variable, is_beyond, distance) = other;
        e.total_cmp(error)
            .then(v.cmp(is_variable))
            .then(x.cmp(is_beyond))
            .then(d.total_cmp(distance))
    })?;
    let draws_between =
        matches!(measured[index].0.drawing, Interpolation::Linear | Interpolation::Hermite);
    let has_rival = ranked.iter().any(|((e, ..), i)| *e == error && measured[*i].0.draws_ahead());
    let why = (draws_between && has_rival).then_some(NOT_AHEAD);
    Some(AdvisedLoop { index, why })
}
