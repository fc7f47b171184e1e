//! How a lane fares on a scene: measured on the run, tick by tick against the truth.
//!
//! A scene is judged from its start, without its script, under one throttle from beginning to end, each body by itself.
//! A linear body under a method of equal steps has one map from tick to tick, whose modes say what becomes of its motion
//! ever after. Any other is followed for [`LONG_RUN`](super::LONG_RUN) times the horizon, and what is not seen by then is not said.

use super::run::{MOST_WORK, Run, Until, follow};
use super::truth::{BodyTruth, Swing, ticks};
use super::verdict::{NoTruth, Verdict, Word};
use crate::lab::scene::{LaneSpec, Scene};
use crate::sim::integrators::StepFailure;
use crate::sim::stability::{FOREVER_S, NormalMode, Stability, Tick, undriven};

/// The error that still counts as accurate: a hundredth of the amplitude, about what can be seen.
pub const TOLERANCE: f64 = 0.01;

/// The change of a swing's amplitude that is seen: a twentieth.
pub const VISIBLE: f64 = 0.05;

/// The frequency error that still looks right.
pub const RIGHT_PITCH: f64 = 0.01;

/// The longest stretch that is judged, in simulated seconds. Shorter scenes are judged whole.
pub const LONGEST_HORIZON_S: f64 = 60.0;

/// An error of this part of the amplitude is rounding.
const ROUNDING: f64 = 1e-9;

/// The growth of the swing over the second half of a long run that is growth and not the last of what comes and goes.
const GROWTH_SEEN: f64 = 2e-3;

/// A change of the amplitude this large is one, however it came about: a factor.
const LEAP: f64 = 1.5;

/// The truth over a scene, to hold lanes against.
pub struct Judge {
    horizon_s: f64,
    throttle: f64,
    most_work: u64,
    truths: Vec<BodyTruth>,
}

/// Whether a lane meets a [`Criterion`](super::advice::Criterion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finding {
    /// It does, with so many evaluations per simulated second.
    Holds { evaluations_per_s: f64 },
    /// The body on this place of the scene does not.
    Fails { body: usize },
    /// It would take too much work, or there is no truth, to tell.
    Unknown,
}

impl Judge {
    /// For `scene` under this throttle, -1 to 1, over its length or its first [`LONGEST_HORIZON_S`].
    pub fn new(scene: &Scene, throttle: f64) -> Self {
        Self::over(scene, throttle, scene.seconds.min(LONGEST_HORIZON_S))
    }

    /// The same over `horizon_s` simulated seconds, more than 0, however long the scene is.
    pub fn over(scene: &Scene, throttle: f64, horizon_s: f64) -> Self {
        let truths = scene.bodies.iter().map(|body| BodyTruth::new(body, throttle, horizon_s));
        Self { horizon_s, throttle, most_work: MOST_WORK, truths: truths.collect() }
    }

    /// The same with less work for each run than [`MOST_WORK`]: what takes more is then not known.
    pub(super) fn within(mut self, most_work: u64) -> Self {
        self.most_work = most_work;
        self
    }

    /// The throttle that the scene is judged under.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }

    /// The simulated seconds that lanes are held against the truth.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// The names of the bodies, in scene order.
    pub fn bodies(&self) -> impl Iterator<Item = &str> {
        self.truths.iter().map(|truth| truth.body.name.as_str())
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
        let modes = Modes::of(truth, spec, tick_hz);
        let until = if modes.is_some() { Until::Horizon } else { Until::LongRun };
        let run = follow(truth, spec, tick_hz, until, self.most_work);
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
            evaluations: run.evaluations,
            seconds: run.seconds,
            horizon_s: self.horizon_s,
        };
        let change = match &modes {
            Some(modes) => modes.tell(&mut verdict, self.horizon_s),
            None => tell_of_run(&mut verdict, truth, &run, self.horizon_s),
        };
        if run.fate.is_some() {
            verdict.is_bounded = Some(false);
        }
        verdict.no_truth = self.without_truth(truth, &run, tick_hz);
        let gap = truth.course(tick_hz).gap(ticks(run.seconds, tick_hz));
        verdict.word = self.word(&verdict, &run, change, gap);
        if matches!(verdict.word, Word::NotJudged | Word::NoTruth | Word::BlewUp | Word::GaveUp) {
            verdict.frequency_error = None;
            verdict.energy_drift = None;
        }
        if verdict.word == Word::NotJudged {
            verdict.is_bounded = None;
        }
        verdict
    }

    /// Why the truth cannot serve, if it cannot.
    fn without_truth(&self, truth: &BodyTruth, run: &Run, tick_hz: u32) -> Option<NoTruth> {
        if let Some(failure) = run.no_truth.as_ref().or(truth.failure.as_ref()) {
            return Some(NoTruth::Failed(failure.clone()));
        }
        let gap = truth.course(tick_hz).gap(ticks(run.seconds, tick_hz));
        (gap.is_nan() || gap > TOLERANCE / 2.0).then_some(NoTruth::Vague(gap))
    }

    fn word(&self, verdict: &Verdict, run: &Run, change: Change, gap: f64) -> Word {
        if let Some(fate) = &run.fate {
            return match fate.failure {
                StepFailure::Escaped { .. } | StepFailure::NotFinite { .. } => Word::BlewUp,
                _ => Word::GaveUp,
            };
        }
        if verdict.no_truth.is_some() {
            return Word::NoTruth;
        }
        if run.is_too_much && run.seconds < run.horizon_s {
            return Word::NotJudged;
        }
        match change {
            _ if run.error <= ROUNDING && gap <= ROUNDING => Word::Rounding,
            _ if run.error <= TOLERANCE => Word::Accurate,
            Change::Grows => Word::GainsEnergy,
            Change::Dies => Word::LosesEnergy,
            Change::None => Word::OutOfPhase,
        }
    }

    /// Whether nothing grows that should not, over the horizon and in the long run.
    pub(super) fn is_bounded(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(|truth| {
            if let Some(modes) = Modes::of(truth, spec, tick_hz) {
                if !modes.are_bounded() {
                    return Err(false);
                }
                let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
                return verdict_on(&run, run.fate.is_none());
            }
            let run = follow(truth, spec, tick_hz, Until::Grown, self.most_work);
            match bounded(truth, &run) {
                Some(is_bounded) => verdict_on(&run, is_bounded),
                None => Err(true),
            }
        })
    }

    /// Whether every body stays within [`TOLERANCE`] of its truth.
    pub(super) fn is_accurate(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(|truth| {
            let run = follow(truth, spec, tick_hz, Until::Error(TOLERANCE), self.most_work);
            self.usable(truth, &run, tick_hz)?;
            verdict_on(&run, run.error <= TOLERANCE)
        })
    }

    /// Whether every body swings as far as its truth, within [`VISIBLE`], and as often, within [`RIGHT_PITCH`]; one that
    /// does not swing, whether it stays within [`VISIBLE`] of its range.
    pub(super) fn looks_right(&self, spec: LaneSpec, tick_hz: u32) -> Finding {
        self.each(|truth| {
            let Some(swing) = &truth.swing else {
                let run = follow(truth, spec, tick_hz, Until::Error(f64::INFINITY), self.most_work);
                self.usable(truth, &run, tick_hz)?;
                // The range is twice the amplitude.
                return verdict_on(&run, run.coordinate_error <= 2.0 * VISIBLE);
            };
            let run = follow(truth, spec, tick_hz, Until::Horizon, self.most_work);
            self.usable(truth, &run, tick_hz)?;
            let pairs = run.windows.iter().zip(&swing.windows);
            let is_as_wide = pairs.clone().all(|(lane, truth)| (lane - truth).abs() <= VISIBLE);
            if run.fate.is_some() || !is_as_wide {
                return Err(false);
            }
            let error = match Modes::of(truth, spec, tick_hz) {
                Some(modes) => modes.frequency_error(),
                None => pitch(truth, &run).map(|pitch| pitch.error),
            };
            verdict_on(&run, error.is_some_and(|error| error.abs() <= RIGHT_PITCH))
        })
    }

    fn usable(&self, truth: &BodyTruth, run: &Run, tick_hz: u32) -> Result<(), bool> {
        if self.without_truth(truth, run, tick_hz).is_some() { Err(true) } else { Ok(()) }
    }

    /// What `of` finds of all bodies together: evaluations per second, or whether that it does not hold is unknown.
    fn each(&self, of: impl Fn(&BodyTruth) -> Result<f64, bool>) -> Finding {
        let mut evaluations_per_s = 0.0;
        let mut is_unknown = false;
        for (body, truth) in self.truths.iter().enumerate() {
            match of(truth) {
                Ok(evaluations) => evaluations_per_s += evaluations,
                Err(false) => return Finding::Fails { body },
                Err(true) => is_unknown = true,
            }
        }
        if is_unknown { Finding::Unknown } else { Finding::Holds { evaluations_per_s } }
    }
}

fn verdict_on(run: &Run, holds: bool) -> Result<f64, bool> {
    if run.is_too_much {
        return Err(true);
    }
    if holds { Ok(run.evaluations as f64 / run.seconds) } else { Err(false) }
}

/// What becomes of the amplitude within the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    None,
    Grows,
    Dies,
}

/// What a method of equal steps makes of the modes of a linear body.
struct Modes<'a> {
    /// Each with its share of the motion's energy.
    modes: Vec<(&'a NormalMode, f64, Stability)>,
}

impl<'a> Modes<'a> {
    /// `None` where the body is not linear, where the method chooses its own steps, or where it gives up.
    fn of(truth: &'a BodyTruth, spec: LaneSpec, tick_hz: u32) -> Option<Self> {
        let chooses = spec.method.tolerance.is_some() || !spec.method.keeps_time;
        let modes = truth.modes.as_ref().filter(|_| !chooses)?;
        let free = undriven(&*truth.start(crate::sim::Solver::Truth));
        let tick = Tick { t: 0.0, h: 1.0 / f64::from(tick_hz), substeps: spec.substeps };
        let each = modes.iter().map(|(mode, share)| {
            let stability = mode.stability(&*free, spec.solver(), tick).ok()?;
            Some((mode, *share, stability))
        });
        Some(Self { modes: each.collect::<Option<_>>()? })
    }

    fn are_bounded(&self) -> bool {
        self.modes.iter().all(|(.., stability)| stability.is_bounded())
    }

    /// Of the mode that carries the most energy of those that swing.
    fn frequency_error(&self) -> Option<f64> {
        let swinging = self.modes.iter().filter(|(mode, ..)| mode.swing().is_some());
        swinging.max_by(|a, b| a.1.total_cmp(&b.1))?.2.frequency_error
    }

    fn are_conserved(&self) -> bool {
        self.modes.iter().all(|(mode, ..)| mode.is_conserved() && mode.omega_squared > 0.0)
    }

    /// The amplitude after `t` seconds, in units of that at the start; of modes that decay in truth, what grows.
    fn amplitude(&self, t: f64) -> f64 {
        let conserved = self.are_conserved();
        let energy = self.modes.iter().map(|(_, share, stability)| {
            let growth = if stability.is_bounded() { 0.0 } else { stability.growth_per_s };
            let rate = if conserved && growth <= 0.0 { -stability.loss_per_s } else { growth };
            if *share > 0.0 {
                share * libm::exp(2.0 * rate.max(0.0) * t + 2.0 * rate.min(0.0) * t)
            } else {
                0.0
            }
        });
        energy.sum::<f64>().sqrt()
    }

    /// The first time, up to [`FOREVER_S`], at which the amplitude is past `level`.
    fn reaches(&self, is_past: impl Fn(f64) -> bool) -> Option<f64> {
        let (mut low, mut high) = (0.0, FIRST_LOOK_S);
        while !is_past(self.amplitude(high)) {
            (low, high) = (high, high * LOOKS_APART);
            if low > FOREVER_S {
                return None;
            }
        }
        for _ in 0..60 {
            let middle = low + (high - low) / 2.0;
            if is_past(self.amplitude(middle)) { high = middle } else { low = middle }
        }
        Some(high)
    }

    fn tell(&self, verdict: &mut Verdict, horizon_s: f64) -> Change {
        verdict.is_bounded = Some(self.are_bounded());
        verdict.frequency_error = self.frequency_error();
        let moves = self.modes.iter().any(|(_, share, _)| *share > 0.0);
        if moves {
            verdict.doubles_in_s = self.reaches(|amplitude| amplitude >= 2.0);
            if self.are_conserved() {
                verdict.halves_in_s = self.reaches(|amplitude| amplitude <= 0.5);
            }
        }
        let worst = self.modes.iter().filter_map(|(.., stability)| stability.doubling_s());
        let worst = worst.min_by(f64::total_cmp);
        // A mode that is not in the motion yet grows out of its rounding.
        let hidden =
            worst.filter(|&worst| verdict.doubles_in_s.is_none_or(|all| worst < all / 2.0));
        verdict.parasite_doubles_in_s = hidden;
        let amplitude = if moves { self.amplitude(horizon_s) } else { 1.0 };
        if self.are_conserved() && moves {
            verdict.energy_change = Some(amplitude * amplitude - 1.0);
        }
        change(amplitude)
    }
}

/// When the amplitude is first looked at, in seconds, and the factor from one look to the next.
const FIRST_LOOK_S: f64 = 1e-9;
const LOOKS_APART: f64 = 1.05;

fn change(amplitude: f64) -> Change {
    match amplitude {
        a if a >= 1.0 + VISIBLE => Change::Grows,
        a if a <= 1.0 - VISIBLE => Change::Dies,
        _ => Change::None,
    }
}

/// What the run itself shows.
fn tell_of_run(verdict: &mut Verdict, truth: &BodyTruth, run: &Run, horizon_s: f64) -> Change {
    verdict.is_bounded = bounded(truth, run);
    verdict.doubles_in_s = run.doubled_at;
    let period = truth.swing.as_ref().map_or(horizon_s, Swing::period);
    let end = run.followed_s;
    // A swing that stays small for some turns, after more turns than would blur the moment.
    let died = |t: f64| end - t >= 4.0 * period && t >= 10.0 * period;
    verdict.halves_in_s = run.halved_at.filter(|&t| died(t));
    verdict.frequency_error = pitch(truth, run).filter(Pitch::is_steady).map(|pitch| pitch.error);
    let within = |at: Option<f64>| at.is_some_and(|t| t <= horizon_s);
    if truth.energy_scale.is_none() {
        let grows = within(run.doubled_at) || within(run.rushed_at);
        return if grows { Change::Grows } else { Change::None };
    }
    let amplitude = |quarter: f64| (1.0 + quarter).max(0.0).sqrt();
    let (first, last) = (amplitude(run.quarters[0]), amplitude(run.quarters[3]));
    verdict.energy_change = Some(run.quarters[3]).filter(|change| change.is_finite());
    let trend = change(last / first);
    match change(last) {
        _ if within(run.doubled_at) => Change::Grows,
        Change::Grows if trend == Change::Grows || last >= LEAP => Change::Grows,
        Change::Dies if trend == Change::Dies || last * LEAP <= 1.0 => Change::Dies,
        _ => Change::None,
    }
}

/// Whether a followed body stays as small as it is in truth; `None` where it was not followed to the end.
fn bounded(truth: &BodyTruth, run: &Run) -> Option<bool> {
    let failed = run.fate.is_some() || run.later.is_some();
    if failed || run.doubled_at.is_some() || run.rushed_at.is_some() {
        return Some(false);
    }
    if run.is_too_much || truth.failure.is_some() || run.is_losing && !run.has_come_to_rest {
        return None;
    }
    let amplitude = |quarter: f64| (1.0 + quarter).max(0.0).sqrt();
    let [_, early, _, late] = run.long_quarters.map(amplitude);
    let grows = truth.energy_scale.is_some() && late / early > 1.0 + GROWTH_SEEN;
    Some(!grows)
}

/// How much too fast a lane swings, as a part of the true frequency: over all its turns and over either half of them.
struct Pitch {
    error: f64,
    halves: [f64; 2],
    /// What the moments between ticks may make of the error.
    blur: f64,
}

impl Pitch {
    /// Whether the error is the same all the time, and can be told from that of its measuring.
    fn is_steady(&self) -> bool {
        let least = (0.005 * self.error.abs()).max(2.5e-5);
        let [a, b] = self.halves;
        self.blur <= least && (a - b).abs() <= 2.0 * least
    }
}

fn pitch(truth: &BodyTruth, run: &Run) -> Option<Pitch> {
    let swing = truth.swing.as_ref()?;
    let h = run.horizon_s / run.series.len().max(1) as f64;
    let level = truth.centres[swing.coordinate];
    let lane = crossings(&run.series, level);
    let count = lane.len().min(swing.crossings.len());
    if count < 3 {
        return None;
    }
    let error = |from: usize, to: usize| {
        let exact = swing.crossings[to] - swing.crossings[from];
        exact / (h * (lane[to].at - lane[from].at)) - 1.0
    };
    let middle = count / 2;
    let span = lane[count - 1].at - lane[0].at;
    Some(Pitch {
        error: error(0, count - 1),
        halves: [error(0, middle), error(middle, count - 1)],
        blur: (lane[0].blur + lane[count - 1].blur) / span,
    })
}

/// Where a series passes a level upwards, counted in samples.
struct Crossing {
    at: f64,
    /// By how much the place may be off.
    blur: f64,
}

fn crossings(series: &[f64], level: f64) -> Vec<Crossing> {
    let passes = |k: &usize| series[*k] < level && series[k + 1] >= level;
    (1..series.len().saturating_sub(2))
        .filter(passes)
        .map(|k| {
            let y: [f64; 4] = std::array::from_fn(|i| series[k - 1 + i] - level);
            let straight = y[1] / (y[1] - y[2]);
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..40 {
                let middle = (low + high) / 2.0;
                if cubic(&y, middle) < 0.0 { low = middle } else { high = middle }
            }
            Crossing { at: (k + 1) as f64 + low, blur: 0.2 * (low - straight).abs() }
        })
        .collect()
}

/// The cubic through four values at -1, 0, 1 and 2.
fn cubic(y: &[f64; 4], s: f64) -> f64 {
    let [a, b, c, d] = y;
    -s * (s - 1.0) * (s - 2.0) / 6.0 * a + (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0 * b
        - (s + 1.0) * s * (s - 2.0) / 2.0 * c
        + (s + 1.0) * s * (s - 1.0) / 6.0 * d
}

impl Swing {
    /// The mean time from one crossing to the next, in seconds.
    fn period(&self) -> f64 {
        let turns = self.crossings.len() - 1;
        (self.crossings[turns] - self.crossings[0]) / turns as f64
    }
}
