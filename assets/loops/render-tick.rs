//! A fixed tick, drawn as a copy that is stepped on by the time since the last one and dropped: smooth and not late,
//! but wrong after each kick, and a step must leave nothing behind but its state.
//!
//! ```text
//! let mut game_loop = GameLoop::new(60);
//! // Each frame, with the duration of the last one:
//! for _ in 0..game_loop.frame(duration_ns) {
//!     world.step(1.0 / 60.0);
//! }
//! let mut ahead = world.clone();
//! ahead.step(game_loop.owed_s());
//! draw(&ahead);
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

    /// The step of the copy that is drawn, in seconds: the time since the last tick.
    pub fn owed_s(&self) -> f64 {
        self.owed as f64 / SECOND_NS as f64 / self.tick_hz as f64
    }
}
