//! How a lane fares on a scene: measured on the run, tick by tick against the truth.
//!
//! A scene is judged from its start, at one tick rate, with the inputs of its script, each body by itself.
//! A linear body under a method of equal steps has one map from tick to tick, whose modes say what becomes of its motion
//! ever after. Any other is followed for [`LONG_RUN`](super::LONG_RUN) times the horizon, and what is not seen by then is not said.

use super::change::{Change, bounded, tell_of_run};
use super::limits::{RIGHT_PITCH, TOLERANCE, VISIBLE};
use super::modes::{Modes, TooMuch};
use super::pitch::pitch;
use super::run::{MOST_WORK, Run, Until, follow};
use super::survey::{Given, TimedInput};
use super::truth::{BodyTruth, ticks};
use super::verdict::{NoTruth, NotJudged, Verdict, Word};
use crate::lab::action::Action;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::Scene;
use crate::sim::integrators::StepFailure;

/// Ticks in a turn that show its peak.
const FEW_TICKS: f64 = 8.0;

/// The longest stretch that is judged, in simulated seconds. Shorter scenes are judged whole.
pub const LONGEST_HORIZON_S: f64 = 60.0;

/// An error of this part of the amplitude is rounding.
const ROUNDING: f64 = 1e-9;

/// The truth over a scene, to hold lanes against.
pub struct Judge {
    horizon_s: f64,
    throttle: f64,
    most_work: u64,
    truths: Vec<BodyTruth>,
}

/// What the script does to the body on this place of the scene, by the clock of the scene's own tick rates.
fn inputs_of(scene: &Scene, body: usize) -> Vec<TimedInput> {
    let (mut tick, mut t, mut hz) = (0, 0.0, f64::from(scene.tick_hz));
    let mut inputs = Vec::new();
    for scripted in &scene.script {
        t += (scripted.tick - tick) as f64 / hz;
        tick = scripted.tick;
        if let Action::TickHz(tick_hz) = scripted.action {
            hz = f64::from(tick_hz);
        }
        inputs.extend(Given::by(&scripted.action, body).map(|given| TimedInput { t, given }));
    }
    inputs
}

/// Whether a lane meets a [`Criterion`](super::advice::Criterion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finding {
    /// It does, with so many evaluations per simulated second.
    Holds { evaluations_per_s: f64 },
    /// The body on this place of the scene does not.
    Fails { body: usize },
    /// It would take too much work, or there is no truth or no tick, to tell.
    Unknown,
}

/// Why one body does not meet a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Missed {
    /// It fails.
    Fails,
    /// It would take too much work, or there is no truth, to tell.
    Unknown,
}

impl From<TooMuch> for Missed {
    fn from(_: TooMuch) -> Self {
        Missed::Unknown
    }
}

impl Judge {
    /// For `scene` under this throttle, -1 to 1, over its length or its first [`LONGEST_HORIZON_S`].
    pub fn new(scene: &Scene, throttle: f64) -> Self {
        Self::over(scene, throttle, scene.seconds.min(LONGEST_HORIZON_S))
    }

    /// The same over `horizon_s` simulated seconds, more than 0, however long the scene is.
    pub fn over(scene: &Scene, throttle: f64, horizon_s: f64) -> Self {
        let of =
            |(place, body)| BodyTruth::new(body, &inputs_of(scene, place), throttle, horizon_s);
        let truths = scene.bodies.iter().enumerate().map(of);
        Self { horizon_s, throttle, most_work: MOST_WORK, truths: truths.collect() }
    }

    /// The same with less work for each run than [`MOST_WORK`]: what takes more is then not known.
    pub(super) fn within(mut self, most_work: u64) -> Self {
        self.most_work = most_work;
        self
    }

    /// Whether all bodies are linear.
    pub(super) fn is_linear(&self) -> bool {
        self.truths.iter().all(|truth| truth.modes.is_some())
    }

    /// The throttle that the scene is judged under.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }

    /// The simulated seconds that lanes are held against the truth.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// What is to be said of a lane at this tick rate: of the body that fares worst.
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
        let worst = verdicts.into_iter().reduce(|a, b| if b.is_worse_than(&a) { b } else { a });
        let worst = worst.expect("a scene has a body");
        Verdict { evaluations, is_bounded: is_bounded.flatten(), ..worst }
    }

    fn of_body(&self, body: usize, spec: LaneSpec, tick_hz: u32) -> Verdict {
        let truth = &self.truths[body];
        let found = Modes::of(truth, spec, tick_hz);
        let most_work = if found.is_ok() { self.most_work } else { 0 };
        let modes = found.ok().flatten();
        let until = if modes.is_some() { Until::Horizon } else { Until::LongRun };
        let run = follow(truth, spec, tick_hz, until, most_work);
        let mut verdict = Verdict {
            word: Word::Accurate,
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
            fate: run.fate.clone(),
            no_truth: None,
            not_judged: None,
            evaluations: run.evaluations,
            seconds: run.seconds,
            horizon_s: self.horizon_s,
        };
        let change = match &modes {
            Some(modes) => modes.tell(&mut verdict, self.horizon_s - truth.last_input_s()),
            None => tell_of_run(&mut verdict, truth, &run, self.horizon_s),
        };
        if run.fate.is_some() {
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
        verdict.word = word(&verdict, &run, change, gap);
        if matches!(verdict.word, Word::NotJudged | Word::NoTruth | Word::BlewUp | Word::GaveUp) {
            verdict.frequency_error = None;
            verdict.energy_drift = None;
        }
        if verdict.word == Word::NotJudged {
            verdict.is_bounded = None;
        }
        verdict
    }

    /// Whether nothing grows that should not, over the horizon and in the long run.
    pub(super) fn is_bounded(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(tick_hz, |truth| {
            if let Some(modes) = Modes::of(truth, spec, tick_hz)? {
                if !modes.are_bounded() {
                    return Err(Missed::Fails);
                }
                let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
                return cost_if(run.fate.is_none(), &run);
            }
            let run = follow(truth, spec, tick_hz, Until::Grown, self.most_work);
            match bounded(truth, &run) {
                Some(is_bounded) => cost_if(is_bounded, &run),
                None => Err(Missed::Unknown),
            }
        })
    }

    /// Whether every body stays within [`TOLERANCE`] of its truth.
    pub(super) fn is_accurate(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(tick_hz, |truth| {
            let run = follow(truth, spec, tick_hz, Until::Error(TOLERANCE), self.most_work);
            require_truth(truth, &run, tick_hz)?;
            cost_if(run.error <= TOLERANCE, &run)
        })
    }

    /// Whether every body swings as far as its truth, within [`VISIBLE`], and as often, within [`RIGHT_PITCH`]; one that
    /// does not swing, or of which too few turns are seen, whether it stays within [`VISIBLE`] of its range. What is
    /// accurate looks right.
    pub(super) fn looks_right(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(tick_hz, |truth| {
            let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
            require_truth(truth, &run, tick_hz)?;
            if run.fate.is_some() || run.error <= TOLERANCE {
                return cost_if(run.fate.is_none(), &run);
            }
            // The range is twice the amplitude.
            let is_near = run.error <= 2.0 * VISIBLE;
            let Some(swing) = &truth.swing else { return cost_if(is_near, &run) };
            let modes = Modes::of(truth, spec, tick_hz)?;
            let error = match &modes {
                Some(modes) => modes.frequency_error(),
                None => pitch(truth, &run).map(|pitch| pitch.error),
            };
            let Some(error) = error else { return cost_if(is_near, &run) };
            // At a coarse tick few turns show their peak.
            let ticks_per_turn = swing.period() * f64::from(tick_hz);
            let together = if ticks_per_turn < FEW_TICKS { 4 } else { 1 };
            let widest = |windows: &[f64]| windows.iter().copied().fold(0.0, f64::max);
            let mut pairs = run.windows.chunks(together).zip(swing.windows.chunks(together));
            let is_as_wide =
                pairs.all(|(lane, truth)| (widest(lane) - widest(truth)).abs() <= VISIBLE);
            cost_if(is_as_wide && error.abs() <= RIGHT_PITCH, &run)
        })
    }

    /// What `of` finds of all bodies together; of one that meets the criterion it returns the evaluations per second.
    fn each(&self, tick_hz: u32, of: impl Fn(&BodyTruth) -> Result<f64, Missed>) -> Finding {
        if ticks(self.horizon_s, tick_hz) == 0 {
            return Finding::Unknown;
        }
        let mut evaluations_per_s = 0.0;
        let mut is_unknown = false;
        for (body, truth) in self.truths.iter().enumerate() {
            match of(truth) {
                Ok(evaluations) => evaluations_per_s += evaluations,
                Err(Missed::Fails) => return Finding::Fails { body },
                Err(Missed::Unknown) => is_unknown = true,
            }
        }
        if is_unknown { Finding::Unknown } else { Finding::Holds { evaluations_per_s } }
    }
}

/// The one word for a run; `change` is that of its amplitude, `gap` by how much the truth may be off.
fn word(verdict: &Verdict, run: &Run, change: Change, gap: f64) -> Word {
    if let Some(fate) = &run.fate {
        return match fate.failure {
            StepFailure::Escaped { .. } | StepFailure::NotFinite { .. } => Word::BlewUp,
            _ => Word::GaveUp,
        };
    }
    if verdict.not_judged.is_some() {
        return Word::NotJudged;
    }
    if verdict.no_truth.is_some() {
        return Word::NoTruth;
    }
    match change {
        _ if run.error <= ROUNDING && gap <= ROUNDING => Word::Rounding,
        _ if run.error <= TOLERANCE => Word::Accurate,
        Change::Grows => Word::GainsEnergy,
        Change::Dies => Word::LosesEnergy,
        Change::None => Word::OutOfPhase,
    }
}

/// What a run costs per simulated second if it meets a criterion.
fn cost_if(holds: bool, run: &Run) -> Result<f64, Missed> {
    match holds {
        _ if run.is_too_much => Err(Missed::Unknown),
        true => Ok(run.evaluations as f64 / run.seconds),
        false => Err(Missed::Fails),
    }
}

/// Why the truth cannot serve, if it cannot; `gap` is the most by which it may be off, in amplitudes.
fn without_truth(truth: &BodyTruth, run: &Run, gap: f64) -> Option<NoTruth> {
    if let Some(failure) = run.no_truth.as_ref().or(truth.failure.as_ref()) {
        return Some(NoTruth::Failed(failure.clone()));
    }
    let is_vague = gap.is_nan() || gap > TOLERANCE / 2.0;
    (is_vague && !run.is_cut_short()).then_some(NoTruth::Vague(gap))
}

/// Refuses to hold a run against a truth that cannot serve.
fn require_truth(truth: &BodyTruth, run: &Run, tick_hz: u32) -> Result<(), Missed> {
    let gap = truth.gap(run.seconds, tick_hz);
    without_truth(truth, run, gap).map_or(Ok(()), |_| Err(Missed::Unknown))
}
