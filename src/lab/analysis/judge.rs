//! The verdict on a lane on a scene, from a run compared with the truth tick by tick.
//!
//! A scene is judged from its start, at one tick rate, with the inputs of its script, each body by itself.
//! A linear body under a method of equal steps has one map from tick to tick, whose modes give its motion at all later
//! times. Any other body is followed for [`LONG_RUN`](super::LONG_RUN) times the horizon, and its verdict claims nothing
//! beyond that.

use super::by_energy::follow_energy;
use super::change::{Change, fill_from_run};
use super::chase_finding::ChaseFinding;
use super::limits::TOLERANCE;
use super::modes::Modes;
use super::outcome::Outcome;
use super::run::{MAX_WORK, Run, Until, follow};
use super::survey::TimedInput;
use super::truth::{BodyTruth, ticks};
use super::verdict::{NoTruth, NotJudged, Verdict};
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::Scene;

mod criteria;

pub(super) use criteria::CriterionFinding;

/// The longest horizon in simulated seconds. A shorter scene is judged over its whole length.
pub const MAX_HORIZON_S: f64 = 60.0;

/// The largest error in amplitudes that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The true motion of a scene, with which lanes are compared.
pub struct Judge {
    horizon_s: f64,
    throttle: f64,
    most_work: u64,
    truths: Vec<BodyTruth>,
}

/// The script's actions on the body at this index of the scene.
fn inputs_of(scene: &Scene, body: usize) -> Vec<TimedInput> {
    let actions = scene.timed_script().filter(|(_, action)| action.acts_on(body));
    actions.map(|(t, action)| TimedInput { t, action: action.clone() }).collect()
}

impl Judge {
    /// A judge of `scene` under this throttle, -1 to 1, over its length but at most [`MAX_HORIZON_S`].
    pub fn new(scene: &Scene, throttle: f64) -> Self {
        Self::over(scene, throttle, scene.seconds.min(MAX_HORIZON_S))
    }

    /// A judge of `scene` under this throttle over `horizon_s` simulated seconds, which is positive and may exceed the
    /// scene's length.
    pub fn over(scene: &Scene, throttle: f64, horizon_s: f64) -> Self {
        let of =
            |(place, body)| BodyTruth::new(body, &inputs_of(scene, place), throttle, horizon_s);
        let truths = scene.bodies.iter().enumerate().map(of);
        Self { horizon_s, throttle, most_work: MAX_WORK, truths: truths.collect() }
    }

    /// Limits the work of each run to less than [`MAX_WORK`]; what takes more is not known.
    pub(super) fn within(mut self, most_work: u64) -> Self {
        self.most_work = most_work;
        self
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
        self.verdict_within(self.most_work, spec, tick_hz)
    }

    /// The work done so far, that on the truth included, in the unit of [`MAX_WORK`].
    pub(super) fn work_done(&self) -> u64 {
        self.truths.iter().map(BodyTruth::work_done).sum()
    }

    /// The verdict on a lane, whose run on each body takes at most this work, or is not judged.
    pub(super) fn verdict_within(&self, most_work: u64, spec: LaneSpec, tick_hz: u32) -> Verdict {
        let of_body = |body| self.of_body(body, spec, tick_hz, most_work);
        let verdicts: Vec<Verdict> = (0..self.truths.len()).map(of_body).collect();
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

    fn of_body(&self, body: usize, spec: LaneSpec, tick_hz: u32, most_work: u64) -> Verdict {
        let truth = &self.truths[body];
        if truth.is_too_dear() {
            return self.by_energy(body, spec, tick_hz, most_work);
        }
        let found = Modes::of(truth, spec, tick_hz);
        let most_work = if found.is_ok() { most_work } else { 0 };
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
    fn by_energy(&self, body: usize, spec: LaneSpec, tick_hz: u32, most_work: u64) -> Verdict {
        let truth = &self.truths[body];
        let ticks = ticks(self.horizon_s, tick_hz);
        // Growth would be sought beyond the horizon for a verdict that nobody gets.
        let most_work = if ticks == 0 { 0 } else { most_work };
        let run = follow_energy(truth, spec, tick_hz, most_work);
        let not_judged = match ticks {
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

/// Why the truth cannot be used; `None` if it can. `gap` is its largest error in amplitudes.
fn without_truth(truth: &BodyTruth, run: &Run, gap: f64) -> Option<NoTruth> {
    if let Some(failure) = run.no_truth.as_ref().or(truth.failure.as_ref()) {
        return Some(NoTruth::Failed(failure.clone()));
    }
    let is_vague = gap.is_nan() || gap > TOLERANCE / 2.0;
    (is_vague && !run.is_cut_short()).then_some(NoTruth::Vague(gap))
}
