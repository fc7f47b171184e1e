//! The polhode: where the angular momentum points, as seen from a body along its middle axis.
//!
//! In truth it stays on a curve of the sphere, which from there is a piece of a hyperbola on both halves of the sphere,
//! gone to and fro. The separatrix, through the middle axis, is two straight lines.

use crate::run::race::LaneBody;
use crate::sim::bodies::Tumble;

/// Number of points around a closed curve.
const AROUND: u32 = 256;

/// The directions of L from a body that turns in space. A place is L/|L| along the axes of the least and of the
/// greatest moment.
pub struct Polhode {
    /// The names of the principal axes, from the least moment to the greatest.
    pub axes: [&'static str; 3],
    /// The places of the same energy, from that of the body and back to it.
    pub way: Vec<[f64; 2]>,
    /// The lines that part the ways round one axis from those round another, and the rim of the sphere.
    pub borders: Vec<Vec<[f64; 2]>>,
}

impl Polhode {
    /// Returns the polhode of a body at its present state; `None` if it does not turn in space.
    pub fn of(body: &LaneBody) -> Option<Self> {
        let tumble: &Tumble = body.stepper.body().downcast_ref()?;
        let slopes = slopes(tumble);
        let way = way(slopes, tumble.pole(body.stepper.v())).collect();
        let mut borders = vec![turns().map(libm::sincos).map(|(sin, cos)| [cos, sin]).collect()];
        if slopes != [0.0; 2] {
            let [across, up] = slopes.map(|slope| (slope / (slopes[0] + slopes[1])).sqrt());
            borders.extend([-up, up].map(|up| vec![[-up, -across], [up, across]]));
        }
        let axes = tumble.axes_by_moment().map(|axis| ["x", "y", "z"][axis]);
        Some(Self { axes, way, borders })
    }
}

/// Returns how 2 T/L² changes with the square of L/|L| along the axis of the least moment, and against that along the
/// axis of the greatest. Both are at least 0.
fn slopes(tumble: &Tumble) -> [f64; 2] {
    let [least, middle, greatest] =
        tumble.axes_by_moment().map(|axis| tumble.moments[axis].recip());
    [least - middle, middle - greatest]
}

/// Returns angles (rad) around a circle.
fn turns() -> impl Iterator<Item = f64> {
    let part = std::f64::consts::TAU / f64::from(AROUND);
    (0..=AROUND).map(move |n| part * f64::from(n))
}

/// Returns the way of constant energy through a pole, from it and back to it.
fn way(slopes: [f64; 2], pole: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let [x, z] = [0, 1].map(|axis| slopes[axis] * pole[axis] * pole[axis]);
    // The pole goes round the axis along which it keeps its sign.
    let kept = usize::from(x < z || slopes[0] == 0.0);
    let level = (x - z).abs();
    let most = ((slopes[kept] - level) / (slopes[0] + slopes[1])).max(0.0).sqrt();
    let from = libm::asin((pole[1 - kept] / most).clamp(-1.0, 1.0));
    turns().map(move |turn| {
        let other = if most > 0.0 { most * libm::sin(from + turn) } else { pole[1 - kept] };
        let along = ((level + slopes[1 - kept] * other * other) / slopes[kept]).sqrt();
        let along = if slopes[kept] > 0.0 { along.copysign(pole[kept]) } else { pole[kept] };
        if kept == 0 { [along, other] } else { [other, along] }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Lane;
    use crate::scene::{LaneSpec, Scene};
    use crate::sim::integrators::method;

    /// Returns how far the energy of a pole is from that of the separatrix, and the same on its way.
    fn levels(scene: &Scene, id: &str, ticks: u64) -> [f64; 2] {
        let mut lane = Lane::new(scene, LaneSpec::plain(method(id).unwrap()).solver(), 1);
        (0..ticks).for_each(|tick| lane.tick(tick, tick as f64 / 60.0, 1.0 / 60.0));
        let body = &lane.bodies()[0];
        let tumble: &Tumble = body.stepper.body().downcast_ref().unwrap();
        let [x, z] = slopes(tumble);
        let level = |at: [f64; 2]| (x * at[0] * at[0] - z * at[1] * at[1]) / (x + z);
        [level(tumble.pole(body.stepper.v())), level(Polhode::of(body).unwrap().way[100])]
    }

    #[test]
    fn a_rescaled_step_goes_to_the_separatrix_and_split_3_stays_on_its_way() {
        for name in ["coin", "t-handle", "phone", "long-box", "gyro"] {
            let scene = Scene::built_in(name).unwrap();
            let [start, way] = levels(&scene, "gyro-rescaled", 0);
            assert!((start - way).abs() < 1e-12, "{name}: {start} and {way}");
            let [rescaled, _] = levels(&scene, "gyro-rescaled", 300);
            assert!(rescaled.abs() < start.abs(), "{name}: {start} to {rescaled}");
            let [split, _] = levels(&scene, "split-3", 300);
            assert!((split - start).abs() < 2e-3, "{name}: {start} to {split}");
        }
    }
}
