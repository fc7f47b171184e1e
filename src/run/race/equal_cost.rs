//! Lanes of equal cost, in which a cheap method may take more substeps.
//!
//! At the same tick rate a method with more evaluations has an advantage, so that a fair race compares equal work. Work
//! is counted in evaluations, because these are the same on every machine.

use std::ops::ControlFlow;

use super::lane::Lane;
use super::ticker::{StopReason, Ticker};
use crate::scene::{LaneSpec, MAX_SUBSTEPS, Scene, nearest_tick};
use crate::sim::TickRate;

/// Minimum number of ticks over which a cost is counted, and number of ticks to count after the script's last action.
/// These are a second in most scenes, long enough for step sizes to settle.
const SETTLING_TICKS: u64 = 60;

/// Maximum number of ticks over which a cost is counted. With more ticks, a person would wait too long for equal cost;
/// later actions of a longer script are left out.
const MAX_COUNTED_TICKS: u64 = 600;

/// Returns the lanes of a scene with substeps that match their evaluations to those of the most expensive lane as
/// given. Counts evaluations at `tick_hz` from the scene's start until the script is over and step sizes have settled,
/// 60 to 600 ticks.
///
/// A library keeps its own substeps. The cost of a lane whose bodies halt is the mean until that moment.
pub fn equal_cost(
    scene: &Scene,
    lanes: &[LaneSpec],
    tick_hz: impl Into<TickRate>,
) -> Vec<LaneSpec> {
    let tick_hz = tick_hz.into();
    let cost = |spec: &LaneSpec, most| evaluations_per_tick(scene, spec, tick_hz, most);
    let dearest = lanes.iter().map(|spec| cost(spec, f64::INFINITY)).fold(0.0, f64::max);
    let equal = |spec: &LaneSpec| match spec.method.is_of_library() {
        true => *spec,
        false => nearest(dearest, *spec, cost),
    };
    lanes.iter().map(equal).collect()
}

/// Returns the lanes in the race, which are those of the scene, at equal cost if the scene asks for it.
pub fn lanes_that_race(scene: &Scene) -> Vec<LaneSpec> {
    match scene.equal_cost {
        true => equal_cost(scene, &scene.lanes, scene.tick_hz),
        false => scene.lanes.clone(),
    }
}

/// Returns `spec` with the substeps that bring its cost nearest to `wanted`. More substeps never cost less, so
/// bisection finds them. `cost` may return infinity above its second argument.
fn nearest(wanted: f64, spec: LaneSpec, cost: impl Fn(&LaneSpec, f64) -> f64) -> LaneSpec {
    let with = |substeps: u32| LaneSpec { substeps, ..spec };
    let (mut low, mut high) = (1, MAX_SUBSTEPS);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if cost(&with(middle), wanted) <= wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [below, above] = [low, high].map(with);
    let off_below = (cost(&below, f64::INFINITY) - wanted).abs();
    let off_above = (cost(&above, wanted + off_below) - wanted).abs();
    if off_above < off_below { above } else { below }
}

/// Returns the mean cost of a tick; infinity if the cost exceeds `most`.
fn evaluations_per_tick(scene: &Scene, spec: &LaneSpec, tick_hz: TickRate, most: f64) -> f64 {
    let over = scene.script.last().map_or(0, |last| nearest_tick(last.at_s, tick_hz));
    let end = over.saturating_add(SETTLING_TICKS).min(MAX_COUNTED_TICKS);
    let lane = Lane::new(scene, spec.solver(), spec.substeps);
    let mut follow = Ticker::new(lane, tick_hz)
        .with_script(&scene.script)
        .with_max_work((most * end as f64) as u64);
    let stop = follow.run(end, |lane, _| match lane.halted() {
        Some(_) => ControlFlow::Break(()),
        None => ControlFlow::Continue(()),
    });
    match stop {
        StopReason::TooMuchWork => f64::INFINITY,
        _ => follow.body.evaluations() as f64 / follow.ticks().max(1) as f64,
    }
}
