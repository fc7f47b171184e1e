//! Lockstep: one tick a frame, however long the frame was. The game is as fast as the display.
//!
//! `world.step(frame(60)); world.draw();`

/// The length in seconds of the step to make.
pub fn frame(tick_hz: u32) -> f64 {
    1.0 / f64::from(tick_hz)
}
