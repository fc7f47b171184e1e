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
use crate::lab::follow::{Follow, StopReason, Ticked};
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
    let mut followed = FollowedEnergy::new(truth, spec, tick_hz, max_work);
    while !followed.work(truth, u64::MAX) {}
    followed.run
}

/// A run without a truth on its way. It can be stopped after any tick, and goes on from there.
pub(super) struct FollowedEnergy {
    follow: Follow<'static, Metered>,
    /// The run so far. What it does to the energy is found at its end.
    pub(super) run: EnergyRun,
    horizon: u64,
    hz: f64,
    means: Means,
    /// The largest kinetic energy, in joules.
    fastest: f64,
    /// The most energy that was lost, and the most that was gained, in joules.
    lost: f64,
    gained: f64,
}

impl FollowedEnergy {
    /// A run before its first tick. The spectral radius is computed.
    pub(super) fn new(truth: &BodyTruth, spec: LaneSpec, tick_hz: u32, max_work: u64) -> Self {
        let (hz, horizon) = (f64::from(tick_hz), ticks(truth.horizon_s, tick_hz));
        let body = truth.body_under(spec.solver(), spec.substeps);
        let stepper = &*body.stepper;
        let n = stepper.q().len() as u64;
        let tick = Tick { t: 0.0, h: 1.0 / hz, substeps: spec.substeps };
        let max_evaluations = max_work / n / WORK_OF_RADIUS;
        let radius = spectral_radius(stepper, spec.solver(), tick, max_evaluations);
        let run = EnergyRun {
            finding: EnergyFinding {
                change: 0.0,
                trend: Change::None,
                drift_percent: None,
                is_conserved: stepper.energy().is_some(),
                spectral_radius: radius.ok().flatten().filter(|radius| radius.is_finite()),
            },
            is_too_much: false,
            failure: None,
            evaluations: 0,
            seconds: 0.0,
        };
        Self {
            follow: truth.follow(Metered::new(body), tick_hz).within(max_work),
            run,
            horizon,
            hz,
            means: Means::over(horizon),
            fastest: 0.0,
            lost: 0.0,
            gained: 0.0,
        }
    }

    /// Goes on for about this much work. Returns whether the run is over.
    pub(super) fn work(&mut self, truth: &BodyTruth, work: u64) -> bool {
        let Self { follow, run, horizon, hz, means, fastest, lost, gained } = self;
        let stop = follow.run(*horizon, |body, tick| {
            (run.seconds, run.evaluations) = (tick as f64 / *hz, body.body.stepper.evaluations());
            let now = body.energy();
            let gain = sum(now) - body.start;
            (*fastest, *lost, *gained) = (fastest.max(now[0]), lost.max(-gain), gained.max(gain));
            means.take_in(tick, gain);
            match body.body.has_worked(work, tick) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        let ticks = follow.ticks();
        follow.body.body.count_work(truth, ticks);
        if stop == StopReason::Seen {
            return false;
        }
        run.is_too_much = stop == StopReason::TooMuchWork;
        run.failure = RunFailure::of(stop, follow.t());
        let (fastest, lost, gained) = (*fastest, *lost, *gained);
        let scale = fastest.max(lost);
        if scale > 0.0 && scale.is_finite() {
            let [first, .., last] = means.means().map(|mean| mean / scale);
            let finding = &mut run.finding;
            finding.change = last;
            let drift = if gained > lost { gained } else { -lost };
            finding.drift_percent = finding.is_conserved.then_some(100.0 * drift / scale);
            finding.trend = if finding.is_conserved {
                Change::between(amplitude(first), amplitude(last))
            } else if last > first.max(0.0) + 2.0 * VISIBLE {
                Change::Grows
            } else {
                Change::None
            };
        }
        true
    }
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
