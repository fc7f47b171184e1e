//! Three turns about two axes and one about the momentum, each of which is exact.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "split-3",
    name: "Split in 3",
    about: "explicit, keeps L in space and the energy within a bound; exact for every symmetric top",
    order: 2,
    order_with_drag: 2,
    reversible: true,
    evaluation_cost: 2,
    source: "after Touma & Wisdom, Lie-Poisson integrators for rigid body dynamics (1994)",
    formula: &[
        "λ = 1 / I of the middle axis, a and b the others",
        "turns about a, b, a by ½h, h, ½h times L (1 / I − λ)",
        "then by h λ L; L turns back by each",
    ],
    ..GYRO
};

/// Split in 3, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Split3;

impl GyroRule for Split3 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        // The axis of the middle moment, and the others.
        let [least, middle, greatest] = axes_by_moment(moments);
        let lambda = 1.0 / moments[middle];
        let [a, b] = [least.min(greatest), least.max(greatest)];
        let mut split = Split::new(moments, omega);
        for (axis, part) in [(a, 0.5), (b, 1.0), (a, 0.5)] {
            split.turn(axis, part * h * (1.0 / moments[axis] - lambda));
        }
        let turn = split.turn * turn_by(h * lambda * split.momentum);
        Ok((split.momentum / moments, turn))
    }
}
