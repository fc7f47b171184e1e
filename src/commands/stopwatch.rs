//! Measures the cost of a lane in real time. Nothing else should run at the same time.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::lab::{Lane, LaneSpec, Scene};

/// The fewest ticks that are timed together. Reading the clock takes as long as a few ticks of a small body, which is at
/// most a hundredth of this many.
const TOGETHER: u64 = 256;

/// The cost of a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timing {
    /// Nanoseconds per simulated second, in the fastest run.
    pub(super) ns_per_s: f64,
    /// The relative excess of the median run over the fastest.
    pub(super) spread: f64,
}

/// Times a lane at this rate, from its start to tick `ticks` or until `effort` has passed, and repeats that until
/// `effort` has passed. `None` if `ticks` is 0.
///
/// The lane must not halt within these ticks: a halted lane costs nothing.
pub(super) fn time(
    scene: &Scene,
    spec: LaneSpec,
    tick_hz: u32,
    ticks: u64,
    effort: Duration,
) -> Option<Timing> {
    let (begin, mut runs) = (Instant::now(), Vec::new());
    while ticks > 0 && (runs.is_empty() || begin.elapsed() < effort) {
        runs.push(ns_per_tick(scene, spec, tick_hz, ticks, effort));
    }
    runs.sort_by(f64::total_cmp);
    let least = *runs.first()?;
    let spread = runs[runs.len() / 2] / least - 1.0;
    Some(Timing { ns_per_s: least * f64::from(tick_hz), spread })
}

/// [`time`] without its spread.
pub(super) fn ns_per_s(
    scene: &Scene,
    spec: LaneSpec,
    tick_hz: u32,
    ticks: u64,
    effort: Duration,
) -> Option<f64> {
    Some(time(scene, spec, tick_hz, ticks, effort)?.ns_per_s)
}

/// Nanoseconds per tick, over as many runs as have [`TOGETHER`] ticks.
fn ns_per_tick(scene: &Scene, spec: LaneSpec, tick_hz: u32, ticks: u64, effort: Duration) -> f64 {
    let hz = f64::from(tick_hz);
    let runs = TOGETHER.div_ceil(ticks);
    let mut lanes: Vec<Lane> =
        (0..runs).map(|_| Lane::new(scene, spec.solver(), spec.substeps)).collect();
    let (start, mut done) = (Instant::now(), 0);
    for lane in &mut lanes {
        lane.run_while(hz, |tick, _| {
            let is_over = tick > 0 && done % TOGETHER == 0 && start.elapsed() >= effort;
            let goes_on = tick < ticks && !is_over;
            done += u64::from(goes_on);
            goes_on
        });
    }
    let elapsed = start.elapsed();
    black_box(&lanes);
    elapsed.as_nanos() as f64 / done as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::method;

    #[test]
    fn a_run_of_some_ticks_has_a_cost_and_one_of_none_has_not() {
        let scene = Scene::built_in("chain").unwrap();
        let spec = LaneSpec::plain(method("rk4").unwrap());
        for ticks in [1, 60, 2 * TOGETHER] {
            let cost = ns_per_s(&scene, spec, 60, ticks, Duration::from_millis(1));
            assert!(cost.is_some_and(|ns| ns.is_finite() && ns > 0.0), "{ticks} ticks: {cost:?}");
        }
        assert_eq!(ns_per_s(&scene, spec, 60, 0, Duration::from_millis(1)), None);
    }
}
