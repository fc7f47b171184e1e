//! A fixed tick whose time comes in whole refreshes of the display, drawn on a line between the last two ticks: the
//! timer's noise does not show.
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

/// What is longer is not caught up: a machine that is too slow would have ever more to do.
const MAX_FRAME_MS: i64 = 250;

/// The loop. Its time is counted in nanoseconds times ticks per second times the numerator of the refresh rate, in
/// which a tick and a refresh are whole: nothing is rounded.
pub struct GameLoop {
    nanosecond: i64,
    tick: i64,
    refresh: i64,
    most_ticks: i64,
    /// The time that has not been counted yet; negative where more has been.
    debt: i64,
    /// The time since the last tick.
    owed: i64,
}

impl GameLoop {
    /// The loop before its first frame. The display's rate is a fraction of small numbers: `[60, 1]`, or `[2997, 50]`
    /// for 59.94 Hz.
    pub fn new(tick_hz: u32, refresh_hz: [u32; 2]) -> Self {
        let (tick_hz, [numerator, denominator]) = (i64::from(tick_hz), refresh_hz.map(i64::from));
        Self {
            nanosecond: tick_hz * numerator,
            tick: SECOND_NS * numerator,
            refresh: SECOND_NS * denominator * tick_hz,
            most_ticks: (tick_hz * MAX_FRAME_MS + 999) / 1000,
            debt: 0,
            owed: 0,
        }
    }

    /// The ticks to make now; `duration_ns` is the duration of the last frame.
    pub fn frame(&mut self, duration_ns: i64) -> i64 {
        // A clock that went back counts as no time.
        let time = duration_ns.max(0) * self.nanosecond + self.debt;
        // A picture stays for a refresh at least, unless frames do not wait for the display.
        let a_refresh_ahead = 2 * time <= -self.refresh;
        let nearest = (2 * time + self.refresh) / (2 * self.refresh);
        let refreshes = if a_refresh_ahead { 0 } else { nearest.max(1) };
        self.debt = time - refreshes * self.refresh;
        self.owed += refreshes * self.refresh;
        let due = self.owed / self.tick;
        self.owed %= self.tick;
        due.min(self.most_ticks)
    }

    /// A coordinate to draw, from those at the last two ticks.
    pub fn drawn(&self, previous: f64, current: f64) -> f64 {
        let alpha = self.owed as f64 / self.tick as f64;
        previous + (current - previous) * alpha
    }
}
