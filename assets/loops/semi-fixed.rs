//! Semi-fixed steps: the frame in equal parts, none longer than a tick unless there are too many.
//!
//! ```text
//! let (count, step_s) = frame(duration_ns, 60);
//! for _ in 0..count {
//!     world.step(step_s);
//! }
//! world.draw();
//! ```

const MOST_STEPS: i64 = 6;
const SECOND_NS: i64 = 1_000_000_000;

/// The steps to make and the length of each in seconds; `duration_ns` is the duration of the last frame.
pub fn frame(duration_ns: i64, tick_hz: u32) -> (i64, f64) {
    // A clock that went back counts as no time.
    let duration_ns = duration_ns.max(0);
    // Rounded up, but for the nanosecond by which a clock rounds: in nanoseconds times ticks per second a tick is a
    // whole number.
    let fewest = ((duration_ns - 1) * i64::from(tick_hz) + SECOND_NS - 1) / SECOND_NS;
    let count = fewest.max(duration_ns.min(1)).min(MOST_STEPS);
    (count, duration_ns as f64 / 1e9 / count.max(1) as f64)
}
