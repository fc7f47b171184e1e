//! A variable step with a longest one: a hitch slows the game down, and blows nothing up.
//!
//! `world.step(frame(duration_ns)); world.draw();`

const MAX_FRAME_NS: i64 = 1_000_000_000 / 30;

/// The length in seconds of the step to make; `duration_ns` is the duration of the last frame. A clock that went back
/// counts as no time, and no time needs no step.
pub fn frame(duration_ns: i64) -> f64 {
    duration_ns.clamp(0, MAX_FRAME_NS) as f64 / 1e9
}
