//! Qt's SpringAnimation, which makes steps of 16 ms by a clock of its own.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "qt-spring",
    name: "Qt SpringAnimation",
    about: "semi-implicit Euler by 16 ms, as often as such a step has passed; stands once it is within 0.01 and slower than \
            0.01/s",
    caveat: "a frame shows the last step of 16 ms, so that now and then one shows none and the next two; its damping is cut to 1, \
             which is 62.5/s, of a mass of 1; the rest is no part of the way: a way of 1 ends after 1 %",
    order: 0,
    order_with_drag: 0,
    restart: Some("with a step of 16 ms not yet begun"),
    source: "runs of Qt 6.12.0: qquickspringanimation.cpp",
    formula: &[
        "g = f / K, s = 0.016, d = min(s (c + C), 1)",
        "S = S₋₁ + H, n = ⌊S / s⌋, S = S − n s",
        "n times: v = v + s K (g − x) − d v, x = x + s v",
        "then if n > 0, |v| < 0.01 and |x − g| < 0.01: x = g, v = 0",
    ],
    ..INTERFACE
};

/// Qt's SpringAnimation, whose frame follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct QtSpring;

impl QtSpring {
    /// Length of a step, in seconds.
    pub const STEP_S: f64 = 0.016;
    /// Distance, and speed per second, that count as rest.
    pub const REST: f64 = 0.01;
    /// Maximum number of steps in a frame, which is a quarter of an hour. Qt has none, and would take long.
    const MOST_STEPS: f64 = 6e4;

    /// Returns the number of steps in this time in seconds.
    pub fn steps(time_s: f64) -> f64 {
        // The addition restores a whole number that rounding has lowered.
        libm::floor(time_s / Self::STEP_S + 1e-9).clamp(0.0, Self::MOST_STEPS)
    }
}

impl EngineRule for QtSpring {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let EngineTick { length, settings: set, .. } = tick;
        let spring = set.stiffness * Self::STEP_S;
        let damping = ((set.damping + set.drag) * Self::STEP_S).min(1.0);
        let clocks = tick.carried.expect("its card says how it restarts")[0].components_mut();
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (((x, v), f), clock) in moved.zip(tick.force.components()).zip(clocks) {
            let target = f / set.stiffness;
            *clock += length;
            let steps = Self::steps(*clock);
            *clock -= steps * Self::STEP_S;
            for _ in 0..steps as u32 {
                *v = *v + spring * (target - *x) - damping * *v;
                *x += *v * 16.0 / 1000.0;
            }
            if steps > 0.0 && v.abs() < Self::REST && (target - *x).abs() < Self::REST {
                (*x, *v) = (target, 0.0);
            }
        }
    }
}
