//! The verdict on a body without a reference solution, because the solution would take too much work. The verdict rests
//! on the energy of the run, which only the method's error can raise, and on the spectral radius of a tick.

use std::ops::ControlFlow;

use super::amplitude::{Trend, amplitude};
use super::criterion::VISIBLE;
use super::energy::Means;
use super::energy_finding::EnergyFinding;
use super::pace::Pace;
use super::truth::{BodyTruth, FollowedBody, ticks};
use super::verdict::RunFailure;
use crate::run::race::StopReason;
use crate::sim::stability::{PowerIteration, Tick};

/// Divisor of a run's work limit. The quotient is the work limit for the spectral radius.
const WORK_OF_RADIUS: u64 = 12;

/// Result of a run without a truth.
pub(super) struct EnergyRun {
    pub(super) finding: EnergyFinding,
    pub(super) failure: Option<RunFailure>,
    /// Whether too much work stopped the run within the horizon.
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
    pub(super) seconds: f64,
}

impl EnergyRun {
    /// Whether neither the energy nor a small deviation grows.
    pub(super) fn is_bounded(&self) -> bool {
        self.failure.is_none() && self.finding.is_bounded()
    }
}

/// Runs the body of `truth` at this pace over the horizon, with its inputs.
pub(super) async fn follow_energy(truth: &BodyTruth, pace: Pace, max_work: u64) -> EnergyRun {
    let Pace { spec, tick_hz } = pace;
    let max_work = max_work.min(truth.meter.budget_left());
    let horizon = ticks(truth.horizon_s, tick_hz);
    let mut followed = truth.follow(spec.solver(), spec.substeps, tick_hz).with_max_work(max_work);
    let is_conserved = followed.body.stepper.energy().is_some();
    let spectral_radius = spectral_radius(truth, &mut followed.body, pace, max_work).await;
    let (mut seconds, mut evaluations) = (0.0, 0);
    let mut means = Means::over(horizon);
    // These are the largest kinetic energy, energy loss and energy gain, in joules.
    let (mut fastest, mut lost, mut gained) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut change = 0.0;
    let see = |body: &FollowedBody, tick: u64| {
        (seconds, evaluations) = (tick_hz.seconds(tick), body.stepper.evaluations());
        let gain = body.energy() - body.base_j;
        let [kinetic, _] = body.energies();
        (fastest, lost, gained) = (fastest.max(kinetic), lost.max(-gain), gained.max(gain));
        means.add(tick, gain);
        change = gain;
        ControlFlow::Continue(())
    };
    let stop = truth.run_until(&mut followed, horizon, see).await;
    let mut finding = EnergyFinding {
        change: 0.0,
        trend: Trend::None,
        drift_percent: None,
        is_conserved,
        spectral_radius,
    };
    let scale = fastest.max(lost);
    if scale > 0.0 && scale.is_finite() {
        let [first, .., last] = means.means().map(|mean| mean / scale);
        finding.change = change / scale;
        let drift = if gained > lost { gained } else { -lost };
        finding.drift_percent = is_conserved.then_some(100.0 * drift / scale);
        finding.trend = if is_conserved {
            Trend::between(amplitude(first), amplitude(last))
        } else if last > first.max(0.0) + 2.0 * VISIBLE {
            Trend::Grows
        } else {
            Trend::None
        };
    }
    EnergyRun {
        finding,
        is_too_much: stop == StopReason::TooMuchWork,
        failure: RunFailure::of(stop, followed.t()),
        evaluations,
        seconds,
    }
}

/// Returns the spectral radius of a tick about the state of `body`, if it is finite.
async fn spectral_radius(
    truth: &BodyTruth,
    body: &mut FollowedBody,
    Pace { spec, tick_hz }: Pace,
    max_work: u64,
) -> Option<f64> {
    let n = body.stepper.q().len() as u64;
    let tick = Tick { t: 0.0, h: tick_hz.step_s(), substeps: spec.substeps };
    let most = max_work / n / WORK_OF_RADIUS;
    let mut iteration = PowerIteration::new(&*body.stepper, spec.solver(), tick, most).ok()??;
    let evaluations = spec.method.evaluations_per_tick(spec.substeps).map_or(n, u64::from);
    while iteration.advance().ok()? {
        truth.meter.yield_after(evaluations * n).await;
    }
    iteration.radius().filter(|radius| radius.is_finite())
}
