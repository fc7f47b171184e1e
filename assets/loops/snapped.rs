//! A fixed tick whose time is snapped to refreshes of the display and averaged, drawn on a line between the last two
//! ticks: a timer's slight noise does not show.
//!
//! ```text
//! let mut game_loop = GameLoop::new(60, [2997, 50]);
//! // Each frame, with the duration of the last one:
//! for _ in 0..game_loop.frame(duration_ns) {
//!     previous = current;
//!     current = current.stepped(1.0 / 60.0);
//! }
//! draw(game_loop.drawn(previous.x, current.x));
//! ```

const SECOND_NS: i64 = 1_000_000_000;
/// How near to whole refreshes a duration is made whole.
const NEAR_NS: i64 = 200_000;
/// The longest duration that is made whole.
const MOST_REFRESHES: i64 = 8;
/// The most ticks that may be owed. A frame that is longer counts as one tick.
const MOST_TICKS: i64 = 8;

/// The loop. Its time is counted in nanoseconds times ticks per second times the numerator of the refresh rate, in
/// which a tick and a refresh are whole: nothing is rounded.
pub struct GameLoop {
    nanosecond: i64,
    tick: i64,
    refresh: i64,
    last: [i64; 4],
    /// What the means so far have left over.
    remainder: i64,
    /// The time since the last tick.
    owed: i64,
}

impl GameLoop {
    /// The loop before its first frame. The display's rate is a fraction of small numbers: `[60, 1]`, or `[2997, 50]`
    /// for 59.94 Hz.
    pub fn new(tick_hz: u32, refresh_hz: [u32; 2]) -> Self {
        let (tick_hz, [numerator, denominator]) = (i64::from(tick_hz), refresh_hz.map(i64::from));
        let refresh = SECOND_NS * denominator * tick_hz;
        Self {
            nanosecond: tick_hz * numerator,
            tick: SECOND_NS * numerator,
            refresh,
            last: [refresh; 4],
            remainder: 0,
            owed: 0,
        }
    }

    /// The ticks to make now; `duration_ns` is the duration of the last frame.
    pub fn frame(&mut self, duration_ns: i64) -> i64 {
        // A clock that went back counts as no time.
        let mut time = duration_ns.max(0) * self.nanosecond;
        if time > MOST_TICKS * self.tick {
            time = self.tick;
        }
        let nearest = (2 * time + self.refresh) / (2 * self.refresh);
        let whole = nearest.clamp(1, MOST_REFRESHES) * self.refresh;
        if (time - whole).abs() < NEAR_NS * self.nanosecond {
            time = whole;
        }
        self.last.rotate_left(1);
        self.last[3] = time;
        let sum = self.last.iter().sum::<i64>() + self.remainder;
        self.remainder = sum % 4;
        self.owed += sum / 4;
        if self.owed > MOST_TICKS * self.tick {
            self.owed = 0;
        }
        let due = self.owed / self.tick;
        self.owed %= self.tick;
        due
    }

    /// A coordinate to draw, from those at the last two ticks.
    pub fn drawn(&self, previous: f64, current: f64) -> f64 {
        let alpha = self.owed as f64 / self.tick as f64;
        previous + (current - previous) * alpha
    }
}
