//! A variable step: one step a frame, as long as the last frame was.
//!
//! `world.step(frame(duration_ns)); world.draw();`

/// The length in seconds of the step to make; `duration_ns` is the duration of the last frame. A clock that went back
/// counts as no time, and no time needs no step.
pub fn frame(duration_ns: i64) -> f64 {
    duration_ns.max(0) as f64 / 1e9
}
