//! A fixed tick, drawn on a cubic through the last two and their velocities: smooth, round in curves, and one tick
//! late.
//!
//! ```text
//! let mut game_loop = GameLoop::new(60);
//! // Each frame, with the duration of the last one:
//! for _ in 0..game_loop.frame(duration_ns) {
//!     previous = current;
//!     current = current.stepped(1.0 / 60.0);
//! }
//! draw(game_loop.drawn([previous.x, current.x], [previous.v, current.v]));
//! ```

const SECOND_NS: i64 = 1_000_000_000;

/// What is longer is not caught up: a machine that is too slow would have ever more to do.
const MAX_FRAME_MS: i64 = 250;

/// The loop. Its time is counted in nanoseconds times ticks per second, in which a tick is whole: nothing is rounded.
pub struct GameLoop {
    tick_hz: i64,
    /// The time since the last tick.
    owed: i64,
}

impl GameLoop {
    /// The loop before its first frame.
    pub fn new(tick_hz: u32) -> Self {
        Self { tick_hz: tick_hz.into(), owed: 0 }
    }

    /// The ticks to make now; `duration_ns` is the duration of the last frame.
    pub fn frame(&mut self, duration_ns: i64) -> i64 {
        // A clock that went back counts as no time.
        self.owed += duration_ns.max(0) * self.tick_hz;
        let due = self.owed / SECOND_NS;
        self.owed %= SECOND_NS;
        let most = (self.tick_hz * MAX_FRAME_MS + 999) / 1000;
        due.min(most)
    }

    /// How far it is from the last tick to the next, from 0 to 1.
    pub fn alpha(&self) -> f64 {
        self.owed as f64 / SECOND_NS as f64
    }

    /// A coordinate to draw, from those at the last two ticks and the velocities per second there.
    pub fn drawn(&self, x: [f64; 2], v: [f64; 2]) -> f64 {
        let (a, b, tick_s) = (self.alpha(), 1.0 - self.alpha(), 1.0 / self.tick_hz as f64);
        let between = b * b * (1.0 + 2.0 * a) * x[0] + a * a * (1.0 + 2.0 * b) * x[1];
        between + tick_s * a * b * (b * v[0] - a * v[1])
    }
}
