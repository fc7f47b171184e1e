//! Follows a lane's bounces beside those of the truth.

use std::ops::ControlFlow;

use super::bounce_finding::BounceFinding;
use super::criterion::TOLERANCE;
use super::pace::Pace;
use super::truth::{BodyTruth, FollowedBody, ticks};
use super::verdict::RunFailure;
use crate::run::race::StopReason;
use crate::sim::integrators::EngineBounce;
use crate::sim::{Bounces, Solver, Stepper, TickRate};

/// A flight of fewer ticks is not compared: it is near the end of the bouncing, and its height is known badly.
const LEAST_TICKS: f64 = 10.0;

/// Height in metres, and part of the highest flight, at and below which a ball lies.
const LIES: f64 = 1e-4;

/// Seconds below the floor after which a ball has sunk, and seconds for which a ball at rest lies, both at the end of
/// the run. Then the part of a short run for both.
const SUNK_S: f64 = 0.5;
const AT_REST_S: f64 = 1.0;
const AT_END: f64 = 0.2;

/// Depth in metres at which an engine may leave a ball at rest.
const SLOP: f64 = 0.025;

/// The largest number of true flights that are followed to a rest.
const MAX_FLIGHTS: u64 = 1000;

/// A ball has grown if it flies this many times as high as the true one ever does.
const TWICE: f64 = 2.0;

/// Part of a tick's way within which a ball lands on a tick.
const ON_TICK: f64 = 1e-9;

/// The bounces of a run.
#[derive(Default)]
pub(super) struct BounceRun {
    pub(super) finding: BounceFinding,
    pub(super) failure: Option<RunFailure>,
    pub(super) is_too_much: bool,
    pub(super) evaluations: u64,
    pub(super) seconds: f64,
}

/// Runs the body of `truth` at this pace up to the horizon, or to the first input.
pub(super) async fn follow_bounces(
    truth: &BodyTruth,
    Pace { spec, tick_hz }: Pace,
    max_work: u64,
) -> BounceRun {
    let h = tick_hz.step_s();
    let until_s = truth.inputs.first().map_or(truth.horizon_s, |input| input.at_s);
    let end = ticks(until_s, tick_hz);
    let max_work = max_work.min(truth.meter.budget_left());
    let mut followed = truth.follow(spec.solver(), spec.substeps, tick_hz).with_max_work(max_work);
    let (mut run, mut seen) = (BounceRun::default(), Vec::new());
    let (mut below_since, mut highest, mut highest_last) = (None, 0.0_f64, 0.0_f64);
    let mut up_until_s = 0.0;
    let mut heights = vec![followed.body.stepper.q()[0]];
    let mut distances = Vec::new();
    let [sunk_s, rest_s] = [SUNK_S, AT_REST_S].map(|most| most.min(AT_END * until_s));
    let slop = if spec.method.bounce().is_some() { SLOP } else { 0.0 };
    let (mut seconds, mut evaluations) = (0.0, 0);
    let mut before = Bounces::default();
    let see = |body: &FollowedBody, tick: u64| {
        let t = tick_hz.seconds(tick);
        (seconds, evaluations) = (t, body.stepper.evaluations());
        let now = body.stepper.bounces().copied().unwrap_or_default();
        let (y, speed) = (now.distance, body.stepper.v()[now.coordinate].abs());
        highest = highest.max(y);
        distances.push(y);
        heights.push(body.stepper.q()[now.coordinate]);
        if t + rest_s > until_s {
            highest_last = highest_last.max(y);
        }
        let is_below = y < -slop && !now.speeds[1].is_nan();
        below_since = is_below.then(|| below_since.unwrap_or((t, now.impacts, speed)));
        if y > LIES * highest.max(1.0) {
            up_until_s = t;
        }
        let has_peaked = (now.apex, now.apex_after) != (before.apex, before.apex_after);
        if now.impacts > before.impacts || has_peaked {
            seen.push((now, has_peaked, speed));
        }
        before = now;
        ControlFlow::Continue(())
    };
    let stop = truth.run_until(&mut followed, end, see).await;
    (run.seconds, run.evaluations) = (seconds, evaluations);
    run.is_too_much = stop == StopReason::TooMuchWork;
    run.failure = RunFailure::of(stop, followed.t());
    let found = &mut run.finding;
    let has_own_time = spec.impact.finds_the_time();
    let mut impacts = truth.impacts.lock().expect("no thread panics with it");
    let exact = impacts.get_or_insert_with(|| truth.start(Solver::Truth));
    let step_s = h / f64::from(spec.substeps);
    let waits = (!has_own_time).then_some(step_s);
    let has_bounced = found.compare(&**exact, &seen, h, waits);
    let is_still = !truth.is_driven();
    let top = exact.true_bounce(0).map(|[_, apex]| apex).filter(|apex| is_still && *apex > 0.0);
    found.climbs_to = top.filter(|top| highest >= TWICE * top).map(|_| highest);
    let lies = LIES * highest.max(1.0);
    // A ball that has lain below the floor since its fall sinks no more.
    let then = distances.len().saturating_sub(ticks(sunk_s, tick_hz) as usize + 1);
    let lowest = |part: &[f64]| part.iter().copied().fold(0.0, f64::min);
    let lies_below = !has_bounced
        && below_since.is_some()
        && lowest(&distances[then..]) >= lowest(&distances[..then]) - lies;
    if !has_bounced && let Some(top) = top {
        let part = |size: f64| (size > 0.0).then_some([size / top, size]);
        found.depth = part(-slop - lowest(&distances));
        let lain = rests_at(&**exact, lies).map_or(usize::MAX, |s| ticks(s, tick_hz) as usize + 2);
        found.hop = part(distances.iter().skip(lain).copied().fold(0.0, f64::max));
    }
    found.is_luck &= !has_own_time;
    let sunk = below_since.filter(|(since, ..)| seconds - since >= sunk_s && !lies_below);
    found.sinks_at_s = sunk.map(|(since, ..)| since);
    let is_unturned = |(_, impacts, speed)| (impacts == before.impacts).then_some(speed);
    found.falls_through = sunk.and_then(is_unturned);
    let is_cut = !truth.inputs.is_empty();
    if found.height.is_none() && found.landing.is_none() && !is_cut {
        let exact = &mut *truth.start(Solver::Truth);
        found.gap = gap(exact, before.coordinate, &heights, tick_hz);
    }
    let rests = *truth.rests.get_or_init(|| {
        let mut exact = truth.start(Solver::Truth);
        let is_known = exact.advance(0.0, until_s - rest_s, 1).is_ok();
        is_known && exact.v()[before.coordinate] == 0.0
    });
    let is_up = found.sinks_at_s.is_none() && highest_last > lies;
    found.never_rests = (rests && is_up).then_some(highest_last);
    if let (Some(height), Some(top), Some((_, part))) = (found.never_rests, top, found.height)
        && height > part.abs() * top
    {
        found.height = None;
    }
    if before.impacts > 0 && before.speeds[1].is_nan() {
        // A soft wall lets the ball swing below it.
        up_until_s = tick_hz.seconds(moves_until(&distances, lies));
    }
    // Nothing rests for ever on a wall that moves, or under a force that changes with time.
    if found.sinks_at_s.is_none() && !is_up && !truth.is_driven() {
        let body = &followed.body.stepper;
        let mut push = vec![0.0; body.q().len()];
        body.acceleration(seconds, body.q(), &push.clone(), &mut push);
        let speed = spec.method.bounce().map_or(0.0, EngineBounce::threshold);
        let threshold = [speed, speed * speed / (2.0 * push[before.coordinate].abs())];
        found.compare_rest(&**exact, (up_until_s, 3.0 * h), lies, threshold);
    }
    run
}

/// Returns the largest difference of the heights at ticks from the exact ones, in parts of the highest exact one, and
/// its time (s). `None` if the exact ones are not known.
fn gap(
    exact: &mut dyn Stepper,
    coordinate: usize,
    heights: &[f64],
    tick_hz: TickRate,
) -> Option<(f64, f64)> {
    let (mut worst, mut highest) = ((0.0, 0.0), exact.q()[coordinate].abs());
    for (tick, height) in (1..).zip(&heights[1..]) {
        exact.advance(tick_hz.seconds(tick - 1), tick_hz.step_s(), 1).ok()?;
        let wanted = exact.q()[coordinate];
        highest = wanted.abs().max(highest);
        let apart = (height - wanted).abs();
        if apart > worst.0 {
            worst = (apart, tick_hz.seconds(tick));
        }
    }
    let part = if worst.0 == 0.0 { 0.0 } else { worst.0 / highest };
    Some((part, worst.1))
}

/// Returns the duration of the true flight after this many impacts, in seconds.
fn flight_s(exact: &dyn Stepper, impacts: u64) -> Option<f64> {
    let [[from_s, _], [to_s, _]] = [exact.true_bounce(impacts)?, exact.true_bounce(impacts + 1)?];
    Some(to_s - from_s)
}

/// Returns the last tick at which a ball is farther than this (m) from where it ends, of its distances at ticks.
fn moves_until(distances: &[f64], within: f64) -> u64 {
    let end = distances.last().copied().unwrap_or(0.0);
    distances.iter().rposition(|y| (y - end).abs() > within).map_or(0, |at| at as u64 + 1)
}

/// Returns the time of the true impact after which no flight is higher than this height in metres.
fn rests_at(exact: &dyn Stepper, height: f64) -> Option<f64> {
    let mut flights = (1..MAX_FLIGHTS).map_while(|impact| exact.true_bounce(impact));
    Some(flights.find(|[_, apex]| apex.is_nan() || *apex <= height)?[0])
}

impl BounceFinding {
    /// Compares the time (s) up to which a run is higher than `lies` (m), known within `within_s`, with that of the
    /// truth. The threshold of the engine is the cause of an early rest if it ends the last flights only.
    fn compare_rest(
        &mut self,
        exact: &dyn Stepper,
        (up_until_s, within_s): (f64, f64),
        lies: f64,
        threshold: [f64; 2],
    ) {
        // Between two walls no flight has a height. Else a height that is not known is that of a very short flight.
        if exact.true_bounce(0).is_none_or(|[_, apex]| apex.is_nan()) {
            return;
        }
        let Some(rest_s) = rests_at(exact, lies) else { return };
        let early_s = rest_s - up_until_s;
        if early_s.abs() > TOLERANCE * rest_s + within_s {
            self.rests_early_s = Some(early_s);
            let slow_s =
                rests_at(exact, threshold[1].max(lies)).filter(|_| threshold[1].is_finite());
            let is_cause = |slow_s: f64| 0.0 < early_s && early_s <= 2.0 * (rest_s - slow_s);
            self.threshold = slow_s.is_some_and(is_cause).then_some(threshold);
        }
    }

    /// Compares records of a run, each with whether it has a new peak and with the speed then, with the truth from its
    /// start, at ticks of `h` (s). A rule that handles an impact at the end of a step of `waits` (s) may be late by so
    /// much.
    /// Returns whether the run has a flight after an impact that was compared.
    fn compare(
        &mut self,
        exact: &dyn Stepper,
        seen: &[(Bounces, bool, f64)],
        h: f64,
        waits: Option<f64>,
    ) -> bool {
        let is_long =
            |impacts| flight_s(exact, impacts).filter(|flight_s| *flight_s >= LEAST_TICKS * h);
        let (mut heights, mut landings) = (Vec::new(), 0);
        let (mut impacts, mut are_same) = (0, true);
        self.is_luck = true;
        for &(now, has_peaked, speed) in seen {
            if has_peaked
                && let (Some(apex), Some([_, wanted])) =
                    (now.apex, exact.true_bounce(now.apex_after))
                && is_long(now.apex_after).is_some()
            {
                heights.push((now.apex_after, (apex / wanted - 1.0).max(-1.0)));
            }
            // Flights become shorter and shorter, so that none is long again.
            if now.impacts > 2 && is_long(now.impacts - 2).is_none() {
                break;
            }
            if now.impacts == impacts {
                continue;
            }
            impacts = now.impacts;
            if let (Some(flight_s), Some([at_s, _])) =
                (is_long(impacts - 1), exact.true_bounce(impacts))
                && are_same
            {
                let late_s = match waits {
                    // A straight line knows a time within the step, and moves the body as a mirror does.
                    Some(step_s) => {
                        let steps = (now.landed_at_s / step_s - ON_TICK).ceil();
                        let late_s = steps * step_s - at_s;
                        late_s - late_s.clamp(0.0, step_s)
                    }
                    None => now.landed_at_s - at_s,
                };
                let part = late_s / flight_s;
                if self.landing.is_none_or(|(_, worst, _)| part.abs() > worst.abs()) {
                    self.landing = Some((impacts, part, late_s));
                }
                // The first impact is where the start has put it.
                self.is_luck &= impacts == 1 || now.beyond <= ON_TICK * speed * h;
                landings += 1;
                // By more than a flight, the impacts of a number are no longer the same.
                are_same = part.abs() <= 1.0;
            }
        }
        self.is_luck &= landings > 2;
        let farther = |worst: (u64, f64), next: &(u64, f64)| {
            if next.1.abs() > worst.1.abs() { *next } else { worst }
        };
        self.height = heights.first().map(|first| heights.iter().fold(*first, farther));
        let doubled = self.height.filter(|(after, part)| *after > 1 && *part > 1.0);
        self.gain = doubled.and_then(|(after, part)| {
            let [first, last] = [exact.true_bounce(1)?[1], exact.true_bounce(after)?[1]];
            let is_kept = (last / first - 1.0).abs() <= TOLERANCE;
            is_kept.then_some(part * last / after as f64)
        });
        let third = heights.len().div_ceil(3);
        let mean =
            |part: &[(u64, f64)]| part.iter().map(|it| it.1).sum::<f64>() / part.len() as f64;
        self.drifts = heights.len() > 2
            && mean(&heights[heights.len() - third..]).abs() > mean(&heights[..third]).abs();
        landings > 1 || heights.iter().any(|(after, _)| *after > 0)
    }
}
