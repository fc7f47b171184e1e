//! The verdict on a body that has no reference solution, because that would take too much work: it rests on
//! the energy of the run, which nothing but a method adds to, and on the spectral radius of a tick.

use std::ops::ControlFlow;

use super::amplitude::{Change, amplitude};
use super::energy::Means;
use super::energy_finding::EnergyFinding;
use super::followed_body::FollowedBody;
use super::limits::VISIBLE;
use super::truth::{BodyTruth, ticks};
use super::verdict::RunFailure;
use crate::lab::action::Action;
use crate::lab::follow::{StopReason, Ticked};
use crate::lab::lane_spec::LaneSpec;
use crate::sim::integrators::StepFailure;
use crate::sim::stability::{Tick, spectral_radius};

/// The part of the work of a run that the spectral radius may take too.
const WORK_OF_RADIUS: u64 = 12;

/// A run without a truth.
pub(super) struct EnergyRun {
    pub(super) finding: EnergyFinding,
    pub(super) failure: Option<RunFailure>,
    /// Whether the run was stopped within the horizon because it took too much work.
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

/// Runs `truth`'s body under `spec` over the horizon, with its inputs.
pub(super) fn follow_energy(
    truth: &BodyTruth,
    spec: LaneSpec,
    tick_hz: u32,
    max_work: u64,
) -> EnergyRun {
    let (hz, horizon) = (f64::from(tick_hz), ticks(truth.horizon_s, tick_hz));
    let body = truth.body_under(spec.solver(), spec.substeps);
    let stepper = &*body.stepper;
    let n = stepper.q().len() as u64;
    let is_conserved = stepper.energy().is_some();
    let tick = Tick { t: 0.0, h: 1.0 / hz, substeps: spec.substeps };
    let max_evaluations = max_work / n / WORK_OF_RADIUS;
    let radius = spectral_radius(stepper, spec.solver(), tick, max_evaluations);
    let mut follow = truth.follow(Metered::new(body), tick_hz).within(max_work);
    let mut means = Means::over(horizon);
    // The largest kinetic energy, the most energy that was lost, and the most that was gained.
    let (mut fastest, mut lost, mut gained) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut seconds, mut evaluations) = (0.0, 0);
    let stop = follow.run(horizon, |body, tick| {
        (seconds, evaluations) = (tick as f64 / hz, body.body.stepper.evaluations());
        let now = body.energy();
        let gain = sum(now) - body.start;
        (fastest, lost, gained) = (fastest.max(now[0]), lost.max(-gain), gained.max(gain));
        means.take_in(tick, gain);
        ControlFlow::Continue(())
    });
    truth.count_work(follow.body.body.work(follow.ticks()));
    let mut run = EnergyRun {
        finding: EnergyFinding {
            change: 0.0,
            trend: Change::None,
            drift_percent: None,
            is_conserved,
            spectral_radius: radius.ok().flatten().filter(|radius| radius.is_finite()),
        },
        is_too_much: stop == StopReason::TooMuchWork,
        failure: RunFailure::of(stop, follow.t()),
        evaluations,
        seconds,
    };
    let scale = fastest.max(lost);
    if scale > 0.0 && scale.is_finite() {
        let [first, .., last] = means.means().map(|mean| mean / scale);
        run.finding.change = last;
        let drift = if gained > lost { gained } else { -lost };
        run.finding.drift_percent = is_conserved.then_some(100.0 * drift / scale);
        run.finding.trend = if is_conserved {
            Change::between(amplitude(first), amplitude(last))
        } else if last > first.max(0.0) + 2.0 * VISIBLE {
            Change::Grows
        } else {
            Change::None
        };
    }
    run
}

/// A body whose energy is measured, and what the inputs add to it is known.
struct Metered {
    body: FollowedBody,
    /// The energy at the start and what the inputs have added, in joules.
    start: f64,
}

impl Metered {
    fn new(body: FollowedBody) -> Self {
        let mut metered = Self { body, start: 0.0 };
        metered.start = sum(metered.energy());
        metered
    }

    /// The kinetic and the potential energy in joules.
    fn energy(&self) -> [f64; 2] {
        self.body.stepper.mechanical_energy().unwrap_or([0.0; 2])
    }
}

fn sum([kinetic, potential]: [f64; 2]) -> f64 {
    kinetic + potential
}

impl Ticked for Metered {
    fn act(&mut self, tick: u64, t: f64, action: &Action) {
        let before = sum(self.energy());
        self.body.act(tick, t, action);
        self.start += sum(self.energy()) - before;
    }

    fn tick(&mut self, tick: u64, t: f64, h: f64) -> Result<(), StepFailure> {
        self.body.tick(tick, t, h)
    }

    fn has_worked_more(&self, than: u64, ticks: u64) -> bool {
        self.body.has_worked_more(than, ticks)
    }
}
