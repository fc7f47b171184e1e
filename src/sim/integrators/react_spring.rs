//! react-spring, which makes whole steps of 1 ms, however long the frame is.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "react-spring",
    name: "React Spring",
    about: "semi-implicit Euler by 1 ms, as often as the frame has milliseconds, rounded up, and 17 times in the first frame; \
            stands once it is within 0.1 % of the way",
    caveat: "its time runs 2 % fast at 60 frames a second and 8 % at 120, and lags below 15.6; here a kick is a new start, with \
             another first frame and another way",
    order: 0,
    order_with_drag: 0,
    restart: Some("with 17 steps, and with the way that is left then"),
    source: "runs of @react-spring/core 10.1.2: SpringValue.ts, with a mass of 1 to the last bit; rafz, src/index.ts",
    formula: &[
        "g = f / K, w = |x − g| at the start",
        "n = ⌈min(1000 H, 64)⌉, and 17 in the first frame; s = 0.001",
        "n times: if |v| ≤ 0.1 p and |x − g| ≤ p = min(0.001 w, 1): x = g, v = 0",
        "else: v = v + s (K (g − x) − (c + C) v), x = x + s v",
    ],
    ..INTERFACE
};

/// react-spring, whose frame follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ReactSpring;

impl ReactSpring {
    /// Length of a step, in seconds.
    pub const STEP_S: f64 = 1e-3;
    /// Length of the longest frame, in seconds.
    pub const LONGEST_S: f64 = 0.064;
    /// Number of steps in the first frame, which counts as 1/60 s.
    pub const FIRST_STEPS: f64 = 17.0;
    /// Fraction of the way that counts as rest; a tenth of it in a millisecond does so as a speed.
    pub const REST: f64 = 1e-3;

    /// Returns the number of steps in a frame of this length in seconds, after the first.
    pub fn steps(frame_s: f64) -> f64 {
        // The subtraction restores a whole number that rounding has raised.
        libm::ceil(1e3 * frame_s.clamp(0.0, Self::LONGEST_S) - 1e-9)
    }
}

impl EngineRule for ReactSpring {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let EngineTick { length, settings: set, .. } = tick;
        let damping = set.damping + set.drag;
        // The precision is 0 before the first frame. The velocity per millisecond is kept for its last bit.
        let [precisions, paces] = tick.carried.expect("its card says how it restarts");
        let kept = precisions.components_mut().iter_mut().zip(paces.components_mut());
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (((x, v), f), (precision, pace)) in moved.zip(tick.force.components()).zip(kept) {
            let target = f / set.stiffness;
            let is_first = *precision == 0.0 && length > 0.0;
            if is_first {
                let way = (*x - target).abs();
                *precision = if way == 0.0 { 0.005 } else { (Self::REST * way).min(1.0) };
            }
            if *v != 1e3 * *pace {
                *pace = *v / 1e3;
            }
            let steps = if is_first { Self::FIRST_STEPS } else { Self::steps(length) };
            for _ in 0..steps as u32 {
                if pace.abs() <= *precision / 10.0 && (target - *x).abs() <= *precision {
                    (*x, *pace) = (target, 0.0);
                    break;
                }
                let spring = -set.stiffness * 1e-6 * (*x - target);
                *pace += spring + -damping * 1e-3 * *pace;
                *x += *pace;
            }
            *v = 1e3 * *pace;
        }
    }
}
