//! The change of a body's amplitude, within the horizon and in the long run, from a run.

use super::frequency::{FrequencyError, frequency_error};
use super::limits::VISIBLE;
use super::run::Run;
use super::truth::{BodyTruth, Swing};
use super::verdict::Verdict;
use crate::sim::stability::FOREVER_S;

/// The relative growth of the swing over the second half of the long run above which it counts as growth.
const GROWTH_SEEN: f64 = 2e-3;

/// How alike the gains of energy from quarter to quarter of the long run are where they are steady, smallest to largest.
const STEADY: f64 = 0.5;

/// A change of the amplitude by this factor counts even if it happens at once and then stops.
const LEAP: f64 = 1.5;

/// The change of the amplitude within the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    None,
    Grows,
    Dies,
}

impl Change {
    /// The change of a swing whose amplitude has changed by this factor.
    pub(super) fn of(amplitude: f64) -> Self {
        match amplitude {
            a if a >= 1.0 + VISIBLE => Change::Grows,
            a if a <= 1.0 - VISIBLE => Change::Dies,
            _ => Change::None,
        }
    }

    /// The change of a swing whose amplitude, in units of the initial one, is `first` in the first quarter and `last` in
    /// the last. A change that happens at once and then stops does not count, unless it is a [leap](LEAP).
    pub(super) fn between(first: f64, last: f64) -> Self {
        let trend = Change::of(last / first);
        match Change::of(last) {
            Change::Grows if trend == Change::Grows || last >= LEAP => Change::Grows,
            Change::Dies if trend == Change::Dies || last * LEAP <= 1.0 => Change::Dies,
            _ => Change::None,
        }
    }
}

/// Puts the change of the motion into a verdict, from the run, and returns the change within the horizon.
pub(super) fn fill_from_run(
    verdict: &mut Verdict,
    truth: &BodyTruth,
    run: &Run,
    horizon_s: f64,
) -> Change {
    verdict.is_bounded = bounded(truth, run);
    verdict.doubles_in_s = run.doubled_at.or_else(|| steadily_doubles_in_s(truth, run));
    let period = truth.swing.as_ref().map_or(horizon_s, Swing::period);
    let end = run.followed_s;
    // The swing stays small for some turns, after so many turns that the time of halving is sharp.
    let died = |t: f64| end - t >= 4.0 * period && t >= 10.0 * period;
    verdict.halves_in_s = run.halved_at.filter(|&t| died(t));
    verdict.frequency_error = frequency_error(truth, run)
        .filter(FrequencyError::is_steady)
        .map(|measured| measured.error);
    let within = |at: Option<f64>| at.is_some_and(|t| t <= horizon_s);
    if truth.energy_scale.is_none() {
        let grows = within(run.doubled_at) || within(run.velocity_doubled_at);
        return if grows { Change::Grows } else { Change::None };
    }
    verdict.energy_change = Some(run.quarters[3]).filter(|change| change.is_finite());
    let [first, .., last] = run.quarters.map(amplitude);
    if within(run.doubled_at) { Change::Grows } else { Change::between(first, last) }
}

/// The amplitude, in units of the initial one, of a swing whose energy has changed by this part.
pub(super) fn amplitude(energy_change: f64) -> f64 {
    (1.0 + energy_change).max(0.0).sqrt()
}

/// Whether the amplitude of a body stays bounded by the true one; `None` if the run did not get to its end.
pub(super) fn bounded(truth: &BodyTruth, run: &Run) -> Option<bool> {
    let failed = run.failure.is_some() || run.later.is_some();
    if failed || run.doubled_at.is_some() || run.velocity_doubled_at.is_some() {
        return Some(false);
    }
    if run.is_too_much || truth.failure.is_some() || run.is_losing && !run.has_come_to_rest {
        return None;
    }
    let [_, early, _, late] = run.long_quarters.map(amplitude);
    let grows = truth.energy_scale.is_some() && late / early > 1.0 + GROWTH_SEEN;
    Some(!grows && steadily_doubles_in_s(truth, run).is_none())
}

/// When the amplitude of a linear oscillator doubles that gains as much energy in each quarter of the long run as in the
/// one before, up to [`FOREVER_S`]: its swing grows at a constant rate. `None` of any other body or run.
fn steadily_doubles_in_s(truth: &BodyTruth, run: &Run) -> Option<f64> {
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
    use super::*;
    use crate::lab::analysis::run::{MAX_WORK, Until, follow};
    use crate::lab::analysis::verdict::RunFailure;
    use crate::lab::{Judge, LaneSpec, Scene};
    use crate::sim::integrators::StepFailure;
    use crate::sim::integrators::method;

    #[test]
    fn a_change_goes_on_or_is_a_leap() {
        for (first, last, change) in [
            (1.0, 1.06, Change::Grows),
            (1.04, 1.06, Change::None),
            (1.0, 1.04, Change::None),
            (1.45, 1.49, Change::None),
            (1.45, 1.51, Change::Grows),
            (1.0, 0.94, Change::Dies),
            (0.96, 0.94, Change::None),
            (1.0, 0.96, Change::None),
            (0.69, 0.67, Change::None),
            (0.69, 0.66, Change::Dies),
            // What grows first and then dies has not grown.
            (2.0, 1.2, Change::None),
        ] {
            assert_eq!(Change::between(first, last), change, "{first} to {last}");
        }
    }

    /// A run to the end of a swing that neither grows nor dies.
    fn followed() -> (BodyTruth, Run, Verdict) {
        let text = "title = 't'\ntick_hz = 60\nseconds = 10\n[[pendulum]]\nlength_m = 1\n";
        let scene = Scene::parse("t", text).unwrap();
        let spec = LaneSpec::plain(method("velocity-verlet").unwrap());
        let judge = Judge::new(&scene, 1.0);
        let verdict = judge.verdict(spec, 60);
        let truth = BodyTruth::new(&scene.bodies[0], &[], 1.0, scene.seconds);
        let run = follow(&truth, spec, 60, Until::LongRun, MAX_WORK);
        (truth, run, verdict)
    }

    #[test]
    fn bounded_is_what_neither_fails_nor_leaves_nor_goes_on_gaining() {
        let (mut truth, run, _) = followed();
        let cause = StepFailure::Escaped { coordinate: "x".into(), value: 1e39 };
        let failure = Some(RunFailure { t: 1.0, cause: cause.clone() });
        let cases: [(&str, Run, Option<bool>); 12] = [
            ("as it is", run.clone(), Some(true)),
            ("ended early", Run { failure: failure.clone(), ..run.clone() }, Some(false)),
            ("ended late", Run { later: failure.clone(), ..run.clone() }, Some(false)),
            ("doubled", Run { doubled_at: Some(7.0), ..run.clone() }, Some(false)),
            ("rushed", Run { velocity_doubled_at: Some(150.0), ..run.clone() }, Some(false)),
            ("cut short", Run { is_too_much: true, ..run.clone() }, None),
            (
                "doubled, and then cut short",
                Run { is_too_much: true, doubled_at: Some(7.0), ..run.clone() },
                Some(false),
            ),
            ("losing", Run { is_losing: true, ..run.clone() }, None),
            (
                "come to rest",
                Run { is_losing: true, has_come_to_rest: true, ..run.clone() },
                Some(true),
            ),
            ("gaining", Run { long_quarters: [0.0, 0.0, 0.0, 6e-3], ..run.clone() }, Some(false)),
            (
                "hardly gaining",
                Run { long_quarters: [0.0, 0.0, 0.0, 3e-3], ..run.clone() },
                Some(true),
            ),
            (
                "gained at once",
                Run { long_quarters: [0.0, 0.2, 0.2, 0.2], ..run.clone() },
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
    fn what_grows_after_the_horizon_has_not_grown_within_it() {
        let (mut truth, run, mut verdict) = followed();
        let mut tell = |run: &Run, truth: &BodyTruth| fill_from_run(&mut verdict, truth, run, 10.0);
        for (at, change) in [(9.0, Change::Grows), (11.0, Change::None)] {
            let doubled = Run { doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&doubled, &truth), change, "doubled at {at} s");
        }
        truth.energy_scale = None;
        for (at, change) in [(9.0, Change::Grows), (11.0, Change::None)] {
            let doubled = Run { doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&doubled, &truth), change, "doubled at {at} s");
            let rushed = Run { velocity_doubled_at: Some(at), ..run.clone() };
            assert_eq!(tell(&rushed, &truth), change, "rushed at {at} s");
        }
        assert_eq!(tell(&run, &truth), Change::None);
    }
}
