//! Lerp per frame, which covers a tenth of the way in every step, whether the step is long or short.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "lerp-per-frame",
    name: "Lerp per frame",
    about: "a tenth of the way in each frame: four times as fast at 144 frames a second as at 30",
    caveat: "the same number is another motion on another display; exponential-decay costs the same and has one motion",
    order: 0,
    order_with_drag: 0,
    source: "folklore of game code; R. Pavlov, Improved Lerp Smoothing, Game Developer (2016)",
    formula: &["x′ = x + 0.1 (g − x)", "v′ = k (g − x′)"],
    follower: Some(FollowerSetting {
        name: "part",
        quantity: FollowerQuantity::Part,
        code: "x += (target - x) * {};",
    }),
    ..FIRST_ORDER_FOLLOWER
};

/// The fraction of the way that each step covers. This value is usual; a higher fraction makes the chase faster at
/// every rate.
const PART: f64 = 0.1;

/// Lerp per frame, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct LerpPerFrame;

impl FollowerRule for LerpPerFrame {
    fn step(_h: f64, k: f64, g: f64, x: f64, _v: f64) -> (f64, f64) {
        lerp(PART, k, g, x)
    }
}
