//! The verdict on a lane on a scene, from a run compared with the truth tick by tick.
//!
//! A scene is judged from its start, at one tick rate, with the inputs of its script, each body by itself.
//! A linear body under a method of equal steps has one map from tick to tick, whose modes give its motion at all later
//! times. Any other body is followed for [`LONG_RUN`](super::LONG_RUN) times the horizon, and its verdict claims nothing
//! beyond that.

use super::by_energy::follow_energy;
use super::change::{Change, bounded, fill_from_run};
use super::chase_finding::ChaseFinding;
use super::frequency::frequency_error;
use super::limits::{FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
use super::modes::{Modes, TooMuch};
use super::outcome::Outcome;
use super::run::{MOST_WORK, Run, Until, follow};
use super::survey::{BodyInput, TimedInput};
use super::truth::{BodyTruth, ticks};
use super::verdict::{NoTruth, NotJudged, Verdict};
use crate::lab::action::Action;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::Scene;

/// The fewest ticks per turn at which every turn shows its peak.
const FEW_TICKS: f64 = 8.0;

/// The longest horizon in simulated seconds. A shorter scene is judged over its whole length.
pub const LONGEST_HORIZON_S: f64 = 60.0;

/// The largest error in amplitudes that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The true motion of a scene, with which lanes are compared.
pub struct Judge {
    horizon_s: f64,
    throttle: f64,
    most_work: u64,
    truths: Vec<BodyTruth>,
}

/// The script's actions on the body at this place of the scene. Their times follow from the scene's own tick rates.
fn inputs_of(scene: &Scene, body: usize) -> Vec<TimedInput> {
    let (mut tick, mut t, mut hz) = (0, 0.0, f64::from(scene.tick_hz));
    let mut inputs = Vec::new();
    for scripted in &scene.script {
        t += (scripted.tick - tick) as f64 / hz;
        tick = scripted.tick;
        if let Action::TickHz(tick_hz) = scripted.action {
            hz = f64::from(tick_hz);
        }
        inputs.extend(BodyInput::of(&scripted.action, body).map(|input| TimedInput { t, input }));
    }
    inputs
}

/// Whether a lane meets a [`Criterion`](super::advice::Criterion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CriterionFinding {
    /// It does, at this cost.
    Holds { evaluations_per_s: f64 },
    /// The body at this place of the scene does not.
    Fails { body: usize },
    /// Not known: it would take too much work, or there is no truth or no tick.
    Unknown,
}

/// Why a body is not known to meet a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum CriterionMiss {
    /// It does not meet it.
    Fails,
    /// Not known: it would take too much work, or there is no truth.
    Unknown,
}

impl From<TooMuch> for CriterionMiss {
    fn from(_: TooMuch) -> Self {
        CriterionMiss::Unknown
    }
}

impl Judge {
    /// A judge of `scene` under this throttle, -1 to 1, over its length but at most [`LONGEST_HORIZON_S`].
    pub fn new(scene: &Scene, throttle: f64) -> Self {
        Self::over(scene, throttle, scene.seconds.min(LONGEST_HORIZON_S))
    }

    /// A judge of `scene` under this throttle over `horizon_s` simulated seconds, which is positive and may exceed the
    /// scene's length.
    pub fn over(scene: &Scene, throttle: f64, horizon_s: f64) -> Self {
        let of =
            |(place, body)| BodyTruth::new(body, &inputs_of(scene, place), throttle, horizon_s);
        let truths = scene.bodies.iter().enumerate().map(of);
        Self { horizon_s, throttle, most_work: MOST_WORK, truths: truths.collect() }
    }

    /// Limits the work of each run to less than [`MOST_WORK`]; what takes more is not known.
    pub(super) fn within(mut self, most_work: u64) -> Self {
        self.most_work = most_work;
        self
    }

    /// Whether all bodies are linear.
    pub(super) fn is_linear(&self) -> bool {
        self.truths.iter().all(|truth| truth.modes.is_some())
    }

    /// Whether a tick at this rate fits into the horizon.
    pub(super) fn has_ticks(&self, tick_hz: u32) -> bool {
        ticks(self.horizon_s, tick_hz) > 0
    }

    /// The throttle under which the scene is judged.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }

    /// The horizon in simulated seconds.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// The verdict on a lane at this tick rate: that of its worst body.
    pub fn verdict(&self, spec: LaneSpec, tick_hz: u32) -> Verdict {
        let verdicts: Vec<Verdict> =
            (0..self.truths.len()).map(|body| self.of_body(body, spec, tick_hz)).collect();
        let evaluations = verdicts.iter().map(|verdict| verdict.evaluations).sum();
        let bounded = verdicts.iter().map(|verdict| verdict.is_bounded);
        let is_bounded = bounded.reduce(|a, b| match (a, b) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        });
        let worst = verdicts.iter().reduce(|a, b| if b.is_worse_than(a) { b } else { a });
        let worst = worst.expect("a scene has a body").clone();
        Verdict { evaluations, is_bounded: is_bounded.flatten(), of_bodies: verdicts, ..worst }
    }

    fn of_body(&self, body: usize, spec: LaneSpec, tick_hz: u32) -> Verdict {
        let truth = &self.truths[body];
        if truth.is_too_dear() {
            return self.by_energy(body, spec, tick_hz);
        }
        let found = Modes::of(truth, spec, tick_hz);
        let most_work = if found.is_ok() { self.most_work } else { 0 };
        let modes = found.ok().flatten();
        let until = if modes.is_some() { Until::Horizon } else { Until::LongRun };
        let run = follow(truth, spec, tick_hz, until, most_work);
        let mut verdict = Verdict {
            outcome: Outcome::Accurate,
            body,
            body_name: (self.truths.len() > 1).then(|| truth.body.name.clone()),
            error: run.error,
            error_at_s: run.error_at_s,
            last_error: run.last_error,
            swings: truth.swing.is_some(),
            doubles_in_s: None,
            halves_in_s: None,
            parasite_doubles_in_s: None,
            energy_change: None,
            frequency_error: None,
            is_bounded: None,
            energy_drift: run.energy_drift,
            chase: ChaseFinding::of(truth, spec, tick_hz, run.chase.as_ref()),
            failure: run.failure.clone(),
            by_energy: None,
            no_truth: None,
            not_judged: None,
            evaluations: run.evaluations,
            seconds: run.seconds,
            horizon_s: self.horizon_s,
            starts_at_s: 0.0,
            of_bodies: Vec::new(),
        };
        let change = match &modes {
            Some(modes) => modes.fill(&mut verdict, self.horizon_s - truth.last_input_s()),
            None => fill_from_run(&mut verdict, truth, &run, self.horizon_s),
        };
        if run.failure.is_some() {
            verdict.is_bounded = Some(false);
        }
        verdict.not_judged = match ticks(self.horizon_s, tick_hz) {
            0 => Some(NotJudged::ShorterThanATick),
            _ => run.is_cut_short().then_some(NotJudged::TooMuchWork),
        };
        let gap = truth.gap(run.seconds, tick_hz);
        if verdict.not_judged.is_none() {
            verdict.no_truth = without_truth(truth, &run, gap);
        }
        verdict.outcome = outcome_of(&verdict, &run, change, gap);
        if matches!(
            verdict.outcome,
            Outcome::NotJudged | Outcome::NoTruth | Outcome::BlewUp | Outcome::GaveUp
        ) {
            verdict.frequency_error = None;
            verdict.energy_drift = None;
        }
        if verdict.outcome == Outcome::NotJudged {
            verdict.is_bounded = None;
        }
        verdict
    }

    /// The verdict on a body that has no reference solution.
    fn by_energy(&self, body: usize, spec: LaneSpec, tick_hz: u32) -> Verdict {
        let truth = &self.truths[body];
        let run = follow_energy(truth, spec, tick_hz, self.most_work);
        let not_judged = match ticks(self.horizon_s, tick_hz) {
            0 => Some(NotJudged::ShorterThanATick),
            _ => run.is_too_much.then_some(NotJudged::TooMuchWork),
        };
        let outcome = match (&run.failure, not_judged, run.change) {
            (Some(failure), ..) => failure.outcome(),
            (None, Some(_), _) => Outcome::NotJudged,
            (None, None, Change::Grows) => Outcome::GainsEnergy,
            (None, None, Change::Dies) => Outcome::LosesEnergy,
            (None, None, Change::None) => Outcome::NoTruth,
        };
        let is_bounded = match outcome {
            Outcome::NotJudged => None,
            Outcome::BlewUp | Outcome::GaveUp => Some(false),
            // A run over the horizon does not show that nothing grows later.
            _ => (!run.is_bounded()).then_some(false),
        };
        let is_whole = run.failure.is_none() && not_judged.is_none();
        Verdict {
            outcome,
            body,
            body_name: (self.truths.len() > 1).then(|| truth.body.name.clone()),
            error: f64::INFINITY,
            error_at_s: run.seconds,
            last_error: f64::INFINITY,
            swings: false,
            doubles_in_s: None,
            halves_in_s: None,
            parasite_doubles_in_s: None,
            energy_change: Some(run.finding.change).filter(|_| is_whole),
            frequency_error: None,
            is_bounded,
            energy_drift: run.drift.filter(|_| is_whole),
            chase: None,
            failure: run.failure,
            by_energy: Some(run.finding),
            no_truth: truth.failure.clone().map(NoTruth::Failed),
            not_judged,
            evaluations: run.evaluations,
            seconds: run.seconds,
            horizon_s: self.horizon_s,
            starts_at_s: 0.0,
            of_bodies: Vec::new(),
        }
    }

    /// Whether nothing grows that does not grow in truth, over the horizon and in the long run.
    pub(super) fn is_bounded(&self, spec: LaneSpec, tick_hz: u32) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            if truth.is_too_dear() {
                let run = follow_energy(truth, spec, tick_hz, self.most_work);
                return match run.is_bounded() {
                    _ if run.is_too_much => Err(CriterionMiss::Unknown),
                    true => Ok(run.evaluations as f64 / run.seconds),
                    false => Err(CriterionMiss::Fails),
                };
            }
            if let Some(modes) = Modes::of(truth, spec, tick_hz)? {
                if !modes.are_bounded() {
                    return Err(CriterionMiss::Fails);
                }
                let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
                return cost_if(run.failure.is_none(), &run);
            }
            let run = follow(truth, spec, tick_hz, Until::Grown, self.most_work);
            match bounded(truth, &run) {
                Some(is_bounded) => cost_if(is_bounded, &run),
                None => Err(CriterionMiss::Unknown),
            }
        })
    }

    /// Whether every body stays within [`TOLERANCE`] of its truth.
    pub(super) fn is_accurate(&self, spec: LaneSpec, tick_hz: u32) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            let run = follow(truth, spec, tick_hz, Until::Error(TOLERANCE), self.most_work);
            require_truth(truth, &run, tick_hz)?;
            cost_if(run.error <= TOLERANCE, &run)
        })
    }

    /// Whether every body has the true amplitude within [`VISIBLE`] and the true frequency within
    /// [`FREQUENCY_TOLERANCE`]. A body that makes too few turns has to stay within [`VISIBLE`] of its range. What is
    /// accurate looks right.
    pub(super) fn looks_right(&self, spec: LaneSpec, tick_hz: u32) -> CriterionFinding {
        self.each(tick_hz, |truth| {
            let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
            require_truth(truth, &run, tick_hz)?;
            if run.failure.is_some() || run.error <= TOLERANCE {
                return cost_if(run.failure.is_none(), &run);
            }
            // The range is twice the amplitude.
            let is_near = run.error <= 2.0 * VISIBLE;
            let Some(swing) = &truth.swing else { return cost_if(is_near, &run) };
            let modes = Modes::of(truth, spec, tick_hz)?;
            let error = match &modes {
                Some(modes) => modes.frequency_error(),
                None => frequency_error(truth, &run).map(|measured| measured.error),
            };
            let Some(error) = error else { return cost_if(is_near, &run) };
            // With few ticks per turn, not every turn shows its peak.
            let ticks_per_turn = swing.period() * f64::from(tick_hz);
            let together = if ticks_per_turn < FEW_TICKS { 4 } else { 1 };
            let widest = |windows: &[f64]| windows.iter().copied().fold(0.0, f64::max);
            let mut pairs = run.windows.chunks(together).zip(swing.windows.chunks(together));
            let is_as_wide =
                pairs.all(|(lane, truth)| (widest(lane) - widest(truth)).abs() <= VISIBLE);
            cost_if(is_as_wide && error.abs() <= FREQUENCY_TOLERANCE, &run)
        })
    }

    /// Applies `of` to every body, which returns the evaluations per second of a body that meets the criterion.
    fn each(
        &self,
        tick_hz: u32,
        of: impl Fn(&BodyTruth) -> Result<f64, CriterionMiss>,
    ) -> CriterionFinding {
        if !self.has_ticks(tick_hz) {
            return CriterionFinding::Unknown;
        }
        let mut evaluations_per_s = 0.0;
        let mut is_unknown = false;
        for (body, truth) in self.truths.iter().enumerate() {
            match of(truth) {
                Ok(evaluations) => evaluations_per_s += evaluations,
                Err(CriterionMiss::Fails) => return CriterionFinding::Fails { body },
                Err(CriterionMiss::Unknown) => is_unknown = true,
            }
        }
        if is_unknown {
            CriterionFinding::Unknown
        } else {
            CriterionFinding::Holds { evaluations_per_s }
        }
    }
}

/// The outcome of a run; `change` is that of its amplitude, `gap` the largest error of the truth.
fn outcome_of(verdict: &Verdict, run: &Run, change: Change, gap: f64) -> Outcome {
    if let Some(failure) = &run.failure {
        return failure.outcome();
    }
    if verdict.not_judged.is_some() {
        return Outcome::NotJudged;
    }
    if verdict.no_truth.is_some() {
        return Outcome::NoTruth;
    }
    match change {
        _ if run.error <= ROUNDING && gap <= ROUNDING => Outcome::Rounding,
        _ if run.error <= TOLERANCE => Outcome::Accurate,
        Change::Grows => Outcome::GainsEnergy,
        Change::Dies => Outcome::LosesEnergy,
        Change::None => Outcome::OutOfPhase,
    }
}

/// The evaluations per simulated second of a run, if it meets a criterion.
fn cost_if(holds: bool, run: &Run) -> Result<f64, CriterionMiss> {
    match holds {
        _ if run.is_too_much => Err(CriterionMiss::Unknown),
        true => Ok(run.evaluations as f64 / run.seconds),
        false => Err(CriterionMiss::Fails),
    }
}

/// Why the truth cannot be used; `None` if it can. `gap` is its largest error in amplitudes.
fn without_truth(truth: &BodyTruth, run: &Run, gap: f64) -> Option<NoTruth> {
    if let Some(failure) = run.no_truth.as_ref().or(truth.failure.as_ref()) {
        return Some(NoTruth::Failed(failure.clone()));
    }
    let is_vague = gap.is_nan() || gap > TOLERANCE / 2.0;
    (is_vague && !run.is_cut_short()).then_some(NoTruth::Vague(gap))
}

/// Fails if the truth cannot be used for this run.
fn require_truth(truth: &BodyTruth, run: &Run, tick_hz: u32) -> Result<(), CriterionMiss> {
    let gap = truth.gap(run.seconds, tick_hz);
    without_truth(truth, run, gap).map_or(Ok(()), |_| Err(CriterionMiss::Unknown))
}
