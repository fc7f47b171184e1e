//! Follows a body that turns in space beside its truth.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::criterion::VISIBLE;
use super::pace::Pace;
use super::spin_finding::SpinFinding;
use super::truth::{BodyTruth, FollowedBody, FollowedRun, LONG_RUN, TruthSeries, ticks};
use super::verdict::RunFailure;
use crate::run::race::StopReason;
use crate::sim::bodies::Tumble;

/// The angle in radians between its axis and L above which a body has tipped over, which is 45°. If the largest true
/// angle times this factor is more, it is that.
const TIPPED: f64 = std::f64::consts::FRAC_PI_4;
const FARTHER: f64 = 1.5;

/// The rotation of a run.
#[derive(Default)]
pub(super) struct SpinRun {
    pub(super) finding: SpinFinding,
    pub(super) failure: Option<RunFailure>,
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
}

/// The times of the flips of an axis: the sign changes of the angular velocity about it.
#[derive(Default)]
struct Flips {
    before: Option<(f64, f64)>,
    at_s: Vec<f64>,
}

impl Flips {
    fn add(&mut self, t: f64, spin: f64) {
        if let Some((t0, before)) = self.before
            && before * spin < 0.0
        {
            self.at_s.push(t0 + (t - t0) * before / (before - spin));
        }
        self.before = Some((t, spin));
    }
}

/// The axis of a body with the largest part of L, as it leans away from where L is at the start.
struct Axis {
    index: usize,
    way: f64,
    /// The lean in radians above which it has tipped over.
    tipped: f64,
}

impl Axis {
    /// Returns the axis of a body with these velocities, and those of its true states.
    fn of<'s>(body: &Tumble, v: &[f64], true_v: impl Iterator<Item = &'s [f64]>) -> Self {
        let momentum = body.momentum_in_body(v);
        let index = momentum.abs().max_position();
        let axis = Self { index, way: momentum[index].signum(), tipped: TIPPED };
        let leans = true_v.map(|v| axis.lean(body, v));
        Self { tipped: TIPPED.max(FARTHER * leans.fold(0.0, f64::max)), ..axis }
    }

    fn lean(&self, body: &Tumble, v: &[f64]) -> f64 {
        let momentum = body.momentum_in_body(v);
        libm::acos((self.way * momentum[self.index] / momentum.length()).clamp(-1.0, 1.0))
    }
}

/// A run before its first tick, beside its truth.
struct Begun {
    followed: FollowedRun,
    start: Tumble,
    axis: Axis,
    series: Arc<TruthSeries>,
}

impl Begun {
    /// Begins a run of the body of `truth` at this pace; `None` if the body does not turn in space.
    async fn of(truth: &BodyTruth, pace: Pace, max_work: u64) -> Option<Self> {
        let Pace { spec, tick_hz } = pace;
        let series = truth.series(tick_hz).await;
        let max_work = max_work.min(truth.meter.budget_left());
        let followed = truth.follow(spec.solver(), spec.substeps, tick_hz).with_max_work(max_work);
        let stepper = &followed.body.stepper;
        let start = stepper.body().downcast_ref::<Tumble>()?.clone();
        let n = stepper.q().len();
        let within = 1..=ticks(truth.horizon_s, tick_hz);
        let true_v = within.filter_map(|tick| Some(&series.at(tick)?[n..]));
        let axis = Axis::of(&start, stepper.v(), true_v);
        Some(Self { followed, start, axis, series })
    }
}

/// The long run of a body.
#[derive(Default)]
pub(super) struct LongSpin {
    /// Whether the body gains no energy of its own and does not tip over.
    pub(super) is_bounded: bool,
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
    pub(super) seconds: f64,
}

/// Runs the body of `truth` at this pace over the long run, with its inputs.
pub(super) async fn follow_long_spin(truth: &BodyTruth, pace: Pace, max_work: u64) -> LongSpin {
    let mut long = LongSpin::default();
    let Some(begun) = Begun::of(truth, pace, max_work).await else { return long };
    let Begun { mut followed, start, axis, series } = begun;
    let see = |body: &FollowedBody, tick: u64| {
        (long.seconds, long.evaluations) = (pace.tick_hz.seconds(tick), body.stepper.evaluations());
        let gains = body.energy() > (1.0 + VISIBLE) * body.base_j;
        if gains || axis.lean(&start, body.stepper.v()) > axis.tipped {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    };
    let end = ticks(LONG_RUN * truth.horizon_s, pace.tick_hz);
    let stop = truth.run_until(&mut followed, end, see).await;
    long.is_bounded = stop == StopReason::End;
    long.is_too_much = series.is_too_much || stop == StopReason::TooMuchWork;
    long
}

/// Runs the body of `truth` at this pace over the horizon, with its inputs.
pub(super) async fn follow_spin(truth: &BodyTruth, pace: Pace, max_work: u64) -> SpinRun {
    let mut run = SpinRun::default();
    let Some(begun) = Begun::of(truth, pace, max_work).await else { return run };
    let Begun { mut followed, axis, series, .. } = begun;
    let (tick_hz, n) = (pace.tick_hz, followed.body.stepper.q().len());
    let end = ticks(truth.horizon_s, tick_hz);
    let (mut own, mut exact) = (Flips::default(), Flips::default());
    let (mut fastest, mut omega) = (0.0_f64, 0.0_f64);
    let found = &mut run.finding;
    found.energy = 1.0;
    let see = |body: &FollowedBody, tick: u64| {
        let Some(state) = series.at(tick) else { return ControlFlow::Break(()) };
        let (stepper, t) = (&*body.stepper, tick_hz.seconds(tick));
        let Some(body) = stepper.body().downcast_ref::<Tumble>() else {
            return ControlFlow::Break(());
        };
        let (q, v) = (stepper.q(), stepper.v());
        let (true_q, true_v) = state.split_at(n);
        let apart = Tumble::angle_between(q, true_q);
        if apart > found.attitude.0 {
            found.attitude = (apart, t);
        }
        let [spin, true_spin] = [v, true_v].map(Tumble::spin_of);
        fastest = fastest.max(true_spin.length());
        omega = omega.max((spin - true_spin).length());
        let [energy, true_energy] =
            [v, true_v].map(|v| Tumble::spin_of(v).dot(body.momentum_in_body(v)));
        found.energy = if true_energy > 0.0 { energy / true_energy } else { 1.0 };
        let [l, true_l] = [(q, v), (true_q, true_v)].map(|(q, v)| body.momentum(q, v));
        found.momentum_turn = found.momentum_turn.max(Tumble::turn_between(l, true_l));
        if found.tips_at_s.is_none() && axis.lean(body, v) > axis.tipped {
            found.tips_at_s = Some(t);
        }
        own.add(t, spin[axis.index]);
        exact.add(t, true_spin[axis.index]);
        found.seconds = t;
        run.evaluations = stepper.evaluations();
        ControlFlow::Continue(())
    };
    let stop = truth.run_until(&mut followed, end, see).await;
    if omega > 0.0 {
        found.omega = omega / fastest;
    }
    found.flips = [&own, &exact].map(|flips| flips.at_s.len() as u32);
    if let (Some(first), Some(last)) = (exact.at_s.first(), exact.at_s.last()) {
        let between = match exact.at_s.len() {
            1 => 2.0 * first,
            n => (last - first) / (n - 1) as f64,
        };
        let late = |(own, exact): (&f64, &f64)| own - exact;
        let all = || own.at_s.iter().zip(&exact.at_s).map(late);
        let worst = all().reduce(|worst, late| if late.abs() > worst.abs() { late } else { worst });
        found.late = worst.map(|worst| (worst, worst / between));
        // A body that flips in truth does not tip over.
        found.tips_at_s = None;
    }
    run.is_too_much = series.is_too_much || stop == StopReason::TooMuchWork;
    run.failure = RunFailure::of(stop, followed.t());
    run
}
