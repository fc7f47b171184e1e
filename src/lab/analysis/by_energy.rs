//! The verdict on a body that has no reference solution, because that would take too much work: it rests on
//! the energy of the run, which nothing but a method adds to, and on the spectral radius of a tick.

use super::change::{Change, amplitude};
use super::energy::Means;
use super::energy_finding::EnergyFinding;
use super::limits::VISIBLE;
use super::run::work;
use super::truth::{BodyTruth, ticks};
use super::verdict::RunFailure;
use crate::lab::lane::check;
use crate::lab::lane_spec::LaneSpec;
use crate::sim::Stepper;
use crate::sim::stability::{Tick, spectral_radius};

/// The part of the work of a run that the spectral radius may take too.
const WORK_OF_RADIUS: u64 = 12;

/// A run without a truth.
pub(super) struct EnergyRun {
    pub(super) finding: EnergyFinding,
    /// How the energy changes.
    pub(super) change: Change,
    pub(super) failure: Option<RunFailure>,
    /// The change of a conserved energy of largest magnitude, in percent of the unit of [`EnergyFinding::change`].
    pub(super) drift: Option<f64>,
    /// Whether the run was stopped within the horizon because it took too much work.
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
    pub(super) seconds: f64,
}

impl EnergyRun {
    /// Whether neither the energy nor a small deviation grows.
    pub(super) fn is_bounded(&self) -> bool {
        self.failure.is_none()
            && self.change != Change::Grows
            && !self.finding.has_growing_deviations()
    }
}

/// Runs `truth`'s body under `spec` over the horizon, with its inputs.
pub(super) fn follow_energy(
    truth: &BodyTruth,
    spec: LaneSpec,
    tick_hz: u32,
    most_work: u64,
) -> EnergyRun {
    let (hz, horizon) = (f64::from(tick_hz), ticks(truth.horizon_s, tick_hz));
    let mut stepper = truth.start(spec.solver());
    let n = stepper.q().len() as u64;
    let is_conserved = stepper.energy().is_some();
    let tick = Tick { t: 0.0, h: 1.0 / hz, substeps: spec.substeps };
    let most_evaluations = most_work / n / WORK_OF_RADIUS;
    let radius = spectral_radius(&*stepper, spec.solver(), tick, most_evaluations);
    let mut run = EnergyRun {
        finding: EnergyFinding {
            change: 0.0,
            is_conserved,
            spectral_radius: radius.ok().flatten().filter(|radius| radius.is_finite()),
        },
        change: Change::None,
        failure: None,
        drift: None,
        is_too_much: false,
        evaluations: 0,
        seconds: 0.0,
    };
    let energy = |stepper: &dyn Stepper| stepper.mechanical_energy().unwrap_or([0.0; 2]);
    let sum = |[kinetic, potential]: [f64; 2]| kinetic + potential;
    let mut start = sum(energy(&*stepper));
    let mut means = Means::over(horizon);
    // The largest kinetic energy, the most energy that was lost, and the most that was gained.
    let (mut fastest, mut lost, mut gained) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut made = 0;
    for tick in 1..=horizon {
        let before = sum(energy(&*stepper));
        truth.apply_inputs(&mut *stepper, tick - 1, tick_hz);
        start += sum(energy(&*stepper)) - before;
        let advanced = stepper.advance((tick - 1) as f64 / hz, 1.0 / hz, spec.substeps);
        if let Err(cause) = advanced.and_then(|()| check(&*stepper, truth.coordinates())) {
            run.failure = Some(RunFailure { t: (tick - 1) as f64 / hz, cause });
            break;
        }
        made = tick;
        (run.seconds, run.evaluations) = (tick as f64 / hz, stepper.evaluations());
        let now = energy(&*stepper);
        let gain = sum(now) - start;
        (fastest, lost, gained) = (fastest.max(now[0]), lost.max(-gain), gained.max(gain));
        means.take_in(tick, gain);
        if work(&*stepper, spec, tick) > most_work {
            run.is_too_much = tick < horizon;
            break;
        }
    }
    truth.count_work(work(&*stepper, spec, made));
    let scale = fastest.max(lost);
    if scale > 0.0 && scale.is_finite() {
        let [first, .., last] = means.means().map(|mean| mean / scale);
        run.finding.change = last;
        let drift = if gained > lost { gained } else { -lost };
        run.drift = is_conserved.then_some(100.0 * drift / scale);
        run.change = if is_conserved {
            Change::between(amplitude(first), amplitude(last))
        } else if last > first.max(0.0) + 2.0 * VISIBLE {
            Change::Grows
        } else {
            Change::None
        };
    }
    run
}
