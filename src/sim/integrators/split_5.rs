//! Five turns about the axes, each of which is exact.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "split-5",
    name: "Split in 5",
    about: "explicit, keeps L in space and the energy within a bound",
    order: 2,
    order_with_drag: 2,
    reversible: true,
    evaluation_cost: 3,
    source: "McLachlan, Explicit Lie-Poisson integration and the Euler equations (1993); Reich (1994)",
    formula: &[
        "turns about the axes 1, 2, 3, 2, 1",
        "by ½h, ½h, h, ½h, ½h times L / I; L turns back by each",
    ],
    ..GYRO
};

/// Split in 5, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Split5;

impl GyroRule for Split5 {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let mut split = Split::new(moments, omega);
        for (axis, part) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
            split.turn(axis, part * h / moments[axis]);
        }
        Ok((split.momentum / moments, split.turn))
    }
}
