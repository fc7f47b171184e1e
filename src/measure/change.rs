//! The change of a body's amplitude in a run, within the horizon and in the long run.
//!
//! The energy is compared as a mean over quarters of a run. Under many methods it varies within each turn without
//! growing, so that its values at two moments show no trend. A growth that the true motion shares is not the method's.

use super::amplitude::{Trend, amplitude};
use super::frequency::{FrequencyError, frequency_error};
use super::judged_run::JudgedRun;
use super::truth::{BodyTruth, Swing};
use super::verdict::LongTerm;
use crate::sim::stability::FOREVER_S;

/// Relative growth of the swing over the second half of the long run from which on the swing counts as growing.
const GROWTH_SEEN: f64 = 2e-3;

/// Gains of energy are steady if the smallest quarter's gain is at least this fraction of the largest quarter's gain.
const STEADY: f64 = 0.5;

/// Changes of a motion's amplitude, energy and frequency.
pub(super) struct MotionChange {
    pub(super) long_term: LongTerm,
    /// Change of the amplitude within the horizon.
    pub(super) within: Trend,
    pub(super) energy_change: Option<f64>,
    pub(super) frequency_error: Option<f64>,
    /// Seconds by which the motion is early at the end of the horizon.
    pub(super) early_s: Option<f64>,
    /// Widest swing relative to the true one, if modes determine it.
    pub(super) width: Option<f64>,
}

impl MotionChange {
    pub(super) fn of_run(truth: &BodyTruth, run: &JudgedRun, horizon_s: f64) -> Self {
        let period = truth.swing.as_ref().map_or(horizon_s, Swing::period);
        let end = run.followed_s;
        // The swing stays small for some turns, after enough turns to make the time of halving precise.
        let died = |t: f64| end - t >= 4.0 * period && t >= 10.0 * period;
        let long_term = LongTerm {
            measure: truth.measure(),
            doubles_in_s: run.doubled_at.or_else(|| steadily_doubles_in_s(truth, run)),
            halves_in_s: run.halved_at.filter(|&t| died(t)),
            parasite_doubles_in_s: None,
            is_bounded: bounded(truth, run),
        };
        let has_in_time = |at: Option<f64>| at.is_some_and(|t| t <= horizon_s);
        let [first, .., last] = run.quarters.map(amplitude);
        let conserves = truth.energy_scale.is_some();
        let rushes = !conserves && has_in_time(run.velocity_doubled_at);
        let within = match conserves {
            _ if rushes || has_in_time(run.doubled_at) => Trend::Grows,
            true => Trend::between(first, last),
            false => Trend::None,
        };
        let frequency_error = frequency_error(truth, run);
        let early_s = frequency_error.as_ref().and_then(|measured| measured.early_s);
        let frequency_error = frequency_error.filter(FrequencyError::is_steady);
        Self {
            long_term,
            within,
            energy_change: run.energy_change.filter(|_| conserves),
            early_s: early_s.filter(|_| conserves),
            width: None,
            frequency_error: frequency_error.map(|measured| measured.error),
        }
    }
}

/// Whether the amplitude of a body stays bounded by the true one; `None` if the run did not reach its end.
pub(super) fn bounded(truth: &BodyTruth, run: &JudgedRun) -> Option<bool> {
    let failed = run.failure.is_some() || run.later.is_some();
    if failed || run.doubled_at.is_some() || run.velocity_doubled_at.is_some() {
        return Some(false);
    }
    if run.is_too_much || truth.failure.is_some() || run.is_losing && !run.has_come_to_rest {
        return None;
    }
    let [_, early, _, late] = run.long_quarters.map(amplitude);
    // The mean of a quarter depends on where it begins in a turn, unless it has many.
    let has_many_turns = truth.swing.as_ref().is_some_and(Swing::has_a_frequency);
    let is_trend = has_many_turns || run.long_quarters.is_sorted();
    let grows = truth.energy_scale.is_some() && is_trend && late / early > 1.0 + GROWTH_SEEN;
    Some(!grows && steadily_doubles_in_s(truth, run).is_none())
}

/// Returns the doubling time of the amplitude of a linear oscillator whose swing grows at a constant rate. The rate
/// counts as constant if the energy gains in the quarters of the long run are similar. `None` beyond [`FOREVER_S`], and
/// for any other body or run.
fn steadily_doubles_in_s(truth: &BodyTruth, run: &JudgedRun) -> Option<f64> {
    let [first, early, middle, late] = run.long_quarters;
    let gains = [early - first, middle - early, late - middle];
    let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
    let most = gains.iter().copied().fold(0.0, f64::max);
    let is_steady = least > 0.0 && least >= STEADY * most;
    let is_followed = !run.is_too_much && run.failure.is_none() && run.later.is_none();
    if !(is_steady && is_followed && truth.is_oscillator() && truth.energy_scale.is_some()) {
        return None;
    }
    let per_s = libm::log(amplitude(late) / amplitude(early)) / (run.followed_s / 2.0);
    Some(std::f64::consts::LN_2 / per_s).filter(|&doubles_in_s| doubles_in_s <= FOREVER_S)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::judged_run::{MAX_WORK, Until, follow};
    use crate::pace::Pace;
    use crate::scene::{LaneSpec, Scene};
    use crate::sim::integrators::{StepFailure, method};
    use crate::slices::block_on;
    use crate::verdict::RunFailure;

    /// Returns a run to the end, for a swing that neither grows nor dies.
    fn followed() -> (BodyTruth, JudgedRun) {
        let text = "title = 't'\ntick_hz = 60\nseconds = 10\n[[pendulum]]\nlength_m = 1\n";
        let scene = Scene::parse("t", text).unwrap();
        let spec = LaneSpec::plain(method("velocity-verlet").unwrap());
        let body = &scene.bodies[0];
        let truth = block_on(BodyTruth::find(body, &[], 1.0, scene.seconds, Arc::default()));
        let run =
            block_on(follow(&truth, Pace { spec, tick_hz: 60.into() }, Until::LongRun, MAX_WORK));
        (truth, run)
    }

    #[test]
    fn a_bounded_run_neither_fails_nor_leaves_nor_keeps_gaining() {
        let (mut truth, run) = followed();
        let cause = StepFailure::Escaped { coordinate: "x".into(), value: 1e39 };
        let failure = Some(RunFailure { t: 1.0, cause: cause.clone() });
        let cases: [(&str, JudgedRun, Option<bool>); 12] = [
            ("as it is", run.clone(), Some(true)),
            ("ended early", JudgedRun { failure: failure.clone(), ..run.clone() }, Some(false)),
            ("ended late", JudgedRun { later: failure.clone(), ..run.clone() }, Some(false)),
            ("doubled", JudgedRun { doubled_at: Some(7.0), ..run.clone() }, Some(false)),
            ("rushed", JudgedRun { velocity_doubled_at: Some(150.0), ..run.clone() }, Some(false)),
            ("cut short", JudgedRun { is_too_much: true, ..run.clone() }, None),
            (
                "doubled, and then cut short",
                JudgedRun { is_too_much: true, doubled_at: Some(7.0), ..run.clone() },
                Some(false),
            ),
            ("losing", JudgedRun { is_losing: true, ..run.clone() }, None),
            (
                "come to rest",
                JudgedRun { is_losing: true, has_come_to_rest: true, ..run.clone() },
                Some(true),
            ),
            (
                "gaining",
                JudgedRun { long_quarters: [0.0, 0.0, 0.0, 6e-3], ..run.clone() },
                Some(false),
            ),
            (
                "hardly gaining",
                JudgedRun { long_quarters: [0.0, 0.0, 0.0, 3e-3], ..run.clone() },
                Some(true),
            ),
            (
                "gained at once",
                JudgedRun { long_quarters: [0.0, 0.2, 0.2, 0.2], ..run.clone() },
                Some(true),
            ),
        ];
        for (case, run, wanted) in &cases {
            assert_eq!(bounded(&truth, run), *wanted, "{case}");
        }
        let gaining = &cases[9].1;
        truth.energy_scale = None;
        assert_eq!(bounded(&truth, gaining), Some(true), "what keeps no energy gains none");
        truth.failure = Some(cause);
        assert_eq!(bounded(&truth, &run), None, "there is no truth to leave");
    }

    #[test]
    fn growth_after_the_horizon_does_not_count_within_it() {
        let (mut truth, run) = followed();
        let tell =
            |run: &JudgedRun, truth: &BodyTruth| MotionChange::of_run(truth, run, 10.0).within;
        for (at, change) in [(9.0, Trend::Grows), (11.0, Trend::None)] {
            let doubled = JudgedRun { doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&doubled, &truth), change, "doubled at {at} s");
        }
        truth.energy_scale = None;
        for (at, change) in [(9.0, Trend::Grows), (11.0, Trend::None)] {
            let doubled = JudgedRun { doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&doubled, &truth), change, "doubled at {at} s");
            let rushed = JudgedRun { velocity_doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&rushed, &truth), change, "rushed at {at} s");
        }
        assert_eq!(tell(&run, &truth), Trend::None);
    }
}
