//! Measures the cost of a lane in real time. Nothing else should run at the same time.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::run::{Lane, Ticker};

/// Fewest ticks timed together. Reading the clock takes as long as a few ticks of a small body, at most a hundredth
/// of this many.
const TOGETHER: u64 = 256;

/// Fewest runs. The fastest one counts, so that an interruption by the system does not. Fewer suffice once they have
/// taken this many times the effort.
const MIN_RUNS: usize = 5;
const PATIENCE: u32 = 20;

/// Nanoseconds per tick of the lane from `made`, run by run, from least to most. A run has `ticks` ticks, or fewer if
/// `effort` passes first. It is repeated until `effort` has passed, and a few times more on a busy machine. Empty if
/// `ticks` is 0.
///
/// The lane must not halt within these ticks: a halted lane costs nothing.
pub(crate) fn ns_per_tick(
    made: impl Fn() -> Ticker<'static, Lane>,
    ticks: u64,
    effort: Duration,
) -> Vec<f64> {
    if ticks == 0 {
        return Vec::new();
    }
    let begin = Instant::now();
    runs(effort, || begin.elapsed(), || ns_per_tick_of_a_run(&made, ticks, effort))
}

/// Results of `run`, from least to most. Repeats it until `elapsed` reaches `effort` and there are a few results.
fn runs(
    effort: Duration,
    mut elapsed: impl FnMut() -> Duration,
    mut run: impl FnMut() -> f64,
) -> Vec<f64> {
    let mut runs = vec![run()];
    loop {
        let passed = elapsed();
        let are_few = runs.len() < MIN_RUNS && passed < PATIENCE * effort;
        if passed >= effort && !are_few {
            runs.sort_by(f64::total_cmp);
            return runs;
        }
        runs.push(run());
    }
}

/// Nanoseconds per tick, over enough copies for [`TOGETHER`] ticks, or over one copy if that takes `effort`.
fn ns_per_tick_of_a_run(
    made: &impl Fn() -> Ticker<'static, Lane>,
    ticks: u64,
    effort: Duration,
) -> f64 {
    // Making a lane may take longer than stepping it.
    let (mut elapsed, mut done) = elapsed_in(made, ticks, effort, 1);
    if done < TOGETHER && elapsed < effort {
        (elapsed, done) = elapsed_in(made, ticks, effort, TOGETHER.div_ceil(ticks));
    }
    elapsed.as_nanos() as f64 / done as f64
}

/// Time that this many runs take, and their ticks. Stops once `effort` has passed.
fn elapsed_in(
    made: &impl Fn() -> Ticker<'static, Lane>,
    ticks: u64,
    effort: Duration,
    runs: u64,
) -> (Duration, u64) {
    let mut lanes: Vec<Ticker<'static, Lane>> = (0..runs).map(|_| made()).collect();
    let (start, mut done) = (Instant::now(), 0);
    for lane in &mut lanes {
        lane.run(ticks, |_, _| {
            done += 1;
            match done % TOGETHER == 0 && start.elapsed() >= effort {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
    }
    let elapsed = start.elapsed();
    black_box(&lanes);
    (elapsed, done)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::sim::Solver;
    use crate::sim::integrators::method;

    #[test]
    fn an_interrupted_run_does_not_count_as_the_cost() {
        let effort = Duration::from_millis(5);
        for (first_ms, others_ms, least, count) in
            [(900, 1, 900.0, 1), (40, 1, 1.0, 5), (1, 1, 1.0, 5), (60, 60, 60.0, 2)]
        {
            let mut times = std::iter::once(first_ms).chain(std::iter::repeat(others_ms));
            let passed = std::cell::Cell::new(0);
            let found = runs(
                effort,
                || Duration::from_millis(passed.get()),
                || {
                    let ms = times.next().unwrap();
                    passed.set(passed.get() + ms);
                    ms as f64
                },
            );
            assert_eq!((found[0], found.len()), (least, count), "{first_ms} ms first");
        }
    }

    #[test]
    fn only_a_run_with_ticks_has_a_cost() {
        let scene = Scene::built_in("chain").unwrap();
        let solver = Solver::Method(method("rk4").unwrap());
        let made = || Ticker::new(Lane::new(&scene, solver, 1), 60);
        for ticks in [1, 60, 2 * TOGETHER] {
            let cost = ns_per_tick(made, ticks, Duration::from_millis(1)).first().copied();
            assert!(cost.is_some_and(|ns| ns.is_finite() && ns > 0.0), "{ticks} ticks: {cost:?}");
        }
        assert!(ns_per_tick(made, 0, Duration::from_millis(1)).is_empty());
    }
}
