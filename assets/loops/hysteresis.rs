//! A fixed tick, with as many ticks a frame as there have been: one comes up to half a tick early or late rather than
//! now and then two in a frame. The picture shows the last one.
//!
//! ```text
//! let mut game_loop = GameLoop::new(60);
//! // Each frame, with the duration of the last one:
//! for _ in 0..game_loop.frame(duration_ns) {
//!     world.step(1.0 / 60.0);
//! }
//! world.draw();
//! ```

/// A tick in the loop's unit of time.
const TICK: i64 = 1_000_000_000;
/// The frames whose counts are compared.
const FRAMES: usize = 12;
/// The most ticks in a frame. The others are not caught up: a machine that is too slow would have ever more to do.
const MOST_TICKS: i64 = 8;

/// The loop. Its time is counted in nanoseconds times ticks per second, in which a tick is whole: nothing is rounded.
pub struct GameLoop {
    tick_hz: i64,
    /// The time since the last tick, from -1/2 to 3/2 ticks.
    owed: i64,
    /// At k, the ticks that the last k frames made.
    made: [i64; FRAMES],
    /// At k, the fewer of the two usual numbers of ticks of k + 1 frames; the other is one more.
    usual: [i64; FRAMES],
}

impl GameLoop {
    /// The loop before its first frame.
    pub fn new(tick_hz: u32) -> Self {
        let one_a_frame = std::array::from_fn(|k| k as i64);
        Self { tick_hz: tick_hz.into(), owed: 0, made: one_a_frame, usual: one_a_frame }
    }

    /// The ticks to make now; `duration_ns` is the duration of the last frame.
    pub fn frame(&mut self, duration_ns: i64) -> i64 {
        // A clock that went back counts as no time.
        self.owed += duration_ns.max(0) * self.tick_hz;
        let (mut least, mut greatest) = (i64::MIN, i64::MAX);
        for (usual, made) in self.usual.iter().zip(&self.made) {
            least = least.max(usual - made);
            greatest = greatest.min(usual + 1 - made);
        }
        let mut due = self.owed.div_euclid(TICK);
        if least <= greatest {
            due = due.clamp(least, greatest);
        }
        let fewest = (self.owed - TICK / 2).div_euclid(TICK).max(0);
        let most = (self.owed + TICK / 2).div_euclid(TICK);
        due = due.clamp(fewest, most);
        self.owed -= due * TICK;
        let ticks = due.min(MOST_TICKS);
        for (usual, made) in self.usual.iter_mut().zip(&self.made) {
            *usual = (*usual).clamp(made + ticks - 1, made + ticks);
        }
        for k in (1..FRAMES).rev() {
            self.made[k] = self.made[k - 1] + ticks;
        }
        ticks
    }
}
