//! Steps one body under one method and compares it with its truth, tick by tick.
//!
//! Advice needs many runs, so that a run ends as soon as the rest cannot change the answer; see [`Until`].

use std::ops::ControlFlow;
use std::sync::Arc;

use super::energy::Energy;
use super::pace::Pace;
use super::swings::Swings;
use super::truth::{BodyTruth, FollowedBody, LONG_RUN, MovedMode, Swing, TruthSeries, ticks};
use super::verdict::RunFailure;
use crate::run::race::{Chase, StopReason};
pub use crate::scene::custom::MAX_WORK;
use crate::sim::integrators::StepFailure;
use crate::sim::stability::{Tick, unforced};
use crate::sim::{Stepper, TickRate};

/// A swing has grown if it reaches this multiple of the true amplitude, and has died away if it falls below the
/// inverse.
const TWICE: f64 = 2.0;

/// Multiple of the long run over which a swing is followed that is [losing](Energy::is_losing) at the end of the long
/// run. A shrinking orbit may still be ejected.
const FOLLOWED_ON: u64 = 100;

/// Periods for which a swing that has halved is still followed, if it must come to rest.
const FOLLOWED_PERIODS: f64 = 5.0;

/// Fraction of the true swing below which a swing has come to rest.
const AT_REST: f64 = 0.02;

/// The condition under which a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Until {
    /// The run ends with the horizon, or when the error exceeds this number of amplitudes.
    Error(f64),
    /// The run ends with the horizon.
    Horizon,
    /// The run ends with the horizon, and the swings are measured step by step.
    Swings,
    /// The run ends with the long run, or when the swing has grown.
    Grown,
    /// The run ends with the long run.
    LongRun,
}

/// The measurements of one body followed under one method.
#[derive(Clone, Debug, Default)]
pub(super) struct JudgedRun {
    /// Largest error of a coordinate or velocity over the horizon, in amplitudes, and the time of this error. The error
    /// is infinite if the body failed.
    pub(super) error: f64,
    pub(super) error_at_s: f64,
    /// Largest error in the last twentieth of the horizon, in amplitudes.
    pub(super) last_error: f64,
    /// Energy drift of largest magnitude over the horizon, in percent of the energy in motion.
    pub(super) energy_drift: Option<f64>,
    /// Failure of the body within the horizon.
    pub(super) failure: Option<RunFailure>,
    /// Failure of the truth.
    pub(super) no_truth: Option<StepFailure>,
    /// Whether too much work stopped the run.
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
    /// Number of simulated seconds within the horizon.
    pub(super) seconds: f64,
    /// Number of all simulated seconds.
    pub(super) followed_s: f64,
    /// Length of the horizon in seconds, in whole ticks.
    pub(super) horizon_s: f64,
    /// Failure of the body after the horizon.
    pub(super) later: Option<RunFailure>,
    /// Largest distance of a coordinate from its centre after a tick of the horizon, in amplitudes.
    pub(super) widest: f64,
    /// Times when a coordinate, and when a velocity, first reached twice its true amplitude, in seconds.
    pub(super) doubled_at: Option<f64>,
    pub(super) velocity_doubled_at: Option<f64>,
    /// Time since which the swing stays below half the true amplitude, in seconds.
    pub(super) halved_at: Option<f64>,
    /// Whether the swing was losing and was followed beyond the long run, and whether it came to rest there.
    pub(super) is_losing: bool,
    pub(super) has_come_to_rest: bool,
    /// The time in seconds after which a swing that has halved must come to rest; `None` if it need not.
    pub(super) rests_after_s: Option<f64>,
    /// Change of the energy at the last tick within the horizon, in units of the largest true kinetic energy.
    pub(super) energy_change: Option<f64>,
    /// Mean changes of the energy in the quarters of the horizon and of the long run, in units of the largest true
    /// kinetic energy.
    pub(super) quarters: [f64; 4],
    pub(super) long_quarters: [f64; 4],
    /// How the body approaches a fixed target, up to the first input.
    pub(super) chase: Option<Chase>,
    /// The swinging coordinate after each tick of the horizon.
    pub(super) series: Vec<f64>,
    /// The swings within the horizon, if they were measured and the body swings.
    pub(super) swings: Option<Swings>,
}

/// Runs the body of `truth` at this pace from its start.
pub(super) async fn follow(
    truth: &BodyTruth,
    Pace { spec, tick_hz }: Pace,
    until: Until,
    max_work: u64,
) -> JudgedRun {
    let horizon = ticks(truth.horizon_s, tick_hz);
    let end = match until {
        Until::Error(_) | Until::Horizon | Until::Swings => horizon,
        Until::Grown | Until::LongRun => ticks(LONG_RUN * truth.horizon_s, tick_hz).max(horizon),
    };
    // A run that is not judged by its error needs no truth.
    let max_work = max_work.min(truth.meter.budget_left());
    let series = match until {
        Until::Grown => None,
        _ => Some(truth.series(tick_hz).await),
    };
    if series.as_ref().is_some_and(|series| series.is_too_much) {
        return JudgedRun { is_too_much: true, ..JudgedRun::new(tick_hz.seconds(horizon)) };
    }
    let mut followed = truth.follow(spec.solver(), spec.substeps, tick_hz).with_max_work(max_work);
    let stepper = &*followed.body.stepper;
    let swings = truth.swing.as_ref().filter(|_| until == Until::Swings).map(|swing| {
        let amplitudes = truth.amplitudes[..truth.centres.len()].to_vec();
        Swings::new(swing.coordinate, truth.centres.clone(), amplitudes, stepper)
    });
    let mut measured = RunMeter {
        chased_s: truth.inputs.first().map_or(truth.horizon_s, |input| input.at_s),
        energy: Energy::of(stepper, truth, horizon, end),
        run: JudgedRun {
            chase: Chase::new(stepper, 0.0),
            ..JudgedRun::new(tick_hz.seconds(horizon))
        },
        series,
        until,
        horizon,
        tick_hz,
    };
    followed.body.swings = swings;
    let see = |body: &FollowedBody, tick| measured.add(truth, body, tick);
    let mut stop = truth.run_until(&mut followed, end, see).await;
    if stop == StopReason::End && end > horizon {
        // The truth is not needed beyond the horizon.
        measured.run.is_losing = measured.energy.is_losing() && truth.swing.is_some();
        let stepper = &*followed.body.stepper;
        if measured.run.is_losing && measured.run.is_undecided(stepper, truth) {
            let period_s = truth.swing.as_ref().map(Swing::period);
            measured.run.rests_after_s = period_s
                .filter(|_| loses_when_small(truth, Pace { spec, tick_hz }))
                .map(|period_s| FOLLOWED_PERIODS * period_s);
            let see = |body: &FollowedBody, tick| measured.add(truth, body, tick);
            stop = truth.run_until(&mut followed, FOLLOWED_ON * end, see).await;
        }
    }
    measured.run.swings = followed.body.swings.take();
    measured.complete(stop, followed.ticks(), followed.t())
}

/// Whether a method, which may choose its steps, makes every small swing of a linear body smaller.
fn loses_when_small(truth: &BodyTruth, Pace { spec, tick_hz }: Pace) -> bool {
    let free = unforced(&*truth.with_last_parameters());
    let tick = Tick { t: 0.0, h: tick_hz.step_s(), substeps: spec.substeps };
    let loses = |moved: &MovedMode| {
        let found = moved.mode.stability_of_small(&*free, spec.solver(), tick);
        found.is_ok_and(|found| found.is_bounded() && found.loss_per_s > 0.0)
    };
    truth.is_oscillator() && truth.modes.iter().flatten().all(loses)
}

/// Measurements of a run in progress.
struct RunMeter {
    run: JudgedRun,
    energy: Energy,
    series: Option<Arc<TruthSeries>>,
    until: Until,
    horizon: u64,
    tick_hz: TickRate,
    /// Time in seconds for which a body that approaches a target is followed.
    chased_s: f64,
}

impl RunMeter {
    /// Adds the body's state after `tick` ticks, and stops the run when the rest is not needed.
    fn add(&mut self, truth: &BodyTruth, body: &FollowedBody, tick: u64) -> ControlFlow<()> {
        let (stepper, horizon) = (&*body.stepper, self.horizon);
        let t = self.tick_hz.seconds(tick);
        let run = &mut self.run;
        run.followed_s = t;
        if tick <= horizon {
            run.seconds = t;
            run.evaluations = stepper.evaluations();
            let first = stepper.q()[0];
            let chased_s = self.chased_s;
            run.chase.iter_mut().filter(|_| t <= chased_s).for_each(|it| it.add_place(first, t));
            if let Some(series) = &self.series {
                run.compare(stepper, series, truth, tick, horizon, t);
                if let Some(swing) = &truth.swing {
                    run.series.push(stepper.q()[swing.coordinate]);
                    let places = stepper.q().iter().zip(&truth.centres).zip(&truth.amplitudes);
                    let parts =
                        places.map(|((q, centre), amplitude)| (q - centre).abs() / amplitude);
                    run.widest = parts.fold(run.widest, f64::max);
                }
                if let Until::Error(enough) = self.until
                    && (run.error > enough || run.no_truth.is_some())
                {
                    return ControlFlow::Break(());
                }
            }
        }
        let drift = self.energy.add(stepper, tick);
        if tick <= horizon {
            run.energy_change = drift;
        }
        if tick <= horizon
            && let Some((drift, part)) = drift.zip(self.energy.percent)
        {
            let percent = part * drift;
            if run.energy_drift.is_none_or(|largest: f64| percent.abs() > largest.abs()) {
                run.energy_drift = Some(percent);
            }
        }
        run.watch_reach(stepper, truth, drift, t);
        let is_needed = match self.until {
            Until::Grown if run.has_grown() => false,
            _ => !run.is_losing || run.is_undecided(stepper, truth),
        };
        if is_needed { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// Completes the run, which has stopped after `ticks` ticks at time `t` (s).
    fn complete(self, stop: StopReason, ticks: u64, t: f64) -> JudgedRun {
        let Self { mut run, energy, horizon, .. } = self;
        (run.quarters, run.long_quarters) = (energy.horizon.means(), energy.long.means());
        run.is_too_much = stop == StopReason::TooMuchWork;
        let failure = RunFailure::of(stop, t);
        if ticks < horizon {
            run.failure = failure;
        } else {
            run.later = failure;
        }
        if run.failure.is_some() {
            run.error = f64::INFINITY;
            (run.error_at_s, run.last_error) = (run.seconds, f64::INFINITY);
        }
        run
    }
}

impl JudgedRun {
    fn new(horizon_s: f64) -> Self {
        Self { horizon_s, ..Self::default() }
    }

    fn compare(
        &mut self,
        stepper: &dyn Stepper,
        series: &TruthSeries,
        truth: &BodyTruth,
        tick: u64,
        horizon: u64,
        t: f64,
    ) {
        let Some(exact) = series.at(tick) else {
            self.no_truth = series.failure.clone();
            return;
        };
        let values = stepper.q().iter().chain(stepper.v());
        let parts = values.zip(exact).zip(&truth.amplitudes);
        let parts = parts.map(|((x, exact), amplitude)| (x - exact).abs() / amplitude);
        // This comparison is written so that NaN propagates.
        let off = parts.fold(0.0, |off, part| if part <= off { off } else { part });
        if off.is_nan() || off > self.error {
            (self.error, self.error_at_s) = (off, t);
        }
        if 20 * tick > 19 * horizon {
            self.last_error = if off <= self.last_error { self.last_error } else { off };
        }
    }

    fn watch_reach(
        &mut self,
        stepper: &dyn Stepper,
        truth: &BodyTruth,
        drift: Option<f64>,
        t: f64,
    ) {
        // The energy gives an oscillator's amplitude at every moment, but its coordinates give it only at their peaks.
        let swing = match drift {
            Some(drift) if truth.is_oscillator() => (1.0 + drift).max(0.0).sqrt(),
            _ => truth.reach.of_coordinates(stepper.q()),
        };
        if swing >= TWICE && self.doubled_at.is_none() {
            self.doubled_at = Some(t);
        }
        if self.velocity_doubled_at.is_none() && truth.reach.of_velocities(stepper.v()) >= TWICE {
            self.velocity_doubled_at = Some(t);
        }
        if swing * TWICE > 1.0 {
            self.halved_at = None;
        } else if self.halved_at.is_none() && truth.energy_scale.is_some() {
            self.halved_at = Some(t);
        }
    }
}

impl JudgedRun {
    /// Whether the run was stopped within the horizon.
    pub(super) fn is_cut_short(&self) -> bool {
        self.is_too_much && self.seconds < self.horizon_s
    }

    /// Whether a coordinate or a velocity has reached twice its true amplitude.
    fn has_grown(&self) -> bool {
        self.doubled_at.is_some() || self.velocity_doubled_at.is_some()
    }

    /// Whether a losing swing failed beyond the horizon before it had grown.
    pub(super) fn has_only_lost(&self) -> bool {
        self.is_losing && self.later.is_some() && !self.has_grown()
    }

    /// Whether a losing swing has neither grown nor come to rest.
    fn is_undecided(&mut self, stepper: &dyn Stepper, truth: &BodyTruth) -> bool {
        !self.has_grown() && !self.rests(stepper, truth)
    }

    /// Whether all coordinates and velocities are near their values at rest.
    fn rests(&mut self, stepper: &dyn Stepper, truth: &BodyTruth) -> bool {
        let parts =
            [truth.reach.of_coordinates(stepper.q()), truth.reach.of_velocities(stepper.v())];
        let halved_s = self.halved_at.map(|t| self.followed_s - t);
        let must_rest = halved_s.zip(self.rests_after_s).is_some_and(|(s, after_s)| s >= after_s);
        self.has_come_to_rest = must_rest || parts.iter().all(|&part| part <= AT_REST);
        self.has_come_to_rest
    }
}
