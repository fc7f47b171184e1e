//! The verdict on a lane on a scene, from a tick-by-tick comparison with the truth.
//!
//! A scene is judged from its start, at one tick rate, with the inputs of its script, each body separately. A linear
//! body under a method of equal steps has one map from tick to tick, whose modes give its motion at all later times.
//! Any other body is followed for [`LONG_RUN`](super::LONG_RUN) times the horizon, and the verdict claims nothing about
//! later times.

use std::sync::Arc;

use super::amplitude::Trend;
use super::by_bounces::follow_bounces;
use super::by_energy::{EnergyRun, follow_energy};
use super::by_spin::follow_spin;
use super::change::MotionChange;
use super::chase_finding::ChaseFinding;
use super::criterion::TOLERANCE;
use super::frequency;
use super::judged_run::{JudgedRun, MAX_WORK, Until, follow};
use super::modes::Modes;
use super::pace::Pace;
use super::slices::{Meter, Once, block_on};
use super::truth::{BodyTruth, ticks};
use super::verdict::{Comparison, Finding, LongTerm, NoTruth, NotJudged, Verdict};
use crate::scene::{LaneSpec, Scene, Scripted};
use crate::sim::TickRate;

mod criteria;

pub(super) use criteria::CriterionFinding;
use criteria::CriterionMiss;

/// Maximum horizon in simulated seconds. A shorter scene is judged over its whole length.
pub const MAX_HORIZON_S: f64 = 60.0;

/// The true motion of a scene, for comparison with its lanes.
pub struct Judge {
    horizon_s: f64,
    throttle: f64,
    max_work: u64,
    begins_later: bool,
    truths: Vec<BodyTruth>,
    /// Truths over their first swings, for bodies that make too few swings within the horizon. Each truth is computed
    /// on first use.
    of_swings: Vec<Once<BodyTruth>>,
    meter: Arc<Meter>,
}

/// Default throttle for judging a scene.
pub(super) const FULL_THROTTLE: f64 = 1.0;

/// Returns the horizon of a scene in simulated seconds.
pub(super) fn horizon_s(scene: &Scene) -> f64 {
    scene.seconds.min(MAX_HORIZON_S)
}

/// Returns the script's actions on the body with this index in the scene.
fn inputs_of(scene: &Scene, body: usize) -> Vec<Scripted> {
    scene.script.iter().filter(|row| row.action.acts_on(body)).cloned().collect()
}

impl Judge {
    /// Creates a judge of `scene` under full throttle, over the scene's length but at most [`MAX_HORIZON_S`].
    pub fn new(scene: &Scene) -> Self {
        Self::over(scene, horizon_s(scene))
    }

    /// Like [`Judge::new`], over `horizon_s` simulated seconds, which must be positive and may exceed the scene's
    /// length.
    pub fn over(scene: &Scene, horizon_s: f64) -> Self {
        block_on(Self::find(scene, FULL_THROTTLE, horizon_s, Arc::default()))
    }

    /// Like [`Judge::new`], under a throttle for the bodies that have one.
    ///
    /// # Panics
    /// If the throttle is not in -1 to 1.
    #[track_caller]
    pub fn at_throttle(scene: &Scene, throttle: f64) -> Self {
        assert!((-1.0..=1.0).contains(&throttle), "the throttle is {throttle}; give -1 to 1");
        block_on(Self::find(scene, throttle, horizon_s(scene), Arc::default()))
    }

    /// Like [`Self::over`], with `meter` as the counter of the judge's work.
    pub(super) async fn find(
        scene: &Scene,
        throttle: f64,
        horizon_s: f64,
        meter: Arc<Meter>,
    ) -> Self {
        let mut truths = Vec::with_capacity(scene.bodies.len());
        for (index, body) in scene.bodies.iter().enumerate() {
            let (inputs, meter) = (inputs_of(scene, index), meter.clone());
            truths.push(BodyTruth::find(body, &inputs, throttle, horizon_s, meter).await);
        }
        let of_swings = truths.iter().map(|_| Once::default()).collect();
        Self {
            horizon_s,
            throttle,
            max_work: MAX_WORK,
            begins_later: false,
            truths,
            of_swings,
            meter,
        }
    }

    /// Limits the work of each run to less than [`MAX_WORK`]. Results beyond the limit are unknown.
    pub(super) fn within(mut self, max_work: u64) -> Self {
        self.max_work = max_work;
        self
    }

    /// Judges a run from some later time on, if `begins_later` is true. The judge's clock begins at 0 all the same, so
    /// that it does not judge a body that a clock drives.
    pub(super) fn beginning_later(mut self, begins_later: bool) -> Self {
        self.begins_later = begins_later;
        self
    }

    /// Whether a body is nonlinear, so that its errors may have bumps.
    pub(super) fn has_bumps(&self) -> bool {
        self.truths.iter().any(|truth| truth.modes.is_none())
    }

    /// Whether a tick at this rate fits into the horizon.
    pub(super) fn has_ticks(&self, tick_hz: TickRate) -> bool {
        ticks(self.horizon_s, tick_hz) > 0
    }

    /// Returns the throttle under which the scene is judged.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }

    /// Returns the horizon in simulated seconds.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// Returns the verdict on a lane at this tick rate, which is the verdict on its worst body.
    pub fn verdict(&self, spec: LaneSpec, tick_hz: impl Into<TickRate>) -> Verdict {
        block_on(self.verdict_within(self.max_work, Pace { spec, tick_hz: tick_hz.into() }))
    }

    /// Returns the true motion of a body.
    pub(super) fn truth(&self, body: usize) -> &BodyTruth {
        &self.truths[body]
    }

    /// Returns the meter that counts the judge's work.
    pub(super) fn meter(&self) -> &Arc<Meter> {
        &self.meter
    }

    /// Returns the verdict on a lane. A body whose run exceeds the work limit is not judged.
    pub(super) async fn verdict_within(&self, max_work: u64, pace: Pace) -> Verdict {
        let mut verdicts = Vec::with_capacity(self.truths.len());
        for body in 0..self.truths.len() {
            verdicts.push(self.verdict_on_body(body, max_work, pace).await);
        }
        Self::of_all(verdicts)
    }

    /// Combines the verdicts on a lane's bodies into one.
    pub(super) fn of_all(verdicts: Vec<Verdict>) -> Verdict {
        let evaluations = verdicts.iter().map(|verdict| verdict.evaluations).sum();
        let bounded = verdicts.iter().map(|verdict| verdict.long_term.is_bounded);
        let is_bounded = bounded.reduce(|a, b| match (a, b) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        });
        let worst = verdicts.iter().reduce(|a, b| if b.badness() > a.badness() { b } else { a });
        let worst = worst.expect("a scene has a body").clone();
        let long_term = LongTerm { is_bounded: is_bounded.flatten(), ..worst.long_term };
        Verdict { evaluations, long_term, of_bodies: verdicts, ..worst }
    }

    async fn verdict_on_body(&self, body: usize, max_work: u64, pace: Pace) -> Verdict {
        let truth = &self.truths[body];
        if self.begins_later && truth.is_driven() {
            let finding = Finding::NotJudged(NotJudged::Driven);
            return self.verdict_with(body, finding, LongTerm::default());
        }
        if truth.is_too_dear() {
            // A tick of a large body may take seconds, so its run ends with the horizon. Later growth would matter to
            // nobody.
            return match self.not_judged(pace.tick_hz, max_work == 0) {
                Some(why) => self.verdict_with(body, Finding::NotJudged(why), LongTerm::default()),
                None => {
                    self.by_energy(body, pace.tick_hz, follow_energy(truth, pace, max_work).await)
                }
            };
        }
        if truth.bounces() {
            return self.by_bounces(body, pace, max_work).await;
        }
        if truth.spins() {
            return self.by_spin(body, pace, max_work).await;
        }
        let found = Modes::of(truth, pace).await;
        let max_work = if found.is_ok() { max_work } else { 0 };
        let by_modes = found
            .ok()
            .flatten()
            .map(|modes| modes.change(truth.measure(), self.horizon_s - truth.last_input_s()));
        let until = if by_modes.is_some() { Until::Horizon } else { Until::LongRun };
        let run = follow(truth, pace, until, max_work).await;
        self.compared(body, pace, &run, by_modes).await
    }

    /// Returns the verdict on a body from a run alongside the truth, and from its modes if they determine the motion.
    async fn compared(
        &self,
        body: usize,
        pace: Pace,
        run: &JudgedRun,
        by_modes: Option<MotionChange>,
    ) -> Verdict {
        let truth = &self.truths[body];
        let are_swings_known = by_modes.is_some() && truth.inputs.is_empty();
        let MotionChange { long_term, within, energy_change, frequency_error, early_s, width } =
            by_modes.unwrap_or_else(|| MotionChange::of_run(truth, run, self.horizon_s));
        // Modes know only the motion after the last input, and a lead begins before it.
        let early_s = if truth.last_input_s() > 0.0 {
            early_s.and(frequency::frequency_error(truth, run)).and_then(|found| found.early_s)
        } else {
            early_s
        };
        // A motion that grew once but stays bounded counts as bounded. A motion that has yet to grow does not.
        let change = match (within, long_term.is_bounded) {
            (Trend::Grows, Some(true)) => Trend::None,
            // An orbit that loses energy falls inward, and may fail there without having grown.
            (Trend::None, Some(false)) if run.has_only_lost() => Trend::Dies,
            (Trend::None, Some(false)) => Trend::Grows,
            _ => within,
        };
        let swing = truth.swing.as_ref();
        // Peaks lie between ticks, so that only an excess is certain.
        let too_wide = swing.map(|swing| run.widest / swing.widest()).filter(|&width| width > 1.0);
        let is_of_phase =
            |early_s: f64| swing.is_some_and(|swing| swing.is_cause_of(early_s, run.error));
        let truth_error = truth.gap(run.seconds, pace.tick_hz).await;
        let not_judged = self.not_judged(pace.tick_hz, run.is_cut_short());
        let finding = if let Some(failure) = run.failure.clone() {
            Finding::Failed { failure, by_energy: None }
        } else if let Some(why) = not_judged {
            Finding::NotJudged(why)
        } else if let Some(why) = without_truth(truth, run, truth_error) {
            Finding::NoTruth(why)
        } else {
            let known = Some(run).filter(|_| are_swings_known);
            let looks_right = self.looks_right(body, pace, known).await;
            let looks_right = match looks_right {
                Ok(_) => Some(true),
                Err(CriterionMiss::Fails) => Some(false),
                Err(CriterionMiss::Unknown) => None,
            };
            Finding::Compared(Comparison {
                error: run.error,
                error_at_s: run.error_at_s,
                last_error: run.last_error,
                truth_error,
                change,
                looks_right,
                width: width.or(too_wide),
                widths: None,
                early_s: early_s.filter(|&early_s| is_of_phase(early_s)),
                energy_change,
                energy_drift_percent: run.energy_drift,
                frequency_error,
            })
        };
        let chase = ChaseFinding::of(truth, pace, run.chase.as_ref());
        let verdict = self.verdict_with(body, finding, long_term);
        Verdict { chase, evaluations: run.evaluations, seconds: run.seconds, ..verdict }
    }

    /// Returns the verdict on a body with walls.
    async fn by_bounces(&self, body: usize, pace: Pace, max_work: u64) -> Verdict {
        let run = follow_bounces(&self.truths[body], pace, max_work).await;
        let finding = match (run.failure, self.not_judged(pace.tick_hz, run.is_too_much)) {
            (Some(failure), _) => Finding::Failed { failure, by_energy: None },
            (None, Some(why)) => Finding::NotJudged(why),
            (None, None) if run.finding.is_empty() => Finding::NotJudged(NotJudged::NoFlight),
            (None, None) => Finding::Bounced(run.finding),
        };
        let verdict = self.verdict_with(body, finding, LongTerm::default());
        Verdict { evaluations: run.evaluations, seconds: run.seconds, ..verdict }
    }

    /// Returns the verdict on a body that turns in space.
    async fn by_spin(&self, body: usize, pace: Pace, max_work: u64) -> Verdict {
        let run = follow_spin(&self.truths[body], pace, max_work).await;
        let finding = match (run.failure, self.not_judged(pace.tick_hz, run.is_too_much)) {
            (Some(failure), _) => Finding::Failed { failure, by_energy: None },
            (None, Some(why)) => Finding::NotJudged(why),
            (None, None) => Finding::Spun(run.finding),
        };
        let verdict = self.verdict_with(body, finding, LongTerm::default());
        Verdict { evaluations: run.evaluations, seconds: run.finding.seconds, ..verdict }
    }

    /// Returns the verdict on a body without a reference solution.
    fn by_energy(&self, body: usize, tick_hz: TickRate, run: EnergyRun) -> Verdict {
        let found = run.finding;
        let finding = match (run.failure, self.not_judged(tick_hz, run.is_too_much)) {
            (Some(failure), _) => Finding::Failed { failure, by_energy: Some(found) },
            (None, Some(why)) => Finding::NotJudged(why),
            (None, None) => Finding::ByEnergy(found),
        };
        // A run over the horizon does not show that nothing grows later.
        let is_bounded = (!found.is_bounded()).then_some(false);
        let verdict =
            self.verdict_with(body, finding, LongTerm { is_bounded, ..LongTerm::default() });
        Verdict { evaluations: run.evaluations, seconds: run.seconds, ..verdict }
    }

    /// Returns the reason if a run at this rate is not judged.
    fn not_judged(&self, tick_hz: TickRate, is_cut_short: bool) -> Option<NotJudged> {
        match self.has_ticks(tick_hz) {
            false => Some(NotJudged::ShorterThanATick),
            true => is_cut_short.then_some(NotJudged::TooMuchWork),
        }
    }

    fn verdict_with(&self, body: usize, finding: Finding, long_term: LongTerm) -> Verdict {
        let is_bounded = match finding {
            Finding::Failed { .. } => Some(false),
            Finding::NotJudged(_) => None,
            _ => long_term.is_bounded,
        };
        Verdict {
            finding,
            long_term: LongTerm { is_bounded, ..long_term },
            chase: None,
            body,
            body_name: self.truths[body].body.name.clone(),
            evaluations: 0,
            seconds: 0.0,
            horizon_s: self.horizon_s,
            starts_at_s: 0.0,
            of_bodies: Vec::new(),
        }
    }
}

/// Returns why the truth cannot be used; `None` if it can be used. `gap` is the truth's largest error in amplitudes.
fn without_truth(truth: &BodyTruth, run: &JudgedRun, gap: f64) -> Option<NoTruth> {
    if let Some(failure) = run.no_truth.as_ref().or(truth.failure.as_ref()) {
        return Some(NoTruth::Failed(failure.clone()));
    }
    let is_vague = gap.is_nan() || gap > TOLERANCE / 2.0;
    (is_vague && !run.is_cut_short()).then_some(NoTruth::Vague(gap))
}
