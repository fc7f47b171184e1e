//! Lanes of equal cost: who is cheap may step more often.

use super::lane::Lane;
use super::lane_spec::LaneSpec;
use super::scene::{MOST_SUBSTEPS, Scene};

/// The ticks over which a cost is counted: a second of most scenes, and enough for step sizes to settle.
const COUNTED_TICKS: u64 = 60;

/// The lanes of a scene, each with as many substeps as bring its evaluations nearest to those of the dearest of them as
/// it stands. Evaluations are counted over the scene's first ticks at `tick_hz`.
///
/// A lane whose bodies halt costs what it did until then.
pub fn equal_cost(scene: &Scene, lanes: &[LaneSpec], tick_hz: u32) -> Vec<LaneSpec> {
    let cost = |spec: &LaneSpec| evaluations_per_tick(scene, spec, tick_hz);
    let dearest = lanes.iter().map(cost).fold(0.0, f64::max);
    lanes.iter().map(|spec| nearest(dearest, *spec, cost)).collect()
}

/// The lanes that race: those of the scene, of equal cost if it asks for that.
pub fn lanes_that_race(scene: &Scene) -> Vec<LaneSpec> {
    match scene.equal_cost {
        true => equal_cost(scene, &scene.lanes, scene.tick_hz),
        false => scene.lanes.clone(),
    }
}

/// `spec` with the substeps that bring its cost nearest to `wanted`: found by bisection, as more substeps never cost
/// less.
fn nearest(wanted: f64, spec: LaneSpec, cost: impl Fn(&LaneSpec) -> f64) -> LaneSpec {
    let with = |substeps: u32| LaneSpec { substeps, ..spec };
    let (mut low, mut high) = (1, MOST_SUBSTEPS);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if cost(&with(middle)) <= wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [below, above] = [low, high].map(with);
    let off = |spec: &LaneSpec| (cost(spec) - wanted).abs();
    if off(&above) < off(&below) { above } else { below }
}

fn evaluations_per_tick(scene: &Scene, spec: &LaneSpec, tick_hz: u32) -> f64 {
    let mut lane = Lane::new(scene, spec.solver(), spec.substeps);
    let h = 1.0 / f64::from(tick_hz);
    let mut ticks = 0;
    while ticks < COUNTED_TICKS && lane.halted().is_none() {
        lane.tick(ticks, ticks as f64 * h, h);
        ticks += 1;
    }
    lane.evaluations() as f64 / ticks.max(1) as f64
}
